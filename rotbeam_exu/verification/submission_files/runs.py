"""runs.csv: one row for each history, with what it cost, or why the code failed."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from decimal import Decimal
from pathlib import Path

from ..cases import Asked, Case
from .faults import Faults
from .tables import number_fault, records, sheet_of, shown

FILE = "runs.csv"
REQUIRED = {"file": "", "elements": "", "step": "s"}
OPTIONAL = {"dof": "", "wall_s": "s", "cpu_s": "s", "failure": "", "remark": ""}
NAME = re.compile(r"m([0-9]{1,9})_h((?:[0-9]+(?:\.[0-9]+)?|\.[0-9]+)(?:e[-+]?[0-9]{1,3})?)\.csv")
"""Of a history's file: elements, and step [s]."""

_ROUNDED = 1e-2
"""Relative distance of a step from what the name of its file says."""


@dataclass(frozen=True, kw_only=True)
class Listed:
    """A row of runs.csv; what is not told is NaN or None."""

    line: int
    file: str
    case: str
    elements: int
    step: float
    dof: int | None
    wall: float
    cpu: float
    failure: str
    remark: str


def file_of(case: str, elements: int, step: float) -> str:
    """Return the name of a history's file below the folder, as S1/m032_h1e-3.csv."""
    _, digits, exponent = Decimal(repr(step)).normalize().as_tuple()
    first, *rest = map(str, digits)
    power = int(exponent) + len(rest)
    return f"{case}/m{elements:03d}_h{first}{'.' if rest else ''}{''.join(rest)}e{power}.csv"


def listed_runs(folder: Path, cases: Mapping[str, Case], faults: Faults) -> list[Listed]:
    """Return the rows of runs.csv that are right by themselves."""
    sheet = sheet_of(folder, FILE, REQUIRED, OPTIONAL, faults)
    if sheet is None:
        return []
    histories = tuple(name for name, case in cases.items() if case.asked is Asked.HISTORY)
    seen: dict[tuple[str, int, float], int] = {}
    found = []
    for line, cells in records(sheet, faults):
        wrong = _wrong_with(cells, histories)
        if not wrong:
            one = _listed(line, cells)
            key = one.case, one.elements, one.step
            if key in seen:
                wrong = [f"the same case, mesh and step stand in line {seen[key]}: keep one"]
            else:
                seen[key] = line
                found.append(one)
        for said in wrong:
            faults.add(FILE, said, line)
    return found


def _listed(line: int, cells: Mapping[str, str]) -> Listed:
    dof = cells.get("dof", "")
    return Listed(
        line=line,
        file=cells["file"],
        case=cells["file"].partition("/")[0],
        elements=int(float(cells["elements"])),
        step=float(cells["step"]),
        dof=int(float(dof)) if dof else None,
        wall=float(cells.get("wall_s") or math.nan),
        cpu=float(cells.get("cpu_s") or math.nan),
        failure=cells.get("failure", ""),
        remark=cells.get("remark", ""),
    )


def _wrong_with(cells: Mapping[str, str], histories: tuple[str, ...]) -> list[str]:
    """Return what is wrong with the cells of a row."""
    wrong = []
    for name, cell in cells.items():
        if name in ("file", "failure", "remark") or (name in OPTIONAL and not cell):
            continue
        said = number_fault(cell)
        if said:
            wrong.append(f"{name}: {said}")
        elif name in ("elements", "dof") and not (float(cell) >= 1.0 and float(cell).is_integer()):
            wrong.append(f"{name} must be a whole number of at least 1, got {cell}")
        elif name == "step" and not float(cell) > 0.0:
            wrong.append(f"step must be positive, in seconds, got {cell}")
        elif name in ("wall_s", "cpu_s") and float(cell) < 0.0:
            wrong.append(f"{name} must not be negative, got {cell}")
    case, _, name = cells["file"].partition("/")
    named = NAME.fullmatch(name)
    if case not in histories:
        wrong.append(f"{shown(case)} is no case with a history; known are {', '.join(histories)}")
    elif not named:
        wrong.append(f"{shown(cells['file'])} is no name of a history: write {case}/m032_h1e-3.csv")
    elif not wrong:
        wrong += _other_than_named(cells, int(named[1]), float(named[2]))
    return wrong


def _other_than_named(cells: Mapping[str, str], elements: int, step: float) -> list[str]:
    """Return where mesh and step of a row are not those of its file's name."""
    wrong = []
    if float(cells["elements"]) != elements:
        wrong.append(f"elements are {cells['elements']}, the file's name says {elements}")
    if abs(float(cells["step"]) - step) > _ROUNDED * step:
        wrong.append(f"step is {cells['step']} s, the file's name says {step:g} s")
    return [f"{said}: correct one of them" for said in wrong]
