"""Profiles: how a quantity varies along the blade, as values that hash and compare."""

from __future__ import annotations

import itertools
import math
from typing import Any

import numpy as np

from .arrays import FloatArray
from .input_checks import bare, finite_number

Profile = float | tuple[float, ...] | tuple[tuple[float, float], ...]
"""A number, coefficients of 1, x/L, (x/L)² ..., or stations (x [m], value), linear in between."""


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


def in_units(profile: Profile, length: float, root: float) -> Profile:
    """Return the profile over its value at the root, stations over the length."""
    if not isinstance(profile, tuple):
        return profile / root
    if stations(profile):
        return tuple((x / length, value / root) for x, value in profile)  # type: ignore[misc]
    return tuple(c / root for c in profile)  # type: ignore[operator]


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


def checked_profile(name: str, profile: object, unit: str = "") -> Profile:
    """Return a profile of plain numbers and tuples, so that it hashes."""
    profile = bare(name, profile, unit)
    if not isinstance(profile, tuple | list | np.ndarray):
        return finite_number(name, profile, unit)
    items = list(profile)
    if not items:
        raise ValueError(f"{name} is empty: give a number, coefficients or stations")
    if not isinstance(items[0], tuple | list | np.ndarray):
        return tuple(_entry(f"{name}[{k}]", value, unit) for k, value in enumerate(items))
    pairs: list[tuple[float, float]] = []
    for k, pair in enumerate(items):
        if not isinstance(pair, tuple | list | np.ndarray) or len(pair) != 2:
            raise ValueError(f"{name}[{k}] must be a station (x, value), got {pair!r}")
        pairs.append((_entry(f"{name}[{k}]", pair[0], "m"), _entry(f"{name}[{k}]", pair[1], unit)))
    _require_ascending(name, [x for x, _ in pairs])
    return tuple(pairs)


def _entry(name: str, value: object, unit: str = "") -> float:
    """Return a number out of a list that may have been read from a file."""
    if isinstance(value, str):
        raise TypeError(f"{name} is the text {str(value)!r}: read numbers, as numpy.loadtxt does")
    if isinstance(value, float) and math.isnan(value):
        raise ValueError(f"{name} is NaN: leave the station out if its cell is empty")
    return finite_number(name, value, unit)


def _require_ascending(name: str, at: list[float]) -> None:
    if len(at) < 2:
        raise ValueError(f"{name} has one station, at {at[0]:g} m: give two at least, or a number")
    for before, x in itertools.pairwise(at):
        if x == before:
            raise ValueError(
                f"two stations of {name} are at {x:g} m: keep one, or set them apart where the "
                f"section steps"
            )
        if x < before:
            raise ValueError(
                f"the stations of {name} must ascend, but {x:g} m comes after {before:g} m: "
                f"sort them"
            )
