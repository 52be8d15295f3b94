r"""A blade in your own Exudyn model
================================

:func:`~rotbeam_exu.fem.add_rotating_beam` adds the driven blade to any Exudyn system and returns
the numbers of its nodes and markers, and settings for the solver: with Exudyn's own, which halve
steps in vain, this run takes 20 times as long. Here a weight hangs on the blade's tip by a spring.
"""

import exudyn as exu
import exudyn.itemInterface as eii  # noqa: N813  (as in its examples)
import matplotlib.pyplot as plt

from analytic import Beam, SpinUp
from rotbeam_exu import figures
from rotbeam_exu.fem import add_rotating_beam

plt.style.use(figures.STYLE)
mbs = exu.SystemContainer().AddSystem()
blade, spin_up = Beam.reference().with_hub_radius(0.5), SpinUp(omega=3.0, ramp_time=3.0)
numbers = add_rotating_beam(mbs, blade, spin_up, elements=8)
weight = mbs.AddNode(eii.NodePoint2D(referenceCoordinates=[9, 0]))
mbs.AddObject(eii.ObjectMassPoint2D(nodeNumber=weight, mass=0.1))
hook = mbs.AddMarker(eii.MarkerNodePosition(nodeNumber=weight))
ends, law = [numbers.tip_marker, hook], {"stiffness": 100.0, "damping": 0.2, "referenceLength": 0.5}
spring = mbs.AddObject(eii.ObjectConnectorSpringDamper(markerNumbers=ends, **law))
pull = exu.OutputVariableType.ForceLocal
force = mbs.AddSensor(eii.SensorObject("", spring, outputVariableType=pull, storeInternal=True))
mbs.Assemble()
mbs.SolveDynamic(numbers.solver_settings(duration=8.0, step=2e-3, every=10))
time, pull = mbs.GetSensorStoredData(force)[:, :2].T
plt.subplot(xlabel="time [s]", ylabel="force of the spring [N]").plot(time, pull)
plt.show()
mbs.Reset()
