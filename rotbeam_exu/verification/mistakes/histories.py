"""Mistakes in a history: what the reference would look like with each of them."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterator, Mapping

import numpy as np

from analytic import SpinUp, spin_up_response
from analytic.arrays import FloatArray
from analytic.lazily import optimize

from ..cases import Case
from .mistake import LEFT, Mistake, explaining
from .ramps import RAMPS

SMALL = 1e-2
"""Error of q(t) over max|q| below which no mistake is looked for: what passes."""

_SAMPLES = 1500
_EARLIEST, _STEPS = 2.0, 401  # offsets that are tried [s], and how many
_RAMP_WINDOW = 4.0  # of the ramp [s]: enough to tell one from another
_SHORTENING = 0.581  # of a bent cantilever's first mode: the tip nears the clamp by this × q²/L
_LINEAR = 0.1  # |q|/L up to which a response is proportional to the speed, early in a ramp

_FACTORS: Mapping[str, tuple[str, Callable[[float], float]]] = {
    "sign of q": (
        "q has the wrong sign: it is negative while the rotation speeds up, Eq. 16",
        lambda length: -1.0,
    ),
    "q over L": ("q is over L: hand it in in metres", lambda length: 1.0 / length),
    "millimetres": ("q is in millimetres: hand it in in metres", lambda length: 1e3),
}
_UNITS = {
    "degrees": 180.0 / math.pi, "revolutions per minute": 30.0 / math.pi, "hertz": 0.5 / math.pi,
}  # fmt: skip
_UNIT_NAMES = {"degrees": "degrees", "revolutions per minute": "rpm", "hertz": "Hz"}


def mistake_in_history(
    case: Case,
    time: FloatArray,
    q: FloatArray,
    reference: Callable[[FloatArray], FloatArray],
    ramps: Collection[str] = RAMPS,
) -> Mistake | None:
    """Return the mistake that explains what a history is off by, if there is one.

    Parameters
    ----------
    case : Case
    time, q : ndarray (samples,)
        As handed in, [s] and [m].
    reference : callable
        The reference's q [m] at times [s] within the case.
    ramps : collection of str
        Wrong ramps to try, keys of RAMPS; each takes a second or two.
    """
    every = max(1, time.size // _SAMPLES)
    time, q = time[::every], q[::every]
    true = reference(time)
    scale = float(np.abs(true).max())
    before = float(np.abs(q - true).max()) / scale
    if not before > SMALL:
        return None

    def made(name: str, said: str, after: float) -> Mistake:
        return Mistake(case=case.name, name=name, said=said, before=before, after=after / scale)

    quick = [
        *(made(*one) for one in _factors(case, q, true)),
        *(made(*one) for one in _offset(case, time, q, reference)),
        *(made(*one) for one in _inertial(case, time, q, true)),
    ]
    found = explaining(quick)
    if found is not None or not isinstance(case.motion, SpinUp):
        return found
    unit = _unit_of_speed(case, q, true)
    if unit is not None:
        return made(*unit)
    return _ramp(case, case.motion, time, q, true, ramps)


def _largest(values: FloatArray) -> float:
    return float(np.abs(values).max())


def _factors(case: Case, q: FloatArray, true: FloatArray) -> Iterator[tuple[str, str, float]]:
    """Yield the best of all factors on q, by its name if it has one."""
    factor = float(q @ true / (true @ true))
    left = _largest(q - factor * true) / max(abs(factor), 1e-300)
    for name, (said, exact) in _FACTORS.items():
        if abs(factor / exact(case.blade.length) - 1.0) < LEFT:
            yield name, said, left
            return
    if factor:
        yield "factor", f"q is {factor:.5g} times the reference throughout", left


def _offset(
    case: Case, time: FloatArray, q: FloatArray, reference: Callable[[FloatArray], FloatArray]
) -> Iterator[tuple[str, str, float]]:
    """Yield the best offset of time; before the start a spin-up is at rest."""

    def left(offset: float) -> float:
        moved = time - offset
        inside = (moved >= 0.0) & (moved <= case.duration)
        rest = q[moved < 0.0] if isinstance(case.motion, SpinUp) else np.empty(0)
        return _largest(np.concatenate((q[inside] - reference(moved[inside]), rest)))

    tried = np.linspace(-_EARLIEST, _EARLIEST, _STEPS)
    best = float(tried[np.argmin([left(offset) for offset in tried])])
    width = tried[1] - tried[0]
    found = optimize.minimize_scalar(left, bounds=(best - width, best + width), method="bounded")
    word = "late" if found.x > 0.0 else "early"
    said = f"q is {abs(found.x):.4g} s {word} throughout: the ramp begins at time zero"
    if not isinstance(case.motion, SpinUp):
        said = f"q is {abs(found.x):.4g} s {word} throughout: begin where the orbit begins"
    yield "time offset", said, float(found.fun)


def _inertial(
    case: Case, time: FloatArray, q: FloatArray, true: FloatArray
) -> Iterator[tuple[str, str, float]]:
    """Yield q taken across a line that does not turn: the tip's position, or its displacement."""
    if case.motion is None:
        return
    blade, angle = case.blade, case.motion.angle(time)
    length = blade.length
    hub = getattr(blade, "hub_radius", 0.0)
    along = hub + length - _SHORTENING * true**2 / length
    position = np.sin(angle) * along + np.cos(angle) * true
    said = "q is taken along an axis that does not turn: turn it by -θ(t), q = y cos θ - x sin θ"
    straight = np.sin(angle) * (hub + length)
    yield "inertial axis", said, min(_largest(q - position), _largest(q - position + straight))


def _unit_of_speed(case: Case, q: FloatArray, true: FloatArray) -> tuple[str, str, float] | None:
    """Return the unit that the speed was taken for; while q is small it is proportional to it.

    A code may well break where it turns too fast, so that only the beginning is looked at.
    """
    large = np.maximum(np.abs(q), np.abs(true)) > _LINEAR * case.blade.length
    early = slice(0, int(np.argmax(large)) if large.any() else q.size)
    if true[early].size < 3 or not true[early].any():
        return None
    factor = float(q[early] @ true[early] / (true[early] @ true[early]))
    left = _largest(q[early] - factor * true[early])
    if left > LEFT * _largest(q[early]):
        return None
    for name, unit in _UNITS.items():
        short = _UNIT_NAMES[name]
        for size, said in (
            (unit, f"the speed was turned into {short} where rad/s are wanted"),
            (1.0 / unit, f"the speed in rad/s was taken for {short}"),
        ):
            if abs(factor / size - 1.0) < LEFT:
                return name, f"{said}: early on q is {factor:.3g} times the reference", left
    return None


def _ramp(
    case: Case,
    spin_up: SpinUp,
    time: FloatArray,
    q: FloatArray,
    true: FloatArray,
    ramps: Collection[str],
) -> Mistake | None:
    """Return the wrong ramp that explains q while the rotation speeds up."""
    during = time <= min(spin_up.ramp_time, _RAMP_WINDOW)
    scale = _largest(true[during])
    before = _largest((q - true)[during]) / scale
    if not before > SMALL:
        return None
    tried = []
    for name in ramps:
        wrong = RAMPS[name](omega=spin_up.omega, ramp_time=spin_up.ramp_time)
        try:
            made = spin_up_response(
                case.blade, wrong, time[during], tolerance=SMALL, loads=case.loads
            ).q
        except (RuntimeError, ValueError):
            continue
        after = _largest(q[during] - made) / scale
        said = f"the ramp has {name}: θ̇ = (ω/T)(t - T/(2π) sin(2πt/T))"
        tried.append(Mistake(case=case.name, name=name, said=said, before=before, after=after))
    return explaining(tried)
