"""Mistakes in a history: the reference with each of them."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Iterator
from dataclasses import dataclass
from itertools import chain

import numpy as np

from analytic import SpeedTable, SpinUp, spin_up_response
from analytic.arrays import FloatArray

from ..case import Case
from .forces import FORCES, without
from .times import delays, of_another_mass

SMALL = 1e-2
"""Error of q(t) over max|q| below which no mistake is looked for: what passes."""

LEFT = 0.2
"""Share of the error that may be left by what explains it; meshes and steps have a share in it."""

SURE = 0.1
"""Share of what a mistake may leave, below which no other is looked for."""

_SAMPLES = 1500
_RAMP_WINDOW = 4.0  # of the ramp [s]: enough to tell one from another
_LINEAR = 0.1  # |q|/L up to which a response is proportional to the speed, early in a ramp

UNITS = {
    "degrees": ("degrees/s", 180.0 / math.pi),
    "revolutions per minute": ("rpm", 30.0 / math.pi),
    "hertz": ("Hz", 0.5 / math.pi),
}
"""Units of a speed or a frequency, and how many of them are 1 rad/s."""

_COSINE = np.linspace(0.0, 1.0, 25)
RAMPS = {
    "a rate that grows linearly, without the sine of Eq. 1": (
        (0.0, 0.01, 0.99, 1.0), (0.0, 0.01, 0.99, 1.0)
    ),
    "a rate that grows as half a cosine": (_COSINE, np.sin(0.5 * np.pi * _COSINE) ** 2),
    "a rate that grows by the smoothstep 3s² - 2s³": ((0.0, 1.0), (0.0, 1.0)),
}  # fmt: skip
"""Ramps that are taken for Eq. 1's: times over T, and speeds over ω, of a `SpeedTable`."""


@dataclass(frozen=True, kw_only=True)
class Mistake:
    """An explanation of the error of a case.

    Attributes
    ----------
    case : str
    name : str
        Of the mistake, the same in all cases: "sign of q".
    said : str
        What seems to have happened, and what to do.
    before, after : float
        Errors with it and without it, both over the same scale.
    """

    case: str
    name: str
    said: str
    before: float
    after: float

    def __str__(self) -> str:
        return f"{self.said} (error {self.before:.1e}, without it {self.after:.1e})"


def explaining(
    case: str, before: float, most: float, suspects: Iterable[tuple[str, str, float]]
) -> Mistake | None:
    """Return the mistake with the least error, if that is `most` at most and explains the whole.

    Suspects are names, sentences and what each leaves. They are dear to compute, so that one which
    leaves far less than it may is the last.
    """
    allowed = min(most, LEFT * before)
    name, said, after = "", "", math.inf
    for suspect in suspects:
        if suspect[2] < after:
            name, said, after = suspect
        if after < SURE * allowed:
            break
    if not after <= allowed:
        return None
    return Mistake(case=case, name=name, said=said, before=before, after=after)


def largest(values: FloatArray) -> float:
    """Return the largest absolute value."""
    return float(np.abs(values).max())


@dataclass(frozen=True, kw_only=True, eq=False)
class _Samples:
    """A history that is off: samples of it and of the reference."""

    case: Case
    time: FloatArray
    q: FloatArray
    true: FloatArray

    @property
    def scale(self) -> FloatArray:
        """The largest |q| of the reference [m], of each component."""
        return np.asarray(np.abs(self.true).max(axis=0))


_Suspects = Iterator[tuple[str, str, float]]
"""Name, sentence, and the largest |q| over the scale that the mistake leaves unexplained."""


def mistake_in_history(
    case: Case,
    time: FloatArray,
    q: FloatArray,
    true: FloatArray,
    ramps: Collection[str] = RAMPS,
    most: float = SMALL / 3.0,
    step: float = math.nan,
) -> Mistake | None:
    """Return the mistake that explains the error of a history, if there is one.

    Times [s] and q [m], in space lag, flap and twist, are as handed in, and `true` is the reference
    there. `ramps` are the wrong ones to try, keys of RAMPS; each takes a second or two. A mistake
    leaves `most` at most, over max|q|. Of what is off by less than passes a delay alone is named.
    """
    every = max(1, time.size // _SAMPLES)
    history = _Samples(case=case, time=time[::every], q=q[::every], true=true[::every])
    before = largest((history.q - history.true) / history.scale)
    late = delays(case, time, q, true, step)
    if not before > SMALL:
        return explaining(case.name, before, most, late)
    suspects = chain(_slips(history), _inertial(history), late)
    mistake = explaining(case.name, before, most, suspects)
    if mistake is not None or not (case.is_spun_up and case.is_quick):
        return mistake
    for name, said, left in _unit_of_speed(history):
        return Mistake(case=case.name, name=name, said=said, before=before, after=left)
    scaled = of_another_mass(case, time, q, true)
    return explaining(case.name, before, most, chain(scaled, _forces(history))) or _ramp(
        history, ramps, most
    )


def _slips(history: _Samples) -> _Suspects:
    """Yield factors by which the columns are off."""
    for name, (said, factors) in history.case.slips.items():
        off = history.q / np.array(factors) - history.true
        yield name, said, largest(off / history.scale)


def _inertial(history: _Samples) -> _Suspects:
    """Yield q taken across a line that does not turn: the tip's position, or its displacement."""
    case = history.case
    if not (case.is_spun_up and case.is_quick) or largest(history.q) < 0.5 * case.blade.length:
        return  # a tip that turns goes farther
    response = spin_up_response(
        case.blade, case.spin_up, history.time, tolerance=0.1 * SMALL, loads=case.loads
    )
    reach = case.blade.hub_radius + case.blade.length
    off = history.q - response.from_axis[:, 1]
    moved = off + reach * np.sin(case.spin_up.angle(history.time))
    said = "q is taken along an axis that does not turn: turn it by -θ(t), q = y cos θ - x sin θ"
    yield "inertial axis", said, min(largest(off / history.scale), largest(moved / history.scale))


def _unit_of_speed(history: _Samples) -> _Suspects:
    """Yield the unit that the speed was taken for; while q is small it is proportional to it.

    A code may well break where it turns too fast, so that only the beginning is looked at.
    """
    large = (
        np.maximum(np.abs(history.q), np.abs(history.true)) > _LINEAR * history.case.blade.length
    )
    early = slice(0, int(np.argmax(large)) if large.any() else history.q.size)
    q, true = history.q[early], history.true[early]
    if true.size < 3 or not true.any():
        return
    factor = float(q @ true / (true @ true))
    left = largest(q - factor * true)
    if left > LEFT * largest(q):
        return
    for name, (short, unit) in UNITS.items():
        for size, said in (
            (unit, f"the speed was turned into {short} where rad/s are wanted"),
            (1.0 / unit, f"the speed in rad/s was taken for {short}"),
        ):
            if abs(factor / size - 1.0) < LEFT:
                sentence = f"{said}: early on q is {factor:.3g} times the reference"
                yield name, sentence, left / float(history.scale)
                return


def _forces(history: _Samples) -> _Suspects:
    """Yield spin-ups without a force of the rotation."""
    for name, (said, _) in FORCES.items():
        try:
            q = without(name, history.case, history.time)
        except RuntimeError:
            continue
        yield name, said, largest((history.q - q) / history.scale)


def _ramp(history: _Samples, ramps: Collection[str], most: float) -> Mistake | None:
    """Return the wrong ramp that explains q while the rotation speeds up."""
    case = history.case
    if type(case.rotation) is not SpinUp:
        return None
    during = history.time <= min(case.ramp_time, _RAMP_WINDOW)
    time, q, true = history.time[during], history.q[during], history.true[during]
    scale = largest(true)
    before = largest(q - true) / scale
    if not before > SMALL:
        return None
    tried = []
    for name in ramps:
        times, speeds = map(np.array, RAMPS[name])
        end, omega = case.ramp_time, case.rotation.omega
        wrong = SpeedTable((end * times).tolist(), (omega * speeds).tolist())
        try:
            made = spin_up_response(
                case.blade, wrong, time, tolerance=0.1 * SMALL, loads=case.loads
            ).q
        except (RuntimeError, ValueError):
            continue
        said = f"the ramp has {name}: θ̇ = (ω/T)(t - T/(2π) sin(2πt/T))"
        tried.append((name, said, largest(q - made) / scale))
    return explaining(case.name, before, most, tried)
