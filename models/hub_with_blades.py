r"""Three blades on a free hub
==========================

A marker on a body of your own is a clamp, too. Here a motor speeds up a hub with three blades for
two seconds and lets it go. The hub turns against the swinging blades. There is ice on the tip of
the first, whose clamp needs another torque.
"""

import exudyn as exu
import exudyn.itemInterface as eii  # noqa: N813  (as in its examples)
import matplotlib.pyplot as plt
import numpy as np

from analytic import Beam
from rotbeam_exu import figures
from rotbeam_exu.fem import add_rotating_beam

plt.style.use(figures.STYLE)
mbs = exu.SystemContainer().AddSystem()
inertia, impulse, end = 20.0, 500.0, 2.0  # kg m², N m s, s
blade = Beam.reference().with_hub_radius(0.5)

ground = mbs.AddObject(eii.ObjectGround())
node = mbs.AddNode(eii.NodeRigidBody2D())
body = mbs.AddObject(eii.ObjectRigidBody2D(mass=10.0, inertia=inertia, nodeNumber=node))
axis, hub = (mbs.AddMarker(eii.MarkerBodyRigid(bodyNumber=item)) for item in (ground, body))
mbs.AddObject(eii.ObjectJointRevolute2D(markerNumbers=[axis, hub]))
blades = [
    add_rotating_beam(mbs, one, hub, azimuth=2.0 * np.pi * k / 3.0, elements=8)
    for k, one in enumerate((blade.with_tip_mass(0.2), blade, blade))
]


def motor(mbs: exu.MainSystem, t: float, torque: np.ndarray) -> list[float]:
    """Torque of the motor, smooth from 0 s to `end`."""
    return [0.0, 0.0, 2.0 * impulse / end * np.sin(np.pi * t / end) ** 2 if t < end else 0.0]


mbs.AddLoad(eii.LoadTorqueVector(markerNumber=hub, loadVectorUserFunction=motor))
rates = exu.OutputVariableType.Coordinates_t
spin = mbs.AddSensor(eii.SensorNode("", node, outputVariableType=rates, storeInternal=True))
sensors = [one.add_torque_sensor(mbs) for one in blades]
mbs.Assemble()
mbs.SolveDynamic(blades[0].solver_settings(duration=8.0, step=4e-3, every=5))
time, speed = mbs.GetSensorStoredData(spin)[:, [0, 3]].T
torques = [mbs.GetSensorStoredData(sensor)[:, 1] for sensor in sensors]

_, (above, below) = plt.subplots(2, sharex=True)
above.plot(time, speed)
above.set_ylabel("speed of the hub [rad/s]")
below.plot(time, torques[0], label="with ice")
below.plot(time, torques[1], label="each of the others")
below.set(xlabel="time [s]", ylabel="torque of the clamp [N m]")
below.legend()
plt.show()
mbs.Reset()
