"""`rotbeam sensitivity`: what each number of a blade does to its frequencies."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
from cyclopts import Parameter

import analytic
from analytic.exact.linear.families import LinearModes
from analytic.exact.linear.steady_state import SteadyState
from analytic.input_checks import rotation_speed, whole_number
from analytic.warning import warn

from .job import Flag, Results
from .options import Number, Numbers, Whole
from .output import bar, formatted, print_columns, print_text
from .request import Request, uses

if TYPE_CHECKING:
    from analytic.sensitivity import Sensitivity

_DIGITS = 7  # of percents; derivatives have no more


@uses("section", "theory", "tolerance", "motion.omega", "loads", "uncertainty")
def sensitivity(
    request: Request,
    *,
    omega: Number | None = None,
    count: Whole = 4,
    steady: Flag = False,
    amplitude: Numbers = None,
    rows: Whole = 15,
    scatter: Annotated[tuple[str, ...], Parameter(consume_multiple=True)] = (),
    length: Number | None = None,
    out: Annotated[Path | None, Parameter(alias="-o")] = None,
    force: Flag = False,
) -> None:
    """Print what each number does to a blade's frequencies or loads.

    Of the exact blade in steady rotation, at a speed that stays. Stiffness, mass, offsets and twist
    of a table at each of its stations, too; those first that change a frequency most.

    Parameters
    ----------
    omega
        Rotation speed [rad/s]; unless given, that of the file, or zero.
    count
        Number of modes.
    steady
        Of the steady state under the loads instead: its tip, and force and moment on the clamp.
    amplitude
        Of free orbits of lag 1 with these peaks over the length instead.
    rows
        Largest number of rows of stations that are printed; netCDF and CSV have all.
    scatter
        Standard deviations, pairs of a number of the whole blade and its deviation, relative or in
        its unit, as EI3=0.05 m=0.03; unless given, [uncertainty] of the file. Prints the scatter
        that comes of it, and where it is from.
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
    $ rotbeam sensitivity --steady --omega 6 --section rectangle
    $ rotbeam sensitivity --omega 6 --amplitude 0.1 0.3
    $ rotbeam sensitivity --omega 6 --section rectangle --count 3 -o results
    """
    from analytic.sensitivity import sensitivity as sensitivity_of

    speed = rotation_speed(request.values.get("omega", 0.0) if omega is None else omega)
    whole_number("rows", rows, least=0)
    deviations, correlated = request.scatter(scatter, length)
    if steady and amplitude:
        raise ValueError("--steady and --amplitude are of different answers: keep one")
    if request.loads and not steady:
        warn("this command does not use [[loads]] without --steady")
    blade = request.blade
    settings: Any = {"theory": request.theory, "tolerance": request.tolerance}
    kind = "steady-" if steady else "orbits-" if amplitude else ""
    with bar("answer and derivatives"):
        if amplitude:
            found = sensitivity_of(
                analytic.periodic_orbits(blade, speed, amplitude, theory=request.theory)
            )
        elif steady:
            found = sensitivity_of(
                analytic.steady_state(blade, speed, loads=request.loads, **settings)
            )
        else:
            found = sensitivity_of(analytic.linear_modes(blade, speed, count, **settings))
    if out is None:
        _print(found, rows)
    else:
        from ..datasets import dataset_of

        Results(out=out, force=force).job(
            f"sensitivity-{kind}omega-{speed:g}",
            dataset_of(found),
            show=lambda *_: _print(found, rows),
            draw=lambda figures, _: figures.tornado(found),
        )
    if deviations:
        _print_spread(found, deviations, correlated)


def _print_spread(found: Sensitivity, scatter: Mapping[str, float], length: float) -> None:
    from analytic.sensitivity import spread

    result = spread(found, scatter, length)
    shares = zip(result.parameters, result.shares.T, strict=True)
    print_columns(
        {
            **_values(found),
            "±": formatted(result.deviations, ".3g"),
            "± [%]": formatted(100.0 * result.relative, ".3g"),
            **{f"of {name} [%]": formatted(100.0 * of, ".1f") for name, of in shares},
        },
        title="Standard deviations, and shares in their squares",
    )


def _values(found: Sensitivity) -> dict[str, list[str]]:
    """Return columns of what was computed."""
    if isinstance(found.answer, LinearModes):
        return {"mode": [*found.outputs], "ω [rad/s]": formatted(found.values, ".5g")}
    names = [*map(_title, found.outputs, found.units)]
    return {"number": names, "value": formatted(found.values, ".6g")}


def _title(output: str, unit: str) -> str:
    return f"{output} [{unit}]"


def _print(found: Sensitivity, rows: int) -> None:
    """Print changes of the whole blade and of what matters most at stations.

    Those of frequencies in percent.
    """
    changes = found.derivatives * [one.step for one in found.parameters]
    groups: tuple[tuple[str, slice], ...]
    if isinstance(found.answer, LinearModes):
        changes *= 100.0 / found.values[:, None]
        titles, groups = [*found.outputs], (("frequencies [%]", slice(None)),)
    else:
        print_columns(_values(found), title=f"Answer at {found.omega:g} rad/s")
        titles = [*map(_title, found.outputs, found.units)]
        half = len(titles) // 2
        groups = (("frequency", slice(half)), ("softening", slice(half, None)))
        if isinstance(found.answer, SteadyState):
            groups = (("tip", slice(4)), ("force", slice(4, 7)), ("moment", slice(7, 10)))
    stations = [k for k, one in enumerate(found.parameters) if one.family]
    whole = np.setdiff1d(np.arange(len(found.parameters)), stations).tolist()
    for what, some in groups:
        of = changes[some]
        largest = np.abs(of).max(axis=0)
        first = sorted(stations, key=lambda k: -largest[k])[:rows]
        for title, places in (("the whole blade", whole), ("one station", first)):
            several = [found.parameters[k] for k in places]
            if not several:
                continue
            print_columns(
                {
                    "number": [one.name for one in several],
                    "change": [one.change for one in several],
                    **{
                        name: [f"{round(value, _DIGITS) + 0.0:+.3g}" for value in row.tolist()]
                        for name, row in zip(titles[some], of[:, places], strict=True)
                    },
                },
                title=f"Change of the {what} by a change of {title}, at {found.omega:g} rad/s",
            )
        if len(first) < len(stations):
            print_text(f"{len(stations) - len(first)} more numbers of stations change less")
