"""The linear bending modes of any inextensible blade as smooth functions of the speed."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.polynomial import chebyshev

from ..arrays import FloatArray
from ..blade_functions import blade_functions
from ..unit_blade import UnitBlade

_SETTLED = 1e-8
"""Share of the last coefficients of an interpolation that has settled."""
_FEWEST, _MOST = 17, 257
_FUNCTIONS = 20
"""Twice as many as the modes in use, and four √w̄ more for the layer at the clamp."""


class ModesAt(NamedTuple):
    """Modes of unit mass at speeds w̄, each (modes, speeds), nondimensional.

    The natural frequency, the force of the Euler acceleration -θ̈ on the mode over -θ̈, the tip's
    deflection (positive), and the rate at which damping takes the amplitude.
    """

    frequency: FloatArray
    force: FloatArray
    tip: FloatArray
    decay: FloatArray


@dataclass(frozen=True)
class ModesOverSpeed:
    """Chebyshev series of the modes from standstill to the speed w̄ = `top`."""

    top: float
    coefficients: FloatArray = field(repr=False)

    def at(self, w: FloatArray) -> ModesAt:
        """Return the modes at speeds `w`, (speeds,), whose sign does not matter.

        Beyond the top they are those at the top.
        """
        inside = np.minimum(2.0 * np.abs(w) / self.top - 1.0, 1.0)
        values = chebyshev.chebval(inside, self.coefficients)
        return ModesAt(*np.asarray(values))


@lru_cache(maxsize=64)
def modes_over_speed(blade: UnitBlade, top: float, count: int) -> ModesOverSpeed:
    """Return the first `count` modes for speeds w̄ from 0 to `top`."""
    solve, points = _eigenproblem(blade, top, count), _FEWEST
    while True:
        nodes = np.cos(np.pi * (np.arange(points) + 0.5) / points)
        values = np.array([solve(0.5 * top * (1.0 + x)) for x in nodes])
        flat = values.reshape(points, -1)
        coefficients = chebyshev.chebfit(nodes, flat, points - 1)
        size = np.abs(flat).max(axis=0) + np.finfo(float).tiny
        rest = float((np.abs(coefficients[-2:]).max(axis=0) / size).max())
        if rest < _SETTLED:
            return ModesOverSpeed(top, coefficients.reshape(values.shape))
        if points >= _MOST:
            raise ValueError(
                f"the modes up to w̄ = {top:.4g} do not settle over the speed with {points} "
                f"speeds ({rest:.1e}): take fewer modes, or a lower speed"
            )
        points = 2 * points - 1


def _eigenproblem(blade: UnitBlade, top: float, count: int) -> Callable[[float], FloatArray]:
    """Return what finds the modes at one speed w̄, (quantities, modes) in the order of `ModesAt`."""
    functions = max(_FUNCTIONS, 2 * count + 8) + math.ceil(4.0 * math.sqrt(top))
    of = blade_functions(blade, functions)
    x, dx = blade.quadrature(2 * (of.across.a_panel + 4))
    along = of.across.twice(x)
    viscosity, _, air = blade.damping
    damping = viscosity * of.bending + air * along.T @ (dx[:, None] * along)

    def solve(w: float) -> FloatArray:
        frequencies, modes = of.modes(w, count)
        decay = 0.5 * np.sum(modes * (damping @ modes), axis=0)
        return np.stack([frequencies, blade.setting * of.euler @ modes, of.tip @ modes, decay])

    return solve
