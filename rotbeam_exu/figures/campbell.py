"""The Campbell diagram in the style of the figures."""

from __future__ import annotations

import matplotlib as mpl
from cycler import cycler
from matplotlib.axes import Axes

from analytic import Campbell

from .style import STYLE, column, cycle, new_figure


def campbell(diagram: Campbell, ax: Axes | None = None, *, highest: float | None = None) -> Axes:
    """Draw lag, flap and torsional frequencies over the speed, and the lines kω.

    Parameters
    ----------
    diagram : Campbell
        As made by `analytic.campbell`.
    ax : Axes, optional
        Drawn on these; otherwise on a new figure.
    highest : float, optional
        Frequency [rad/s] up to which is drawn; otherwise all are.
    """
    with mpl.rc_context({**STYLE, "axes.prop_cycle": cycler(color=cycle())}):
        ax = ax or new_figure(column(), 3.2, layout="constrained")[1]
        return diagram.plot(ax, highest=highest)
