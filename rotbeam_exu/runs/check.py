"""Checks of a step before a run and of the run after it: a solver that succeeds is not believed."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from analytic import Blade
from analytic.arrays import FloatArray
from analytic.blade_checks import require_steady_state
from analytic.exact.linear.modes import driven_modes
from analytic.warning import PartialError, warn

from ..lazily import xr
from .attributes import beam_of

SAMPLES_PER_PERIOD = 200
"""Samples kept of a period of ω_n, at least."""

STEPS_PER_PERIOD = 20
"""Steps in a period of ω_n, at least: with fewer the oscillation is the integrator's own."""

STEPS_PER_RAMP = 20
"""Steps in a ramp, at least: fewer do not see it, and a ramp within one or two not at all."""

LEAST_SLENDERNESS = 1e-11
"""μ below which the round-off of |r'| - 1 spoils the axial force by more than 1e-5 of it."""

STRAIN_LIMIT = 0.05
"""Axial strain beyond which a linear elastic law means nothing."""

RESIDUAL_LIMIT = 1e-8
"""Constraint residual, position over L or direction [-]; a converged Newton step leaves 1e-12."""

DRIFT_LIMIT = 1e-2
"""Drift of the steady Jacobi energy over the largest elastic energy; 1e-6 at the default step."""

LARGE_SWING = 0.7
"""Deflection of the tip over L above which a beam in free swing may break into short waves."""

_RESOLVED = 0.06
"""Phase of a step [rad], a hundredth of a cycle, below which a smaller one is no remedy."""


class SimulationError(PartialError):
    """A run that the solver finished, or gave up, and that does not pass its checks.

    Its `part` is the Dataset of the run if the solver finished: to look at, not to use.
    """


def checked_steps(
    blade: Blade,
    omega: float,
    ramp_time: float,
    duration: float,
    step: float,
    driven: Sequence[float] = (),
) -> tuple[int, int]:
    """Return how many steps a run has, and of how many one is kept: a divisor.

    Refuse a run that ends before its ramp or is no whole number of steps, a speed `omega` [rad/s]
    without steady state, and too few steps in a ramp or in a period of the first mode or of a load,
    which have the frequencies `driven` [rad/s].
    """
    if duration <= ramp_time:
        raise ValueError(
            f"duration {duration:g} s ends before the steady rotation, which begins at "
            f"ramp_time {ramp_time:g} s; take a longer duration"
        )
    steps = whole_steps(duration, step)
    require_stretch(blade)
    if 0.0 < ramp_time < (STEPS_PER_RAMP - 1e-9) * step:
        raise ValueError(
            f"ramp_time {ramp_time:g} s holds {ramp_time / step:.3g} steps of {step:g} s, too few "
            f"to follow it: take a step of {ramp_time / STEPS_PER_RAMP:.3g} s or less"
        )
    require_steady_state(blade, omega)
    fastest, of = float(driven_modes(blade, omega).frequencies[0]), "the natural frequency"
    if driven and max(driven) > fastest:
        fastest, of = max(driven), "a load"
    period = 2.0 * math.pi / fastest
    if period < STEPS_PER_PERIOD * step:
        raise ValueError(
            f"a step of {step:g} s leaves {period / step:.3g} steps in a period of {of}, "
            f"{period:.4g} s: take {period / STEPS_PER_PERIOD:.3g} s or less"
        )
    most = max(1, int(period / (SAMPLES_PER_PERIOD * step)))
    return steps, max(n for n in range(1, most + 1) if steps % n == 0)


def whole_steps(duration: float, step: float) -> int:
    """Return how many steps a duration has, or refuse a broken number of them."""
    steps = round(duration / step)
    if steps < 1 or abs(steps * step - duration) > 1e-9 * duration:
        steps = max(steps, 1)
        raise ValueError(
            f"duration {duration:.12g} s is not a whole number of steps of {step:g} s; try a step "
            f"of {duration / steps:.12g} s or a duration of {steps * step:.12g} s"
        )
    return steps


def require_stretch(blade: Blade) -> None:
    """Refuse a beam so stiff along its axis that double precision does not hold its stretch."""
    if blade.slenderness < LEAST_SLENDERNESS:
        raise ValueError(
            f"the slenderness I/(AL²) = {blade.slenderness:.3g} is below {LEAST_SLENDERNESS:g}, "
            "where round-off of the stretch spoils the axial force: lower the axial stiffness EA "
            f"below {blade.bending_stiffness / (LEAST_SLENDERNESS * blade.length**2):.3g} N, which "
            "changes nothing else"
        )


def warn_if_coarse(blade: Blade, omega: float, elements: int) -> None:
    """Warn where the root's boundary layer is shorter than half an element.

    The tension N bends a rotating beam within √(EI/N) = √2 L/w̄ of its clamp; there, cubic
    elements of twice that length are off by half a percent in frequency, linear ones by more.
    """
    layer = math.sqrt(2.0) * blade.frequency_scale / omega if omega > 0.0 else math.inf
    if elements * layer < 0.5:
        warn(
            f"at omega = {omega:g} rad/s the beam bends within {layer:.2g} L of its clamp, less "
            f"than half of one of {elements} elements: frequencies may be off by percents; take "
            f"{math.ceil(1.0 / layer)} elements or more"
        )


def remedy(run: xr.Dataset, t: float) -> str:
    """Return what to try after a run that went wrong at `t` [s].

    No step cures a linear model's reach, a rotation that tears the beam, or the waves, too short
    for any step, that a beam breaks into when it swings through most of its length.
    """
    attrs = run.attrs
    omega, divergence_speed = float(attrs["omega"]), float(attrs["divergence_speed"])
    smaller = f"take a smaller step than {attrs['step']:g} s"
    if omega > divergence_speed:
        return (
            f"linear elastic frames diverge above their divergence speed, {divergence_speed:.6g} "
            f"rad/s here, and omega is {omega:g} rad/s: take more substructures or another element"
        )
    if math.isfinite(divergence_speed):
        return (
            "linear elastic frames are for small deflection: take a longer ramp_time, more "
            f"substructures or another element, or {smaller.removeprefix('take ')}"
        )
    blade = beam_of(attrs)
    # ½mω²L²/EA at the root, Eq. 67's strain; a hub and bending add to it.
    strain = 0.5 * blade.mass_per_length * (omega * blade.length) ** 2 / blade.axial_stiffness
    strain *= 1.0 + 2.0 * blade.unit.hub
    if strain > 0.2 * STRAIN_LIMIT:
        return (
            f"the rotation alone strains the root by {strain:.2g}: lower omega below "
            f"{omega * math.sqrt(0.2 * STRAIN_LIMIT / strain):.3g} rad/s, or raise the axial "
            "stiffness EA"
        )
    resolved = float(attrs["step"]) * max(omega, blade.omega_0) < _RESOLVED
    before = run["q"].to_numpy()[run["time"].to_numpy() <= t]
    swing = float(np.abs(before).max(initial=0.0)) / blade.length
    if resolved and LARGE_SWING < swing < 1.0:
        gentler = "smaller loads, more damping" if "loads" in attrs else "a longer ramp_time"
        return (
            f"the tip has swung to {swing:.2g} of the length, where the beam breaks into waves "
            f"too short for any step: take {gentler}, or a duration below {t:.4g} s"
        )
    return smaller


def _reach(run: xr.Dataset) -> FloatArray:
    """Return the tip's distance from the clamp [m], (samples,); zero where the line may lengthen.

    Tension off the line bends the blade, which lengthens the line and not the sections.
    """
    blade = beam_of(run.attrs)
    if blade.table or any(blade.line.tension_offset):
        return np.zeros(run.sizes["time"])
    if "axis" in run:
        axis = run["axis"].to_numpy()
        return np.asarray(np.linalg.norm(axis[:, -1] - axis[:, 0], axis=-1))
    unit = blade.unit
    radius = unit.hub * float(run.attrs["blade_length"])
    tip = run["tip_x"].to_numpy() + 1j * run["tip_y"].to_numpy()
    in_plane = np.abs(tip - radius * np.exp(1j * run["angle"].to_numpy()))
    out_of_plane = math.sqrt(1.0 - unit.setting**2) * run["q"].to_numpy()
    return np.asarray(np.hypot(in_plane, out_of_plane))


def balanced_energy(run: xr.Dataset) -> tuple[FloatArray, str]:
    """Return the energy [J] that stays constant in steady rotation, (samples,), and its name.

    The Jacobi energy E - ω L_z, less the energy supplied by loads, damping and the speed.
    """
    energy = run["jacobi_energy"].to_numpy()
    if "supplied_energy" not in run:
        return energy, "the steady Jacobi energy E - ω L_z"
    supplied = run["supplied_energy"].to_numpy()
    return energy - supplied, "the Jacobi energy E - ω L_z from the energy supplied"


def check_run(run: xr.Dataset) -> str:
    """Return "passed", or raise with the first bad time, the number and the remedy.

    A SimulationError, if a run of `simulate` did not reach its end, holds a number that is not
    finite, leaves the reach of a beam whose tension is on its line, strains it beyond the linear
    law, or violates the clamp. If it does not conserve the Jacobi energy E - ω L_z in steady
    rotation, but for the energy supplied.
    """
    time = np.asarray(run["time"], dtype=np.float64)
    attrs = run.attrs
    step, length = float(attrs["step"]), float(attrs["blade_length"])
    for name, variable in run.data_vars.items():
        bad = ~np.isfinite(variable.to_numpy()).reshape(time.size, -1).all(axis=1)
        if bad.any():
            first = int(np.argmax(bad))
            raise SimulationError(
                f"{name} is not finite at t = {time[first]:.6g} s: {remedy(run, time[first])}"
            )
    # A beam that hardly vibrates has no elastic energy to speak of.
    scale = max(run["elastic_energy"].max().item(), 1e-4 * run["kinetic_energy"].max().item())
    steady = time >= float(attrs["ramp_time"])
    energy, its_name = balanced_energy(run)
    drift = np.where(steady, np.abs(energy - energy[int(np.argmax(steady))]), 0.0)
    checks = {
        "the tip's distance from the clamp over the length": (
            _reach(run) / length, 1.0 + STRAIN_LIMIT
        ),
        "the axial strain": (run["axial_strain"].to_numpy(), STRAIN_LIMIT),
        "the clamp's position error over the length": (
            run["clamp_residual"].to_numpy() / length, RESIDUAL_LIMIT
        ),
        "the root's direction error": (
            np.abs(run["direction_residual"].to_numpy()), RESIDUAL_LIMIT
        ),
        f"the drift of {its_name} over the largest elastic energy": (
            drift / max(scale, np.finfo(float).tiny), DRIFT_LIMIT
        ),
    }  # fmt: skip
    # Written so that NaN fails.
    failed = {
        name: bad for name, (size, limit) in checks.items() if (bad := ~(size <= limit)).any()
    }
    if failed:
        name = min(failed, key=lambda one: int(np.argmax(failed[one])))
        first, (size, limit) = int(np.argmax(failed[name])), checks[name]
        raise SimulationError(
            f"{name} reaches {size[first]:.3g} at t = {time[first]:.6g} s, above {limit:.3g}: "
            f"{remedy(run, time[first])}"
        )
    if time[-1] < float(attrs["duration"]) - 0.5 * step:
        raise SimulationError(
            f"the solver stopped at t = {time[-1]:.6g} s of {attrs['duration']:g} s: "
            f"{remedy(run, time[-1])}"
        )
    return "passed"


def energy_drift(run: xr.Dataset) -> tuple[float, float]:
    """Return drift and ripple of the steady `balanced_energy` over the largest elastic one.

    The drift is the change of its trend, a straight line, over the steady phase: the integrator's
    lasting gain or loss. The ripple is the largest deviation from that line: the truncation error
    that comes and goes with the oscillation, of second order in the step.
    """
    time = run["time"].to_numpy()
    steady = time >= run.attrs["ramp_time"]
    time, energy = time[steady], balanced_energy(run)[0][steady]
    trend = np.polynomial.Polynomial.fit(time, energy, 1)
    scale = max(float(run["elastic_energy"].max()), float(np.finfo(float).tiny))
    return (
        abs(float(trend(time[-1]) - trend(time[0]))) / scale,
        float(np.abs(energy - trend(time)).max()) / scale,
    )
