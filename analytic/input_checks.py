"""What is refused at the door, and the sentence that says so.

Every public entry of both packages validates through these functions, so that bad input reads
the same everywhere: what, where, by how much, what to try.
"""

from __future__ import annotations

import math
from numbers import Integral, Real

import numpy as np
from numpy.typing import NDArray


class RotbeamWarning(UserWarning):
    """Input or a result that is legal but probably not what was meant."""


def _number(name: str, value: object, unit: str) -> float:
    if isinstance(value, bool) or not isinstance(value, Real):
        raise TypeError(f"{name} must be a number{_in(unit)}, got {value!r}")
    number = float(value)
    if not math.isfinite(number):
        raise ValueError(f"{name} must be finite, got {number}{_unit(unit)}")
    return number


def _unit(unit: str) -> str:
    return f" {unit}" if unit else ""


def _in(unit: str) -> str:
    return f" in {unit}" if unit else ""


def positive(name: str, value: object, unit: str = "") -> float:
    """Return `value` as a float, refusing what is not a finite number above zero."""
    number = _number(name, value, unit)
    if number <= 0.0:
        raise ValueError(f"{name} must be positive, got {number}{_unit(unit)}")
    return number


def not_negative(name: str, value: object, unit: str = "", remedy: str = "") -> float:
    """Return `value` as a float, refusing what is not a finite number of zero or more."""
    number = _number(name, value, unit)
    if number < 0.0:
        hint = f"; {remedy}" if remedy else ""
        raise ValueError(f"{name} must not be negative, got {number}{_unit(unit)}{hint}")
    return number


def whole_number(name: str, value: object, least: int = 1) -> int:
    """Return `value` as an int, refusing what is not a whole number of at least `least`."""
    if isinstance(value, bool) or not isinstance(value, Integral):
        raise TypeError(f"{name} must be a whole number, got {value!r}")
    number = int(value)
    if number < least:
        raise ValueError(f"{name} must be at least {least}, got {number}")
    return number


def rotation_speed(omega: object, name: str = "omega") -> float:
    """Return the rotation speed [rad/s] as a float; by mirror symmetry it is never negative."""
    return not_negative(
        name,
        omega,
        "rad/s",
        "a beam that turns the other way is the mirror image, so change the sign of q",
    )


def finite_values(name: str, values: object, unit: str = "") -> NDArray[np.float64]:
    """Return a number or a sequence of numbers as a 1-d array, refusing what is not finite."""
    try:
        array = np.atleast_1d(np.asarray(values))
        if array.dtype.kind not in "fiu":
            raise TypeError
        array = array.astype(np.float64)
    except (TypeError, ValueError):
        raise TypeError(f"{name} must be numbers{_in(unit)}, got {values!r}") from None
    if array.ndim != 1 or array.size == 0:
        raise ValueError(f"{name} must be a sequence of numbers, got shape {array.shape}")
    if not np.all(np.isfinite(array)):
        first = array[~np.isfinite(array)][0]
        raise ValueError(f"{name} must be finite, got {first}{_unit(unit)}")
    return array
