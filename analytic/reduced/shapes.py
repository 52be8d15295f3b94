"""Assumed transverse shapes φ_v of Secs. 3-5, on the unit beam x = η/L, with φ_v(1) = 1.

The first mode of the cantilever at rest, and polynomials: the static deflections of Tables 1-3 in
exact rationals, and the first mode of the rotating, inextensible beam by Frobenius' method, Sec. 5.
This solves v'''' - ½w̄² [(1-x²) v']' - (w̄² + w̄_n²) v = 0, clamped at x = 0 and free at x = 1. The
power series at the clamp follow Wright, Smith, Thresher and Wang (1982).
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from numpy.polynomial import polynomial
from numpy.typing import ArrayLike

from ..arrays import FloatArray
from ..beam import BETA_1
from ..lazily import optimize
from ..quadrature import gauss_points

MAX_W_BAR = 30.0
"""Both series grow like exp(w̄/√2): up to here w̄_n keeps 3e-7, at 40 only 3e-4."""
_MAX_DEGREE = 150
"""At w̄ = 30 the series has converged at degree 100."""


class Shape(ABC):
    """A transverse shape; methods take x = η/L, of any shape of array, and keep it."""

    @abstractmethod
    def _derivative(self, x: FloatArray, order: int) -> FloatArray:
        """Return φ_v, or its first or second derivative."""

    def deflection(self, x: ArrayLike) -> FloatArray:
        """Return φ_v [-]."""
        return self._derivative(np.asarray(x, dtype=np.float64), 0)

    def slope(self, x: ArrayLike) -> FloatArray:
        """Return φ_v' [-]."""
        return self._derivative(np.asarray(x, dtype=np.float64), 1)

    def curvature(self, x: ArrayLike) -> FloatArray:
        """Return φ_v'' [-]."""
        return self._derivative(np.asarray(x, dtype=np.float64), 2)

    def foreshortening(self, x: ArrayLike) -> FloatArray:
        """Return φ_u = -½∫₀ˣ φ_v'² dξ, Eq. 28 [-], by Gauss quadrature of each interval."""
        x = np.asarray(x, dtype=np.float64)
        points, weights = gauss_points(48)
        return -0.5 * x * (self.slope(x[..., np.newaxis] * points) ** 2 @ weights)


@dataclass(frozen=True)
class CantileverMode(Shape):
    """First bending mode of the cantilever at rest, of frequency β² √(EI/mL³)."""

    def _derivative(self, x: FloatArray, order: int) -> FloatArray:
        """Even ones combine cosh ∓ cos with sinh ∓ sin; the odd one is the slope."""
        z, sign = BETA_1 * x, order - 1.0
        sigma = (np.cosh(BETA_1) + np.cos(BETA_1)) / (np.sinh(BETA_1) + np.sin(BETA_1))
        if order == 1:
            mode = np.sinh(z) + np.sin(z) - sigma * (np.cosh(z) - np.cos(z))
        else:
            mode = np.cosh(z) + sign * np.cos(z) - sigma * (np.sinh(z) + sign * np.sin(z))
        # The mode's tip value is exactly 2.
        return np.asarray(0.5 * BETA_1**order * mode)


@dataclass(frozen=True)
class PolynomialShape(Shape):
    """A polynomial shape; `coefficients` of 1, x, x², ..., rational or floating point."""

    coefficients: tuple[Fraction | float, ...]

    @property
    def degree(self) -> int:
        """Degree of the polynomial."""
        return len(self.coefficients) - 1

    def _derivative(self, x: FloatArray, order: int) -> FloatArray:
        c = polynomial.polyder(np.array(self.coefficients, dtype=np.float64), order)
        return np.asarray(polynomial.polyval(x, c))


def static_deflection(degree: int) -> PolynomialShape:
    """Return the polynomial of Table 1, 2 or 3 as the static deflection the paper says it is.

    Degree 3 deflects under a transverse tip force, 4 under a uniform load, 5 under a load that
    grows linearly from zero at the clamp. φ'''' = load is solved with φ(0) = φ'(0) = 0 and
    φ''(1) = 0, and with φ'''(1) = 0 unless the load is the tip force.
    """
    if degree not in {3, 4, 5}:
        raise ValueError(f"static deflections have degree 3, 4 or 5, got {degree}")
    if degree == 3:
        shear = [Fraction(-1)]
    else:
        shear = _integral([Fraction(0)] * (degree - 4) + [Fraction(1)], zero_at=1)
    moment = _integral(shear, zero_at=1)
    deflection = _integral(_integral(moment, zero_at=0), zero_at=0)
    tip = sum(deflection)
    return PolynomialShape(tuple(c / tip for c in deflection))


def _integral(c: list[Fraction], *, zero_at: int) -> list[Fraction]:
    """Antiderivative of a polynomial that vanishes at 0 or at 1."""
    rising = [a / (k + 1) for k, a in enumerate(c)]
    return [-sum(rising, Fraction(0)) if zero_at else Fraction(0), *rising]


@dataclass(frozen=True)
class RotatingMode(PolynomialShape):
    """First mode at the normalized rotation speed `w_bar`; `w_n` is w̄_n of Eq. 82 [-].

    `.degree` is the degree at which the series has converged.
    """

    w_bar: float
    w_n: float


def frobenius_series(r: int, w_bar: float, w_n: float, degree: int) -> FloatArray:
    """Return the coefficients a_{r,k}, k = 0 .. `degree`, of v_r, Eqs. 80 and 81.

    Corrected: Eq. 80 starts from k = 0, and Eq. 81's second numerator reads
    w̄²(k-3)(k-4) - 2(w̄² + w̄_n²); as printed the series gives 5.140 rad/s at 2 rad/s.
    """
    a = [0.0] * (degree + 1)
    a[r] = 1.0
    s, e = 0.5 * w_bar**2, w_bar**2 + w_n**2
    for k in range(r + 2, degree + 1):
        # The terms are a_{k-2} s/(k(k-1)) and a_{k-4}; the latter is zero for k < r + 4.
        a[k] = s * a[k - 2] / (k * (k - 1))
        if k >= r + 4:
            a[k] -= (s * (k - 3) * (k - 4) - e) * a[k - 4] / (k * (k - 1) * (k - 2) * (k - 3))
    return np.array(a)


def frequency_equation(w_bar: float, w_n: float, degree: int) -> float:
    """Return the determinant of Eq. 86: bending moment and shear force of v₂, v₃ at the tip."""
    (moment_2, shear_2), (moment_3, shear_3) = (
        _tip(frobenius_series(r, w_bar, w_n, degree)) for r in (2, 3)
    )
    return moment_2 * shear_3 - moment_3 * shear_2


def rotating_frequency(w_bar: float, degree: int) -> float:
    """Return w̄_n [-], the root of Eq. 86 with polynomials of the given `degree`.

    The root is bracketed. Southwell's theorem bounds w̄_n² from below by β⁴, for the rotating
    string's first in-plane frequency is zero. The static deflection under a uniform load has the
    Rayleigh quotient 162/13 + (9/52) w̄² above it.
    """
    return float(
        optimize.brentq(
            lambda w: frequency_equation(w_bar, w, degree),
            0.999 * BETA_1**2,
            _upper(w_bar),
            xtol=1e-14,
        )
    )


def rotating_mode(w_bar: float) -> RotatingMode:
    """Return the first rotating mode, Eq. 87, at the degree at which the series has converged.

    The paper stops at degree 36, which at 8 rad/s is 2.1e-4 rad/s off. Here terms are added until
    the last ones no longer change the tip's shear force, the slowest quantity to converge.
    """
    degree = converged_degree(w_bar)
    w_n = rotating_frequency(w_bar, degree)
    v_2, v_3 = (frobenius_series(r, w_bar, w_n, degree) for r in (2, 3))
    (moment_2, _), (moment_3, _) = _tip(v_2), _tip(v_3)
    c = v_3 - moment_3 / moment_2 * v_2
    return RotatingMode(tuple((c / c.sum()).tolist()), w_bar=w_bar, w_n=w_n)


def converged_degree(w_bar: float) -> int:
    """Return the degree beyond which the terms of v₂ and v₃ at the tip are round-off."""
    if w_bar > MAX_W_BAR:
        raise ValueError(
            f"the power series of the rotating mode keeps its digits up to w_bar = ω/√(EI/mL³) = "
            f"{MAX_W_BAR:g}, got {w_bar:.4g}: lower omega, or take FrM"
        )
    k = np.arange(_MAX_DEGREE + 1.0)
    # Third derivatives converge last, and at the upper bound for w̄_n the terms are the largest.
    terms = sum(
        np.abs(k * (k - 1) * (k - 2) * frobenius_series(r, w_bar, _upper(w_bar), _MAX_DEGREE))
        for r in (2, 3)
    )
    return int(np.flatnonzero(terms > 1e-17 * np.sum(terms))[-1])


def _upper(w_bar: float) -> float:
    """Rayleigh quotient of the static deflection under a uniform load, above w̄_n."""
    return math.sqrt(162 / 13 + 9 / 52 * w_bar**2)


def _tip(a: FloatArray) -> tuple[float, float]:
    """Second and third derivative at x = 1 of a power series."""
    k = np.arange(float(a.size))
    bending = k * (k - 1.0) * a
    return float(bending.sum()), float(bending @ (k - 2.0))
