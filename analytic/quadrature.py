"""Clamped polynomial bases on the unit interval: integrals of Legendre polynomials.

Integrating P_k twice gives functions with φ(0) = φ'(0) = 0 whose second derivatives are
orthogonal, so that the bending stiffness is diagonal; integrating once gives functions with
ψ(0) = 0 whose slopes are orthogonal, so that the axial stiffness is. Both stay well conditioned
at any degree in use. A blade with masses inside or kinks of its section is cut there into panels,
on each of which its motion is smooth.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.polynomial import legendre

from .arrays import FloatArray

WHOLE = np.array([0.0, 1.0])
"""The ends of the one panel that a smooth blade is."""


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


def transverse_basis(count: int, x: FloatArray, panels: FloatArray = WHOLE) -> BasisValues:
    """Return φ_k, φ_k', φ_k'' at `x` in [0, 1], φ_k'' = √(2k+1) P_k(2x-1), k < `count`.

    On more than one panel there are `count` functions for each, by degree first, whose curvatures
    are such polynomials on it and zero on all others; so a larger basis begins with a smaller one.
    """

    def on_one(t: FloatArray) -> BasisValues:
        curvature = _legendre(count + 2, t)
        slope = _integrated(curvature)
        value = _integrated(slope)
        return BasisValues(*(_normalized(count, part) for part in (value, slope, curvature)))

    return _on_panels(on_one, x, panels, order=2)


def axial_basis(count: int, x: FloatArray, panels: FloatArray = WHOLE) -> BasisValues:
    """Return ψ_k, ψ_k', ψ_k'' at `x` in [0, 1], ψ_k' = √(2k+1) P_k(2x-1), k < `count`.

    On more than one panel the slopes are such polynomials, as in `transverse_basis`.
    """

    def on_one(t: FloatArray) -> BasisValues:
        slope = _legendre(count + 1, t)
        value, curvature = _integrated(slope), _differentiated(slope)
        return BasisValues(*(_normalized(count, part) for part in (value, slope, curvature)))

    return _on_panels(on_one, x, panels, order=1)


def _on_panels(
    on_one: Callable[[FloatArray], BasisValues], x: FloatArray, panels: FloatArray, order: int
) -> BasisValues:
    """Return a basis of which the derivative of that order is orthonormal panel by panel."""
    if panels.size == 2:
        return on_one(x)
    parts = []
    for start, end in pairwise(panels.tolist()):
        h, last = end - start, end == panels[-1]
        t = np.clip((x - start) / h, 0.0, 1.0)
        inside = ((x >= start) & ((x < end) | last))[:, None]
        at, after = on_one(t), on_one(np.ones(1))
        value, slope, curvature = (h ** (order - 0.5 - k) * part for k, part in enumerate(at))
        if order == 2:
            # Beyond its panel a curvature leaves a slope.
            value = value + h**0.5 * after.slope * np.maximum(x - end, 0.0)[:, None]
        else:
            slope = slope * inside
        parts.append((value, slope, curvature * inside))
    # By degree first, so that more degrees come at the end.
    size = (x.size, parts[0][0].shape[1] * len(parts))
    return BasisValues(
        *(np.stack(kind, axis=-1).reshape(size) for kind in zip(*parts, strict=True))
    )


def integrals_from_clamp(count: int, x: FloatArray, panels: FloatArray = WHOLE) -> FloatArray:
    """Return the matrix from values at the Gauss points, `count` a panel, to integrals up to `x`.

    Exact for polynomials of a degree below `count` on each panel.
    """
    points, weights = gauss_points_on(count, panels)
    legendre = axial_basis(count, points, panels).slope
    return np.asarray(axial_basis(count, x, panels).value @ (legendre * weights[:, None]).T)


def gauss_points_on(count: int, panels: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return Gauss-Legendre points and weights, `count` of each on every panel."""
    if panels.size == 2:
        return gauss_points(count)
    x, weights = gauss_points(count)
    width = np.diff(panels)[:, None]
    return (panels[:-1, None] + width * x).ravel(), (width * weights).ravel()


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
