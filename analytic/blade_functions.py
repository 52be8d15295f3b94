"""The functions by which the reduced models of any straight blade are resolved, and its modes.

Everywhere two measures, dm and EI dx, and the rotary inertia dj, point masses included.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from .arrays import FloatArray
from .lazily import linalg
from .profiles import evaluated
from .settled import FoundT, settled
from .shape_functions import ShapeFunctions, shape_functions
from .unit_blade import UnitBlade


class FirstMode(NamedTuple):
    """The first mode, 1 at the tip, by its coefficients (n,), w̄_n, and the next two w̄_j."""

    coefficients: FloatArray
    w_n: float
    others: tuple[float, float]


@dataclass(frozen=True, eq=False, kw_only=True)
class BladeFunctions:
    """Functions φ_k of a blade's deflection, and what its integrals take; no dimensions.

    Attributes
    ----------
    blade : UnitBlade
    across : ShapeFunctions
        The functions themselves.
    at, dm : ndarray (masses,)
        The measure of the mass, and where it is.
    dj : ndarray (turning,)
        The measure of the rotary inertia.
    bent : ndarray (points,)
        The measure EI dx.
    weights : ndarray (inner,)
        Of the Gauss points from which slopes are integrated.
    to_masses : ndarray (masses, inner)
        From values at these points to their integrals from the clamp.
    tension : ndarray (inner,)
        ∫N f dx = w̄² tension @ f.
    deflection : ndarray (masses, n)
    slope, slope_turning, slope_bent : ndarray (inner, n), (turning, n), (points, n)
    curvature : ndarray (points, n)
    tip : ndarray (n,)
    mass, bending, centrifugal, turning : ndarray (n, n)
        M; the parts of K = bending + w̄² centrifugal; and the rotary inertia's part of M.
    euler : ndarray (n,)
        ∫(δ + x) φ dm + ∫φ' dj: over c; the Euler force -θ̈ does work on it.
    """

    blade: UnitBlade
    across: ShapeFunctions
    at: FloatArray
    dm: FloatArray
    dj: FloatArray
    bent: FloatArray
    weights: FloatArray
    to_masses: FloatArray
    tension: FloatArray
    deflection: FloatArray
    slope: FloatArray
    slope_turning: FloatArray
    slope_bent: FloatArray
    curvature: FloatArray
    tip: FloatArray
    mass: FloatArray
    bending: FloatArray
    centrifugal: FloatArray
    turning: FloatArray
    euler: FloatArray

    def stiffness(self, w_bar: float) -> FloatArray:
        """Return K (n, n) at w̄: bending, tension, and the softening of the plane of rotation."""
        return np.asarray(self.bending + w_bar**2 * self.centrifugal)

    def first_mode(self, w_bar: float) -> FirstMode:
        """Return the first mode at w̄."""
        # M is nearly singular and K is not: the reciprocal problem keeps the low modes' digits.
        reciprocal, vectors = linalg.eigh(self.mass, self.stiffness(w_bar))
        first = vectors[:, -1] / (self.tip @ vectors[:, -1])
        second, third = (1.0 / np.sqrt(reciprocal[-2:-4:-1])).tolist()
        return FirstMode(first, 1.0 / math.sqrt(reciprocal[-1]), (second, third))


_KINKED = 1e-5
"""Change that is left where a section has kinks, with an algebraic tail."""
_FEWEST, _MOST = 16, 120
_A_ROOT = 3.5
"""Rotation bends the blade in a layer √2/w̄ thin: 3.5 √w̄ functions have ten digits of λ_ω."""
_ON_PANEL = 3, 20
"""Least and most functions on each panel, whatever their sum."""


def basis_sizes(blade: UnitBlade, w_bar: float) -> list[int]:
    """Return the numbers of functions to try at w̄, each half as many again as the last."""
    fewest = min(max(_FEWEST, _A_ROOT * math.sqrt(w_bar)), 2 * _MOST / 3)
    panels = blade.panel_count
    sizes = [max(_ON_PANEL[0], math.ceil(fewest / panels))]
    while (more := math.ceil(1.5 * sizes[-1])) <= max(_ON_PANEL[1], _MOST // panels):
        sizes.append(more)
    return [panels * size for size in sizes]


def settled_functions(
    solve: Callable[[int], FoundT],
    blade: UnitBlade,
    w_bar: float,
    tolerance: float,
    of: Callable[[FoundT], tuple[float, ...]],
    name: str,
) -> FoundT:
    """Return what `solve` finds with the first number of functions that settles its numbers."""
    sizes = basis_sizes(blade, w_bar)
    remedy = "rotate slower, or smooth the section"
    return settled(solve, iter(sizes), tolerance, of, name, remedy, left=_KINKED)[1]


@lru_cache(maxsize=16)
def blade_functions(blade: UnitBlade, count: int) -> BladeFunctions:
    """Return at least `count` functions of the blade."""
    across = shape_functions(blade, count)
    points = 2 * (across.a_panel + 4)
    x, dx = blade.quadrature(points)
    bent = dx * evaluated(blade.bending, x)
    at, dm = blade.inertia(points)
    turning_at, dj = blade.turning(points)
    inner = blade.grid(points, 4)
    # Values at these points to integrals from the clamp to the masses: products of two slopes.
    to_masses = inner.integral(at)

    phi, slope, slope_turning = (
        across.twice(at), across.once(inner.points), across.once(turning_at)
    )  # fmt: skip
    curvature = across.strain(x)
    lever = (blade.hub + at) * dm
    tension = lever @ to_masses
    moved = phi.T @ (dm[:, None] * phi)
    turning = slope_turning.T @ (dj[:, None] * slope_turning)
    return BladeFunctions(
        blade=blade,
        across=across,
        at=at,
        dm=dm,
        dj=dj,
        bent=bent,
        weights=inner.weights,
        to_masses=to_masses,
        tension=tension,
        deflection=phi,
        slope=slope,
        slope_turning=slope_turning,
        slope_bent=across.once(x),
        curvature=curvature,
        tip=across.twice(np.ones(1))[0],
        mass=moved + turning,
        bending=curvature.T @ (bent[:, None] * curvature),
        centrifugal=slope.T @ (tension[:, None] * slope) - blade.setting**2 * moved,
        turning=turning,
        euler=lever @ phi + dj @ slope_turning,
    )
