"""Fourier series of periodic orbits: half of one where time reversal allows, full otherwise.

The coefficients (2H + 1, n) are the mean, H cosines and H sines of each coordinate. Time reversal
leaves sines to the coordinates that it turns around, and the mean and cosines to the others, so
that half of them are zero and half a period is all of it.
"""

from __future__ import annotations

from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import NDArray

from ..arrays import FloatArray

Parts = list[tuple[NDArray[np.intp], slice]]
"""Coordinates, and rows of the coefficients that are theirs: cosines or sines, never both."""


def waves(phase: FloatArray, harmonics: int, order: int = 2) -> FloatArray:
    """Return 1, cos kφ, sin kφ and their first derivatives, (order + 1, phases, 2H + 1)."""
    k = np.arange(harmonics + 1.0)
    turns = np.multiply.outer(phase, k)
    sin, cos = np.sin(turns), np.cos(turns)
    result = np.empty((order + 1, len(phase), 2 * harmonics + 1))
    for derivative in result:
        derivative[:, : harmonics + 1], derivative[:, harmonics + 1 :] = cos, sin[:, 1:]
        sin, cos = k * cos, -k * sin
    return result


class Period:
    """Midpoints of a period or of half of it, and the projection onto the waves there.

    In half a period sines belong to coordinates that reversal turns around, cosines to the others.
    """

    def __init__(self, harmonics: int, half: bool, count: int) -> None:
        self._resolved = count - 1 if half else count // 2 - 1
        self.spacing = (1.0 if half else 2.0) * np.pi / count
        self.phase = np.asarray(self.spacing * (np.arange(count) + 0.5), dtype=np.float64)
        self.waves = waves(self.phase, harmonics)  # (3, count, 2H + 1)
        # From samples to coefficients, (2H + 1, count); exact for products of two waves.
        self.onto = 2.0 / count * self.waves[0].T
        self.onto[0] *= 0.5

    @cached_property
    def products(self) -> FloatArray:
        """Means times cos dφ and sin dφ, (2, 3H + 1, count), d = -H to 2H, of all products.

        Zero for waves that so few phases do not resolve.
        """
        H, count = len(self.onto) // 2, len(self.phase)
        orders = np.arange(-H, 2 * H + 1.0)
        turns = np.multiply.outer(orders, self.phase)
        kept = (np.abs(orders) <= self._resolved)[:, None]
        return np.asarray(np.stack((np.cos(turns), np.sin(turns))) * kept / count)


@lru_cache(maxsize=128)
def period(harmonics: int, half: bool, fine: bool = False, coarse: bool = False) -> Period:
    """Return the phases that so many harmonics take, finer ones for their residual, or few."""
    count = 4 * harmonics + 8 if fine else 2 * harmonics + 2
    if coarse:
        count = harmonics // 2 + 1
    return Period(harmonics, half, count if half else 2 * count)


def parts_of(
    odd: NDArray[np.bool_] | None, size: int, harmonics: int, pinned: int | None = None
) -> Parts:
    """Return the coefficients that are no zeros, by the symmetry `odd` of a system.

    Without a drive or symmetry the first cosine of the coordinate `pinned` is zero too, which
    fixes the phase. Its equation follows from all others, for the energy is conserved.
    """
    if odd is None:
        every = np.arange(size)
        return [
            (every, slice(0, 1)),
            (every if pinned is None else np.delete(every, pinned), slice(1, 2)),
            (every, slice(2, harmonics + 1)),
            (every, slice(harmonics + 1, 2 * harmonics + 1)),
        ]
    return [
        (np.flatnonzero(odd), slice(harmonics + 1, 2 * harmonics + 1)),
        (np.flatnonzero(~odd), slice(0, harmonics + 1)),
    ]


def packed(coefficients: FloatArray, parts: Parts) -> FloatArray:
    """Return the coefficients that are no zeros, (unknowns,)."""
    return np.concatenate([coefficients[rows, at].ravel() for at, rows in parts])


def unpacked(unknowns: FloatArray, parts: Parts, shape: tuple[int, int]) -> FloatArray:
    """Return the coefficients of the `shape` (2H + 1, n) that `packed` packed."""
    coefficients, start = np.zeros(shape), 0
    for at, rows in parts:
        end = start + (rows.stop - rows.start) * at.size
        coefficients[rows, at] = unknowns[start:end].reshape(rows.stop - rows.start, at.size)
        start = end
    return coefficients
