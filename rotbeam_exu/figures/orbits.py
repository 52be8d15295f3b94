"""Figure 15: one period of the orbit in phase space."""

from __future__ import annotations

import matplotlib as mpl
import xarray as xr
from matplotlib.axes import Axes

from .style import COLUMN, MODEL_LINES, STYLE, label, new_figure


def figure_15(data: xr.Dataset, ax: Axes | None = None) -> Axes:
    """Draw the orbits of models, exact beam and finite elements over one period of the latter."""
    ax = ax or new_figure(COLUMN, 3.6)[1]
    with mpl.rc_context(STYLE):
        for model in data["model"].to_numpy():
            here = data.sel(model=model)
            if model == "finite element":
                ax.plot(
                    here["q_bar"][::8], here["q_dot_bar"][::8], ls="none", marker="o", ms=3.0,
                    mfc="white", mec="black", mew=0.6, zorder=6,
                    label=f"{data.attrs['elements']} elements",
                )  # fmt: skip
            else:
                ax.plot(
                    here["q_bar"], here["q_dot_bar"], label=str(model), **MODEL_LINES[str(model)]
                )
        ax.set(xlabel=label(data["q_bar"]), ylabel=label(data["q_dot_bar"]))
        ax.set_title(
            f"ω = {data.attrs['omega']:g} rad/s, a = {data.attrs['amplitude']:.4f}", loc="left"
        )
        ax.legend(loc="center", ncols=2)
    return ax
