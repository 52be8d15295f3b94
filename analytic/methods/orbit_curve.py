"""Curves of orbits by arclength, each resolved as finely as it needs: free ones and responses.

The unknowns are the coefficients of the series and the frequency, one more than the projected
equations.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property, partial
from itertools import pairwise
from typing import Any, Generic, Literal

import numpy as np

from ..arrays import FloatArray
from .arclength import Point, advanced, corrected, crossing, located
from .continuation import Care, refined
from .fourier import packed, unpacked
from .harmonic_balance import jacobian, on_finer, projected
from .newton import NoOrbitError
from .orbit import Orbit, S

Mark = Literal["", "asked", "fold", "peak", "branch point"]
Marked = tuple[Orbit[Any], Mark]
"""An orbit on a curve and its mark: "asked" for, a "fold" of the frequency, a "peak" of the
amplitude, a "branch point" where another curve crosses."""

_CARE = Care(harmonics=40, functions=64)
RESPONSE_ERROR = 5e-5
"""Error over the amplitude down to which functions grow on a table, as long as there are more."""
_LARGEST_ERROR = 1e-3
_FIRST_STEP, _LONGEST_STEP = 0.02, 0.25
_MOST_POINTS = 4000
_LEAST_SHARE = 1.0 / 32.0  # of a load, by which it is raised
_STILL = 1e-12  # amplitude that is round-off, and has no peaks


@dataclass(frozen=True, eq=False)
class OrbitCurve(Generic[S]):
    """The projected equations of orbits, as a curve in their coefficients and frequency."""

    like: Orbit[S]  # on the same system and harmonics
    origin: float  # the frequency is this plus the scale times the last unknown
    scale: float
    # The orbit on as many more harmonics or functions as a point lacks, None if it lacks none;
    # raises NoOrbitError if that is more than are taken.
    larger: Callable[[At[S]], Orbit[S] | None]

    def unknowns(self, orbit: Orbit[Any]) -> FloatArray:
        """Return the unknowns of an orbit, cut or padded to these harmonics and functions."""
        orbit = orbit.with_harmonics(self.like.harmonics).on(self.like.system)
        last = (orbit.frequency - self.origin) / self.scale
        return np.append(packed(orbit.coefficients, self.like.parts), last)

    def _raw(self, z: FloatArray) -> Orbit[S]:
        return replace(
            self.like,
            coefficients=unpacked(z[:-1], self.like.parts, self.like.coefficients.shape),
            frequency=float(self.origin + self.scale * z[-1]),
        )

    def orbit(self, z: FloatArray) -> Orbit[S]:
        """Return the orbit of the unknowns, with its peak."""
        return self._raw(z).at_peak()

    def residual(self, z: FloatArray) -> FloatArray:
        """Return the projected residual, as many as there are coefficients."""
        return projected(self._raw(z))

    def jacobian(self, z: FloatArray, *, coarse: bool = False) -> FloatArray:
        """Return its derivatives to all unknowns; `coarse` ones are good to about 1e-3."""
        matrix = jacobian(self._raw(z), coarse=coarse)[:-1]
        matrix[:, -1] *= self.scale
        return matrix


@dataclass(frozen=True, eq=False)
class At(Generic[S]):
    """A point of a curve of orbits."""

    curve: OrbitCurve[S]
    point: Point

    @cached_property
    def orbit(self) -> Orbit[S]:
        """The orbit."""
        return self.curve.orbit(self.point.z)

    @cached_property
    def error(self) -> float:
        """Change of the gauge's harmonics on more functions, over the largest.

        Across the curve, so that it does not grow where the amplitude goes fast with the frequency.
        """
        largest = float(np.abs(self.orbit.gauge_harmonics).max())
        if largest < _STILL:
            return 0.0
        moved = on_finer(self.orbit, self.point.factors, lambda _: 0.0, self.curve.scale)
        change = moved.gauge_harmonics - self.orbit.gauge_harmonics
        return float(np.abs(change).max()) / largest

    def on(self, curve: OrbitCurve[S]) -> At[S]:
        """Return the nearest point of a finer curve."""
        here = curve.unknowns(self.orbit)
        ahead = curve.unknowns(self.curve.orbit(self.point.z + self.point.tangent))
        return At(curve, corrected(curve, here, ahead - here))

    def resolved(self) -> At[S]:
        """Return the same with as many harmonics and functions as it needs."""
        at = self
        while (larger := at.curve.larger(at)) is not None:
            at = at.on(replace(at.curve, like=larger))
        return at

    def followed(self, step: float, longest: float) -> Iterator[tuple[At[S], At[S]]]:
        """Yield points with the next, on a curve that resolves both; raises NoOrbitError."""
        here = self
        while True:
            point, step = advanced(here.curve, here.point, step, longest)
            there = At(here.curve, point).resolved()
            if there.curve is not here.curve:
                here = here.on(there.curve)
            yield here, there
            here = there

    def fold(self, there: At[S]) -> Point | None:
        """Return where the frequency turns around before the next point, if it does."""
        return located(self.curve, self.point, there.point, lambda point: float(point.tangent[-1]))

    def peak(self, there: At[S]) -> Point | None:
        """Return where the amplitude turns around before the next point, if it does."""
        curve = self.curve
        if self.orbit.amplitude < _STILL:
            return None

        def climb(point: Point) -> float:
            return float(curve.orbit(point.z).peak_gradient() @ point.tangent)

        return located(curve, self.point, there.point, climb)

    def crossing(self, there: At[S]) -> FloatArray | None:
        """Return where another branch crosses before the next point, if one does."""
        return crossing(self.curve, self.point, there.point)


def response_curve(
    system: S, frequencies: FloatArray, largest: float, harmonics: int, tail: float = 1.0
) -> tuple[list[Marked], float]:
    """Return the response from the first frequency to the last, along the curve, and its error.

    Followed by arclength through all folds, from the small response at the first; the frequencies
    between are met wherever the curve passes them. Curves that are not connected to it are not
    found. At least so many `harmonics` are taken; for the `tail` see `Care`.

    The error is that of `At` at the highest point, of a table the largest.

    Raises
    ------
    NoOrbitError
        If no response is found, the curve has no way on, or the amplitude exceeds `largest`; `last`
        is the list of orbits found.
    """
    first, last = float(frequencies[0]), float(frequencies[-1])
    rest = np.zeros((2 * harmonics + 1, system.size))
    rest[0] = system.rest(first)
    like = Orbit(system=system, frequency=first, coefficients=rest)
    curve = OrbitCurve(like, first, last - first, partial(_larger, tail=tail))
    marked: list[Marked] = []
    try:
        highest = at = _beginning(curve)
        error = at.error if tail > 1.0 else 0.0
        marked.append((at.orbit, "asked"))
        for here, there in at.followed(_FIRST_STEP, _LONGEST_STEP):
            between, over = _between(here, there, frequencies)
            marked += between
            if over:
                return marked, max(error, highest.error)
            if tail > 1.0:
                error = max(error, there.error)
            highest = max(highest, there, key=lambda one: one.orbit.amplitude)
            if there.orbit.amplitude > largest:
                raise NoOrbitError(f"the amplitude exceeds {largest:g} there")
            marked.append((there.orbit, ""))
            if len(marked) >= _MOST_POINTS:
                break
    except NoOrbitError as reason:
        raise NoOrbitError(str(reason), marked, reason.remedy) from None
    raise NoOrbitError(f"the curve does not end within {_MOST_POINTS} points", marked)


def _larger(at: At[S], tail: float) -> Orbit[S] | None:
    """Return the orbit on more harmonics or functions: of a table until its error is small."""

    def enough(more: bool) -> bool:
        if not more and at.error > _LARGEST_ERROR:
            count = at.orbit.system.functions
            raise NoOrbitError(
                f"with {count} functions {at.error:.1e} of the amplitude is unknown",
                remedy="no damping helps where functions are missing: smooth the steps of the "
                "table that its data do not know",
            )
        return not more or at.error <= RESPONSE_ERROR

    return refined(at.orbit, _CARE._replace(tail=tail), enough if tail > 1.0 else None)


def _beginning(curve: OrbitCurve[S]) -> At[S]:
    """Return the small response at the first frequency; the load is raised in steps if it takes."""
    z, share, step = curve.unknowns(curve.like), 0.0, 1.0
    across, like = np.eye(1, z.size, z.size - 1)[0], curve.like
    while share < 1.0:
        eased = replace(curve, like=replace(like, system=like.system.loaded(share + step)))
        try:
            point = corrected(eased, z, across)
        except NoOrbitError:
            step *= 0.5
            if step < _LEAST_SHARE:
                raise
        else:
            z, share = point.z, share + step
    resolved = At(curve, point).resolved()
    curve, z = resolved.curve, resolved.point.z.copy()
    z[-1] = 0.0  # refining goes across the curve, not along the frequency
    return At(curve, corrected(curve, z, np.eye(1, z.size, z.size - 1)[0]))


def _between(at: At[S], there: At[S], frequencies: FloatArray) -> tuple[list[Marked], bool]:
    """Return the special points between two points, in order, and whether the curve ends."""
    curve, between = at.curve, list[tuple[float, Mark, FloatArray]]()

    def note(mark: Mark, z: FloatArray) -> None:
        between.append((float(at.point.tangent @ (z - at.point.z)), mark, z))

    fold = at.fold(there)
    if fold is not None:
        note("fold", fold.z)
    if (peak := at.peak(there)) is not None:
        note("peak", peak.z)
    if (crossed := at.crossing(there)) is not None:
        note("branch point", crossed)
    # A fold between them may pass a frequency twice: each side for itself.
    stops = [at.point, *([fold] if fold is not None else []), there.point]
    for one, other in pairwise(stops):
        for value in (frequencies - curve.origin) / curve.scale:
            if value == 0.0 and other.z[-1] > one.z[-1]:
                continue  # the beginning, which refinement has moved back a little
            if (one.z[-1] - value) * (other.z[-1] - value) < 0.0 or other.z[-1] == value:
                point = _at_frequency(curve, one, other, float(value))
                if point is not None:
                    note("asked", point.z)
    between.sort(key=lambda item: item[0])
    marked, over = list[Marked](), False
    for _, mark, z in between:
        marked.append((curve.orbit(z), mark))
        if mark == "asked" and not 1e-9 <= z[-1] <= 1.0 - 1e-9:
            over = True
            break
    return marked, over


def _at_frequency(curve: OrbitCurve[S], one: Point, other: Point, value: float) -> Point | None:
    """Return the point between two, with no fold between them, at a value of the last unknown."""
    share = (value - one.z[-1]) / (other.z[-1] - one.z[-1])
    guess = one.z + share * (other.z - one.z)
    try:
        return corrected(curve, guess, np.eye(1, guess.size, guess.size - 1)[0])
    except NoOrbitError:  # next to a fold
        return located(curve, one, other, lambda point: float(point.z[-1] - value))
