"""The types of arrays and of profiles, and parts of long arrays."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]

Profile = float | tuple[float, ...] | tuple[tuple[float, float], ...]
"""A number, coefficients of 1, x/L, (x/L)² ..., or stations (x [m], value), linear in between."""

_AT_ONCE = 100  # samples, in space of some megabytes each


def few_at_once(count: int) -> list[NDArray[np.int_]]:
    """Return the places of so many samples in parts, whose fields fit into memory."""
    return np.array_split(np.arange(count), 1 + count // _AT_ONCE)
