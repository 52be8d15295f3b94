"""Results on disk: netCDF that loads back equal, and CSV tables; whole or not at all."""

from __future__ import annotations

import errno
import io
import json
import math
import os
import secrets
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path
from typing import Any

import numpy as np

from ..lazily import xr
from .result_tables import tables_of, title

OUTCOMES = frozenset(
    {"divergence_speed", "error", "failure", "planar", "residual", "sentence"}
    | {"settings", "solution", "stable_covers", "verdict", "versions", "wall_time"}
)
"""Attributes of a result that follow from its inputs, and from where and when it was made."""


def save(run: xr.Dataset, path: str | os.PathLike[str]) -> Path:
    """Write a Dataset as netCDF (.nc) or CSV (.csv), by the ending of `path`, and return the path.

    netCDF is to be loaded: `load` gives back variables, coordinates, attributes, every bit of every
    number; text comes back as NumPy's text, tuples as lists. CSV is for spreadsheets: a header with
    names and units, then one row per sample, with every digit. Variables of other dimensions are
    another table: of a result with several, ``spin.csv`` is ``spin-q.csv``, ``spin-place.csv``
    ..., and the path of the first is returned. A frequency over speed and mode has a second table,
    ``-wide``, with a column per mode. ``spin.json`` lists the tables, the meaning of their columns,
    and the attributes: beam, motion, theory, versions.

    Raises
    ------
    ValueError
        If the ending is neither; if netCDF cannot keep something of it.
    OSError
        If the file cannot be written; what stood there before then still stands.

    Examples
    --------
    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> from analytic import Beam, SpinUp
    >>> from rotbeam_exu import load, save, simulate
    >>> motion = SpinUp(omega=2.0, ramp_time=1.0)
    >>> run = simulate(Beam.reference(), motion, elements=4, duration=2.0, step=5e-3)
    >>> with TemporaryDirectory() as folder:
    ...     again = load(save(run, Path(folder) / "run.nc"))
    >>> again.identical(run)
    True
    """
    target = Path(path)
    if target.suffix == ".csv":
        return save_tables(run, target)[0]
    if target.suffix != ".nc":
        raise ValueError(f"cannot write {target.name!r}: the ending must be .nc or .csv")
    try:
        content = _netcdf(run)
    except Exception as error:  # each layer has exceptions of its own for what it cannot keep
        raise ValueError(f"cannot write {target.name!r}: {error}") from error
    with whole_file(target) as partial:
        partial.write_bytes(content)
    return target


def _netcdf(data: xr.Dataset) -> bytes:
    arrays = [
        name for name, one in data.variables.items() if one.size > 1 and one.dtype.kind in "fiu"
    ]
    # HDF5 then refuses an array of which a bit has changed.
    checked = {name: {"fletcher32": True} for name in arrays}
    # In memory first: HDF5 does not survive a disk that fills while it writes. No lock: that of a
    # Dask client goes by a file's name.
    content = io.BytesIO()
    with xr.backends.H5NetCDFStore.open(content, mode="w", lock=False) as store:
        _plainly(data).dump_to_store(store, encoding=checked)
    return content.getvalue()


def _plainly(data: xr.Dataset) -> xr.Dataset:
    """Return a copy without another file's encoding, its attributes Python's numbers and text."""
    data = data.drop_encoding()
    data.attrs = {name: plain(one) for name, one in data.attrs.items()}
    for variable in data.variables.values():
        variable.attrs = {name: plain(one) for name, one in variable.attrs.items()}
    return data


def save_tables(data: xr.Dataset, path: Path) -> list[Path]:
    """Write a Dataset as the tables of `save` and their JSON file, all or none; return the paths.

    A single table has the name of `path`; of several, each adds its own.
    """
    tables = tables_of(data)
    if len(tables) == 1:
        paths = [path]
    else:
        paths = [path.with_name(f"{path.stem}-{name}.csv") for name in tables]
    contents = {
        target: rows.to_csv(index=False, lineterminator="\n", na_rep="nan")
        for target, rows in zip(paths, tables.values(), strict=True)
    }
    variables = [data[name] for name in data.variables]
    long_names = {title(one): one.attrs.get("long_name", "") for one in variables}
    about = {
        "tables": {
            target.name: {column: long_names.get(column, "") for column in rows}
            for target, rows in zip(paths, tables.values(), strict=True)
        },
        "attributes": {name: _readable(value) for name, value in data.attrs.items()},
        "grid": {name: _readable(values) for name, values in _grid(data).items()},
    }
    contents[path.with_suffix(".json")] = f"{_json(about)}\n"
    with ExitStack() as files:
        # In reverse: the last to be moved lists the tables.
        for target in reversed(contents):
            partial = files.enter_context(whole_file(target))
            partial.write_text(contents[target], encoding="utf-8", newline="\n")
    return list(contents)


def _json(value: object, margin: str = "\n") -> str:
    """Return JSON for a reader: each entry of a dict in a line of its own, lists in one."""
    if not isinstance(value, dict) or not value:
        return json.dumps(value, ensure_ascii=False, default=str)
    inner = f"{margin}  "
    entries = (f"{inner}{_json(str(k))}: {_json(one, inner)}" for k, one in value.items())
    return f"{{{','.join(entries)}{margin}}}"


def load(path: str | os.PathLike[str]) -> xr.Dataset:
    """Read a Dataset that `save` wrote as netCDF, attributes included.

    Raises
    ------
    ValueError
        If the file is a table, or cannot be read.
    FileNotFoundError
        If there is none.

    Examples
    --------
    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> import xarray as xr
    >>> from rotbeam_exu import load, save
    >>> data = xr.Dataset({"q": ("time", [0.0, 0.1])}, {"time": [0.0, 1.0]}, {"omega": 6.0})
    >>> with TemporaryDirectory() as folder:
    ...     print(load(save(data, Path(folder) / "mine.nc")).q.values)
    [0.  0.1]
    """
    source = Path(path)
    if not source.is_file():
        raise FileNotFoundError(f"there is no file {source}")
    if source.suffix == ".csv":
        raise ValueError(
            f"{source} is a table for reading: load the netCDF file instead, or read the table by "
            "pandas.read_csv(path)"
        )
    try:
        # Units such as "seconds" are for people, not for numpy's timedelta64.
        data = xr.load_dataset(
            io.BytesIO(source.read_bytes()), engine="h5netcdf", decode_times=False,
            decode_timedelta=False,
        )  # fmt: skip
    except Exception as error:  # HDF5, h5py and xarray raise what the damage happens to meet
        raise ValueError(
            f"{source} is not a netCDF file that can be read ({error}); write it again"
        ) from error
    return _plainly(data)


def differing_inputs(
    run: xr.Dataset | Mapping[str, object], path: str | os.PathLike[str]
) -> dict[str, tuple[object, object]]:
    """Return, by its name, each input in which a result, or its inputs alone, and a file differ.

    The file is netCDF, or the JSON of tables. Its values in both, None if missing; `file`, if it
    cannot be read; nothing if there is none. Inputs are the attributes but `OUTCOMES`, and the
    coordinates of every dimension but time: the grid of a sweep.
    """
    if not Path(path).exists():
        return {}
    try:
        attributes, grid = _kept(Path(path))
    except (OSError, ValueError, LookupError, TypeError) as error:
        return {"file": (None, str(error))}
    if isinstance(run, xr.Dataset):
        mine = _inputs({**run.attrs, **_grid(run)})
    else:
        # The grid of what is not computed yet is known where it is among the inputs.
        mine = _inputs(run)
        grid = {name: values for name, values in grid.items() if name in mine}
    theirs = _inputs({**attributes, **grid})
    return {
        name: (mine.get(name), theirs.get(name))
        for name in sorted(mine.keys() | theirs.keys())
        if mine.get(name) != theirs.get(name)
    }


def _kept(path: Path) -> tuple[Mapping[Any, object], Mapping[str, object]]:
    """Return the attributes and the grid of the result in a file."""
    if path.suffix == ".json":
        about = json.loads(path.read_text(encoding="utf-8"))
        return about["attributes"], about["grid"]
    there = load(path)
    return there.attrs, _grid(there)


def _grid(data: xr.Dataset) -> dict[str, xr.DataArray]:
    """Return the coordinates of every dimension but time."""
    return {str(name): data[name] for name in data.dims if name in data.coords and name != "time"}


def _inputs(values: Mapping[Any, object]) -> dict[str, object]:
    return {str(k): _readable(value) for k, value in values.items() if k not in OUTCOMES}


def _readable(value: object) -> object:
    """Return a value as a reader's JSON has it: JSON in a text is read, NaN and inf are text."""
    value = plain(value)
    if isinstance(value, str) and value[:1] in ("{", "["):
        with suppress(ValueError):
            value = json.loads(value)
    if isinstance(value, dict):
        return {str(name): _readable(one) for name, one in value.items()}
    if isinstance(value, list):
        return [_readable(one) for one in value]
    return str(value) if isinstance(value, float) and not math.isfinite(value) else value


def plain(value: object) -> object:
    """Return Python's numbers, text and lists of them for NumPy's and xarray's."""
    if isinstance(value, (np.ndarray, np.generic, xr.DataArray)):
        return np.asarray(value).tolist()
    if isinstance(value, (list, tuple)):
        return [plain(item) for item in value]
    if isinstance(value, dict):
        return {key: plain(item) for key, item in value.items()}
    return value


@contextmanager
def whole_file(target: Path) -> Iterator[Path]:
    """Give a path to write to; move it to `target` at the end, or remove it on any failure."""
    if target.is_dir():
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), str(target))
    partial = target.with_name(f".{target.stem}-{secrets.token_hex(4)}{target.suffix}")
    try:
        yield partial
        partial.replace(target)
    except OSError as error:
        if error.filename is None:  # as of a full disk
            error.filename = str(target)
        raise
    finally:
        partial.unlink(missing_ok=True)


def writable_folder(path: str | os.PathLike[str]) -> Path:
    """Make the folder if needed and prove that it can be written, before any long work."""
    folder = Path(path)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder) as file:
            file.write(bytes(4096))  # a full disk is willing to make a file, and no more
    except OSError as error:
        reason = error.strerror or error
        raise OSError(f"cannot write to the folder {folder}: {reason}; choose another") from error
    return folder
