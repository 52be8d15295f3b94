"""The figures: each takes data and `ax=`, returns Axes and shows nothing.

The only place that knows matplotlib.
"""

from __future__ import annotations

from .animation import animate, save_animation
from .spin_up import spin_up
from .style import save_figure

__all__ = ["animate", "save_animation", "save_figure", "spin_up"]
