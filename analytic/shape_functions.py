"""Shape functions of a blade: its strains under loads that are mass times polynomials; its modes.

Where the section has a kink or a step, the curvature M/EI and the elongation N/EA have one too, and
M'' and N' as the mass has; the acceleration is smoother. So M'' and N' are the mass per length
times polynomials, of a uniform mass M and N are polynomials themselves. A blade then takes as many
functions as its motion needs, however finely stations cut its section. Only point masses cut the
polynomials, for M' and N jump there.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Literal, NamedTuple

import numpy as np

from .arrays import FloatArray, evaluated, slope_of
from .lazily import linalg
from .quadrature import BasisValues, Grid, polynomials_on
from .unit_blade import UnitBlade

_FEWEST = 3  # a panel
_MORE = 14  # points on each cell, for the inverse of the stiffness

Stiffness = Literal["bending", "axial"]


@dataclass(frozen=True, eq=False)
class ShapeFunctions:
    """Strains M/EI or N/EA, orthonormal in that stiffness, and their integrals.

    Made by `shape_functions`. A larger set begins with a smaller one.
    """

    blade: UnitBlade
    a_panel: int  # functions on each panel between point masses
    stiffness: Stiffness  # "bending" for M/EI, "axial" for N/EA

    @property
    def count(self) -> int:
        """Number of functions."""
        return self.a_panel * self.blade.panel_count

    @cached_property
    def _grid(self) -> Grid:
        return self.blade.grid(self.a_panel, _MORE)

    def _profile(self, x: FloatArray) -> FloatArray:
        return evaluated(getattr(self.blade, self.stiffness), x)[:, None]

    def _polynomials(self, x: FloatArray) -> BasisValues:
        return polynomials_on(self.a_panel, x, self.blade.panels)

    def _mass(self, x: FloatArray) -> FloatArray:
        """Return the mass per length at `x`, over its mean on each panel, (places, count)."""
        panels, grid = self.blade.panels, self._grid
        masses = grid.integrals(evaluated(self.blade.mass, grid.points)[:, None], panels)[:, 0]
        mean = np.tile(np.diff(masses) / np.diff(panels), self.a_panel)
        return np.asarray(evaluated(self.blade.mass, x)[:, None] / mean)

    @cached_property
    def _shear(self) -> FloatArray:
        """∫M'' dx from the clamp to the grid's points, (points, count)."""
        x = self._grid.points
        return self._grid.integrals(self._mass(x) * self._polynomials(x).curvature, x)

    @cached_property
    def _slope(self) -> FloatArray:
        """N' at the grid's points, (points, count)."""
        x = self._grid.points
        return self._mass(x) * self._polynomials(x).slope

    def forces(self, x: FloatArray) -> FloatArray:
        """Return M or N at `x`, (places, count), before they are made orthonormal."""
        here = self._polynomials(x)
        if self.blade.mass == 1.0:
            return here.value
        panels = self.blade.panels
        first, slope, _ = (kind.sum(axis=0) for kind in self._polynomials(panels[:-1]))
        inside = np.tile((x[:, None] >= panels[:-1]) & (x[:, None] < panels[1:]), self.a_panel)
        inside[x == 1.0, -1 :: -self.blade.panel_count] = True
        if self.stiffness == "axial":
            return np.asarray(inside * (first + self._grid.integrals(self._slope, x)))
        lever = x[:, None] - np.tile(panels[:-1], self.a_panel)
        return np.asarray(inside * (first + slope * lever + self._grid.integrals(self._shear, x)))

    @cached_property
    def _orthonormal(self) -> FloatArray:
        """The upper triangular matrix that makes the strains orthonormal."""
        x, weights = self._grid.points, self._grid.weights[:, None]
        factor = np.linalg.qr(np.sqrt(weights / self._profile(x)) * self.forces(x), mode="r")
        return np.asarray(np.linalg.inv(factor) * np.sign(np.diag(factor)))

    def strain(self, x: FloatArray) -> FloatArray:
        """Return the strains at `x`, (places, count)."""
        return np.asarray(self.forces(x) / self._profile(x) @ self._orthonormal)

    def elongation_slope(self, x: FloatArray) -> FloatArray:
        """Return the derivatives of N/EA at `x`, (places, count)."""
        S, slopes = self._profile(x), self._mass(x) * self._polynomials(x).slope
        bent = slope_of(self.blade.axial, x)[:, None] / S
        return np.asarray((slopes - bent * self.forces(x)) / S @ self._orthonormal)

    @cached_property
    def _strains(self) -> FloatArray:
        return self.strain(self._grid.points)

    def once(self, x: FloatArray) -> FloatArray:
        """Return their integrals from the clamp to `x`, (places, count)."""
        return self._grid.integrals(self._strains, x)

    @cached_property
    def _onces(self) -> FloatArray:
        return self.once(self._grid.points)

    def twice(self, x: FloatArray) -> FloatArray:
        """Return the integrals of these from the clamp to `x`, (places, count)."""
        return self._grid.integrals(self._onces, x)


@lru_cache(maxsize=64)
def shape_functions(
    blade: UnitBlade, count: int, stiffness: Stiffness = "bending"
) -> ShapeFunctions:
    """Return at least `count` functions, as many on every panel, and three of each at least."""
    a_panel = max(_FEWEST if blade.panel_count > 1 else 1, math.ceil(count / blade.panel_count))
    return ShapeFunctions(blade, a_panel, stiffness)


class FirstMode(NamedTuple):
    """The first mode, 1 at the tip, by its coefficients (n,), w̄_n, and the next two w̄_j."""

    coefficients: FloatArray
    w_n: float
    others: tuple[float, float]


class BladeFunctions:
    """Functions φ_k (n) of a blade's deflection, and what integrals of the reduced models take.

    Without dimensions. Measures are dm at the masses, dj at what turns, point masses included, and
    EI dx at the points. Slopes are integrated from Gauss points inside.
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


@lru_cache(maxsize=16)
def blade_functions(blade: UnitBlade, count: int) -> BladeFunctions:
    """Return at least `count` functions of the blade."""
    return BladeFunctions(blade, count)
