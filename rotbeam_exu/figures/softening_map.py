"""The map of λ_ω over hub radius and speed, and λ_ω in lag and in flap."""

from __future__ import annotations

import matplotlib as mpl
import numpy as np
import xarray as xr
from matplotlib.axes import Axes

from ..paper import BLUE, RED
from .style import STYLE, colormap, column, ink, label, new_figure


def softening_map(data: xr.Dataset, ax: Axes | None = None) -> Axes:
    """Draw λ_ω, its zero line, and the lines on which ω_2/ω_n is 3, 4 and 5.

    Parameters
    ----------
    data : Dataset
        As made by `rotbeam_exu.comparison.softening_map`.
    ax : Axes, optional
        Drawn on these; otherwise on a new figure.
    """
    ax = ax or new_figure(column(), 3.0)[1]
    assert ax is not None
    x, y = data["hub_ratio"].to_numpy(), data["w_bar"].to_numpy()
    values, ratio = data["lambda_omega"].to_numpy().T, data["ratio"].to_numpy().T
    # Half as much again as most of the map has: lines stay legible on its darkest colors.
    limit = float(np.round(1.5 * np.quantile(np.abs(values), 0.95), 2))
    with mpl.rc_context(STYLE):
        filled = ax.contourf(
            x,
            y,
            values,
            levels=np.linspace(-limit, limit, 17),
            cmap=colormap("RdBu_r"),
            extend="both",
        )
        colorbar = ax.figure.colorbar(filled, ax=ax, ticks=np.linspace(-limit, limit, 5))
        colorbar.set_label(f"{label(data['lambda_omega'])}: hardens < 0 < softens")
        zero = ax.contour(x, y, values, levels=[0.0], colors="black", linewidths=1.0)
        ax.clabel(zero, fmt={0.0: "0"}, fontsize=6.5)
        lines = ax.contour(
            x, y, ratio, levels=[3.0, 4.0, 5.0], colors="black", linewidths=0.8, linestyles="--"
        )
        ax.clabel(lines, fmt=lambda value: f"{value:.0f}:1", fontsize=6.5)
        ax.set(xlabel=label(data["hub_ratio"]), ylabel=label(data["w_bar"]))
    return ax


def softening_by_plane(data: xr.Dataset, ax: Axes | None = None) -> Axes:
    """Draw λ_ω of lag alone and of flap alone over the speed, with the zeros where it changes sign.

    Parameters
    ----------
    data : Dataset
        As made by `rotbeam_exu.comparison.softening_by_plane`.
    ax : Axes, optional
        Drawn on these; otherwise on a new figure.
    """
    ax = ax or new_figure(column(), 2.4)[1]
    assert ax is not None
    x = data["w_bar"].to_numpy()
    with mpl.rc_context(STYLE):
        ax.axhline(0.0, color="0.6", lw=0.5)
        # Where each name of a zero is clear of both curves.
        for plane, color, dashes, at, side in (
            ("lag", ink(BLUE), "-", (4, -9), "left"),
            ("flap", ink(RED), "--", (-4, 3), "right"),
        ):
            values = data["lambda_omega"].sel(plane=plane).to_numpy()
            ax.plot(x, values, color=color, ls=dashes, label=plane)
            for k in np.flatnonzero(np.diff(np.sign(values))):
                zero = x[k] - values[k] * (x[k + 1] - x[k]) / (values[k + 1] - values[k])
                ax.plot(zero, 0.0, "o", color=color, ms=3)
                ax.annotate(
                    f"{zero:.2f}", (zero, 0.0), xytext=at, textcoords="offset points",
                    fontsize=6.5, color=color, ha=side,
                )  # fmt: skip
        sign = f"{label(data['lambda_omega'])}: hardens < 0 < softens"
        ax.set(xlabel=label(data["w_bar"]), ylabel=sign, xlim=(x[0], x[-1]))
        ax.legend()
    return ax
