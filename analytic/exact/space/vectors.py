"""Vector fields with the three components first: cross products, rotations, quaternions."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from ...arrays import ComplexArray, FloatArray
from ...quadrature import Grid

_PICARD, _SETTLED = 40, 2e-15  # iterations at most, and the change after which the next is less
_WOUND = 4.0  # ∫|K|dx of a cell


def cross(a: FloatArray, b: FloatArray) -> FloatArray:
    """Return a × b of fields (3, ...), which broadcast."""
    result = np.empty(np.broadcast_shapes(a.shape, b.shape))
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        np.multiply(a[j], b[k], out=result[i])
        result[i] -= a[k] * b[j]
    return result


def turned(frame: FloatArray, vector: FloatArray) -> FloatArray:
    """Return R y for frames (3, 3, ...) and vectors (3, ...)."""
    result = np.empty((3, *np.broadcast_shapes(frame.shape[2:], vector.shape[1:])))
    for i, row in enumerate(frame):
        np.multiply(row[0], vector[0], out=result[i])
        result[i] += row[1] * vector[1]
        result[i] += row[2] * vector[2]
    return result


def turned_back(frame: FloatArray, vector: FloatArray) -> FloatArray:
    """Return Rᵀ y for frames (3, 3, ...) and vectors (3, ...)."""
    return turned(np.swapaxes(frame, 0, 1), vector)


def about_axis(angle: FloatArray) -> FloatArray:
    """Return the rotations (3, 3, ...) about the first axis by angles (...)."""
    c, s, one, none = np.cos(angle), np.sin(angle), np.ones_like(angle), np.zeros_like(angle)
    return np.stack([np.stack(row) for row in ((one, none, none), (none, c, -s), (none, s, c))])


def product(p: FloatArray, q: FloatArray) -> FloatArray:
    """Return the quaternions p ∘ q, each (4, ...)."""
    real = p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3]
    return np.concatenate((real[None], p[0] * q[1:] + q[0] * p[1:] + cross(p[1:], q[1:])))


def frames(quaternion: FloatArray) -> FloatArray:
    """Return the rotations (3, 3, ...) of quaternions (4, ...) of any size."""
    a, b, c, d = quaternion / np.sqrt(np.sum(quaternion * quaternion, axis=0))
    return np.stack(
        [
            np.stack(row)
            for row in (
                (1.0 - 2.0 * (c * c + d * d), 2.0 * (b * c - a * d), 2.0 * (b * d + a * c)),
                (2.0 * (b * c + a * d), 1.0 - 2.0 * (b * b + d * d), 2.0 * (c * d - a * b)),
                (2.0 * (b * d - a * c), 2.0 * (c * d + a * b), 1.0 - 2.0 * (b * b + c * c)),
            )
        ]
    )


class Frames:
    """Solution of R' = R K̂, R(0) = 1, on the cells of a grid, and at places on it.

    Unit quaternions obey Q' = ½ Q ∘ (0, K): collocation at the Gauss points of each cell, and the
    product of the cells before.

    Parameters
    ----------
    grid : Grid
        On whose points the curvatures are given.
    places : ndarray (places,)
        Further material points at which the frames are wanted.
    kinks : list
        Ends of cells, and rotation vectors (3,) by which the frame jumps there.
    """

    def __init__(
        self, grid: Grid, places: FloatArray, kinks: Sequence[tuple[float, FloatArray]] = ()
    ) -> None:
        self._grid, self._places = grid, places
        self._cell = np.clip(
            np.searchsorted(grid.ends, places, side="right") - 1, 0, grid.counts.size - 1
        )
        # Integrals from the start of each cell, to its own points, to its end, and to the places.
        inside = grid.integral(np.concatenate((grid.points, grid.ends[1:], places)))
        self._kinks = {
            int(np.argmin(np.abs(grid.ends - x))) - 1: _quaternion(vector) for x, vector in kinks
        }
        self._parts = []
        first = 0
        for k, count in enumerate(grid.counts.tolist()):
            own = slice(first, first + count)
            rows = np.concatenate(
                (
                    np.arange(first, first + count),
                    [grid.points.size + k],
                    grid.points.size + grid.counts.size + np.flatnonzero(self._cell == k),
                )
            )
            self._parts.append((own, inside[rows][:, own]))
            first += count

    def of(self, curvature: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return R at the grid's points and at the places, (3, 3, samples, points or places).

        From curvatures (3, samples, points) in the moving frame.
        """
        samples = curvature.shape[1]
        at = np.empty((4, samples, self._grid.points.size))
        extra = np.empty((4, samples, self._places.size))
        before = np.zeros((4, samples, 1))
        before[0] = 1.0
        for k, (own, integral) in enumerate(self._parts):
            local = _from_unit(curvature[:, :, own], integral)
            count = own.stop - own.start
            here = product(before, local)
            at[:, :, own] = here[:, :, :count]
            extra[:, :, self._cell == k] = here[:, :, count + 1 :]
            before = here[:, :, count : count + 1]
            if k in self._kinks:
                before = product(before, self._kinks[k])
        return frames(at), frames(extra)


def _quaternion(vector: FloatArray) -> FloatArray:
    """Return the quaternion (4, 1, 1) of a rotation vector (3,)."""
    half = 0.5 * float(np.linalg.norm(vector))
    # sin(x)/x, of numpy in units of π.
    return np.array([math.cos(half), *(0.5 * np.sinc(half / math.pi) * vector)])[:, None, None]


def _from_unit(curvature: FloatArray, integral: FloatArray) -> FloatArray:
    """Return Q (4, samples, rows) that starts at 1, by collocation on one cell.

    As u + vj with complex u and v. Picard's iteration finds the collocated solution itself: on one
    cell its errors fall as the terms of exp(|K|/2). Beyond a turn or so round-off grows as that.
    """
    k1, k2, k3 = 0.5 * curvature
    turn, bend, onto = 1j * k1, k2 + 1j * k3, integral.T.astype(np.complex128)
    count = len(onto)
    found = np.zeros((2, *k1.shape), dtype=np.complex128)
    found[0] = 1.0

    def rates(of: ComplexArray) -> ComplexArray:
        u, v = of
        return np.stack((u * turn - v * bend.conj(), u * bend - v * turn))

    if np.abs(curvature).max(initial=0.0) * np.abs(onto).sum(axis=0).max() > _WOUND:
        parts = [[turn, -bend.conj()], [bend, -turn]]
        system = np.block([[-one[:, None] * integral[:count] for one in row] for row in parts])
        system += np.eye(2 * count)
        begin = np.repeat([1.0, 0.0], count)[:, None]
        solved = np.linalg.solve(system, np.broadcast_to(begin, (len(k1), 2 * count, 1)))
        found = np.moveaxis(solved.reshape(len(k1), 2, count), 1, 0)
    else:
        for _ in range(_PICARD):
            last, found = found, rates(found) @ onto[:, :count]
            found[0] += 1.0
            if np.abs(found - last).max(initial=0.0) < _SETTLED:
                break
    u, v = rates(found) @ onto
    return np.stack((1.0 + u.real, u.imag, v.real, v.imag))
