"""The rotating cantilever beam on paper: reduced models and the exact continuum solution.

Needs numpy, scipy and sympy only; knows nothing of any multibody code. Importing it is cheap:
each name below is loaded when it is first used.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

from .beam import Beam
from .spin_up import SpinUp, SteadyRotation

if TYPE_CHECKING:
    from .reduced import ReducedModel, critical_speed, reduced_model
    from .softening import softening_speed
    from .tables import paper_table
    from .variants import VARIANTS, Variant

_LAZY: dict[str, str] = {
    "VARIANTS": "variants",
    "ReducedModel": "reduced",
    "Variant": "variants",
    "critical_speed": "reduced",
    "paper_table": "tables",
    "reduced_model": "reduced",
    "softening_speed": "softening",
}

__all__ = [
    "VARIANTS",
    "Beam",
    "ReducedModel",
    "SpinUp",
    "SteadyRotation",
    "Variant",
    "critical_speed",
    "paper_table",
    "reduced_model",
    "softening_speed",
]


def __getattr__(name: str) -> object:
    if name not in _LAZY:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f".{_LAZY[name]}", __name__), name)


def __dir__() -> list[str]:
    return sorted(__all__)
