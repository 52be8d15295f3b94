"""A Dataset as the bytes of a netCDF file, sealed: damaged bytes never reach HDF5."""

from __future__ import annotations

import hashlib
import io
import re
from collections.abc import Iterator
from typing import Any

import numpy as np

from ..lazily import h5netcdf, xr

# HDF5 knows where its data end and ignores what follows, so every reader of netCDF still can. Its
# own Fletcher-32 covers arrays of numbers only: of 200 bits flipped in attributes it missed 171.
_SEAL = b"\nrotbeam_exu sha256 %s\n"
_SEALED = re.compile(rb"\nrotbeam_exu sha256 ([0-9a-f]{64})\n\Z")


def encode(data: xr.Dataset) -> bytes:
    """Return the file that holds `data`, and the digest of all its bytes after them.

    Raises
    ------
    ValueError
        If an attribute is none that netCDF has: a number, text, or a list of either; or if the file
        would not give something back as it is.
    """
    for name, value in _attributes(data):
        if not _storable(plain(value)):
            raise ValueError(
                f"{name} is {value!r}, which netCDF cannot keep: give a number, text, or a list "
                "of several numbers or texts"
            )
    # In memory first: HDF5 does not survive a disk that fills while it writes.
    buffer = io.BytesIO()
    try:
        with h5netcdf.File(buffer, "w") as file:
            # What another file's encoding said, a fill value for one, is not for this one.
            data.drop_encoding().dump_to_store(xr.backends.H5NetCDFStore(file))
    except Exception as error:  # each layer has exceptions of its own for what it cannot keep
        raise ValueError(str(error)) from error
    content = buffer.getvalue()
    lost = _lost(data, decode(content)[0])
    if lost:
        raise ValueError(lost)
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
    for attrs in (data.attrs, *(variable.attrs for variable in data.variables.values())):
        attrs.update({name: plain(value) for name, value in attrs.items()})
    return data.drop_encoding(), seal is not None


def _storable(value: Any) -> bool:
    items = value if isinstance(value, list) and len(value) > 1 else [value]
    kinds = set(map(type, items))
    if kinds == {str}:
        # Neither NUL nor half a surrogate pair: HDF5's text is UTF-8 that ends with NUL.
        return all("\0" not in x and x.encode(errors="ignore").decode() == x for x in items)
    return kinds == {float} or (kinds == {int} and all(-(2**63) <= x < 2**63 for x in items))


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


def _attributes(data: xr.Dataset) -> Iterator[tuple[str, Any]]:
    """Every attribute with its name in words, the variables' after the Dataset's own."""
    for name, value in data.attrs.items():
        yield f"the attribute {name!r}", value
    for variable, array in data.variables.items():
        for name, value in array.attrs.items():
            yield f"the attribute {name!r} of {variable!r}", value


def _lost(given: xr.Dataset, kept: xr.Dataset) -> str | None:
    """Return in words the first thing of `given` that `kept` does not hold, or None.

    Text is text in whatever dtype, and lists, tuples and arrays are the same attribute.
    """
    theirs = dict(_attributes(kept))
    for name, value in _attributes(given):
        if name not in theirs or not same(plain(value), plain(theirs[name])):
            return f"{name} would be lost or changed: rename it"
    for variable, array in given.variables.items():
        back = kept.variables.get(variable)
        if back is None or (variable in given.coords) != (variable in kept.coords):
            return f"{variable!r} would be lost: rename it"
        if _kind(array) != _kind(back) or not array.equals(back):  # type: ignore[no-untyped-call]
            return (
                f"{variable!r}, of type {array.dtype}, would come back different: "
                "give numbers, truth values or text, and no attributes that encode them"
            )
    return None


def _kind(array: xr.Variable) -> str:
    """Return NumPy's letter of the type, "U" for all text."""
    kind = array.dtype.kind
    text = kind in "OT" and all(isinstance(value, str) for value in array.to_numpy().flat)
    return "U" if text else kind
