"""`rotbeam campbell`: the Campbell diagram of the exact beam, in the plane and out of it."""

from __future__ import annotations

import math
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import numpy as np
from cyclopts import Parameter

import analytic
from analytic.arrays import FloatArray
from analytic.input_checks import positive, rotation_speed, whole_number

from .job import Flag, Results
from .options import Number, Whole
from .output import bar, formatted, print_columns, print_note
from .request import Request, uses

if TYPE_CHECKING:
    from analytic.exact.linear.campbell import Campbell


@uses("section", "theory", "tolerance", "motion.omega", "uncertainty")
def campbell(
    request: Request,
    *,
    omega_min: Number = 0.0,
    omega_max: Number | None = None,
    points: Whole = 13,
    count: Whole = 3,
    orders: Whole = 6,
    out: Annotated[Path | None, Parameter(alias="-o")] = None,
    frequency_max: Number | None = None,
    scatter: Annotated[tuple[str, ...], Parameter(consume_multiple=True)] = (),
    length: Number | None = None,
    force: Flag = False,
) -> None:
    """Print frequencies over the speed, and where they cross k ω.

    Exact, extensible beam about its steady rotation; modes are tracked by shape, and resolved to a
    tolerance. Lag and axial modes, and where the section out of the plane is known, flap and
    torsion.

    Parameters
    ----------
    omega_min
        Lowest rotation speed [rad/s].
    omega_max
        Highest rotation speed [rad/s]; unless given, twice the file's, or the one that `run` takes.
    points
        Number of speeds.
    count
        Number of modes, those lowest at the first speed.
    orders
        Lines k ω up to this k.
    out
        Folder for netCDF, CSV and the figure; without it none is written.
    frequency_max
        Highest frequency in the figure [rad/s]; without it all are drawn.
    scatter
        Standard deviations of numbers of the blade, as EI3=0.05 m=0.03; unless given,
        [uncertainty] of the file. Prints and draws the scatter of the frequencies.
    length
        Correlation length of the scatter along the blade [m]; unless given, all stations are off
        together.
    force
        Replace a result of other inputs that has the same name.

    Examples
    --------
    $ rotbeam campbell
    $ rotbeam campbell --section rectangle --frequency-max 80 -o results
    $ rotbeam campbell --omega-max 6 --points 4 --scatter EI3=0.05 m=0.03
    $ rotbeam campbell --omega-max 8 --points 5 --count 2 -o results
    """
    if frequency_max is not None:
        positive("frequency_max", frequency_max, "rad/s")
    deviations, correlated = request.scatter(scatter, length)
    blade = request.blade
    usual = 2.0 * request.motion.spin_up.omega
    highest = usual if omega_max is None else omega_max
    ends = rotation_speed(omega_min, "omega_min"), rotation_speed(highest, "omega_max")
    speeds = np.linspace(*ends, whole_number("points", points, least=2))
    with bar("modes"):
        diagram = analytic.campbell(
            blade, speeds, count, orders, theory=request.theory, tolerance=request.tolerance
        )
    band: FloatArray | None = None
    if deviations:
        from analytic.sensitivity import campbell_spread

        with bar("scatter"):
            band = campbell_spread(diagram, deviations, correlated)
    if out is None:
        _print(diagram, band)
        return
    from ..datasets import dataset_of

    data = dataset_of(diagram)
    if band is not None:
        about = {"long_name": "standard deviation of the frequency", "units": "rad/s"}
        data["deviation"] = ("omega", "mode"), band, about
    Results(out=out, force=force).job(
        f"campbell-{request.section}", data, show=lambda *_: _print(diagram, band),
        draw=lambda figures, _: figures.campbell(
            diagram, highest=frequency_max, deviations=band
        ),
    )  # fmt: skip


def _print(diagram: Campbell, band: FloatArray | None) -> None:
    """Print frequencies over speed, and the crossings, with as many digits as are known."""

    def column(values: Iterable[float], name: str) -> list[str]:
        # Torsion has four digits, for the section may be kept from warping.
        return formatted(values, "#.4g" if name.startswith("torsion") else ".6f")

    omega, turn, names = "ω [rad/s]", 2.0 * math.pi, diagram.names
    for unit, speed, per_second, over in (("rad/s", omega, 1.0, 1.0), ("Hz", "rpm", turn, 60.0)):
        rows = (diagram.frequencies.T / per_second).tolist()
        print_columns(
            {speed: formatted(diagram.omegas * over / per_second, ".4g")}
            | {name: column(row, name) for name, row in zip(names, rows, strict=True)},
            title=f"Frequencies [{unit}]",
        )
    if veered := [title for title in diagram.titles if title not in names]:
        print_note(
            "Modes are named by their motion at the lowest speed. Where two veer they exchange it: "
            f"at {diagram.omegas[-1]:.4g} rad/s {', '.join(veered)}"
        )
    if band is not None:
        percent = (100.0 * band / diagram.frequencies).T
        print_columns(
            {omega: formatted(diagram.omegas, ".4g")}
            | {name: formatted(row, ".3g") for name, row in zip(names, percent, strict=True)},
            title="Standard deviations [%]",
        )
    met = diagram.crossings
    print_columns(
        {
            "mode": [one.mode for one in met],
            "k": [str(one.order) for one in met],
            omega: [x for one in met for x in column([one.omega], one.mode)],
            "rpm": formatted([60.0 * one.omega / turn for one in met], ".4g"),
            "frequency [rad/s]": [x for one in met for x in column([one.frequency], one.mode)],
            "Hz": formatted([one.frequency / turn for one in met], ".4g"),
        },
        title="Crossings with the lines k ω",
    )
