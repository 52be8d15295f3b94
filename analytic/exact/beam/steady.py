"""The exact beam in steady rotation: the system whose orbits are sought, its modes and states."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, ClassVar, NamedTuple, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...arrays import ComplexArray, FloatArray
from ...beam import AnyBlade, require_steady_state
from ...input_checks import finite_number, points_of_beam
from ...methods.gyroscopic import reciprocal_modes
from ...methods.orbit import Orbit
from ...methods.system import Tangent
from ...theory import BERNOULLI_EULER
from .continuum import Continuum
from .discretization import blade_continuum, finer_model
from .state import BeamState, Driven


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
        return np.asarray(self.model.padded(q, finer.model))


class AtConstantRate(Discretized):
    """Equations of a blade in a frame that turns at a constant rate, in the plane or in space."""

    rate: float
    driven: ClassVar[bool] = False

    @property
    def push(self) -> FloatArray | None:
        """The load, as `model.residual` takes it."""
        return None

    def unloaded(self, frequency: float) -> Self:
        """Return it without load, at the speed that belongs to a drive's frequency."""
        del frequency
        return self

    def by(self) -> Driven:
        """Return what drives it."""
        return Driven(self.rate, push=self.push)

    def residual(self, q: FloatArray, q_dot: FloatArray, q_ddot: FloatArray) -> FloatArray:
        """Return the virtual work of all forces, (samples, n)."""
        return np.asarray(self.model.residual(q, q_dot, q_ddot, self.by()))

    def tangent(self, q: FloatArray, q_dot: FloatArray, q_ddot: FloatArray) -> Tangent:
        """Return the residual and its derivatives to q, q̇ and q̈."""
        tangent: Tangent = self.model.tangent(q, q_dot, q_ddot, self.by())
        return tangent

    def section_loads(self, x: FloatArray, *state: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return force and moment at `x` in states q, q̇, q̈, as the model has them."""
        found: tuple[FloatArray, FloatArray] = self.model.section_loads(x, *state, self.by())
        return found

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

    Attributes
    ----------
    model : Continuum
    rate : float
        w̄ = ω/√(EI/mL³).
    """

    model: Continuum
    rate: float

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
        return replace(self, model=finer_model(self.model))


BeamOrbit = Orbit[SteadyBeam]
"""A periodic orbit of the beam."""


def steady_rotation(beam: AnyBlade, omega: float, model: Continuum) -> SteadyBeam:
    """Return the beam in steady rotation at ω [rad/s], refusing a speed that tears it."""
    if model.slenderness > 0.0:
        require_steady_state(beam, omega)
    return SteadyBeam(model, omega / beam.frequency_scale)


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


def stretched_state(beam: AnyBlade, omega: float, x: ArrayLike) -> BeamState:
    """Return the state of the beam that turns at `omega` [rad/s] and does not swing."""
    steady = steady_rotation(beam, omega, blade_continuum(beam, BERNOULLI_EULER, 20, 10))
    return _state(beam, steady.model, steady.equilibrium, np.zeros(steady.size), x)


def orbit_state(
    beam: AnyBlade,
    orbit: Orbit[Any],
    x: ArrayLike,
    phase: float,
) -> BeamState:
    """Return the state of an orbit of `beam` at the points `x` [m] and the `phase` [rad]."""
    phases = np.array([finite_number("phase", phase, "rad")])
    (q,), (q_dot,), _ = orbit.coordinates(phases)
    return _state(beam, orbit.system.model, q, q_dot, x)


def _state(
    beam: AnyBlade, model: Continuum, q: FloatArray, q_dot: FloatArray, x: ArrayLike
) -> BeamState:
    at, length, per_second = points_of_beam("x", x, beam.length), beam.length, beam.frequency_scale
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
