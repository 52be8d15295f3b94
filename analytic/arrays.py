"""The types of numbers, arrays and profiles, and parts of long arrays."""

from __future__ import annotations

from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]

NumbersT = TypeVar("NumbersT", float, FloatArray)
"""A number, or several; what has this type in and out keeps the shape."""

Profile = float | tuple[float, ...] | tuple[tuple[float, float], ...]
"""A number, coefficients of 1, x/L, (x/L)² ..., or stations (x [m], value), linear in between."""

_AT_ONCE = 100  # samples, in space of some megabytes each


def lone_as_float(values: FloatArray) -> Any:
    """Return one number as a float, several as they are."""
    return values if values.ndim else float(values)


def few_at_once(count: int) -> list[NDArray[np.int_]]:
    """Return the places of so many samples in parts, whose fields fit into memory."""
    return np.array_split(np.arange(count), 1 + count // _AT_ONCE)
