"""Figure 15: one period of the orbit in phase space."""

from __future__ import annotations

import matplotlib as mpl
import xarray as xr
from matplotlib.axes import Axes

from .style import STYLE, column, label, model_line, new_figure


def figure_15(data: xr.Dataset, ax: Axes | None = None) -> Axes:
    """Draw the orbits of models, exact beam and finite elements over one period of the latter.

    A dot marks where each orbit ends; the inset shows those that end near the start.
    """
    ax = ax or new_figure(column(), 4.4)[1]
    amplitude = float(data.attrs["amplitude"])
    fastest = float(data["q_dot_bar"].sel(model="finite element").max())
    with mpl.rc_context(STYLE):
        near = ax.inset_axes((0.25, 0.3, 0.5, 0.4))
        near.set(
            xlim=(0.9 * amplitude, 1.02 * amplitude),
            ylim=(-0.45 * fastest, 0.45 * fastest),
            xticks=[],
            yticks=[],
        )
        near.spines[["top", "right"]].set_visible(True)
        for panel in (ax, near):
            _orbits(panel, data)
        ax.indicate_inset_zoom(near, edgecolor="0.5", alpha=1.0)
        ax.set(xlabel=label(data["q_bar"]), ylabel=label(data["q_dot_bar"]))
        ax.set_title(f"ω = {data.attrs['omega']:g} rad/s, a = {amplitude:.4f}", loc="left")
        ax.legend(
            loc="upper center",
            bbox_to_anchor=(0.5, -0.16),
            ncols=4,
            columnspacing=1.2,
            title="$\\bullet$ end of the period",
            title_fontsize=STYLE["legend.fontsize"],
        )
    return ax


def _orbits(ax: Axes, data: xr.Dataset) -> None:
    for model in data["model"].to_numpy():
        here = data.sel(model=model)
        if model == "finite element":
            ax.plot(
                here["q_bar"][::8], here["q_dot_bar"][::8], ls="none", marker="o", ms=3.0,
                mfc="white", mec="black", mew=0.6, zorder=6,
                label=f"{data.attrs['elements']} elements",
            )  # fmt: skip
            continue
        line = model_line(str(model))
        ax.plot(here["q_bar"], here["q_dot_bar"], label=str(model), **line)
        ax.plot(
            here["q_bar"][-1], here["q_dot_bar"][-1], marker="o", ms=4.0, color=line["color"],
            zorder=7,
        )  # fmt: skip
