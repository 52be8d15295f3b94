"""runs.csv, one row for each history with its cost or its failure, and the histories themselves."""

from __future__ import annotations

import math
import os
import re
from collections.abc import Collection, Iterator
from pathlib import Path
from typing import Any

import numpy as np

from analytic.arrays import FloatArray

from ..cases import CASES, TIP, Asked, Case
from ..submission import Run
from .faults import Faults, files_in, several, shown
from .tables import (
    DIGITS,
    FAILURE,
    LEAST_DIGITS,
    TOO_FEW,
    Column,
    Sheet,
    digits,
    not_negative,
    positive,
    rounding,
    rows_of,
    sheet_of,
    text,
    whole,
)

FILE = "runs.csv"
FARTHEST = 0.02
"""Largest distance of samples [s]: the estimator needs twenty a period, and 100 ms give it none."""

FARTHEST_TIP = 1e4
"""Largest |q|/L that is judged: millimetres for metres, and no more than that."""

HISTORY = (
    Column("time", unit="s"),
    Column("q", unit="m"),
    Column("q_dot", unit="m/s", needed=False, measured=True),
)
TIP_COLUMNS = tuple(Column(name, unit="rad" if name == "twist" else "m") for name in TIP)
_SLACK = 1e-6
_NAME = re.compile(
    r"m([0-9]{1,9})_([ht])((?:[0-9]+(?:\.[0-9]+)?|\.[0-9]+)(?:e[-+]?[0-9]{1,3})?)\.csv"
)
"""Name of a history's file: elements, and step [s] or tolerance."""

_ROUNDED = 1e-2
"""Relative distance of a step or tolerance from that in the name of its file."""


def _history(_: str, cell: str) -> str:
    """Return the name of a history's file."""
    case, _, name = cell.partition("/")
    known = [one.name for one in CASES.values() if one.asked is Asked.HISTORY]
    if case not in known:
        among = f"known are {', '.join(known)}"
        raise ValueError(f"{shown(case)} is no case with a history; {among}")
    if not _NAME.fullmatch(name):
        remedy = f"write {case}/m032_h1e-3.csv, or _t1e-6 of a tolerance"
        raise ValueError(f"{shown(cell)} is no name of a history: {remedy}")
    return cell


COLUMNS = (
    Column("file", _history), Column("elements", whole),
    Column("step", positive, "s", needed=False), Column("tolerance", positive, needed=False),
    Column("dof", whole, needed=False),
    Column("wall_s", not_negative, "s", needed=False),
    Column("cpu_s", not_negative, "s", needed=False),
    FAILURE, Column("remark", text, needed=False),
)  # fmt: skip


def file_of(run: Run) -> str:
    """Return the name of a history's file below the folder, as S1/m032_h1e-3.csv."""
    size = np.format_float_scientific(run.refinement, trim="-", exp_digits=1).replace("+", "")
    return f"{run.case}/m{run.elements:03d}_{'t' if run.is_adaptive else 'h'}{size}.csv"


def runs_of(root: Path, faults: Faults, only: Collection[str] = ()) -> tuple[Run, ...]:
    """Return the runs of some or all cases that runs.csv lists; failed runs have no history."""
    histories = [name for name, case in CASES.items() if case.asked is Asked.HISTORY]
    there = [file for name in histories for file in files_in(root, name)]
    if not there and not os.path.lexists(root / FILE):
        return ()
    found, listed = [], list(_listed(root, faults))
    for row in listed:
        if only and row["case"] not in only:
            continue
        samples: dict[str, Any] | None = {"time": np.empty(0), "q": np.empty(0)}
        if "failure" not in row:
            samples = history_of(
                root, row["file"], CASES[row["case"]], row.get("step", math.nan), faults
            )
        if samples is not None:
            found.append(Run(**(row | samples)))
    if not faults.of(FILE):
        known = {row["file"] for row in listed}
        for file in dict.fromkeys(there):
            if file not in known:
                faults.add(file, f"stands in no row of {FILE}: add file, elements, step")
    return tuple(found)


def _listed(root: Path, faults: Faults) -> Iterator[dict[str, Any]]:
    """Yield the rows of runs.csv that are right by themselves, with their case."""
    sheet = sheet_of(root, FILE, COLUMNS, faults)
    seen: dict[tuple[str, int, float], int] = {}
    first: dict[str, str] = {}
    for line, _, row in rows_of(sheet, faults) if sheet else ():
        case, name = row["file"].split("/")
        elements, kind, size = _NAME.fullmatch(name).groups()  # type: ignore[union-attr]
        of, other = ("step", "tolerance") if kind == "h" else ("tolerance", "step")
        place = case, row["elements"], row.get(of, 0.0)
        alike = math.isclose(place[2], float(size), rel_tol=_ROUNDED) and other not in row
        if row["elements"] != int(elements) or not alike:
            named = f"{int(elements)} elements and a {of} of {float(size):g}, the row does not"
            said = f"the file's name says {named}: correct one of them"
        elif first.setdefault(case, of) != of:
            said = f"a {of} stands beside a {other} of {case}, which no fit takes together"
        elif seen.setdefault(place, line) != line:
            said = f"the same case, mesh and {of} stand in line {seen[place]}: keep one"
        else:
            yield row | {"case": case}
            continue
        faults.add(FILE, said, line)


def history_of(
    folder: Path, file: str, case: Case, step: float, faults: Faults
) -> dict[str, Any] | None:
    """Return time and q up to the end of the case, and the error that the last digits leave.

    None if something is wrong. In space q is lag, flap and twist, (samples, 3). `step` is NaN where
    it is not known. A rate, q_dot, is not judged.
    """
    wanted = (HISTORY[0], *TIP_COLUMNS) if case.in_space else HISTORY
    sheet = sheet_of(folder, file, wanted, faults)
    numbers = None if sheet is None else _numbers(sheet, faults)
    if sheet is None or numbers is None:
        return None
    columns = {column.name: one for column, one in zip(sheet.columns, numbers.T, strict=True)}
    with np.errstate(over="ignore", invalid="ignore"):
        most = _digits(sheet, columns)
        unfit: list[tuple[str, int | None]] = [
            (f"column {name!r} is written to {count} {TOO_FEW}", None)
            for name, count in most.items()
            if count < LEAST_DIGITS
        ]
        tip = np.stack([columns[name] for name in case.columns])
        farthest = tip[np.abs(tip).argmax(axis=0), np.arange(tip.shape[1])]
        unfit += _unfit(columns["time"], farthest, case)
    for said, k in unfit:
        faults.add(file, said, None if k is None else sheet.lines[k])
    if unfit:
        return None
    within = columns["time"] <= case.duration
    errors = np.array([_rounding(columns, name, most, step) for name in case.columns])
    q, lost = (tip.T, errors) if case.in_space else (tip[0], errors[0])
    return {"time": columns["time"][within], "q": q[within], "rounding": lost}


def _numbers(sheet: Sheet, faults: Faults) -> FloatArray | None:
    """Return all numbers, (rows, columns); None if some are faulty, which is told row by row."""
    shape = len(sheet.rows), len(sheet.columns)
    try:
        numbers = np.loadtxt(sheet.rows, delimiter=",", ndmin=2, comments=None)
    except ValueError:
        numbers = np.empty((0, 0))
    if numbers.shape != shape or not np.isfinite(numbers).all():
        rows = [list(values.values()) for _, _, values in rows_of(sheet, faults)]
        numbers = np.array(rows, dtype=float)
    return numbers if numbers.shape == shape else None


def _unfit(time: FloatArray, q: FloatArray, case: Case) -> list[tuple[str, int | None]]:
    """Return what keeps finite numbers from being the history of a case, and in which row."""
    found: list[tuple[str, int | None]] = []
    gaps = np.diff(time)
    far = np.flatnonzero(np.abs(q) > FARTHEST_TIP * case.blade.length)
    if far.size:
        said = (
            f"q is {q[far[0]]:.3g} m, of a beam of {case.blade.length:g} m: a run that "
            "diverged has no file, but a sentence in the column failure of runs.csv"
        )
        found.append((said, int(far[0])))
    back = np.flatnonzero(gaps <= 0.0)
    if back.size:
        k = int(back[0]) + 1
        said = f"time must increase, but {time[k]:.10g} s follows {time[k - 1]:.10g} s"
        remedy = ": sort the rows, keep one of each time, and write all digits"
        return [*found, (said + several(back.size) + remedy, k)]
    if time[0] < -_SLACK or time[0] > FARTHEST:
        found.append((f"begins at {time[0]:.6g} s: begin at 0 s", 0))
    if time[-1] < case.duration - FARTHEST:
        said = f"ends at {time[-1]:.6g} s, case {case.name} lasts {case.duration:g} s: run it whole"
        found.append((said, time.size - 1))
    wide = np.flatnonzero(gaps > FARTHEST * (1.0 + _SLACK))
    if wide.size:
        k = int(wide[0]) + 1
        said = (
            f"samples are {1e3 * gaps[k - 1]:.4g} ms apart{several(wide.size)}, at most "
            f"{1e3 * FARTHEST:g} ms leave something to measure: sample more often"
        )
        found.append((said, k))
    return found


def _rounding(
    columns: dict[str, FloatArray], name: str, most: dict[str, int], step: float
) -> float:
    """Return the error of a column that the last digits of time and of itself leave.

    A time is exact, however short, that is a whole number of steps with all their decimals.
    """
    time, q = columns["time"], columns[name]
    late = rounding(most["time"], float(time[-1]))
    whole_steps = np.abs(time / step - np.rint(time / step)) < _SLACK
    if late <= (0.5 + _SLACK) * step and whole_steps.all():
        late = 0.0
    fastest = float(np.abs(np.gradient(q, time)).max()) if late else 0.0
    return rounding(most[name], float(np.abs(q).max())) + late * fastest


def _digits(sheet: Sheet, columns: dict[str, FloatArray]) -> dict[str, int]:
    """Return to how many digits columns are written; DIGITS stands for more, and for exact ones."""
    found = dict.fromkeys(columns, DIGITS)
    for number, (name, values) in enumerate(columns.items()):
        gaps = np.diff(values)
        if gaps.size and np.ptp(gaps) <= 1e-9 * np.abs(values).max():
            continue  # even samples, such as 0.02 k, and zeros are exact however short
        most = 0
        for row in sheet.rows:
            most = max(most, digits(row.split(",")[number]))
            if most >= DIGITS:
                break
        found[name] = min(most, DIGITS)
    return found
