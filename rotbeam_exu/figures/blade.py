"""Figures of a blade's report: along its span, over its speed, over a turn; strain."""

from __future__ import annotations

from collections.abc import Sequence

import xarray as xr
from matplotlib.axes import Axes

from analytic.exact.linear.families import LinearModes

from .style import column, columns, fitting_units, house_axes, label, ramp


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


def strain_along(data: xr.Dataset, ax: Axes | None = None) -> Axes:
    """Draw the stress, or without it the strain, of each point of the sections along the span.

    Of data over time the band from the least to the largest, and both as lines: what
    `rotbeam_exu.runs.shape.strain_at` returns.

    Raises
    ------
    ValueError
        If the data have no strain over stations.
    """
    if "strain" not in data or not {"station", "point"} <= set(data["strain"].dims):
        raise ValueError(
            "strain_along draws what runs.shape.strain_at returns, of two stations or more"
        )
    values = data["stress" if "stress" in data else "strain"]
    with house_axes(ax, column(), 2.8) as axes:
        for number, color in enumerate(ramp(data.sizes["point"])):
            one, name = values.isel(point=number), f"point {number + 1}"
            if "time" not in one.dims:
                axes.plot(one["station"], one, color=color, label=name)
                continue
            ends = one.min("time"), one.max("time")
            axes.fill_between(one["station"], *ends, color=color, alpha=0.2, lw=0.0)
            for end, words in zip(ends, (name, None), strict=True):
                axes.plot(one["station"], end, color=color, label=words)
        axes.axhline(0.0, color="0.6", lw=0.5, zorder=0)
        axes.set(xlabel="distance from the clamp [m]", ylabel=label(values), xmargin=0.0)
        axes.legend(ncols=2)
        fitting_units(axes)
    return axes
