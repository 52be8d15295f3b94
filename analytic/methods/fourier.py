"""Fourier series of periodic orbits: half of one where time reversal allows, full otherwise.

Of an orbit that time reversal maps onto itself, q = Σ s_k sin kφ for the coordinates that reversal
turns around, k ≥ 1, and q = Σ c_k cos kφ for the others, k ≥ 0. Both stand in one array of
coefficients (H + 1, n), whose row 0 is the mean. Damped and driven orbits have a full series, of
coefficients (2H + 1, n): the mean, H cosines, H sines.
"""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from ..arrays import FloatArray


class Waves:
    """sin kφ and cos kφ at phases φ, and their first two derivatives.

    Attributes
    ----------
    odd : ndarray (3, phases, H)
        sin kφ and its derivatives, k = 1 ... H.
    even : ndarray (3, phases, H + 1)
        cos kφ and its derivatives, k = 0 ... H.
    """

    def __init__(self, phase: FloatArray, harmonics: int) -> None:
        k = np.arange(harmonics + 1)
        sin, cos = np.sin(np.multiply.outer(phase, k)), np.cos(np.multiply.outer(phase, k))
        self.odd: FloatArray = np.stack((sin, k * cos, -(k**2) * sin))[..., 1:]
        self.even: FloatArray = np.stack((cos, -k * sin, -(k**2) * cos))

    def sums(
        self, coefficients: FloatArray, odd: NDArray[np.bool_], frequency: float
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return q, dq/dτ, d²q/dτ² (phases, n) of the coefficients (H + 1, n), φ = Ωτ."""
        sines = np.where(odd, coefficients[1:], 0.0)
        q = self.odd @ sines + self.even @ np.where(odd, 0.0, coefficients)
        return q[0], frequency * q[1], frequency**2 * q[2]


class HalfPeriod:
    """Midpoints of half a period, which is all of it, and the projection onto the waves there.

    Attributes
    ----------
    phase : ndarray (count,)
        2H + 2 of them, or more.
    spacing : float
        Between the phases.
    waves : Waves
    onto_odd, onto_even : ndarray (H, count), (H + 1, count)
        From samples to the coefficients of sin kφ and of cos kφ; exact for products of two waves.
    """

    def __init__(self, harmonics: int, count: int) -> None:
        self.spacing = math.pi / count
        self.phase = np.pi * (np.arange(count) + 0.5) / count
        self.waves = Waves(self.phase, harmonics)
        self.onto_odd = 2.0 / count * self.waves.odd[0].T
        self.onto_even = 2.0 / count * self.waves.even[0].T
        self.onto_even[0] *= 0.5

    def project(self, samples: FloatArray, odd: NDArray[np.bool_]) -> FloatArray:
        """Return the coefficients (unknowns,) of coordinates (count, n) given at the phases."""
        return np.concatenate(
            ((self.onto_odd @ samples[:, odd]).ravel(), (self.onto_even @ samples[:, ~odd]).ravel())
        )


@lru_cache(maxsize=64)
def half_period(harmonics: int) -> HalfPeriod:
    """Return the half period for so many harmonics, made once."""
    return HalfPeriod(harmonics, 2 * harmonics + 2)


@lru_cache(maxsize=64)
def fine_half_period(harmonics: int) -> HalfPeriod:
    """Return 4H + 8 midpoints of half a period, which see what H harmonics leave."""
    return HalfPeriod(harmonics, 4 * harmonics + 8)


def packed(coefficients: FloatArray, odd: NDArray[np.bool_]) -> FloatArray:
    """Return the coefficients (H + 1, n) as the unknowns (..,): those of sines, then of cosines."""
    return np.concatenate((coefficients[1:, odd].ravel(), coefficients[:, ~odd].ravel()))


def unpacked(unknowns: FloatArray, odd: NDArray[np.bool_]) -> FloatArray:
    """Return what `packed` packed."""
    rows = (unknowns.size + int(odd.sum())) // odd.size
    coefficients = np.zeros((rows, odd.size))
    cut = (rows - 1) * int(odd.sum())
    coefficients[1:, odd] = unknowns[:cut].reshape(rows - 1, -1)
    coefficients[:, ~odd] = unknowns[cut:].reshape(rows, -1)
    return coefficients


class FullPeriod:
    """Midpoints of a period, and the projection onto 1, cos kφ and sin kφ there.

    Attributes
    ----------
    phase : ndarray (4H + 4,)
    waves : ndarray (3, phases, 2H + 1)
        As `full_waves` has them.
    onto : ndarray (2H + 1, phases)
        From samples to coefficients; exact for products of two waves.
    """

    def __init__(self, harmonics: int) -> None:
        count = 4 * harmonics + 4
        self.phase = 2.0 * np.pi * (np.arange(count) + 0.5) / count
        self.waves = full_waves(self.phase, harmonics)
        self.onto = 2.0 / count * self.waves[0].T
        self.onto[0] *= 0.5


def full_waves(phase: FloatArray, harmonics: int) -> FloatArray:
    """Return 1, cos kφ and sin kφ and their first two derivatives, (3, phases, 2H + 1)."""
    half = Waves(phase, harmonics)
    return np.concatenate((half.even, half.odd), axis=-1)


@lru_cache(maxsize=64)
def full_period(harmonics: int) -> FullPeriod:
    """Return the full period for so many harmonics, made once."""
    return FullPeriod(harmonics)
