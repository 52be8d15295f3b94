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
    from .backbone import AmplitudeNotReachedError, Backbone, BeamState
    from .campbell_diagram import Campbell, Crossing, campbell
    from .modes import LinearModes, linear_modes
    from .periodic import periodic_orbits
    from .reduced import ReducedModel, critical_speed, reduced_model
    from .softening import softening_speed
    from .tables import paper_table
    from .transient import SpinUpResponse, spin_up_response
    from .variants import VARIANTS, Variant

_LAZY: dict[str, str] = {
    "AmplitudeNotReachedError": "backbone",
    "Backbone": "backbone",
    "BeamState": "backbone",
    "Campbell": "campbell_diagram",
    "Crossing": "campbell_diagram",
    "LinearModes": "modes",
    "ReducedModel": "reduced",
    "SpinUpResponse": "transient",
    "VARIANTS": "variants",
    "Variant": "variants",
    "campbell": "campbell_diagram",
    "critical_speed": "reduced",
    "linear_modes": "modes",
    "paper_table": "tables",
    "periodic_orbits": "periodic",
    "reduced_model": "reduced",
    "softening_speed": "softening",
    "spin_up_response": "transient",
}

__all__ = [
    "VARIANTS",
    "AmplitudeNotReachedError",
    "Backbone",
    "Beam",
    "BeamState",
    "Campbell",
    "Crossing",
    "LinearModes",
    "ReducedModel",
    "SpinUp",
    "SpinUpResponse",
    "SteadyRotation",
    "Variant",
    "campbell",
    "critical_speed",
    "linear_modes",
    "paper_table",
    "periodic_orbits",
    "reduced_model",
    "softening_speed",
    "spin_up_response",
]


def __getattr__(name: str) -> object:
    if name not in _LAZY:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f".{_LAZY[name]}", __name__), name)


def __dir__() -> list[str]:
    return sorted(__all__)
