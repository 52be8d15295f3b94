"""The exact beam in steady rotation: its functions, the system of its orbits, modes, states."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from typing import Any, ClassVar, NamedTuple, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...arrays import ComplexArray, FloatArray, evaluated, in_units
from ...blade import Blade
from ...blade_checks import require_planar, require_steady_state
from ...input_checks import points_of_beam, whole_number
from ...methods.orbit import Orbit
from ...methods.system import Tangent, reciprocal_modes
from ...shape_functions import shape_functions
from ...theory import BERNOULLI_EULER, Theory, require_theory
from ...unit_blade import UnitBlade
from .planar import Continuum
from .state import BeamState, Driven

MOST_FUNCTIONS = 256
"""For θ; beyond, the eigenproblem takes seconds."""


continuum = lru_cache(maxsize=32)(Continuum)
"""The discretization, built once for each set of arguments."""


def blade_continuum(blade: Blade, theory: Theory, bending: int, axial: int) -> Continuum:
    """Return the discretization by at least so many functions, as many on every panel."""
    require_planar(blade)
    unit = _unit(blade, require_theory(theory))
    slenderness, axial = (blade.slenderness, axial) if theory.extension else (0.0, 1)
    bending, axial = (shape_functions(unit, count).count for count in (bending, axial))
    return continuum(slenderness, bending, axial, unit, theory.shear, theory.engesser)


def resolved_model(blade: Blade, mode: int, theory: Theory, functions: int) -> Continuum:
    """Return the discretization, refusing a mode that it does not resolve."""
    functions = whole_number("functions", functions, least=4)
    if functions > MOST_FUNCTIONS or mode > MOST_FUNCTIONS // 2:
        raise ValueError(
            f"at most {MOST_FUNCTIONS} functions are taken, which resolve {MOST_FUNCTIONS // 2} "
            f"modes, got functions={functions} for mode {mode}: ask for less"
        )
    if mode > functions // 2:
        raise ValueError(
            f"mode {mode} is beyond the {functions // 2} that {functions} functions resolve; "
            f"ask for functions={2 * mode} or more"
        )
    return blade_continuum(blade, theory, functions, max(4, 5 * functions // 8))


def require_shear(blade: Blade, theory: Theory) -> None:
    """Refuse a number for sections that tell their shear stiffness, and True for others."""
    if theory.shear is not None and (theory.shear is True) != blade.section.at_stations:
        raise ValueError(
            f"shear = {theory.shear} does not fit the blade: a blade from stations tells its "
            "shear stiffness, take Theory(shear=True); others need the ratio to EA, as "
            "Theory(shear=0.32)"
        )


def _unit(blade: Blade, theory: Theory) -> UnitBlade:
    """Return the blade without dimensions, with the rotary inertia of its slices."""
    require_shear(blade, theory)
    unit, given = blade.unit, blade.section.rotary_inertia is not None
    if given or not theory.rotary_inertia:
        return unit
    x = np.linspace(0.0, 1.0, 257)
    if not np.allclose(evaluated(unit.mass, x), evaluated(unit.axial, x), rtol=1e-9):
        raise ValueError(
            "mass and axial stiffness of the blade do not vary alike, so that its sections "
            "have no one ρ/E to take their rotary inertia from: give "
            "Section(rotary_inertia=...) in kg m"
        )
    return replace(unit, rotary=in_units(unit.bending, 1.0, 1.0 / blade.slenderness))


def on_more(q: FloatArray, own: tuple[int, ...], others: tuple[int, ...]) -> FloatArray:
    """Return coordinates of the same shape where each family has as many functions or more."""
    parts = np.split(q, np.cumsum(own)[:-1], axis=-1)
    more = [[(0, 0)] * (q.ndim - 1) + [(0, n - m)] for m, n in zip(own, others, strict=True)]
    return np.concatenate(list(map(np.pad, parts, more)), axis=-1)


class Discretized:
    """Size and refinement of a discretized blade, in the plane or in space."""

    model: Any

    @property
    def size(self) -> int:
        """Number of coordinates."""
        return int(self.model.size)

    @property
    def functions(self) -> int:
        """Number of functions for each curvature of bending."""
        return int(self.model.bending)

    def lifted(self, q: FloatArray, finer: Self) -> FloatArray:
        """Return the coordinates of the same shape on more functions, along the last axis."""
        return on_more(q, self.model.families, finer.model.families)

    def by(self, *drive: Any) -> Driven:
        """Return what drives it, where a drive acts at phases (samples,) and a frequency."""
        raise NotImplementedError

    def residual(self, *state: Any) -> FloatArray:
        """Return the virtual work (samples, n) of all forces in states q, q̇, q̈ and their drive."""
        return np.asarray(self.model.residual(*state[:3], self.by(*state[3:])))

    def tangent(self, *state: Any) -> Tangent:
        """Return the residual of the same states and its derivatives to q, q̇ and q̈."""
        tangent: Tangent = self.model.tangent(*state[:3], self.by(*state[3:]))
        return tangent

    def section_loads(self, x: FloatArray, *state: Any) -> tuple[FloatArray, FloatArray]:
        """Return force and moment at `x` in the same states, as the model has them."""
        loads: tuple[FloatArray, FloatArray]
        loads = self.model.section_loads(x, *state[:3], self.by(*state[3:]))
        return loads


class AtConstantRate(Discretized):
    """Equations of a blade in a frame that turns at a constant rate, in the plane or in space."""

    rate: float
    direction: tuple[float, ...] = (0.0, 1.0, 0.0)
    driven: ClassVar[bool] = False
    stiff: ClassVar[bool] = False

    @property
    def push(self) -> FloatArray | None:
        """The load, as `model.residual` takes it."""
        return None

    def unloaded(self, frequency: float) -> Self:
        """Return it without load, at the speed that belongs to a drive's frequency."""
        del frequency
        return self

    def by(self, *drive: Any) -> Driven:
        """Return what drives it."""
        del drive
        return Driven(self.rate, push=self.push)

    def potential(self, q: FloatArray) -> FloatArray:
        """Return the amended potential, of the elastic and the centrifugal forces, (samples,)."""
        return np.asarray(self.model.amended_potential(q, self.rate))

    def kinetic_energy(self, q: FloatArray, q_dot: FloatArray) -> FloatArray:
        """Return the kinetic energy relative to the rotating frame, (samples,)."""
        return np.asarray(self.model.kinetic_energy(q, q_dot))


@dataclass(frozen=True, eq=False)
class SteadyBeam(AtConstantRate):
    """The beam in a frame that turns at a constant rate; a system of `methods`.

    The gauge is the tip's deflection over the length. The motion (θ, e, γ)(t) → (-θ, e, -γ)(-t)
    maps orbits onto orbits: θ and γ are odd. The invariant is the Jacobi integral.
    """

    model: Continuum
    rate: float  # w̄ = ω/√(EI/mL³)

    @cached_property
    def odd(self) -> NDArray[np.bool_]:
        """True for the coordinates of θ and γ, (n,)."""
        return self.model.odd

    @cached_property
    def equilibrium(self) -> FloatArray:
        """Coordinates (n,) of the straight beam that the rotation stretches."""
        return self.model.steady_state(self.rate)

    def gauge(self, q: FloatArray) -> FloatArray:
        """Return the tip's deflection v(1), (samples,)."""
        return self.model.tip(q).imag

    def gauge_rate(self, q: FloatArray, q_dot: FloatArray) -> FloatArray:
        """Return the rate of the tip's deflection, (samples,)."""
        return self.model.tip_rate(q, q_dot).imag

    def gauge_gradient(self, q: FloatArray) -> FloatArray:
        """Return the derivatives of the tip's deflection to the coordinates, (samples, n)."""
        return self.model.tip_gradient(q).imag

    def refined(self) -> Self:
        """Return the beam on half as many functions again."""
        old = self.model
        panels = old.blade.panel_count

        def more(count: int) -> int:
            a_panel = count // panels
            # One more at least, on every panel: the same functions would confirm themselves.
            return panels * (a_panel + max(a_panel // 2, 1))

        axial = more(old.axial) if old.slenderness > 0.0 else old.axial
        finer = continuum(
            old.slenderness, more(old.bending), axial, old.blade, old.shear_ratio, old.engesser
        )
        return replace(self, model=finer)


BeamOrbit = Orbit[SteadyBeam]
"""A periodic orbit of the beam."""


def steady_rotation(blade: Blade, omega: float, model: Continuum) -> SteadyBeam:
    """Return the beam in steady rotation at ω [rad/s], refusing a speed that tears it."""
    if model.slenderness > 0.0:
        require_steady_state(blade, omega)
    return SteadyBeam(model, omega / blade.frequency_scale)


class Modes(NamedTuple):
    """Nondimensional frequencies (n,), coordinates (n, n) and slopes z' (n, points)."""

    frequencies: FloatArray
    coordinates: FloatArray
    slopes: ComplexArray


def solve_modes(steady: SteadyBeam) -> Modes:
    """Return all modes about the steady state, the slopes scaled to a tip displacement of 1.

    With θ and γ in the sine and e in the cosine of Ωτ, K - ΩS - Ω²M is real and symmetric.
    """
    model, at, at_rest = steady.model, steady.equilibrium, np.zeros((1, steady.size))
    tangent = steady.tangent(at[None], at_rest, at_rest)
    gyroscopic = np.where(np.outer(model.odd, ~model.odd), tangent.damping[0], 0.0)
    gyroscopic += gyroscopic.T
    inverse, shapes = reciprocal_modes(tangent.stiffness[0], gyroscopic, tangent.mass[0])
    # The inextensible beam has no axial modes: they come out with ν = 0.
    kept = inverse > 1e-12
    coordinates = shapes.T[kept]
    slopes = model.slope_rate(at, coordinates)
    tips = slopes @ model.weights
    scale = np.where(np.abs(tips.imag) >= np.abs(tips.real), tips.imag, tips.real)
    return Modes(1.0 / inverse[kept], coordinates / scale[:, None], slopes / scale[:, None])


def stretched_state(blade: Blade, omega: float, x: ArrayLike) -> BeamState:
    """Return the state of the beam that turns at `omega` [rad/s] and does not swing."""
    steady = steady_rotation(blade, omega, blade_continuum(blade, BERNOULLI_EULER, 20, 10))
    return state_of(blade, steady.model, steady.equilibrium, np.zeros(steady.size), x)


def state_of(
    blade: Blade, model: Continuum, q: FloatArray, q_dot: FloatArray, x: ArrayLike
) -> BeamState:
    """Return the state of coordinates and their rates (n,) at the points `x` [m]; of the plane."""
    if model.in_space:
        raise ValueError(
            "the state of a blade in space is more than u, v and their rates: take axis, at two "
            "phases for the rates"
        )
    at, length, per_second = (
        points_of_beam("x", x, blade.length),
        blade.length,
        blade.frequency_scale,
    )
    slope, slope_rate = model.slope(q, at), per_second * model.slope_rate(q, q_dot, at)
    z = length * model.integrated(model.slope(q), at)
    z_dot = length * per_second * model.integrated(model.slope_rate(q, q_dot), at)
    shear, shear_rate = model.shear_angle(q, q_dot, at)
    return BeamState(
        u=z.real - length * at,
        v=z.imag,
        u_slope=slope.real - 1.0,
        v_slope=slope.imag,
        u_dot=z_dot.real,
        v_dot=z_dot.imag,
        u_slope_dot=slope_rate.real,
        v_slope_dot=slope_rate.imag,
        shear_angle=shear,
        shear_angle_dot=per_second * shear_rate,
    )
