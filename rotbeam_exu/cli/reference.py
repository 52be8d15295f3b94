"""`rotbeam reference`: the exact spin-up, to compare a code with."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

import analytic
from analytic.input_checks import positive, whole_number

from ..lazily import xr
from ..runs.attributes import beam_attributes
from .job import Results
from .motion import Config, RampTime, SteadySpeed, configured, motion_of
from .options import Whole
from .output import bar, print_line

if TYPE_CHECKING:
    from analytic.exact.driven.response import SpinUpResponse


def reference(
    *,
    omega: SteadySpeed = None,
    ramp_time: RampTime = None,
    duration: float | None = None,
    samples: Whole = 1501,
    tolerance: float = 1e-8,
    config: Config = None,
    results: Results = Results(),
) -> None:
    """Write the exact spin-up as netCDF and CSV.

    The beam is geometrically exact and extensible (Bernoulli-Euler), without loads; step and
    functions are refined until two solutions agree.

    Parameters
    ----------
    duration
        Last time that is written [s].
    samples
        Number of times that are written, evenly spaced from 0.
    tolerance
        Largest error of the tip's position over the largest of q.

    Examples
    --------
    $ rotbeam reference
    $ rotbeam reference --omega 4 --ramp-time 2.5 --duration 8 --samples 801 -o exact
    """
    file = configured(config)
    if duration is None:
        duration = file.numerics.get("duration")
    tolerance = positive("tolerance", tolerance)
    samples = whole_number("samples", samples, least=2)
    motion = motion_of(file, omega=omega, ramp_time=ramp_time, duration=duration)
    spin_up = motion.spin_up
    inputs = {
        **beam_attributes(file.beam), "omega": spin_up.omega, "ramp_time": spin_up.ramp_time,
        "duration": motion.duration, "samples": samples, "tolerance": tolerance,
    }  # fmt: skip
    times = np.linspace(0.0, motion.duration, samples)

    def computed() -> SpinUpResponse:
        with bar("integrating"):
            return analytic.spin_up_response(file.beam, spin_up, times, tolerance=tolerance)

    name = f"exact-omega-{spin_up.omega:g}-ramp-{spin_up.ramp_time:g}"
    results.job(name, inputs, computed, _print)


def _print(response: SpinUpResponse, _: xr.Dataset) -> None:
    spin_up = response.spin_up
    farthest = int(np.abs(response.q).argmax())
    print_line("spin-up", f"ω = {spin_up.omega:g} rad/s in T = {spin_up.ramp_time:g} s")
    print_line("samples", f"{response.time.size}, up to t = {response.time[-1]:g} s")
    print_line(
        "largest |q|",
        f"{abs(response.q[farthest]):.9g} m at t = {response.time[farthest]:g} s, of the samples",
    )
    print_line("error of the tip", f"at most {response.error:.1e} of the largest |q|")
