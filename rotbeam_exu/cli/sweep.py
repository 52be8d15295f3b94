"""`rotbeam sweep` and `rotbeam converge`: spin-ups over a grid, and over meshes and steps."""

from __future__ import annotations

from typing import Annotated, Any

import numpy as np
from cyclopts import Parameter

from analytic.input_checks import positive, whole_number
from analytic.warning import warn

from .. import paper
from ..lazily import xr
from .job import Flag, Results
from .motion import chosen_speeds, chosen_times, grid_motion, refuse_rest, whose_speeds
from .options import Number, Numbers, Whole, Workers
from .output import formatted, print_columns, print_line, print_note, print_text
from .request import Request, uses


@uses("motion", "discretization", "loads", "damping")
def sweep(
    request: Request,
    *,
    omega: Numbers = None,
    ramp_time: Numbers = None,
    workers: Workers = Workers(),
    results: Results = Results(),
) -> None:
    """Spin the beam up over a grid of speeds and ramp times.

    The default is the paper's grid; a speed or ramp time in [motion] of a file is the grid's only
    one, unless others are given. Failed cases stay on record and end in exit code 1; a sweep that
    was stopped goes on where it stopped.

    Parameters
    ----------
    omega
        Steady angular velocities [rad/s].
    ramp_time
        Ramp times T [s].

    Examples
    --------
    $ rotbeam sweep
    $ rotbeam sweep --omega 4 6 --ramp-time 2.5 3 --step 2e-3 -o quick
    $ rotbeam sweep --config beam.toml --cache runs --jobs 1
    """
    from ..sweeps.grid import sweep as run_sweep

    blade, given = request.blade, request.values
    omegas, ramp_times = omega, ramp_time
    if omegas is None:
        omegas = [given["omega"]] if "omega" in given else chosen_speeds(blade, *paper.SPEEDS)
    if ramp_times is None:
        scaled = chosen_times(blade, *paper.RAMP_TIMES, digits=4)
        ramp_times = [given["ramp_time"]] if "ramp_time" in given else scaled
    refuse_rest(*omegas)
    motion = grid_motion(
        blade, omegas, ramp_times, duration=given.get("duration"), step=given.get("step")
    )
    count = len(omegas) * len(ramp_times)
    one = request.case(motion)

    def computed() -> xr.Dataset:
        if request.config is not None:
            speeds, times = (", ".join(f"{x:g}" for x in of) for of in (omegas, ramp_times))
            print_text(
                f"ω = {speeds} rad/s, T = {times} s (by default {whose_speeds(blade)} ω/ω_0)"
            )
        with workers.counted("spin-ups") as how:
            return run_sweep(
                blade, omegas=omegas, ramp_times=ramp_times, element=one.element,
                elements=one.elements, duration=one.duration, step=one.step, frame=one.frame,
                loads=one.loads, on_error="record", **how,
            )  # fmt: skip

    name, grid = f"sweep-{request.mesh}", {"omega": omegas, "ramp_time": ramp_times}
    failed = results.job(name, {**one.describe(), **grid}, computed, _print)
    if failed:
        raise RuntimeError(
            f"{failed} of {count} spin-ups failed; why is above, and as `failure` in "
            f"{results.out / name}.nc"
        )


def _print(result: xr.Dataset, _: xr.Dataset) -> int:
    """Print the result, and why cases failed; return how many did."""
    from ..sweeps.grid import failures

    rows = result.to_dataframe().reset_index()
    columns: dict[str, Any] = {
        "ω [rad/s]": rows["omega"],
        "T [s]": rows["ramp_time"],
        "amplitude a/L": rows["amplitude"],
        "ω_NL [rad/s]": rows["frequency"],
        "±": formatted(rows["frequency_error"], ".1e"),
        "ω_NL/ω_n": rows["frequency"] / rows["omega_n"],
        "equations": rows["verdict"].replace("passed", "solved"),
    }
    attrs = result.attrs
    print_columns(
        {title: list(values) for title, values in columns.items()},
        title=f"{attrs['elements']} {attrs['element']} elements, {attrs['frame']} frame, "
        f"step {attrs['step']:g} s, to {attrs['duration']:g} s",
    )
    failed = failures(result)
    for sentence, points in failed.items():
        where = "; ".join(f"ω = {omega:g} rad/s, T = {time:g} s" for omega, time in points)
        print_text(f"failed at {where}: {sentence}")
    return sum(map(len, failed.values()))


@uses("speed", "ramp_time", "discretization", "loads", "damping")
def converge(
    request: Request,
    *,
    tolerance: Number = 1e-4,
    count: Whole = 3,
    no_exact: Annotated[Flag, Parameter(name="--no-exact")] = False,
    workers: Workers = Workers(),
    results: Results = Results(),
) -> None:
    """Print the errors of a mesh and a step, and which to take.

    Natural frequencies and one spin-up, as `run` has it, on coarser and finer meshes and smaller
    steps; one fit to all of them gives errors and orders. Writes netCDF and CSV. Frequencies of a
    mesh and spin-ups that are done stay in the cache: a call that was stopped goes on from there.

    Parameters
    ----------
    tolerance
        Wished relative error of the frequencies, and of q(t) over its largest size.
    count
        Number of frequencies.
    no_exact
        Leave out the exact beam; the errors are by the fit all the same.

    Examples
    --------
    $ rotbeam converge
    $ rotbeam converge --config beam.toml --tolerance 1e-3 --jobs 2 -o mine
    """
    from .. import comparison

    case = request.case()
    whole_number("elements", case.elements, least=2)
    whole_number("count", count)
    inputs = {**case.describe(), "tolerance": positive("tolerance", tolerance)}

    def computed() -> xr.Dataset:
        exact = not no_exact
        pieces = "frequencies and spin-ups"
        with workers.counted(pieces, pieces) as how:
            return comparison.refinement(case, count=count, tolerance=tolerance, exact=exact, **how)

    name = f"converge-{request.mesh}-omega-{case.omega:g}-ramp-{case.ramp_time:g}"
    results.job(name, inputs, computed, _print_errors)


def _print_errors(data: xr.Dataset, _: xr.Dataset) -> None:
    """Print errors, orders and what to take; warn where the mesh asked about misses it."""
    print_columns(
        {
            "mode": [str(k) for k in data["mode"].values],
            **{
                f"{int(n)} elements": formatted(row, "+.1e")
                for n, row in zip(data["mesh"], data["frequency_error"], strict=True)
            },
            "order": formatted(data["frequency_order"], ".1f"),
            "limit less exact": formatted(data["exact_distance"], "+.1e"),
            "±": formatted(data["frequency_uncertainty"], ".0e"),
        },
        title="Natural frequencies: relative error by one fit to all meshes",
    )
    print_columns(
        {
            "elements": [str(n) for n in data["elements"].values],
            "step [s]": formatted(data["step"], "g"),
            "error": formatted(data["error"], ".1e"),
            "of the mesh": formatted(data["in_mesh"], ".1e"),
            "of the step": formatted(data["in_step"], ".1e"),
            "from the exact": formatted(data["exact_error"], ".1e"),
        },
        title="q(t) over its largest size: error by one fit to all runs",
    )
    orders = formatted(map(float, (data["order"], data["order_in_step"])), ".1f")
    print_line("orders of q(t)", f"{orders[0]} in the mesh, {orders[1]} in the step")
    if "-" in orders:
        print_note("-: the runs do not show it")
    attrs, finest = data.attrs, data.sel(mesh=data.attrs["elements"], run=3)
    tolerance = attrs["tolerance"]
    take = f"{int(data['recommended_elements'])} elements, step {data['recommended_step']:.3g} s"
    print_line(f"for {tolerance:g}", take)
    worst = float(np.abs(finest["frequency_error"]).max())
    # Their sum: errors of mesh and step may cancel, by luck.
    error = float(finest["in_mesh"] + finest["in_step"])
    if max(worst, error) > tolerance:
        warn(
            f"{attrs['elements']} elements with a step of {attrs['step']:g} s have errors of "
            f"{worst:.1e} in the frequencies and of {error:.1e} in q(t), more than {tolerance:g}: "
            f"take {take}"
        )
    # What the runs leave open of their limit is no error of the element.
    limit = float((np.abs(data["exact_distance"]) - data["frequency_uncertainty"]).max())
    if limit > tolerance:
        warn(
            f"the limit of this element is at least {limit:.1e} from the exact "
            f"frequencies, more than {tolerance:g}, so that no mesh mends it: take another element"
        )
