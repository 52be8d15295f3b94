"""Mistakes in L.csv and B.csv: other units, other speeds, other amplitudes than were asked for."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from analytic import periodic_orbits
from analytic.arrays import FloatArray

from ..cases import Asked, Case
from ..judgement import THRESHOLDS
from ..references import Reference, row_of
from ..submission import Row
from .histories import SIGNS, TWISTED, UNITS
from .mistake import Mistake, explaining, largest

_Suspects = Iterator[tuple[str, str, FloatArray]]
"""Name, sentence, and the frequencies that a right code hands in with the mistake."""

SMALL_OF_SHIFT = 1e-2
"""Error of a backbone over the largest shift below which no mistake is looked for: a first harmonic
for a peak is 5 % at 0.6. Of other tables it is what passes."""

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


@dataclass(frozen=True, kw_only=True, eq=False)
class _Seen:
    """The finest mesh's rows of a table, their numbers in one row, and the exact ones."""

    case: Case
    rows: list[Row]
    reference: Reference
    found: FloatArray
    true: FloatArray

    def of_rows(self, name: str) -> FloatArray:
        """Return an attribute of all rows."""
        return np.array([getattr(row, name) for row in self.rows])

    @property
    def linear(self) -> FloatArray:
        """ω_n at the rows' speeds [rad/s]."""
        return np.array([self.reference.first_frequency(row.speed) for row in self.rows])


def mistake_in_table(
    case: Case, rows: Sequence[Row], reference: Reference, most: float
) -> Mistake | None:
    """Return the mistake that explains the errors of the finest mesh's numbers, if there is one.

    It leaves `most` at most, of backbones over the largest shift at a speed.
    """
    done = [one for one in rows if one.case == case.name and not one.failure]
    finest = [one for one in done if one.elements == max(one.elements for one in done)]
    if not finest:
        return None
    found = np.concatenate([one.values for one in finest])
    true = np.concatenate([reference.numbers(one) for one in finest])
    seen = _Seen(case=case, rows=finest, reference=reference, found=found, true=true)
    suspects, small, scale = _of_frequencies, THRESHOLDS[case.quantities[0]], np.ones(true.size)
    if case.asked is Asked.STEADY:
        suspects = _of_tips
    elif case.asked is Asked.BACKBONE:
        shift, speeds = true / seen.linear - 1.0, seen.of_rows("speed")
        scale = np.array([largest(shift[speeds == speed]) for speed in speeds])
        suspects, small = _of_backbones, SMALL_OF_SHIFT
    before = largest((found / true - 1.0) / scale)
    if not before > small:
        return None
    left = ((name, said, largest((found / w - 1.0) / scale)) for name, said, w in suspects(seen))
    return explaining(case.name, before, most, left)


def _of_frequencies(seen: _Seen) -> _Suspects:
    """Yield frequencies in other units, of other speeds and motions, and from a spectrum."""
    case, true, speeds = seen.case, seen.true, seen.of_rows("speed")

    def at(factor: float) -> FloatArray:
        theory, wanted = seen.reference.theory, set((factor * speeds).tolist())
        known = {speed: row_of(case, theory, speed)[0] for speed in wanted}
        return np.array([known[factor * row.speed][row.number - 1] for row in seen.rows])

    yield from _other_units(true)
    yield "eigenvalues", "the frequencies are ω_n², eigenvalues: hand in their roots", true**2
    if not case.in_space and any(case.speeds):
        yield from _other_motions(true, speeds, float(at(0.0)[0]))
    yield from _bins(seen.found, true)
    for name, (said, factor) in _SPEED_UNITS.items() if any(case.speeds) else ():
        if not case.in_space or not factor:  # whose modes take a tenth of a second
            yield name, said, at(factor)


def _of_tips(seen: _Seen) -> _Suspects:
    """Yield steady tips of other signs and units."""
    other = "sign of the precone" if seen.case.loads else "sign of gravity"
    for name, (said, factors) in {**SIGNS, **_STEADY_SIGNS}.items():
        if name != other:
            yield name, said, seen.true * np.tile(factors, len(seen.rows))


def _of_backbones(seen: _Seen) -> _Suspects:
    """Yield backbones in other units, and over other amplitudes."""
    a = seen.of_rows("amplitude")
    yield from _other_units(seen.true)
    yield "linear frequency", "the frequencies are ω_n, whatever the amplitude", seen.linear
    said = "the amplitudes are those of the first harmonic: hand in the peak, max|q|/L"
    yield "first harmonic", said, _of_orbits(seen, a, first_harmonic=True)
    said = "the amplitudes are from peak to peak: hand in the peak, max|q|/L"
    yield "peak to peak", said, _of_orbits(seen, 0.5 * a)


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


def _of_orbits(seen: _Seen, a: FloatArray, first_harmonic: bool = False) -> FloatArray:
    """Return the exact frequencies at peaks or first harmonics; where there is none, infinity."""
    found, speeds = np.full(a.size, np.inf), seen.of_rows("speed")
    for speed in np.unique(speeds):
        here = speeds == speed
        wanted = np.unique(a[here])
        try:
            # A first harmonic is up to 3 % larger than the peak.
            peaks = np.union1d(wanted, 0.97 * wanted) if first_harmonic else wanted
            orbits = periodic_orbits(seen.case.blade, float(speed), peaks)
        except (RuntimeError, ValueError):
            continue
        sizes = orbits.first_harmonic if first_harmonic else orbits.amplitude
        # Frequencies are nearly linear in a².
        found[here] = np.interp(a[here] ** 2, sizes**2, orbits.frequency)
    return found
