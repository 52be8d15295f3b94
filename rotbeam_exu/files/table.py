"""A Dataset as a CSV table, for people and for other programs.

A table begins like this::

    # beam_length = 8.0
    time [s],q [m]
    0.0,0.0

Attributes are JSON. One row per point of the grid, in C order of the dimensions; what does not
depend on one of them repeats.
"""

from __future__ import annotations

import csv
import io
import json
from typing import Any

from ..lazily import xr
from .round_trip import plain


def encode(data: xr.Dataset) -> bytes:
    """Return the table that holds `data`, every digit of its numbers, and its attributes."""
    out = io.StringIO()
    for name, value in data.attrs.items():
        entry = f"{name} = {json.dumps(plain(value), ensure_ascii=False, default=str)}"
        out.writelines(f"# {line}\n" for line in entry.splitlines())
    columns = [data[name] for name in dict.fromkeys([*data.sizes, *data.variables])]
    csv.writer(out, lineterminator="\n").writerow(map(_title, columns))
    # Text in quotes, for those who skip whatever follows a "#".
    rows = csv.writer(out, lineterminator="\n", quoting=csv.QUOTE_NONNUMERIC)
    rows.writerows(zip(*(_spread(column.variable, data) for column in columns), strict=True))
    return out.getvalue().encode()


def _title(array: xr.DataArray) -> str:
    units = array.attrs.get("units", "")
    return str(array.name) if units in ("", "1") else f"{array.name} [{units}]"


def _spread(variable: xr.Variable, data: xr.Dataset) -> list[Any]:
    """Return the values at every point of the whole grid: numbers, truth values, or text."""
    whole: xr.Variable = variable.set_dims(dict(data.sizes))  # type: ignore[no-untyped-call]
    values = whole.transpose(*data.sizes).to_numpy().ravel()
    return list((values if values.dtype.kind in "fiub" else values.astype(str)).tolist())
