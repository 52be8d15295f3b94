"""Results on disk: netCDF that loads back equal, CSV to read anywhere; whole or not at all."""

from __future__ import annotations

import io
import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import h5netcdf
import xarray as xr
from xarray.backends import H5NetCDFStore


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
