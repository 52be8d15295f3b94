"""A Dataset as a CSV table for everyone, with header lines from which it is read back.

A table begins like this::

    # rotbeam_exu table, sha256 of all below: 5d41...
    # beam_length = 8.0
    # dimension "time": 3001
    # column "time": {"kind": "coordinate", "dims": ["time"], "dtype": "float64", "attrs": {...}}
    time [s],q [m]
    0.0,0.0

Values in the header are JSON. One row per point of the grid, in C order of the dimensions; what
does not depend on one of them repeats.
"""

from __future__ import annotations

import csv
import hashlib
import io
import json
import re
from collections.abc import Callable
from itertools import chain
from typing import Any

import numpy as np

from ..lazily import xr
from .round_trip import attributes, is_text, plain

_MARK = "# rotbeam_exu table, sha256 of all below: "
_STRUCTURE = re.compile(r'# (dimension|column) ("(?:[^"\\]|\\.)*"): (.*)')
_ATTRIBUTE = re.compile(r"# (.+?) = (.*)")

_READERS: dict[str, Callable[[str], Any]] = {
    "f": float,
    "i": int,
    "u": int,
    "b": "True".__eq__,
    "U": str,
}


def encode(data: xr.Dataset) -> bytes:
    """Return the table that holds `data`; its first line is the digest of the rest.

    Raises
    ------
    ValueError
        If an attribute is not JSON, or a variable neither numbers, truth values nor text.
    """
    for owner, value in attributes(data):
        try:
            _json(value)
        except (TypeError, ValueError) as error:
            raise ValueError(f"{owner} is {value!r}, which JSON cannot keep") from error
    out = io.StringIO()
    for name, value in data.attrs.items():
        line = f"# {name} = {_json(value)}"
        found = _ATTRIBUTE.fullmatch(line)
        if found is None or found[1] != name or _STRUCTURE.fullmatch(line):
            raise ValueError(
                f"the attribute {name!r} has a name that no header can hold: rename it"
            )
        out.write(f"{line}\n")
    for dimension, size in data.sizes.items():
        out.write(f"# dimension {_json(dimension)}: {size}\n")
    columns: dict[str, list[Any]] = {
        str(dimension): _spread(xr.Variable(dimension, np.arange(size)), data)
        for dimension, size in data.sizes.items()
    }
    for name, variable in data.variables.items():
        dtype = np.dtype(str) if is_text(variable.to_numpy()) else variable.dtype
        if dtype.kind not in _READERS:
            raise ValueError(f"{name!r} is of type {dtype}: give numbers, truth values or text")
        described = {
            "kind": "coordinate" if name in data.coords else "variable",
            "dims": variable.dims,
            "dtype": dtype.kind if dtype.kind == "U" else dtype.name,
            "attrs": dict(variable.attrs),
        }
        out.write(f"# column {_json(name)}: {_json(described)}\n")
        columns[str(name)] = _spread(variable, data)
    titles = [_title(n, data[n].attrs if n in data.variables else {}) for n in columns]
    csv.writer(out, lineterminator="\n").writerow(titles)
    # Text in quotes, for those who skip whatever follows a "#".
    rows = csv.writer(out, lineterminator="\n", quoting=csv.QUOTE_NONNUMERIC)
    rows.writerows(zip(*columns.values(), strict=True))
    content = out.getvalue().encode()
    return f"{_MARK}{hashlib.sha256(content).hexdigest()}\n".encode() + content


def decode(raw: bytes) -> xr.Dataset:
    """Return the Dataset in a table that `encode` wrote.

    Raises
    ------
    ValueError
        If it is another table, or was changed.
    """
    mark, _, content = raw.partition(b"\n")
    if not mark.startswith(_MARK.encode()):
        raise ValueError("it does not begin with the line of a table that `save` wrote")
    if mark.decode(errors="replace") != _MARK + hashlib.sha256(content).hexdigest():
        raise ValueError("its digest says that it was damaged or changed after it was written")
    attrs: dict[str, Any] = {}
    sizes: dict[str, int] = {}
    described: dict[str, dict[str, Any]] = {}
    lines = io.StringIO(content.decode(), newline="\n")
    while (line := lines.readline()).startswith("# "):
        if structure := _STRUCTURE.fullmatch(line.rstrip("\n")):
            kind, name, value = structure[1], *map(json.loads, structure.groups()[1:])
            (sizes if kind == "dimension" else described)[name] = value
        elif attribute := _ATTRIBUTE.fullmatch(line.rstrip("\n")):
            attrs[attribute[1]] = json.loads(attribute[2])
        else:
            raise ValueError(f"no header line: {line!r}")
    rows = csv.reader(chain([line], lines))
    titles = next(rows)
    cells = list(zip(*rows, strict=True)) or [()] * len(titles)
    variables: dict[str, dict[str, xr.Variable]] = {"coordinate": {}, "variable": {}}
    for name, column in described.items():
        texts = cells[titles.index(_title(name, column["attrs"]))]
        variables[column["kind"]][name] = _gathered(texts, sizes, column)
    return xr.Dataset(variables["variable"], variables["coordinate"], attrs)


def _title(name: str, attrs: dict[str, Any]) -> str:
    units = attrs.get("units", "")
    return name if units in ("", "1") else f"{name} [{units}]"


def _json(value: object) -> str:
    return json.dumps(plain(value), ensure_ascii=False)


def _spread(variable: xr.Variable, data: xr.Dataset) -> list[Any]:
    """Return the values at every point of the whole grid."""
    whole: xr.Variable = variable.set_dims(dict(data.sizes))  # type: ignore[no-untyped-call]
    return list(whole.transpose(*data.sizes).to_numpy().ravel().tolist())


def _gathered(texts: tuple[str, ...], sizes: dict[str, int], column: dict[str, Any]) -> xr.Variable:
    """Return a variable from its cells, one for each point of the whole grid."""
    dtype = np.dtype(column["dtype"])
    read = _READERS[dtype.kind]
    values = np.array([read(text) for text in texts], dtype=dtype).reshape(tuple(sizes.values()))
    here = tuple(slice(None) if name in column["dims"] else 0 for name in sizes)
    kept = [name for name in sizes if name in column["dims"]]
    return xr.Variable(kept, values[here], column["attrs"]).transpose(*column["dims"])
