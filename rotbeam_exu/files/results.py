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

from analytic.warning import warn

from ..lazily import xr
from . import netcdf
from .netcdf import plain, same

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
        If the ending is neither; if something would not come back from netCDF as it is.
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
        content = _table(run) if target.suffix == ".csv" else netcdf.encode(run)
    except (LookupError, TypeError, ValueError) as error:
        raise ValueError(f"cannot write {target.name!r}: {error}") from error
    with whole_file(target) as partial:
        partial.write_bytes(content)
    return target


def _table(data: xr.Dataset) -> bytes:
    """Return a CSV table with every digit, one row per point of the grid in C order of the sizes.

    What does not depend on a dimension repeats. Attributes are JSON in lines above.
    """
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
        If the file is a table, cannot be read, or was damaged or changed since it was written.
    FileNotFoundError
        If there is none.

    Warns
    -----
    RotbeamWarning
        If the file was not written by `save`, so that nothing tells whether it is damaged.

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
    run, sealed = read(path)
    if not sealed:
        warn(
            f"{path} was not written by `save`, or by an older version, so that damage would not "
            "show; check its numbers, and save what was loaded"
        )
    return run


def read(path: str | os.PathLike[str]) -> tuple[xr.Dataset, bool]:
    """Return what `load` does, and instead of a warning whether a digest vouches for it."""
    source = Path(path)
    if not source.is_file():
        raise FileNotFoundError(f"there is no file {source}")
    if source.suffix == ".csv":
        raise ValueError(
            f"{source} is a table for reading: load the netCDF file instead, or read the table by "
            "pandas.read_csv(path, comment='#')"
        )
    try:
        return netcdf.decode(source.read_bytes())
    except (LookupError, TypeError, ValueError) as error:
        raise ValueError(
            f"{source} is not a netCDF file that can be read ({error}); write it again"
        ) from error


def differing_inputs(
    run: xr.Dataset | Mapping[str, object], path: str | os.PathLike[str]
) -> dict[str, tuple[object, object]]:
    """Tell whether the file at `path` holds the same inputs: what to ask before replacing it.

    Inputs are the attributes but `OUTCOMES`, and the coordinates of every dimension but time: the
    grid of a sweep.

    Parameters
    ----------
    run : Dataset or mapping
        A result, or only its inputs by name, where it is not computed yet.
    path : path
        A file that `save` wrote, or none. For a table the netCDF file of its name answers.

    Returns
    -------
    dict
        By name of each input that differs, its values in `run` and in the file, None if missing.
        `variables`, if the file has some that the result lacks; `file`, if it cannot be read. Empty
        if there is no file, or if it may be replaced without loss.
    """
    target = Path(path)
    kept = target.with_suffix(".nc") if target.suffix == ".csv" else target
    if not target.exists() and not kept.exists():
        return {}
    try:
        there, _ = read(kept)
    except (OSError, ValueError) as error:
        return {"file": (None, str(error))}
    mine, theirs = _inputs(run), _inputs(there)
    if not isinstance(run, xr.Dataset):
        # The grid of what is not computed yet is known where it is among the inputs.
        theirs = {name: theirs[name] for name in theirs if name in mine or name not in there.coords}
    differing = {
        name: (mine.get(name), theirs.get(name))
        for name in sorted(mine.keys() | theirs.keys())
        if not same(mine.get(name), theirs.get(name))
    }
    if isinstance(run, xr.Dataset) and not there.variables.keys() <= run.variables.keys():
        differing["variables"] = (
            sorted(map(str, run.variables)),
            sorted(map(str, there.variables)),
        )
    return differing


def _inputs(run: xr.Dataset | Mapping[str, object]) -> dict[str, object]:
    if isinstance(run, xr.Dataset):
        grid = {name: run[name] for name in run.dims if name in run.coords and name != "time"}
        run = {**{str(k): v for k, v in run.attrs.items()}, **{str(k): v for k, v in grid.items()}}
    return {name: plain(value) for name, value in run.items() if name not in OUTCOMES}


@contextmanager
def whole_file(target: Path) -> Iterator[Path]:
    """Give a path to write to; move it to `target` at the end, or remove it on any failure."""
    # Named before it is made: a signal in between would leave what nobody knows.
    partial = target.with_name(f".{target.stem}-{secrets.token_hex(4)}{target.suffix}")
    try:
        partial.touch(exist_ok=False)
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
