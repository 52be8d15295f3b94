"""Figures 3 and 4: coarse meshes spun up, and their steady orbits."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import matplotlib as mpl
import numpy as np
import xarray as xr
from matplotlib.axes import Axes

from .style import STYLE, column, columns, cycle, label, new_figure

_DASHES = ("-", "--", ":")
_DASHES_OF_ORBITS = ("-.", (0, (5, 1)), (0, (3, 1, 1, 1)), (0, (1, 1)), "--", ":")


def figure_3(data: xr.Dataset, ax: Axes | None = None) -> Axes:
    """Draw the tip displacement of one, two and three elements; the inset shows its phase."""
    ax = ax or new_figure(column(), 2.9)[1]
    ramp_time, end = float(data.attrs["ramp_time"]), float(data["time"][-1])
    last = data["q"].where(data["time"] >= end - 0.25 * (end - ramp_time), drop=True)
    height = 1.15 * float(np.abs(last).max())
    with mpl.rc_context(STYLE):
        near = ax.inset_axes((0.52, 0.14, 0.46, 0.48))
        near.set(xlim=(last["time"][0], end), ylim=(-height, height))
        near.spines[["top", "right"]].set_visible(True)
        near.tick_params(labelsize=6.0)
        ax.axvspan(ramp_time, end, color="0.92", lw=0)
        for panel in (ax, near):
            for row, color, style in zip(data["q"], cycle(), _DASHES, strict=False):
                count = int(row["elements"])
                name = f"{count} element{'s' if count > 1 else ''}"
                panel.plot(data["time"], row, color=color, ls=style, label=name)
        low = float(data["q"].min())
        ax.set(
            xlabel=label(data["time"]), ylabel=label(data["q"]), xlim=(0.0, end),
            ylim=(1.08 * low, 0.2 * abs(low)),
        )  # fmt: skip
        ax.indicate_inset_zoom(near, edgecolor="0.5", alpha=1.0)
        ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.18), ncols=3)
        ax.set_title(f"ω = {data.attrs['omega']:g} rad/s, T = {ramp_time:g} s", loc="left")
    return ax


def figure_4(data: xr.Dataset, ax: Sequence[Axes] | None = None) -> Sequence[Axes]:
    """Draw normalized steady orbits: (a) by ramp time, (b) by speed.

    The first turn is the line; all turns lie behind it, pale. A case that both panels have looks
    the same in both, and they have one scale.
    """
    axes: Any = new_figure(columns(), 2.9, ncols=2)[1] if ax is None else ax
    width, height = (1.08 * float(np.abs(data[name]).max()) for name in ("q_bar", "q_dot_bar"))
    looks: dict[tuple[float, float], tuple[str, Any]] = {}
    fresh = iter(zip(cycle(), _DASHES_OF_ORBITS, strict=False))
    common = _cases(data, "a") & _cases(data, "b")
    with mpl.rc_context(STYLE):
        for panel, letter in zip(axes, "ab", strict=True):
            here = data.isel(case=(data["panel"] == letter).to_numpy())
            by = "ramp_time" if letter == "a" else "omega"
            for case in range(here.sizes["case"]):
                row = here.isel(case=case)
                key = float(row["omega"]), float(row["ramp_time"])
                if key not in looks:
                    looks[key] = ("black", "-") if key in common else next(fresh)
                color, dashes = looks[key]
                q, rate = row["q_bar"].to_numpy(), row["q_dot_bar"].to_numpy()
                name = f"T = {key[1]:g} s" if by == "ramp_time" else f"ω = {key[0]:g} rad/s"
                once = _first_turn(q, rate)
                panel.plot(q, rate, color=color, lw=0.4, alpha=0.25)
                panel.plot(q[once], rate[once], color=color, ls=dashes, label=name)
            fixed = here.isel(case=0)
            held = (
                f"ω = {float(fixed['omega']):g} rad/s"
                if letter == "a"
                else f"T = {float(fixed['ramp_time']):g} s"
            )
            panel.set_title(f"{letter}) {held}", loc="left")
            panel.set(
                xlabel=label(data["q_bar"]), ylabel=label(data["q_dot_bar"]),
                xlim=(-width, width), ylim=(-height, height),
            )  # fmt: skip
            panel.legend(loc="center")
    return tuple(axes)


def _cases(data: xr.Dataset, letter: str) -> set[tuple[float, float]]:
    here = data.isel(case=(data["panel"] == letter).to_numpy())
    return set(zip(here["omega"].values.tolist(), here["ramp_time"].values.tolist(), strict=True))


def _first_turn(q: Any, rate: Any) -> slice:
    """Return the samples of an orbit once around."""
    turned = np.unwrap(np.arctan2(rate, q)[np.isfinite(q)])
    around = np.flatnonzero(np.abs(turned - turned[0]) >= 2.0 * np.pi)
    return slice(0, int(around[0]) + 1 if around.size else None)
