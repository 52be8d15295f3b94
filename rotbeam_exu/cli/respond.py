"""`rotbeam respond`: the forced response of the exact blade, over its frequency."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
from cyclopts import Parameter

import analytic
from analytic.input_checks import positive, whole_number
from analytic.warning import warn

from ..lazily import xr
from .job import Results
from .options import NoFigure, Number, Whole, one_of, option_of
from .output import bar, formatted, print_columns, print_text
from .request import Request, uses

if TYPE_CHECKING:
    from analytic.exact.driven.forced_orbits import ForcedResponse

_AROUND = 0.9, 1.1  # of lag 1's frequency


@uses("omega", "load", "damping", "theory")
def respond(
    request: Request,
    *,
    first: Annotated[Number | None, Parameter(name="--from")] = None,
    last: Annotated[Number | None, Parameter(name="--to")] = None,
    points: Whole = 41,
    functions: Whole = 10,
    no_figure: NoFigure = False,
    results: Results = Results(),
) -> None:
    """Follow a damped, driven blade's response through its folds.

    The blade is the exact one. Prints both ends and, in order along the curve, all folds and peaks,
    and whether it leaves its plane, where the section is known; writes netCDF, CSV and a figure.

    Parameters
    ----------
    first
        Drive frequency at which the curve begins [rad/s]; unless given, 0.9 times lag 1's. Under
        gravity, which goes around once a turn, the rotation speed.
    last
        Drive frequency at which it ends [rad/s]; unless given, 1.1 times lag 1's.
    points
        Number of frequencies, ends included, at which the curve has points.
    functions
        Functions that resolve the beam along its length, at least.

    Examples
    --------
    $ rotbeam respond --omega 6 --tip-force 0.5 --damping-ratio 0.02
    $ rotbeam respond --omega 6 --ripple 0.003 --damping-ratio 0.001 --from 3.6 --to 4
    $ rotbeam respond --gravity --external-damping 0.3 --from 4 --to 6 --points 5
    """
    from ..datasets import response_inputs

    load: Any = one_of(request.loads)
    blade = request.blade
    if load.varied == "frequency" and load.frequency is not None:
        warn("the frequency of the load is that from --from to --to, not its own")
        load = replace(load, frequency=None)
    damping_given = {
        "damping_ratio",
        "external_damping",
    } & request.options.keys()  # perhaps as zero
    if not damping_given and not blade.damping:
        raise ValueError(
            "the blade is undamped, and at resonance its response has no end: give "
            "--damping-ratio or --external-damping, 0 for none, or [blade.damping] in --config"
        )
    omega = None
    if load.varied == "frequency":
        omega = request.omega
    elif "omega" in request.options:
        raise ValueError(
            f"under --{option_of(type(load))} the rotation speeds are those --from one --to "
            "another: leave --omega out"
        )
    elif "omega" in request.values:
        warn(f"{request.config}: under --{option_of(type(load))} omega of [motion] is not used")
    first, last = _ends(request, omega, first, last)
    if positive("from", first, "rad/s") >= positive("to", last, "rad/s"):
        raise ValueError(f"--to must be above --from, got {last:g} and {first:g} rad/s")
    frequencies = np.linspace(first, last, whole_number("points", points, least=2))
    inputs = request.inputs(
        **response_inputs(blade, load, omega),
        **{"from": first, "to": last, "points": points, "functions": functions},
    )

    def computed() -> ForcedResponse:
        how: Any = {"theory": request.theory, "functions": functions}
        with bar("following the curve"):
            if omega is None:
                return analytic.forced_response(blade, frequencies, load, **how)
            return analytic.forced_response(blade, omega, load, frequencies, **how)

    turning = "" if omega is None else f"omega-{omega:g}-"
    loaded = f"{option_of(type(load))}-{load.size:g}"
    results.job(
        f"response-{turning}{loaded}-from-{first:g}-to-{last:g}", inputs, computed, _print,
        table=lambda data: data.drop_dims(["harmonic", "orbit"], errors="ignore"),
        draw=None if no_figure else lambda figures, data: figures.forced_response(data),
    )  # fmt: skip


def _ends(
    request: Request, omega: float | None, first: float | None, last: float | None
) -> tuple[float, float]:
    """Return both ends as given, or about the resonance of lag 1, to three digits."""
    if first is not None and last is not None:
        return first, last
    if omega is None:
        raise ValueError("give the rotation speeds between which to follow it, --from and --to")
    modes = analytic.linear_modes(request.blade, omega, 1, theory=request.theory, only="lag")
    own = (float(f"{share * modes.frequencies[0]:.3g}") for share in _AROUND)
    low, high = (
        of if given is None else given for of, given in zip(own, (first, last), strict=True)
    )
    return low, high


def _print(response: ForcedResponse, data: xr.Dataset) -> None:
    marks = data["mark"].to_numpy()
    (shown,) = np.nonzero(marks)
    frequency = data["frequency"].attrs["long_name"].split()[-1]
    stable = np.where(data["stable"].to_numpy(), "yes", "no")
    print_columns(
        {
            "": marks[shown].tolist(),
            f"{frequency} [rad/s]": formatted(data["frequency"][shown], ".6f"),
            "|q|/L": formatted(data["amplitude"][shown], ".6g"),
            "lag [rad]": formatted(data["phase"][shown], ".4f"),
            # A fold is the limit of both.
            "stable": [
                f"{stable[i - 1]} | {stable[i + 1]}" if marks[i] == "fold" else stable[i]
                for i in shown
            ],
        },
        title=str(response),
    )
    if "planar" in data.attrs:
        print_text(f"{data.attrs['planar']}.")
