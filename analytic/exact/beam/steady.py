"""The exact beam in steady rotation: the system whose modes and orbits are sought."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, ClassVar, Self

import numpy as np
from numpy.typing import NDArray

from ...arrays import FloatArray
from ...beam import AnyBlade, require_steady_state
from ...methods.orbit import Orbit
from ...methods.system import Tangent
from .continuum import Continuum
from .discretization import finer_model


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

    def residual(self, q: FloatArray, q_dot: FloatArray, q_ddot: FloatArray) -> FloatArray:
        """Return the virtual work of all forces, (samples, n)."""
        return np.asarray(self.model.residual(q, q_dot, q_ddot, self.rate, push=self.push))

    def tangent(self, q: FloatArray, q_dot: FloatArray, q_ddot: FloatArray) -> Tangent:
        """Return the residual and its derivatives to q, q̇ and q̈."""
        tangent: Tangent = self.model.tangent(q, q_dot, q_ddot, self.rate, push=self.push)
        return tangent

    def potential(self, q: FloatArray) -> FloatArray:
        """Return the amended potential, of the elastic and the centrifugal forces, (samples,)."""
        return np.asarray(self.model.amended_potential(q, self.rate))

    def kinetic_energy(self, q: FloatArray, q_dot: FloatArray) -> FloatArray:
        """Return the kinetic energy relative to the rotating frame, (samples,)."""
        return np.asarray(self.model.kinetic_energy(q, q_dot))


@dataclass(frozen=True, eq=False)
class SteadyBeam(AtConstantRate):
    """The beam in a frame that turns at a constant rate; a `methods.System`.

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
