"""`rotbeam table N`: the paper's tables beside what the package derives."""

from __future__ import annotations

from typing import Annotated

from cyclopts import Parameter

from analytic import paper_table

from .options import Whole
from .output import Format, print_columns


def table(number: Whole, *, form: Annotated[Format, Parameter(name="--format")] = "table") -> None:
    """Print a table of the paper, as printed and as derived.

    Differences and errata are marked.

    Parameters
    ----------
    number
        1 to 5.
    form
        A table for the reader, or CSV.
    """
    result = paper_table(number)
    columns = {
        heading: [getattr(row, field) for row in result.rows]
        for heading, field in (
            ("quantity", "quantity"),
            ("printed", "printed"),
            ("derived", "derived"),
            ("difference", "difference"),
            ("note", "note"),
        )
    }
    print_columns(columns, form, title=f"Table {result.number}: {result.title}")
