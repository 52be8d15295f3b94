"""Parts of scipy, which takes longer to import than most commands run, imported on first use."""

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
    from scipy import (
        integrate,
        interpolate,
        linalg,
        ndimage,
        optimize,
        signal,
        sparse,
        spatial,
        special,
        stats,
    )
else:
    integrate, interpolate, linalg, ndimage, optimize, signal, sparse, spatial, special, stats = (
        Lazily(f"scipy.{name}")
        for name in (
            "integrate", "interpolate", "linalg", "ndimage", "optimize", "signal", "sparse",
            "spatial", "special", "stats",
        )
    )  # fmt: skip

__all__ = [
    "Lazily", "integrate", "interpolate", "linalg", "ndimage", "optimize", "signal", "sparse",
    "spatial", "special", "stats",
]  # fmt: skip
