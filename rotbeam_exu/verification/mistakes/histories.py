"""Mistakes in a history: the reference with each of them."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterator
from dataclasses import dataclass
from functools import partial
from typing import Any, cast

import numpy as np

from analytic import SpinUp, spin_up_response
from analytic.arrays import FloatArray
from analytic.lazily import optimize
from analytic.motion import SpeedChange

from ..cases import Case
from .forces import FORCES, without
from .mistake import LEFT, Mistake, explaining, largest

SMALL = 1e-2
"""Error of q(t) over max|q| below which no mistake is looked for: what passes."""

_SAMPLES = 1500
_EARLIEST, _STEPS = 2.0, 401  # offsets that are tried [s], and how many
_RAMP_WINDOW = 4.0  # of the ramp [s]: enough to tell one from another
_SHORTENING = 0.581  # of a bent cantilever's first mode: the tip nears the clamp by this × q²/L
_ROUGH = 0.3  # of max|q|: what a mistake leaves that may be it, in the first mode alone
_LINEAR = 0.1  # |q|/L up to which a response is proportional to the speed, early in a ramp

UNITS = {
    "degrees": ("degrees/s", 180.0 / math.pi),
    "revolutions per minute": ("rpm", 30.0 / math.pi),
    "hertz": ("Hz", 0.5 / math.pi),
}
"""Units of a speed or a frequency, and how many of them are 1 rad/s."""


@dataclass(frozen=True, kw_only=True)
class _WrongRamp(SpeedChange, abstract=True):
    """A ramp that is taken for Eq. 1's: same speed, same time, another way to it.

    `way` is, over s = t/T, the angle over ωT, the rate over ω and the acceleration over ω/T.
    """

    omega: float
    ramp_time: float
    start: float = 0.0
    way: Callable[[Any], tuple[Any, Any, Any]]

    @property
    def shortest_wave(self) -> float:  # type: ignore[override]
        """Period of the acceleration during the ramp, T [s]."""
        return self.ramp_time

    def _within(self, t: Any, derivative: int) -> Any:
        scale = self.omega * self.ramp_time ** (1 - derivative)
        return scale * self.way(t / self.ramp_time)[derivative]


def _linear(s: Any) -> tuple[Any, Any, Any]:
    return 0.5 * s**2, s, s < 1.0


def _half_cosine(s: Any) -> tuple[Any, Any, Any]:
    sine = np.sin(np.pi * s)
    return 0.5 * (s - sine / np.pi), np.sin(0.5 * np.pi * s) ** 2, 0.5 * np.pi * sine


def _smoothstep(s: Any) -> tuple[Any, Any, Any]:
    return s**3 - 0.5 * s**4, s**2 * (3.0 - 2.0 * s), 6.0 * s * (1.0 - s)


RAMPS: dict[str, Callable[..., _WrongRamp]] = {
    "a rate that grows linearly, without the sine of Eq. 1": partial(_WrongRamp, way=_linear),
    "a rate that grows as half a cosine": partial(_WrongRamp, way=_half_cosine),
    "a rate that grows by the smoothstep 3s² - 2s³": partial(_WrongRamp, way=_smoothstep),
}


@dataclass(frozen=True, kw_only=True, eq=False)
class _Seen:
    """A history that is off: samples of it and of the reference."""

    case: Case
    time: FloatArray
    q: FloatArray
    true: FloatArray
    reference: Callable[[FloatArray], FloatArray]

    def placed(self, left: Callable[[FloatArray], float]) -> float:
        """Return what is left by a mistake that wants the tip's place along the clamp's line [m].

        It is taken from the first mode, and where that explains much of a spin-up from theory.
        """
        blade, rotation = self.case.blade, cast("SpinUp", self.case.rotation)
        hub = blade.unit.hub * blade.length
        rough = left(hub + blade.length - _SHORTENING * self.true**2 / blade.length)
        if rough > _ROUGH * largest(self.true) or not self.case.is_spun_up:
            return rough
        found = spin_up_response(
            blade, rotation, self.time, tolerance=0.1 * SMALL, loads=self.case.loads
        )
        turned = (found.tip @ [1.0, 1.0j]) * np.exp(-1j * rotation.angle(self.time))
        return left(turned.real)


_Suspects = Iterator[tuple[str, str, float]]
"""Name, sentence, and the largest |q| [m] that the mistake leaves unexplained."""


def mistake_in_history(
    case: Case,
    time: FloatArray,
    q: FloatArray,
    reference: Callable[[FloatArray], FloatArray],
    ramps: Collection[str] = RAMPS,
    most: float = SMALL / 3.0,
) -> Mistake | None:
    """Return the mistake that explains the error of a history, if there is one.

    Times [s] and q [m], in space lag, flap and twist, are as handed in; `reference` gives q at
    times within the case. `ramps` are the wrong ones to try, keys of RAMPS; each takes a second or
    two. A mistake leaves `most` at most, over max|q|.
    """
    every = max(1, time.size // _SAMPLES)
    time, q = time[::every], q[::every]
    true = reference(time)
    scale = np.abs(true).max(axis=0)
    before = largest((q - true) / scale)
    if not before > SMALL:
        return None
    if case.in_space:
        tried = (
            (name, said, largest((q / factors - true) / scale))
            for name, (said, factors) in _signs_of(case).items()
        )
        return explaining(case.name, before, most, tried)
    seen = _Seen(case=case, time=time, q=q, true=true, reference=reference)
    found = explaining(
        case.name, before, most,
        ((name, said, left / scale) for of in SUSPECTS for name, said, left in of(seen)),
    )  # fmt: skip
    if found is not None or not case.is_spun_up:
        return found
    for name, said, left in _unit_of_speed(seen):
        return Mistake(case=case.name, name=name, said=said, before=before, after=left / scale)
    lacking = ((name, said, left / scale) for name, said, left in _forces(seen))
    return explaining(case.name, before, most, lacking) or _ramp(seen, ramps, most)


TWISTED = "twist is the other way round: it turns the chord from the direction of rotation up"
_OTHER = "is the other way round: lag grows along the rotation, flap up, twist from lag to flap"
SIGNS = {
    "sign of lag": (f"lag {_OTHER}", (-1.0, 1.0, 1.0)),
    "sign of flap": (f"flap {_OTHER}", (1.0, -1.0, 1.0)),
    "sign of twist": (f"twist {_OTHER}", (1.0, 1.0, -1.0)),
    "degrees": ("the twist is in degrees: hand it in in rad", (1.0, 1.0, UNITS["degrees"][1])),
}
"""Factors of lag, flap and twist by which a tip in space may be off, and what is said of them."""


def _signs_of(case: Case) -> dict[str, tuple[str, tuple[float, ...]]]:
    """Return SIGNS, and the mirror in which a blade moves that is built or kicked wrongly."""
    name, said = "sign of the blade's twist", f"the blade's {TWISTED}"
    if case.kick:
        name = "sign of the kick"
        said = "the kick is the other way round: it goes up, along the axis"
    return {**SIGNS, name: (said, (1.0, -1.0, -1.0))}


def _factors(seen: _Seen) -> _Suspects:
    """Yield the best of all factors on q, by its name if it has one."""
    factor = float(seen.q @ seen.true / (seen.true @ seen.true))
    left = largest(seen.q - factor * seen.true) / max(abs(factor), 1e-300)
    for name, said, exact in (
        ("sign of q", "q has the wrong sign: it is negative while the rotation speeds up, Eq. 16",
            -1.0),
        ("q over L", "q is over L: hand it in in metres", 1.0 / seen.case.blade.length),
        ("millimetres", "q is in millimetres: hand it in in metres", 1e3),
    ):  # fmt: skip
        if abs(factor / exact - 1.0) < LEFT:
            yield name, said, left
            return
    if factor:
        yield "factor", f"q is {factor:.5g} times the reference throughout", left


def _offset(seen: _Seen) -> _Suspects:
    """Yield the best offset of time; before the start a spin-up is at rest."""
    case, q = seen.case, seen.q

    def left(offset: float) -> float:
        moved = seen.time - offset
        inside = (moved >= 0.0) & (moved <= case.duration)
        rest = q[moved < 0.0] if case.is_spun_up else np.empty(0)
        return largest(np.concatenate((q[inside] - seen.reference(moved[inside]), rest)))

    tried = np.linspace(-_EARLIEST, _EARLIEST, _STEPS)
    best = float(tried[np.argmin([left(offset) for offset in tried])])
    width = tried[1] - tried[0]
    found = optimize.minimize_scalar(left, bounds=(best - width, best + width), method="bounded")
    word = "late" if found.x > 0.0 else "early"
    begin = "the ramp begins at time zero" if case.is_spun_up else "begin where the orbit begins"
    yield "time offset", f"q is {abs(found.x):.4g} s {word} throughout: {begin}", float(found.fun)


def _inertial(seen: _Seen) -> _Suspects:
    """Yield q taken across a line that does not turn: the tip's position, or its displacement."""
    blade, angle = seen.case.blade, seen.case.rotation.angle(seen.time)
    reach = (1.0 + blade.unit.hub) * blade.length

    def left(along: FloatArray) -> float:
        off = seen.q - np.sin(angle) * along - np.cos(angle) * seen.true
        return min(largest(off), largest(off + np.sin(angle) * reach))

    said = "q is taken along an axis that does not turn: turn it by -θ(t), q = y cos θ - x sin θ"
    yield "inertial axis", said, seen.placed(left)


def _angle(seen: _Seen) -> _Suspects:
    """Yield the tip's angle from the clamp's line: in degrees, radians, or times the length."""
    length = seen.case.blade.length
    for name, said, unit in (
        ("degrees", "q is the tip's angle in degrees", 180.0 / math.pi),
        ("radians", "q is the tip's angle in radians", 1.0),
        ("arc", "q is the tip's angle times the length", length),
    ):

        def left(along: FloatArray, unit: float = unit) -> float:
            return largest(seen.q / unit - np.arctan2(seen.true, along)) * length

        remedy = "hand in the distance across the clamp's line, Eq. 16"
        yield name, f"{said}: {remedy}", seen.placed(left)


SUSPECTS = _factors, _offset, _inertial, _angle
"""Mistakes of any history; mistakes of spin-ups are tried if none of these explains it."""


def _unit_of_speed(seen: _Seen) -> _Suspects:
    """Yield the unit that the speed was taken for; while q is small it is proportional to it.

    A code may well break where it turns too fast, so that only the beginning is looked at.
    """
    large = np.maximum(np.abs(seen.q), np.abs(seen.true)) > _LINEAR * seen.case.blade.length
    early = slice(0, int(np.argmax(large)) if large.any() else seen.q.size)
    q, true = seen.q[early], seen.true[early]
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
                yield name, f"{said}: early on q is {factor:.3g} times the reference", left
                return


def _forces(seen: _Seen) -> _Suspects:
    """Yield spin-ups without a force of the rotation."""
    for name, (said, _) in FORCES.items():
        try:
            yield name, said, largest(seen.q - without(name, seen.case, seen.time))
        except RuntimeError:
            continue


def _ramp(seen: _Seen, ramps: Collection[str], most: float) -> Mistake | None:
    """Return the wrong ramp that explains q while the rotation speeds up."""
    case = seen.case
    during = seen.time <= min(case.ramp_time, _RAMP_WINDOW)
    time, q, true = seen.time[during], seen.q[during], seen.true[during]
    scale = largest(true)
    before = largest(q - true) / scale
    if not before > SMALL:
        return None
    tried = []
    for name in ramps:
        wrong = RAMPS[name](omega=case.rotation.omega, ramp_time=case.ramp_time)
        try:
            made = spin_up_response(
                case.blade, wrong, time, tolerance=0.1 * SMALL, loads=case.loads
            ).q
        except (RuntimeError, ValueError):
            continue
        said = f"the ramp has {name}: θ̇ = (ω/T)(t - T/(2π) sin(2πt/T))"
        tried.append((name, said, largest(q - made) / scale))
    return explaining(case.name, before, most, tried)
