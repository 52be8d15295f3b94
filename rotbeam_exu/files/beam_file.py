"""A beam or a blade from a TOML file, with stations from CSV, and a run's motion and numerics."""

from __future__ import annotations

import csv
import math
import os
import re
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, get_args

import numpy as np

from analytic import AnyBlade, Beam, Blade, Damping, PointMass, Section
from analytic.arrays import FloatArray
from analytic.description import from_description
from analytic.input_checks import finite_number, positive, rotation_speed, shown, whole_number
from analytic.loads import Load
from analytic.parts import Line
from analytic.section import OutOfPlane
from analytic.section_shapes import SectionShape

from .beam_tables import BEAM, NUMERICS, require_keys

_DECIMAL_COMMA = re.compile(r"^\s*[\w.]+\s*=\s*([+-]?\d+),(\d+)\s*(?:#.*)?$", re.MULTILINE)


@dataclass(frozen=True, kw_only=True)
class RunFile:
    """Content of a file about a run, as far as it has any; the paper's beam where it has none."""

    beam: AnyBlade
    motion: Mapping[str, float] = field(default_factory=dict)
    loads: Sequence[Load] = ()
    numerics: Mapping[str, Any] = field(default_factory=dict)


def load_beam(path: str | os.PathLike[str]) -> AnyBlade:
    """Read a beam from the table [beam] of a TOML file, or a blade from [blade], in SI units.

    [beam] gives length, area, second_moment, youngs_modulus and density, or length,
    axial_stiffness, bending_stiffness and mass_per_length. [blade] gives length and, where they are
    not zero, hub_radius [m] and setting_angle [rad]; [blade.section] gives axial_stiffness,
    bending_stiffness, mass_per_length and rotary_inertia, each a number, coefficients of x/L, or
    stations [x, value]; [blade.section.out_of_plane] bending_ratio and, if known,
    torsion_ratio, or [beam.shape] and [blade.section.shape] the kind of a shape and its
    lengths [m]; each [[blade.point_mass]] position, mass, inertia and offset; [blade.line] twist
    [rad], precone [rad], prebend and sweep [1/m], mass_offset and tension_offset [m], kinks;
    [blade.stations], in place of length and section, the keywords of `Blade.from_stations` or of
    `Blade.from_shapes`, or the name of a `file` that `blade_of_csv` reads; [blade.damping] ratio,
    of mode 1 in the plane at rest, or bending [s], axial [s] and external [kg/(m s)], relative to
    the turning frame and not of point masses, each zero where it is not given.

    Raises
    ------
    ValueError
        If the file is not TOML, or a key is missing, unknown or has a value that is refused; the
        sentence names the file and the key.
    FileNotFoundError
        If there is no such file.

    Examples
    --------
    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> from rotbeam_exu.files.beam_file import load_beam
    >>> numbers = "length = 8.0, area = 7.3e-5, second_moment = 8.218e-9, density = 2766.67"
    >>> with TemporaryDirectory() as folder:
    ...     path = Path(folder) / "beam.toml"
    ...     _ = path.write_text(f"beam = {{ {numbers}, youngs_modulus = 6.8952e10 }}")
    ...     beam = load_beam(path)
    >>> print(f"{beam.omega_0:.4f} rad/s")
    2.9100 rad/s
    """
    return load_run_file(path, needs_beam=True).beam


def load_run_file(path: str | os.PathLike[str], *, needs_beam: bool = False) -> RunFile:
    """Read [beam] or [blade], as `load_beam` does, and the tables [motion], [numerics], [[loads]].

    [motion] may hold omega [rad/s] and ramp_time [s]; [numerics] element, elements, step [s],
    duration [s] and frame; each [[loads]] the kind of a load and its fields. A file with one of
    these may do without a beam, unless it `needs_beam`. Errors are those of `load_beam`.
    """
    source = Path(path)
    document = _read_toml(source)
    try:
        if "beam" in document and "blade" in document:
            raise ValueError("it has both [beam] and [blade]: keep one")
        require_keys(document)
        if "blade" in document:
            beam = _blade(document["blade"], source.parent)
        elif "beam" in document:
            beam = _beam(document["beam"])
        elif document and not needs_beam:
            beam = Beam.reference()
        else:
            raise ValueError(f"it has no table [beam] with {', '.join(BEAM.required)}")
        run = {
            name: {key: _number(key, value) for key, value in document[name].items()}
            for name in ("motion", "numerics")
            if name in document
        }
        loads = [from_description(one, Load) for one in document.get("loads", [])]
    except (OverflowError, TypeError, ValueError) as error:
        raise ValueError(f"{source}: {error}") from error
    return RunFile(beam=beam, loads=loads, **run)


def _number(name: str, value: object) -> Any:
    """Return a number or a name of [motion] and [numerics]; but for the speed, times [s]."""
    if name in ("element", "frame"):
        if not isinstance(value, str):
            raise TypeError(f"{name} must be a name in quotes, got {value!r}")
        if value not in (names := get_args(NUMERICS.optional[name])):
            more = "; a class of your own is for --element alone" if ":" in value else ""
            known = ", ".join(map(repr, names))
            raise ValueError(
                f"unknown {name} {shown(value)} in [numerics]; known are {known}{more}"
            )
        return value
    if name == "elements":
        return whole_number(name, value)
    return rotation_speed(value) if name == "omega" else positive(name, value, "s")


def _read_toml(source: Path) -> dict[str, Any]:
    """Return the tables of a TOML file; refuse other files."""
    if not source.is_file():
        raise FileNotFoundError(f"there is no file {source}")
    try:
        # Some editors begin a file with a byte order mark, which "utf-8-sig" skips.
        return tomllib.loads(source.read_text(encoding="utf-8-sig"))
    except ValueError as error:  # of TOML, of UTF-8, or of an integer with too many digits
        comma = _DECIMAL_COMMA.search(source.read_text(encoding="utf-8", errors="replace"))
        hint = f"; write {comma[1]}.{comma[2]} for {comma[1]},{comma[2]}" if comma else ""
        raise ValueError(f"{source} is not valid TOML: {error}{hint}") from error


def _beam(table: dict[str, Any]) -> AnyBlade:
    if "axial_stiffness" in table:
        return Beam.from_stiffness(**table)
    material = {name: table[name] for name in BEAM.required}
    return _shaped(Beam(**material), table.get("shape"))


def _blade(table: dict[str, Any], folder: Path) -> AnyBlade:
    parts: dict[str, Any] = dict(table)
    masses, damping, line = (
        parts.pop(name, default)
        for name, default in (("point_mass", []), ("damping", {}), ("line", {}))
    )
    shape = None
    if "stations" in parts:
        at = _at_stations(parts.pop("stations"), folder)
        parts |= {"length": at.length, "section": at.section}
        line = {"twist": at.line.twist, **line}
    else:
        section = dict(parts["section"])
        shape = section.pop("shape", None)
        if "out_of_plane" in section:
            if shape is not None:
                raise ValueError(
                    "a shape and out_of_plane of [blade.section] say the same: keep one"
                )
            section["out_of_plane"] = OutOfPlane(**section["out_of_plane"])
        parts["section"] = Section(**section)
    point_masses = tuple(PointMass(**one) for one in masses)
    blade = _shaped(Blade(**parts, line=Line(**line), point_masses=point_masses), shape).blade
    if "ratio" in damping:
        return blade.with_damping(Damping.from_ratio(blade, 1, damping["ratio"]))
    return blade.with_damping(Damping(**damping))


def _at_stations(table: dict[str, Any], folder: Path) -> Blade:
    if "file" in table:
        return blade_of_csv(folder / str(table["file"]))
    if "shapes" in table:
        shapes = [from_description(one, SectionShape) for one in table["shapes"]]
        return Blade.from_shapes(**{**table, "shapes": shapes})
    return Blade.from_stations(**table)


def _shaped(beam: AnyBlade, shape: Any) -> AnyBlade:
    """Return the beam with the shape of a table, or itself without one."""
    return beam if shape is None else beam.with_shape(from_description(shape, SectionShape))


_STIFFNESS = ("EA", "GA2", "GA3", "GJ", "EI2", "EI3")
_MASS = ("m", "j1", "j2", "j3")
_CENTERS = ("tension", "shear", "center", "axis")
_UNITS = {
    "x": "m", "twist": "rad", "EA": "N", "EI": "N m^2", "m": "kg/m",
    "GA2": "N", "GA3": "N", "GJ": "N m^2", "EI2": "N m^2", "EI3": "N m^2",
    "j1": "kg m", "j2": "kg m", "j3": "kg m",
    **{f"{name}{axis}": "m" for name in _CENTERS for axis in (2, 3)},
}  # fmt: skip
_FACTORS = {
    "rad": {"rad": 1.0, "deg": math.pi / 180.0},
    "m": {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "in": 0.0254, "ft": 0.3048},
    "N": {"N": 1.0, "kN": 1e3, "MN": 1e6, "GN": 1e9},
    "N m^2": {"N m^2": 1.0, "kN m^2": 1e3, "MN m^2": 1e6, "N mm^2": 1e-6},
    "kg/m": {"kg/m": 1.0, "g/mm": 1.0, "t/mm": 1e6, "g/m": 1e-3},
    "kg m": {"kg m": 1.0, "kg m^2/m": 1.0, "t mm": 1.0, "g m": 1e-3},
}
"""Units that a header may have, and what one of them is in SI."""


def blade_of_csv(path: Path) -> Blade:
    """Return the blade of a CSV file of stations.

    The header has each column's name and unit, as `EA [MN]`. In the plane: x, EA, EI and m. In
    space: x, EA, GJ, EI2 (flap), EI3 (lag), m, and, if known, GA2, GA3, j1, j2 and j3, twist, and
    tension2, tension3, ... of `Blade.from_stations`.

    Raises
    ------
    ValueError
        If a column is missing or unknown, or its unit, or a cell is no number.
    """
    if not path.is_file():
        raise FileNotFoundError(f"there is no file {path}")
    with path.open(encoding="utf-8-sig", newline="") as file:
        header, *rows = [row for row in csv.reader(file) if row] or [[]]
    columns = {}
    for place, title in enumerate(header):
        name, factor = _name_and_factor(title, path)
        columns[name] = factor * np.array([_cell(row, place, title, path) for row in rows])
    planar = "EI" in columns
    wanted = ("x", "EA", "EI", "m") if planar else ("x", "EA", "GJ", "EI2", "EI3", "m")
    if missing := [name for name in wanted if name not in columns]:
        raise ValueError(f"{path} lacks the column {', '.join(missing)}")
    if planar:
        return _planar(columns, path)
    EA, zero = columns["EA"], np.zeros_like(columns["x"])
    # A theory without shear does not use GA2 and GA3; a homogeneous section has j = m EI/EA.
    known = {"GA2": EA, "GA3": EA, "twist": zero}
    known |= {f"j{axis}": columns["m"] * columns[f"EI{axis}"] / EA for axis in (2, 3)} | columns
    known = {"j1": known["j2"] + known["j3"]} | known
    pairs = {
        name: np.stack([known.get(f"{name}{axis}", zero) for axis in (2, 3)], axis=-1)
        for name in _CENTERS
    }
    stiffness, mass = (
        np.stack([known[name] for name in names], axis=-1) for names in (_STIFFNESS, _MASS)
    )
    return Blade.from_stations(known["x"], stiffness, mass, twist=known["twist"], **pairs)


def _planar(columns: dict[str, FloatArray], path: Path) -> Blade:
    if more := sorted(columns.keys() - {"x", "EA", "EI", "m"}):
        raise ValueError(
            f"{path} has EI, of the plane, beside {', '.join(more)} in space: give EI2 and EI3"
        )
    x = columns["x"].tolist()
    named = {"axial_stiffness": "EA", "bending_stiffness": "EI", "mass_per_length": "m"}
    profiles: dict[str, Any] = {
        name: tuple(zip(x, columns[column].tolist(), strict=True)) for name, column in named.items()
    }
    return Blade(length=x[-1], section=Section(**profiles))


def _name_and_factor(title: str, path: Path) -> tuple[str, float]:
    """Return the name of a column and its unit in SI."""
    told = re.fullmatch(r"\s*(\w+)\s*\[(.*)\]\s*", title)
    name = told[1] if told else title.strip()
    if name not in _UNITS:
        raise ValueError(f"{path}: unknown column {name!r}; known are {', '.join(_UNITS)}")
    factors = _FACTORS[_UNITS[name]]
    unit = " ".join(told[2].replace("²", "^2").replace("*", " ").split()) if told else ""
    if unit not in factors:
        raise ValueError(
            f"{path}: give the unit of column {title!r}, as {name} [{_UNITS[name]}]; known are "
            f"{', '.join(factors)}"
        )
    return name, factors[unit]


def _cell(row: list[str], place: int, title: str, path: Path) -> float:
    try:
        return finite_number(title, float(row[place]))
    except (IndexError, ValueError) as error:
        cell = row[place] if place < len(row) else ""
        raise ValueError(f"{path}: column {title!r} has {cell!r}, which is no number") from error
