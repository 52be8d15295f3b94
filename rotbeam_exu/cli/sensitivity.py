"""`rotbeam sensitivity`: what each number of a blade does to its frequencies."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import numpy as np
from cyclopts import Parameter

import analytic
from analytic.input_checks import rotation_speed, whole_number

from .job import Flag, Results
from .options import Number, Whole
from .output import bar, formatted, print_columns, print_text
from .request import Request, uses

if TYPE_CHECKING:
    from analytic.sensitivity import Sensitivity

_DIGITS = 7  # of percents; derivatives have no more


@uses("section", "theory", "tolerance", "motion.omega")
def sensitivity(
    request: Request,
    *,
    omega: Number | None = None,
    count: Whole = 4,
    rows: Whole = 15,
    scatter: Annotated[tuple[str, ...], Parameter(consume_multiple=True)] = (),
    length: Number | None = None,
    out: Annotated[Path | None, Parameter(alias="-o")] = None,
    force: Flag = False,
) -> None:
    """Print how frequencies change with the numbers of a blade.

    Of the exact blade about its steady rotation, at a speed that stays. Stiffness, mass, offsets
    and twist of a table at each of its stations, too; those first that change a frequency most.

    Parameters
    ----------
    omega
        Rotation speed [rad/s]; unless given, that of the file, or zero.
    count
        Number of modes.
    rows
        Largest number of rows of stations that are printed; netCDF and CSV have all.
    scatter
        Standard deviations, pairs of a number of the whole blade and its deviation, relative or in
        its unit, as EI3=0.05 m=0.03: prints the scatter of the frequencies, and where it is from.
    length
        Correlation length of the scatter along the blade [m]; unless given, all stations are off
        together.
    out
        Folder for netCDF and CSV; without it none is written.
    force
        Replace a result of other inputs that has the same name.

    Examples
    --------
    $ rotbeam sensitivity --omega 6
    $ rotbeam sensitivity --omega 6 --scatter EI3=0.05 m=0.03
    $ rotbeam sensitivity --omega 6 --section rectangle --count 3 -o results
    """
    from analytic.sensitivity import sensitivity as sensitivity_of

    speed = rotation_speed(request.values.get("omega", 0.0) if omega is None else omega)
    whole_number("rows", rows, least=0)
    deviations = _deviations(scatter)
    with bar("modes and derivatives"):
        modes = analytic.linear_modes(
            request.blade, speed, count, theory=request.theory, tolerance=request.tolerance
        )
        found = sensitivity_of(modes)
    if out is None:
        _print(found, rows)
    else:
        from ..datasets import dataset_of

        Results(out=out, force=force).job(
            f"sensitivity-omega-{speed:g}", dataset_of(found), show=lambda *_: _print(found, rows)
        )
    if deviations:
        _print_spread(found, deviations, math.inf if length is None else length)


def _deviations(pairs: Sequence[str]) -> dict[str, float]:
    """Return the deviations of --scatter by name."""
    found: dict[str, float] = {}
    for pair in pairs:
        name, _, value = pair.partition("=")
        if name in found:
            raise ValueError(f"--scatter has {name} twice")
        try:
            found[name] = float(value)
        except ValueError:
            raise ValueError(f"--scatter takes name=deviation, as EI3=0.05, got {pair!r}") from None
    return found


def _print_spread(found: Sensitivity, scatter: Mapping[str, float], length: float) -> None:
    from analytic.sensitivity import spread

    result = spread(found, scatter, length)
    shares = zip(result.parameters, result.shares.T, strict=True)
    print_columns(
        {
            "mode": list(found.modes.names),
            "ω [rad/s]": formatted(found.modes.frequencies, ".5g"),
            "± [%]": formatted(100.0 * result.relative, ".3g"),
            **{f"of {name} [%]": formatted(100.0 * of, ".1f") for name, of in shares},
        },
        title="Standard deviation of the frequencies, and shares in its square",
    )


def _print(found: Sensitivity, rows: int) -> None:
    """Print changes in percent, of the whole blade and of what matters most at stations."""
    steps = np.array([one.step for one in found.parameters])
    percent = 100.0 * found.derivatives * steps / found.modes.frequencies[:, None]
    largest = np.abs(percent).max(axis=0)
    stations = [k for k, one in enumerate(found.parameters) if one.family]
    whole = [k for k in range(steps.size) if k not in set(stations)]
    first = sorted(stations, key=lambda k: -largest[k])[:rows]
    for title, places in (("the whole blade", whole), ("one station", first)):
        if not places:
            continue
        several = [found.parameters[k] for k in places]
        print_columns(
            {
                "number": [one.name for one in several],
                "change": [_change(one.step, one.size, one.unit) for one in several],
                **{
                    name: [f"{round(value, _DIGITS) + 0.0:+.3g}" for value in row[places].tolist()]
                    for name, row in zip(found.modes.names, percent, strict=True)
                },
            },
            title=f"Change of the frequencies [%] by a change of {title}, at {found.omega:g} rad/s",
        )
    if len(first) < len(stations):
        print_text(f"{len(stations) - len(first)} more numbers of stations change less")


def _change(step: float, size: float, unit: str) -> str:
    """Return a change in words."""
    if unit == "rad":
        return f"+{math.degrees(step):g} deg"
    return f"+{step:.3g} {unit}" if unit == "m" else f"+{100.0 * step / size:g} %"
