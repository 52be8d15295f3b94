"""Exudyn's solver: its settings, a run that can be stopped, and the samples it keeps."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from analytic.arrays import FloatArray

from .elements import Chain
from .frame import Frame
from .lazily import exudyn, items

_TOLERANCE = 1e-9
"""Newton's absolute tolerance of forces, in EI/L², where round-off allows it."""


def solver_settings(
    steps: int,
    step: float,
    every: int,
    frame: Frame,
    *,
    round_off: float,
    new_jacobians: bool = False,
    spectral_radius: float = 0.9,
) -> tuple[exudyn.SimulationSettings, dict[str, Any]]:
    """Solver settings, and the same as a plain record, all in the beam's units.

    A tolerance relative to the first residual would loosen with the axial stiffness, and one below
    the round-off is never met, whereupon adaptive stepping halves steps silently: Newton stops at
    an absolute force. In the rotating frame each iteration calls back into Python, and a new
    Jacobian for each step saves iterations; so it does where an element asks for `new_jacobians`.
    An element may also ask for another `spectral_radius` in the inertial frame.
    """
    described: dict[str, Any] = {
        "solver": "GeneralizedAlpha" if frame == "inertial" else "trapezoidal rule",
        "spectral_radius": spectral_radius if frame == "inertial" else 1.0,
        "relative_tolerance": 1e-14,
        "absolute_tolerance": max(_TOLERANCE, round_off),
        "sample_every": every,
    }
    settings = exudyn.SimulationSettings()
    integration = settings.timeIntegration
    integration.endTime = steps * step
    integration.numberOfSteps = steps
    integration.adaptiveStep = False
    integration.generalizedAlpha.spectralRadius = described["spectral_radius"]
    integration.newton.relativeTolerance = described["relative_tolerance"]
    integration.newton.absoluteTolerance = described["absolute_tolerance"]
    integration.newton.modifiedNewtonJacUpdatePerStep = new_jacobians or frame == "rotating"
    integration.verboseMode = 0
    settings.linearSolver.solverType = exudyn.LinearSolverType.EigenSparse
    settings.solution.file.write = False
    # Exactly the interval: a little under it, samples would drift off the grid.
    settings.solution.sensors.writePeriod = every * step
    return settings, described


def solve(
    mbs: exudyn.MainSystem,
    settings: exudyn.SimulationSettings,
    progress: Callable[[float], None] | None,
) -> BaseException | None:
    """Run the solver, and return its error where it gave up.

    Ctrl-C, and whatever `progress` raises, come out as what they are.
    """
    shown, end = 0.0, settings.timeIntegration.endTime
    interruption: BaseException | None = None

    def before_step(mbs: Any, t: float) -> bool:
        # Being called at all lets Python see Ctrl-C between two steps.
        nonlocal shown, interruption
        if progress is not None and t >= shown:
            try:
                progress(min(t / end, 1.0))
            except BaseException as error:
                interruption = error
                raise
            shown += 0.01 * end
        return True

    mbs.SetPreStepUserFunction(before_step)
    try:
        mbs.SolveDynamic(settings)
    except BaseException as error:
        if interruption is not None:
            raise interruption from None
        if "KeyboardInterrupt" in _chain_of(error):
            raise KeyboardInterrupt from None
        return error
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


@dataclass(frozen=True, kw_only=True)
class Trajectory:
    """What was sampled of a run, in the units in which it was solved.

    Attributes
    ----------
    time : ndarray (samples,)
    coordinates, velocities : ndarray (samples, nodes, n)
        Reference values included.
    elastic_energy : ndarray (samples,)
    """

    time: FloatArray
    coordinates: FloatArray
    velocities: FloatArray
    elastic_energy: FloatArray


class Sensors:
    """Coordinates and velocities of all nodes, and the elastic energy, sampled in C++."""

    def __init__(self, mbs: exudyn.MainSystem, chain: Chain) -> None:
        self._mbs, self._chain = mbs, chain
        kind = exudyn.OutputVariableType
        self._reference = np.array(
            [mbs.GetNodeParameter(n, "referenceCoordinates") for n in chain.nodes]
        )
        self._coordinates = [self._of_node(n, kind.Coordinates) for n in chain.nodes]
        self._velocities = [self._of_node(n, kind.Coordinates_t) for n in chain.nodes]
        self._elastic = [
            mbs.AddSensor(
                items.SensorBody(
                    bodyNumber=body,
                    outputVariableType=kind.PotentialEnergy,
                    storeInternal=True,
                    writeToFile=False,
                )
            )
            for body in chain.bodies
        ]

    def _of_node(self, node: Any, variable: Any) -> Any:
        return self._mbs.AddSensor(
            items.SensorNode(
                nodeNumber=node, outputVariableType=variable, storeInternal=True, writeToFile=False
            )
        )

    def read(self) -> Trajectory:
        """Return the samples kept."""
        table = self._mbs.GetSensorStoredData
        coordinates = np.stack([table(s)[:, 1:] for s in self._coordinates], axis=1)
        coordinates += self._reference
        elastic = np.sum([table(s)[:, 1] for s in self._elastic], axis=0)
        if self._chain.elastic_energy is not None:
            elastic = elastic + self._chain.elastic_energy(coordinates)
        return Trajectory(
            time=np.array(table(self._coordinates[0])[:, 0]),
            coordinates=coordinates,
            velocities=np.stack([table(s)[:, 1:] for s in self._velocities], axis=1),
            elastic_energy=elastic,
        )
