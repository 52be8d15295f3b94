"""`rotbeam blade`: mass, stiffness and first frequencies of the blade in a file."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, get_args

import numpy as np
from cyclopts import Parameter

import analytic
from analytic import Blade
from analytic.arrays import FloatArray
from analytic.station_section import Interpolation, StationSection

from ..files.blade_toml import blade_toml
from ..files.openfast import blade_file_of, write_beamdyn
from .job import Flag, require_writable, write_text
from .output import bar, formatted, print_columns, print_line, print_note, print_written
from .request import Request, uses

if TYPE_CHECKING:
    from analytic.exact.linear.families import LinearModes

_COUNT = 6  # modes
_CHANGE = 1e-4  # of frequencies with the other interpolation, which a person reads in percent


@uses("theory", "tolerance", "motion.omega")
def blade(
    request: Request,
    *,
    out: Annotated[Path | None, Parameter(alias="-o")] = None,
    force: Flag = False,
) -> None:
    """Print mass, stiffness and frequencies of a blade, or write it.

    The frequencies are at rest and at the speed of the file.

    Of a table of stations it also prints by how much the frequencies at rest change with the other
    interpolation between stations, which is a convention.

    Parameters
    ----------
    out
        File to write the blade into, and compute nothing: .toml, or .dat for BeamDyn's two files.
    force
        Replace a file that has this name.

    Examples
    --------
    $ rotbeam blade
    $ rotbeam blade --config beam.toml
    $ rotbeam blade --config x_BeamDyn.dat --out blade.toml
    """
    blade, omega = request.blade, request.values.get("omega", 0.0)
    how: dict[str, Any] = {"theory": request.theory, "tolerance": request.tolerance}
    if out is not None:
        _write(request, out, force=force)
        return
    with bar("modes"):
        rest = analytic.linear_modes(blade, 0.0, _COUNT, **how)
        turning = {}
        if omega:
            modes = analytic.linear_modes(blade, omega, _COUNT, **how)
            turning[f"at {omega:g} rad/s [Hz]"] = _named(modes, rest) / (2.0 * np.pi)
        others = {}
        if table := blade.table:
            (way,) = set(get_args(Interpolation)) - {table.interpolation}
            others[way] = _changes(blade, table, way, rest, how)
    place, mass = blade.unit.inertia(32)
    moment = float(place @ mass) * blade.mass_per_length * blade.length**2
    print_line("length", f"{blade.length:g} m, on a hub of {blade.hub_radius:g} m")
    print_line("mass", f"{blade.mass:.7g} kg")
    print_line("first moment", f"{moment:.7g} kg m about the clamp")
    print_line("center of mass", f"{moment / blade.mass:.5g} m from the clamp")
    _print_section(blade)
    print_columns(
        {
            "mode": list(rest.names),
            "at rest [Hz]": formatted(rest.frequencies / (2.0 * np.pi), ".6f"),
            "[rad/s]": formatted(rest.frequencies, ".6f"),
            **{title: formatted(values, ".6f") for title, values in turning.items()},
            **{f'"{way}" [%]': formatted(changes, "+.2f") for way, changes in others.items()},
        },
        title=f"Frequencies, {request.theory}",
    )
    for way, changes in others.items():
        print_note(
            f'"{way}": the change with interpolation = "{way}" in [blade.stations]'
            + ("; these frequencies did not settle" if np.isnan(changes).any() else "")
        )


def _write(request: Request, target: Path, *, force: bool) -> None:
    """Write the blade as TOML, with the file's speed and theory, or as BeamDyn's two files."""
    if target.suffix not in (".toml", ".dat"):
        raise ValueError(f"cannot write {target.name!r}: the ending must be .toml or .dat")
    require_writable(target, force=force)
    if target.suffix == ".dat":
        require_writable(blade_file_of(target), force=force)
        print_written(write_beamdyn(request.blade, target))
        return
    motion = {name: request.values[name] for name in ("omega",) if name in request.values}
    write_text(blade_toml(request.blade, motion=motion, theory=request.theory), target)
    print_written([target])


def _changes(
    blade: Blade,
    section: StationSection,
    way: Interpolation,
    rest: LinearModes,
    how: Mapping[str, Any],
) -> FloatArray:
    """Return the relative changes of frequencies [%] with the other interpolation."""
    other = replace(blade, section=replace(section, interpolation=way))
    try:
        modes = analytic.linear_modes(other, 0.0, _COUNT, **{**how, "tolerance": _CHANGE})
    except ValueError:  # it did not settle
        return np.full_like(rest.frequencies, np.nan)
    return 100.0 * (_named(modes, rest) / rest.frequencies - 1.0)


def _named(modes: LinearModes, like: LinearModes) -> FloatArray:
    """Return the frequencies of the modes that have the names of others, NaN for none."""
    frequencies = dict(zip(modes.names, modes.frequencies.tolist(), strict=True))
    return np.array([frequencies.get(name, np.nan) for name in like.names])


def _print_section(blade: Blade) -> None:
    """Print stiffness and mass at the root, at the tip, and their extremes."""
    from ..report.blade import sections_of

    if table := blade.table:
        print_line("stations", f"{len(table.x)}")
    values = sections_of(blade).data_vars
    print_columns(
        {
            "section": [f"{name} [{of.attrs['units']}]" for name, of in values.items()],
            "root": [float(of[0]) for of in values.values()],
            "tip": [float(of[-1]) for of in values.values()],
            "least": [float(of.min()) for of in values.values()],
            "greatest": [float(of.max()) for of in values.values()],
        },
        title="Stiffness about the centers of tension and shear, mass per length",
    )
