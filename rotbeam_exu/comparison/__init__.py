"""Simulation and theory on the same axes: the data of the paper's figures, and error budgets.

Each function returns a Dataset; `rotbeam_exu.figures` draws it.
"""

from __future__ import annotations

from .backbones import figure_5, figure_14
from .refinement import refinement
from .results import growth_out_of_plane, residual, softening_map
from .runs import figure_3, figure_4, figure_15
from .theory import figure_8, figure_9, figure_10, figure_11, figure_12, figure_13, model_budget

__all__ = [
    "figure_3", "figure_4", "figure_5", "figure_8", "figure_9", "figure_10", "figure_11",
    "figure_12", "figure_13", "figure_14", "figure_15",
    "growth_out_of_plane", "model_budget", "refinement", "residual", "softening_map",
]  # fmt: skip
