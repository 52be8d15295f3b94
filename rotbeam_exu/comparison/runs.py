"""Data of Figures 3, 4 and 15: coarse meshes spun up, their steady orbits, and the models'."""

from __future__ import annotations

import functools
import math
from typing import Any

import numpy as np

from analytic import Beam, SpinUp, periodic_orbits, reduced_model, spin_up_response
from analytic.arrays import FloatArray
from analytic.lazily import interpolate

from ..fem.simulation import simulate
from ..labels import OMEGA, dataset, labeled
from ..lazily import xr
from ..paper import MODELS
from ..runs.attributes import blade_attributes, motion_attributes
from ..runs.oscillation import steady_oscillation
from .theory import beyond_range


def reference_displacement(blade: Beam, spin_up: SpinUp) -> float:
    """Return q_0 = mωL⁴/(T(EI + mω²L³)) [m], Eq. 17.

    The text asks for the largest acceleration, which is 2ω/T; the print, kept here, has half of
    it. It is only a normalization.
    """
    omega, ramp_time, mass, length = spin_up.omega, spin_up.ramp_time, blade.mass, blade.length
    stiffness = blade.bending_stiffness + mass * omega**2 * length**3
    return mass * omega * length**4 / (ramp_time * stiffness)


def reference_velocity(blade: Beam, spin_up: SpinUp) -> float:
    """Return q̇_0 = q_0 √(EI/(mL³) + ω²) [m/s], Eq. 18.

    Corrected: the print divides, which has not the units of a velocity.
    """
    frequency = math.hypot(blade.frequency_scale, spin_up.omega)
    return reference_displacement(blade, spin_up) * frequency


def figure_3() -> xr.Dataset:
    """Tip displacement with 1, 2 and 3 elements at ω = 4 rad/s, T = 15 s (Fig. 3).

    Returns
    -------
    Dataset
        `q` [m] over (elements, time), and `exact`, the exact beam's, over time.
    """
    blade, spin_up, meshes = Beam.reference(), SpinUp(omega=4.0, ramp_time=15.0), [1, 2, 3]
    runs = [simulate(blade, spin_up, elements=n, duration=30.0) for n in meshes]
    data = xr.concat([run["q"] for run in runs], dim="elements").to_dataset(name="q")
    data["elements"] = ("elements", meshes, labeled("number of elements"))
    exact = spin_up_response(blade, spin_up, data["time"].to_numpy(), tolerance=1e-5).q
    data["exact"] = ("time", exact, data["q"].attrs)
    motion = {name: runs[0].attrs[name] for name in ("omega", "ramp_time")}
    data.attrs = {**blade_attributes(blade), **motion, **motion_attributes(spin_up)}
    data.attrs |= _numerics(runs[0])
    del data.attrs["elements"]  # a coordinate here
    return data


def figure_4() -> xr.Dataset:
    """Steady orbits in the normalization of Eqs. 15, 17 and 18, three elements (Fig. 4).

    Returns
    -------
    Dataset
        `q_bar` and `q_dot_bar` [-] over (case, sample): first ω = 4 rad/s with T = 1.5, 2 and
        3 s (a), then T = 3 s with ω = 4, 6 and 8 rad/s (b). `sample` counts from the end of the
        ramp, and a shorter steady phase is filled with NaN. `smear` over case: the largest velocity
        that no harmonic of the orbit's frequency explains over the largest, what other modes do.
    """
    blade = Beam.reference()

    @functools.cache
    def orbit(omega: float, ramp_time: float) -> xr.Dataset:
        spin_up = SpinUp(omega=omega, ramp_time=ramp_time)
        run = simulate(blade, spin_up, elements=3)
        steady = run.where(run["time"] >= ramp_time, drop=True)
        q_bar = steady["q"].data / reference_displacement(blade, spin_up)
        q_dot_bar = steady["q_dot"].data / reference_velocity(blade, spin_up)
        smear = _unexplained(steady["q_dot"], steady_oscillation(run).frequency)
        return dataset(
            {
                "q_bar": ("sample", q_bar, "tip displacement q/q₀"),
                "q_dot_bar": ("sample", q_dot_bar, "tip velocity q̇/q̇₀"),
                "smear": ((), smear, "share of other modes in the velocity"),
            },
            {"sample": np.arange(q_bar.size)},
            {**blade_attributes(blade), **_numerics(run)},
        )

    omegas, ramp_times = [4.0, 4.0, 4.0, 4.0, 6.0, 8.0], [1.5, 2.0, 3.0, 3.0, 3.0, 3.0]
    orbits = map(orbit, omegas, ramp_times)
    cases = dataset(
        {
            "panel": ("case", list("aaabbb"), "panel"),
            "omega": ("case", omegas, OMEGA),
            "ramp_time": ("case", ramp_times, "ramp time T [s]"),
        },
        {},
    )
    return xr.concat(orbits, dim="case", join="outer").assign(cases)


def _numerics(run: xr.Dataset) -> dict[str, Any]:
    """Return how a run was computed."""
    names = ("elements", "element", "element_options", "step", "frame")
    return {name: run.attrs[name] for name in names}


def _unexplained(rate: xr.DataArray, frequency: float) -> float:
    """Return what twelve harmonics leave of a velocity, over its largest value."""
    psi = frequency * rate["time"].to_numpy()[:, None] * np.arange(1, 13)
    harmonics = np.hstack([np.ones((psi.shape[0], 1)), np.cos(psi), np.sin(psi)])
    velocity = rate.to_numpy()
    left = velocity - harmonics @ np.linalg.lstsq(harmonics, velocity)[0]
    return float(np.abs(left).max() / np.abs(velocity).max())


def figure_15(
    blade: Beam | None = None, *, omega: float = 6.0, ramp_time: float = 3.0, **options: Any
) -> xr.Dataset:
    """Orbits over one period of the finite element solution, at its amplitude (Fig. 15).

    Parameters
    ----------
    blade : Blade, optional
        By default the paper's.
    omega, ramp_time : float
        The spin-up [rad/s], [s]. The print does not say which T it shows.
    **options
        As for `simulate`, for the finite element run; by default the main job's 16 elements.

    Returns
    -------
    Dataset
        `q_bar` = q/L and `q_dot_bar` = q̇/(ω0 L) [-] over (model, phase), the models, "exact" and
        "finite element", each from its greatest deflection; `period` [s] over model. Sec. 6 calls
        q̇/(ω0 L) by the name of the displacement; it is the velocity. A model whose frequency is
        off does not close: `gap` [-], from start to end. `distance` [-], of the farthest of its
        points from the finite element orbit, whenever that is there. Both are in units of that
        orbit's half axes. Attributes state the amplitude, and each model has it as its peak.
    """
    blade = blade or Beam.reference()
    run = simulate(blade, SpinUp(omega=omega, ramp_time=ramp_time), **options)
    steady = steady_oscillation(run)
    period = 2.0 * np.pi / steady.frequency
    phase = np.linspace(0.0, 1.0, 201)
    q, q_dot = _from_the_peak(run, period, phase * period)
    here = q / blade.length, q_dot / (blade.omega_0 * blade.length), period
    theory = _of_theory(blade, omega, steady.amplitude, phase * period)
    orbits = {"finite element": here, **theory}
    names = list(orbits)
    q_bar, q_dot_bar, periods = (np.array(one) for one in zip(*orbits.values(), strict=True))
    paths = q_bar / np.abs(q_bar[0]).max() + 1j * q_dot_bar / np.abs(q_dot_bar[0]).max()
    gap = np.abs(paths[:, -1] - paths[:, 0])
    distance = [np.abs(path[:, None] - paths[0]).min(axis=1).max() for path in paths]
    along = ("model", "phase")
    return dataset(
        {
            "q_bar": (along, q_bar, "tip displacement q/L"),
            "q_dot_bar": (along, q_dot_bar, "tip velocity q̇/(ω₀L)"),
            "gap": ("model", gap, "gap from start to end over the half axes"),
            "distance": ("model", distance, "distance from the FE orbit over its half axes"),
            "period": ("model", periods, "period [s]"),
        },
        {"model": (names, "model"), "phase": (phase, "time over the FE period")},
        {
            "omega": omega,
            "ramp_time": ramp_time,
            "amplitude": steady.amplitude,
            **_numerics(run),
            **blade_attributes(blade),
        },
    )


def _of_theory(
    blade: Beam, omega: float, amplitude: float, time: FloatArray
) -> dict[str, tuple[FloatArray, FloatArray, float]]:
    """Return q/L, q̇/(ω0 L) and the period of models and exact beam, from their peak."""
    orbits = {}
    with beyond_range():
        for name in MODELS:
            model = reduced_model(blade, omega, name)
            tip, a0 = model.perturbation, float(model.first_harmonic(amplitude))
            frequency = float(model.frequency(a0))
            psi = frequency * time + tip.peak_phase(np.array(a0))
            rate = frequency * tip.rate(psi, a0) / blade.omega_0
            orbits[name] = tip.deflection(psi, a0), rate, 2.0 * np.pi / frequency
        exact = periodic_orbits(blade, omega, [amplitude])
    (frequency,), (sines,), (start,) = exact.frequency, exact.harmonics, exact.peak_time
    orders = np.arange(1, sines.size + 1)
    phases = np.outer(frequency * (start + time), orders)
    rate = frequency * np.cos(phases) @ (orders * sines) / blade.omega_0
    orbits["exact"] = np.sin(phases) @ sines, rate, 2.0 * np.pi / float(frequency)
    return orbits


def _from_the_peak(
    run: xr.Dataset, period: float, time: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return q and q_dot over one period from the first steady maximum, by cubic splines."""
    steady = run.where(run["time"] >= run.attrs["ramp_time"], drop=True)
    at = steady["time"].to_numpy()
    displacement = interpolate.CubicSpline(at, steady["q"].to_numpy())
    rate = interpolate.CubicSpline(at, steady["q_dot"].to_numpy())
    turns = rate.roots(extrapolate=False)
    peak = next(t for t in turns if displacement(t) > 0.0 and t + period <= at[-1])
    return np.asarray(displacement(peak + time)), np.asarray(rate(peak + time))
