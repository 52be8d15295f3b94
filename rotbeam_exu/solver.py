"""Exudyn's solver: its settings, a run that can be stopped, and the samples it keeps."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Literal

import exudyn
import numpy as np
from exudyn.itemInterface import SensorBody, SensorNode

from .elements import Chain
from .elements.formulation import FloatArray
from .verdict import SimulationError

Frame = Literal["inertial", "rotating"]

_OUTPUT = exudyn.OutputVariableType


def solver_settings(
    duration: float, steps: int, every: int, frame: Frame
) -> tuple[exudyn.SimulationSettings, dict[str, Any]]:
    """Solver settings, and the same as a plain record.

    The default absolute tolerance lies under the round-off floor, and adaptive stepping then
    halves steps silently. In the rotating frame each iteration calls back into Python, and a new
    Jacobian for each step saves iterations.
    """
    described: dict[str, Any] = {
        "solver": "GeneralizedAlpha" if frame == "inertial" else "trapezoidal rule",
        "spectral_radius": 0.9 if frame == "inertial" else 1.0,
        "relative_tolerance": 1e-8,
        "absolute_tolerance": 1e-6,
        "sample_every": every,
    }
    settings = exudyn.SimulationSettings()
    integration = settings.timeIntegration
    integration.endTime = duration
    integration.numberOfSteps = steps
    integration.adaptiveStep = False
    integration.generalizedAlpha.spectralRadius = described["spectral_radius"]
    integration.newton.relativeTolerance = described["relative_tolerance"]
    integration.newton.absoluteTolerance = described["absolute_tolerance"]
    integration.newton.modifiedNewtonJacUpdatePerStep = frame == "rotating"
    integration.verboseMode = 0
    settings.linearSolver.solverType = exudyn.LinearSolverType.EigenSparse
    settings.solution.file.write = False
    # Exactly the interval: a little under it, samples would drift off the grid.
    settings.solution.sensors.writePeriod = every * duration / steps
    return settings, described


def solve(
    mbs: exudyn.MainSystem,
    settings: exudyn.SimulationSettings,
    duration: float,
    progress: Callable[[float], None] | None,
    smaller: str,
) -> SimulationError | None:
    """Run the solver; Ctrl-C comes out as what it is, a failure is returned with its remedy."""
    shown = 0.0

    def before_step(mbs: Any, t: float) -> bool:
        # Being called at all lets Python see Ctrl-C between two steps.
        nonlocal shown
        if progress is not None and t >= shown:
            progress(min(t / duration, 1.0))
            shown += 0.01 * duration
        return True

    mbs.SetPreStepUserFunction(before_step)
    try:
        mbs.SolveDynamic(settings)
    except BaseException as error:
        if "KeyboardInterrupt" in _chain_of(error):
            raise KeyboardInterrupt from None
        failure = SimulationError(
            f"the solver gave up at t = {mbs.systemData.GetTime():.6g} s of {duration:g} s: "
            f"{smaller}"
        )
        failure.__cause__ = error
        return failure
    if progress is not None:
        progress(1.0)
    return None


def _chain_of(error: BaseException | None) -> str:
    """Names and texts of an error and of what caused it."""
    text = ""
    while error is not None:
        text += f"{type(error).__name__} {error} "
        error = error.__cause__ or error.__context__
    return text


class Sensors:
    """Coordinates and velocities of all nodes, and the elastic energy, sampled in C++."""

    def __init__(self, mbs: exudyn.MainSystem, chain: Chain) -> None:
        self._mbs, self._chain = mbs, chain
        self._reference = np.array(
            [mbs.GetNodeParameter(n, "referenceCoordinates") for n in chain.nodes]
        )
        self._coordinates = [self._of_node(n, _OUTPUT.Coordinates) for n in chain.nodes]
        self._velocities = [self._of_node(n, _OUTPUT.Coordinates_t) for n in chain.nodes]
        self._elastic = [
            mbs.AddSensor(
                SensorBody(
                    bodyNumber=body,
                    outputVariableType=_OUTPUT.PotentialEnergy,
                    storeInternal=True,
                    writeToFile=False,
                )
            )
            for body in chain.bodies
        ]

    def _of_node(self, node: Any, variable: Any) -> Any:
        return self._mbs.AddSensor(
            SensorNode(
                nodeNumber=node, outputVariableType=variable, storeInternal=True, writeToFile=False
            )
        )

    def read(self) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """Time (n,), coordinates and velocities (n, nodes, ·), elastic energy (n,)."""
        table = self._mbs.GetSensorStoredData
        time = np.array(table(self._coordinates[0])[:, 0])
        coordinates = np.stack([table(s)[:, 1:] for s in self._coordinates], axis=1)
        velocities = np.stack([table(s)[:, 1:] for s in self._velocities], axis=1)
        coordinates += self._reference
        elastic = np.sum([table(s)[:, 1] for s in self._elastic], axis=0)
        if self._chain.elastic_energy is not None:
            elastic = elastic + self._chain.elastic_energy(coordinates)
        return time, coordinates, velocities, elastic
