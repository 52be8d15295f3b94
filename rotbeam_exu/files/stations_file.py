"""A blade from a CSV file of its stations, each column with its unit."""

from __future__ import annotations

import csv
import io
import math
import re
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from analytic import Blade, Section
from analytic.arrays import FloatArray
from analytic.input_checks import shown
from analytic.station_section import MASSES, STIFFNESSES

from .openfast import elastodyn_names

_CENTERS = ("tension", "shear", "center", "axis")
_UNITS = {
    "x": "m", "twist": "rad", "EA": "N", "EI": "N m^2", "m": "kg/m",
    "GA2": "N", "GA3": "N", "GJ": "N m^2", "EI2": "N m^2", "EI3": "N m^2",
    "j1": "kg m", "j2": "kg m", "j3": "kg m",
    **{f"{name}{axis}": "m" for name in _CENTERS for axis in (2, 3)},
}  # fmt: skip
_FACTORS = {
    "s": {"s": 1.0, "ms": 1e-3},
    "rad/s": {"rad/s": 1.0, "Hz": math.tau, "rpm": math.tau / 60.0},
    "1": {"%": 0.01, "1": 1.0},
    "N m": {"N m": 1.0, "kN m": 1e3, "MN m": 1e6},
    "N/m": {"N/m": 1.0, "kN/m": 1e3, "N/mm": 1e3},
    "N m/m": {"N m/m": 1.0, "N": 1.0, "kN m/m": 1e3, "kN": 1e3},
    "rad": {"rad": 1.0, "deg": math.pi / 180.0},
    "m": {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "in": 0.0254, "ft": 0.3048},
    "N": {"N": 1.0, "kN": 1e3, "MN": 1e6, "GN": 1e9},
    "N m^2": {"N m^2": 1.0, "kN m^2": 1e3, "MN m^2": 1e6, "N mm^2": 1e-6},
    "kg/m": {"kg/m": 1.0, "g/mm": 1.0, "t/mm": 1e6, "g/m": 1e-3},
    "kg m": {"kg m": 1.0, "kg m^2/m": 1.0, "t mm": 1.0, "g m": 1e-3},
}
"""Units that a header may have, and what one of them is in SI."""
_TITLE = re.compile(r"\s*(\w+)\s*\[([^\]]*)\]\s*")
_NUMBER = re.compile(r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?")


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
    columns = columns_of(path, _UNITS, "x [m],EA [N],EI [N m^2],m [kg/m]")
    planar = "EI" in columns
    needed = ("x", "EA", "EI", "m") if planar else ("x", "EA", "GJ", "EI2", "EI3", "m")
    if missing := [name for name in needed if name not in columns]:
        raise ValueError(f"{path} lacks the column {', '.join(missing)}")
    if planar:
        return _planar(columns, path)
    EA, zero = columns["EA"], np.zeros_like(columns["x"])
    # A theory without shear does not use GA2 and GA3; a homogeneous section has j = m EI/EA.
    values = {"GA2": EA, "GA3": EA, "twist": zero}
    values |= {f"j{axis}": columns["m"] * columns[f"EI{axis}"] / EA for axis in (2, 3)} | columns
    values = {"j1": values["j2"] + values["j3"]} | values
    pairs: dict[str, Any] = {
        name: np.stack([values.get(f"{name}{axis}", zero) for axis in (2, 3)], axis=-1)
        for name in _CENTERS
    }
    stiffness, mass = (
        np.stack([values[name] for name in names], axis=-1) for names in (STIFFNESSES, MASSES)
    )
    return Blade.from_stations(values["x"], stiffness, mass, twist=values["twist"], **pairs)


def _planar(columns: dict[str, FloatArray], path: Path) -> Blade:
    if more := sorted(columns.keys() - {"x", "EA", "EI", "m"}):
        raise ValueError(
            f"{path} has EI, of the plane, and {', '.join(more)} in space: give EI2 and EI3"
        )
    x = columns["x"].tolist()
    named = {"axial_stiffness": "EA", "bending_stiffness": "EI", "mass_per_length": "m"}
    profiles: dict[str, Any] = {
        name: tuple(zip(x, columns[column].tolist(), strict=True)) for name, column in named.items()
    }
    return Blade(length=x[-1], section=Section(**profiles))


def text_of(path: Path) -> str:
    """Return the text of a file in UTF-8, without the mark that some editors begin it with."""
    if not path.is_file():
        raise FileNotFoundError(f"there is no file {path}")
    try:
        return path.read_bytes().decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise ValueError(
            f"{path} is not written in UTF-8: byte {error.object[error.start]:#x} at place "
            f'{error.start + 1} is none of it; save it as UTF-8, in Excel as "CSV UTF-8"'
        ) from None


def columns_of(path: Path, units: Mapping[str, str], example: str) -> dict[str, FloatArray]:
    """Return the columns of a CSV in SI by name; refuse what is no table of numbers.

    Names have their `units`, none where a column is of text; the sentence on a file without a
    header has an `example` of one.
    """
    reader = csv.reader(io.StringIO(text_of(path), newline=""))
    try:
        lines = [(reader.line_num, row) for row in reader if any(row)]
    except csv.Error as error:
        raise ValueError(f"{path}: line {reader.line_num} is no row of a table: {error}") from None
    (_, header), *rows = lines or [(1, [])]
    factors = _factors(header, path, units, example)
    if not rows:
        raise ValueError(f"{path} has a header and no rows: give a row at each place or instant")
    for number, row in rows:
        if len(row) != len(header):
            raise ValueError(
                f"{path}: line {number} has {len(row)} cells, the header {len(header)}; write a "
                "decimal point, as 1.5, where it has a decimal comma"
            )
    return {
        name: factor * np.array([_number(row[place], name, n, path) for n, row in rows])
        if units[name]
        else np.array([row[place].strip() for _, row in rows])
        for place, (name, factor) in enumerate(factors.items())
    }


def _factors(
    header: Iterable[str], path: Path, units: Mapping[str, str], example: str
) -> dict[str, float]:
    """Return the names of columns and their units in SI."""
    titles = [(_TITLE.fullmatch(title), title.strip()) for title in header]
    named = [
        (match[1], match[2], title) if match else (title, "", title) for match, title in titles
    ]
    if theirs := {title: ours for *_, title in named if (ours := elastodyn_names(title))}:
        pairs = ", ".join(f"{title} is {ours}" for title, ours in theirs.items())
        raise ValueError(
            f"{path} has columns of ElastoDyn: name them as here, where {pairs}, and give EA [N] "
            "and GJ [N m^2]; or name ElastoDyn's file itself in [blade.stations]"
        )
    if not any(name in units for name, *_ in named):  # of another file, of which nothing is shown
        raise ValueError(
            f"{path} begins with no title of a known column: give it a header, as {example}, "
            "separated by commas"
        )
    factors: dict[str, float] = {}
    for name, written, title in named:
        if name not in units:
            raise ValueError(f"{path}: unknown column {shown(name)}; known are {', '.join(units)}")
        if name in factors:
            raise ValueError(f"{path} has two columns {name}: keep one")
        by_unit = _FACTORS[units[name]] if units[name] else {"": 1.0}
        unit = " ".join(written.replace("²", "^2").replace("*", " ").split())
        if unit not in by_unit:
            raise ValueError(
                f"{path}: give the unit of column {shown(title)}, as {name} [{units[name]}]; "
                f"known are {', '.join(by_unit)}"
            )
        factors[name] = by_unit[unit]
    return factors


def _number(cell: str, name: str, line: int, path: Path) -> float:
    """Return a cell as a number, which has neither underscores nor digits of other scripts."""
    number = float(cell) if _NUMBER.fullmatch(cell.strip()) else math.nan
    if not math.isfinite(number):
        raise ValueError(
            f"{path}: line {line} has {shown(cell)} in column {name}, which is no number as 1.5e6"
        )
    return number
