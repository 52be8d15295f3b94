"""Libraries that take longer to import than most commands run, imported on first use."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any


class Lazily:
    """A library, imported when one of its names is first asked for; safe in threads."""

    def __init__(self, name: str) -> None:
        self._name = name

    def __getattr__(self, name: str) -> Any:
        return getattr(import_module(self._name), name)


if TYPE_CHECKING:
    import h5netcdf
    import h5py  # type: ignore[import-untyped]
    import xarray as xr
else:
    h5netcdf, h5py, xr = map(Lazily, ("h5netcdf", "h5py", "xarray"))

__all__ = ["Lazily", "h5netcdf", "h5py", "xr"]
