"""A force of the rotation that a code leaves out: the exact beam without it, spun up.

In a frame that turns at the rate w the work of all forces is a parabola of w, but for Euler's
force, which is proportional to ẇ. The Coriolis force is its odd part, the centrifugal force the
even part less that at w = 0. So a beam without one of them is a sum of beams at w, -w and 0, and
one without Euler's force is the beam at ẇ = 0.
"""

from __future__ import annotations

from collections.abc import Iterable
from itertools import pairwise

import numpy as np

from analytic.arrays import FloatArray
from analytic.exact.continuum.planar import Continuum
from analytic.exact.continuum.state import Driven
from analytic.exact.driven.transient import grid_of, integrated
from analytic.methods.system import Tangent

from ..case import Case

_FUNCTIONS = 12, 6
_STEP = 0.08  # in units of 1/√(EI/(mL³))

FORCES: dict[str, tuple[str, dict[tuple[float, float], float]]] = {
    "no Euler force": ("Euler's force is left out: add -θ̈ × r in the turning frame",
        {(1.0, 0.0): 1.0}),
    "no Coriolis force": ("the Coriolis force is left out: add 2θ̇ × v in the turning frame",
        {(1.0, 1.0): 0.5, (-1.0, 1.0): 0.5}),
    "no centrifugal force": ("the centrifugal force is left out: add its tension and θ̇² r",
        {(1.0, 1.0): 0.5, (-1.0, 1.0): -0.5, (0.0, 1.0): 1.0}),
}  # fmt: skip
"""Sentences on a code that leaves out a force, and weights of beams by their w and ẇ over true."""


class Lacking(Continuum):
    """The exact beam in the plane, at several rates of the clamp, summed with weights.

    Parameters
    ----------
    case : Case
    rates : dict
        Weights by w and ẇ over those of the case.
    """

    def __init__(self, case: Case, rates: dict[tuple[float, float], float]) -> None:
        super().__init__(case.blade.slenderness, *_FUNCTIONS, blade=case.blade.unit)
        self.rates = rates

    def tangent(self, q: FloatArray, q_dot: FloatArray, q_ddot: FloatArray, by: Driven) -> Tangent:
        """Return the weighted sum of the beams' tangents, as `Continuum.tangent`."""
        beams = [super(Lacking, self).tangent(q, q_dot, q_ddot, one) for one in self._drives(by)]
        return Tangent(*(self._sum(parts) for parts in zip(*beams, strict=True)))

    def residual(
        self, q: FloatArray, q_dot: FloatArray, q_ddot: FloatArray, by: Driven
    ) -> FloatArray:
        """Return the weighted sum of the beams' residuals, as `Continuum.residual`."""
        beams = [super(Lacking, self).residual(q, q_dot, q_ddot, one) for one in self._drives(by)]
        return self._sum(beams)

    def _drives(self, by: Driven) -> list[Driven]:
        return [
            by._replace(rate=share * by.rate, rate_dot=speeding * by.rate_dot)
            for share, speeding in self.rates
        ]

    def _sum(self, parts: Iterable[FloatArray]) -> FloatArray:
        weighted = zip(self.rates.values(), parts, strict=True)
        return np.asarray(np.sum([weight * part for weight, part in weighted], axis=0))


def without(force: str, case: Case, time: FloatArray) -> FloatArray:
    """Return q [m] of a spin-up at times [s] without a force, a key of FORCES.

    RuntimeError where Newton's method fails.
    """
    blade, model = case.blade, Lacking(case, FORCES[force][1])
    end, ramp = float(time[-1]), min(case.ramp_time, float(time[-1]))
    step = _STEP / blade.frequency_scale
    corners = [0.0, ramp] + [end] * (end > ramp)
    counts = [int(np.ceil((b - a) / step)) for a, b in pairwise(corners)]
    motion = integrated(
        blade, case.rotation, case.loads, model, grid_of(corners, counts), time, np.empty(0),
        np.zeros(model.size),
    )  # fmt: skip
    if motion is None:
        raise RuntimeError(f"{force}: the motion is not reached")
    return np.asarray(blade.length * motion.q)
