"""A force of the rotation that a code leaves out: the exact beam without it, spun up."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from typing import Any

import numpy as np

from analytic.arrays import ComplexArray, FloatArray
from analytic.exact.continuum.planar import Continuum
from analytic.exact.continuum.state import Driven
from analytic.exact.driven.transient import grid_of, integrated

from ..cases import Case

_FUNCTIONS = 12, 6
_STEP = 0.08  # in units of 1/√(EI/(mL³))

Force = Callable[[Any, FloatArray], tuple[ComplexArray, FloatArray]]
"""From fields and rate to what is left out of the accelerations of the slope r', (samples, points),
and of the clamp at a unit radius, (samples, 1)."""


def _coriolis(at: Any, rate: FloatArray) -> tuple[ComplexArray, FloatArray]:
    velocity = at.stretch_rate + 1j * at.stretch * (at.spin - rate)
    return 2j * rate * at.turn * velocity, 0.0 * rate


def _centrifugal(at: Any, rate: FloatArray) -> tuple[ComplexArray, FloatArray]:
    return -(rate**2) * at.turn * at.stretch, -(rate**2)


FORCES: dict[str, tuple[str, Force]] = {
    "no Coriolis force": ("the Coriolis force is left out: add 2θ̇ × v in the turning frame",
        _coriolis),
    "no centrifugal force": ("the centrifugal force is left out: add its tension and θ̇² r",
        _centrifugal),
}  # fmt: skip


class _Lacking(Continuum):
    """The exact beam without a force of the rotation.

    Newton's method has the whole beam's tangent, and takes an iteration more for it.
    """

    force: Force

    def _fields(self, q: Any, q_dot: Any, q_ddot: Any, by: Driven) -> Any:
        at = super()._fields(q, q_dot, q_ddot, by)
        slope, clamp = self.force(at, self.blade.setting * np.asarray(by.rate)[..., None])
        lacking = slope @ self._green + clamp * self.blade.hub * self.outboard["mass"]
        return at._replace(force=at.force - at.turn.conj() * lacking)


def without(force: str, case: Case, time: FloatArray) -> FloatArray:
    """Return q [m] of a spin-up at times [s] without a force, a key of FORCES.

    RuntimeError where Newton's method fails.
    """
    blade, rotation = case.blade, case.rotation
    model = _Lacking(blade.slenderness, *_FUNCTIONS, blade=blade.unit)
    model.force = FORCES[force][1]
    end, ramp = float(time[-1]), min(case.ramp_time, float(time[-1]))
    step = _STEP / blade.frequency_scale
    corners = [0.0, ramp] + [end] * (end > ramp)
    counts = [int(np.ceil((b - a) / step)) for a, b in pairwise(corners)]
    found = integrated(
        blade, rotation, case.loads, model, grid_of(corners, counts), time, np.empty(0),
        np.zeros(model.size),
    )  # fmt: skip
    if found is None:
        raise RuntimeError(f"{force}: the motion is not reached")
    return np.asarray(blade.length * found.q)
