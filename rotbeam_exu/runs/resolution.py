"""Resolution limits of a mesh and a step, told before a run instead of after it."""

from __future__ import annotations

import math
from collections.abc import Sequence

from analytic import AnyBlade, linear_modes
from analytic.beam import require_steady_state
from analytic.warning import warn

SAMPLES_PER_PERIOD = 200
"""Samples kept of a period of ω_n, at least."""

STEPS_PER_PERIOD = 20
"""Steps in a period of ω_n, at least: with fewer the oscillation is the integrator's own."""

STEPS_PER_RAMP = 20
"""Steps in a ramp, at least: fewer do not see Eq. 1, and a ramp within one or two not at all."""

LEAST_SLENDERNESS = 1e-11
"""μ below which the round-off of |r'| - 1 spoils the axial force by more than 1e-5 of it."""

_MOST_ELEMENTS, _MOST_ELEMENT_STEPS = 7900, 1.5e12  # 8 GB for a matrix; a month at 2 µs each


def checked_steps(
    beam: AnyBlade,
    omega: float,
    ramp_time: float,
    elements: int,
    duration: float,
    step: float,
    driven: Sequence[float] = (),
) -> tuple[int, int]:
    """Return how many steps a run has, and of how many one is kept.

    Loads go by the frequencies `driven` [rad/s].

    Raises
    ------
    ValueError
        If the run ends before its ramp, is no whole number of steps, or a check below fails.
    """
    if duration <= ramp_time:
        raise ValueError(
            f"duration {duration:g} s ends before the steady rotation, which begins at "
            f"ramp_time {ramp_time:g} s; take a longer duration"
        )
    steps = whole_steps(duration, step)
    require_stretch(beam)
    require_resolved_ramp(ramp_time, step)
    require_feasible(elements, steps)
    return steps, sampling(beam, omega, steps, step, driven)


def whole_steps(duration: float, step: float) -> int:
    """Return how many steps a duration has, or refuse a broken number of them."""
    steps = round(duration / step)
    if steps < 1 or abs(steps * step - duration) > 1e-9 * duration:
        steps = max(steps, 1)
        raise ValueError(
            f"duration {duration:g} s is not a whole number of steps of {step:g} s; try a step of "
            f"{duration / steps:.12g} s or a duration of {steps * step:.12g} s"
        )
    return steps


def sampling(
    beam: AnyBlade, omega: float, steps: int, step: float, driven: Sequence[float] = ()
) -> int:
    """Return how many steps lie between two samples: a divisor of `steps`.

    Raises
    ------
    ValueError
        If no steady state exists at the speed `omega` [rad/s], or a period of its first mode, or
        of a load, has fewer steps than STEPS_PER_PERIOD.
    """
    require_steady_state(beam, omega)
    fastest, of = float(linear_modes(beam, omega, 1).frequencies[0]), "the natural frequency"
    if driven and max(driven) > fastest:
        fastest, of = max(driven), "a load"
    period = 2.0 * math.pi / fastest
    if period < STEPS_PER_PERIOD * step:
        raise ValueError(
            f"a step of {step:g} s leaves {period / step:.3g} steps in a period of {of}, "
            f"{period:.4g} s: take {period / STEPS_PER_PERIOD:.3g} s or less"
        )
    most = max(1, int(period / (SAMPLES_PER_PERIOD * step)))
    return max(n for n in range(1, most + 1) if steps % n == 0)


def require_resolved_ramp(ramp_time: float, step: float) -> None:
    """Refuse a ramp of fewer than STEPS_PER_RAMP steps."""
    if 0.0 < ramp_time < (STEPS_PER_RAMP - 1e-9) * step:
        raise ValueError(
            f"ramp_time {ramp_time:g} s holds {ramp_time / step:.3g} steps of {step:g} s, too few "
            f"to follow Eq. 1: take a step of {ramp_time / STEPS_PER_RAMP:.3g} s or less"
        )


def require_stretch(beam: AnyBlade) -> None:
    """Refuse a beam so stiff along its axis that double precision does not hold its stretch."""
    if beam.slenderness < LEAST_SLENDERNESS:
        raise ValueError(
            f"the slenderness I/(AL²) = {beam.slenderness:.3g} is below {LEAST_SLENDERNESS:g}, "
            "where round-off of the stretch spoils the axial force: lower the axial stiffness EA "
            f"below {beam.bending_stiffness / (LEAST_SLENDERNESS * beam.length**2):.3g} N, which "
            "changes nothing else"
        )


def require_feasible(elements: int, steps: int = 1) -> None:
    """Refuse a mesh that no memory holds, and runs that would take more than a month."""
    if elements > _MOST_ELEMENTS or elements * steps > _MOST_ELEMENT_STEPS:
        raise ValueError(
            f"{elements:.6g} elements and {steps:.6g} steps are more than memory or a month take: "
            "take fewer elements, a larger step or a shorter duration"
        )


def warn_if_coarse(beam: AnyBlade, omega: float, elements: int) -> None:
    """Warn where the root's boundary layer is shorter than half an element.

    The tension N bends a rotating beam within √(EI/N) = √2 L/w̄ of its clamp; there, cubic
    elements of twice that length are off by half a percent in frequency, linear ones by more.
    """
    layer = math.sqrt(2.0) * beam.frequency_scale / omega if omega > 0.0 else math.inf
    if elements * layer < 0.5:
        warn(
            f"at omega = {omega:g} rad/s the beam bends within {layer:.2g} L of its clamp, less "
            f"than half of one of {elements} elements: frequencies may be off by percents; take "
            f"{math.ceil(1.0 / layer)} elements or more"
        )
