"""Continuation of periodic orbits in amplitude, from a linear mode outwards."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from ..arrays import FloatArray
from .harmonic_balance import NoOrbitError, PeriodicOrbit, S, solve

RESIDUAL_BOUND = 1e-4
"""Largest residual of an accepted orbit; its frequency is wrong by the order of the square."""

_DRIFT_BOUND = 2e-11  # the drift of the invariant at which the harmonics suffice
_FEWEST_HARMONICS, _MOST_HARMONICS = 6, 48
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
    return orbit.residual <= RESIDUAL_BOUND


def followed(
    last: PeriodicOrbit[S], before: PeriodicOrbit[S] | None, amplitude: float
) -> tuple[PeriodicOrbit[S], PeriodicOrbit[S] | None]:
    """Return the orbit of the peak `amplitude` and its forerunner, starting from two known ones.

    Steps are halved where Newton's method fails.

    Raises
    ------
    NoOrbitError
        If they would have to become too small, saying where and why.
    """
    target = min(amplitude, _LARGEST_FACTOR * last.amplitude)
    halvings = 0
    while True:
        try:
            found = _resolved(_predicted(last, before, target), target)
        except NoOrbitError as reason:
            halvings += 1
            if halvings > _HALVINGS:
                raise NoOrbitError(
                    f"the last amplitude reached is {last.amplitude:.4g}, beyond which {reason}",
                    last,
                ) from None
            target = 0.5 * (last.amplitude + target)
            continue
        if found.amplitude > last.amplitude:
            before = last
        last = found
        if target == amplitude:
            return last, before
        target = min(amplitude, _LARGEST_FACTOR * target)


def _predicted(
    last: PeriodicOrbit[S], before: PeriodicOrbit[S] | None, amplitude: float
) -> PeriodicOrbit[S]:
    """Return the guess: harmonic k as a^k, times a linear function of a² if two are known."""
    guess = last.scaled(amplitude)
    # Far below, the high harmonics of `before` are round-off.
    if before is None or not 0.0 < amplitude - last.amplitude < before.amplitude:
        return guess
    other = before.scaled(amplitude).with_harmonics(last.harmonics).on(last.system)
    weight = (amplitude**2 - last.amplitude**2) / (last.amplitude**2 - before.amplitude**2)
    return replace(
        guess,
        coefficients=guess.coefficients + weight * (guess.coefficients - other.coefficients),
        frequency=guess.frequency + weight * (guess.frequency - other.frequency),
    )


def _resolved(guess: PeriodicOrbit[S], amplitude: float) -> PeriodicOrbit[S]:
    """Return the orbit near `guess` with as many harmonics and functions as it needs.

    Harmonics until the invariant is constant, functions until the residual is small.
    """
    orbit = solve(guess, amplitude)
    while True:
        if orbit.invariant_drift > _DRIFT_BOUND + orbit.invariant_noise:
            reason = (
                f"{orbit.harmonics} harmonics leave the Jacobi integral drifting by "
                f"{orbit.invariant_drift:.1e}"
            )
            larger = orbit.with_harmonics(orbit.harmonics + 4)
            too_many = larger.harmonics > _MOST_HARMONICS
        elif not meets_the_equations(orbit):
            reason = (
                f"{orbit.system.functions} functions meet the equations of motion to "
                f"{orbit.residual:.1e} only, not to {RESIDUAL_BOUND:g}"
            )
            larger = orbit.on(orbit.system.refined())
            too_many = larger.system.functions > MOST_FUNCTIONS
        else:
            return orbit
        if too_many or larger.harmonics * larger.system.size > _MOST_UNKNOWNS:
            raise NoOrbitError(reason)
        orbit = solve(larger, amplitude)
