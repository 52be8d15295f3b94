"""Figures of a blade's report: along its span, over its speed, and over a turn."""

from __future__ import annotations

from collections.abc import Sequence

import xarray as xr
from matplotlib.axes import Axes

from analytic.exact.linear.families import LinearModes

from .style import columns, house_axes, label


def blade_sections(data: xr.Dataset, ax: Sequence[Axes] | None = None) -> Sequence[Axes]:
    """Draw stiffness, and mass per length, along the span."""
    stiffness = [name for name in data.data_vars if data[name].attrs["units"] != "kg/m"]
    with house_axes(ax, columns(), 2.6, ncols=2) as axes:
        for name in (one for one in stiffness if data[one].attrs["units"] == "N m^2"):
            axes[0].semilogy(data["x"], data[name], label=name)
        axes[1].plot(data["x"], data["m"])
        axes[0].set(xlabel=label(data["x"]), ylabel="stiffness [N m²]")
        axes[0].legend()
        axes[1].set(xlabel=label(data["x"]), ylabel=label(data["m"]), ylim=(0.0, None))
    return tuple(axes)


def mode_shapes(modes: LinearModes, ax: Axes | None = None) -> Axes:
    """Draw the shapes along the blade, each its largest value 1."""
    with house_axes(ax, columns(), 3.0) as axes:
        modes.plot(axes)
        axes.legend(
            title=f"ω = {modes.omega:.4g} rad/s", loc="upper left", bbox_to_anchor=(1.01, 1.0)
        )
    return axes


def steady_tip(data: xr.Dataset, ax: Axes | None = None) -> Axes:
    """Draw how far rotation moves the tip, over the speed."""
    with house_axes(ax, columns(), 2.6) as axes:
        for name, words in (("lag", "lag"), ("flap", "flap"), ("along", "along the clamp")):
            axes.plot(data["omega"], data[name], marker=".", label=words)
        axes.set(xlabel=label(data["omega"]), ylabel="tip, moved from rest [m]")
        axes.legend()
    return axes


def root_over_turn(data: xr.Dataset, ax: Sequence[Axes] | None = None) -> Sequence[Axes]:
    """Draw forces and moments of the root over the angle of the clamp."""
    with house_axes(ax, columns(), 3.4, ncols=2) as axes:
        for panel, kind in zip(axes, ("force", "moment"), strict=True):
            for name in (one for one in data.data_vars if str(one).startswith(kind)):
                panel.plot(data["angle"], data[name], label=data[name].attrs["long_name"])
            unit = data[f"{kind}_x"].attrs["units"]
            panel.set(
                xlabel=label(data["angle"]), ylabel=f"{kind} at the root [{unit}]",
                xlim=(0.0, 360.0), xticks=range(0, 361, 90),
            )  # fmt: skip
            panel.legend(loc="upper center", bbox_to_anchor=(0.5, -0.22))
    return tuple(axes)
