"""Results on disk: netCDF that loads back equal, CSV to read anywhere; whole or not at all."""

from __future__ import annotations

import io
import os
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import h5netcdf
import numpy as np
import xarray as xr
from xarray.backends import H5NetCDFStore

OUTCOMES = frozenset({"critical_speed", "failure", "settings", "verdict", "versions", "wall_time"})
"""Attributes of a result that follow from its inputs, and from where and when it was made."""


def save(run: xr.Dataset, path: str | os.PathLike[str]) -> Path:
    """Write a Dataset as netCDF (.nc) or CSV (.csv), by the ending of `path`, and return the path.

    The CSV has one row per sample, units in the header, and holds no attributes.

    Raises
    ------
    ValueError
        If the ending is neither.
    OSError
        If the file cannot be written; what stood there before then still stands.
    """
    target = Path(path)
    if target.suffix not in (".nc", ".csv"):
        raise ValueError(f"cannot write {target.name!r}: the ending must be .nc or .csv")
    with whole_file(target) as partial:
        if target.suffix == ".nc":
            # In memory first: HDF5 does not survive a disk that fills while it writes.
            buffer = io.BytesIO()
            with h5netcdf.File(buffer, "w") as file:
                run.dump_to_store(H5NetCDFStore(file))
            partial.write_bytes(buffer.getbuffer())
        else:
            frame = run.to_dataframe().reset_index()
            units = {str(name): run[name].attrs.get("units", "") for name in frame.columns}
            frame = frame.rename(
                columns={n: f"{n} [{u}]" for n, u in units.items() if u not in ("", "1")}
            )
            frame.to_csv(partial, index=False)
    return target


def save_tables(data: xr.Dataset, path: Path) -> list[Path]:
    """Write a Dataset as CSV, one table for each set of dimensions, and return the paths.

    A single table takes the name of `path`; of several, each adds the name of its first variable.
    """
    groups: dict[tuple[str, ...], list[str]] = {}
    for name, variable in data.data_vars.items():
        groups.setdefault(tuple(map(str, variable.dims)), []).append(str(name))
    if len(groups) == 1:
        return [save(data, path)]
    return [
        save(data[names], path.with_name(f"{path.stem}-{names[0]}.csv"))
        for names in groups.values()
    ]


def load(path: str | os.PathLike[str]) -> xr.Dataset:
    """Read a Dataset that `save` wrote as netCDF, attributes included.

    Raises
    ------
    ValueError
        If the file is not one that can be read.
    FileNotFoundError
        If there is none.
    """
    source = Path(path)
    if not source.is_file():
        raise FileNotFoundError(f"there is no file {source}")
    try:
        return xr.load_dataset(source, engine="h5netcdf")
    except (OSError, ValueError, KeyError) as error:
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
        A file that `save` wrote, or none.

    Returns
    -------
    dict
        By name, the value in `run` and the one in the file, None where there is none, of every
        input that differs; `variables`, if the file has some that the result lacks; `file`, if it
        cannot be read. Empty if there is no file, or if it may be replaced without loss.
    """
    if not Path(path).exists():
        return {}
    try:
        there = load(path)
    except (OSError, ValueError) as error:
        return {"file": (None, str(error))}
    mine, theirs = _inputs(run), _inputs(there)
    differing = {
        name: (mine.get(name), theirs.get(name))
        for name in sorted(mine.keys() | theirs.keys())
        if not _same(mine.get(name), theirs.get(name))
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
    return {name: _plain(value) for name, value in run.items() if name not in OUTCOMES}


def _plain(value: Any) -> object:
    """Return numbers, text and lists of them for NumPy's and xarray's."""
    if isinstance(value, (list, tuple, np.ndarray, np.generic, xr.DataArray)):
        return np.asarray(value).tolist()
    return value


def _same(one: object, other: object) -> bool:
    """Whether two plain values are equal, NaN to itself."""
    if isinstance(one, list) and isinstance(other, list):
        return len(one) == len(other) and all(map(_same, one, other))
    return one == other or (one != one and other != other)  # noqa: PLR0124


@contextmanager
def whole_file(target: Path) -> Iterator[Path]:
    """Give a path to write to; move it to `target` at the end, or remove it on any failure."""
    handle, name = tempfile.mkstemp(
        prefix=f".{target.stem}-", suffix=target.suffix, dir=target.parent
    )
    os.close(handle)
    partial = Path(name)
    try:
        yield partial
        # mkstemp makes files private; results are meant to be shared as other files are.
        umask = os.umask(0)
        os.umask(umask)
        partial.chmod(0o666 & ~umask)
        partial.replace(target)
    finally:
        partial.unlink(missing_ok=True)


def writable_folder(path: str | os.PathLike[str]) -> Path:
    """Make the folder if needed and prove that it can be written, before any long work."""
    folder = Path(path)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            pass
    except OSError as error:
        reason = error.strerror or error
        raise OSError(f"cannot write to the folder {folder}: {reason}; choose another") from error
    return folder
