"""Figures 3 and 4: coarse meshes spun up, and their steady orbits."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import matplotlib as mpl
import xarray as xr
from matplotlib.axes import Axes

from .style import COLUMN, COLUMNS, CYCLE, STYLE, label, new_figure


def figure_3(data: xr.Dataset, ax: Axes | None = None) -> Axes:
    """Draw the tip displacement of one, two and three elements."""
    ax = ax or new_figure(COLUMN, 2.6)[1]
    ramp_time, end = float(data.attrs["ramp_time"]), float(data["time"][-1])
    with mpl.rc_context(STYLE):
        ax.axvspan(ramp_time, end, color="0.92", lw=0)
        for row, color, style in zip(data["q"], CYCLE, ("-", "--", ":"), strict=False):
            count = int(row["elements"])
            name = f"{count} element{'s' if count > 1 else ''}"
            ax.plot(data["time"], row, color=color, ls=style, label=name)
        ax.set(xlabel=label(data["time"]), ylabel=label(data["q"]), xlim=(0.0, end))
        ax.legend(loc="lower right")
        ax.set_title(f"ω = {data.attrs['omega']:g} rad/s, T = {ramp_time:g} s", loc="left")
    return ax


def figure_4(data: xr.Dataset, ax: Sequence[Axes] | None = None) -> Sequence[Axes]:
    """Draw normalized steady orbits: (a) by ramp time, (b) by speed."""
    axes: Any = new_figure(COLUMNS, 3.2, ncols=2)[1] if ax is None else ax
    with mpl.rc_context(STYLE):
        for panel, letter in zip(axes, "ab", strict=True):
            here = data.isel(case=(data["panel"] == letter).to_numpy())
            by = "ramp_time" if letter == "a" else "omega"
            for case, color in zip(here["case"], CYCLE, strict=False):
                row = here.sel(case=case) if "case" in here.coords else here.isel(case=int(case))
                value = float(row[by])
                name = f"T = {value:g} s" if by == "ramp_time" else f"ω = {value:g} rad/s"
                panel.plot(row["q_bar"], row["q_dot_bar"], color=color, lw=0.6, label=name)
            fixed = here.isel(case=0)
            panel.set_title(
                f"{letter}) ω = {float(fixed['omega']):g} rad/s"
                if letter == "a"
                else f"{letter}) T = {float(fixed['ramp_time']):g} s",
                loc="left",
            )
            panel.set(xlabel=label(data["q_bar"]), ylabel=label(data["q_dot_bar"]))
            panel.legend(loc="center")
    return tuple(axes)
