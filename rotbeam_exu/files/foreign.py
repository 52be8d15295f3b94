"""Text of other codes' input files: numbers as Fortran writes them, values by name, rows.

No library reads them: openfast_io 5.0.0 knows the format of OpenFAST 5 alone, and takes ElastoDyn's
former column PitchAxis for the twist; wetb is under GPL and installs 25 packages.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from analytic.input_checks import shown

_NUMBER = re.compile(r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eEdD][+-]?[0-9]+)?")
_LARGEST = 50_000_000  # bytes, a thousand times what blades have


@dataclass(frozen=True)
class ForeignText:
    """A text file; nothing in it is executed, and nothing of it is shown but a cell or a name."""

    path: Path

    @cached_property
    def lines(self) -> list[str]:
        """Lines; letters that are not UTF-8 stand in remarks alone."""
        if not self.path.is_file():
            raise FileNotFoundError(f"there is no file {self.path}")
        if (size := self.path.stat().st_size) > _LARGEST:
            raise ValueError(
                f"{self.path} has {size / 1e6:.0f} MB, and files of blades have less than "
                f"{_LARGEST / 1e6:.0f}: give another"
            )
        return self.path.read_bytes().decode("utf-8-sig", errors="replace").splitlines()

    def first(self, pattern: str, what: str, start: int = 0) -> int:
        """Return the first line that matches, refusing a file without one."""
        for place, line in enumerate(self.lines[start:], start):
            if re.search(pattern, line, re.IGNORECASE):
                return place
        raise ValueError(f"{self.path} has no {what}{f' after line {start}' * (start > 0)}")

    def value(self, name: str) -> str:
        """Return the text before a name, as OpenFAST's files have values."""
        pattern = rf"""^\s*("[^"]*"|'[^']*'|[^\s,]+)[\s,]+{re.escape(name)}(\W|$)"""
        line = self.lines[self.first(pattern, f"line with a value and the name {name}")]
        match = re.match(pattern, line, re.IGNORECASE)
        assert match
        return match[1].strip("\"'")

    def number(self, name: str) -> float:
        """Return the number before a name."""
        return self._number(self.value(name), f"{name} is")

    def count(self, name: str, least: int) -> int:
        """Return the whole number before a name."""
        text = self.value(name)
        if not (text.isascii() and text.isdigit() and int(text[:9]) >= least):
            raise ValueError(
                f"{self.path}: {name} must be a whole number from {least} on, got {shown(text)}"
            )
        return int(text[:9])

    def row(self, place: int, count: int) -> list[float]:
        """Return the numbers of a line, between blanks or commas; behind them may be a remark."""
        if place >= len(self.lines):
            raise ValueError(f"{self.path} ends where {count} numbers should stand: is it whole?")
        remark = re.split(r"[;!#]", self.lines[place])[0]
        return self.cells(remark.replace(",", " ").split(), count, place)

    def cells(self, cells: list[str], count: int, place: int) -> list[float]:
        """Return the first cells of a line as numbers; refuse more numbers."""
        where = f"line {place + 1} has"
        if len(cells) < count or any(map(_NUMBER.fullmatch, cells[count:])):
            raise ValueError(
                f"{self.path}: {where} {len(cells)} cells where {count} numbers are expected; "
                "write a decimal point, as 1.5, where it has a decimal comma"
            )
        return [self._number(cell, where) for cell in cells[:count]]

    def rows(self, start: int, count: int, width: int) -> list[list[float]]:
        """Return so many lines of numbers; blank ones between them do not count."""
        rows, place = list[list[float]](), start
        while len(rows) < count:
            if place >= len(self.lines) or self.lines[place].strip():
                rows.append(self.row(place, width))
            place += 1
        return rows

    def beside(self, name: str) -> Path:
        """Return the path of a file that this one names, in its own folder or one within."""
        folder = self.path.parent.resolve()
        path = (folder / name.replace("\\", "/")).resolve()
        if not (path.is_relative_to(folder) and path.is_file()):
            raise ValueError(
                f"{self.path} names the file {shown(name)}, which is not in its folder: copy both "
                "into one, and write the name without the other"
            )
        return path

    def _number(self, cell: str, where: str) -> float:
        plain = cell.lower().replace("d", "e")
        number = float(plain) if _NUMBER.fullmatch(cell) else math.nan
        if not math.isfinite(number):
            raise ValueError(f"{self.path}: {where} {shown(cell)}, which is no number as 1.5e6")
        return number
