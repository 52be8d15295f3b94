"""The rotating cantilever beam on paper: reduced models and the exact continuum solution.

Needs numpy, scipy and sympy only; knows nothing of any multibody code. Importing it is cheap:
each name below is loaded when it is first used.
"""

from __future__ import annotations

from importlib import import_module

from .beam import Beam
from .spin_up import SpinUp, SteadyRotation

_LAZY: dict[str, str] = {}

__all__ = ["Beam", "SpinUp", "SteadyRotation"]


def __getattr__(name: str) -> object:
    if name not in _LAZY:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f".{_LAZY[name]}", __name__), name)


def __dir__() -> list[str]:
    return sorted(__all__)
