"""runs.csv: one row for each history, with what it cost, or why the code failed."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Mapping
from decimal import Decimal
from pathlib import Path
from typing import Any

import numpy as np

from analytic.arrays import FloatArray

from ..cases import Asked, Case
from ..submission import Run
from .content import below
from .faults import Faults, printable, shown
from .histories import history_of
from .tables import FAILURE, Column, Kind, bounded, rows_of, sheet_of, text, whole

FILE = "runs.csv"
_NAME = re.compile(r"m([0-9]{1,9})_h((?:[0-9]+(?:\.[0-9]+)?|\.[0-9]+)(?:e[-+]?[0-9]{1,3})?)\.csv")
"""Of a history's file: elements, and step [s]."""

_ROUNDED = 1e-2
"""Relative distance of a step from what the name of its file says."""

_positive = bounded(lambda value: value > 0.0, "must be positive, in seconds, got {}")
_cost = bounded(lambda value: value >= 0.0, "must not be negative, got {}")


def columns_of(cases: Mapping[str, Case]) -> tuple[Column, ...]:
    """Return the columns of runs.csv."""
    return (
        Column("file", _history_of(cases)), Column("elements", whole),
        Column("step", _positive, "s"), Column("dof", whole, needed=False),
        Column("wall_s", _cost, "s", needed=False), Column("cpu_s", _cost, "s", needed=False),
        FAILURE, Column("remark", text, needed=False),
    )  # fmt: skip


def _history_of(cases: Mapping[str, Case]) -> Kind:
    """Return the kind of names of histories."""
    known = tuple(name for name, case in cases.items() if case.asked is Asked.HISTORY)

    def read(_: str, cell: str) -> str:
        case, _, name = cell.partition("/")
        if case not in known:
            raise ValueError(
                f"{shown(case)} is no case with a history; known are {', '.join(known)}"
            )
        if not _NAME.fullmatch(name):
            raise ValueError(f"{shown(cell)} is no name of a history: write {case}/m032_h1e-3.csv")
        return cell

    return read


def file_of(case: str, elements: int, step: float) -> str:
    """Return the name of a history's file below the folder, as S1/m032_h1e-3.csv."""
    _, digits, exponent = Decimal(repr(step)).normalize().as_tuple()
    first, *rest = map(str, digits)
    power = int(exponent) + len(rest)
    return f"{case}/m{elements:03d}_h{first}{'.' if rest else ''}{''.join(rest)}e{power}.csv"


def runs_of(root: Path, cases: Mapping[str, Case], faults: Faults) -> tuple[Run, ...]:
    """Return the runs that runs.csv lists, those that failed without a history."""
    there = [
        f"{name}/{printable(path.name)}"
        for name, case in cases.items()
        if case.asked is Asked.HISTORY and below(root, name) and (root / name).is_dir()
        for path in sorted((root / name).glob("*.csv"))
    ]
    if not there and not os.path.lexists(root / FILE):
        return ()
    found, listed = [], list(_listed(root, cases, faults))
    for row in listed:
        samples: dict[str, FloatArray] | None = {"time": np.empty(0), "q": np.empty(0)}
        if "failure" not in row:
            samples = history_of(root, row["file"], cases[row["case"]], faults)
        if samples is not None:
            found.append(Run(**(row | samples)))
    if not faults.of(FILE):
        known = {row["file"] for row in listed}
        for file in dict.fromkeys(there):
            if file not in known:
                faults.add(file, f"stands in no row of {FILE}: add file, elements, step")
    return tuple(found)


def _listed(root: Path, cases: Mapping[str, Case], faults: Faults) -> Iterator[dict[str, Any]]:
    """Yield the rows of runs.csv that are right by themselves, with their case."""
    sheet = sheet_of(root, FILE, columns_of(cases), faults)
    seen: dict[tuple[str, int, float], int] = {}
    for line, cells, row in rows_of(sheet, faults) if sheet else ():
        case, _, name = row["file"].partition("/")
        elements, step = _NAME.fullmatch(name).groups()  # type: ignore[union-attr]
        wrong = []
        if row["elements"] != int(elements):
            wrong.append(f"elements are {cells['elements']}, the file's name says {int(elements)}")
        if abs(row["step"] - float(step)) > _ROUNDED * float(step):
            wrong.append(f"step is {cells['step']} s, the file's name says {float(step):g} s")
        wrong = [f"{said}: correct one of them" for said in wrong]
        place = case, row["elements"], row["step"]
        if not wrong and seen.setdefault(place, line) != line:
            wrong = [f"the same case, mesh and step stand in line {seen[place]}: keep one"]
        for said in wrong:
            faults.add(FILE, said, line)
        if not wrong:
            yield row | {"case": case}
