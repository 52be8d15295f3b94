"""A Dataset as the bytes of a netCDF file, sealed: what is damaged never reaches HDF5."""

from __future__ import annotations

import hashlib
import io
import re
import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any

from ..lazily import h5netcdf, h5py, xr
from .round_trip import attributes, plain

# HDF5 knows where its data end and ignores what follows, so every reader of netCDF still can. Its
# own Fletcher-32 covers arrays of numbers only: of 200 bits flipped in attributes it missed 171.
_SEAL = b"\nrotbeam_exu sha256 %s\n"
_SEALED = re.compile(rb"\nrotbeam_exu sha256 ([0-9a-f]{64})\n\Z")


def encode(data: xr.Dataset) -> bytes:
    """Return the file that holds `data`, and the digest of all its bytes after them.

    Raises
    ------
    ValueError
        If an attribute is none that netCDF has: a number, text, or a list of either.
    """
    for name, value in attributes(data):
        if not _storable(plain(value)):
            raise ValueError(
                f"{name} is {value!r}, which netCDF cannot keep: give a number, text, or a list "
                "of several numbers or texts"
            )
    # In memory first: HDF5 does not survive a disk that fills while it writes.
    buffer = io.BytesIO()
    try:
        with _interrupts_held(), h5netcdf.File(buffer, "w") as file:
            # What another file's encoding said, a fill value for one, is not for this one.
            data.drop_encoding().dump_to_store(xr.backends.H5NetCDFStore(file))
    except Exception as error:  # each layer has exceptions of its own for what it cannot keep
        raise ValueError(str(error)) from error
    content = buffer.getvalue()
    return content + _SEAL % hashlib.sha256(content).hexdigest().encode()


@contextmanager
def _interrupts_held() -> Iterator[None]:
    """Let Ctrl-C and the like wait: h5netcdf, interrupted, leaves a file that cannot be closed."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    held: list[tuple[int, FrameType | None]] = []
    numbers = [
        signal.SIGINT,
        signal.SIGTERM,
        *([signal.SIGHUP] if hasattr(signal, "SIGHUP") else []),
    ]
    found = {number: signal.getsignal(number) for number in numbers}
    former = {number: handler for number, handler in found.items() if callable(handler)}
    for number in former:
        signal.signal(number, lambda *arguments: held.append(arguments))
    try:
        yield
    finally:
        for number, handler in former.items():
            signal.signal(number, handler)
    for arguments in held[-1:]:
        former[signal.Signals(arguments[0])](*arguments)


def decode(raw: bytes) -> tuple[xr.Dataset, bool]:
    """Return the Dataset in a file, and whether the file is sealed: whole, and of our writing.

    Raises
    ------
    ValueError
        If the seal is broken, the file names others to read, or it is no netCDF.
    """
    seal = _SEALED.search(raw[-128:])
    if seal is not None:
        raw = raw[: -len(seal[0])]
        if hashlib.sha256(raw).hexdigest().encode() != seal[1]:
            raise ValueError("its digest says that it was damaged or changed after it was written")
    try:
        with h5py.File(io.BytesIO(raw), "r") as file:
            _refuse_other_files(file)
        # Units such as "seconds" are for people, not for numpy's timedelta64.
        data = xr.load_dataset(
            io.BytesIO(raw), engine="h5netcdf", decode_times=False, decode_timedelta=False
        )
    except Exception as error:  # HDF5, h5py and xarray raise what the damage happens to meet.
        raise ValueError(str(error) or type(error).__name__) from error
    for attrs in (data.attrs, *(variable.attrs for variable in data.variables.values())):
        attrs.update({name: plain(value) for name, value in attrs.items()})
    return data.drop_encoding(), seal is not None


def _storable(value: object) -> bool:
    if isinstance(value, list):
        return len(value) > 1 and all(
            type(item) is type(value[0]) and not isinstance(item, list) and _storable(item)
            for item in value
        )
    if isinstance(value, str):
        # Neither NUL nor half a surrogate pair: HDF5's text is UTF-8 that ends with NUL.
        return "\0" not in value and value.encode(errors="ignore").decode() == value
    if isinstance(value, bool):
        return False
    if isinstance(value, int):
        return -(2**63) <= value < 2**63
    return isinstance(value, float)


def _refuse_other_files(file: Any) -> None:
    """Refuse external links and storage, and virtual datasets, which read whatever they name."""
    waiting, seen = [file["/"]], set()
    while waiting:
        group = waiting.pop()
        for name in group:
            link = group.get(name, getlink=True)
            if isinstance(link, h5py.SoftLink):
                continue  # to a place in this file, which is met by itself
            item = group[name] if isinstance(link, h5py.HardLink) else None
            if item is None or (
                isinstance(item, h5py.Dataset) and (item.external or item.is_virtual)
            ):
                raise ValueError(f"{group.name.rstrip('/')}/{name} names another file to read from")
            address = h5py.h5o.get_info(item.id).addr
            if isinstance(item, h5py.Group) and address not in seen:
                seen.add(address)
                waiting.append(item)
