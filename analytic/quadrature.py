"""Gauss points and polynomials on the unit interval and on a cut one, and integrals from the clamp.

On a `Grid` of cells each cell is integrated by Gauss points of its own.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray

from .arrays import FloatArray

_STRETCH = 20  # points: integrals are dense within a stretch, and sums from one to the next


class BasisValues(NamedTuple):
    """Values of a basis and of its first two derivatives at points, each (points, functions)."""

    value: FloatArray
    slope: FloatArray
    curvature: FloatArray


@cache
def gauss_points(count: int) -> tuple[FloatArray, FloatArray]:
    """Return Gauss-Legendre points and weights (count,) on [0, 1], exact to degree 2 count - 1.

    Computed once per count, and read-only because shared.
    """
    points, weights = legendre.leggauss(count)
    points, weights = 0.5 * (points + 1.0), 0.5 * weights
    points.flags.writeable = weights.flags.writeable = False
    return points, weights


def polynomials_on(count: int, x: FloatArray, panels: FloatArray) -> BasisValues:
    """Return polynomials and two derivatives at `x`: each (points, `count` for every panel).

    On each panel they are Legendre's, and zero on all others. They are in the order of their
    degree, so that a larger basis begins with a smaller one.
    """
    parts = []
    for start, end in pairwise(panels.tolist()):
        h, last = end - start, end == panels[-1]
        inside = ((x >= start) & ((x < end) | last))[:, None]
        value = _legendre(count, np.clip((x - start) / h, 0.0, 1.0))
        slope = _differentiated(value)
        kinds = (value, slope, _differentiated(slope))
        parts.append(
            [h ** (-0.5 - k) * _normalized(count, f) * inside for k, f in enumerate(kinds)]
        )
    size = (x.size, count * len(parts))
    return BasisValues(
        *(np.stack(kind, axis=-1).reshape(size) for kind in zip(*parts, strict=True))
    )


def integrals_from_clamp(count: int, x: FloatArray) -> FloatArray:
    """Return the matrix from values at `count` Gauss points to integrals from 0 up to `x`.

    Exact for polynomials of a degree below `count`.
    """
    value = _normalized(count, _integrated(_legendre(count + 1, x)))
    return np.asarray(value @ _onto_slopes(count).T)


@cache
def _onto_slopes(count: int) -> FloatArray:
    """Return the matrix from values at `count` Gauss points to coefficients of ψ'."""
    points, weights = gauss_points(count)
    return np.asarray(_normalized(count, _legendre(count, points)) * weights[:, None])


@dataclass(frozen=True, eq=False)
class Grid:
    """Gauss points on the cells of a cut interval."""

    ends: FloatArray  # (cells + 1,), ascending from 0 to 1
    counts: NDArray[np.intp]  # (cells,), of the Gauss points on each

    @cached_property
    def points(self) -> FloatArray:
        """The Gauss points (points,), ascending."""
        return np.concatenate([a + (b - a) * gauss_points(n)[0] for (a, b), n in self._cells()])

    @cached_property
    def weights(self) -> FloatArray:
        """Their weights (points,)."""
        return np.concatenate([(b - a) * gauss_points(n)[1] for (a, b), n in self._cells()])

    def _cells(self) -> zip[tuple[tuple[float, float], int]]:
        return zip(pairwise(self.ends.tolist()), self.counts.tolist(), strict=True)

    @cached_property
    def _first(self) -> NDArray[np.intp]:
        """The first point of each cell."""
        return np.concatenate(([0], np.cumsum(self.counts)[:-1]))

    def _inside(
        self, x: FloatArray
    ) -> tuple[NDArray[np.intp], list[tuple[NDArray[np.intp], NDArray[np.intp], FloatArray]]]:
        """Return the cell of each place; by number of points the places, points and the matrix."""
        cell = np.clip(np.searchsorted(self.ends, x, side="right") - 1, 0, self.counts.size - 1)
        width, parts = np.diff(self.ends), []
        for count in np.unique(self.counts[cell]).tolist():
            rows = np.flatnonzero(self.counts[cell] == count)
            at = cell[rows]
            part = integrals_from_clamp(count, (x[rows] - self.ends[at]) / width[at])
            points = self._first[at][:, None] + np.arange(count)
            parts.append((rows, points, width[at][:, None] * part))
        return cell, parts

    def integrals(self, values: FloatArray, x: FloatArray) -> FloatArray:
        """Return the integrals from 0 to `x` (places,) of values (points, n): (places, n).

        Exact for polynomials on each cell of a degree below its count.
        """
        cell, parts = self._inside(x)
        on_cells = np.add.reduceat(self.weights[:, None] * values, self._first)
        result = np.concatenate((np.zeros((1, values.shape[1])), np.cumsum(on_cells, axis=0)))[cell]
        for rows, points, part in parts:
            result[rows] += np.einsum("xp,xpn->xn", part, values[points])
        return np.asarray(result)

    def interpolation(self, x: FloatArray) -> FloatArray:
        """Return the matrix (places, points) from values at the points to those at `x`.

        By the polynomial on each cell; the end of a cell belongs to the next one, but the last.
        """
        cell = np.clip(np.searchsorted(self.ends, x, side="right") - 1, 0, self.counts.size - 1)
        result = np.zeros((x.size, self.points.size))
        for row, k in enumerate(cell.tolist()):
            count, first, start = self.counts[k], self._first[k], self.ends[k]
            points, weights = gauss_points(int(count))
            here = np.append(points, (x[row] - start) / (self.ends[k + 1] - start))
            waves = _normalized(int(count), _legendre(int(count), here))
            result[row, first : first + count] = weights * (waves[:-1] @ waves[-1])
        return result

    def integral(self, x: FloatArray) -> FloatArray:
        """Return the matrix (places, points) from values at the points to integrals up to `x`."""
        cell, parts = self._inside(x)
        before = np.arange(self.points.size) < self._first[cell][:, None]
        result = np.where(before, self.weights, 0.0)
        for rows, points, part in parts:
            result[rows[:, None], points] = part
        return result


class Stretch(NamedTuple):
    """Some cells of a grid, and the places in them."""

    own: slice  # points of the grid
    places: slice | NDArray[np.intp]
    onto: FloatArray  # (points, places), transpose of that to integrals from the first cell's start
    weights: FloatArray


class Running:
    """Integrals from 0 up to some places, as sums that run from stretch to stretch of a grid.

    Fields (..., points or places) have the points last.

    Parameters
    ----------
    grid : Grid
    places : ndarray (places,)
    cuts : sequence
        Ends of cells at which a stretch has to end.
    """

    def __init__(self, grid: Grid, places: FloatArray, cuts: Sequence[float] = ()) -> None:
        cells = grid.counts.size
        self.count, self._points = places.size, grid.points.size
        ends = {int(np.argmin(np.abs(grid.ends - cut))) for cut in cuts}
        cell = np.clip(np.searchsorted(grid.ends, places, side="right") - 1, 0, cells - 1)
        self.stretches = list[Stretch]()
        first = begin = 0
        for end in range(1, cells + 1):
            count = int(grid.counts[begin:end].sum())
            if end < cells and count < _STRETCH and end not in ends:
                continue
            part = Grid(grid.ends[begin : end + 1], grid.counts[begin:end])
            rows = np.flatnonzero((cell >= begin) & (cell < end))
            onto = part.integral(places[rows]).T
            ahead = rows.size and rows[-1] + 1 - rows[0] == rows.size
            inside = slice(int(rows[0]), int(rows[-1]) + 1) if ahead else rows
            self.stretches.append(Stretch(slice(first, first + count), inside, onto, part.weights))
            first, begin = first + count, end

    def of(self, field: FloatArray) -> FloatArray:
        """Return the integrals up to each place of a field at the grid's points."""
        result = np.empty((*field.shape[:-1], self.count))
        before: FloatArray | float = 0.0
        for points, places, onto, weights in self.stretches:
            result[..., places] = field[..., points] @ onto + before
            before = before + (field[..., points] @ weights)[..., None]
        return result

    def beyond(self, field: FloatArray) -> FloatArray:
        """Return the sums of a field at the places beyond each point, times its weight.

        By the transpose of `of`, so that work is the same from both sides.
        """
        result = np.empty((*field.shape[:-1], self._points))
        after: FloatArray | float = 0.0
        for points, places, onto, weights in reversed(self.stretches):
            values = field[..., places]
            result[..., points] = values @ onto.T + after * weights
            after = after + values.sum(axis=-1, keepdims=True)
        return result


def _legendre(count: int, x: FloatArray) -> FloatArray:
    """P_k(2x-1), k < `count`, along the last axis."""
    return np.asarray(legendre.legvander(2.0 * x - 1.0, count - 1), dtype=np.float64)


def _normalized(count: int, values: FloatArray) -> FloatArray:
    return np.asarray(values[..., :count] * np.sqrt(2.0 * np.arange(count) + 1.0))


def _integrated(values: FloatArray) -> FloatArray:
    """∫P_k dx = (P_{k+1} - P_{k-1})/(4k+2) from the clamp, P_{-1} being -P_0."""
    before = np.concatenate((-values[..., :1], values[..., :-2]), axis=-1)
    k = np.arange(values.shape[-1] - 1)
    return np.asarray((values[..., 1:] - before) / (4.0 * k + 2.0))


def _differentiated(values: FloatArray) -> FloatArray:
    """P_k' = P_{k-2}' + (4k-2) P_{k-1}; and so again."""
    slopes = np.zeros_like(values)
    for k in range(1, values.shape[-1]):
        slopes[..., k] = slopes[..., max(k - 2, 0)] * (k > 1) + (4.0 * k - 2.0) * values[..., k - 1]
    return slopes
