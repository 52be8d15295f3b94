"""Exudyn's systems and solver: settings, a run that can be stopped, and the samples it keeps."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from traceback import format_exception
from typing import Any

import numpy as np

from analytic import Blade
from analytic.arrays import FloatArray
from analytic.lazily import sparse

from ..runs import Frame
from .elements.formulation import Chain, Formulation
from .lazily import exudyn, items
from .mesh import Mesh


@contextmanager
def exudyn_system() -> Iterator[exudyn.MainSystem]:
    """Give an empty, silent system; none is collected by itself, and memory would grow."""
    exudyn.config.printToConsole = False
    # Without a display, an open renderer ends the process.
    exudyn.special.userInterface.suppressRenderer = True
    container = exudyn.SystemContainer()
    mbs = container.AddSystem()
    try:
        yield mbs
    finally:
        mbs.Reset()
        container.Reset()


def static_settings(blade: Blade, elements: int) -> exudyn.SimulationSettings:
    """Return the settings of a static solution, for a beam of unit length."""
    settings = exudyn.SimulationSettings()
    settings.solution.file.write = False
    settings.staticSolver.verboseMode = 0
    settings.staticSolver.newton.absoluteTolerance = round_off(blade, elements)
    return settings


def round_off(blade: Blade, elements: int) -> float:
    """Return the residual force that Newton cannot go below, for a beam of unit length.

    The axial force EA (|r'| - 1) has its round-off from r' = r/l, the shear force from r''/l²;
    both most on the shortest element.
    """
    finest = blade.length / Mesh(blade=blade, elements=elements).lengths.min()
    return float(
        1e-14 * (finest * blade.axial_stiffness + 10.0 * finest**3 * blade.bending_stiffness)
    )


def mass_matrix(model: Formulation, blade: Blade, elements: int) -> sparse.csr_array:
    """Return the mass matrix of the chain as Exudyn assembles it, root first [SI].

    Of nodes with Euler parameters, whose mass is not constant, that of the places alone.
    """
    with exudyn_system() as mbs:
        model.lay(mbs, blade, elements)
        mbs.Assemble()
        system: Any = mbs.ComputeLinearizedSystem(static_settings(blade, elements))
    mass = np.array(system[0])
    if not model.constant_mass:
        place = np.arange(model.angles.size) < model.dimensions
        mass *= np.outer(*2 * [np.resize(place, len(mass))])
    return sparse.csr_array(mass)


def described(settings: exudyn.SimulationSettings, frame: Frame, every: int) -> dict[str, Any]:
    """Return what a run says of its settings, in the beam's units."""
    integration = settings.timeIntegration
    return {
        "solver": "GeneralizedAlpha" if frame == "inertial" else "trapezoidal rule",
        "spectral_radius": integration.generalizedAlpha.spectralRadius,
        "relative_tolerance": integration.newton.relativeTolerance,
        "absolute_tolerance": integration.newton.absoluteTolerance,
        "sample_every": every,
    }


def solve(
    mbs: exudyn.MainSystem,
    settings: exudyn.SimulationSettings,
    progress: Callable[[float], None] | None,
) -> BaseException | None:
    """Run the solver, and return its error where it gave up.

    Ctrl-C, and whatever `progress` raises, come out unchanged.
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
        if any("KeyboardInterrupt" in one for one in format_exception(error, limit=0)):
            raise KeyboardInterrupt from None
        return error
    if progress is not None:
        progress(1.0)
    return None


@dataclass(frozen=True, kw_only=True)
class Trajectory:
    """Samples of a run, in the units in which it was solved."""

    time: FloatArray
    coordinates: FloatArray  # (samples, nodes, n), reference values included
    velocities: FloatArray
    reference: FloatArray
    elastic_energy: FloatArray
    multipliers: FloatArray  # (samples, constraints), of the root's place, then its direction
    accelerations: FloatArray  # with no samples unless asked for


class Sensors:
    """Coordinates and velocities of all nodes, energy and the clamp's forces, sampled in C++."""

    def __init__(
        self, mbs: exudyn.MainSystem, chain: Chain, clamp: Sequence[exudyn.ObjectIndex],
        accelerations: bool = False,
    ) -> None:  # fmt: skip
        self._mbs, self._chain, self._reference = mbs, chain, chain.reference(mbs)
        kind = exudyn.OutputVariableType
        kept: dict[str, Any] = {"storeInternal": True, "writeToFile": False}

        def of_nodes(variable: Any) -> list[exudyn.SensorIndex]:
            nodal = {"outputVariableType": variable, **kept}
            return [mbs.AddSensor(items.SensorNode(nodeNumber=n, **nodal)) for n in chain.nodes]

        self._coordinates, self._velocities = map(of_nodes, (kind.Coordinates, kind.Coordinates_t))
        self._accelerations = of_nodes(kind.Coordinates_tt) if accelerations else []
        kept["outputVariableType"] = kind.PotentialEnergy
        self._elastic = [
            mbs.AddSensor(items.SensorBody(bodyNumber=one, **kept)) for one in chain.bodies
        ]
        kept["outputVariableType"] = kind.Force
        self._clamp = [mbs.AddSensor(items.SensorObject(objectNumber=o, **kept)) for o in clamp]

    def read(self) -> Trajectory:
        """Return the samples kept."""
        table = self._mbs.GetSensorStoredData

        def values(sensors: Sequence[exudyn.SensorIndex]) -> FloatArray:
            return np.stack([table(one)[:, 1:] for one in sensors], axis=1)

        coordinates = values(self._coordinates) + self._reference
        elastic = np.sum([table(s)[:, 1] for s in self._elastic], axis=0)
        if self._chain.elastic_energy is not None:
            elastic = elastic + self._chain.elastic_energy(coordinates)
        return Trajectory(
            time=np.array(table(self._coordinates[0])[:, 0]),
            coordinates=coordinates,
            velocities=values(self._velocities),
            reference=self._reference,
            elastic_energy=elastic,
            multipliers=np.hstack([coordinates[:, 0, :0], *(table(s)[:, 1:] for s in self._clamp)]),
            accelerations=values(self._accelerations) if self._accelerations else coordinates[:0],
        )
