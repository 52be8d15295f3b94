"""Mistakes in L.csv and B.csv: other units, other speeds, other amplitudes than were asked for."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import TypeVar

import numpy as np

from analytic import periodic_orbits
from analytic.arrays import FloatArray

from ..cases import Asked, Case
from ..judgement import THRESHOLDS
from ..references import Reference, row_of
from ..submission import BackbonePoint, Frequency, SteadyTip
from .histories import SIGNS, TWISTED, UNITS
from .mistake import Mistake, explaining, largest

Row = TypeVar("Row", Frequency | SteadyTip, BackbonePoint)
_Suspects = Iterator[tuple[str, str, FloatArray]]
"""Name, sentence, and the frequencies that a right code hands in with the mistake."""

SMALL = THRESHOLDS["linear frequency"]
"""Relative error of a frequency below which no mistake is looked for: what passes."""

SMALL_OF_SHIFT = 1e-2
"""The same of backbones, over the largest shift: a first harmonic for a peak is 5 % at 0.6."""

_MOST_BINS, _IN_BIN, _FEWEST = 300, 1e-3, 3
"""Bins up to a frequency that are tried, how far off one it may be, and how many frequencies."""

_SPEED_UNITS = {
    "degrees": ("the speeds in rad/s were taken for degrees/s", math.pi / 180.0),
    "revolutions per minute": ("the speeds in rad/s were taken for rpm", math.pi / 30.0),
    "no rotation": ("the frequencies are those at rest, whatever the speed", 0.0),
}


_STEADY_SIGNS = {
    "sign of the precone": ("the precone tilts the blade down: it lifts it", (-1.0, -1.0, 1.0)),
    "sign of gravity": ("gravity lifts the blade: it points down", (-1.0, -1.0, 1.0)),
    "sign of the blade's twist": (f"the blade's {TWISTED}", (-1.0, 1.0, -1.0)),
}
"""Signs of a steady tip after a half turn about the blade, and after a mirror."""


def mistake_in_frequencies(
    case: Case,
    rows: Sequence[Frequency | SteadyTip],
    reference: Reference,
    most: float = THRESHOLDS["linear frequency"] / 3.0,
) -> Mistake | None:
    """Return the mistake that explains the errors of the finest mesh's frequencies or tips."""
    done = [one for one in rows if one.case == case.name and not one.failure]
    finest = _finest(done) if done else []
    places = [
        (one.speed, place, value) for one in finest for place, (value, _) in one.values.items()
    ]
    if not places:
        return None
    found = np.array([value for *_, value in places])

    def of(factor: float) -> FloatArray:
        speeds = {factor * speed for speed, *_ in places}
        known = {speed: row_of(case, reference.theory, speed)[0] for speed in speeds}
        return np.array([known[factor * speed][place] for speed, place, _ in places])

    def suspects() -> _Suspects:
        if case.asked is Asked.STEADY:
            other = "sign of the precone" if case.loads else "sign of gravity"
            for name, (said, factors) in {**SIGNS, **_STEADY_SIGNS}.items():
                if name != other:
                    yield name, said, true * [factors[place] for _, place, _ in places]
            return
        yield from _other_units(true)
        yield "eigenvalues", "the frequencies are ω_n², eigenvalues: hand in their roots", true**2
        speeds = np.array([speed for speed, *_ in places])
        if not case.in_space and any(case.speeds):
            yield from _other_motions(true, speeds, float(of(0.0)[0]))
        yield from _bins(found, true)
        for name, (said, factor) in _SPEED_UNITS.items() if any(case.speeds) else ():
            if not case.in_space or not factor:  # whose modes take a tenth of a second
                yield name, said, of(factor)

    true = np.array([reference.row(speed)[place] for speed, place, _ in places])
    (quantity,) = case.quantities
    small = THRESHOLDS[quantity]
    return _explaining(case, found, true, np.ones(true.size), small, most, suspects())


def mistake_in_backbone(
    case: Case, rows: Sequence[BackbonePoint], reference: Reference, most: float = SMALL_OF_SHIFT
) -> Mistake | None:
    """Return the mistake that explains the error of the finest mesh's backbones."""
    points = _finest(rows)
    true = np.array([reference.frequency_at(one.amplitude, one.speed) for one in points])
    linear = np.array([reference.first_frequency(one.speed) for one in points])
    scale = np.array([largest((true / linear - 1.0)[_at(points, one.speed)]) for one in points])

    def suspects() -> _Suspects:
        yield from _other_units(true)
        yield "linear frequency", "the frequencies are ω_n, whatever the amplitude", linear
        a = np.array([one.amplitude for one in points])
        said = "the amplitudes are those of the first harmonic: hand in the peak, max|q|/L"
        yield "first harmonic", said, _of_orbits(case, points, a, first_harmonic=True)
        said = "the amplitudes are from peak to peak: hand in the peak, max|q|/L"
        yield "peak to peak", said, _of_orbits(case, points, 0.5 * a)

    found = np.array([one.frequency for one in points])
    return _explaining(case, found, true, scale, SMALL_OF_SHIFT, most, suspects())


def _explaining(
    case: Case,
    found: FloatArray,
    true: FloatArray,
    scale: FloatArray,
    small: float,
    most: float,
    suspects: _Suspects,
) -> Mistake | None:
    """Return the mistake that explains what frequencies are off by, relative to `scale`."""
    before = largest((found / true - 1.0) / scale)
    if not before > small:
        return None
    left = ((name, said, largest((found / w - 1.0) / scale)) for name, said, w in suspects)
    return explaining(case.name, before, most, left)


def _other_motions(true: FloatArray, speeds: FloatArray, at_rest: float) -> _Suspects:
    """Yield frequencies of other motions, and of this one by another observer."""
    said = "the frequencies are those out of the plane, √(ω_n² + ω²): hand in those in the plane"
    yield "out of the plane", said, np.hypot(true, speeds)
    said = "the frequencies are those seen at rest, ω_n + ω: hand in those in the turning frame"
    yield "seen at rest", said, true + speeds
    said = "the rotation softens and does not stiffen, √(ω_0² - ω²): add the centrifugal tension"
    softened = np.sqrt(np.maximum(at_rest**2 - speeds**2, 0.0))
    yield "no centrifugal stiffening", said, np.where(softened > 0.0, softened, np.inf)


def _bins(found: FloatArray, true: FloatArray) -> _Suspects:
    """Yield what lies in a spectrum's bins: all are multiples of one width, half of it off at most.

    Three different frequencies are needed; of two a width is always found.
    """
    if np.unique(found).size < _FEWEST:
        return
    for width in found.max() / np.arange(1.0, _MOST_BINS):
        if np.abs(found - true).max() > 0.51 * width:
            return
        if np.abs(found / width - np.rint(found / width)).max() < _IN_BIN:
            said = f"the frequencies are multiples of {width:.3g} rad/s, bins of an FFT: fit q(t)"
            yield "bins", f"{said}, or run {2.0 * math.pi / width:.3g} s many times over", found
            return


def _other_units(true: FloatArray) -> _Suspects:
    for name, (unit, factor) in UNITS.items():
        yield name, f"the frequencies are in {unit}: hand in rad/s", factor * true


def _of_orbits(
    case: Case, points: Sequence[BackbonePoint], a: FloatArray, first_harmonic: bool = False
) -> FloatArray:
    """Return the exact frequencies at peaks or first harmonics; where there is none, infinity."""
    found = np.full(a.size, np.inf)
    for speed in {one.speed for one in points}:
        here = _at(points, speed)
        wanted = np.unique(a[here])
        try:
            # A first harmonic is up to 3 % larger than the peak.
            peaks = np.union1d(wanted, 0.97 * wanted) if first_harmonic else wanted
            orbits = periodic_orbits(case.blade, speed, peaks)
        except (RuntimeError, ValueError):
            continue
        sizes = orbits.first_harmonic if first_harmonic else orbits.amplitude
        # Frequencies are nearly linear in a².
        found[here] = np.interp(a[here] ** 2, sizes**2, orbits.frequency)
    return found


def _at(points: Sequence[BackbonePoint], speed: float) -> np.ndarray[tuple[int], np.dtype[np.bool]]:
    return np.array([one.speed == speed for one in points])


def _finest(rows: Sequence[Row]) -> list[Row]:
    most = max(one.elements for one in rows)
    return [one for one in rows if one.elements == most]
