"""Assumed transverse shapes φ_v of Secs. 3-5, on the unit beam x = η/L, with φ_v(1) = 1.

The first mode of the cantilever at rest, and polynomials: the static deflections of Tables 1-3 in
exact rationals here, the rotating mode by its power series in `analytic.reduced.rotating_mode`.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from numpy.polynomial import polynomial
from numpy.typing import ArrayLike

from ..arrays import FloatArray
from ..beam import BETA_1
from ..quadrature import gauss_points


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
