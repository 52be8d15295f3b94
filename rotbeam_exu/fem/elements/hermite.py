"""The cubic shape functions of nodes that carry a value and its slope."""

from __future__ import annotations

import numpy as np

from analytic.arrays import FloatArray

HERMITE = tuple(
    np.polynomial.Polynomial(c)
    for c in ([1, 0, -3, 2], [0, 1, -2, 1], [0, 0, 3, -2], [0, 0, -1, 1])
)
"""Of value and slope at the one end and at the other, over ξ from 0 to 1, on unit length."""


def scales(length: float) -> FloatArray:
    """Return what the shape functions of a cell of `length` are times those of a unit one, (4,)."""
    return np.array([1.0, length, 1.0, length])


def shapes(xi: float, length: float, order: int) -> FloatArray:
    """Return the derivatives to x, of `order`, at ξ = x/l, (4,)."""
    unit = np.array([(function.deriv(order) if order else function)(xi) for function in HERMITE])
    return np.asarray(unit * scales(length) / length**order)
