"""The exact backbone as a series in the square of the amplitude."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.polynomial import Chebyshev, Polynomial
from numpy.typing import ArrayLike

from ...arrays import FloatArray
from ...beam import AnyBlade
from ...input_checks import finite_array, float_array

_SHARE = 1.0 / 3.0  # of a curve's error, which coefficients left out may have
_BLOCK = 32768  # amplitudes that stay in the cache while powers are summed


@dataclass(frozen=True, kw_only=True)
class BackboneCurve:
    """The exact backbone at one speed as a series; made by `backbone_curve`.

    Attributes
    ----------
    beam : Beam or Blade
    omega : float
        Rotation speed ω [rad/s].
    mode : int
        From 1.
    omega_n : float
        ω_n [rad/s].
    holds_up_to : float
        Largest peak |q|/L.
    error : float
        Of ω_NL/ω_n, and of the first harmonic over the peak: what the tail of the series leaves, or
        orbits that it was not made from show, whichever is the most.
    series, first : Chebyshev
        Series in a² of ω_NL/ω_n and of the first harmonic over the peak.

    Examples
    --------
    >>> from analytic import Beam, backbone_curve
    >>> curve = backbone_curve(Beam.reference(), omega=6.0, up_to=0.4)
    >>> print(f"ω_NL/ω_n = 1 - {curve.lambda_omega:.5f} a² + …, within {curve.holds_up_to:.2f}")
    ω_NL/ω_n = 1 - 0.01967 a² + …, within 0.40
    >>> print((curve.frequency([0.1, 0.2, 0.4])).round(6))
    [3.729665 3.727422 3.717892]
    """

    beam: AnyBlade
    omega: float
    mode: int
    omega_n: float
    holds_up_to: float
    error: float
    series: Chebyshev = field(repr=False)
    first: Chebyshev = field(repr=False)

    @cached_property
    def _powers(self) -> FloatArray:
        return in_powers(_shortened(self.series, _SHARE * self.error))

    @cached_property
    def _first_powers(self) -> FloatArray:
        return in_powers(_shortened(self.first, _SHARE * self.error))

    @property
    def lambda_omega(self) -> float:
        """λ_ω of ω_NL = ω_n (1 - λ_ω a² - κ a⁴ - ...) [-], a the peak."""
        return -float(in_powers(self.series)[1])

    @property
    def kappa(self) -> float:
        """κ of the same [-], the fifth order of the extensible beam."""
        return -float(in_powers(self.series)[2])

    def frequency(self, a: ArrayLike) -> FloatArray:
        """Return ω_NL [rad/s] at the peaks `a`, of their shape.

        Raises
        ------
        ValueError
            If an amplitude is negative, or above `holds_up_to`.
        """
        return in_square(self.omega_n * self._powers, self._within(a))

    def first_harmonic(self, a: ArrayLike) -> FloatArray:
        """Return the first harmonic of q/L at the peaks `a`, of their shape; refuses as above."""
        amplitude = self._within(a)
        return amplitude * in_square(self._first_powers, amplitude)

    def _within(self, a: ArrayLike) -> FloatArray:
        amplitude = float_array("amplitude", a)
        low, high = _extent(amplitude)
        if not (low >= 0.0 and high <= self.holds_up_to * (1.0 + 1e-12)):
            finite_array("amplitude", amplitude)
            raise ValueError(
                f"the curve at omega = {self.omega:g} rad/s holds for amplitudes from 0 up to "
                f"{self.holds_up_to:.6g}, got {low if low < 0.0 else high:g}: they are the peak of "
                f"|q|/L; beyond, take periodic_orbits or backbone(...).branch"
            )
        return amplitude

    def __str__(self) -> str:
        return (
            f"Exact backbone of mode {self.mode} at {self.omega:g} rad/s up to a = "
            f"{self.holds_up_to:.4g}: ω_n = {self.omega_n:.8f} rad/s, λ_ω = "
            f"{self.lambda_omega:.6f}, κ = {self.kappa:.5f}, error {self.error:.0e}"
        )


def _extent(a: FloatArray) -> tuple[float, float]:
    """Return the least and the greatest of the numbers and 0, not a number where one is not."""
    flat = np.ravel(a)
    blocks = [flat[start : start + _BLOCK] for start in range(0, flat.size, _BLOCK)]
    return (
        float(np.min([block.min() for block in blocks], initial=0.0)),
        float(np.max([block.max() for block in blocks], initial=0.0)),
    )


def _shortened(series: Chebyshev, error: float) -> Chebyshev:
    """Return the series without the last coefficients, as many as sum up to less than `error`."""
    left_out = np.cumsum(np.abs(series.coef[::-1]))
    return series.cutdeg(series.degree() - int(np.sum(left_out < error)))


def in_powers(series: Chebyshev) -> FloatArray:
    """Return the coefficients of the powers of a²."""
    return np.asarray(series.convert(kind=Polynomial, domain=[-1.0, 1.0], window=[-1.0, 1.0]).coef)


def in_square(coefficients: FloatArray, a: FloatArray) -> FloatArray:
    """Return Σ c_k a^2k, of the shape of `a`: by Horner's rule, in blocks that fit the cache."""
    flat, powers = np.ravel(a), [*coefficients.tolist(), 0.0][: max(2, len(coefficients))]
    result, squares = np.empty_like(flat), np.empty(min(flat.size, _BLOCK))
    for start in range(0, flat.size, _BLOCK):
        part = flat[start : start + _BLOCK]
        square, value = squares[: part.size], result[start : start + _BLOCK]
        np.multiply(part, part, out=square)
        np.multiply(square, powers[-1], out=value)
        for power in powers[-2:0:-1]:
            value += power
            value *= square
        value += powers[0]
    # A scalar for a scalar, as NumPy's own functions have it.
    return result.reshape(np.shape(a))[()]
