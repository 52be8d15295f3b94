"""runs.csv: one row for each history, with what it cost, or why the code failed."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Mapping
from decimal import Decimal
from pathlib import Path
from typing import Any

import numpy as np

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
    there = list(dict.fromkeys(_found_histories(root, cases)))
    if not there and not os.path.lexists(root / FILE):
        return ()
    found, nothing = [], np.empty(0)
    listed = list(_listed(root, cases, faults))
    for row in listed:
        samples = {"time": nothing, "q": nothing}
        if "failure" not in row:
            history = history_of(root, row["file"], cases[row["case"]], faults)
            if history is None:
                continue
            samples = history
        found.append(Run(**(row | samples)))
    if not faults.of(FILE):
        known = {row["file"] for row in listed}
        for file in there:
            if file not in known:
                faults.add(file, f"stands in no row of {FILE}: add file, elements, step")
    return tuple(found)


def _listed(root: Path, cases: Mapping[str, Case], faults: Faults) -> Iterator[dict[str, Any]]:
    """Yield the rows of runs.csv that are right by themselves, with their case."""
    sheet = sheet_of(root, FILE, columns_of(cases), faults)
    seen: dict[tuple[str, int, float], int] = {}
    for line, cells, row in rows_of(sheet, faults) if sheet else ():
        case, _, name = row["file"].partition("/")
        wrong = _other_than_named(name, cells, row)
        place = case, row["elements"], row["step"]
        if not wrong and seen.setdefault(place, line) != line:
            wrong = [f"the same case, mesh and step stand in line {seen[place]}: keep one"]
        for said in wrong:
            faults.add(FILE, said, line)
        if not wrong:
            yield row | {"case": case}


def _other_than_named(name: str, cells: Mapping[str, str], row: Mapping[str, Any]) -> list[str]:
    """Return where mesh and step of a row are not those of its file's name."""
    named = _NAME.fullmatch(name)
    assert named is not None
    elements, step = int(named[1]), float(named[2])
    wrong = []
    if row["elements"] != elements:
        wrong.append(f"elements are {cells['elements']}, the file's name says {elements}")
    if abs(row["step"] - step) > _ROUNDED * step:
        wrong.append(f"step is {cells['step']} s, the file's name says {step:g} s")
    return [f"{said}: correct one of them" for said in wrong]


def _found_histories(root: Path, cases: Mapping[str, Case]) -> Iterator[str]:
    for name, case in cases.items():
        if case.asked is Asked.HISTORY and below(root, name) and (root / name).is_dir():
            for path in sorted((root / name).glob("*.csv")):
                yield f"{name}/{printable(path.name)}"
