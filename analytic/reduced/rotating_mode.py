"""The first bending mode of the rotating, inextensible beam by Frobenius' method, Sec. 5.

It solves v'''' - ½w̄² [(1-x²) v']' - (w̄² + w̄_n²) v = 0 on the unit beam, clamped at x = 0 and
free at x = 1. The power series at the clamp follow Wright, Smith, Thresher and Wang (1982).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray
from ..beam import BETA_1
from ..lazily import optimize
from .shapes import PolynomialShape

MAX_W_BAR = 30.0
"""Both series grow like exp(w̄/√2): up to here w̄_n keeps 3e-7, at 40 only 3e-4."""
_MAX_DEGREE = 150
"""At w̄ = 30 the series has converged at degree 100."""


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


def rotating_mode(w_bar: float, degree: int | None = None) -> RotatingMode:
    """Return the first rotating mode, Eq. 87, at the degree at which the series has converged.

    Another `degree` shows the effect of the paper's.

    The paper stops at degree 36, which at 8 rad/s is 2.1e-4 rad/s off. Here terms are added until
    the last ones no longer change the tip's shear force, the slowest quantity to converge.
    """
    degree = degree or converged_degree(w_bar)
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
