"""Loads on the exact blade: nondimensional, and as the driven system they make of it.

A load is a complex force in the frame of the clamp, per mass (gravity), per length, or at the tip.
A ripple of the speed is no force but changes w and ẇ.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from ...arrays import ComplexArray, FloatArray
from ...beam import AnyBlade, require_blade
from ...loads import Load, require_load
from ...methods.system import Tangent
from ..beam.continuum import Continuum
from ..beam.steady import BeamCoordinates
from ..space.continuum import SpaceContinuum


def unit_load(beam: AnyBlade, load: Load) -> Load:
    """Return a load without dimensions, in units of L, m0 L and √(m0 L⁴/EI0).

    Raises
    ------
    TypeError
        If it is none.
    """
    require_blade(beam)
    require_load(load)
    return load.in_units(
        beam.length, beam.mass_per_length * beam.length, 1.0 / beam.frequency_scale
    )


def pushes(
    model: Continuum | SpaceContinuum, loads: Sequence[tuple[Load, FloatArray]], angle: FloatArray
) -> Any:
    """Return the force of all loads as `model.residual` takes it, None if none.

    Parameters
    ----------
    model : Continuum or SpaceContinuum
    loads : sequence
        Without dimensions, and their phases (samples,).
    angle : ndarray (samples,)
        θ [rad].
    """
    total: Any = None
    for load, phase in loads:
        if load.acts_on is not None:
            push = model.push(load.force(phase, angle, model.setting), load.acts_on)
            total = push if total is None else total + push
    return total


@dataclass(frozen=True, eq=False)
class DrivenBeam(BeamCoordinates):
    """The beam under one load in steady rotation; a `methods.System`.

    Under gravity, which goes around once a turn, the drive's frequency ν is the speed as well.

    Attributes
    ----------
    rate : float or None
        w̄; None if it is ν.
    load : Load
        Without dimensions.
    """

    rate: float | None
    load: Load
    driven: ClassVar[bool] = True
    odd: ClassVar[None] = None

    def speed(self, frequency: float) -> float:
        """Return w̄."""
        return frequency if self.rate is None else self.rate

    def rest(self, frequency: float) -> FloatArray:
        """Return the straight beam that the rotation stretches, (n,)."""
        return self.model.steady_state(self.speed(frequency))

    def _drive(
        self, phase: FloatArray, frequency: float
    ) -> tuple[FloatArray, FloatArray, ComplexArray | None]:
        """Return w, ẇ and the push at the phases."""
        load = self.load
        rate = self.speed(frequency) + load.rate(phase)
        # Gravity goes by the angle, which is its phase; what goes by the phase alone is told none.
        angle = phase if self.rate is None else np.full_like(phase, np.nan)
        return rate, load.acceleration(phase, frequency), pushes(self.model, [(load, phase)], angle)

    def residual(
        self,
        q: FloatArray,
        q_dot: FloatArray,
        q_ddot: FloatArray,
        phase: FloatArray,
        frequency: float,
    ) -> FloatArray:
        """Return the virtual work of all forces, (samples, n)."""
        return self.model.residual(q, q_dot, q_ddot, *self._drive(phase, frequency))

    def tangent(
        self,
        q: FloatArray,
        q_dot: FloatArray,
        q_ddot: FloatArray,
        phase: FloatArray,
        frequency: float,
    ) -> Tangent:
        """Return the residual and its derivatives to q, q̇ and q̈."""
        return self.model.tangent(q, q_dot, q_ddot, *self._drive(phase, frequency))

    def section_loads(
        self,
        x: FloatArray,
        q: FloatArray,
        q_dot: FloatArray,
        q_ddot: FloatArray,
        phase: FloatArray,
        frequency: float,
    ) -> tuple[FloatArray, FloatArray]:
        """Return force and moment at `x`, as the model has them."""
        return self.model.section_loads(x, q, q_dot, q_ddot, *self._drive(phase, frequency))
