"""The exact spin-ups that the Explorer shows, and what Eq. 1 leaves over its ramp time."""

from __future__ import annotations

import contextlib
import math
from collections.abc import Sequence

import numpy as np

from analytic import AnyBlade, SpinUp, linear_modes, residual_amplitude, spin_up_response

from ..lazily import xr

SAMPLES = 376
"""Of a history: forty a period of the paper's beam."""
_CURVE = 300  # ramp times of the closed form
_A_PERIOD = 200  # samples of what is left
_LARGEST = 1.1  # left by the closed form; beyond, the blade is thrown about and costs minutes
_TOLERANCE = 1e-3  # of the largest |q|: a tenth of a pixel


def exact_spin_up(beam: AnyBlade, omega: float, ramp_time: float, duration: float) -> xr.Dataset:
    """Return q/L of an exact spin-up and what it leaves; a pure function, for any executor.

    Half peak to peak in the period after the ramp is left. NaN where the transient is too violent
    to be computed in seconds.
    """
    spin_up = SpinUp(omega=omega, ramp_time=ramp_time)
    period = 2.0 * math.pi / float(linear_modes(beam, omega, 1).frequencies[0])
    times = np.linspace(0.0, duration, SAMPLES)
    after = ramp_time + np.linspace(0.0, period, _A_PERIOD)
    both = np.union1d(times, after)
    q = np.full(both.size, np.nan)
    if residual_amplitude(beam, spin_up) < _LARGEST:
        with contextlib.suppress(RuntimeError):
            q = spin_up_response(beam, spin_up, both, tolerance=_TOLERANCE).q / beam.length
    late = q[np.searchsorted(both, after)]
    return xr.Dataset(
        {
            "spin_up": ("time", q[np.searchsorted(both, times)], {"units": "1"}),
            "exact_left": ((), 0.5 * np.ptp(late), {"units": "1"}),
        },
        coords={
            "time": ("time", times, {"units": "s"}),
            "fe_omega": omega,
            "exact_ramp_time": ramp_time,
        },
    )


def together(
    spun: Sequence[xr.Dataset], beam: AnyBlade, omegas: Sequence[float], ramp_times: Sequence[float]
) -> xr.Dataset:
    """Return spin-ups on their grid, and what is left by the closed form over its range.

    The closed form is corrected by the backbone.
    """
    grid = [one.expand_dims(("fe_omega", "exact_ramp_time")) for one in spun]
    curve = np.linspace(min(ramp_times), max(ramp_times), _CURVE)
    one = max(ramp_times)
    left = [
        residual_amplitude(beam, SpinUp(omega=omega, ramp_time=one), curve, corrected=True)
        for omega in omegas
    ]
    return (
        xr.combine_by_coords(grid)
        .sel(fe_omega=list(omegas))
        .assign_coords(ramp_curve=("ramp_curve", curve, {"units": "s"}))
        .assign(closed_left=(("fe_omega", "ramp_curve"), np.array(left), {"units": "1"}))
    )
