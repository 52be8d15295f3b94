"""The model about its rotating equilibrium, undamped: mass, stretch, natural frequencies."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import numpy as np

from analytic import AnyBlade, SteadyRotation
from analytic.arrays import ComplexArray, FloatArray
from analytic.beam import require_planar, require_steady_state, undamped, warn_if_rpm
from analytic.input_checks import rotation_speed, whole_number
from analytic.lazily import sparse
from analytic.methods.gyroscopic import inverse_eigenvalues

from ..resolution import require_feasible, require_stretch, warn_if_coarse
from ..verdict import SimulationError
from . import drive
from .elements import Chain, Formulation, formulation, require_modeled
from .lazily import exudyn
from .system import exudyn_system
from .units import Units


@dataclass(frozen=True, kw_only=True)
class Linearization:
    """The model about its rotating equilibrium, M ü + G u̇ + K u = 0, in the beam's units.

    Attributes
    ----------
    mass : ndarray (n, n)
        Of the free coordinates, as the two that follow.
    stiffness : ndarray (n, n)
    gyroscopic : ndarray (n, n)
    stretch : float
        How far the rotation moves the tip.
    """

    mass: FloatArray
    stiffness: FloatArray
    gyroscopic: FloatArray
    stretch: float

    def inverse_eigenvalues(self) -> ComplexArray:
        """Return 1/λ of λ² M + λ G + K = 0."""
        return inverse_eigenvalues(self.mass, self.gyroscopic, self.stiffness)


def mass_matrix(model: Formulation, beam: AnyBlade, elements: int) -> sparse.csr_array:
    """Return the constant mass matrix of the chain as Exudyn assembles it, root first [SI]."""
    with exudyn_system() as mbs:
        model.lay(mbs, beam, elements)
        mbs.Assemble()
        system: Any = mbs.ComputeLinearizedSystem(_static_settings(beam, elements))
    return sparse.csr_array(np.asarray(system[0]))


def natural_frequencies(
    beam: AnyBlade,
    omega: float,
    *,
    element: str | Formulation = "cable",
    elements: int = 16,
    count: int = 3,
) -> FloatArray:
    """Natural frequencies [rad/s] of the finite element model in steady rotation, ascending.

    Small undamped vibration in the plane of bending, about the equilibrium stretched by the
    rotation, Coriolis and centrifugal terms included: the ω_n to which a nonlinear frequency of
    the same mesh belongs. Damping of the blade does not count.

    Parameters
    ----------
    beam : Beam or Blade
    omega : float
        Steady angular velocity ω [rad/s].
    element, elements
        Formulation and number of elements, as in `simulate`.
    count : int
        How many frequencies.

    Returns
    -------
    ndarray of shape (count,)

    Raises
    ------
    ValueError
        If an input is refused, or the mesh has fewer than `count` modes.
    SimulationError
        If the static equilibrium is not found, or unstable: frequencies would not tell.

    Examples
    --------
    >>> from analytic import Beam
    >>> from rotbeam_exu import natural_frequencies
    >>> for element in ("cable", "exact"):
    ...     found = natural_frequencies(Beam.reference(), omega=6.0, element=element, elements=8)
    ...     print(element, found.round(4))
    cable [ 3.7311 23.0152 56.6964]
    exact [ 3.7282 23.6436 62.3349]
    """
    require_planar(beam)
    warn_if_coarse(beam, rotation_speed(omega), whole_number("elements", elements))
    return mesh_frequencies(beam, omega, element, elements, count)


def mesh_frequencies(
    beam: AnyBlade, omega: float, element: str | Formulation, elements: int, count: int
) -> FloatArray:
    """Return what `natural_frequencies` does, of a mesh however coarse: its own ω_n."""
    whole_number("count", count)
    system = linearized(beam, omega, element, elements)
    name, modes = formulation(element).name, system.mass.shape[0]
    if count > modes:
        raise ValueError(
            f"count = {count} is more than the {modes} modes of {elements} {name!r} "
            "elements; take more elements"
        )
    inverse = system.inverse_eigenvalues()
    growth = _growth(inverse) / Units.of(beam).time
    if growth > 0.0:
        raise SimulationError(
            f"the steady state of {elements} {name!r} elements at omega = "
            f"{omega:g} rad/s is unstable, it grows with {growth:.6g} 1/s: lower the speed or take "
            "another element"
        )
    slowest = np.sort(np.abs(inverse.imag))[::-1][: 2 * count : 2]
    return np.asarray(1.0 / slowest) / Units.of(beam).time


def growth_rate(
    beam: AnyBlade, omega: float, *, element: str | Formulation = "linear", elements: int = 16
) -> float:
    """Rate [1/s] at which a small disturbance of the steady rotation grows; zero where stable.

    Zero for every element that describes large deformation; for the linear floating frame it is
    √(ω² - ω0²) above ω0, but for the axial coupling, of the order of μ.

    Examples
    --------
    >>> from analytic import Beam
    >>> from rotbeam_exu import growth_rate
    >>> for element in ("linear", "cable"):
    ...     print(f"{element}: {growth_rate(Beam.reference(), omega=6.0, element=element):.4f} 1/s")
    linear: 5.2471 1/s
    cable: 0.0000 1/s
    """
    system = linearized(beam, omega, element, elements)
    return _growth(system.inverse_eigenvalues()) / Units.of(beam).time


def _growth(inverse: ComplexArray) -> float:
    """Return the largest real part of λ beyond what round-off gives to undamped modes."""
    growing = inverse[inverse.real > 1e-6 * np.abs(inverse).max()]
    return float((1.0 / growing).real.max()) if growing.size else 0.0


def steady_stretch(
    beam: AnyBlade, omega: float, *, element: str | Formulation = "cable", elements: int = 16
) -> float:
    """Tip displacement [m] along the beam in steady rotation without vibration.

    To leading order in μ it is Δl_ω = mω²L²/(3EA), Eq. 67; the whole of it is
    tan(kL)/k - L with k = ω √(ρ/E), larger by the factor 1 + (2/5)(kL)².

    Examples
    --------
    >>> from analytic import Beam
    >>> from rotbeam_exu import steady_stretch
    >>> print(f"{steady_stretch(Beam.reference(), omega=6.0):.2e} m")
    2.47e-04 m
    """
    return linearized(beam, omega, element, elements).stretch * beam.length


def linearized(
    beam: AnyBlade, omega: float, element: str | Formulation, elements: int
) -> Linearization:
    """Return the model about its equilibrium at ω [rad/s], refusing what has none."""
    with steady_system(beam, omega, element, elements) as (mbs, chain, settings):
        tip = mbs.GetNodeOutput(chain.nodes[-1], exudyn.OutputVariableType.Displacement)
        linear: Any = mbs.ComputeLinearizedSystem(settings, projectIntoConstraintNullspace=True)
    mass_projected, stiffness, gyroscopic = (np.asarray(m) for m in linear[:3])
    return Linearization(
        mass=mass_projected, stiffness=stiffness, gyroscopic=gyroscopic, stretch=float(tip[0])
    )


@contextmanager
def steady_system(
    beam: AnyBlade, omega: float, element: str | Formulation, elements: int
) -> Iterator[tuple[exudyn.MainSystem, Chain, exudyn.SimulationSettings]]:
    """Give the model in the rotating frame and the beam's units, at its equilibrium at ω [rad/s].

    With its chain and the settings of a static solution.
    """
    omega = rotation_speed(omega)
    warn_if_rpm(beam, omega)
    require_steady_state(beam, omega)
    beam, model, units = undamped(beam), formulation(element), Units.of(beam)
    require_modeled(beam, model)
    rotation = units.rotation(SteadyRotation(omega=omega))
    unit_beam = units.beam(beam)
    elements = whole_number("elements", elements)
    require_stretch(beam)
    require_feasible(elements)
    mass = mass_matrix(model, unit_beam, elements)
    with exudyn_system() as mbs:
        chain = model.lay(mbs, unit_beam, elements)
        drive.fix_root(mbs, chain, model, direction=True)
        drive.add_inertial_forces(mbs, chain, model, mass, rotation, beam.unit.setting)
        mbs.Assemble()
        settings = _static_settings(unit_beam, elements)
        try:
            mbs.SolveStatic(settings, updateInitialValues=True)
        except Exception as error:
            raise SimulationError(
                f"no steady state found at omega = {omega:g} rad/s: check the axial stiffness "
                f"EA = {beam.axial_stiffness:g} N and the speed"
            ) from error
        yield mbs, chain, settings


def _static_settings(beam: AnyBlade, elements: int) -> exudyn.SimulationSettings:
    settings = exudyn.SimulationSettings()
    settings.solution.file.write = False
    settings.staticSolver.verboseMode = 0
    settings.staticSolver.newton.absoluteTolerance = round_off(beam, elements)
    return settings


def round_off(beam: AnyBlade, elements: int) -> float:
    """Return the residual force that Newton cannot go below, for a beam of unit length.

    The axial force EA (|r'| - 1) has its round-off from r' = r/l, the shear force from r''/l².
    """
    return 1e-14 * (elements * beam.axial_stiffness + 10.0 * elements**3 * beam.bending_stiffness)
