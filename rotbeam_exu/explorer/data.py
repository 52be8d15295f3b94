"""Data of the Explorer: models, exact orbits and finite element points over a grid of speeds."""

from __future__ import annotations

import contextlib
import itertools
import math
import os
import warnings
from collections.abc import Callable, Sequence
from concurrent.futures import Future
from typing import Any

import numpy as np

from analytic import (
    VARIANTS,
    AmplitudeNotReachedError,
    Beam,
    Blade,
    SpinUp,
    periodic_orbits,
    reduced_model,
    residual_amplitude,
    spin_up_response,
)
from analytic.arrays import FloatArray
from analytic.exact.linear.modes import driven_modes
from analytic.input_checks import RotbeamWarning

from ..comparison.theory import beyond_range
from ..labels import AMPLITUDE, OMEGA, dataset
from ..lazily import xr
from ..paper import RAMP_TIMES, SPEEDS
from ..sweeps.cases import worker_pool
from ..sweeps.grid import sweep

OMEGAS = tuple((0.25 * np.arange(49)).tolist())
"""Speeds of the slider [rad/s]."""
AMPLITUDES = tuple((np.arange(1, 61) / 100.0).tolist())
"""Amplitudes of the slider."""
EXACT_RAMP_TIMES = tuple(sorted({*RAMP_TIMES, *(0.5 * np.arange(4, 21)).tolist()}))
"""Ramp times of the slider [s]: the paper's, and every half second from 2 to 10 s."""

_TIP_HARMONICS = 20
"""Harmonics of q/L kept; from the twelfth on they are below 4e-6."""
_AXIS_HARMONICS = 7  # those beyond are below 2e-4 of the length, a twentieth of a pixel
_AXIS_POINTS = 13
_SAMPLES = 376
"""Samples of a history: forty a period of the paper's beam."""
_CURVE = 300  # ramp times of the closed form
_A_PERIOD = 200  # samples of what is left
_LARGEST = 1.1  # left by the closed form; beyond, the blade is thrown about and costs minutes
_TOLERANCE = 1e-3  # of the largest |q|: a tenth of a pixel


def explorer_data(
    blade: Blade | None = None,
    *,
    omegas: Sequence[float] = OMEGAS,
    amplitudes: Sequence[float] = AMPLITUDES,
    finite_element_omegas: Sequence[float] = SPEEDS,
    ramp_times: Sequence[float] = RAMP_TIMES,
    exact_ramp_times: Sequence[float] | None = None,
    elements: int = 16,
    duration: float = 15.0,
    step: float = 1e-3,
    jobs: int | None = None,
    cache: str | os.PathLike[str] | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> xr.Dataset:
    """Return all that the Explorer shows, on a grid of speeds and amplitudes.

    Parameters
    ----------
    blade : Blade, optional
        By default the paper's. The paper's models do not describe a blade.
    omegas : sequence of float
        Rotation speeds [rad/s], ascending in equal steps.
    amplitudes : sequence of float
        Peaks |q|/L of the exact orbits, ascending in equal steps.
    finite_element_omegas, ramp_times, elements, duration, step
        Grid [rad/s], [s], mesh, end [s] and step [s] of the finite element points.
    exact_ramp_times : sequence of float
        Ramp times [s] of the exact spin-ups to the same speeds, ascending; by default
        EXACT_RAMP_TIMES, those below `duration`.
    jobs, cache
        Number of workers, and where finished spin-ups are kept, as for `sweep`.
    progress : callable, optional
        Called with the pieces of work done and their number.

    Returns
    -------
    Dataset
        Reduced models over (model, omega): omega_n [rad/s], lambda_omega, kappa, h2, lambda_x [-],
        and over a as well the first_harmonic that has the peak a, NaN where a model has no
        oscillation. Exact orbits: exact_omega_n and exact_lambda_omega over omega,
        exact_frequency [rad/s] over (omega, a), the sine coefficients `harmonics` of q/L, NaN where
        no orbit is found. The beam's axis over L in the rotating frame: along Σ axis_x cos kφ,
        across Σ axis_y sin kφ, k = 0, 1 ...; `note`, the warnings of `periodic_orbits`. Points over
        (fe_omega, ramp_time): fe_amplitude [-], fe_frequency and fe_omega_n [rad/s]. Exact
        `spin_up`, q/L over (fe_omega, exact_ramp_time, time), and the amplitude over L that it
        leaves, exact_left; by the closed form closed_left over (fe_omega, ramp_curve).

    Raises
    ------
    ValueError
        If speeds, amplitudes or ramp times do not ascend as said.
    """
    blade = blade or Beam.reference()
    _evenly("omegas", omegas)
    _evenly("amplitudes", amplitudes)
    exact_ramp_times = _ramp_times(exact_ramp_times, duration)
    ramps = list(itertools.product(finite_element_omegas, exact_ramp_times))
    total = len(omegas) + len(finite_element_omegas) * len(ramp_times) + len(ramps)
    done = itertools.count(1)  # its next() is atomic: orbits report from the pool's own thread

    def one_more(*_: object) -> None:
        if progress is not None:
            progress(next(done), total)

    def finished(future: Future[Any]) -> None:
        if not future.cancelled() and future.exception() is None:
            one_more()

    with worker_pool(None, jobs, total) as pool:
        exact = [pool.submit(exact_orbits, blade, omega, tuple(amplitudes)) for omega in omegas]
        spun = [pool.submit(exact_spin_up, blade, *ramp, duration) for ramp in ramps]
        futures: list[Future[Any]] = [*exact, *spun]
        for future in futures:
            future.add_done_callback(finished)
        try:
            points = sweep(
                blade, omegas=finite_element_omegas, ramp_times=ramp_times, elements=elements,
                duration=duration, step=step, executor=pool, cache=cache, progress=one_more,
            )  # fmt: skip
            orbits = xr.concat([future.result() for future in exact], dim="omega")
            left = [future.result() for future in spun]
        finally:
            for future in futures:
                future.cancel()
    shown = ["amplitude", "frequency", "omega_n"]
    points = points[shown].rename({name: f"fe_{name}" for name in ("omega", *shown)})
    spin_ups = _spin_ups(blade, finite_element_omegas, exact_ramp_times, duration, left)
    parts = [_models(blade, omegas, amplitudes), orbits, points, spin_ups]
    data = xr.merge(parts, combine_attrs="drop", join="exact")
    data.attrs = {
        "frequency_scale": blade.frequency_scale,
        "length": blade.length,
        "elements": elements,
        "blade": "" if blade == Beam.reference() else str(blade),
    }
    return data


def _models(blade: Blade, omegas: Sequence[float], amplitudes: Sequence[float]) -> xr.Dataset:
    """Coefficients of Eqs. 63 and 65 over (model, omega), of every variant."""
    values = np.full((5, len(VARIANTS), len(omegas)), np.nan)
    first = np.full((len(VARIANTS), len(omegas), len(amplitudes)), np.nan)
    with beyond_range():
        for i, name in enumerate(VARIANTS):
            for j, omega in enumerate(omegas):
                try:
                    model = reduced_model(blade, omega, name)
                except ValueError:
                    continue  # no oscillation at that speed, or not for such a blade
                tip = model.perturbation
                values[:, i, j] = model.omega_n, tip.lambda_omega, tip.kappa, tip.h2, tip.h3
                first[i, j] = model.first_harmonic(list(amplitudes))
    dims = ("model", "omega")
    return dataset(
        {
            "omega_n": (dims, values[0], "natural frequency ω_n [rad/s]"),
            "lambda_omega": (dims, values[1], "λ_ω"),
            "kappa": (dims, values[2], "κ"),
            "h2": (dims, values[3], "second harmonic"),
            "lambda_x": (dims, values[4], "λ_x"),
            "first_harmonic": ((*dims, "a"), first, "first harmonic"),
        },
        {"model": list(VARIANTS), "omega": (list(omegas), OMEGA)},
    )


def exact_orbits(blade: Blade, omega: float, amplitudes: tuple[float, ...]) -> xr.Dataset:
    """Return the exact orbits shown at one speed; a pure function, for any executor.

    NaN for orbits that are not found.
    """
    peaks = np.array(amplitudes)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", RotbeamWarning)
        try:
            backbone = periodic_orbits(blade, omega, peaks)
        except AmplitudeNotReachedError as error:
            if error.part is None:
                raise
            backbone = error.part
    reached = np.abs(peaks[:, None] - backbone.amplitude).min(axis=1) < 1e-6

    def at_all(values: FloatArray) -> FloatArray:
        whole = np.full((peaks.size, *values.shape[1:]), np.nan)
        whole[reached] = values
        return whole

    tip = backbone.harmonics[:, :_TIP_HARMONICS]
    tip = np.pad(tip, ((0, 0), (0, _TIP_HARMONICS - tip.shape[1])))
    # The midpoints of half a period, which symmetry makes enough.
    phase = np.pi * (np.arange(32) + 0.5) / 32
    points = np.linspace(0.0, blade.length, _AXIS_POINTS)
    places = [backbone.axis(i, points, phase) for i in range(backbone.amplitude.size)]
    axes = [_axis_harmonics(place[..., 0], place[..., 1]) for place in places]
    axis_x, axis_y = (np.array(parts) / blade.length for parts in zip(*axes, strict=True))
    along = ("a", "k", "point")
    orbits = dataset(
        {
            "exact_omega_n": ((), backbone.omega_n, "natural frequency ω_n [rad/s]"),
            "exact_lambda_omega": ((), backbone.lambda_omega, "λ_ω"),
            "exact_frequency": ("a", at_all(backbone.frequency), "frequency ω_NL [rad/s]"),
            "harmonics": (("a", "harmonic"), at_all(tip), "q/L over sin kφ"),
            "axis_x": (along, at_all(axis_x), "x/L over cos kφ"),
            "axis_y": (along, at_all(axis_y), "y/L over sin kφ"),
            "note": ((), "; ".join(str(warning.message) for warning in caught), "warnings"),
        },
        {"a": (list(amplitudes), AMPLITUDE)},
    )
    return orbits.assign_coords(omega=omega)


def _axis_harmonics(x: FloatArray, y: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Cosine coefficients of x and sine coefficients of y, (k, points), k from 0."""
    count = len(x)
    angle = np.multiply.outer(np.arange(_AXIS_HARMONICS + 1), np.pi * (np.arange(count) + 0.5))
    cosines = 2.0 / count * np.cos(angle / count) @ x
    cosines[0] *= 0.5
    return cosines, 2.0 / count * np.sin(angle / count) @ y


def exact_spin_up(
    blade: Blade, omega: float, ramp_time: float, duration: float
) -> tuple[FloatArray, float]:
    """Return q/L of an exact spin-up and the amplitude it leaves; a pure function.

    Half peak to peak in the period after the ramp is left. NaN where the transient is too violent
    to be computed in seconds.
    """
    spin_up = SpinUp(omega=omega, ramp_time=ramp_time)
    period = 2.0 * math.pi / float(driven_modes(blade, omega).frequencies[0])
    times = np.linspace(0.0, duration, _SAMPLES)
    after = ramp_time + np.linspace(0.0, period, _A_PERIOD)
    both = np.union1d(times, after)
    q = np.full(both.size, np.nan)
    if residual_amplitude(blade, spin_up) < _LARGEST:
        with contextlib.suppress(RuntimeError):
            q = spin_up_response(blade, spin_up, both, tolerance=_TOLERANCE).q / blade.length
    return q[np.searchsorted(both, times)], 0.5 * float(np.ptp(q[np.searchsorted(both, after)]))


def _spin_ups(
    blade: Blade,
    omegas: Sequence[float],
    ramp_times: Sequence[float],
    duration: float,
    spun: Sequence[tuple[FloatArray, float]],
) -> xr.Dataset:
    """Return spin-ups on their grid, and the closed form, corrected by the backbone."""
    shape, grid = (len(omegas), len(ramp_times)), ("fe_omega", "exact_ramp_time")
    q, left = (np.array(values) for values in zip(*spun, strict=True))
    curve = np.linspace(min(ramp_times), max(ramp_times), _CURVE)
    ramps = [SpinUp(omega=omega, ramp_time=max(ramp_times)) for omega in omegas]
    closed = [residual_amplitude(blade, ramp, curve, corrected=True) for ramp in ramps]
    return dataset(
        {
            "spin_up": ((*grid, "time"), q.reshape(*shape, -1), "q/L"),
            "exact_left": (grid, left.reshape(shape), "amplitude left over L"),
            "closed_left": (("fe_omega", "ramp_curve"), closed, "amplitude left over L"),
        },
        {
            "fe_omega": (list(omegas), OMEGA),
            "exact_ramp_time": (list(ramp_times), "ramp time T [s]"),
            "time": (np.linspace(0.0, duration, _SAMPLES), "time t [s]"),
            "ramp_curve": (curve, "ramp time T [s]"),
        },
    )


def _evenly(name: str, values: Sequence[float]) -> None:
    steps = np.diff(values)
    if len(steps) == 0 or steps[0] <= 0.0 or np.ptp(steps) > 1e-9 * steps[0]:
        raise ValueError(
            f"{name} must ascend in equal steps, for a slider shows them, got {list(values)}"
        )


def _ramp_times(given: Sequence[float] | None, duration: float) -> list[float]:
    times = [T for T in EXACT_RAMP_TIMES if duration > T] if given is None else list(given)
    if np.any(np.diff(times) <= 0.0) or max(times, default=duration) >= duration:
        raise ValueError(
            f"exact_ramp_times must ascend and end before duration = {duration:g} s, got {times}"
        )
    return times
