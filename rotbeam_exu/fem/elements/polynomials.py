"""Shape functions: cubic ones of nodes that carry a value and its slope, and Lagrange's."""

from __future__ import annotations

import numpy as np

from analytic.arrays import FloatArray

HERMITE = tuple(
    np.polynomial.Polynomial(c)
    for c in ([1, 0, -3, 2], [0, 1, -2, 1], [0, 0, 3, -2], [0, 0, -1, 1])
)
"""Functions of value and slope at one end and the other, over ξ from 0 to 1, on unit length."""

_LAGRANGE = {
    1: tuple(np.polynomial.Polynomial(c) for c in ([1, -1], [0, 1])),
    2: tuple(np.polynomial.Polynomial(c) for c in ([1, -3, 2], [0, 4, -4], [0, -1, 2])),
}


def lagrange(xi: FloatArray, degree: int, order: int = 0) -> FloatArray:
    """Return the derivatives to ξ from 0 to 1, of `order`, of Lagrange's with evenly spaced nodes.

    (points, nodes); degree 2 is Eqs. 3-5.
    """
    functions = (f.deriv(order) if order else f for f in _LAGRANGE[degree])
    return np.stack([function(xi) for function in functions], axis=1)


def scales(length: float) -> FloatArray:
    """Return the factors from a unit cell's shape functions to a cell's of `length`, (4,)."""
    return np.array([1.0, length, 1.0, length])


def shapes(xi: float | FloatArray, length: float, order: int) -> FloatArray:
    """Return the derivatives to x, of `order`, at ξ = x/l, (..., 4)."""
    unit = [(function.deriv(order) if order else function)(xi) for function in HERMITE]
    return np.asarray(np.stack(unit, axis=-1) * scales(length) / length**order)
