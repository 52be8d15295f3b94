r"""Three blades on a free hub
==========================

A motor speeds up a hub with three blades and lets go. There is ice on the first blade's tip.
"""

import exudyn as exu
import exudyn.itemInterface as eii  # noqa: N813  (as in its examples)
import matplotlib.pyplot as plt
import numpy as np

from analytic import Beam
from rotbeam_exu import figures
from rotbeam_exu.fem import add_rotating_beam

plt.style.use(figures.STYLE)
mbs, inertia, impulse = exu.SystemContainer().AddSystem(), 20.0, 500.0  # kg m², N m s
ground, node = mbs.AddObject(eii.ObjectGround()), mbs.AddNode(eii.NodeRigidBody2D())
body = mbs.AddObject(eii.ObjectRigidBody2D(mass=10.0, inertia=inertia, nodeNumber=node))
axis, hub = (mbs.AddMarker(eii.MarkerBodyRigid(bodyNumber=item)) for item in (ground, body))
mbs.AddObject(eii.ObjectJointRevolute2D(markerNumbers=[axis, hub]))
blade = Beam.reference().with_hub_radius(0.5)
three = zip((blade.with_tip_mass(0.2), blade, blade), 2.0 * np.pi / 3.0 * np.arange(3), strict=True)
blades = [add_rotating_beam(mbs, one, hub, azimuth=at, elements=8) for one, at in three]
pulse = lambda mbs, t, _: [0, 0, impulse * np.sin(np.pi * t / 2.0) ** 2 if t < 2.0 else 0.0]  # noqa: E731
mbs.AddLoad(eii.LoadTorqueVector(markerNumber=hub, loadVectorUserFunction=pulse))
keep = {"outputVariableType": exu.OutputVariableType.Coordinates_t, "storeInternal": True}
spin = mbs.AddSensor(eii.SensorNode("", node, **keep))
sensors = [one.add_torque_sensor(mbs) for one in blades]
mbs.Assemble()
mbs.SolveDynamic(blades[0].solver_settings(duration=8.0, step=4e-3, every=5))
time, speed = mbs.GetSensorStoredData(spin)[:, [0, 3]].T
torques = [mbs.GetSensorStoredData(sensor)[:, 1] for sensor in sensors]
_, (above, below) = plt.subplots(2, sharex=True)
above.plot(time, speed)
above.set(ylabel="hub speed [rad/s]")
below.set(xlabel="time [s]", ylabel="clamp torque [N m]")
below.plot(time, torques[0], label="with ice")
below.plot(time, torques[1], "--", label="each of the others")
below.set_ylim(top=330.0)
below.legend(ncols=2)
plt.show()
mbs.Reset()
