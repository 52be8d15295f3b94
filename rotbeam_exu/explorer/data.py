"""What the Explorer shows: models, exact orbits and finite element points over a grid of speeds."""

from __future__ import annotations

import itertools
import os
import warnings
from collections.abc import Callable, Sequence
from concurrent.futures import Executor
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from analytic import VARIANTS, AnyBlade, Beam, periodic_orbits, reduced_model
from analytic.input_checks import RotbeamWarning

from ..comparison.theory import beyond_range
from ..paper import RAMP_TIMES, SPEEDS
from ..sweeps.grid import sweep
from ..sweeps.workers import worker_pool

OMEGAS = tuple((0.25 * np.arange(49)).tolist())
"""Speeds of the slider [rad/s]."""
AMPLITUDES = tuple((np.arange(1, 61) / 100.0).tolist())
"""Amplitudes of the slider."""

TIP_HARMONICS = 20
"""Harmonics of q/L kept; from the twelfth on they are below 4e-6."""
_AXIS_HARMONICS = 7  # those beyond are below 2e-4 of the length, a twentieth of a pixel
_AXIS_POINTS = 13

_NONE = {"units": "1"}
_FREQUENCY = {"units": "rad/s"}


def explorer_data(
    beam: AnyBlade | None = None,
    *,
    omegas: Sequence[float] = OMEGAS,
    amplitudes: Sequence[float] = AMPLITUDES,
    finite_element_omegas: Sequence[float] = SPEEDS,
    ramp_times: Sequence[float] = RAMP_TIMES,
    elements: int = 16,
    duration: float = 15.0,
    step: float = 1e-3,
    executor: Executor | None = None,
    jobs: int | None = None,
    cache: str | os.PathLike[str] | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> xr.Dataset:
    """Return all that the Explorer shows, on a grid of speeds and amplitudes.

    Parameters
    ----------
    beam : Beam or Blade, optional
        By default the paper's. Of a blade the paper's models have nothing to say.
    omegas : sequence of float
        Rotation speeds [rad/s], ascending in equal steps.
    amplitudes : sequence of float
        Peaks |q|/L of the exact orbits, ascending in equal steps.
    finite_element_omegas, ramp_times, elements, duration, step
        Grid [rad/s], [s], mesh, end [s] and step [s] of the finite element points.
    executor, jobs, cache
        Where the work is done and where finished spin-ups are kept, as for `sweep`.
    progress : callable, optional
        Called with the pieces of work done and their number.

    Returns
    -------
    Dataset
        Reduced models over (model, omega): omega_n [rad/s], lambda_omega, kappa, h2, lambda_x [-],
        and over a as well the first_harmonic that has the peak a, NaN where a model has no
        oscillation. Exact orbits: exact_omega_n and exact_lambda_omega over omega,
        exact_frequency [rad/s] over (omega, a), the sine coefficients `harmonics` of q/L, and the
        beam's axis over L in the rotating frame, along Σ axis_x cos kφ, across Σ axis_y sin kφ,
        k = 0, 1 ...; `note`, what `periodic_orbits` warned of. Points over (fe_omega, ramp_time):
        fe_amplitude [-], fe_frequency and fe_omega_n [rad/s].
    """
    beam = beam or Beam.reference()
    _evenly("omegas", omegas)
    _evenly("amplitudes", amplitudes)
    total = len(omegas) + len(finite_element_omegas) * len(ramp_times)

    done = itertools.count(1)  # its next() is atomic: orbits report from the pool's own thread

    def one_more(*_: object) -> None:
        if progress is not None:
            progress(next(done), total)

    with worker_pool(executor, jobs, total) as pool:
        exact = [pool.submit(_exact, beam, omega, tuple(amplitudes)) for omega in omegas]
        for future in exact:
            future.add_done_callback(one_more)
        try:
            points = sweep(
                beam,
                omegas=finite_element_omegas,
                ramp_times=ramp_times,
                elements=elements,
                duration=duration,
                step=step,
                executor=pool,
                cache=cache,
                progress=one_more,
            )
            orbits = xr.concat([future.result() for future in exact], dim="omega")
        finally:
            for future in exact:
                future.cancel()
    points = points[["amplitude", "frequency", "omega_n"]].rename(
        {"omega": "fe_omega", **{n: f"fe_{n}" for n in ("amplitude", "frequency", "omega_n")}}
    )
    data = xr.merge([_models(beam, omegas, amplitudes), orbits, points], combine_attrs="drop")
    data.attrs = {
        "frequency_scale": beam.frequency_scale,
        "length": beam.length,
        "elements": elements,
        "blade": "" if beam == Beam.reference() else str(beam),
    }
    return data


def _models(beam: AnyBlade, omegas: Sequence[float], amplitudes: Sequence[float]) -> xr.Dataset:
    """Coefficients of Eqs. 63 and 65 over (model, omega), of every variant."""
    values = np.full((5, len(VARIANTS), len(omegas)), np.nan)
    first = np.full((len(VARIANTS), len(omegas), len(amplitudes)), np.nan)
    with beyond_range():
        for i, name in enumerate(VARIANTS):
            for j, omega in enumerate(omegas):
                try:
                    model = reduced_model(beam, omega, name)
                except ValueError:
                    continue  # no oscillation at that speed, or not for such a blade
                tip = model.perturbation
                values[:, i, j] = model.omega_n, tip.lambda_omega, tip.kappa, tip.h2, tip.h3
                first[i, j] = model.first_harmonic(list(amplitudes))
    dims: Any = ("model", "omega")
    return xr.Dataset(
        {
            "omega_n": (dims, values[0], _FREQUENCY),
            "lambda_omega": (dims, values[1], _NONE),
            "kappa": (dims, values[2], _NONE),
            "h2": (dims, values[3], _NONE),
            "lambda_x": (dims, values[4], _NONE),
            "first_harmonic": ((*dims, "a"), first, _NONE),
        },
        coords={"model": list(VARIANTS), "omega": ("omega", list(omegas), _FREQUENCY)},
    )


def _exact(beam: AnyBlade, omega: float, amplitudes: tuple[float, ...]) -> xr.Dataset:
    """Exact orbits at one speed; a pure function, for any executor."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", RotbeamWarning)
        backbone = periodic_orbits(beam, omega, amplitudes)
    count = min(TIP_HARMONICS, backbone.harmonics.shape[1])
    tip = np.pad(backbone.harmonics[:, :count], ((0, 0), (0, TIP_HARMONICS - count)))
    axis_x, axis_y = zip(
        *(_axis_harmonics(*_axis(backbone, i)) for i in range(len(amplitudes))), strict=True
    )
    along: Any = ("a", "k", "point")
    return xr.Dataset(
        {
            "exact_omega_n": ((), backbone.omega_n, _FREQUENCY),
            "exact_lambda_omega": ((), backbone.lambda_omega, _NONE),
            "exact_frequency": ("a", backbone.frequency, _FREQUENCY),
            "harmonics": (("a", "harmonic"), tip, _NONE),
            "axis_x": (along, np.array(axis_x), _NONE),
            "axis_y": (along, np.array(axis_y), _NONE),
            "note": ((), "; ".join(str(warning.message) for warning in caught)),
        },
        coords={"omega": omega, "a": ("a", list(amplitudes), _NONE)},
    )


def _axis(backbone: Any, i: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Axis over L at the midpoints of half a period, which symmetry makes enough."""
    length = backbone.beam.length
    phase = np.pi * (np.arange(32) + 0.5) / 32
    x, y = backbone.axis(i, np.linspace(0.0, length, _AXIS_POINTS), phase)
    return x / length, y / length


def _axis_harmonics(
    x: NDArray[np.float64], y: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Cosine coefficients of x and sine coefficients of y, (k, points), k from 0."""
    count = len(x)
    angle = np.multiply.outer(np.arange(_AXIS_HARMONICS + 1), np.pi * (np.arange(count) + 0.5))
    cosines = 2.0 / count * np.cos(angle / count) @ x
    cosines[0] *= 0.5
    return cosines, 2.0 / count * np.sin(angle / count) @ y


def _evenly(name: str, values: Sequence[float]) -> None:
    steps = np.diff(values)
    if len(steps) == 0 or steps[0] <= 0.0 or np.ptp(steps) > 1e-9 * steps[0]:
        raise ValueError(
            f"{name} must ascend in equal steps, for a slider shows them, got {list(values)}"
        )
