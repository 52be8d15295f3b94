"""Printing a table of columns, for a reader or as CSV."""

from __future__ import annotations

import csv
import sys
from collections.abc import Mapping, Sequence
from typing import Literal

from rich.console import Console
from rich.markup import escape
from rich.table import Table

Format = Literal["table", "csv"]


def print_columns(
    columns: Mapping[str, Sequence[str | float]], form: Format, title: str = ""
) -> None:
    """Print named columns of equal length; floats in full in CSV, to 7 digits in a table."""
    rows = list(zip(*columns.values(), strict=True))
    if form == "csv":
        writer = csv.writer(sys.stdout, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows(rows)
        return
    table = Table(title=escape(title) or None)
    for name, cells in columns.items():
        numeric = bool(cells) and isinstance(cells[0], float)
        table.add_column(escape(name), justify="right" if numeric else "left", overflow="fold")
    for row in rows:
        table.add_row(*(f"{cell:.7g}" if isinstance(cell, float) else escape(cell) for cell in row))
    Console().print(table)
