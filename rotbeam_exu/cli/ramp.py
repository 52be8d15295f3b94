"""`rotbeam ramp`: residual vibration over the ramp time, and its minima."""

from __future__ import annotations

from functools import partial

import numpy as np

import analytic
from analytic import Blade, SpinUp
from analytic.input_checks import positive, whole_number
from analytic.spin_up.modes_over_speed import excited_mode

from ..fem.lazily import require_exudyn
from ..lazily import xr
from ..runs.attributes import theory_of
from .job import Results
from .motion import chosen_ramps
from .options import Number, Whole
from .output import counter, formatted, print_columns, print_note
from .request import Request, uses


@uses("speed", "mesh")
def ramp(
    request: Request,
    *,
    mode: str = "lag 1",
    longest: Number | None = None,
    points: Whole = 9,
    finite_element_points: Whole = 5,
    results: Results = Results(),
) -> None:
    """Print the residual vibration over the ramp time, and minima.

    Prints the quiet ramp times and the points; writes all numbers and the figure.

    Parameters
    ----------
    mode
        Mode of the residual vibration, by its name or number.
    longest
        Longest ramp time [s]; 10 for the paper's beam.
    points
        Ramp times of exact transients, evenly spaced.
    finite_element_points
        Ramp times of runs in Exudyn, evenly spaced; 0 for none.

    Examples
    --------
    $ rotbeam ramp --omega 6 --longest 10
    $ rotbeam ramp --config nrel_5mw.toml --mode "flap 1" --points 3
    """
    from .. import comparison

    blade = request.blade
    case = request.case()
    omega = case.omega
    mode = excited_mode(blade, omega, mode, case.model.theory_of(blade))
    if longest is None:
        longest = chosen_ramps(blade)
    positive("longest", longest)
    whole_number("finite-element-points", finite_element_points, least=0)
    inputs = request.inputs(
        omega=omega, mode=mode, longest=longest, points=points,
        finite_element_points=finite_element_points,
        **{name: case.describe()[name] for name in ("element", "element_options", "elements")},
    )  # fmt: skip
    if finite_element_points:
        # Before the transients are computed, for the runs cannot be.
        try:
            require_exudyn()
        except ImportError as error:
            raise ImportError(f"{error}; take --finite-element-points 0") from error

    of_mode = "" if mode == "lag 1" else f"-{mode.replace(' ', '-')}"

    def computed() -> xr.Dataset:
        with counter("ramps") as progress:
            return comparison.residual(
                blade, omega, mode=mode, longest=longest, points=points, element=case.element,
                elements=case.elements, finite_element_points=finite_element_points,
                progress=progress,
            )  # fmt: skip

    results.job(
        f"ramp-omega-{omega:g}-longest-{longest:g}{of_mode}", inputs, computed,
        lambda data, _: _print(blade, omega, longest, data),
        draw=lambda figures, data: figures.residual(data),
    )  # fmt: skip


def _print(blade: Blade, omega: float, longest: float, data: xr.Dataset) -> None:
    """Print the quiet ramps, then the points."""
    one, mode = SpinUp(omega=omega, ramp_time=longest), data.attrs["mode"]
    quiet = data["quiet_ramp_time"].to_numpy()
    left = partial(analytic.residual_amplitude, blade, one, mode=mode, theory=theory_of(data.attrs))
    if quiet.size:
        print_columns(
            {
                "T [s]": formatted(quiet, ".4f"),
                "residual/L": formatted(data["quiet"], ".2e"),
                "closed form": formatted(left(quiet), ".2e"),
            },
            title=f"Quiet ramp times of Eq. 1, {mode}",
        )
    else:
        print_note(f"no quiet ramp time of {mode} up to {longest:g} s")
    exact, elements = (
        dict(zip(data[f"{name}_ramp_time"].to_numpy(), data[name].to_numpy(), strict=True))
        for name in ("exact", "finite_element")
    )
    times = np.array(sorted({*exact, *elements}))
    if not times.size:
        return
    more, note = "all modes", f"of {mode} alone, then of the lowest modes together"
    if corrected := bool(np.isfinite(data["corrected"]).any()):
        more, note = "with the backbone", "linear, then corrected by the action of FrM's orbit"
    better = left(times, corrected=True) if corrected else left(times, all_modes=True)
    print_columns(
        {
            "T [s]": formatted(times, ".4f"),
            "closed form": formatted(left(times), "#.4g"),
            more: formatted(better, "#.4g"),
            "exact": formatted([exact.get(T, np.nan) for T in times], "#.4g"),
            "finite elements": formatted([elements.get(T, np.nan) for T in times], "#.4g"),
        },
        title=f"Residual amplitude over L, ω = {omega:g} rad/s",
    )
    across = "out of the plane of rotation" if mode.startswith("flap") else "in its plane"
    print_note(
        f"closed form: {note}; exact and finite elements: half peak to peak of all modes {across}; "
        "-: no transient"
    )
