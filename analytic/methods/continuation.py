"""Continuation of periodic orbits in amplitude, from a linear mode outwards."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..exact.continuum import Continuum, finer_model
from ..exact.modes import Modes
from ..quadrature import FloatArray
from .harmonic_balance import NoOrbitError, PeriodicOrbit, solve

RESIDUAL_BOUND = 1e-4
"""Largest residual of an accepted orbit; its frequency is wrong by the order of the square."""

_JACOBI_BOUND = 2e-11  # the drift of the Jacobi integral at which the harmonics suffice
_FEWEST_HARMONICS, _MOST_HARMONICS = 6, 48
MOST_FUNCTIONS = 128
"""For θ; enough for the smallest orbits up to w̄ = 1000."""
_MOST_UNKNOWNS = 4000  # whose Jacobian takes 128 MB
_LARGEST_FACTOR = 2.5  # from one amplitude to the next
_HALVINGS = 5


def linear_orbit(
    model: Continuum, rate: float, modes: Modes, mode: int, amplitude: float
) -> PeriodicOrbit:
    """Return the motion of so small an amplitude in the linear mode, counted from 1."""
    shape = amplitude * modes.coordinates[mode - 1]
    sines = np.zeros((_FEWEST_HARMONICS, model.bending))
    cosines = np.zeros((_FEWEST_HARMONICS + 1, model.axial))
    cosines[0] = model.split(model.steady_state(rate))[1]
    sines[0], cosines[1] = model.split(shape)
    return PeriodicOrbit(
        model=model,
        rate=rate,
        amplitude=amplitude,
        frequency=float(modes.frequencies[mode - 1]),
        sines=sines,
        cosines=cosines,
    )


def steady_elongation(orbit: PeriodicOrbit) -> FloatArray:
    """Return the coordinates of e (axial,) that the rotation alone gives the model."""
    return orbit.model.split(orbit.model.steady_state(orbit.rate))[1]


def meets_the_equations(orbit: PeriodicOrbit) -> bool:
    """Return whether the functions suffice, by the residual on half as many again."""
    return orbit.residual <= RESIDUAL_BOUND


def followed(
    last: PeriodicOrbit, before: PeriodicOrbit | None, amplitude: float
) -> tuple[PeriodicOrbit, PeriodicOrbit | None]:
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
    last: PeriodicOrbit, before: PeriodicOrbit | None, amplitude: float
) -> PeriodicOrbit:
    """Return the guess: harmonic k as a^k, times a linear function of a² if two are known."""
    guess = last.scaled(amplitude, steady_elongation(last))
    # Far below, the high harmonics of `before` are round-off.
    if before is None or not 0.0 < amplitude - last.amplitude < before.amplitude:
        return guess
    other = before.scaled(amplitude, steady_elongation(before))
    other = other.with_harmonics(last.harmonics).with_functions(last.model)
    weight = (amplitude**2 - last.amplitude**2) / (last.amplitude**2 - before.amplitude**2)
    return replace(
        guess,
        sines=guess.sines + weight * (guess.sines - other.sines),
        cosines=guess.cosines + weight * (guess.cosines - other.cosines),
        frequency=guess.frequency + weight * (guess.frequency - other.frequency),
    )


def _resolved(guess: PeriodicOrbit, amplitude: float) -> PeriodicOrbit:
    """Return the orbit near `guess` with as many harmonics and functions as it needs.

    Harmonics until the Jacobi integral is constant, functions until the residual is small.
    """
    orbit = solve(guess, amplitude)
    while True:
        if orbit.jacobi_drift > _JACOBI_BOUND + orbit.jacobi_noise:
            reason = (
                f"{orbit.harmonics} harmonics leave the Jacobi integral drifting by "
                f"{orbit.jacobi_drift:.1e}"
            )
            larger = orbit.with_harmonics(orbit.harmonics + 4)
            too_many = larger.harmonics > _MOST_HARMONICS
        elif not meets_the_equations(orbit):
            reason = (
                f"{orbit.model.bending} functions meet the equations of motion to "
                f"{orbit.residual:.1e} only, not to {RESIDUAL_BOUND:g}"
            )
            larger = orbit.with_functions(finer_model(orbit.model))
            too_many = larger.model.bending > MOST_FUNCTIONS
        else:
            return orbit
        if too_many or larger.harmonics * larger.model.size > _MOST_UNKNOWNS:
            raise NoOrbitError(reason)
        orbit = solve(larger, amplitude)
