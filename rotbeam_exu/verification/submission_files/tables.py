"""CSV as a submission has it: one header row, commas, C floats, lines of # that are not read.

`Sheet` is a file's rows with their line numbers; `records` splits them into named cells. Long
tables of numbers alone are read by `histories`.
"""

from __future__ import annotations

import csv
import difflib
import math
import re
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from .content import text_of
from .faults import Faults

MOST_LINES = 2_000_000
LONGEST_LINE = 10_000
"""Letters of a line, and lines of a table: beyond them is no history and no sentence."""

_NUMBER = re.compile(r"[-+]?([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][-+]?[0-9]+)?")
_FORTRAN = re.compile(r"[-+]?[0-9]*(\.[0-9]*)?[dD][-+]?[0-9]+")
_HEADER = re.compile(r"(?P<name>[^\[\]()]*?)\s*(?:[\[(](?P<unit>.*)[\])])?")
_SHOWN = 40
"""Letters of a faulty cell that a sentence repeats."""


@dataclass(frozen=True, kw_only=True)
class Sheet:
    """The lines of a table that hold something, the header apart.

    Attributes
    ----------
    file : str
    names : tuple of str
        Columns, as the header has them.
    header : int
        Line number of the header.
    rows : list of str
        As written.
    lines : list of int
        Line number of each row.
    """

    file: str
    names: tuple[str, ...]
    header: int
    rows: list[str] = field(repr=False)
    lines: list[int] = field(repr=False)


def sheet_of(
    folder: Path,
    file: str,
    required: Mapping[str, str],
    optional: Mapping[str, str],
    faults: Faults,
) -> Sheet | None:
    """Return the rows of a table; None where it has no header that can be used.

    Parameters
    ----------
    folder, file
    required, optional : mapping
        The unit of each column by its name, "" without one.
    faults : Faults
        To which what is wrong is added.
    """
    text = text_of(folder, file, faults)
    if text is None:
        return None
    if text.count("\n") > MOST_LINES:
        faults.add(file, f"has more than {MOST_LINES:,} lines: sample less often")
        return None
    numbered = [
        (number, line)
        for number, line in enumerate(text.split("\n"), 1)
        if line and not line.isspace() and not line.lstrip().startswith("#")
    ]
    wanted = ",".join(required)
    if not numbered:
        faults.add(file, f"is empty: begin with the header {wanted}")
        return None
    for number, line in numbered:
        if len(line) > LONGEST_LINE:
            said = f"has {len(line):,} letters, more than {LONGEST_LINE:,}: keep to {wanted}"
            faults.add(file, said, number)
            return None
    header, title = numbered[0]
    wrong = _wrong_header(title, {**required, **optional}, tuple(required))
    if not wrong and len(numbered) == 1:
        wrong = ["has a header and no rows below it"]
    for said in wrong:
        faults.add(file, said, header)
    if wrong:
        return None
    return Sheet(
        file=file,
        names=tuple(_cell_of_header(cell)[0] for cell in title.split(",")),
        header=header,
        rows=[line for _, line in numbered[1:]],
        lines=[number for number, _ in numbered[1:]],
    )


def _cell_of_header(cell: str) -> tuple[str, str]:
    """Return the name and the unit, if there is one in brackets."""
    match = _HEADER.fullmatch(cell.strip().strip('"').strip())
    return (match["name"], (match["unit"] or "").strip()) if match else (cell, "")


def _wrong_header(title: str, units: Mapping[str, str], required: tuple[str, ...]) -> list[str]:
    """Return what is wrong with a header row."""
    wanted = ",".join(required)
    if "," not in title and len(required) > 1:
        other = [f" by {name}" for mark, name in _SEPARATORS.items() if mark in title.strip()]
        split = f"is split{other[0]}" if other else f"is {shown(title.strip())}"
        return [f"the header {split}: separate the columns by commas, {wanted}"]
    cells = [_cell_of_header(cell) for cell in title.split(",")]
    names = [name for name, _ in cells]
    if all(_NUMBER.fullmatch(name) for name in names):
        return [f"there is no header, the first row holds numbers: begin with {wanted}"]
    found = []
    for name, unit in cells:
        if name not in units:
            close = difflib.get_close_matches(name.lower(), list(units), n=1)
            hint = f"did you mean {close[0]!r}?" if close else f"known are {', '.join(units)}"
            found.append(f"unknown column {shown(name)}; {hint}")
        elif unit and unit != units[name]:
            due = f"[{units[name]}]" if units[name] else "no unit"
            found.append(f"column {name!r} is in {shown(unit)}: write it in {due}")
    missing = [name for name in required if name not in names]
    if missing:
        found.append(f"there is no column {', '.join(missing)}: the header is {wanted}")
    twice = [name for name, count in Counter(names).items() if count > 1]
    if twice:
        found.append(f"column {shown(twice[0])} occurs twice: keep one")
    return found


_SEPARATORS = {";": "semicolons", "\t": "tabs", "|": "bars", " ": "blanks"}


def records(sheet: Sheet, faults: Faults) -> list[tuple[int, dict[str, str]]]:
    """Return line number and cells by column of each row that has as many cells as the header."""
    found = []
    for line, row in zip(sheet.lines, sheet.rows, strict=True):
        try:
            cells = next(csv.reader([row], strict=True, skipinitialspace=True))
        except csv.Error as error:
            faults.add(sheet.file, f"is no row of CSV: {error}", line)
            continue
        if len(cells) != len(sheet.names):
            faults.add(sheet.file, columns_fault(row, len(cells), len(sheet.names)), line)
            continue
        found.append((line, dict(zip(sheet.names, map(str.strip, cells), strict=True))))
    return found


def columns_fault(row: str, cells: int, wanted: int) -> str:
    """Return the sentence on a row of too few or too many cells."""
    if cells == 1:
        for mark, name in _SEPARATORS.items():
            if mark in row.strip():
                return f"cells are separated by {name}: separate them by commas"
    if ";" in row:
        return "cells are separated by semicolons: separate them by commas, with decimal points"
    return (
        f"has {cells} {'cell' if cells == 1 else 'cells'}, the header {wanted}: "
        "write the row whole, and decimals with a point"
    )


def number_fault(cell: str) -> str:
    """Return what is wrong with a cell that should hold a finite number, or nothing."""
    if _NUMBER.fullmatch(cell):
        if math.isfinite(float(cell)):
            return ""
        return f"{shown(cell)} is too large a number"
    if not cell:
        return "a cell is empty: write a number"
    if _FORTRAN.fullmatch(cell):
        return f"{shown(cell)} has Fortran's exponent D: write E"
    if cell.lower().lstrip("+-") in ("nan", "inf", "infinity", "-nan(ind)", "nan(ind)"):
        return f"{shown(cell)} is not finite: hand in what the code computed, or its failure"
    return f"{shown(cell)} is no number: write it as C does, -1.25e-3"


def shown(text: str) -> str:
    """Return a text in quotes, what cannot be printed escaped, and not too much of it."""
    quoted = ascii(text) if not text.isprintable() else repr(text)
    return quoted if len(quoted) <= _SHOWN else f"{quoted[:_SHOWN]}...{quoted[0]}"


def digits(cell: str) -> int:
    """Return the significant digits that are written."""
    mantissa = re.split("[eE]", cell.strip())[0].lstrip("+-").replace(".", "")
    return len(mantissa.lstrip("0"))
