"""Labeled data: a Dataset of numbers with dims and labels, labels that several share, rounding."""

from __future__ import annotations

import math
from collections.abc import Mapping

from numpy.typing import ArrayLike

from .lazily import xr

OMEGA = "angular velocity ω [rad/s]"
GROWTH = "growth rate out of the plane [1/s]"
ORBIT = "amplitude a = |q|/L of the planar orbit"
AMPLITUDE = "peak amplitude a = |q|/L"


def labeled(label: str) -> dict[str, str]:
    """Return a label, "angular velocity ω [rad/s]", as the attributes of a variable.

    Without a unit it is 1.
    """
    name, _, unit = label.partition(" [")
    attrs = {"units": unit.removesuffix("]") or "1"}
    return {**attrs, "long_name": name} if name else attrs


def dataset(
    variables: Mapping[str, tuple[str | tuple[str, ...], ArrayLike, str]],
    coords: Mapping[str, object],
    attrs: Mapping[str, object] | None = None,
) -> xr.Dataset:
    """Return a Dataset of labeled numbers: of dims, values and label by name.

    Coordinates are values and label by dimension, or values alone; attributes are all else.
    """
    return xr.Dataset(
        {name: (dims, values, labeled(label)) for name, (dims, values, label) in variables.items()},
        {
            name: (name, coordinate[0], labeled(coordinate[1]))
            if isinstance(coordinate, tuple)
            else coordinate
            for name, coordinate in coords.items()
        },
        attrs,
    )


def one_two_five(value: float) -> float:
    """Return the next of 1, 2, 5 times a power of ten that is not above, but for round-off."""
    exponent = math.floor(math.log10(value * (1.0 + 1e-9)))
    first = max(n for n in (1, 2, 5) if n <= value * (1.0 + 1e-9) / 10.0**exponent)
    return float(f"{first}e{exponent}")
