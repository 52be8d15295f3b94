"""The response of a driven system over its parameter, followed through all folds."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np

from ..arrays import FloatArray
from .arclength import NoWayOnError, Point, corrected, crossing, located
from .driven import D, DrivenOrbit, Mark, ResponseCurve
from .orbit_curve import At

_FIRST_STEP, _LONGEST_STEP = 0.02, 0.25
_MOST_POINTS = 4000


class ResponseNotFollowedError(Exception):
    """A response curve ended too early; `orbits` holds what was found of it, `remedy` what to try.

    No remedy is told where the usual ones may help.
    """

    def __init__(self, message: str, orbits: list[DrivenOrbit[Any]], remedy: str = "") -> None:
        super().__init__(message)
        self.orbits, self.remedy = orbits, remedy


def response_curve(
    system: D, parameters: FloatArray, largest: float, harmonics: int
) -> list[DrivenOrbit[D]]:
    """Return the response from the first parameter to the last, in order along the curve.

    Followed by arclength through all folds, from the small response at the first; the parameters
    between are met wherever the curve passes them. Curves that are not connected to it are not
    found. At least so many `harmonics` are taken.

    Raises
    ------
    ResponseNotFollowedError
        If no response is found, the curve has no way on, or the amplitude exceeds `largest`.
    """
    first, last = float(parameters[0]), float(parameters[-1])
    curve = ResponseCurve(system, harmonics, first, last - first)
    orbits: list[DrivenOrbit[D]] = []
    try:
        at = _beginning(curve)
        orbits.append(replace(at.orbit, mark="asked"))
        step = _FIRST_STEP
        while len(orbits) < _MOST_POINTS:
            at, there, step = at.advanced(step, _LONGEST_STEP)
            between, over = _between(at, there, parameters)
            orbits += between
            if over:
                return orbits
            if there.orbit.amplitude > largest:
                raise NoWayOnError(f"the amplitude exceeds {largest:g} there")
            orbits.append(there.orbit)
            at = there
    except NoWayOnError as reason:
        raise ResponseNotFollowedError(str(reason), orbits, reason.remedy) from None
    raise ResponseNotFollowedError(f"the curve does not end within {_MOST_POINTS} points", orbits)


def _beginning(curve: ResponseCurve[D]) -> At[ResponseCurve[D]]:
    """Return the small response at the first parameter."""
    rest = np.zeros((2 * curve.harmonics + 1, curve.system.size))
    rest[0] = curve.system.rest(curve.origin)
    across = np.eye(1, rest.size + 1, rest.size)[0]
    resolved = At(curve, corrected(curve, np.append(rest.ravel(), 0.0), across)).resolved()
    curve, z = resolved.curve, resolved.point.z.copy()
    z[-1] = 0.0  # refining goes across the curve, not along the parameter
    return At(curve, corrected(curve, z, np.eye(1, z.size, z.size - 1)[0]))


def _between(
    at: At[ResponseCurve[D]], there: At[ResponseCurve[D]], parameters: FloatArray
) -> tuple[list[DrivenOrbit[D]], bool]:
    """Return what is special between two points, in order, and whether the curve's end is."""
    curve = at.curve
    wanted = (parameters - curve.origin) / curve.scale

    def climb(point: Point) -> float:
        along = point.tangent[:-1].reshape(-1, curve.system.size)
        return curve.orbit(point.z).amplitude_slope(along)

    found: list[tuple[float, Mark, FloatArray]] = []

    def note(mark: Mark, z: FloatArray) -> None:
        found.append((float(at.point.tangent @ (z - at.point.z)), mark, z))

    fold = located(curve, at.point, there.point, lambda point: float(point.tangent[-1]))
    peak = located(curve, at.point, there.point, climb)
    if fold is not None:
        note("fold", fold.z)
    if peak is not None:
        note("peak", peak.z)
    if (crossed := crossing(curve, at.point, there.point)) is not None:
        note("branch point", crossed[0])
    # A fold between them may pass a parameter twice: each side for itself.
    stops = [at.point, *([fold] if fold is not None else []), there.point]
    for one, other in pairwise(stops):
        for value in wanted:
            if (one.z[-1] - value) * (other.z[-1] - value) < 0.0 or other.z[-1] == value:
                point = _at_parameter(curve, one, other, float(value))
                if point is not None:
                    note("asked", point.z)
    found.sort(key=lambda item: item[0])
    orbits, over = [], False
    for _, mark, z in found:
        orbits.append(replace(curve.orbit(z), mark=mark))
        if mark == "asked" and not 1e-9 <= z[-1] <= 1.0 - 1e-9:
            over = True
            break
    return orbits, over


def _at_parameter(curve: ResponseCurve[D], one: Point, other: Point, value: float) -> Point | None:
    """Return the point between two, with no fold between them, at a value of the last unknown."""
    share = (value - one.z[-1]) / (other.z[-1] - one.z[-1])
    guess = one.z + share * (other.z - one.z)
    try:
        return corrected(curve, guess, np.eye(1, guess.size, guess.size - 1)[0])
    except NoWayOnError:  # next to a fold
        return located(curve, one, other, lambda point: float(point.z[-1] - value))
