"""`rotbeam fit`: the blade that fits measured frequencies, pulls and histories."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from .job import Flag, Results, require_writable, write_text
from .options import deviations_of
from .output import bar, formatted, print_columns, print_note, print_text, print_written
from .request import Request, uses

if TYPE_CHECKING:
    from analytic.sensitivity import Fit


@uses("section", "theory")
def fit(
    request: Request,
    measured: tuple[Path, ...],
    /,
    *,
    free: Annotated[tuple[str, ...], Parameter(consume_multiple=True)],
    prior: Annotated[tuple[str, ...], Parameter(consume_multiple=True)] = (),
    out: Annotated[Path | None, Parameter(alias="-o")] = None,
    force: Flag = False,
) -> None:
    """Print the numbers of a blade that fit what was measured.

    Least squares with the derivatives of the exact blade, from the blade of the file. Says, too,
    what the data do not determine.

    Parameters
    ----------
    measured
        CSV files, each of one kind: natural frequencies, with the columns mode, omega [rpm],
        frequency [Hz] and deviation [%]; a number of the steady state, as deflection_z [mm], under
        a force fz [N] at x [m]; or one of a spin-up, as tip_y [mm], with time [s], omega [rpm],
        ramp_time [s] and deviation [%] of the largest.
    free
        Numbers to fit, as EI2 EI3 m of the whole blade, or EI2[4] at station 4, counted from 0.
    prior
        Standard deviations about the values of the file, as m=0.02, relative or in their units.
    out
        Folder for netCDF, CSV and the blade, fit.toml; without it none is written.
    force
        Replace results of other inputs that have the same name.

    Examples
    --------
    $ rotbeam fit measured.csv --free EI3 m --prior m=0.02
    $ rotbeam fit measured.csv --config beam.toml --free EI3 -o results
    """
    from analytic.sensitivity import fit as fit_of

    from ..files.measured_file import measured_of

    several = [one for path in measured for one in measured_of(path)]
    target = None if out is None else out / "fit.toml"
    if target:
        require_writable(target, force=force)
    with bar("modes, states and their derivatives"):
        found = fit_of(
            request.blade,
            several,
            free,
            prior=deviations_of("prior", prior),
            theory=request.theory,
        )
    if out is None or target is None:
        _print(found)
        return
    from ..datasets import dataset_of
    from ..files.blade_toml import blade_toml

    Results(out=out, force=force).job("fit", dataset_of(found), show=lambda *_: _print(found))
    write_text(blade_toml(found.blade, theory=request.theory), target)
    print_written([target])


def _print(found: Fit) -> None:
    units = [one.unit for one in found.parameters]
    print_columns(
        {
            "number": [f"{n} [{u}]" for n, u in zip(found.names, units, strict=True)],
            "before": formatted(found.before, ".6g"),
            "after": formatted(found.values, ".6g"),
            "±": formatted(found.deviations, ".2g"),
        },
        title="Numbers of the blade",
    )
    stated = found.measured[0].deviation is not None
    print_columns(
        {
            "measured": [f"{one.label} [{one.unit}]" for one in found.measured],
            "value": formatted([one.value for one in found.measured], ".6g"),
            "blade": formatted(found.computed, ".6g"),
            "deviations off": formatted(found.residuals, "+.2f"),
        },
        title="What was measured",
    )
    part = "" if stated else " of the values, as no deviations are given"
    print_text(f"misfit {found.misfit:.3g}{part}")
    for sentence in found.unknown:
        print_note(sentence)
