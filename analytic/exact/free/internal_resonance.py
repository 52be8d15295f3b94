"""Internal resonance: a harmonic of an orbit meets another mode.

Small motion about an orbit of frequency Ω has frequencies of its own, ν_j, which its Floquet
multipliers exp(2πi ν_j/Ω) show. Harmonic k drives mode j where ν_j = kΩ: the multiplier is 1.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from ...arrays import FloatArray
from ...methods.floquet import floquet_multipliers
from ...methods.newton import NoOrbitError
from ...warning import warn
from ..continuum.rotation import BladeOrbit
from .path import ModePath

_NEAR = 0.1  # an internal resonance is this near: turns a period from the whole number
_PERHAPS = 0.1  # how far a mode's frequency about an orbit is from the linear one's, at most
_FELT = 1e-7  # size of a harmonic of the gauge, over the first, that is no round-off
_LOOKS = 6
_CLOSE = 5e-3  # amplitudes that pin a resonance down
_INSIDE = 0.25  # of what is between two, from either
FOLLOWED = "use backbone(...).branch to follow the branches"
_NOTICEABLE = 1e-3  # size of a harmonic, relative to the first, that can drive another mode


class Resonance(NamedTuple):
    """An internal resonance on a backbone.

    Attributes
    ----------
    harmonic : int
        Of the orbit.
    mode : str
        Name of the mode that it meets.
    amplitude : float
        Peak |q|/L.
    frequency : float
        Of the orbit [rad/s].
    """

    harmonic: int
    mode: str
    amplitude: float
    frequency: float


def frequency_ratios(of: ModePath, orbits: Sequence[BladeOrbit]) -> tuple[list[str], FloatArray]:
    """Return the names of the lowest other modes, and their ν_j/Ω (orbits, modes) about orbits.

    They ascend along the path of a mode. Multipliers leave open how many turns a mode makes in a
    period; it is followed in the square of the amplitude.
    """
    others = _others(of)
    squares = np.array([0.0, *(orbit.amplitude**2 for orbit in orbits)])
    ratios = [of.modes[others] / of.modes[of.place]]
    for i, orbit in enumerate(orbits, start=1):
        expected = ratios[-1]
        if i > 1:
            slope = (ratios[-1] - ratios[-2]) / (squares[i - 1] - squares[i - 2])
            expected = expected + slope * (squares[i] - squares[i - 1])
        ratios.append(_nearest(orbit, expected))
    return [of.names[j] for j in others], np.array(ratios[1:])


def _others(of: ModePath) -> list[int]:
    """Return the places of the lowest four other modes."""
    return [j for j in range(min(5, of.modes.size)) if j != of.place]


def _nearest(orbit: BladeOrbit, expected: FloatArray) -> FloatArray:
    turns = _turns(orbit, expected.size)
    above = np.round(expected - turns) + turns
    below = np.round(expected + turns) - turns
    nearer = np.abs(above - expected) < np.abs(below - expected)
    return np.where(nearer, above, below)


def _turns(orbit: BladeOrbit, count: int) -> FloatArray:
    """Return how far each mode's multiplier is from 1, in turns, 0 to ½, without the own mode."""
    multipliers = floquet_multipliers(orbit, modes=count + 1)
    # Two for each mode, after the orbit's own.
    return np.asarray(np.abs(np.angle(multipliers.values[2::2])) / (2.0 * np.pi))


def resonances_along(of: ModePath, orbits: Sequence[BladeOrbit]) -> list[Resonance]:
    """Return the internal resonances between successive orbits."""
    others, ratios = frequency_ratios(of, orbits)
    met: list[Resonance] = []
    for i, pair in enumerate(pairwise(ratios)):
        for j, before, after in zip(others, *pair, strict=True):
            low, high = sorted((float(before), float(after)))
            for k in range(math.floor(low) + 1, math.floor(high) + 1):
                if not _drives(orbits[i], k):
                    continue
                share = (k - before) / (after - before)
                here, there = (orbit.amplitude for orbit in orbits[i : i + 2])
                a = float(here + share * (there - here))
                a = _pole(orbits[max(i - 1, 0) : i + 3], k) or a
                frequency = frequency_at(orbits, a) * of.blade.frequency_scale
                met.append(Resonance(k, j, a, frequency))
    return sorted(met, key=lambda one: one.amplitude)


def frequency_at(orbits: Sequence[BladeOrbit], amplitude: float) -> float:
    """Return the frequency at an amplitude, by straight lines between ascending orbits."""
    return float(np.interp(amplitude, *np.array([(o.amplitude, o.frequency) for o in orbits]).T))


def _pole(orbits: Sequence[BladeOrbit], k: int) -> float | None:
    """Return the amplitude at which harmonic k changes its sign through infinity, if it does.

    There the mode is in resonance; ratios are held back from the whole number next to it.
    """
    for last, orbit in pairwise(orbits):
        if k > min(last.harmonics, orbit.harmonics):
            continue
        before, after = (o.gauge_harmonics[k] / o.gauge_harmonics[1] for o in (last, orbit))
        if (before * after.conj()).real < 0.0 and min(abs(before), abs(after)) > _FELT:
            share = (1.0 / abs(before)) / (1.0 / abs(before) + 1.0 / abs(after))
            return float(last.amplitude + share * (orbit.amplitude - last.amplitude))
    return None


def pinned(
    at: Callable[[float], BladeOrbit], orbits: Sequence[BladeOrbit], resonance: Resonance
) -> tuple[list[BladeOrbit], float]:
    """Return more orbits next to a resonance, as near as they are found, and its amplitude.

    The harmonic's share without the resonance shifts the pole that two far orbits give.
    """
    k, place = resonance.harmonic, resonance.amplitude
    i = sum(orbit.amplitude < place for orbit in orbits)
    if not 0 < i < len(orbits):
        return [], place
    (below, above), halves = orbits[i - 1 : i + 1], list[BladeOrbit]()
    while (pole := _pole((below, above), k)) is not None:
        place, gap = pole, above.amplitude - below.amplitude
        if gap < _CLOSE:
            break
        inside = min(max(pole, below.amplitude + _INSIDE * gap), above.amplitude - _INSIDE * gap)
        try:
            halves.append(at(inside))
        except NoOrbitError:
            break
        if (halves[-1].gauge_harmonics[k] * below.gauge_harmonics[k].conj()).real > 0.0:
            below = halves[-1]
        else:
            above = halves[-1]
    return halves, place


def _drives(orbit: BladeOrbit, k: int) -> bool:
    """Return whether the orbit has harmonic k at all: some have no even ones."""
    return k % 2 == 1 or bool(orbit.system.model.skews(orbit.system.rate))


def nearest_resonance(of: ModePath, orbits: Sequence[BladeOrbit]) -> str:
    """Return which harmonic is nearest to another mode at the last orbit: why a branch bends."""
    others, ratios = frequency_ratios(of, orbits)
    # Slower modes have no harmonic to meet.
    distance = np.where(ratios[-1] > 1.5, np.abs(np.round(ratios[-1]) / ratios[-1] - 1.0), np.inf)
    # The higher a harmonic, the less it is felt.
    nearest = int(np.argmin(distance * ratios[-1] ** 2))
    return (
        f" (harmonic {round(float(ratios[-1, nearest]))} is {100.0 * distance[nearest]:.1f} % from "
        f"{others[nearest]} there)"
    )


def prominent_harmonics(of: ModePath, orbit: BladeOrbit) -> list[int]:
    """Return the harmonics larger than the one before that may be near another mode."""
    others, sizes = of.modes[_others(of)], orbit.sizes
    return [
        k + 1
        for k in range(2, sizes.size)
        if sizes[k] > max(sizes[k - 1], _NOTICEABLE * sizes[0])
        and np.any(np.abs(others / orbit.frequency / (k + 1) - 1.0) < _PERHAPS)
    ]


def warn_of_resonances(of: ModePath, orbits: Iterable[BladeOrbit]) -> None:
    """Warn once for each harmonic that stands out of an orbit's series and meets another mode."""
    others = _others(of)
    suspects = [(orbit, ks) for orbit in orbits if (ks := prominent_harmonics(of, orbit))]
    # Multipliers cost more than an orbit does: of very many a few are looked at.
    looked = np.unique(np.linspace(0, len(suspects) - 1, _LOOKS).round().astype(int))
    warned: set[tuple[int, str]] = set()
    for orbit, harmonics in [suspects[i] for i in looked.tolist()] if suspects else []:
        turns = _turns(orbit, len(others))
        for k in harmonics:
            # Of the modes whose linear frequency is not far, that whose multiplier is nearest 1.
            near = [
                (float(t), of.names[j])
                for t, j in zip(turns, others, strict=True)
                if abs(of.modes[j] / orbit.frequency / k - 1.0) < _PERHAPS and t < _NEAR
            ]
            if not near or (k, min(near)[1]) in warned:
                continue
            distance, j = min(near)
            warned.add((k, j))
            warn(
                f"internal resonance: from a = {orbit.amplitude:g} on, harmonic {k} of the orbit "
                f"of {of.mode} ({k * orbit.frequency * of.blade.frequency_scale:.4f} rad/s) is "
                f"{100.0 * distance / k:.1f} % from {j} (from Floquet exponents): "
                f"{FOLLOWED}"
            )
