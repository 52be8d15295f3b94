"""Loads of files: a table over time and span from a CSV, and those that name their kind."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from analytic import LoadTable
from analytic.description import from_description
from analytic.loads import Load

from .foreign import ForeignText
from .stations_file import columns_of

_COMPONENTS = {
    **{f"f{axis}": "N/m" for axis in "xyz"},
    **{f"m{axis}": "N m/m" for axis in "xyz"},
}
_UNITS = {"time": "s", "x": "m", **_COMPONENTS}


def load_table(path: Path, **more: Any) -> LoadTable:
    """Return the loads of a CSV file: columns time, x, fx, fy, fz, mx, my, mz, each with its unit.

    A row at every station of every instant, by time first; without time the table is over the span
    alone, and components that are missing are zero. Along the clamp, in the direction of rotation
    and normal to both, or with `following` by the section's axes 1, 2, 3.

    Parameters
    ----------
    path : Path
    **more
        Other fields of the `LoadTable`.

    Raises
    ------
    ValueError
        If a column is missing or unknown, or its unit, a cell is no number, or a row is not there.
    """
    columns = columns_of(path, _UNITS, "x [m],fx [N/m],fy [N/m],fz [N/m]")
    if "x" not in columns or not columns.keys() & _COMPONENTS.keys():
        raise ValueError(f"{path} lacks the column x, or any of {', '.join(_COMPONENTS)}")
    rows, none = columns["x"].size, np.zeros_like(columns["x"])
    parts = [
        np.stack([columns.get(f"{kind}{axis}", none) for axis in "xyz"], axis=-1) for kind in "fm"
    ]
    if "time" not in columns:
        return LoadTable(x=columns["x"], force=parts[0], moment=parts[1], **more)
    time, x = columns["time"], columns["x"]
    count = int(np.argmax(time != time[0])) or rows  # stations of the first instant
    if rows % count:
        raise ValueError(
            f"{path} has {rows} rows, and {count} stations at the first instant: give a row at "
            "each of these stations at every instant"
        )
    time, x = time.reshape(-1, count), x.reshape(-1, count)
    astray = np.flatnonzero(((time != time[:, :1]) | (x != x[0])).any(axis=1))
    if astray.size:
        raise ValueError(
            f"{path}: the rows of instant {astray[0] + 1} do not have the stations of the first, "
            f"or not one time: give the same {count} stations at every instant, in the same order"
        )
    force, moment = (one.reshape(-1, count, 3) for one in parts)
    return LoadTable(x=x[0], force=force, moment=moment, time=time[:, 0], **more)


def load_of(told: Mapping[str, Any], folder: Path) -> Load:
    """Return the load of a file's table; its `file` is in the folder or one within."""
    if told.get("kind") != LoadTable.__name__ or "file" not in told:
        return from_description(told, Load)
    more = {name: value for name, value in told.items() if name not in ("kind", "file")}
    path = ForeignText(folder / "the file").beside(str(told["file"]))
    try:
        return load_table(path, **more)
    except TypeError as error:
        raise ValueError(f"{path}: {error}") from error
