"""Validation of what users give, and the sentence that refuses it.

Every public entry of both packages validates through these functions, so that bad input reads
the same everywhere: what, where, by how much, what to try.
"""

from __future__ import annotations

import itertools
import math
import reprlib
from collections.abc import Iterable
from numbers import Integral, Real
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from .arrays import FloatArray, Profile, stations
from .warning import RotbeamWarning as RotbeamWarning  # noqa: PLC0414  (everyone has it from here)
from .warning import warn

_STEP = 1e-9  # of the span: narrower changes no frequency beyond 1e-8
_BEYOND_THE_ENDS = 1e-12  # of the length: what round-off puts a point of the beam outside it
_FAINTEST = 1e-4  # |q|/L below which round-off hides what is nonlinear: a² times ten digits
_SOUND = 30.0, 2e4  # [m/s], in rubber and in diamond: all solids are between
_ANGLES = ("rad", "deg", "rev", "turn", "rpm", "cycle")


def bare(name: str, value: object, unit: str | None) -> object:
    """Return a quantity of a units library as its number in `unit`, anything else as it is.

    Where the unit is None, as of a table whose columns differ in it, a quantity is refused.
    """
    units = getattr(value, "units", getattr(value, "unit", None))
    if units is None:
        return value
    if unit is None:
        raise ValueError(
            f"{name} has entries of different units, got a quantity in {units}: convert each "
            "column to SI and give the numbers"
        )
    if isinstance(units, str):  # a label, as xarray's arrays carry it, converts nothing
        if units == (unit or "1"):
            return np.asarray(value)[()]
        raise ValueError(f"{name} must be{_in(unit or '1')}, got units {units!r}: convert it first")
    text = str(units)
    if unit == "rad/s" and not any(angle in text for angle in _ANGLES):
        # Libraries take an angle for a plain number, so that 1 Hz would come out as 1 rad/s.
        raise ValueError(f"{name} must be in rad/s, got {text}, which names no angle: convert it")
    try:
        converted = value.to(unit or "dimensionless")  # type: ignore[attr-defined]
        bare: object = getattr(converted, "magnitude", getattr(converted, "value", None))
    except Exception as reason:  # each library raises its own
        raise ValueError(
            f"{name} must be a quantity{_in(unit) or ' without a unit'}, got {text} ({reason}): "
            f"give the number{_in(unit)} itself"
        ) from None
    return bare


def _unit(unit: str | None) -> str:
    return f" {unit}" if unit else ""


def _in(unit: str | None) -> str:
    return f" in {unit}" if unit else ""


def shown(value: object) -> str:
    """Return a value as one would type it, on one line; of a long one, its beginning and end."""
    short = reprlib.Repr()
    short.maxstring = short.maxother = 100
    return " ".join(short.repr(value).split())


def positive(name: str, value: object, unit: str = "") -> float:
    """Return `value` as a float; refuse all but finite numbers above zero."""
    number = finite_number(name, value, unit)
    if number <= 0.0:
        raise ValueError(f"{name} must be positive, got {number}{_unit(unit)}")
    return number


def not_negative(name: str, value: object, unit: str = "", remedy: str = "") -> float:
    """Return `value` as a float; refuse all but finite numbers of zero or more."""
    number = finite_number(name, value, unit)
    if number < 0.0:
        hint = f"; {remedy}" if remedy else ""
        raise ValueError(f"{name} must not be negative, got {number}{_unit(unit)}{hint}")
    return number


def finite_number(name: str, value: object, unit: str = "") -> float:
    """Return `value` as a float; refuse all but finite numbers."""
    value = bare(name, value, unit)
    if not _is_number(value):
        raise TypeError(f"{name} must be a number{_in(unit)}, got {shown(value)}")
    try:
        number = float(value)  # type: ignore[arg-type]
    except OverflowError:  # a whole number of more than 308 digits
        number = math.inf
    if not math.isfinite(number):
        raise ValueError(f"{name} must be finite, got {number}{_unit(unit)}")
    return number


def _is_number(value: object) -> bool:
    """Whether it is a real number; True and NumPy's spans of time count as such in Python alone."""
    return isinstance(value, Real) and not isinstance(value, (bool, np.timedelta64))


def whole_number(name: str, value: object, least: int = 1, most: int | None = None) -> int:
    """Return `value` as an int; refuse all but whole numbers from `least` to `most`."""
    if not (_is_number(value) and isinstance(value, Integral)):
        raise TypeError(f"{name} must be a whole number, got {shown(value)}")
    number = int(value)
    if number < least:
        raise ValueError(f"{name} must be at least {least}, got {number}")
    if most is not None and number > most:
        raise ValueError(f"{name} must be at most {most}, got {number}")
    return number


def flag(name: str, value: object) -> bool:
    """Return `value` as a bool; refuse all but True and False, such as "no" or nan."""
    if not isinstance(value, (bool, np.bool_)):
        raise TypeError(f"{name} must be True or False, got {shown(value)}")
    return bool(value)


def checked_angle(name: str, value: object, most: float = math.pi) -> float:
    """Return an angle [rad]; ask about one beyond `most`, refuse what is none in degrees either."""
    number = finite_number(name, value, "rad")
    if abs(number) > 360.0:
        raise ValueError(
            f"{name} = {number:g} rad is more than a turn, even if it is in degrees: give it in rad"
        )
    if abs(number) > most:
        warn(
            f"{name} = {number:g} rad is beyond {most:.4g} rad: in degrees? {number:g} degrees are "
            f"{math.radians(number):.4g} rad"
        )
    return number


def peak_deflection(name: str, value: object) -> float:
    """Return the largest |q|/L of orbits asked for, refusing what none has or round-off hides."""
    peak = positive(name, value)
    if not _FAINTEST <= peak < 1.0:
        bound = "below 1" if peak >= 1.0 else f"at least {_FAINTEST:g}"
        raise ValueError(f"{name} must be {bound}, got {peak:g}: it is |q|/L of the tip")
    return peak


def warn_if_giga(name: str, stiffness: float, unit: str, inertia: float) -> None:
    """Warn of a stiffness that only as a number of GPa or GN has the speed of sound of a solid.

    That speed is known in SI alone: in other units the warning may be wrong, and says so.
    """
    sound = math.sqrt(stiffness / inertia)
    meant = math.sqrt(1e9) * sound
    if sound < _SOUND[0] <= meant <= _SOUND[1]:
        warn(
            f"{name} = {stiffness:.4g} {unit} makes sound go along the beam at {sound:.3g} m/s, "
            f"slower than in any solid: in G{unit}? {stiffness:.4g} G{unit} are "
            f"{1e9 * stiffness:.4g} {unit} and make it {meant:.4g} m/s; in units other than SI "
            "this may be right"
        )


def rotation_speed(omega: object, name: str = "omega") -> float:
    """Return the rotation speed [rad/s] as a float; by mirror symmetry it is never negative."""
    return not_negative(
        name,
        omega,
        "rad/s",
        "a beam that turns the other way is the mirror image, so change the sign of q",
    )


def finite_array(name: str, values: object, unit: str | None = "") -> FloatArray:
    """Return numbers as an array of their own shape; refuse numbers that are not finite.

    Quantities of a units library are converted to `unit`, also in lists; see `bare` for None.
    """
    try:
        array = np.asarray(_nested(name, values, unit), dtype=np.float64)
    except ValueError as error:
        if "inhomogeneous" not in str(error):
            raise
        raise TypeError(
            f"{name} must be numbers{_in(unit)}, got lists of different lengths"
        ) from None
    finite = np.isfinite(array)
    if not finite.all():
        raise ValueError(f"{name} must be finite, got {array[~finite].flat[0]}{_unit(unit)}")
    return array


def _nested(name: str, values: object, unit: str | None) -> Any:
    """Return numbers or arrays in nested lists; refuse what NumPy would take for numbers."""
    if type(values) is float:  # as in tables of thousands, of which checks take half of the time
        return values
    if isinstance(values, (list, tuple)):
        return [_nested(name, item, unit) for item in values]
    values = bare(name, values, unit)
    if _is_number(values):
        return values
    if not callable(getattr(values, "mask", callable)):  # an array's, not the method of pandas
        remedy = "leave out what is masked, by .compressed()"
        raise TypeError(f"{name} must be numbers{_in(unit)}, got a masked array: {remedy}")
    array = np.asarray(values)
    fractions = array.dtype.kind == "O" and array.ndim and all(map(_is_number, array.flat))
    empty = isinstance(values, np.ndarray) and not array.size
    if isinstance(values, bytearray) or not (array.dtype.kind in "fiu" or fractions or empty):
        raise TypeError(f"{name} must be numbers{_in(unit)}, got {shown(values)}")
    return array


def finite_values(name: str, values: object, unit: str = "") -> FloatArray:
    """Return a number or a sequence as a 1-d array; refuse numbers that are not finite."""
    array = np.atleast_1d(finite_array(name, values, unit))
    if array.ndim != 1 or array.size == 0:
        raise ValueError(f"{name} must be a sequence of numbers, got shape {array.shape}")
    return array


def three_numbers(name: str, values: object, unit: str = "") -> tuple[float, ...]:
    """Return the three components of a vector."""
    found = finite_array(name, values, unit)
    if found.shape != (3,):
        raise ValueError(
            f"{name} must be three numbers{_in(unit)}, got {shown(values)}: as (0.0, 0.0, 1.0)"
        )
    return tuple(found.tolist())


def along(name: str, values: object, count: int, unit: str) -> FloatArray:
    """Return a number at each of so many stations, from these or from one for all, (stations,)."""
    array = finite_array(name, values, unit)
    if array.shape not in ((), (count,)):
        raise ValueError(
            f"{name} must be one number{_in(unit)}, or one at each of the {count} stations, got "
            f"the shape {array.shape}"
        )
    return np.broadcast_to(array, count)


def require_ascending(name: str, values: Iterable[float], unit: str) -> None:
    """Refuse numbers of which one is not above the one before it."""
    for before, after in itertools.pairwise(values):
        if after <= before:
            raise ValueError(
                f"{name} must ascend, but {after:g} {unit} comes after {before:g} {unit}: sort "
                "them, and set equal ones apart"
            )


def stepped(name: str, values: ArrayLike) -> FloatArray:
    """Return ascending stations [m]; two at one place are a step, 1e-9 of their span wide."""
    at = np.array(values, dtype=np.float64)
    same, width = np.diff(at) == 0.0, _STEP * (at[-1] - at[0])
    at[1:][same] += width
    if same[-1:].any():
        at[-2:] -= width  # the blade ends where it did
    require_ascending(name, at, "m")
    return at


def times_from_rest(times: object) -> FloatArray:
    """Return the times of a response as a 1-d array; refuse those before 0 or out of order."""
    time = finite_values("times", times, "s")
    if time[0] < 0.0 or np.any(np.diff(time) < 0.0):
        raise ValueError("times must ascend from 0 s on, for the blade is at rest before")
    return time


def points_of_beam(name: str, x: object, length: float) -> FloatArray:
    """Return material points `x` [m], one or a sequence, over the `length`: (points,) in 0 .. 1.

    Points beyond the ends by round-off are put on them, any others beyond are refused.
    """
    points = np.atleast_1d(finite_array(name, x, "m"))
    if points.ndim != 1:
        raise ValueError(f"{name} must be a sequence of points, got shape {points.shape}")
    slack = _BEYOND_THE_ENDS * length
    outside = (points < -slack) | (points > length + slack)
    if outside.any():
        raise ValueError(
            f"{name} must lie on the beam, from 0 to its length of {length:g} m, got "
            f"{points[outside][0]:g} m; {name} are distances from the clamp"
        )
    return np.clip(points / length, 0.0, 1.0)


def require_offset(name: str, offset: ArrayLike, length: float) -> None:
    """Refuse offsets [m] from the line that are longer than the blade, of `length` [m]."""
    far = float(np.abs(offset).max())
    if far > length:
        raise ValueError(
            f"{name} is {far:g} m from the line of a blade of {length:g} m: give it in m, at most "
            "the length"
        )


def require_along(name: str, profile: Profile, length: float) -> None:
    """Refuse stations that do not run from the clamp to the tip, at `length` [m]."""
    at = stations(profile)
    if at and (at[0] != 0.0 or not math.isclose(at[-1], length, rel_tol=1e-9)):
        raise ValueError(
            f"the stations of {name} run from {at[0]:g} to {at[-1]:g} m: give them from 0 to the "
            f"length, {length:g} m"
        )


def checked_profile(name: str, profile: object, unit: str = "") -> Profile:
    """Return a profile of plain numbers and tuples, so that it hashes."""
    given, profile = profile, bare(name, profile, unit)
    if profile is not given and np.ndim(profile) > 1:  # type: ignore[arg-type]
        raise ValueError(
            f"{name} has stations (x, value), which differ in unit, in one quantity: give each "
            "number its unit, or plain numbers in SI"
        )
    if not _is_sequence(profile):
        return finite_number(name, profile, unit)
    items: list[Any] = list(profile)  # type: ignore[call-overload]
    if not items:
        raise ValueError(f"{name} is empty: give a number, coefficients or stations")
    if not _is_sequence(items[0]):
        return tuple(_entry(f"{name}[{k}]", value, unit) for k, value in enumerate(items))
    pairs: list[tuple[float, float]] = []
    for k, pair in enumerate(items):
        if not _is_sequence(pair) or len(pair) != 2:
            raise ValueError(f"{name}[{k}] must be a station (x, value), got {shown(pair)}")
        pairs.append((_entry(f"{name}[{k}]", pair[0], "m"), _entry(f"{name}[{k}]", pair[1], unit)))
    if len(pairs) < 2:
        raise ValueError(
            f"{name} has one station, at {pairs[0][0]:g} m: give two at least, or a number"
        )
    at = stepped(f"the stations of {name}", [x for x, _ in pairs]).tolist()
    return tuple((x, value) for x, (_, value) in zip(at, pairs, strict=True))


def _is_sequence(value: object) -> bool:
    return isinstance(value, tuple | list) or (isinstance(value, np.ndarray) and value.ndim > 0)


def _entry(name: str, value: object, unit: str = "") -> float:
    """Return a number out of a list that may have been read from a file."""
    if isinstance(value, str):
        raise TypeError(f"{name} is the text {str(value)!r}: read numbers, as numpy.loadtxt does")
    if isinstance(value, float) and math.isnan(value):
        raise ValueError(f"{name} is NaN: leave the station out if its cell is empty")
    return finite_number(name, value, unit)
