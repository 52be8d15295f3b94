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

from .arrays import FloatArray


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
    curvature = _legendre(count + 2, x)
    slope = _integrated(curvature)
    value = _integrated(slope)
    return BasisValues(*(_normalized(count, part) for part in (value, slope, curvature)))


def axial_basis(count: int, x: FloatArray) -> BasisValues:
    """Return ψ_k, ψ_k', ψ_k'' at `x` in [0, 1], ψ_k' = √(2k+1) P_k(2x-1), k < `count`."""
    slope = _legendre(count + 1, x)
    value, curvature = _integrated(slope), _differentiated(slope)
    return BasisValues(*(_normalized(count, part) for part in (value, slope, curvature)))


def integrals_from_clamp(count: int, x: FloatArray) -> FloatArray:
    """Return the matrix from values at `count` Gauss points to integrals from 0 to each `x`.

    Exact for polynomials of a degree below `count`.
    """
    points, weights = gauss_points(count)
    legendre = axial_basis(count, points).slope
    return np.asarray(axial_basis(count, x).value @ (legendre * weights[:, None]).T)


def _legendre(count: int, x: FloatArray) -> FloatArray:
    """P_k(2x-1), k < `count`, along the last axis."""
    return np.asarray(legendre.legvander(2.0 * x - 1.0, count - 1), dtype=np.float64)


def _normalized(count: int, values: FloatArray) -> FloatArray:
    return np.asarray(values[..., :count] * np.sqrt(2.0 * np.arange(count) + 1.0))


def _integrated(values: FloatArray) -> FloatArray:
    """Return the integrals from the clamp of P_k, or of their integrals, one fewer.

    ∫P_k dx = (P_{k+1} - P_{k-1})/(4k+2), where P_{-1} stands for -P_0; and so again.
    """
    before = np.concatenate((-values[..., :1], values[..., :-2]), axis=-1)
    k = np.arange(values.shape[-1] - 1)
    return np.asarray((values[..., 1:] - before) / (4.0 * k + 2.0))


def _differentiated(values: FloatArray) -> FloatArray:
    """Return the derivatives of P_k to x, P_k' = P_{k-2}' + (4k-2) P_{k-1}."""
    slopes = np.zeros_like(values)
    for k in range(1, values.shape[-1]):
        slopes[..., k] = slopes[..., max(k - 2, 0)] + (4.0 * k - 2.0) * values[..., k - 1]
    return slopes
