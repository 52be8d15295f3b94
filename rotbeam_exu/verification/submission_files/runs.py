"""runs.csv, one row for each history with its cost or its failure, and the histories themselves."""

from __future__ import annotations

import math
import os
from collections.abc import Collection, Iterator, Sequence
from typing import Any

import numpy as np

from analytic.arrays import FloatArray

from ..case import Case
from ..cases import CASES
from ..submission import Run
from . import tables
from .faults import Folder, several

FILE = "runs.csv"
FARTHEST = 0.02
"""Largest distance of samples [s]: the estimator needs twenty a period, and 100 ms give it none."""

FARTHEST_TIP = 1e4
"""Largest |q|/L that is judged: millimetres for metres, and no more than that."""

_SLACK = 1e-6
_ROUNDED = 1e-2
"""Relative distance of a step or tolerance from that in the name of its file."""


def file_of(run: Run) -> str:
    """Return the name of a history's file below the folder, as S1/m032_h1e-3.csv."""
    kind = "t" if run.is_adaptive else "h"
    return f"{run.case}/m{run.elements:03d}_{kind}{size_in_words(run.refinement)}.csv"


def size_in_words(size: float) -> str:
    """Return a step or tolerance as it stands in names of files, 4e-3."""
    return np.format_float_scientific(size, trim="-", exp_digits=1).replace("+", "")


def list_of(runs: Sequence[Run]) -> str:
    """Return the text of runs.csv, of runs with their files."""
    return tables.written(tables.RUNS, list(map(vars, runs)))


def runs_of(folder: Folder, only: Collection[str]) -> tuple[Run, ...]:
    """Return the runs of some or all cases that runs.csv lists; failed runs have no history."""
    there = [file for name in tables.HISTORIES for file in folder.histories(name)]
    if not there and not os.path.lexists(folder.root / FILE):
        return ()
    runs, listed = [], list(_listed(folder))
    for row in listed:
        if only and row["case"] not in only:
            continue
        case, step = CASES[row["case"]], row.get("step", math.nan)
        if "failure" in row:
            runs.append(Run(**row, time=np.empty(0), q=np.empty(0)))
        elif samples := history_of(folder, row["file"], case, step):
            runs.append(Run(**{**row, **samples}))
    complete, files = not folder.is_faulty(FILE), {row["file"] for row in listed}
    for file in there:
        if file in files:
            continue
        if complete:
            folder.add(file, f"stands in no row of {FILE}: add file, elements, step")
        else:
            _check(folder, file, only)
    return tuple(runs)


def _check(folder: Folder, file: str, only: Collection[str]) -> None:
    """Find the faults of a history whose row in runs.csv is missing or faulty."""
    try:
        case, _, kind, size = tables.RUNS[0].value(file).groups()
    except ValueError as error:
        folder.add(file, str(error))
        return
    if not only or case in only:
        history_of(folder, file, CASES[case], float(size) if kind == "h" else math.nan)


def _listed(folder: Folder) -> Iterator[dict[str, Any]]:
    """Yield the rows of runs.csv that are right, with their case."""
    lines: dict[tuple[str, int, float], int] = {}
    first: dict[str, str] = {}
    for line, _, row in tables.rows_of(folder, tables.sheet_of(folder, FILE, tables.RUNS)):
        case, elements, kind, size = row["file"].groups()
        of, other = ("step", "tolerance") if kind == "h" else ("tolerance", "step")
        place = case, row["elements"], row.get(of, 0.0)
        alike = math.isclose(place[2], float(size), rel_tol=_ROUNDED) and other not in row
        if row["elements"] != int(elements) or not alike:
            named = f"{int(elements)} elements and a {of} of {float(size):g}, the row does not"
            said = f"the file's name says {named}: correct one of them"
        elif first.setdefault(case, of) != of:
            said = f"a {of} and a {other} of {case}, which no fit takes together"
        elif lines.setdefault(place, line) != line:
            said = f"the same case, mesh and {of} stand in line {lines[place]}: keep one"
        else:
            yield row | {"file": row["file"][0], "case": case}
            continue
        folder.add(FILE, said, line)


def history_of(folder: Folder, file: str, case: Case, step: float) -> dict[str, FloatArray] | None:
    """Return time and q up to the end of the case, and the error that the last digits leave.

    None if something is wrong. In space q is lag, flap and twist, (samples, 3). `step` is NaN where
    it is not known. A rate, q_dot, is not judged.
    """
    sheet = tables.sheet_of(folder, file, tables.HISTORY[case.columns])
    if not sheet.rows:
        return None
    shape = len(sheet.rows), len(sheet.columns)
    try:
        numbers = np.loadtxt(sheet.rows, delimiter=",", ndmin=2, comments=None)
    except ValueError:
        numbers = np.empty(0)
    if numbers.shape != shape or not np.isfinite(numbers).all():
        # Row by row, which takes numbers in quotes, and tells what is wrong with others.
        numbers = np.array(
            [list(values.values()) for _, _, values in tables.rows_of(folder, sheet)]
        )
    if numbers.shape != shape:
        return None
    columns = {column.name: one for column, one in zip(sheet.columns, numbers.T, strict=True)}
    time, tip = columns["time"], np.stack([columns[name] for name in case.columns])
    most = dict.fromkeys(columns, tables.DIGITS)
    with np.errstate(over="ignore", invalid="ignore"):
        for k, (name, values) in enumerate(columns.items()):
            gaps = np.diff(values)
            # Even samples, such as 0.02 k, and zeros are exact however short.
            if not (gaps.size and np.ptp(gaps) <= 1e-9 * np.abs(values).max()):
                most[name] = tables.digits(row.split(",")[k] for row in sheet.rows)
        lengths = tip / np.array(case.sizes)[:, None] * case.blade.length
        farthest = lengths[np.abs(lengths).argmax(axis=0), np.arange(time.size)]
        wrong = [*tables.too_short(most), *_unfit(time, farthest, case, sheet.lines)]
    if folder.add_all(file, wrong):
        return None
    largest, late = np.abs(tip).max(axis=1), tables.rounding(most["time"], time[-1])
    lost = np.array(
        [tables.rounding(most[n], q) for n, q in zip(case.columns, largest, strict=True)]
    )
    # A time is exact, however short, that is a whole number of steps with all their decimals.
    off = np.abs(time / step - np.rint(time / step)).max()
    if late and not (late <= (0.5 + _SLACK) * step and off < _SLACK):
        lost += late * np.abs(np.gradient(tip, time, axis=1)).max(axis=1)
    within = time <= case.duration
    return {
        "time": time[within], "q": case.joined(tip)[within], "rounding": case.joined(lost)
    }  # fmt: skip


def _unfit(
    time: FloatArray, q: FloatArray, case: Case, lines: Sequence[int]
) -> Iterator[tuple[str, int]]:
    """Yield what keeps finite numbers from being the history of a case, and in which line."""
    gaps = np.diff(time)
    far = np.flatnonzero(np.abs(q) > FARTHEST_TIP * case.blade.length)
    if far.size:
        said = (
            f"q is {q[far[0]]:.3g} m, of a beam of {case.blade.length:g} m: a run that "
            "diverged has no file, but a sentence in the column failure of runs.csv"
        )
        yield said, lines[far[0]]
    back = np.flatnonzero(gaps <= 0.0)
    if back.size:
        before, after = time[back[0]], time[back[0] + 1]
        said = f"time must increase, but {after:.10g} s follows {before:.10g} s"
        remedy = ": sort the rows, keep one of each time, and write all digits"
        yield said + several(back.size) + remedy, lines[back[0] + 1]
        return
    if time[0] < -_SLACK or time[0] > FARTHEST:
        yield f"begins at {time[0]:.6g} s: begin at 0 s", lines[0]
    if time[-1] < case.duration - FARTHEST:
        said = f"ends at {time[-1]:.6g} s, case {case.name} lasts {case.duration:g} s: run it whole"
        yield said, lines[-1]
    wide = np.flatnonzero(gaps > FARTHEST * (1.0 + _SLACK))
    if wide.size:
        said = (
            f"samples are {1e3 * gaps[wide[0]]:.4g} ms apart{several(wide.size)}, at most "
            f"{1e3 * FARTHEST:g} ms leave something to measure: sample more often"
        )
        yield said, lines[wide[0] + 1]
