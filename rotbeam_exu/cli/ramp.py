"""`rotbeam ramp`: residual vibration over the ramp time, and its minima."""

from __future__ import annotations

import numpy as np

import analytic
from analytic import Blade, SpinUp
from analytic.blade_checks import require_planar
from analytic.input_checks import positive, whole_number

from ..fem.lazily import require_exudyn
from ..lazily import xr
from .job import Results
from .motion import chosen_times
from .options import Number, Whole
from .output import counter, formatted, print_columns, print_note
from .request import Request, uses


@uses("speed", "mesh")
def ramp(
    request: Request,
    *,
    longest: Number | None = None,
    points: Whole = 9,
    finite_element_points: Whole = 5,
    results: Results = Results(),
) -> None:
    """Print the residual vibration over the ramp time, and minima.

    Prints the quiet ramp times and the points; writes all numbers and the figure.

    Parameters
    ----------
    longest
        Longest ramp time [s]; 10 for the paper's beam.
    points
        Ramp times of exact transients, evenly spaced.
    finite_element_points
        Ramp times of runs in Exudyn, evenly spaced; 0 for none.

    Examples
    --------
    $ rotbeam ramp --omega 6 --longest 10
    """
    from .. import comparison

    blade = request.blade
    require_planar(blade, "ramp is for", "rotbeam reference, which has one ramp in space")
    case = request.case()
    omega = case.omega
    longest = chosen_times(blade, 10.0)[0] if longest is None else positive("longest", longest)
    whole_number("finite-element-points", finite_element_points, least=0)
    inputs = request.inputs(
        omega=omega, longest=longest, points=points, finite_element_points=finite_element_points,
        **{name: case.describe()[name] for name in ("element", "element_options", "elements")},
    )  # fmt: skip
    if finite_element_points:
        # Before the transients are computed, for the runs cannot be.
        try:
            require_exudyn()
        except ImportError as error:
            raise ImportError(f"{error}; take --finite-element-points 0") from error

    def computed() -> xr.Dataset:
        with counter("transients") as progress:
            return comparison.residual(
                blade, omega, longest=longest, points=points, element=case.element,
                elements=case.elements, finite_element_points=finite_element_points,
                progress=progress,
            )  # fmt: skip

    results.job(
        f"ramp-omega-{omega:g}-longest-{longest:g}", inputs, computed,
        lambda data, _: _print(blade, omega, longest, data),
        draw=lambda figures, data: figures.residual(data),
    )  # fmt: skip


def _print(blade: Blade, omega: float, longest: float, data: xr.Dataset) -> None:
    """Print the quiet ramps, then the points."""
    one = SpinUp(omega=omega, ramp_time=longest)
    quiet = data["quiet_ramp_time"].to_numpy()
    left = analytic.residual_amplitude
    print_columns(
        {
            "T [s]": formatted(quiet, ".4f"),
            "residual/L": formatted(data["quiet"], ".2e"),
            "closed form": formatted(left(blade, one, quiet), ".2e"),
        },
        title="Quiet ramp times of Eq. 1",
    )
    exact, elements = (
        dict(zip(data[f"{name}_ramp_time"].to_numpy(), data[name].to_numpy(), strict=True))
        for name in ("exact", "finite_element")
    )
    times = np.array(sorted({*exact, *elements}))
    if not times.size:
        return
    print_columns(
        {
            "T [s]": formatted(times, ".4f"),
            "closed form": formatted(left(blade, one, times), "#.4g"),
            "with the backbone": formatted(left(blade, one, times, corrected=True), "#.4g"),
            "exact": formatted([exact.get(T, np.nan) for T in times], "#.4g"),
            "finite elements": formatted([elements.get(T, np.nan) for T in times], "#.4g"),
        },
        title=f"Residual amplitude over L, ω = {omega:g} rad/s",
    )
    print_note(
        "closed form: linear beam; with the backbone: corrected by the action of FrM's orbit; "
        "-: no run",
    )
