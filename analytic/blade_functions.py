"""The functions by which the reduced models of any straight blade are resolved, and its modes.

Everywhere two measures, dm and EI dx, and the rotary inertia dj, point masses included.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from .arrays import FloatArray
from .lazily import linalg
from .profiles import evaluated
from .settled import FoundT, settled
from .shape_functions import shape_functions
from .unit_blade import UnitBlade


class FirstMode(NamedTuple):
    """The first mode, 1 at the tip, by its coefficients (n,), w̄_n, and the next two w̄_j."""

    coefficients: FloatArray
    w_n: float
    others: tuple[float, float]


class BladeFunctions:
    """Functions φ_k (n) of a blade's deflection, and what its integrals take; no dimensions.

    Measures are dm at the masses, dj at what turns, and EI dx at the points. Slopes are integrated
    from Gauss points inside.
    """

    def __init__(self, blade: UnitBlade, count: int) -> None:
        self.blade = blade
        self.across = across = shape_functions(blade, count)
        points = 2 * (across.a_panel + 4)
        x, dx = blade.quadrature(points)
        self.bent = dx * evaluated(blade.bending, x)  # EI dx, (points,)
        self.at, self.dm = blade.inertia(points)  # (masses,)
        turning_at, dj = blade.turning(points)
        self.dj, inner = dj, blade.grid(points, 4)  # (turning,)
        self.weights = inner.weights  # (inner,)
        # Values inside to integrals from the clamp to the masses: products of two slopes.
        self.to_masses = inner.integral(self.at)

        self.deflection = across.twice(self.at)
        self.slope, self.slope_turning, self.slope_bent = (
            across.once(places) for places in (inner.points, turning_at, x)
        )
        self.curvature = across.strain(x)
        self.tip = across.twice(np.ones(1))[0]
        lever = (blade.hub + self.at) * self.dm
        self.tension = lever @ self.to_masses  # ∫N f dx = w̄² tension @ f
        moved = self.deflection.T @ (self.dm[:, None] * self.deflection)
        self.turning = self.slope_turning.T @ (dj[:, None] * self.slope_turning)
        self.mass = moved + self.turning
        self.bending = self.curvature.T @ (self.bent[:, None] * self.curvature)
        stiffening = self.slope.T @ (self.tension[:, None] * self.slope)
        self.centrifugal = stiffening - blade.setting**2 * moved  # K = bending + w̄² centrifugal
        # ∫(δ + x) φ dm + ∫φ' dj: over c; the Euler force -θ̈ does work on it.
        self.euler = lever @ self.deflection + dj @ self.slope_turning

    def stiffness(self, w_bar: float) -> FloatArray:
        """Return K (n, n) at w̄: bending, tension, and the softening of the plane of rotation."""
        return np.asarray(self.bending + w_bar**2 * self.centrifugal)

    def modes(self, w_bar: float, count: int) -> tuple[FloatArray, FloatArray]:
        """Return the lowest w̄_j (count,) at w̄ and the modes (n, count), of unit mass, tip up."""
        # M is nearly singular and K is not: the reciprocal problem keeps the low modes' digits.
        reciprocal, vectors = linalg.eigh(self.mass, self.stiffness(w_bar))
        frequencies = 1.0 / np.sqrt(reciprocal[: -count - 1 : -1])
        lowest = vectors[:, : -count - 1 : -1]
        return frequencies, lowest * np.sign(self.tip @ lowest) * frequencies

    def first_mode(self, w_bar: float) -> FirstMode:
        """Return the first mode at w̄."""
        frequencies, modes = self.modes(w_bar, 3)
        w_n, second, third = frequencies.tolist()
        return FirstMode(modes[:, 0] / (self.tip @ modes[:, 0]), w_n, (second, third))


_KINKED = 1e-5
"""Change that is left where a section has kinks, with an algebraic tail."""
_FEWEST, _MOST = 16, 120
_A_ROOT = 3.5
"""Rotation bends the blade in a layer √2/w̄ thin: 3.5 √w̄ functions have ten digits of λ_ω."""
_ON_PANEL = 3, 20
"""Least and most functions on each panel, whatever their sum."""


def settled_functions(
    solve: Callable[[int], FoundT],
    blade: UnitBlade,
    w_bar: float,
    tolerance: float,
    of: Callable[[FoundT], tuple[float, ...]],
    name: str,
) -> FoundT:
    """Return what `solve` finds with the first number of functions that settles its numbers."""
    fewest = min(max(_FEWEST, _A_ROOT * math.sqrt(w_bar)), 2 * _MOST / 3)
    panels = blade.panel_count
    sizes = [max(_ON_PANEL[0], math.ceil(fewest / panels))]
    while (more := math.ceil(1.5 * sizes[-1])) <= max(_ON_PANEL[1], _MOST // panels):
        sizes.append(more)
    remedy, counts = "rotate slower, or smooth the section", (panels * size for size in sizes)
    return settled(solve, counts, tolerance, of, name, remedy, left=_KINKED)[1]


@lru_cache(maxsize=16)
def blade_functions(blade: UnitBlade, count: int) -> BladeFunctions:
    """Return at least `count` functions of the blade."""
    return BladeFunctions(blade, count)
