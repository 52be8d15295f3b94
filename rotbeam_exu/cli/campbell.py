"""`rotbeam campbell`: the Campbell diagram of the exact beam, in the plane and out of it."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import numpy as np
from cyclopts import Parameter

import analytic
from analytic import AnyBlade
from analytic.exact.linear.modes import Plane
from analytic.input_checks import positive, rotation_speed, whole_number

from .job import Job
from .motion import chosen_speeds, configured
from .options import SECTION, Flag, SectionOptions, Whole
from .output import Format, bar, formatted, print_columns

if TYPE_CHECKING:
    from analytic.exact.linear.campbell import Campbell


def campbell(
    *,
    omega_min: float = 0.0,
    omega_max: float | None = None,
    points: Whole = 13,
    count: Whole = 3,
    orders: Whole = 6,
    shape: SectionOptions = SECTION,
    config: Path | None = None,
    format: Format = "table",  # noqa: A002  the name of the option
    out: Annotated[Path | None, Parameter(alias="-o")] = None,
    frequency_max: float | None = None,
    force: Flag = False,
) -> None:
    """Print frequencies over the speed, and where they cross k ω.

    Exact, extensible beam about its steady rotation; modes are tracked by shape, and resolved until
    half as many functions again change no frequency by 1e-9. In the plane (lag), and where the
    section out of it is known, out of it (flap) and in torsion.

    Parameters
    ----------
    omega_min
        Lowest rotation speed [rad/s].
    omega_max
        Highest rotation speed [rad/s]; unless given, twice the file's, or the benchmark's 6 rad/s.
    points
        Number of speeds.
    count
        Number of modes, of each family.
    orders
        Lines k ω up to this k.
    config
        TOML file with the beam; without it, the paper's beam.
    format
        A table to read, or CSV of the frequencies; the crossings are then in the folder only.
    out
        Folder for netCDF, CSV and the figure; without it none is written.
    frequency_max
        Highest frequency in the figure [rad/s]; without it all are drawn.
    force
        Replace a result of other inputs that has the same name.

    Examples
    --------
    $ rotbeam campbell
    $ rotbeam campbell --section rectangle --frequency-max 80 -o results
    $ rotbeam campbell --omega-max 8 --points 5 --count 2 --format csv
    """
    if frequency_max is not None:
        positive("frequency_max", frequency_max, "rad/s")
    file = configured(config)
    beam = shape.of(file.beam)
    usual = 2.0 * file.motion.get("omega", chosen_speeds(beam, 6.0)[0])
    highest = usual if omega_max is None else omega_max
    ends = rotation_speed(omega_min, "omega_min"), rotation_speed(highest, "omega_max")
    speeds = np.linspace(*ends, whole_number("points", points, least=2))
    with bar("modes"):
        diagram = analytic.campbell(beam, speeds, count, orders, planes=_families(beam))
    if out is None:
        _print(diagram, format)
        return
    from ..datasets import dataset_of

    data = dataset_of(diagram)
    Job(
        path=out / f"campbell-{shape.name}", inputs=data, force=force, compute=lambda: data,
        show=lambda *_: _print(diagram, format), aside=format == "csv",
        draw=lambda figures, _: figures.campbell(diagram, highest=frequency_max),
    ).run()  # fmt: skip


def _families(beam: AnyBlade) -> list[Plane]:
    """Return the families of modes that the beam's section determines."""
    known = beam.section.out_of_plane
    if known is None or beam.unit.setting != 1.0:
        return ["lag"]
    twists = known.torsion_ratio is not None and math.isfinite(known.torsion_ratio)
    inert = 0.0 not in (known.polar_inertia, beam.section.rotary_inertia)
    return ["lag", "flap", "torsion"] if twists and inert else ["lag", "flap"]


def _print(diagram: Campbell, form: Format) -> None:
    """Print frequencies over speed, and the crossings.

    A table has as many digits as are known: of torsion four, for the section may be kept from
    warping. CSV has all, and no crossings: one table a stream.
    """
    csv = form == "csv"

    def column(values: Iterable[float], plane: Plane) -> Sequence[str | float]:
        return list(values) if csv else formatted(values, "#.4g" if plane == "torsion" else ".6f")

    unit, omega = (" [rad/s]", "omega [rad/s]") if csv else ("", "ω [rad/s]")
    in_plane = set(diagram.planes) == {"lag"} and diagram.names[0] == "lag 1"
    names = [f"mode {k}" for k, _ in enumerate(diagram.planes, 1)] if in_plane else diagram.names
    columns = zip(names, diagram.planes, diagram.frequencies.T.tolist(), strict=True)
    print_columns(
        {omega: diagram.omegas.tolist() if csv else formatted(diagram.omegas, ".4g")}
        | {f"{name}{unit}": column(found, plane) for name, plane, found in columns},
        form,
        title=f"{'In-plane frequencies' if in_plane else 'Frequencies'} [rad/s]",
    )
    if csv:
        return
    met = diagram.crossings
    named = [names[diagram.planes.index(one.plane) + one.mode - 1] for one in met]
    print_columns(
        {
            "mode": [name.removeprefix("mode ") for name in named] if in_plane else named,
            "k": [str(one.order) for one in met],
            omega: [cell for one in met for cell in column([one.omega], one.plane)],
            "frequency [rad/s]": [x for one in met for x in column([one.frequency], one.plane)],
        },
        title="Crossings with the lines k ω",
    )
