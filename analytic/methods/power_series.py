"""Power series in an amplitude, cut at an order: arrays whose first axis is the order."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..arrays import ComplexArray, FloatArray


def product(f: NDArray[Any], g: NDArray[Any]) -> NDArray[Any]:
    """Return the product of two series, to the order of both."""
    return np.array([sum(f[j] * g[k - j] for j in range(k + 1)) for k in range(len(f))])


def turn(theta: FloatArray) -> ComplexArray:
    """Return exp(iθ) of a series θ that begins with order 1, by its derivative iθ' exp(iθ)."""
    result = np.zeros(theta.shape, dtype=np.complex128)
    result[0] = 1.0
    for k in range(1, len(theta)):
        result[k] = sum(1j * j / k * theta[j] * result[k - j] for j in range(1, k + 1))
    return result
