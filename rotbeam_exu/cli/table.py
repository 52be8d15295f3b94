"""`rotbeam table N`: the paper's tables compared with the values that the package derives."""

from __future__ import annotations

import analytic
from analytic.reduced.tables import PaperTable

from .options import numbered
from .output import print_columns, print_note


def table(number: str, /) -> None:
    """Print a table of the paper, as printed and as derived.

    Differences and errata are marked; the marks are explained below the table.

    Parameters
    ----------
    number
        1 to 5, or all.

    Examples
    --------
    $ rotbeam table 3
    $ rotbeam table all
    """
    for one in numbered("table", number, range(1, 6)):
        _print(analytic.paper_table(one))


def _print(result: PaperTable) -> None:
    names = ("quantity", "printed", "derived", "difference", "note")
    columns = {name: [getattr(row, name) for row in result.rows] for name in names}
    notes = [note for note in dict.fromkeys(columns["note"]) if note]
    marks = {note: chr(ord("a") + i) for i, note in enumerate(notes)}
    columns["note"] = [marks.get(note, "") for note in columns["note"]]
    print_columns(columns, title=f"Table {result.number}: {result.title}")
    for note, mark in marks.items():
        print_note(f"{mark}: {note}")
