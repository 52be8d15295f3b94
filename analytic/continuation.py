"""Continuation of periodic orbits in amplitude, from a linear mode outwards."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from .basis import FloatArray
from .continuum import Continuum
from .harmonic_balance import NoOrbitError, PeriodicOrbit, solve
from .modes import Modes

RESIDUAL_BOUND = 1e-4
"""Largest residual of an accepted orbit; its frequency is wrong by the order of the square."""

_JACOBI_BOUND = 2e-11  # the drift of the Jacobi integral at which the harmonics suffice
_FEWEST_HARMONICS, _MOST_HARMONICS = 6, 48
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
    steady = last.model.split(last.model.steady_state(last.rate))[1]
    target = min(amplitude, _LARGEST_FACTOR * last.amplitude)
    halvings = 0
    while True:
        try:
            found = _resolved(_predicted(last, before, target, steady), target)
        except NoOrbitError as reason:
            halvings += 1
            if halvings > _HALVINGS:
                raise NoOrbitError(
                    f"the last amplitude reached is {last.amplitude:.4g}, beyond which {reason}",
                    last,
                ) from None
            target = 0.5 * (last.amplitude + target)
            continue
        last, before = found, last
        if target == amplitude:
            return last, before
        target = min(amplitude, _LARGEST_FACTOR * target)


def _predicted(
    last: PeriodicOrbit, before: PeriodicOrbit | None, amplitude: float, steady: FloatArray
) -> PeriodicOrbit:
    """Return the guess: harmonic k as a^k, times a linear function of a² if two are known."""
    guess = last.scaled(amplitude, steady)
    # Far below, the high harmonics of `before` are round-off.
    if before is None or not 0.0 < amplitude - last.amplitude < before.amplitude:
        return guess
    other = before.scaled(amplitude, steady).with_harmonics(last.harmonics)
    weight = (amplitude**2 - last.amplitude**2) / (last.amplitude**2 - before.amplitude**2)
    return replace(
        guess,
        sines=guess.sines + weight * (guess.sines - other.sines),
        cosines=guess.cosines + weight * (guess.cosines - other.cosines),
        frequency=guess.frequency + weight * (guess.frequency - other.frequency),
    )


def _resolved(guess: PeriodicOrbit, amplitude: float) -> PeriodicOrbit:
    """Return the orbit near `guess` with as many harmonics as its Jacobi integral needs."""
    orbit = solve(guess, amplitude)
    while orbit.jacobi_drift > _JACOBI_BOUND + orbit.jacobi_noise:
        if orbit.harmonics >= _MOST_HARMONICS:
            raise NoOrbitError(
                f"{orbit.harmonics} harmonics leave the Jacobi integral drifting by "
                f"{orbit.jacobi_drift:.1e}"
            )
        orbit = solve(orbit.with_harmonics(orbit.harmonics + 4), amplitude)
    if orbit.residual > RESIDUAL_BOUND:
        raise NoOrbitError(
            f"the equations of motion are met to {orbit.residual:.1e} only, not to "
            f"{RESIDUAL_BOUND:g} (more functions may help)"
        )
    return orbit
