"""Continuation of periodic orbits in amplitude, from a linear mode outwards."""

from __future__ import annotations

import math
from bisect import bisect_right
from dataclasses import dataclass, field, replace
from typing import Any, Generic

import numpy as np

from ..arrays import FloatArray
from .harmonic_balance import NoOrbitError, PeriodicOrbit, S, solve

RESIDUAL_BOUND = 1e-4
"""Largest residual of an accepted orbit; its frequency is wrong by the order of the square."""

_DRIFT_BOUND = 2e-11  # the drift of the invariant at which the harmonics suffice
_LARGE_DRIFT = 1e-7  # that with which the most harmonics are let go
_FEWEST_HARMONICS, _MOST_HARMONICS = 6, 64
MOST_FUNCTIONS = 128
"""For θ; enough for the smallest orbits up to w̄ = 1000."""
_MOST_UNKNOWNS = 4000  # whose Jacobian takes 128 MB
_LARGEST_FACTOR = 2.5  # from one amplitude to the next
_HALVINGS = 5


def linear_orbit(
    system: S, shape: FloatArray, frequency: float, amplitude: float
) -> PeriodicOrbit[S]:
    """Return the motion q₀ + `amplitude` times `shape` (n,), odd coordinates in the sine."""
    coefficients = np.zeros((_FEWEST_HARMONICS + 1, system.size))
    coefficients[0] = system.equilibrium
    coefficients[1] = amplitude * shape
    return PeriodicOrbit(
        system=system, amplitude=amplitude, frequency=frequency, coefficients=coefficients
    )


def meets_the_equations(orbit: PeriodicOrbit[Any]) -> bool:
    """Return whether the functions suffice, by the residual on half as many again."""
    return bool(orbit.residual <= RESIDUAL_BOUND)


@dataclass(kw_only=True)
class Path(Generic[S]):
    """The orbits that grow out of a linear mode, by their amplitude.

    It is laid from its two smallest orbits upwards in steps that do not depend on what is asked
    for, and so are the answers.

    Attributes
    ----------
    seed, double : PeriodicOrbit
        The smallest orbits.
    longest : float
        Longest step of the amplitude.
    nodes : list of PeriodicOrbit
        Those found so far, ascending.
    """

    seed: PeriodicOrbit[S]
    double: PeriodicOrbit[S]
    longest: float
    nodes: list[PeriodicOrbit[S]] = field(init=False)
    _end: str = field(init=False, default="")
    _step: float = field(init=False, default=math.inf)

    def __post_init__(self) -> None:
        self.nodes = [self.seed, self.double]

    def at(self, amplitude: float) -> PeriodicOrbit[S]:
        """Return the orbit of the peak `amplitude`.

        Raises
        ------
        NoOrbitError
            If there is none, or none is found: where and why.
        """
        while self.nodes[-1].amplitude < amplitude:
            self._extend()
        place = bisect_right(self.nodes, amplitude, key=lambda orbit: orbit.amplitude)
        below = self.nodes[max(place - 1, 0)]
        if below.amplitude == amplitude:
            return below
        before = self.nodes[place - 2] if place >= 2 else None
        above = self.nodes[place] if place < len(self.nodes) else None
        guesses = [_predicted(below, before, amplitude)]
        if above is not None and amplitude > below.amplitude:
            guesses = [_on_line(below, above, amplitude), *guesses, above.scaled(amplitude)]
        reasons = []
        for guess in guesses:
            try:
                return _resolved(guess, amplitude)
            except NoOrbitError as reason:
                reasons.append(str(reason))
        raise NoOrbitError(reasons[0], below)

    def _extend(self) -> None:
        """Add the next node."""
        if self._end:
            raise NoOrbitError(self._end, self.nodes[-1])
        last, reason = self.nodes[-1], ""
        step = min((_LARGEST_FACTOR - 1.0) * last.amplitude, self.longest, 2.0 * self._step)
        while step > self.longest / 2.0**_HALVINGS:
            try:
                found = self._stepped(last.amplitude + step)
            except NoOrbitError as failed:
                reason, step = reason or str(failed), 0.5 * step
                continue
            self.nodes.append(found)
            self._step = step
            return
        self._end = f"the last amplitude reached is {last.amplitude:.4g}, beyond which {reason}"
        raise NoOrbitError(self._end, last)

    def _stepped(self, amplitude: float) -> PeriodicOrbit[S]:
        return _resolved(_predicted(self.nodes[-1], self.nodes[-2], amplitude), amplitude)


def _predicted(
    last: PeriodicOrbit[S], before: PeriodicOrbit[S] | None, amplitude: float
) -> PeriodicOrbit[S]:
    """Return the guess: harmonic k as a^k, times a linear function of a² if two are known."""
    guess = last.scaled(amplitude)
    # Far below, the high harmonics of `before` are round-off.
    if before is None or not 0.0 < amplitude - last.amplitude < before.amplitude:
        return guess
    return _on_line(last, before, amplitude)


def _on_line(one: PeriodicOrbit[S], other: PeriodicOrbit[S], amplitude: float) -> PeriodicOrbit[S]:
    """Return the guess from two orbits: harmonic k as a^k, times a linear function of a²."""
    finer = max(one.system, other.system, key=lambda system: system.functions)
    here, there = (
        orbit.scaled(amplitude).with_harmonics(one.harmonics).on(finer) for orbit in (one, other)
    )
    weight = (amplitude**2 - one.amplitude**2) / (other.amplitude**2 - one.amplitude**2)
    return replace(
        here,
        coefficients=here.coefficients + weight * (there.coefficients - here.coefficients),
        frequency=here.frequency + weight * (there.frequency - here.frequency),
    )


def _resolved(guess: PeriodicOrbit[S], amplitude: float) -> PeriodicOrbit[S]:
    """Return the orbit near `guess` with as many harmonics and functions as it needs."""
    orbit = solve(guess, amplitude)
    while (larger := refined(orbit)) is not None:
        orbit = solve(larger, amplitude)
    return orbit


def refined(orbit: PeriodicOrbit[S]) -> PeriodicOrbit[S] | None:
    """Return the orbit on more harmonics or functions, to be solved again; None if it needs none.

    Harmonics until the invariant is constant, functions until the residual is small.

    Raises
    ------
    NoOrbitError
        If it needs more than are taken.
    """
    if orbit.invariant_drift > _DRIFT_BOUND + orbit.invariant_noise:
        most = orbit.harmonics >= _MOST_HARMONICS
        if most and orbit.invariant_drift < _LARGE_DRIFT and meets_the_equations(orbit):
            return None
        count = orbit.harmonics + max(4, orbit.harmonics // 4)
        larger = orbit.with_harmonics(min(count, _MOST_HARMONICS))
        if most or _too_large(larger):
            raise NoOrbitError(
                f"{orbit.harmonics} harmonics leave the Jacobi integral drifting by "
                f"{orbit.invariant_drift:.1e}"
            )
        return larger
    return None if meets_the_equations(orbit) else _on_more_functions(orbit)


def _on_more_functions(orbit: PeriodicOrbit[S]) -> PeriodicOrbit[S]:
    larger = orbit.on(orbit.system.refined())
    if larger.system.functions > MOST_FUNCTIONS or _too_large(larger):
        raise NoOrbitError(
            f"{orbit.system.functions} functions meet the equations of motion to "
            f"{orbit.residual:.1e} only, not to {RESIDUAL_BOUND:g}"
        )
    return larger


def _too_large(orbit: PeriodicOrbit[Any]) -> bool:
    return bool(orbit.harmonics * orbit.system.size > _MOST_UNKNOWNS)
