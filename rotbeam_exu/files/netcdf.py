"""A Dataset as the bytes of a netCDF file, sealed: damaged bytes never reach HDF5."""

from __future__ import annotations

import hashlib
import io
import re
from typing import Any

import numpy as np

from ..lazily import xr

# HDF5 knows where its data end and ignores what follows, so every reader of netCDF still can. Its
# own Fletcher-32 covers arrays of numbers only: of 200 bits flipped in attributes it missed 171.
_SEAL = b"\nrotbeam_exu sha256 %s\n"
_SEALED = re.compile(rb"\nrotbeam_exu sha256 ([0-9a-f]{64})\n\Z")


def encode(data: xr.Dataset) -> bytes:
    """Return the file that holds `data`, and the digest of all its bytes after them.

    Raises
    ------
    ValueError
        If netCDF cannot keep something of it, or would not give it back as it is.
    """
    given = _with_plain_attributes(data.drop_encoding())
    try:
        # In memory first: HDF5 does not survive a disk that fills while it writes.
        content = bytes(given.to_netcdf(engine="h5netcdf"))
        kept = decode(content)[0]
    except Exception as error:  # each layer has exceptions of its own for what it cannot keep
        raise ValueError(f"netCDF cannot keep it: {error}") from error
    lost = [name for name, value in given.attrs.items() if not same(value, kept.attrs.get(name))]
    lost += [
        name
        for name, one in given.data_vars.items()
        if not (_kind(one) == _kind(kept[name]) and one.identical(kept[name]))
    ]
    if lost or not kept.identical(given):
        raise ValueError(
            f"{', '.join(map(repr, lost)) or 'a name'} would come back different: give numbers, "
            "truth values or text, no list of one, and no attributes that encode them"
        )
    return content + _SEAL % hashlib.sha256(content).hexdigest().encode()


def decode(raw: bytes) -> tuple[xr.Dataset, bool]:
    """Return the Dataset in a file, and whether the file is sealed: whole, and of our writing.

    Raises
    ------
    ValueError
        If the seal is broken, or it is no netCDF.
    """
    seal = _SEALED.search(raw[-128:])
    if seal is not None:
        raw = raw[: -len(seal[0])]
        if hashlib.sha256(raw).hexdigest().encode() != seal[1]:
            raise ValueError("its digest says that it was damaged or changed after it was written")
    try:
        # Units such as "seconds" are for people, not for numpy's timedelta64.
        data = xr.load_dataset(
            io.BytesIO(raw), engine="h5netcdf", decode_times=False, decode_timedelta=False
        )
    except Exception as error:  # HDF5, h5py and xarray raise what the damage happens to meet.
        raise ValueError(str(error) or type(error).__name__) from error
    return _with_plain_attributes(data.drop_encoding()), seal is not None


def _with_plain_attributes(data: xr.Dataset) -> xr.Dataset:
    """Return a copy whose attributes are Python's numbers, text and lists."""
    data = data.copy()
    data.attrs = plain(data.attrs)
    for variable in data.variables.values():
        variable.attrs = plain(variable.attrs)
    return data


def _kind(array: Any) -> str:
    """Return NumPy's letter of the type, "U" for all text."""
    kind: str = array.dtype.kind
    text = kind in "OT" and all(isinstance(value, str) for value in array.to_numpy().flat)
    return "U" if text else kind


def plain(value: Any) -> Any:
    """Return Python's numbers, text and lists of them for NumPy's and xarray's."""
    if isinstance(value, (np.ndarray, np.generic, xr.DataArray)):
        return np.asarray(value).tolist()
    if isinstance(value, (list, tuple)):
        return [plain(item) for item in value]
    if isinstance(value, dict):
        return {key: plain(item) for key, item in value.items()}
    return value


def same(one: Any, other: Any) -> bool:
    """Whether two plain values are equal, NaN to itself."""
    if isinstance(one, list) and isinstance(other, list):
        return len(one) == len(other) and all(map(same, one, other))
    return bool(one == other or (one != one and other != other))  # noqa: PLR0124
