"""Loads on the exact blade: nondimensional, and as the driven system they make of it.

A load is a complex force, in the frame of the clamp, times what it acts on: all that has mass
(gravity), the length, or the tip. A ripple of the speed is no force but changes w and ẇ.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..arrays import ComplexArray, FloatArray
from ..beam import AnyBlade, require_blade
from ..loads import DistributedForce, Gravity, Load, SpeedRipple, TipForce
from ..methods.system import Tangent
from .continuum import Continuum
from .steady import BeamCoordinates


class UnitLoads(NamedTuple):
    """Sizes of the loads, nondimensional.

    Attributes
    ----------
    gravity : float
        γ = g m0 L³/EI0.
    ripple : float
        ε √(m0 L⁴/EI0).
    tip : float
        F L²/EI0.
    length : float
        p L³/EI0.
    """

    gravity: float = 0.0
    ripple: float = 0.0
    tip: float = 0.0
    length: float = 0.0


def unit_loads(beam: AnyBlade, load: Load) -> UnitLoads:
    """Return a load without dimensions.

    Raises
    ------
    TypeError
        If it is none.
    """
    require_blade(beam)
    L, EI = beam.length, beam.bending_stiffness
    if isinstance(load, Gravity):
        return UnitLoads(gravity=load.gravity * beam.mass_per_length * L**3 / EI)
    if isinstance(load, SpeedRipple):
        return UnitLoads(ripple=load.amplitude / beam.frequency_scale)
    if isinstance(load, TipForce):
        return UnitLoads(tip=load.amplitude * L**2 / EI)
    if isinstance(load, DistributedForce):
        return UnitLoads(length=load.amplitude * L**3 / EI)
    raise TypeError(
        f"a load must be a SpeedRipple, TipForce, DistributedForce or Gravity, got {load!r}"
    )


def pushes(
    model: Continuum, loads: Sequence[tuple[UnitLoads, FloatArray]], angle: FloatArray
) -> ComplexArray | None:
    """Return the force of all loads beyond each Gauss point, (samples, points), None if none.

    Parameters
    ----------
    model : Continuum
    loads : sequence
        Sizes, and the phases (samples,) of those that are harmonic.
    angle : ndarray (samples,)
        θ [rad].
    """
    total: ComplexArray | None = None
    for sizes, phase in loads:
        across = 1j * np.cos(phase)
        falling = -(np.sin(angle) + 1j * model.blade.setting * np.cos(angle))
        for force, onto in (
            (sizes.gravity * falling, "mass"),
            (sizes.length * across, "length"),
            (sizes.tip * across, "tip"),
        ):
            if force.any():
                push = np.multiply.outer(force, model.outboard[onto])
                total = push if total is None else total + push
    return total


@dataclass(frozen=True, eq=False)
class DrivenBeam(BeamCoordinates):
    """The beam under one load in steady rotation; a `methods.DrivenSystem`.

    The parameter is the drive's frequency ν. Under gravity, which goes around once a turn, it is
    the speed as well.

    Attributes
    ----------
    rate : float or None
        w̄; None where it is the parameter.
    loads : UnitLoads
    """

    rate: float | None
    loads: UnitLoads

    def frequency(self, parameter: float) -> float:
        """Return ν itself."""
        return parameter

    def speed(self, parameter: float) -> float:
        """Return w̄."""
        return parameter if self.rate is None else self.rate

    def rest(self, parameter: float) -> FloatArray:
        """Return the straight beam that the rotation stretches, (n,)."""
        return self.model.steady_state(self.speed(parameter))

    def _drive(
        self, phase: FloatArray, parameter: float
    ) -> tuple[FloatArray, FloatArray, ComplexArray | None]:
        """Return w, ẇ and the push at the phases."""
        ripple, w = self.loads.ripple, self.speed(parameter)
        push = pushes(self.model, [(self.loads, phase)], phase)
        return w + ripple * np.cos(phase), -ripple * parameter * np.sin(phase), push

    def residual(
        self,
        q: FloatArray,
        q_dot: FloatArray,
        q_ddot: FloatArray,
        phase: FloatArray,
        parameter: float,
    ) -> FloatArray:
        """Return the virtual work of all forces, (samples, n)."""
        return self.model.residual(q, q_dot, q_ddot, *self._drive(phase, parameter))

    def tangent(
        self,
        q: FloatArray,
        q_dot: FloatArray,
        q_ddot: FloatArray,
        phase: FloatArray,
        parameter: float,
    ) -> Tangent:
        """Return the residual and its derivatives to q, q̇ and q̈."""
        return self.model.tangent(q, q_dot, q_ddot, *self._drive(phase, parameter))
