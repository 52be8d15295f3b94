"""Data of Figure 15: one period of the finite element orbit beside the models'."""

from __future__ import annotations

from typing import Any

import numpy as np

from analytic import Beam, Orbits, SpinUp, periodic_orbits, reduced_model
from analytic.arrays import FloatArray
from analytic.lazily import interpolate

from ..fem.simulation import simulate
from ..lazily import xr
from ..oscillation import steady_oscillation
from ..paper import MODELS
from ..verdict import beam_attributes
from .theory import beyond_range


def figure_15(
    beam: Beam | None = None, *, omega: float = 6.0, ramp_time: float = 3.0, **options: Any
) -> xr.Dataset:
    """Orbits over one period of the finite element solution, at its amplitude (Fig. 15).

    Parameters
    ----------
    beam : Beam, optional
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
    beam = beam or Beam.reference()
    run = simulate(beam, SpinUp(omega=omega, ramp_time=ramp_time), **options)
    steady = steady_oscillation(run)
    period = 2.0 * np.pi / steady.frequency
    phase = np.linspace(0.0, 1.0, 201)
    time = phase * period
    per_length = 1.0 / (beam.omega_0 * beam.length)

    q, q_dot = _from_the_peak(run, period, time)
    orbits, periods = _of_theory(beam, omega, steady.amplitude, time)
    orbits["finite element"] = (q / beam.length, q_dot * per_length)
    periods["finite element"] = period
    names = ["finite element", *MODELS, "exact"]
    half_axes = np.array([np.abs(v).max() for v in orbits["finite element"]])
    paths = {name: np.stack(orbit, axis=-1) / half_axes for name, orbit in orbits.items()}
    return xr.Dataset(
        {
            "q_bar": (
                ("model", "phase"),
                np.array([orbits[name][0] for name in names]),
                {"units": "1", "long_name": "tip displacement q/L"},
            ),
            "q_dot_bar": (
                ("model", "phase"),
                np.array([orbits[name][1] for name in names]),
                {"units": "1", "long_name": "tip velocity q̇/(ω₀L)"},
            ),
            "gap": (
                "model",
                [float(np.linalg.norm(paths[name][-1] - paths[name][0])) for name in names],
                {"units": "1", "long_name": "gap from start to end over the half axes"},
            ),
            "distance": (
                "model",
                [_distance(paths[name], paths["finite element"]) for name in names],
                {"units": "1", "long_name": "distance from the FE orbit over its half axes"},
            ),
            "period": (
                "model",
                np.array([periods[name] for name in names]),
                {"units": "s", "long_name": "period"},
            ),
        },
        coords={
            "model": ("model", names, {"units": "1", "long_name": "model"}),
            "phase": ("phase", phase, {"units": "1", "long_name": "time over the FE period"}),
        },
        attrs={
            "omega": omega,
            "ramp_time": ramp_time,
            "amplitude": steady.amplitude,
            **{
                name: run.attrs[name]
                for name in ("elements", "element", "element_options", "step", "frame")
            },
            **beam_attributes(beam),
        },
    )


def _of_theory(
    beam: Beam, omega: float, amplitude: float, time: FloatArray
) -> tuple[dict[str, tuple[FloatArray, FloatArray]], dict[str, float]]:
    """Return q/L and q̇/(ω0 L) of the models and the exact beam from their peak, and the periods."""
    orbits, periods = {}, {}
    with beyond_range():
        for name in MODELS:
            model = reduced_model(beam, omega, name)
            tip, a0 = model.perturbation, float(model.first_harmonic(amplitude))
            frequency = model.frequency(a0)
            psi = frequency * time + tip.peak_phase(np.array(a0))
            velocity = frequency * tip.rate(psi, a0)
            orbits[name] = (tip.deflection(psi, a0), velocity / beam.omega_0)
            periods[name] = 2.0 * np.pi / frequency
        exact = periodic_orbits(beam, omega, [amplitude])
    x, x_rate = _from_exact_peak(exact, time)
    orbits["exact"] = (x, x_rate / beam.omega_0)
    periods["exact"] = 2.0 * np.pi / float(exact.frequency[0])
    return orbits, periods


def _distance(path: FloatArray, other: FloatArray) -> float:
    """Return the largest distance of a point of `path` from the nearest of `other`, (n, 2) each."""
    apart = np.linalg.norm(path[:, None] - other[None], axis=2)
    return float(apart.min(axis=1).max())


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


def _from_exact_peak(backbone: Orbits, time: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return x = q/L and dx/dt [1/s] of the first orbit from its peak, by periodic splines."""
    x, rate = backbone.orbit(0, 401)
    period = 2.0 * np.pi / backbone.frequency[0]
    samples = np.linspace(0.0, period, x.size)
    at = (backbone.peak_time[0] + time) % period
    ends = [np.append(v[:-1], v[0]) for v in (x, rate * backbone.beam.frequency_scale)]
    first, second = (
        np.asarray(interpolate.CubicSpline(samples, v, bc_type="periodic")(at)) for v in ends
    )
    return first, second
