"""Mistakes by which the reference is met at other times: a delay, and a wrong mass or stiffness.

A blade of g times the mass moves as the right one does where its time is t/√g: its spin-up is
that of the right blade to √g ω in T/√g, and its frequency at a speed ω is the right blade's at
√g ω, over √g. A stiffness that is g times smaller does the same, but for what EA is worth.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from functools import partial

import numpy as np

from analytic import SpinUp, spin_up_response
from analytic.arrays import FloatArray
from analytic.lazily import interpolate, optimize

from ...runs.oscillation import oscillation_of
from ..case import Case

_LATEST = 0.125
"""Delay that is looked for, in periods of the first mode: beyond it lies another mistake."""

_TRIED = 101
_ONE_STEP = 0.05  # share of a step or a sample by which a delay is taken for it

_MOST_OFF = 0.5 * math.log(4.0)  # of ln √g: factors of units are larger
_CORRECTIONS = 3
_FOUND = 1e-6  # of √g, in the fixed point that frequencies have


def delays(
    case: Case, time: FloatArray, q: FloatArray, true: FloatArray, step: float
) -> Iterator[tuple[str, str, float]]:
    """Yield the delay by which q(t) is nearest to the reference, and what it leaves over max|q|.

    q and `true` are [m] at times [s], in space (samples, 3); a step [s] may be NaN.
    """
    most = _LATEST * 2.0 * math.pi / _first(case, case.rotation.omega)
    shape, scale = interpolate.CubicSpline(time, true), np.abs(true).max(axis=0)
    within = (time >= most) & (time <= time[-1] - most)
    if not within.any():
        return

    def left(delay: float) -> float:
        return float(np.abs((q[within] - shape(time[within] - delay)) / scale).max())

    tried = np.linspace(-most, most, _TRIED)
    nearest = tried[int(np.argmin([left(one) for one in tried]))]
    gap = tried[1] - tried[0]
    delay = optimize.minimize_scalar(
        left, bounds=(nearest - gap, nearest + gap), method="bounded", options={"xatol": 1e-6 * gap}
    ).x
    said = f"q(t) is {1e3 * abs(delay):.2g} ms {'late' if delay > 0.0 else 'early'}"
    for name, width in (("step", step), ("sample", float(np.median(np.diff(time))))):
        if abs(abs(delay) / width - 1.0) < _ONE_STEP:
            said += f", one {name}: write each q with its own time"
            break
    else:
        said += ": let t = 0 be the start of Eq. 1"
    yield "delay", said, left(delay)


def _first(case: Case, speed: float) -> float:
    """Return the first natural frequency at a speed [rad/s]."""
    return float(case.modes(speed, case.theories[0]).frequencies[0])


def off_in_mass(frequency_at: Callable[[float], float], speed: float, found: float) -> float:
    """Return √g of the mass by which a frequency [rad/s] at a speed [rad/s] is that found.

    `frequency_at` has the right blade's at any speed. NaN where no mass within a factor of four
    has it.
    """
    root = 1.0
    for _ in range(60):
        before, root = root, frequency_at(root * speed) / found
        if abs(math.log(root)) > _MOST_OFF:
            return math.nan
        if abs(root - before) < _FOUND or not speed:
            return root
    return math.nan


def said_of_mass(root: float) -> str:
    """Return the sentence on a mass that is off."""
    mass = root**2
    return (
        f"the mass is {mass:.4g} times what it should be, or the stiffness {1.0 / mass:.4g} times: "
        "compare density, area, E and I"
    )


def of_another_mass(
    case: Case, time: FloatArray, q: FloatArray, true: FloatArray
) -> Iterator[tuple[str, str, float]]:
    """Yield the spin-up of a blade with another mass or stiffness, which its frequency gives."""
    motion, blade = case.rotation, case.blade
    loaded = bool(case.loads) or blade.damping.bending > 0.0 or blade.damping.axial > 0.0
    if type(motion) is not SpinUp or not case.oscillates or loaded:
        return
    first = _first(case, motion.omega)

    def swing(of: FloatArray) -> float:
        return oscillation_of(time, of / blade.length, motion.ramp_time, first).frequency

    try:
        found = swing(q)
        root = off_in_mass(partial(_first, case), motion.omega, first * found / swing(true))
        before: tuple[float, float] | None = None
        # The linear frequency with g is ω(√g Ω)/√g; its slope over ln √g is -ω_0²/ω².
        slope = -((_first(case, 0.0) / first) ** 2)
        for _ in range(_CORRECTIONS):
            if math.isnan(root) or abs(math.log(root)) > _MOST_OFF:
                return
            other = SpinUp(omega=root * motion.omega, ramp_time=motion.ramp_time / root)
            made = spin_up_response(blade, other, time / root, tolerance=1e-3).q
            yield "mass", said_of_mass(root), float(np.abs(q - made).max() / np.abs(true).max())
            here = math.log(root), math.log(swing(made) / found)
            if before is not None and here[0] != before[0]:
                slope = (here[1] - before[1]) / (here[0] - before[0])
            before = here
            root = math.exp(here[0] - here[1] / slope)
    except (RuntimeError, ValueError):
        return  # no steady oscillation, or no motion
