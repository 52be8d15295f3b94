r"""A blade in your own Exudyn model
================================

:func:`~rotbeam_exu.fem.add_rotating_beam` adds the driven blade to any Exudyn system and returns
the numbers of its nodes and markers, and settings for the solver: with Exudyn's own, which halve
steps in vain, this run takes 20 times as long. Here a weight hangs on the blade's tip by a spring.
"""

import exudyn as exu
import exudyn.itemInterface as eii  # noqa: N813  (as in its examples)
import matplotlib.pyplot as plt
import numpy as np

from analytic import Beam, SpinUp
from rotbeam_exu import figures
from rotbeam_exu.fem import add_rotating_beam

plt.style.use(figures.STYLE)
blade, spin_up = Beam.reference().with_hub_radius(0.5), SpinUp(omega=3.0, ramp_time=3.0)


def deflection(*, with_weight: bool) -> tuple[np.ndarray, np.ndarray]:
    """Return times and the tip's deflection across the clamp's line, of the finished run."""
    mbs = exu.SystemContainer().AddSystem()
    numbers = add_rotating_beam(mbs, blade, spin_up, elements=8)
    if with_weight:
        weight = mbs.AddNode(eii.NodePoint2D(referenceCoordinates=[9, 0]))
        mbs.AddObject(eii.ObjectMassPoint2D(nodeNumber=weight, mass=0.1))
        hook = mbs.AddMarker(eii.MarkerNodePosition(nodeNumber=weight))
        law = {"stiffness": 100.0, "damping": 0.2, "referenceLength": 0.5}
        ends = [numbers.tip_marker, hook]
        mbs.AddObject(eii.ObjectConnectorSpringDamper(markerNumbers=ends, **law))
    mbs.Assemble()
    mbs.SolveDynamic(numbers.solver_settings(duration=8.0, step=2e-3, every=10))
    time, x, y = mbs.GetSensorStoredData(numbers.tip_sensor)[:, :3].T
    mbs.Reset()
    angle = np.array([spin_up.angle(t) for t in time])
    return time, y * np.cos(angle) - x * np.sin(angle)


alone, loaded = deflection(with_weight=False), deflection(with_weight=True)
ax = plt.subplot(xlabel="time [s]", ylabel="deflection of the tip [m]")
ax.plot(*alone, "k--", label="blade alone")
ax.plot(*loaded, label="with the weight")
ax.legend()
plt.show()
