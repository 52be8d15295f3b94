"""The figures: each takes data and `ax=`, returns Axes and shows nothing.

The only place that knows matplotlib.
"""

from __future__ import annotations

from .spin_up import spin_up
from .style import save_figure

__all__ = ["save_figure", "spin_up"]
