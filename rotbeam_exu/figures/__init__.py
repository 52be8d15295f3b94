"""The figures: each takes data and `ax=`, by default of a new figure, returns Axes, shows nothing.

The only place that knows matplotlib. The data comes from the function of the same name in
`rotbeam_exu.comparison`; `spin_up` takes a run, `campbell` a `Campbell`,
`forced_response` and `planar_stability` what `rotbeam_exu.dataset_of` makes of theirs.
"""

from __future__ import annotations

from .animation import animate, save_animation
from .backbones import figure_5, figure_14
from .blade import blade_sections, mode_shapes, root_over_turn, steady_tip, strain_along
from .paper_figure import PAPER_FIGURES, caption
from .results import (
    campbell,
    forced_response,
    growth_out_of_plane,
    over_time,
    planar_stability,
    residual,
    softening_map,
    tornado,
)
from .runs import figure_3, figure_4, figure_15, spin_up
from .style import STYLE, save_figure, style
from .theory import figure_8, figure_9, figure_10, figure_11, figure_12, figure_13

__all__ = [
    "PAPER_FIGURES", "STYLE", "animate", "blade_sections", "campbell", "caption", "figure_3",
    "figure_4", "figure_5", "figure_8", "figure_9", "figure_10", "figure_11", "figure_12",
    "figure_13", "figure_14", "figure_15", "forced_response", "growth_out_of_plane", "mode_shapes",
    "over_time", "planar_stability", "residual", "root_over_turn", "save_animation", "save_figure",
    "softening_map", "spin_up", "steady_tip", "strain_along", "style", "tornado",
]  # fmt: skip
