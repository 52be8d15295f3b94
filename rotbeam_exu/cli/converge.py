"""`rotbeam converge`: errors of mesh and step, and which to take for a tolerance."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from cyclopts import Parameter

from analytic.input_checks import positive, whole_number
from analytic.warning import warn

from ..lazily import xr
from .driving import Driving
from .job import Flag, Results
from .motion import Config, RampTime, SteadySpeed, configured
from .options import Discretization, Whole, Workers
from .output import formatted, print_columns, print_line, print_note


def converge(
    *,
    omega: SteadySpeed = None,
    ramp_time: RampTime = None,
    tolerance: float = 1e-4,
    count: Whole = 3,
    discretization: Discretization = Discretization(),
    driving: Driving = Driving(),
    no_exact: Annotated[Flag, Parameter(name="--no-exact")] = False,
    workers: Workers = Workers(),
    config: Config = None,
    results: Results = Results(),
) -> None:
    """Print the errors of a mesh and a step, and which to take.

    Natural frequencies and one spin-up, as `run` has it, on coarser and finer meshes and smaller
    steps; one fit to all of them gives errors and orders. Writes netCDF and CSV.

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

    file = configured(config)
    numerics = discretization.over(file.numerics)
    case = driving.spin_up_case(file, numerics, omega, ramp_time)
    whole_number("elements", case.elements, least=2)
    whole_number("count", count)
    inputs = {**case.describe(), "tolerance": positive("tolerance", tolerance)}

    def computed() -> xr.Dataset:
        exact = not no_exact
        with workers.counted("spin-ups") as how:
            return comparison.refinement(case, count=count, tolerance=tolerance, exact=exact, **how)

    name = f"converge-{numerics.name}-omega-{case.omega:g}-ramp-{case.ramp_time:g}"
    results.job(name, inputs, computed, _print)


def _print(data: xr.Dataset, _: xr.Dataset) -> None:
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
    attrs, asked = data.attrs, data.sel(mesh=data.attrs["elements"], run=3)
    tolerance = attrs["tolerance"]
    take = f"{int(data['recommended_elements'])} elements, step {data['recommended_step']:.3g} s"
    print_line(f"for {tolerance:g}", take)
    worst = float(np.abs(asked["frequency_error"]).max())
    # Their sum: errors of mesh and step may cancel, by luck.
    error = float(asked["in_mesh"] + asked["in_step"])
    if max(worst, error) > tolerance:
        warn(
            f"{attrs['elements']} elements with a step of {attrs['step']:g} s have errors of "
            f"{worst:.1e} in the frequencies and of {error:.1e} in q(t), more than {tolerance:g}: "
            f"take {take}"
        )
    limit = float(np.abs(data["exact_distance"]).max())
    if limit > tolerance:
        warn(
            f"the limit of this element is {limit:.1e} from the exact frequencies, more than "
            f"{tolerance:g}, so that no mesh mends it: take another element"
        )
