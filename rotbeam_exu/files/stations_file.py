"""A blade from a CSV file of its stations, with units in the header."""

from __future__ import annotations

import csv
import math
import re
from pathlib import Path
from typing import Any

import numpy as np

from analytic import Blade, Section
from analytic.arrays import FloatArray
from analytic.input_checks import finite_number

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
