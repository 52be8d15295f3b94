"""`rotbeam table N`: the paper's tables compared with the values that the package derives."""

from __future__ import annotations

from typing import Annotated

from cyclopts import Parameter

import analytic
from analytic.reduced.tables import PaperTable

from .options import numbered
from .output import Format, print_columns, print_note


def table(
    number: str,
    /,
    *,
    form: Annotated[Format, Parameter(name="--format")] = "table",
) -> None:
    """Print a table of the paper, as printed and as derived.

    Differences and errata are marked; the marks are explained below the table.

    Parameters
    ----------
    number
        1 to 5, or all.
    form
        A table for the reader, or CSV.

    Examples
    --------
    $ rotbeam table 3
    $ rotbeam table all --format csv
    """
    wanted = numbered("table", number, range(1, 6))
    for one in wanted:
        _print(analytic.paper_table(one), form, several=len(wanted) > 1)


def _print(result: PaperTable, form: Format, *, several: bool) -> None:
    names = ("quantity", "printed", "derived", "difference", "note")
    columns = {name: [getattr(row, name) for row in result.rows] for name in names}
    notes = [note for note in dict.fromkeys(columns["note"]) if note]
    if form == "csv":
        if several:
            columns = {"table": [str(result.number)] * len(result.rows), **columns}
        print_columns(columns, form, header=not several or result.number == 1)
        return
    marks = {note: chr(ord("a") + i) for i, note in enumerate(notes)}
    columns["note"] = [marks.get(note, "") for note in columns["note"]]
    print_columns(columns, form, title=f"Table {result.number}: {result.title}")
    for note, mark in marks.items():
        print_note(f"{mark}: {note}")
