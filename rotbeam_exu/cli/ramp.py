"""`rotbeam ramp`: what a spin-up leaves over its ramp time, and the ramp times that leave least."""

from __future__ import annotations

from pathlib import Path

import numpy as np

import analytic
from analytic import AnyBlade, SpinUp
from analytic.input_checks import positive, whole_number

from ..fem.lazily import require_exudyn
from ..lazily import xr
from ..runs.attributes import beam_attributes
from .configuration import configured, motion_of
from .job import Job, drawn
from .motion import chosen_times, refuse_rest
from .options import Discretization, Element, Results, Whole
from .output import new_console, print_columns, print_note
from .progress import counter

_LONGEST = 10.0  # of the paper's beam [s]
_RESULTS = Results()


def ramp(
    *,
    omega: float | None = None,
    longest: float | None = None,
    points: Whole = 9,
    finite_element_points: Whole = 5,
    element: Element | None = None,
    elements: Whole | None = None,
    config: Path | None = None,
    results: Results = _RESULTS,
) -> None:
    """Tell what a spin-up leaves over its ramp time, and where least.

    Printed are the quiet ramp times, and the points; written are all numbers and the figure.

    Parameters
    ----------
    omega
        Speed after the ramp [rad/s], unless [motion] of the file has it; 6 for the paper's beam.
    longest
        Longest ramp time [s]; 10 for the paper's beam.
    points
        Ramp times of exact transients, evenly spaced.
    finite_element_points
        Ramp times of runs in Exudyn, evenly spaced; 0 for none.
    element
        Beam formulation: cable (unless given), exact or reissner, ancf3, linear, substructures.
    elements
        Number of elements, 16 unless given.
    config
        TOML file with the beam or blade, and if it likes with omega in [motion], and element and
        elements in [numerics]; without it, the paper's beam.

    Examples
    --------
    $ rotbeam ramp --omega 6 --longest 10
    """
    from .. import comparison
    from ..fem.elements import formulation

    file = configured(config)
    beam = file.beam
    omega = motion_of(file, omega=omega).spin_up.omega
    mesh = Discretization(element=element, elements=elements).over(file.numerics)
    element, elements = mesh.element, mesh.elements
    refuse_rest(omega)
    longest = chosen_times(beam, _LONGEST)[0] if longest is None else positive("longest", longest)
    for name, count in (("points", points), ("finite-element-points", finite_element_points)):
        whole_number(name, count, least=0)
    inputs = {
        **beam_attributes(beam), "omega": omega, "longest": longest, "points": points,
        "finite_element_points": finite_element_points, "element": formulation(element).name,
        "elements": elements,
    }  # fmt: skip
    if finite_element_points:
        _require_exudyn()

    def computed() -> xr.Dataset:
        with counter(new_console(), "transients") as progress:
            return comparison.residual(
                beam, omega, longest=longest, points=points, element=element, elements=elements,
                finite_element_points=finite_element_points, progress=progress,
            )  # fmt: skip

    Job(
        path=results.out / f"ramp-omega-{omega:g}-longest-{longest:g}",
        inputs=inputs,
        force=results.force,
        compute=computed,
        dataset=lambda data: data.assign_attrs(inputs),
        show=lambda data, _: _print(beam, omega, longest, data),
        draw=drawn(lambda figures, data: figures.residual(data)),
    ).run()


def _require_exudyn() -> None:
    """Say before the transients are computed that the runs cannot be, and what can."""
    try:
        require_exudyn()
    except ImportError as error:
        raise ImportError(f"{error}; take --finite-element-points 0") from error


def _print(beam: AnyBlade, omega: float, longest: float, data: xr.Dataset) -> None:
    """Print the quiet ramps, then the points."""
    one = SpinUp(omega=omega, ramp_time=longest)
    quiet = data["quiet_ramp_time"].to_numpy()
    print_columns(
        {
            "T [s]": [f"{T:.4f}" for T in quiet],
            "left/L": [f"{left:.2e}" for left in data["quiet"].to_numpy()],
            "closed form": [
                f"{left:.2e}" for left in analytic.residual_amplitude(beam, one, quiet)
            ],
        },
        "table",
        title="Quiet ramp times of Eq. 1",
    )
    exact = dict(zip(data["exact_ramp_time"].to_numpy(), data["exact"].to_numpy(), strict=True))
    elements = dict(
        zip(
            data["finite_element_ramp_time"].to_numpy(),
            data["finite_element"].to_numpy(),
            strict=True,
        )
    )
    times = np.array(sorted({*exact, *elements}))
    if not times.size:
        return
    print_columns(
        {
            "T [s]": [f"{T:.4f}" for T in times],
            "closed form": [f"{a:#.4g}" for a in analytic.residual_amplitude(beam, one, times)],
            "with the backbone": [
                f"{a:#.4g}" for a in analytic.residual_amplitude(beam, one, times, corrected=True)
            ],
            "exact": [f"{exact[T]:#.4g}" if T in exact else "-" for T in times],
            "finite elements": [f"{elements[T]:#.4g}" if T in elements else "-" for T in times],
        },
        "table",
        title=f"Amplitude left over L, ω = {omega:g} rad/s",
    )
    print_note(
        "closed form: of the linear beam; with the backbone: its action for that of FrM's orbit; "
        "-: not run there",
    )
