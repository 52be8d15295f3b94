"""Motion of a run: as far as it is not given, the paper's, scaled by the blade's ω_0."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from analytic import Beam, Blade, SpinUp
from analytic.input_checks import positive

from ..labels import one_two_five

_OMEGA, _RAMP_TIME, _DURATION, _STEP = 6.0, 3.0, 15.0, 1e-3
"""The paper's choices for its beam [rad/s, s, s, s]; other beams keep their ratios to ω_0."""

_TABLE_SPEED, _TABLE_TIME, _TABLE_STEP = 0.25, 7.0, 14.0
"""Speed, times and step of a table over the paper's: a rotor is run up to half its ω_0."""

_STEPS_PER_RAMP = 30
"""Steps that a chosen step leaves at least in a ramp; `simulate` refuses fewer than 20."""

_STEADY_PERIODS = 5.0
"""Periods 2π/ω_0 that a chosen duration leaves at least after the ramp; two are measured."""


@dataclass(frozen=True, kw_only=True)
class ChosenMotion:
    """A spin-up, its end and the integrator's step [s]."""

    spin_up: SpinUp
    duration: float
    step: float


def chosen_speeds(blade: Blade, *of_paper: float) -> list[float]:
    """Return speeds [rad/s] of the paper's beam, scaled to the same ω/ω_0, to two digits.

    Those of a table of stations are a quarter.
    """
    share = (_TABLE_SPEED if blade.table else 1.0) / slower_than_paper(blade)
    return [_rounded(omega * share, 2) for omega in of_paper]


def chosen_times(blade: Blade, *of_paper: float, digits: int = 2) -> list[float]:
    """Return times [s] of the paper's beam, scaled to the same ω_0 t, to two digits or more.

    Those of a table of stations are seven times as long.
    """
    longer = (_TABLE_TIME if blade.table else 1.0) * slower_than_paper(blade)
    return [_rounded(time * longer, digits) for time in of_paper]


def chosen_ramps(blade: Blade) -> float:
    """Return the longest ramp time [s] that is looked at: 10 s of the paper's beam, scaled."""
    return _rounded(10.0 * slower_than_paper(blade), 2)


def refuse_rest(*speeds: float) -> None:
    """Refuse a speed [rad/s] of zero, at which nothing will oscillate."""
    if not all(speeds):
        raise ValueError(
            "at omega = 0 rad/s the beam stays at rest and nothing oscillates: take a speed above "
            f"zero, as {_OMEGA:g} rad/s in the paper"
        )


def chosen_motion(
    blade: Blade,
    *,
    omega: float | None = None,
    ramp_time: float | None = None,
    duration: float | None = None,
    step: float | None = None,
) -> ChosenMotion:
    """Return the motion given, completed with the paper's values scaled by ω_0.

    Speeds go with ω_0 and times with 1/ω_0, to two digits. The step is the next of 1, 2, 5 times a
    power of ten below, and at most a thirtieth of the ramp: the duration is a whole number of
    steps. A given duration or step is kept and the other fitted to it; a chosen duration leaves
    five periods after the ramp, of a table of stations no more.
    """
    table = blade.table
    omega = chosen_speeds(blade, _OMEGA)[0] if omega is None else omega
    ramp_time = chosen_times(blade, _RAMP_TIME)[0] if ramp_time is None else ramp_time
    spin_up = SpinUp(omega=omega, ramp_time=ramp_time)
    step = None if step is None else positive("step", step, "s")
    small = _STEP * slower_than_paper(blade) * (_TABLE_STEP if table else 1.0)
    fine = one_two_five(min(small, spin_up.ramp_time / _STEPS_PER_RAMP))
    if duration is None:
        enough = spin_up.ramp_time + _STEADY_PERIODS * 2.0 * math.pi / blade.omega_0
        duration = 0.0 if table else chosen_times(blade, _DURATION)[0]
        if duration < enough:
            duration = _rounded(enough, 2, up=True)
        if step is not None:
            duration = _whole_steps(duration, step) * step
    else:
        duration = positive("duration", duration, "s")
    if step is None:
        fitted = duration / _whole_steps(duration, fine)
        # The number as printed, where round-off is all that sets them apart.
        step = fine if math.isclose(fitted, fine, rel_tol=1e-12) else fitted
    return ChosenMotion(spin_up=spin_up, duration=duration, step=step)


def grid_motion(
    blade: Blade,
    omegas: Sequence[float],
    ramp_times: Sequence[float],
    *,
    duration: float | None = None,
    step: float | None = None,
) -> ChosenMotion:
    """Return duration and step for a whole grid: of the longest ramp and of the shortest."""
    for omega in omegas:
        SpinUp(omega=omega, ramp_time=1.0)
    checked = [positive("ramp_time", time, "s") for time in ramp_times]
    longest, shortest = max(checked, default=None), min(checked, default=None)
    if step is None:
        step = chosen_motion(blade, ramp_time=shortest, duration=duration).step
    return chosen_motion(blade, ramp_time=longest, duration=duration, step=step)


def whose_speeds(blade: Blade) -> str:
    """Return whose ω/ω_0 chosen speeds have, in words."""
    share = f"{_TABLE_SPEED:g} times " if blade.table else ""
    return f"{share}the benchmark's"


def slower_than_paper(blade: Blade) -> float:
    """Ratio of the paper's natural frequency to the beam's."""
    return Beam.reference().omega_0 / blade.omega_0


def _whole_steps(duration: float, step: float) -> int:
    """Return the number of steps that cover a duration, rounded up but for round-off."""
    return max(1, math.ceil(duration / step * (1.0 - 1e-12)))


def _rounded(value: float, digits: int, *, up: bool = False) -> float:
    unit = digits - 1 - math.floor(math.log10(value))
    if up:
        # Through the decimal text, for a power of ten times a number is not the number printed.
        return float(f"{math.ceil(value * 10.0**unit * (1.0 - 1e-12))}e{-unit}")
    return float(f"{value:.{digits - 1}e}")
