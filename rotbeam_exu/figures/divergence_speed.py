"""Critical speed of linear floating frames in a row, against their number."""

from __future__ import annotations

import matplotlib as mpl
import xarray as xr
from matplotlib.axes import Axes

from ..paper import BLUE, ORANGE
from .style import STYLE, column, ink, label, new_figure


def divergence_speed(data: xr.Dataset, ax: Axes | None = None) -> Axes:
    """Draw the divergence speed over the number of substructures, for either frame.

    Parameters
    ----------
    data : Dataset
        As made by `rotbeam_exu.fem.stability.divergence_speeds`.
    ax : Axes, optional
        Drawn on these; otherwise on a new figure.
    """
    if ax is None:
        _, ax = new_figure(column(), 2.6)
    assert ax is not None
    omega_0 = float(data.attrs["omega_0"])
    speeds = data["divergence_speed"]
    with mpl.rc_context(STYLE):
        ax.axhline(omega_0, color="0.6", lw=0.5)
        last = int(data["substructures"][-1])
        ax.annotate("$ω_0$", (last, omega_0), xytext=(0, 3), textcoords="offset points", ha="right")
        styles = {"tangent": (ink(BLUE), "o"), "pinned": (ink(ORANGE), "s")}
        for frame, (color, marker) in styles.items():
            ax.plot(
                data["substructures"], speeds.sel(frame=frame), color=color, marker=marker,
                markersize=3.0, label=f"{frame} frames",
            )  # fmt: skip
        ax.set(
            xscale="log", yscale="log", xlabel=label(data["substructures"]), ylabel=label(speeds)
        )
        ax.xaxis.set_major_locator(mpl.ticker.FixedLocator([float(n) for n in data.substructures]))
        ax.xaxis.set_major_formatter(mpl.ticker.ScalarFormatter())
        ax.xaxis.set_minor_locator(mpl.ticker.NullLocator())
        ax.legend()
    return ax
