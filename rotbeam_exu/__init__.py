"""The rotating cantilever beam in Exudyn: models, sweeps, comparison with the theory, figures.

Each name below is loaded when it is first used, so that importing the package stays cheap.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .linearization import growth_rate, natural_frequencies, steady_stretch
    from .oscillation import SteadyOscillation, steady_oscillation
    from .simulation import simulate
    from .stability import critical_speed
    from .storage import load, save
    from .sweeps import sweep
    from .verdict import SimulationError

__version__ = "0.1.0"

_LAZY = {
    "SimulationError": "verdict",
    "SteadyOscillation": "oscillation",
    "critical_speed": "stability",
    "growth_rate": "linearization",
    "load": "storage",
    "natural_frequencies": "linearization",
    "save": "storage",
    "simulate": "simulation",
    "steady_oscillation": "oscillation",
    "steady_stretch": "linearization",
    "sweep": "sweeps",
}

__all__ = [
    "SimulationError",
    "SteadyOscillation",
    "critical_speed",
    "growth_rate",
    "load",
    "natural_frequencies",
    "save",
    "simulate",
    "steady_oscillation",
    "steady_stretch",
    "sweep",
]


def __getattr__(name: str) -> object:
    if name not in _LAZY:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f".{_LAZY[name]}", __name__), name)
