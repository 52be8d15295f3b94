"""CSV as a submission has it: one header row, commas, C floats, lines of # that are not read.

A table is described by its columns, of a `Kind` each. `Sheet` is its lines, `rows_of` its values,
`written` writes it. Histories, which are long, are read at once by `runs` where they are right.
"""

from __future__ import annotations

import csv
import io
import math
import re
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from .faults import Faults, near, shown, text_of

LONGEST_LINE = 10_000
"""Letters of a line: beyond them is no row and no sentence."""

DIGITS, LEAST_DIGITS = 8, 5
"""Digits of a number that lose nothing, and that it has at least: four in the time alone cost
9.5e-3 of q(t). Between them the last digit is an error, which widens the floor."""

TOO_FEW = f"digits, at least {LEAST_DIGITS} are needed and {DIGITS} lose nothing: write %.10g"
"""End of the sentence on numbers that are too short."""

_NUMBER = re.compile(r"[-+]?([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][-+]?[0-9]+)?")
_FORTRAN = re.compile(r"[-+]?[0-9]*(\.[0-9]*)?[dD][-+]?[0-9]+")
_NOT_FINITE = "nan", "inf", "infinity", "nan(ind)"
_HEADER = re.compile(r"(?P<name>[^\[\]()]*?)\s*(?:[\[(](?P<unit>.*)[\])])?")
_SEPARATORS = {";": "semicolons", "\t": "tabs", "|": "bars", " ": "blanks"}
_SAME = 1e-6
"""Relative distance within which a speed or an amplitude is taken for a requested one."""

Kind = Callable[[str, str], Any]
"""From a column's name and a cell to its value; ValueError with the sentence on a faulty cell."""


def text(_name: str, cell: str) -> str:
    """Return a text as it is."""
    return cell


def number(name: str, cell: str) -> float:
    """Return a finite number."""
    if _NUMBER.fullmatch(cell) and math.isfinite(float(cell)):
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


def whole(name: str, cell: str) -> int:
    """Return a whole number of at least 1."""
    value = number(name, cell)
    if not (value >= 1.0 and value.is_integer()):
        raise ValueError(f"{name} must be a whole number of at least 1, got {cell}")
    return int(value)


def positive(name: str, cell: str) -> float:
    """Return a number above zero."""
    value = number(name, cell)
    if value <= 0.0:
        raise ValueError(f"{name} must be positive, got {cell}")
    return value


def not_negative(name: str, cell: str) -> float:
    """Return a number of zero or more."""
    value = number(name, cell)
    if value < 0.0:
        raise ValueError(f"{name} must not be negative, got {cell}")
    return value


def asked(values: Sequence[float]) -> Kind:
    """Return the kind of numbers that are asked for; one close to it stands for such a number."""

    def read(name: str, cell: str) -> float:
        value = number(name, cell)
        close = min(values, key=lambda known: abs(known - value))
        if abs(close - value) > _SAME * (abs(close) or 1.0):
            known = ", ".join(f"{one:g}" for one in values)
            raise ValueError(f"{name} {value:g} is not asked for: hand in {known}")
        return close

    return read


@dataclass(frozen=True)
class Column:
    """A column of a table, whose header may state its unit.

    Each table has the needed columns; cells of the others may be empty. Each row has the measured
    columns, but for rows that tell a failure.
    """

    name: str
    kind: Kind = number
    unit: str = ""
    needed: bool = True
    measured: bool = False

    @property
    def field(self) -> str:
        """Attribute that is read: the name without its unit."""
        return self.name.removesuffix("_s")


FAILURE = Column("failure", text, needed=False)


class Sheet(NamedTuple):
    """Rows of a table as written, with their line numbers; columns as in the header."""

    file: str
    columns: list[Column]
    rows: list[str]
    lines: list[int]


def sheet_of(folder: Path, file: str, columns: Sequence[Column], faults: Faults) -> Sheet | None:
    """Return the rows of a table; None, and why, where it has no header that can be used."""
    content = text_of(folder, file, faults)
    if content is None:
        return None
    numbered = [
        (line, row)
        for line, row in enumerate(content.split("\n"), 1)
        if row and not row.isspace() and not row.lstrip().startswith("#")
    ]
    wanted = ",".join(column.name for column in columns if column.needed)
    if not numbered:
        faults.add(file, f"is empty: begin with the header {wanted}")
        return None
    for line, row in numbered:
        if len(row) > LONGEST_LINE:
            many = f"has {len(row):,} letters, more than {LONGEST_LINE:,}"
            faults.add(file, f"{many}: keep to {wanted}", line)
            return None
    (first, title), *rest = numbered
    wrong = _wrong_header(title, columns, wanted)
    if not (wrong or rest):
        wrong = ["has a header and no rows below it"]
    for said in wrong:
        faults.add(file, said, first)
    if wrong:
        return None
    known = {column.name: column for column in columns}
    header = [known[_cell_of_header(cell)[0]] for cell in title.split(",")]
    return Sheet(file, header, [row for _, row in rest], [line for line, _ in rest])


def _cell_of_header(cell: str) -> tuple[str, str]:
    """Return the name and the unit, if there is one in brackets."""
    match = _HEADER.fullmatch(cell.strip().strip('"').strip())
    return (match["name"], (match["unit"] or "").strip()) if match else (cell, "")


def _wrong_header(title: str, columns: Sequence[Column], wanted: str) -> list[str]:
    """Return the fault of a header row."""
    if "," not in title and "," in wanted:
        other = [f" by {name}" for mark, name in _SEPARATORS.items() if mark in title.strip()]
        split = f"is split{other[0]}" if other else f"is {shown(title.strip())}"
        return [f"the header {split}: separate the columns by commas, {wanted}"]
    cells = [_cell_of_header(cell) for cell in title.split(",")]
    names, units = [name for name, _ in cells], {column.name: column.unit for column in columns}
    if all(_NUMBER.fullmatch(name) for name in names):
        return [f"there is no header, the first row holds numbers: begin with {wanted}"]
    found = []
    for name, unit in cells:
        if name not in units:
            found.append(f"unknown column {shown(name)}; {near(name, units)}")
        elif unit and unit != units[name]:
            due = f"[{units[name]}]" if units[name] else "no unit"
            found.append(f"column {name!r} is in {shown(unit)}: write it in {due}")
    missing = [name for name in wanted.split(",") if name not in names]
    if missing:
        found.append(f"there is no column {', '.join(missing)}: the header is {wanted}")
    twice = [name for name, count in Counter(names).items() if count > 1]
    if twice:
        found.append(f"column {shown(twice[0])} occurs twice: keep one")
    return found


def rows_of(sheet: Sheet, faults: Faults) -> Iterator[tuple[int, dict[str, str], dict[str, Any]]]:
    """Yield line, cells by column and values by field of each row that is right by itself.

    Values that are not told are left out.
    """
    for line, row in zip(sheet.lines, sheet.rows, strict=True):
        try:
            cells = next(csv.reader([row], strict=True, skipinitialspace=True))
        except csv.Error as error:
            faults.add(sheet.file, f"is no row of CSV: {error}", line)
            continue
        if len(cells) != len(sheet.columns):
            has = f"has {len(cells)} cell{'s' * (len(cells) > 1)}, the header {len(sheet.columns)}"
            remedy = "write the row whole, with commas between cells and decimal points"
            faults.add(sheet.file, f"{has}: {remedy}", line)
            continue
        pairs = list(zip(sheet.columns, map(str.strip, cells), strict=True))
        failed = any(cell and column is FAILURE for column, cell in pairs)
        values, right = {}, True
        for column, cell in pairs:
            if failed if column.measured else not (cell or column.needed):
                continue
            try:
                values[column.field] = column.kind(column.name, cell)
            except ValueError as error:
                faults.add(sheet.file, str(error), line)
                right = False
        if right:
            yield line, {column.name: cell for column, cell in pairs}, values


def digits(cell: str) -> int:
    """Return the significant digits that are written."""
    mantissa = re.split("[eE]", cell.strip(' "'))[0].lstrip("+-").replace(".", "")
    return len(mantissa.lstrip("0"))


def rounding(most: int, largest: float) -> float:
    """Return by how much numbers are off that are written to `most` digits; 0 of DIGITS or more.

    Half a unit of the last decimal of the largest, which %g and %f have alike.
    """
    if most >= DIGITS or not largest:
        return 0.0
    return 0.5 * float(10.0 ** (math.floor(math.log10(largest)) + 1 - most))


def written(columns: Iterable[Column], rows: Sequence[Mapping[str, object]]) -> str:
    """Return the table of rows by field, which reads back the same."""
    held = [one for one in columns if any(row.get(one.field) is not None for row in rows)]
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(column.name for column in held)
    writer.writerows([_cell(row.get(column.field)) for column in held] for row in rows)
    return out.getvalue()


def _cell(cell: object) -> str:
    """Return a cell, empty for an unknown value; a sentence has one line."""
    if cell is None or (isinstance(cell, float) and math.isnan(cell)):
        return ""
    if isinstance(cell, str):
        return " ".join(cell.split())
    return repr(cell.item() if isinstance(cell, np.generic) else cell)
