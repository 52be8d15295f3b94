r"""
A blade in an Exudyn model of one's own
=======================================

:func:`~rotbeam_exu.fem.rotating_beam.add_rotating_beam` puts the driven blade into any Exudyn
system and returns its numbers. Here a weight hangs on its tip by a spring, which `simulate` does
not know of.
"""

import exudyn as exu
import matplotlib.pyplot as plt
import numpy as np
from exudyn.itemInterface import (
    MarkerNodePosition,
    NodePoint2D,
    ObjectConnectorSpringDamper,
    ObjectMassPoint2D,
    SensorNode,
)

from analytic import Beam, SpinUp
from rotbeam_exu.fem import add_rotating_beam

SC = exu.SystemContainer()
mbs = SC.AddSystem()

blade = Beam.reference().with_hub_radius(0.5)
spin_up = SpinUp(omega=3.0, ramp_time=3.0)
numbers = add_rotating_beam(mbs, blade, spin_up, elements=8)

# %%
# A weight of 0.1 kg beyond the tip, on a spring of half a meter.
weight = mbs.AddNode(NodePoint2D(referenceCoordinates=[9.0, 0.0]))
mbs.AddObject(ObjectMassPoint2D(nodeNumber=weight, mass=0.1))
hook = mbs.AddMarker(MarkerNodePosition(nodeNumber=weight))
mbs.AddObject(
    ObjectConnectorSpringDamper(
        markerNumbers=[numbers.tip_marker, hook], stiffness=100.0, damping=0.2, referenceLength=0.5
    )
)
sensor = mbs.AddSensor(
    SensorNode(
        nodeNumber=weight,
        outputVariableType=exu.OutputVariableType.Position,
        storeInternal=True,
        writeToFile=False,
    )
)
mbs.Assemble()

settings = exu.SimulationSettings()
settings.timeIntegration.endTime = 8.0
settings.timeIntegration.numberOfSteps = 4000
settings.timeIntegration.generalizedAlpha.spectralRadius = 0.9
settings.timeIntegration.verboseMode = 0
settings.solution.file.write = False
settings.solution.sensors.writePeriod = 0.02
mbs.SolveDynamic(settings)

# %%
# The path of tip and weight, seen from above.
paths = [mbs.GetSensorStoredData(number) for number in (numbers.tip_sensor, sensor)]
_, ax = plt.subplots(figsize=(5, 5), layout="constrained")
for path, name in zip(paths, ("tip", "weight"), strict=True):
    ax.plot(path[:, 1], path[:, 2], label=name)
ax.set(xlabel="x [m]", ylabel="y [m]", aspect="equal")
ax.legend()
plt.show()

stretch = np.linalg.norm(paths[1][:, 1:3] - paths[0][:, 1:3], axis=1) - 0.5
print(f"the spring is stretched by {stretch[-100:].mean():.3f} m")

# Systems are not collected by themselves.
mbs.Reset()
SC.Reset()
