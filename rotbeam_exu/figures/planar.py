"""Where planar motion leaves its plane."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import matplotlib as mpl
import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm

from ..paper import BLUE, ORANGE, RED
from .style import STYLE, colormap, column, cycle, ink, label, new_figure

_MARKS = {"period doubling": "s", "divergence": "^", "sum resonance": "o"}


def planar_stability(data: xr.Dataset, ax: Axes | None = None) -> Axes:
    """Draw the growth rate out of the plane over the amplitude, at one speed.

    Parameters
    ----------
    data : Dataset
        As made by `rotbeam_exu.comparison.planar_stability`.
    ax : Axes, optional
        Drawn on these; otherwise on a new figure.
    """
    ax = ax or new_figure(column(), 2.6)[1]
    assert ax is not None
    a, rate = data["a"].to_numpy(), data["growth_rate"].to_numpy()
    kinds, stable = data["kind"].to_numpy(), rate == 0.0
    with mpl.rc_context(STYLE):
        for (kind, mark), color in zip(_MARKS.items(), map(ink, (BLUE, RED, ORANGE)), strict=True):
            here = kinds == kind
            if here.any():
                ax.plot(a[here], rate[here], mark, color=color, ms=3.5, label=kind)
        ax.plot(a[stable], np.zeros(stable.sum()), "o", color="black", ms=3, label="stays in plane",
                transform=ax.get_xaxis_transform(), clip_on=False)  # fmt: skip
        limit = float(data.attrs.get("limit", np.inf))
        if np.isfinite(limit):
            ax.axvline(limit, color="0.5", lw=0.7, ls="--", label=f"limit, a = {limit:.3g}")
        if stable.all():
            ax.set(ylim=(0.0, 1.0), yticks=[0.0])
        else:
            ax.set_yscale("log")
        ax.set(xlabel=label(data["a"]), ylabel=label(data["growth_rate"]), xlim=(0.0, None))
        ax.set_title(f"ω = {data.attrs['omega']:g} rad/s", loc="left")
        ax.legend()
    return ax


def growth_out_of_plane(
    data: xr.Dataset,
    ax: Axes | None = None,
    *,
    spin_ups: Mapping[float, Sequence[float]] | None = None,
) -> Axes:
    """Draw the map of growth rates over speed and amplitude; what is white stays in the plane.

    Parameters
    ----------
    data : Dataset
        As made by `rotbeam_exu.comparison.growth_out_of_plane`.
    ax : Axes, optional
        Drawn on these; otherwise on a new figure.
    spin_ups : mapping, optional
        Amplitudes |q|/L on which spin-ups end, by their speeds [rad/s].
    """
    ax = ax or new_figure(column(), 3.0)[1]
    assert ax is not None
    rate = data["growth_rate"].where(data["growth_rate"] > 0.0).to_numpy().T
    with mpl.rc_context(STYLE):
        ax.set_facecolor("white")
        drawn = ax.pcolormesh(
            data["omega"], data["a"], rate, cmap=colormap("YlOrRd"), norm=LogNorm(0.01, 100.0),
            shading="nearest", rasterized=True,
        )  # fmt: skip
        bar = ax.figure.colorbar(drawn, ax=ax, extend="both")
        bar.set_label(label(data["growth_rate"]))
        ends = [(omega, a) for omega, peaks in (spin_ups or {}).items() for a in peaks]
        if ends:
            ax.plot(*np.transpose(ends), "o", ms=3.2, mfc="white", mec="black", mew=0.7,
                    clip_on=False, label="where spin-ups end")  # fmt: skip
            ax.legend(loc="lower right")
        step = 0.5 * float(data["omega"].diff("omega").max())
        ax.set(
            xlabel=label(data["omega"]), ylabel=label(data["a"]),
            xlim=(float(data["omega"].min()) - step, float(data["omega"].max()) + step),
        )  # fmt: skip
        ax.set_yscale("log")
        levels = [0.01, 0.02, 0.05, 0.1, 0.2, 0.4]
        ax.set_yticks(levels, [f"{level:g}" for level in levels])
        ax.set_yticks([], minor=True)
        # White beyond what was computed would say that it stays.
        edges = np.asarray(drawn.get_coordinates())[:, 0, 1]
        ax.set_ylim(edges[0], edges[-1])
    return ax


def stability_limits(data: xr.Dataset, ax: Axes | None = None) -> Axes:
    """Draw the amplitudes from which on the plane is left over height/width, a line for each speed.

    Parameters
    ----------
    data : Dataset
        As made by `rotbeam_exu.comparison.stability_limits`.
    ax : Axes, optional
        Drawn on these; otherwise on a new figure.
    """
    ax = ax or new_figure(column(), 2.6)[1]
    assert ax is not None
    with mpl.rc_context(STYLE):
        for omega, color, mark in zip(data["omega"].to_numpy(), cycle(), "os^Dv<", strict=False):
            limit = data["limit"].sel(omega=omega)
            ax.plot(data["ratio"], limit.where(np.isfinite(limit)), f"{mark}-", color=color, ms=3,
                    label=f"{omega:g} rad/s")  # fmt: skip
        ax.set_xscale("log")
        ax.set_yscale("log")
        ticks = data["ratio"].to_numpy()
        ax.set_xticks(ticks, [f"{ratio:g}" for ratio in ticks])
        ax.set_xticks([], minor=True)
        levels = [0.03, 0.05, 0.1, 0.2, 0.4, 0.6]
        ax.set_yticks(levels, [f"{level:g}" for level in levels])
        ax.set_yticks([], minor=True)
        ax.set(xlabel=label(data["ratio"]), ylabel=label(data["limit"]))
        ax.legend()
    return ax
