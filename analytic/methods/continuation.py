"""Continuation of periodic orbits in amplitude, from a linear mode outwards."""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, Generic, NamedTuple

import numpy as np

from ..arrays import FloatArray
from .fourier import packed
from .harmonic_balance import LastTangent, frequency_change, solve
from .newton import NoOrbitError
from .orbit import Orbit, S

RESIDUAL_BOUND = 1e-4
"""Largest residual of an orbit on the way; away from resonances its frequency is good to 1e-8."""

FREQUENCY_BOUND = 1e-9
"""Relative change of an orbit's frequency under one more refinement, up to which it is settled."""

_OF_TABLES, _DRIFT = 1e-7, 1e-8  # the same of tables, whose data do not deserve more
_LARGE_DRIFT = 1e-7  # that with which the most harmonics are let go
_TRUNCATED = 5e-6  # residual of harmonics left out, which leave 1e-6 of a response's amplitude
_FEWEST_HARMONICS = 6
MOST_FUNCTIONS = 128
"""For θ; enough for the smallest orbits up to w̄ = 1000."""
_LARGEST_FACTOR = 2.5  # from one amplitude to the next
_SAME_AMPLITUDE = 1e-14  # steps add up to 0.3 within round-off
_GUESSED_FROM = 4  # nodes
_FARTHEST = 6.0  # from an orbit to one guessed from it, as a ratio of the amplitudes


class Care(NamedTuple):
    """Effort: how well orbits are resolved, and how hard the next one is sought."""

    drift: float = 2e-11  # of the invariant, at which the harmonics suffice
    harmonics: int = 64  # at most
    halvings: int = 5  # of a step that finds nothing
    functions: int = 128  # at most
    unknowns: int = 4000  # at most, whose Jacobian takes 128 MB
    tail: float = 1.0  # times `RESIDUAL_BOUND`, what kinks of the section may leave

    @property
    def change(self) -> float:
        """Relative change of the frequency by more functions, at which they suffice."""
        return FREQUENCY_BOUND if self.tail == 1.0 else _OF_TABLES

    def of_table(self, tail: float) -> Care:
        """Return the same for a table, or for a smooth blade, whose tail is 1."""
        return self if tail == 1.0 else self._replace(tail=tail, drift=max(self.drift, _DRIFT))


THOROUGH = Care()


def linear_orbit(system: S, shape: FloatArray, frequency: float, amplitude: float) -> Orbit[S]:
    """Return the motion q₀ + `amplitude` times `shape` (n,), odd coordinates in the sine.

    Without symmetry a complex shape x makes the motion Re x exp(iφ).
    """
    coefficients = np.zeros((2 * _FEWEST_HARMONICS + 1, system.size))
    coefficients[0] = system.equilibrium
    if system.odd is None:
        cosine, sine = shape.real, -shape.imag
    else:
        cosine, sine = np.where(system.odd, 0.0, shape), np.where(system.odd, shape, 0.0)
    coefficients[1] = amplitude * cosine
    coefficients[_FEWEST_HARMONICS + 1] = amplitude * sine
    return Orbit(system=system, amplitude=amplitude, frequency=frequency, coefficients=coefficients)


def meets_the_equations(orbit: Orbit[Any], care: Care) -> bool:
    """Return whether the functions suffice, by the residual on half as many again."""
    return bool(orbit.residual <= care.tail * RESIDUAL_BOUND)


@dataclass(kw_only=True)
class Path(Generic[S]):
    """The orbits that grow out of a linear mode, by their amplitude.

    It grows from its two smallest orbits upwards in steps that do not depend on the amplitudes
    asked for; nor do the answers.
    """

    seed: Orbit[S]
    double: Orbit[S]
    longest: float  # step of the amplitude
    care: Care = THOROUGH
    tangent: LastTangent = field(default_factory=LastTangent, repr=False)
    nodes: list[Orbit[S]] = field(init=False)  # found so far, ascending
    _end: str = field(init=False, default="")
    _step: float = field(init=False, default=math.inf)

    def __post_init__(self) -> None:
        self.nodes = [self.seed, self.double]

    def at(self, amplitude: float) -> Orbit[S]:
        """Return the orbit of the peak `amplitude`, with its frequency's error; or NoOrbitError."""
        while self.nodes[-1].amplitude < amplitude - _SAME_AMPLITUDE:
            self._extend()
        place = bisect_right(self.nodes, amplitude, key=lambda orbit: orbit.amplitude)
        below = self.nodes[max(place - 1, 0)]
        for node in (below, *self.nodes[place : place + 1]):
            if abs(node.amplitude - amplitude) < _SAME_AMPLITUDE:
                return self._settled(replace(node, amplitude=amplitude))
        lower, upper = self.nodes[max(place - 3, 0) : max(place, 1)], self.nodes[place : place + 1]
        guesses = [_through(lower, amplitude), below]
        if upper and place:
            guesses = [_through([*lower, *upper], amplitude), *guesses, *upper]
        reasons = []
        for guess in guesses:
            try:
                return self._settled(self._resolved(guess.scaled(amplitude), amplitude))
            except NoOrbitError as reason:
                reasons.append(str(reason))
        raise NoOrbitError(reasons[0], below)

    def laid(self, amplitude: float) -> Orbit[S]:
        """Return the same, at or beyond the last node: it becomes a node."""
        while self.nodes[-1].amplitude < amplitude - _SAME_AMPLITUDE:
            self._extend(amplitude)
        last = self.nodes[-1]
        return last if abs(last.amplitude - amplitude) < _SAME_AMPLITUDE else self.at(amplitude)

    def _extend(self, end: float = math.inf) -> None:
        """Add the next node, not beyond `end`."""
        if self._end:
            raise NoOrbitError(self._end, self.nodes[-1])
        last, reason = self.nodes[-1], ""
        step = min((_LARGEST_FACTOR - 1.0) * last.amplitude, self.longest, 2.0 * self._step)
        if last.amplitude + 1.1 * step > end:
            step = end - last.amplitude
        whole = step
        while step > min(self.longest / 2.0**self.care.halvings, 0.9 * whole):
            try:
                orbit = self._stepped(last.amplitude + step)
            except NoOrbitError as failed:
                reason, step = reason or str(failed), 0.5 * step
                continue
            self.nodes.append(orbit)
            self._step = step if step < whole else math.inf
            return
        self._end = f"the last amplitude reached is {last.amplitude:.4g}, beyond which {reason}"
        raise NoOrbitError(self._end, last)

    def _stepped(self, amplitude: float) -> Orbit[S]:
        last = self.nodes[-1]
        guess = _through(self.nodes[-_GUESSED_FROM:], amplitude)
        # Cut at harmonic H, the invariant drifts as the next one, with a^(H + 1).
        growth = (amplitude / last.amplitude) ** (last.harmonics + 1)
        if (last.invariant_drift - last.invariant_noise) * growth > self.care.drift:
            guess = _on_more_harmonics(guess, self.care.harmonics)
        return self._resolved(guess, amplitude)

    def _resolved(self, guess: Orbit[S], amplitude: float) -> Orbit[S]:
        """Return the orbit near `guess` with as many harmonics and functions as it needs."""
        orbit = solve(guess, amplitude, self.tangent)
        while (larger := refined(orbit, self.care)) is not None:
            orbit = solve(larger, amplitude, self.tangent)
        return orbit

    def _settled(self, orbit: Orbit[S]) -> Orbit[S]:
        """Return the orbit with its frequency's error, on as many functions as that needs."""
        error, tangent = frequency_change(orbit, self.tangent), LastTangent()
        while error > self.care.change:
            try:
                orbit = solve(_on_more_functions(orbit), orbit.amplitude, tangent)
            except NoOrbitError:
                break
            error = frequency_change(orbit, tangent)
        if orbit.invariant_drift > self.care.drift + orbit.invariant_noise:
            # The most harmonics were not enough.
            error += _change_by_harmonics(orbit)
        return replace(orbit, frequency_error=error)


def _change_by_harmonics(orbit: Orbit[Any]) -> float:
    """Return the relative change of the frequency by a quarter more harmonics."""
    try:
        more = solve(_on_more_harmonics(orbit, 2 * orbit.harmonics), orbit.amplitude)
    except NoOrbitError:
        return math.inf
    return abs(more.frequency / orbit.frequency - 1.0)


def _through(orbits: Sequence[Orbit[S]], amplitude: float) -> Orbit[S]:
    """Return the guess through orbits: harmonic k as a^k, times a polynomial of a²."""
    # Far below, the high harmonics are round-off.
    near = [orbit for orbit in orbits if amplitude < _FARTHEST * orbit.amplitude]
    last = near[-1] if near else orbits[-1]
    finer = max(
        (orbit.system for orbit in near), key=lambda one: one.functions, default=last.system
    )
    here = [
        orbit.scaled(amplitude).with_harmonics(last.harmonics).on(finer) for orbit in near or [last]
    ]
    squares = np.array([orbit.amplitude**2 for orbit in near or [last]])
    weights = [
        np.prod([(amplitude**2 - other) / (one - other) for other in squares if other != one])
        for one in squares
    ]
    return replace(
        here[-1],
        coefficients=sum(w * orbit.coefficients for w, orbit in zip(weights, here, strict=True)),
        frequency=float(sum(w * orbit.frequency for w, orbit in zip(weights, here, strict=True))),
    )


def refined(
    orbit: Orbit[S], care: Care = THOROUGH, enough: Callable[[bool], bool] | None = None
) -> Orbit[S] | None:
    """Return the orbit on more harmonics or functions, to be solved again; None if it needs none.

    Harmonics until the invariant is constant or, under a drive, until they leave a small residual;
    functions until the residual on half as many again is small, or by `enough`, a function of
    whether more are possible. Raises NoOrbitError where that takes more than are taken.
    """
    if orbit.system.driven:
        lacks, left = orbit.truncation > _TRUNCATED, f"a residual of {orbit.truncation:.1e}"
    else:
        lacks = orbit.invariant_drift > care.drift + orbit.invariant_noise
        left = f"the Jacobi integral drifting by {orbit.invariant_drift:.1e}"
    larger = _on_more_harmonics(orbit, care.harmonics)
    last = orbit.harmonics >= care.harmonics or _too_large(larger, care)
    nearly = not orbit.system.driven and orbit.invariant_drift < _LARGE_DRIFT
    if not lacks or (last and nearly):
        if enough is None:
            suffice = meets_the_equations(orbit, care)
        else:
            suffice = enough(not _too_many(orbit.on(orbit.finer), care))
        return None if suffice else _on_more_functions(orbit, care)
    if last:
        raise NoOrbitError(f"{orbit.harmonics} harmonics leave {left}")
    return larger


def _on_more_harmonics(orbit: Orbit[S], most: int) -> Orbit[S]:
    more = 2 if orbit.system.driven else max(4, orbit.harmonics // 4)
    return orbit.with_harmonics(min(orbit.harmonics + more, most))


def _on_more_functions(orbit: Orbit[S], care: Care = THOROUGH) -> Orbit[S]:
    larger = orbit.on(orbit.finer)
    if _too_many(larger, care):
        raise NoOrbitError(
            f"{orbit.system.functions} functions meet the equations of motion to "
            f"{orbit.residual:.1e} only, not to {care.tail * RESIDUAL_BOUND:g}",
            remedy="no damping helps where functions are missing: smooth the steps of the section, "
            "or rotate slower",
        )
    return larger


def _too_many(larger: Orbit[Any], care: Care) -> bool:
    most = min(care.functions, MOST_FUNCTIONS)
    return larger.system.functions > most or _too_large(larger, care)


def _too_large(orbit: Orbit[Any], care: Care) -> bool:
    return bool(packed(orbit.coefficients, orbit.parts).size > care.unknowns)
