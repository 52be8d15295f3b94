"""The tables of a submission: their columns, and CSV both ways.

CSV has one header row, commas, C floats, and lines of # that are not read.
"""

from __future__ import annotations

import csv
import io
import math
import re
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from analytic.letters import plain_text

from ..case import Asked, Case
from ..cases import CASES
from ..space_cases import ROOT, TIP
from ..submission import LONGEST_REMARKS
from .faults import Folder, near, shown

LONGEST_LINE = 10_000
"""Letters of a line: beyond them is no row and no sentence."""

DIGITS, LEAST_DIGITS = 8, 5
"""Digits of a number that lose nothing, and that it has at least: four in the time alone cost
9.5e-3 of q(t). Between them the last digit is an error, which widens the floor."""

HISTORIES = [name for name, case in CASES.items() if case.asked is Asked.HISTORY]
_HISTORY = re.compile(
    r"([^/]*)/m([0-9]{1,9})_([ht])((?:[0-9]{1,20}(?:\.[0-9]{1,20})?|\.[0-9]{1,20})(?:e[-+]?[0-9]{1,3})?)\.csv"
)
"""Name of a history's file: case, elements, and step [s] or tolerance."""

_NUMBER = re.compile(r"[-+]?([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][-+]?[0-9]+)?")
_FORTRAN = re.compile(r"[-+]?[0-9]*(\.[0-9]*)?[dD][-+]?[0-9]+")
_NOT_FINITE = "nan", "inf", "infinity", "nan(ind)"
_HEADER = re.compile(r"(?P<name>[^\[\]()]*?)\s*(?:[\[(](?P<unit>.*)[\])])?")
_SEPARATORS = {";": "semicolons", "\t": "tabs", "|": "bars", " ": "blanks"}
_SAME = 1e-6
"""Relative distance within which a speed or an amplitude is taken for a requested one."""

LEAST, MOST = 1e-20, 1e12
"""Sizes of numbers that are read, in any unit; what is beyond is a slip, or a run that diverged."""

_RANGES: dict[str, Callable[[float], bool]] = {
    "be a whole number of at least 1": lambda value: value >= 1.0 and value.is_integer(),
    f"be positive, of {LEAST:g} at least": lambda value: value >= LEAST,
    "not be negative": lambda value: value >= 0.0,
}
WHOLE, POSITIVE, NOT_NEGATIVE = _RANGES


@dataclass(frozen=True)
class Column:
    """A column of numbers, in its unit, range, and among those asked for; or one of text.

    Each table has the needed columns; cells of the others may be empty. Each row has the measured
    columns, but for rows that report a failure.
    """

    name: str
    unit: str = ""
    must: str = ""
    among: Sequence[float] = ()
    text: Callable[[str], str | re.Match[str]] | None = None
    needed: bool = True
    measured: bool = False

    @property
    def field(self) -> str:
        """Attribute that is read: the name without its unit."""
        return self.name.removesuffix("_s")

    def value(self, cell: str) -> Any:
        """Return what a cell says; ValueError with the sentence on a faulty one."""
        if self.text:
            return self.text(cell)
        value = number(self.name, cell)
        if self.must and not _RANGES[self.must](value):
            raise ValueError(f"{self.name} must {self.must}, got {cell}")
        if self.among:
            close = min(self.among, key=lambda listed: abs(listed - value))
            if abs(close - value) > _SAME * (abs(close) or 1.0):
                listed = ", ".join(f"{one:g}" for one in self.among)
                raise ValueError(f"{self.name} {value:g} is not asked for: hand in {listed}")
            return close
        return int(value) if self.must == WHOLE else value


def number(name: str, cell: str) -> float:
    """Return a finite number of at most MOST."""
    if _NUMBER.fullmatch(cell) and math.isfinite(float(cell)):
        if abs(float(cell)) > MOST:
            why = f"is larger than {MOST:g}: check the unit, or hand in the failure of the run"
            raise ValueError(f"{name}: {shown(cell)} {why}")
        return float(cell)
    if not cell:
        raise ValueError(f"{name}: a cell is empty: write a number")
    if _FORTRAN.fullmatch(cell):
        why = "has Fortran's exponent D: write E"
    elif _NUMBER.fullmatch(cell) or cell.lower().lstrip("+-") in _NOT_FINITE:
        why = "is not finite: hand in what the code computed, or its failure"
    else:
        why = "is no number: write it as C does, -1.25e-3"
    raise ValueError(f"{name}: {shown(cell)} {why}")


def _history(cell: str) -> re.Match[str]:
    case, match = cell.partition("/")[0], _HISTORY.fullmatch(cell)
    if case not in HISTORIES:
        among = f"known are {', '.join(HISTORIES)}"
        raise ValueError(f"{shown(case)} is no case with a history; {among}")
    if match is None:
        remedy = f"write {case}/m032_h1e-3.csv, or _t1e-6 of a tolerance"
        raise ValueError(f"{shown(cell)} is no name of a history: {remedy}")
    return match


def _sentence(name: str) -> Column:
    return Column(name, text=lambda cell: plain_text(name, cell, LONGEST_REMARKS), needed=False)


ELEMENTS, FAILURE = Column("elements", must=WHOLE), _sentence("failure")
RUNS = (
    Column("file", text=_history), ELEMENTS,
    Column("step", "s", POSITIVE, needed=False), Column("tolerance", must=POSITIVE, needed=False),
    Column("dof", must=WHOLE, needed=False), Column("wall_s", "s", NOT_NEGATIVE, needed=False),
    Column("cpu_s", "s", NOT_NEGATIVE, needed=False),
    FAILURE, _sentence("remark"),
)  # fmt: skip
"""Columns of runs.csv."""

_TIME = Column("time", "s")
_TIP = tuple(Column(name, "rad" if name == "twist" else "m", measured=True) for name in TIP)
HISTORY = {
    TIP: (_TIME, *_TIP),
    (*TIP, *ROOT): (_TIME, *_TIP, *(Column(name, "N m", measured=True) for name in ROOT)),
    ("q",): (_TIME, Column("q", "m"), Column("q_dot", "m/s", needed=False, measured=True)),
}
"""Columns of histories by `Case.columns`."""


def columns_of(case: Case) -> tuple[Column, ...]:
    """Return the columns of a case that is handed in as one table."""
    places = [ELEMENTS, Column("speed", "rad/s", among=case.speeds)]
    if case.amplitudes:
        places.append(Column("amplitude", among=case.amplitudes))
    if case.count > 1:
        places.append(Column("number", among=range(1, case.count + 1)))
    if case.asked is Asked.STEADY:
        return (*places, *_TIP, FAILURE)
    frequency = Column("frequency", "rad/s", POSITIVE, measured=True)
    return (*places, frequency, Column("rounding", "rad/s", NOT_NEGATIVE, needed=False), FAILURE)


class Sheet(NamedTuple):
    """Rows of a table as written, with their line numbers; columns as in the header."""

    file: str
    columns: list[Column]
    rows: list[str]
    lines: list[int]


def sheet_of(folder: Folder, file: str, columns: Sequence[Column]) -> Sheet:
    """Return a table, without rows where it cannot be used."""
    text = folder.text(file)
    numbered = [
        (line, row)
        for line, row in enumerate((text or "").split("\n"), 1)
        if row.lstrip()[:1] not in ("", "#")
    ]
    if text is None or folder.add_all(file, _wrong(numbered, columns)):
        return Sheet(file, [], [], [])
    by_name = {column.name: column for column in columns}
    (first, header), *rest = numbered
    if not rest:
        folder.add(file, "has a header and no rows below it", first)
    held = [by_name[_title(cell)[0]] for cell in header.split(",")]
    return Sheet(file, held, [row for _, row in rest], [line for line, _ in rest])


def _title(cell: str) -> tuple[str, str]:
    """Return the name in a cell of the header and the unit, if there is one in brackets."""
    match = _HEADER.fullmatch(cell.strip().strip('"').strip())
    return (match["name"], (match["unit"] or "").strip()) if match else (cell, "")


def _wrong(
    numbered: Sequence[tuple[int, str]], columns: Sequence[Column]
) -> Iterator[tuple[str, int | None]]:
    """Yield what keeps lines from being a table of some columns, and where."""
    expected = ",".join(column.name for column in columns if column.needed)
    if not numbered:
        yield f"is empty: begin with the header {expected}", None
        return
    for line, row in numbered:
        if len(row) > LONGEST_LINE:
            many = f"has {len(row):,} letters, more than {LONGEST_LINE:,}"
            yield f"{many}: keep to {expected}", line
            return
    first, header = numbered[0]
    if "," not in header and "," in expected:
        other = [f" by {name}" for mark, name in _SEPARATORS.items() if mark in header.strip()]
        split = f"is split{other[0]}" if other else f"is {shown(header.strip())}"
        yield f"the header {split}: separate the columns by commas, {expected}", first
        return
    titles = [_title(cell) for cell in header.split(",")]
    names, units = [name for name, _ in titles], {column.name: column.unit for column in columns}
    if all(_NUMBER.fullmatch(name) for name in names):
        yield f"there is no header, the first row holds numbers: begin with {expected}", first
        return
    for name, unit in titles:
        if name not in units:
            yield f"unknown column {shown(name)}; {near(name, units)}", first
        elif unit and unit != units[name]:
            due = f"[{units[name]}]" if units[name] else "no unit"
            yield f"column {name!r} is in {shown(unit)}: write it in {due}", first
    missing = [name for name in expected.split(",") if name not in names]
    if missing:
        yield f"there is no column {', '.join(missing)}: the header is {expected}", first
    twice = [name for name, count in Counter(names).items() if count > 1]
    if twice:
        yield f"column {shown(twice[0])} occurs twice: keep one", first


def rows_of(folder: Folder, sheet: Sheet) -> Iterator[tuple[int, dict[str, str], dict[str, Any]]]:
    """Yield line, cells by column and values by field of each row that is right by itself.

    Values that are not given are left out.
    """
    for line, row in zip(sheet.lines, sheet.rows, strict=True):
        try:
            written = next(csv.reader([row], strict=True, skipinitialspace=True))
        except csv.Error as error:
            folder.add(sheet.file, f"is no row of CSV: {error}", line)
            continue
        if len(written) != len(sheet.columns):
            has = f"has {len(written)} cell{'s' * (len(written) > 1)}"
            remedy = "write the row whole, with commas between cells and decimal points"
            folder.add(sheet.file, f"{has}, the header {len(sheet.columns)}: {remedy}", line)
            continue
        cells = {column: cell.strip() for column, cell in zip(sheet.columns, written, strict=True)}
        values, right, failed = {}, True, bool(cells.get(FAILURE))
        for column, cell in cells.items():
            if failed if column.measured else not (cell or column.needed):
                continue
            try:
                values[column.field] = column.value(cell)
            except ValueError as error:
                folder.add(sheet.file, str(error), line)
                right = False
        if right:
            yield line, {column.name: cell for column, cell in cells.items()}, values


def digits(cells: Iterable[str]) -> int:
    """Return to how many digits cells are written at most; DIGITS stands for more."""
    most = 0
    for cell in cells:
        mantissa = re.split("[eE]", cell.strip(' "'))[0].lstrip("+-").replace(".", "")
        most = max(most, len(mantissa.lstrip("0")))
        if most >= DIGITS:
            return DIGITS
    return most


def too_short(most: Mapping[str, int]) -> Iterator[tuple[str, None]]:
    """Yield the sentences on columns that are written to too few digits."""
    for name, count in most.items():
        if count < LEAST_DIGITS:
            due = f"at least {LEAST_DIGITS} are needed and {DIGITS} lose nothing: write %.10g"
            yield f"column {name!r} is written to {count} digits, {due}", None


def rounding(most: int, largest: float) -> float:
    """Return by how much numbers are off that are written to `most` digits; 0 of DIGITS.

    Half a unit of the last decimal of the largest, which %g and %f have alike.
    """
    if most == DIGITS or not largest:
        return 0.0
    return 0.5 * float(10.0 ** (math.floor(math.log10(largest)) + 1 - most))


def written(columns: Iterable[Column], rows: Sequence[Mapping[str, object]]) -> str:
    """Return the table of rows by field, which reads back the same."""
    held = [
        one for one in columns
        if one.needed or any(row.get(one.field) is not None for row in rows)
    ]  # fmt: skip
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(column.name for column in held)
    writer.writerows([_cell(row.get(column.field)) for column in held] for row in rows)
    return out.getvalue()


def _cell(value: object) -> str:
    """Return a cell, empty for an unknown value; a sentence has one line."""
    if value is None or (isinstance(value, float) and math.isnan(value)):
        return ""
    if isinstance(value, str):
        return " ".join(value.split())
    return repr(value.item() if isinstance(value, np.generic) else value)
