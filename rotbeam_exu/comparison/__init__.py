"""Simulation and theory on the same axes: the data of the paper's figures, and the error budget.

Each function returns a Dataset; `rotbeam_exu.figures` draws it.
"""

from __future__ import annotations

from .backbones import figure_5, figure_14, finite_element_points, fitted_softening
from .budget import finite_element_budget, model_budget
from .exact_spin_up import exact_spin_up
from .orbits import figure_15
from .planar import growth_out_of_plane, modes_in_space, planar_stability, stability_limits
from .residual import residual
from .response import forced_response
from .runs import figure_3, figure_4
from .softening_map import softening_by_plane, softening_map
from .theory import figure_8, figure_9, figure_10, figure_11, figure_12, figure_13

__all__ = [
    "exact_spin_up",
    "figure_3",
    "figure_4",
    "figure_5",
    "figure_8",
    "figure_9",
    "figure_10",
    "figure_11",
    "figure_12",
    "figure_13",
    "figure_14",
    "figure_15",
    "finite_element_budget",
    "finite_element_points",
    "fitted_softening",
    "forced_response",
    "growth_out_of_plane",
    "model_budget",
    "modes_in_space",
    "planar_stability",
    "residual",
    "softening_by_plane",
    "softening_map",
    "stability_limits",
]
