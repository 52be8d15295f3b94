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
    from .campbell_diagram import Campbell, Crossing, campbell
    from .modes import LinearModes, linear_modes
    from .periodic import Backbone, BeamState, periodic_orbits
    from .transient import SpinUpResponse, spin_up_response

_LAZY: dict[str, str] = {
    "Backbone": "periodic",
    "BeamState": "periodic",
    "Campbell": "campbell_diagram",
    "Crossing": "campbell_diagram",
    "LinearModes": "modes",
    "SpinUpResponse": "transient",
    "campbell": "campbell_diagram",
    "linear_modes": "modes",
    "periodic_orbits": "periodic",
    "spin_up_response": "transient",
}

__all__ = [
    "Backbone",
    "Beam",
    "BeamState",
    "Campbell",
    "Crossing",
    "LinearModes",
    "SpinUp",
    "SpinUpResponse",
    "SteadyRotation",
    "campbell",
    "linear_modes",
    "periodic_orbits",
    "spin_up_response",
]


def __getattr__(name: str) -> object:
    if name not in _LAZY:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f".{_LAZY[name]}", __name__), name)


def __dir__() -> list[str]:
    return sorted(__all__)
