"""Libraries that take longer to import than most commands run, imported on first use."""

from __future__ import annotations

from typing import TYPE_CHECKING

from analytic.lazily import Lazily

if TYPE_CHECKING:
    import h5py
    import xarray as xr
else:
    h5py, xr = map(Lazily, ("h5py", "xarray"))

__all__ = ["h5py", "xr"]
