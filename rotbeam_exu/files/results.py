"""Results on disk: netCDF that loads back equal, and CSV for reading; whole or not at all."""

from __future__ import annotations

import csv
import io
import json
import os
import secrets
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from ..lazily import xr

OUTCOMES = frozenset(
    {"divergence_speed", "error", "failure", "residual", "sentence"}
    | {"settings", "solution", "verdict", "versions", "wall_time"}
)
"""Attributes of a result that follow from its inputs, and from where and when it was made."""


def save(run: xr.Dataset, path: str | os.PathLike[str]) -> Path:
    """Write a Dataset as netCDF (.nc) or CSV (.csv), by the ending of `path`, and return the path.

    netCDF is to be loaded: `load` gives back variables, coordinates, attributes, every bit of every
    number; text comes back as NumPy's text, tuples as lists. CSV is for reading: one row per
    sample, units in the header of the columns, and attributes in lines above that begin with "#".

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
    if target.suffix not in (".nc", ".csv"):
        raise ValueError(f"cannot write {target.name!r}: the ending must be .nc or .csv")
    try:
        content = _table(run) if target.suffix == ".csv" else _netcdf(run)
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
    data.attrs = plain(data.attrs)
    for variable in data.variables.values():
        variable.attrs = plain(variable.attrs)
    return data


def _table(data: xr.Dataset) -> bytes:
    """Return a CSV table with every digit, one row per point of the grid in C order of the sizes.

    What does not depend on a dimension repeats. Attributes are JSON in lines above.
    """
    out = io.StringIO()
    for name, value in data.attrs.items():
        entry = f"{name} = {json.dumps(plain(value), ensure_ascii=False, default=str)}"
        out.writelines(f"# {line}\n" for line in entry.splitlines())
    if data.sizes:
        rows = data.to_dataframe(dim_order=list(data.sizes)).reset_index()
    else:
        rows = data.expand_dims("row").to_dataframe()
    rows = rows.rename(columns={name: _title(data[name]) for name in rows})
    csv.writer(out, lineterminator="\n").writerow(rows.columns)
    # Text in quotes, for those who skip whatever follows a "#"; pandas would quote NaN as well.
    quoting = csv.writer(out, lineterminator="\n", quoting=csv.QUOTE_NONNUMERIC)
    quoting.writerows(rows.itertuples(index=False, name=None))
    return out.getvalue().encode()


def _title(array: xr.DataArray) -> str:
    units = array.attrs.get("units", "")
    return str(array.name) if units in ("", "1") else f"{array.name} [{units}]"


def parts(data: xr.Dataset) -> dict[str, xr.Dataset]:
    """Return the part of each set of dimensions, by the name of its first variable."""
    groups: dict[tuple[str, ...], list[str]] = {}
    for name, variable in data.data_vars.items():
        groups.setdefault(tuple(map(str, variable.dims)), []).append(str(name))
    return {names[0]: data[names] for names in groups.values()}


def save_tables(data: xr.Dataset, path: Path) -> list[Path]:
    """Write a Dataset as CSV, one table for each set of dimensions, and return the paths.

    A single table takes the name of `path`; of several, each adds the name of its first variable.
    """
    tables = parts(data)
    if len(tables) == 1:
        return [save(data, path)]
    return [save(part, path.with_name(f"{path.stem}-{name}.csv")) for name, part in tables.items()]


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
            "pandas.read_csv(path, comment='#')"
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

    Its values in both, None if missing; `file`, if it cannot be read; nothing if there is none.
    Inputs are the attributes but `OUTCOMES`, and the coordinates of every dimension but time: the
    grid of a sweep.
    """
    if not Path(path).exists():
        return {}
    try:
        there = load(path)
    except (OSError, ValueError) as error:
        return {"file": (None, str(error))}
    mine, theirs = _inputs(run), _inputs(there)
    if not isinstance(run, xr.Dataset):
        # The grid of what is not computed yet is known where it is among the inputs.
        theirs = {name: theirs[name] for name in theirs if name in mine or name not in there.coords}
    return {
        name: (mine.get(name), theirs.get(name))
        for name in sorted(mine.keys() | theirs.keys())
        if not _same(mine.get(name), theirs.get(name))
    }


def _inputs(run: xr.Dataset | Mapping[str, object]) -> dict[str, object]:
    if isinstance(run, xr.Dataset):
        grid = {name: run[name] for name in run.dims if name in run.coords and name != "time"}
        run = {**{str(k): v for k, v in run.attrs.items()}, **{str(k): v for k, v in grid.items()}}
    return {name: plain(value) for name, value in run.items() if name not in OUTCOMES}


def plain(value: Any) -> Any:
    """Return Python's numbers, text and lists of them for NumPy's and xarray's."""
    if isinstance(value, (np.ndarray, np.generic, xr.DataArray)):
        return np.asarray(value).tolist()
    if isinstance(value, (list, tuple)):
        return [plain(item) for item in value]
    if isinstance(value, dict):
        return {key: plain(item) for key, item in value.items()}
    return value


def _same(one: Any, other: Any) -> bool:
    """Whether two plain values are equal, NaN to itself."""
    if isinstance(one, list) and isinstance(other, list):
        return len(one) == len(other) and all(map(_same, one, other))
    return bool(one == other or (one != one and other != other))  # noqa: PLR0124


@contextmanager
def whole_file(target: Path) -> Iterator[Path]:
    """Give a path to write to; move it to `target` at the end, or remove it on any failure."""
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
