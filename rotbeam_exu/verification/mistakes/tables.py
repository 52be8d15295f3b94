"""Mistakes in L.csv and its like: other units, speeds and motions than were asked for."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from analytic.arrays import FloatArray

from ..case import Asked, Case
from ..judgement import THRESHOLDS
from ..references import Reference, row_of
from ..space_cases import SIGNS, TWISTED
from ..submission import Row
from .histories import UNITS, Mistake, explaining, largest
from .times import off_in_mass, said_of_mass

_Suspects = Iterator[tuple[str, str, FloatArray]]
"""Name, sentence, and the numbers that a right code hands in with the mistake."""

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


def mistake_in_table(
    case: Case, rows: Sequence[Row], reference: Reference, most: float
) -> Mistake | None:
    """Return the mistake that explains the errors of the finest mesh's numbers, if there is one.

    It leaves `most` at most.
    """
    done = [one for one in rows if one.case == case.name and not one.failure]
    finest = [one for one in done if one.elements == max(one.elements for one in done)]
    if not finest:
        return None
    values = np.concatenate([one.values for one in finest])
    true = np.concatenate([reference.numbers(one) for one in finest])
    before = largest(values / true - 1.0)
    if not before > THRESHOLDS[case.quantities[0]]:
        return None
    if case.asked is Asked.STEADY:
        suspects = _of_tips(case, true)
    else:
        suspects = _other_units(true)
        if case.asked is Asked.FREQUENCIES:
            suspects = _of_frequencies(case, finest, reference, values, true)
    left = ((name, said, largest(values / w - 1.0)) for name, said, w in suspects)
    return explaining(case.name, before, most, left)


def _of_tips(case: Case, true: FloatArray) -> _Suspects:
    """Yield steady tips of other signs and units."""
    other = "sign of the precone" if case.loads else "sign of gravity"
    for name, (said, factors) in {**SIGNS, **_STEADY_SIGNS}.items():
        if name != other:
            yield name, said, (true.reshape(-1, 3) * factors).ravel()


def _other_units(true: FloatArray) -> _Suspects:
    for name, (unit, factor) in UNITS.items():
        yield name, f"the frequencies are in {unit}: hand in rad/s", factor * true


def _of_frequencies(
    case: Case, rows: Sequence[Row], reference: Reference, values: FloatArray, true: FloatArray
) -> _Suspects:
    """Yield frequencies in other units, of other speeds and motions, and from a spectrum."""
    speeds = np.array([row.speed for row in rows])

    def at(factor: float) -> FloatArray:
        rotations = set((factor * speeds).tolist())
        frequencies = {speed: row_of(case, reference.theory, speed)[0] for speed in rotations}
        return np.array([frequencies[factor * row.speed][row.number - 1] for row in rows])

    yield from _other_units(true)
    yield "eigenvalues", "the frequencies are ω_n², eigenvalues: hand in their roots", true**2
    if case.count == 1:  # the first in the plane
        yield from _other_motions(true, speeds, float(at(0.0)[0]))
    yield from _bins(values, true)
    for name, (said, factor) in _SPEED_UNITS.items():
        if case.is_quick or not factor:
            yield name, said, at(factor)
    slowest = int(np.argmin(speeds))
    of_slowest = rows[slowest]
    root = off_in_mass(
        lambda speed: float(row_of(case, reference.theory, speed)[0][of_slowest.number - 1]),
        of_slowest.speed, float(values[slowest]),
    )  # fmt: skip
    if not math.isnan(root):
        yield "mass", said_of_mass(root), at(root) / root


def _other_motions(true: FloatArray, speeds: FloatArray, at_rest: float) -> _Suspects:
    """Yield frequencies of other motions, and of this one by another observer."""
    said = "the frequencies are those out of the plane, √(ω_n² + ω²): hand in those in the plane"
    yield "out of the plane", said, np.hypot(true, speeds)
    said = "the frequencies are those seen at rest, ω_n + ω: hand in those in the turning frame"
    yield "seen at rest", said, true + speeds
    said = "the rotation softens and does not stiffen, √(ω_0² - ω²): add the centrifugal tension"
    softened = np.sqrt(np.maximum(at_rest**2 - speeds**2, 0.0))
    yield "no centrifugal stiffening", said, np.where(softened > 0.0, softened, np.inf)


def _bins(values: FloatArray, true: FloatArray) -> _Suspects:
    """Yield what lies in a spectrum's bins: all are multiples of one width, half of it off at most.

    Three different frequencies are needed; of two a width is always found.
    """
    if np.unique(values).size < _FEWEST:
        return
    for width in values.max() / np.arange(1.0, _MOST_BINS):
        if np.abs(values - true).max() > 0.51 * width:
            return
        if np.abs(values / width - np.rint(values / width)).max() < _IN_BIN:
            said = f"the frequencies are multiples of {width:.3g} rad/s, bins of an FFT: fit q(t)"
            yield "bins", f"{said}, or run {2.0 * math.pi / width:.3g} s many times over", values
            return
