"""The history of a run as a file: read at once where it is right, row by row where it is not."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from analytic.arrays import FloatArray

from ..cases import Case
from .faults import Faults, several
from .tables import DIGITS, Column, Sheet, digits, rows_of, sheet_of

FARTHEST = 0.02
"""Largest distance of samples [s]: the estimator needs twenty a period, and 100 ms give it none."""

FARTHEST_TIP = 1e4
"""Largest |q|/L that is judged: millimetres for metres, and no more than that."""

COLUMNS = (
    Column("time", unit="s"),
    Column("q", unit="m"),
    Column("q_dot", unit="m/s", needed=False, measured=True),
)
_SLACK = 1e-6


def history_of(folder: Path, file: str, case: Case, faults: Faults) -> dict[str, FloatArray] | None:
    """Return time, q and perhaps q_dot up to the end of the case; None if something is wrong."""
    sheet = sheet_of(folder, file, COLUMNS, faults)
    if sheet is None:
        return None
    numbers = _numbers(sheet, faults)
    if numbers is None:
        return None
    columns = {column.name: one for column, one in zip(sheet.columns, numbers.T, strict=True)}
    with np.errstate(over="ignore", invalid="ignore"):
        unfit = _unfit(sheet, columns, case)
    for said, row in unfit:
        faults.add(file, said, None if row is None else sheet.lines[row])
    if unfit:
        return None
    within = columns["time"] <= case.duration
    return {name: values[within] for name, values in columns.items()}


def _numbers(sheet: Sheet, faults: Faults) -> FloatArray | None:
    """Return all numbers, (rows, columns); None if some are faulty."""
    shape = len(sheet.rows), len(sheet.columns)
    try:
        numbers = np.loadtxt(sheet.rows, delimiter=",", ndmin=2, comments=None)
    except ValueError:
        numbers = np.empty((0, 0))
    if numbers.shape != shape or not np.isfinite(numbers).all():
        rows = [list(values.values()) for _, _, values in rows_of(sheet, faults)]
        numbers = np.array(rows, dtype=float)
    return numbers if numbers.shape == shape else None


def _unfit(
    sheet: Sheet, columns: dict[str, FloatArray], case: Case
) -> list[tuple[str, int | None]]:
    """Return what keeps finite numbers from being the history of a case, and in which row."""
    time = columns["time"]
    gaps = np.diff(time)
    found: list[tuple[str, int | None]] = [
        (f"column {name!r} is written to {most} digits, {DIGITS} are needed: write %.10g", None)
        for number, name in enumerate(columns)
        if (most := _most_digits(sheet, number, columns[name])) < DIGITS
    ]
    far = np.flatnonzero(np.abs(columns["q"]) > FARTHEST_TIP * case.blade.length)
    if far.size:
        said = (
            f"q is {columns['q'][far[0]]:.3g} m, of a beam of {case.blade.length:g} m: a run that "
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


def _most_digits(sheet: Sheet, number: int, values: FloatArray) -> int:
    """Return the digits written of a column, DIGITS where that many are, or fewer are exact."""
    gaps = np.diff(values)
    even = gaps.size and np.ptp(gaps) <= 1e-9 * np.abs(values).max()
    if even:
        # Even samples, such as 0.02 k, and zeros are exact however short.
        return DIGITS
    most = 0
    for row in sheet.rows:
        most = max(most, digits(row.split(",")[number]))
        if most >= DIGITS:
            return DIGITS
    return most
