"""Loads on the exact blade: nondimensional, and as the driven system they make of it.

A load is a complex force in the frame of the clamp, per mass (gravity), per length, or at the tip.
A ripple of the speed is no force but changes w and ẇ.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any, ClassVar

import numpy as np

from ...arrays import FloatArray
from ...beam import AnyBlade, require_blade
from ...loads import Load, require_load
from ...methods.system import Tangent
from ..beam.continuum import Continuum
from ..beam.state import Driven
from ..beam.steady import Discretized, SteadyBeam
from ..space.continuum import SpaceContinuum
from ..space.steady import SpaceBlade


def unit_load(beam: AnyBlade, load: Load) -> Load:
    """Return a load without dimensions, in units of L, m0 L and √(m0 L⁴/EI0)."""
    require_blade(beam)
    require_load(load)
    return load.in_units(
        beam.length, beam.mass_per_length * beam.length, 1.0 / beam.frequency_scale
    )


def pushes(
    model: Continuum | SpaceContinuum, loads: Sequence[tuple[Load, FloatArray]], angle: FloatArray
) -> Any:
    """Return the force of all loads, with their phases (samples,), as a model takes it, or None."""
    total: Any = None
    for load, phase in loads:
        if load.acts_on is not None:
            force, lift = load.force(phase, angle, model.setting), load.lift(phase)
            push = model.push(force, load.acts_on, lift)
            total = push if total is None else total + push
    return total


@dataclass(frozen=True, eq=False)
class DrivenBlade(Discretized):
    """The blade under one load in steady rotation, in its plane or in space; a system of `methods`.

    Under gravity, which goes around once a turn, the drive's frequency ν is the speed as well. The
    gauge is that of the blade without the load, which has no dimensions.
    """

    steady: SteadyBeam | SpaceBlade
    load: Load
    driven: ClassVar[bool] = True
    odd: ClassVar[None] = None

    @property
    def model(self) -> Continuum | SpaceContinuum:
        """The discretization."""
        return self.steady.model

    @property
    def gauge(self) -> Callable[[FloatArray], FloatArray]:
        """The function that returns the tip's deflection, (samples,)."""
        return self.steady.gauge

    @property
    def gauge_rate(self) -> Callable[[FloatArray, FloatArray], FloatArray]:
        """The function that returns its rate, (samples,)."""
        return self.steady.gauge_rate

    @property
    def gauge_gradient(self) -> Callable[[FloatArray], FloatArray]:
        """The function that returns its derivatives to the coordinates, (samples, n)."""
        return self.steady.gauge_gradient

    def refined(self) -> DrivenBlade:
        """Return the blade on half as many functions again."""
        return replace(self, steady=self.steady.refined())

    @property
    def _turns(self) -> bool:
        return self.load.varied == "speed"

    def speed(self, frequency: float) -> float:
        """Return w̄."""
        return frequency if self._turns else self.steady.rate

    def unloaded(self, frequency: float) -> SteadyBeam | SpaceBlade:
        """Return the blade in steady rotation without the load."""
        return replace(self.steady, rate=frequency) if self._turns else self.steady

    def rest(self, frequency: float) -> FloatArray:
        """Return the steady state without the load, (n,)."""
        return self.unloaded(frequency).equilibrium

    def loaded(self, share: float) -> DrivenBlade:
        """Return the blade under a share of the load."""
        return replace(self, load=self.load.times(share))

    def by(self, phase: FloatArray, nu: float) -> Driven:
        """Return what drives it at the phases."""
        # Gravity goes by the angle, which is its phase; what goes by the phase alone is told none.
        angle = phase if self._turns else np.full_like(phase, np.nan)
        push = pushes(self.model, [(self.load, phase)], angle)
        rate = self.speed(nu) + self.load.rate(phase)
        return Driven(rate, self.load.acceleration(phase, nu), push)

    def _at(
        self, q: FloatArray, q_dot: FloatArray, q_ddot: FloatArray, *drive: Any
    ) -> tuple[FloatArray, FloatArray, FloatArray, Driven]:
        return q, q_dot, q_ddot, self.by(*drive)

    def residual(self, *state: Any) -> FloatArray:
        """Return the virtual work (samples, n) of all forces in states q, q̇, q̈ at phases and ν."""
        return self.model.residual(*self._at(*state))

    def tangent(self, *state: Any) -> Tangent:
        """Return the residual of the same states and its derivatives to q, q̇ and q̈."""
        return self.model.tangent(*self._at(*state))

    def section_loads(self, x: FloatArray, *state: Any) -> tuple[FloatArray, FloatArray]:
        """Return force and moment at `x` in the same states, as the model does."""
        return self.model.section_loads(x, *self._at(*state))
