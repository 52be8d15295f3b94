"""`rotbeam blade`: mass, stiffness and first frequencies of the blade in a file."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, get_args

import numpy as np

import analytic
from analytic import Blade, Theory
from analytic.arrays import FloatArray, evaluated, in_units
from analytic.station_section import STIFFNESSES, Interpolation, StationSection

from .output import bar, formatted, print_columns, print_line, print_note
from .request import Request, uses

if TYPE_CHECKING:
    from analytic.exact.linear.space_modes import LinearModes

_COUNT = 6  # modes


@uses("theory", "motion.omega")
def blade(request: Request) -> None:
    """Print mass, stiffness and first frequencies of a blade.

    The frequencies are at rest and at the speed of the file.

    Of a table of stations it also prints by how much the frequencies at rest change with the other
    interpolation between stations, which is a convention.

    Examples
    --------
    $ rotbeam blade
    $ rotbeam blade --config beam.toml
    """
    blade, theory, omega = request.blade, request.theory, request.values.get("omega", 0.0)
    with bar("modes"):
        rest = analytic.linear_modes(blade, 0.0, _COUNT, theory=theory)
        turning = {}
        if omega:
            modes = analytic.linear_modes(blade, omega, _COUNT, theory=theory)
            turning[f"at {omega:g} rad/s [Hz]"] = _named(modes, rest) / (2.0 * np.pi)
        section, others = blade.section, {}
        if isinstance(section, StationSection):
            (way,) = set(get_args(Interpolation)) - {section.interpolation}
            others[way] = _changes(blade, section, way, theory, rest)
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
            **{f'"{way}" [%]': formatted(changes, "+.4f") for way, changes in others.items()},
        },
        title=f"Frequencies, {theory}",
    )
    for way, changes in others.items():
        print_note(
            f'"{way}": the change with interpolation = "{way}" in [blade.stations]'
            + ("; these frequencies did not settle" if np.isnan(changes).any() else "")
        )


def _changes(
    blade: Blade, section: StationSection, way: Interpolation, theory: Theory, rest: LinearModes
) -> FloatArray:
    """Return the relative changes of frequencies [%] with the other interpolation."""
    other = replace(blade, section=replace(section, interpolation=way))
    try:
        modes = analytic.linear_modes(other, 0.0, _COUNT, theory=theory)
    except ValueError:  # it did not settle
        return np.full_like(rest.frequencies, np.nan)
    return 100.0 * (_named(modes, rest) / rest.frequencies - 1.0)


def _named(modes: LinearModes, like: LinearModes) -> FloatArray:
    """Return the frequencies of the modes that have the names of others, NaN for none."""
    frequencies = dict(zip(modes.names, modes.frequencies.tolist(), strict=True))
    return np.array([frequencies.get(name, np.nan) for name in like.names])


def _print_section(blade: Blade) -> None:
    """Print stiffness and mass at the root, at the tip, and their extremes."""
    section = blade.section
    if isinstance(section, StationSection):
        print_line("stations", f"{len(section.x)}")
        values = dict(zip(STIFFNESSES, section.stiffnesses.T, strict=True))
        values["m"] = np.array(section.mass_per_length)[:, 1]
    else:
        x = np.linspace(0.0, 1.0, 257)
        named = {"EA": "axial_stiffness", "EI": "bending_stiffness", "m": "mass_per_length"}
        profiles = section.profiles()
        values = {
            name: evaluated(in_units(profiles[long], blade.length, 1.0), x)
            for name, long in named.items()
        }
    units = {"E": "N m^2", "G": "N", "m": "kg/m"} | {"EA": "N", "GJ": "N m^2"}
    print_columns(
        {
            "section": [f"{name} [{units.get(name) or units[name[0]]}]" for name in values],
            "root": [float(of[0]) for of in values.values()],
            "tip": [float(of[-1]) for of in values.values()],
            "least": [float(of.min()) for of in values.values()],
            "greatest": [float(of.max()) for of in values.values()],
        },
        title="Stiffness about the centers of tension and shear, mass per length",
    )
