"""The figures: each takes data and `ax=`, returns Axes and shows nothing.

The only place that knows matplotlib. The data comes from the function of the same name in
`rotbeam_exu.comparison`; `spin_up` takes a run, `campbell` an `analytic.Campbell`,
`divergence_speed` what `rotbeam_exu.fem.stability.divergence_speeds` returns.
"""

from __future__ import annotations

from .animation import animate, save_animation
from .backbones import figure_5, figure_14
from .campbell import campbell
from .descriptions import caption
from .divergence_speed import divergence_speed
from .orbits import figure_15
from .planar import growth_out_of_plane, planar_stability, stability_limits
from .residual import residual
from .response import forced_response
from .runs import figure_3, figure_4
from .softening_map import softening_by_plane, softening_map
from .spin_up import spin_up
from .style import STYLE, STYLES, Style, save_figure, style
from .theory import figure_8, figure_9, figure_10, figure_11, figure_12, figure_13

__all__ = [
    "STYLE",
    "STYLES",
    "Style",
    "animate",
    "campbell",
    "caption",
    "divergence_speed",
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
    "forced_response",
    "growth_out_of_plane",
    "planar_stability",
    "residual",
    "save_animation",
    "save_figure",
    "softening_by_plane",
    "softening_map",
    "spin_up",
    "stability_limits",
    "style",
]
