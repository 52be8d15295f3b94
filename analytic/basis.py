"""Clamped polynomial bases on the unit interval: integrals of Legendre polynomials.

Integrating P_k twice gives functions with φ(0) = φ'(0) = 0 whose second derivatives are
orthogonal, so that the bending stiffness is diagonal; integrating once gives functions with
ψ(0) = 0 whose slopes are orthogonal, so that the axial stiffness is. Both stay well conditioned
at any degree in use.
"""

from __future__ import annotations

from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]


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


def transverse_basis(count: int, x: FloatArray) -> BasisValues:
    """Return φ_k, φ_k', φ_k'' at `x` in [0, 1], φ_k'' = √(2k+1) P_k(2x-1), k < `count`."""
    curvature, slope, value = _integrals(count, x, times=2)
    return BasisValues(value, slope, curvature)


def axial_basis(count: int, x: FloatArray) -> BasisValues:
    """Return ψ_k, ψ_k', ψ_k'' at `x` in [0, 1], ψ_k' = √(2k+1) P_k(2x-1), k < `count`."""
    slope, value = _integrals(count, x, times=1)
    curvature = 2.0 * legendre.legval(2.0 * x - 1.0, legendre.legder(_normalized(count), axis=0))
    return BasisValues(value, slope, _points_first(curvature))


def _points_first(values: ArrayLike) -> FloatArray:
    return np.moveaxis(np.asarray(values, dtype=np.float64), 0, -1)


def _normalized(count: int) -> FloatArray:
    return np.diag(np.sqrt(2.0 * np.arange(count) + 1.0))


def _integrals(count: int, x: FloatArray, times: int) -> list[FloatArray]:
    """Values of √(2k+1) P_k and of its first `times` integrals from the clamp, at `x`."""
    coefficients = _normalized(count)
    values = []
    for _ in range(times + 1):
        values.append(_points_first(legendre.legval(2.0 * x - 1.0, coefficients)))
        # dx is half of the Legendre variable's own differential.
        coefficients = np.asarray(
            legendre.legint(coefficients, lbnd=-1.0, scl=0.5, axis=0), dtype=np.float64
        )
    return values
