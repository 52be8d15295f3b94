"""The types of numbers, arrays and profiles, parts of long arrays, and values of profiles.

A profile is how a quantity varies along the blade, as a value that hashes and compares.
"""

from __future__ import annotations

from collections.abc import Sequence
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


def evaluated(profile: Profile, x: FloatArray) -> FloatArray:
    """Return the values of a profile at `x`, in the units of its stations or, else, over L."""
    if not isinstance(profile, tuple):
        return np.full_like(x, profile)
    at = stations(profile)
    if at:
        return np.interp(x, at, [pair[1] for pair in profile])  # type: ignore[index]
    return np.asarray(np.polynomial.polynomial.polyval(x, np.array(profile, dtype=float)))


def slope_of(profile: Profile, x: FloatArray) -> FloatArray:
    """Return the derivatives of a profile at `x`; at a station, of the stretch after it."""
    at = stations(profile)
    if at:
        values = [pair[1] for pair in profile]  # type: ignore[index,union-attr]
        stretch = np.clip(np.searchsorted(at, x, side="right") - 1, 0, len(at) - 2)
        return np.asarray((np.diff(values) / np.diff(at))[stretch])
    if not isinstance(profile, tuple):
        return np.zeros_like(x)
    polynomial = np.polynomial.Polynomial(np.array(profile, dtype=float))
    return np.asarray(polynomial.deriv()(x))


def stations(profile: Profile) -> list[float]:
    """Return where the stations are; none of a number or a polynomial."""
    if isinstance(profile, tuple) and profile and isinstance(profile[0], tuple):
        return [pair[0] for pair in profile]
    return []


def profile_at(x: Sequence[float], values: FloatArray) -> Profile:
    """Return the profile of values at stations."""
    return tuple(zip(x, values.tolist(), strict=True))


def in_units(profile: Profile, length: float, root: float) -> Profile:
    """Return the profile over its value at the root, stations over the length.

    A number, where it is the same all along: a blade is uniform however it is written.
    """
    if not isinstance(profile, tuple):
        return profile / root
    if at := stations(profile):
        values = [value / root for _, value in profile]  # type: ignore[misc]
        same = min(values) == max(values)
        return values[0] if same else tuple(zip((x / length for x in at), values, strict=True))
    first, *others = (c / root for c in profile)  # type: ignore[operator]
    return (first, *others) if any(others) else first


def times(profile: Profile, factor: Any) -> Profile:
    """Return a profile times a polynomial in x/L; stations are refused."""
    if stations(profile):
        raise ValueError(
            "with_taper multiplies numbers and polynomials; a section given by stations has its "
            "taper in them: scale their values"
        )
    if profile == 0.0:
        return 0.0
    polynomial: Any = profile if isinstance(profile, tuple) else (profile,)
    return tuple(np.polynomial.polynomial.polymul(polynomial, factor).tolist())
