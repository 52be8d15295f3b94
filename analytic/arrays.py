"""The types of arrays, and parts of long ones."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]

_AT_ONCE = 100  # samples, in space of some megabytes each


def few_at_once(count: int) -> list[NDArray[np.int_]]:
    """Return the places of so many samples in parts, whose fields fit into memory."""
    return np.array_split(np.arange(count), 1 + count // _AT_ONCE)
