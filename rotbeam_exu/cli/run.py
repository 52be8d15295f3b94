"""`rotbeam run` and `rotbeam reference`: one spin-up, in Exudyn and exact."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Literal

import numpy as np
from cyclopts import Parameter

import analytic
from analytic.input_checks import whole_number
from analytic.warning import warn

from ..lazily import xr
from ..runs.attributes import loads_attributes, start_attributes
from ..runs.check import energy_drift
from .job import Flag, Results
from .motion import whose_speeds
from .options import NoFigure, Whole
from .output import bar, print_line
from .request import Request, uses

if TYPE_CHECKING:
    from analytic.exact.driven.response import SpinUpResponse

    from ..fem.case import RunCase
    from ..runs.oscillation import SteadyOscillation
    from ..verification.assessment import Assessment


@uses("speed", "ramp_time", "discretization", "loads", "damping")
def run(
    request: Request,
    *,
    stations: Whole | None = None,
    no_exact: Annotated[Flag, Parameter(name="--no-exact")] = False,
    no_figure: NoFigure = False,
    results: Results = Results(),
) -> None:
    """Spin a beam up in Exudyn and measure the remaining oscillation.

    Writes netCDF, CSV and a figure. Without options it is the paper's beam, 6 rad/s in 3 s; for
    another beam speed, times and step follow its ω_0. A table of stations is run up more slowly, to
    half its ω_0, with elements `space_exact`.

    Parameters
    ----------
    stations
        Keep places, sections, strains and loads at so many stations along the blade, in the netCDF
        alone; `animate --run` shows them.
    no_exact
        Leave out the frequency of the exact beam at the run's amplitude.

    Examples
    --------
    $ rotbeam run
    $ rotbeam run --omega 4 --ramp-time 2.5 --frame rotating --elements 32 -o fine
    $ rotbeam run --config beam.toml --element exact --no-figure
    $ rotbeam run --gravity --damping-ratio 0.01 --no-exact
    """
    from ..runs.oscillation import steady_oscillation
    from ..verification.assessment import assess

    case = request.case()
    chosen = "" if "omega" in request.values else f", {whose_speeds(request.blade)}"
    count = 0 if stations is None else whole_number("stations", stations, least=2)
    kept = np.linspace(0.0, case.blade.length, count)
    name = f"{request.mesh}-omega-{case.omega:g}-ramp-{case.ramp_time:g}"

    def computed() -> xr.Dataset:
        from ..fem.simulation import run_case

        with bar("spinning up") as drawn:
            return run_case(case, stations=kept, progress=lambda done: drawn(done, 1.0))

    def shown(data: xr.Dataset, _: xr.Dataset) -> Assessment:
        try:
            steady = steady_oscillation(data)
        except ValueError as error:  # as of a window that is too short
            raise RuntimeError(f"{error}; the run itself is in {results.out / name}.nc") from error
        with bar("exact frequencies"):
            assessment = assess(case, steady, exact=not no_exact)
        _print_inputs(case, request.values["element"], chosen)
        _print_results(data, steady, assessment)
        return assessment

    assessment = results.job(
        name, case.describe(), computed, shown,
        table=lambda data: data.drop_dims("station", errors="ignore"),
        draw=None if no_figure else lambda figures, data: figures.spin_up(data),
    )  # fmt: skip
    for sentence in assessment.warnings(case.elements, case.step):
        warn(sentence)


def _print_inputs(case: RunCase, element: str, chosen: str) -> None:
    blade = case.blade
    print_line(
        "beam",
        f"L = {blade.length:g} m, EI = {blade.bending_stiffness:.6g} N m², "
        f"EA = {blade.axial_stiffness:.6g} N, m = {blade.mass:.6g} kg, "
        f"ω_0 = {blade.omega_0:.6g} rad/s",
    )
    print_line(
        "spin-up",
        f"ω = {case.omega:g} rad/s in T = {case.ramp_time:g} s "
        f"(Ω = {case.omega / blade.omega_0:.4f}{chosen})",
    )
    if case.loads:
        print_line("loads", "; ".join(map(str, case.loads)))
    numerics = f"{case.frame} frame, step {case.step:g} s, {case.duration:g} s"
    print_line("discretization", f"{case.elements} × {element}; {numerics}")


def _print_results(data: xr.Dataset, steady: SteadyOscillation, assessment: Assessment) -> None:
    """Print measurements, compared with the exact beam, and checks."""
    worst = max(
        float(abs(data["direction_residual"]).max()),
        float(data["clamp_residual"].max()) / data.attrs["blade_length"],
    )
    drift, ripple = energy_drift(data)
    about = [name for name in data.data_vars if str(name).startswith("root_moment_")]
    largest = float((data[about].to_array() ** 2).sum("variable").max()) ** 0.5
    print_line("natural frequency", f"ω_n = {assessment.omega_n:.6f} rad/s (mesh, steady rotation)")
    print_line(
        "steady amplitude",
        f"{steady.amplitude:.5f} L half peak to peak, first harmonic {steady.first_harmonic:.5f} L",
    )
    print_line(
        "steady frequency",
        f"ω_NL = {steady.frequency:.6f} rad/s over {steady.cycles} cycles, "
        f"ω_NL/ω_n = {steady.frequency / assessment.omega_n:.6f}; "
        f"± {steady.frequency_error:.1g} rad/s (fit only; mesh and step not included)",
    )
    for title, text in assessment.lines():
        print_line(title, text)
    print_line("largest root moment", f"{largest:.6g} N m")
    print_line("constraint residual", f"{worst:.2g} (worst)")
    print_line("energy drift", f"{drift:.2g}, ripple {ripple:.2g} of the largest elastic energy")
    print_line("wall time", f"{data.attrs['wall_time']:.2f} s")
    print_line("verdict", assessment.sentence)


@uses("speed", "ramp_time", "duration", "tolerance", "theory", "loads")
def reference(
    request: Request,
    *,
    start: Literal["straight", "steady"] = "straight",
    samples: Whole = 1501,
    results: Results = Results(),
) -> None:
    """Write the exact spin-up as netCDF and CSV.

    The beam is geometrically exact, extensible unless its theory says otherwise; step and functions
    are refined until two solutions agree.

    Parameters
    ----------
    start
        Straight, or in the steady state under the loads as they are at t = 0.
    samples
        Number of times that are written, evenly spaced from 0.

    Examples
    --------
    $ rotbeam reference
    $ rotbeam reference --omega 4 --ramp-time 2.5 --duration 8 --samples 801 -o exact
    """
    motion, tolerance = request.motion, request.tolerance
    samples = whole_number("samples", samples, least=2)
    spin_up = motion.spin_up
    inputs = request.inputs(
        omega=spin_up.omega, ramp_time=spin_up.ramp_time, duration=motion.duration,
        samples=samples, **({"tolerance": tolerance} if tolerance else {}),
        **loads_attributes(request.loads), **start_attributes(start),
    )  # fmt: skip
    times = np.linspace(0.0, motion.duration, samples)

    def computed() -> SpinUpResponse:
        with bar("integrating"):
            return analytic.spin_up_response(
                request.blade, spin_up, times, tolerance=tolerance, theory=request.theory,
                loads=request.loads, start=start,
            )  # fmt: skip

    name = f"exact-omega-{spin_up.omega:g}-ramp-{spin_up.ramp_time:g}"
    results.job(name, inputs, computed, _print_reference)


def _print_reference(response: SpinUpResponse, _: xr.Dataset) -> None:
    spin_up = response.spin_up
    farthest = int(np.abs(response.q).argmax())
    print_line("spin-up", f"ω = {spin_up.omega:g} rad/s in T = {spin_up.ramp_time:g} s")
    print_line("samples", f"{response.time.size}, up to t = {response.time[-1]:g} s")
    print_line(
        "largest |q|",
        f"{abs(response.q[farthest]):.9g} m at t = {response.time[farthest]:g} s, of the samples",
    )
    print_line("error of the tip", f"at most {response.error:.1e} of the largest |q|")
