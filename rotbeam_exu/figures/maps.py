"""Maps over the speed: λ_ω over the hub radius, in lag and in flap, and growth out of the plane."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import SymLogNorm

from ..paper import BLUE, RED
from .style import colormap, column, house_axes, ink, label, takes_own

_GROWTH_LEVELS = (0.0, 0.1, 0.3, 1.0, 3.0, 10.0, 30.0, 100.0)  # [1/s]


@takes_own
def softening_map(data: xr.Dataset, ax: Axes | None = None) -> Axes:
    """Draw λ_ω, its zero line, and the lines on which ω_2/ω_n is 3, 4 and 5."""
    x, y = data["hub_ratio"].to_numpy(), data["w_bar"].to_numpy()
    values, ratio = data["lambda_omega"].to_numpy().T, data["ratio"].to_numpy().T
    limit = float(np.quantile(np.abs(values), 0.99))
    with house_axes(ax, column(), 3.0) as axes:
        step = np.ceil(limit / 5.0 * 200.0) / 200.0
        levels = step * np.arange(-5.0, 5.5, 0.5)
        filled = axes.contourf(x, y, values, levels, cmap=colormap("RdBu_r"), extend="both")
        colorbar = axes.figure.colorbar(filled, ax=axes, ticks=levels[2::4])
        colorbar.set_label(f"{label(data['lambda_omega'])}: hardening < 0, softening > 0")
        zero = axes.contour(x, y, values, levels=[0.0], colors="black", linewidths=1.0)
        axes.clabel(zero, fmt={0.0: "0"}, fontsize=6.5, manual=[(3.0, 0.8)])
        lines = axes.contour(
            x, y, ratio, levels=[3.0, 4.0, 5.0], colors="black", linewidths=0.8, linestyles="--"
        )
        places = [(2.4, 6.5), (2.6, 2.8), (2.6, 1.5)]
        for text in axes.clabel(lines, fmt="%.0f:1", fontsize=6.5, manual=places):
            text.set_rotation(0.0)
        axes.set(xlabel=label(data["hub_ratio"]), ylabel=label(data["w_bar"]))
    return axes


@takes_own
def softening_by_plane(data: xr.Dataset, ax: Axes | None = None) -> Axes:
    """Draw λ_ω of lag alone and of flap alone, with the speeds at which it changes sign."""
    x = data["w_bar"].to_numpy()
    with house_axes(ax, column(), 2.4) as axes:
        axes.axhline(0.0, color="0.6", lw=0.5)
        # Where each name of a zero is clear of both curves.
        for plane, color, dashes, at, side in (
            ("lag", ink(BLUE), "-", (4, -9), "left"),
            ("flap", ink(RED), "--", (-4, 3), "right"),
        ):
            values = data["lambda_omega"].sel(plane=plane).to_numpy()
            axes.plot(x, values, color=color, ls=dashes, label=plane)
            for k in np.flatnonzero(np.diff(np.sign(values))):
                zero = x[k] - values[k] * (x[k + 1] - x[k]) / (values[k + 1] - values[k])
                axes.plot(zero, 0.0, "o", color=color, ms=3)
                axes.annotate(
                    f"{zero:.2f}", (zero, 0.0), xytext=at, textcoords="offset points",
                    fontsize=6.5, color=color, ha=side,
                )  # fmt: skip
        axes.set(xlabel=label(data["w_bar"]), ylabel=label(data["lambda_omega"]))
        axes.set_xlim(x[0], x[-1])
        for words, place, ha in (
            ("softening", (0.02, 0.93), "left"),
            ("hardening", (0.98, 0.03), "right"),
        ):
            axes.text(*place, words, transform=axes.transAxes, ha=ha, color="0.35")
        axes.legend()
    return axes


@takes_own
def growth_out_of_plane(
    data: xr.Dataset,
    ax: Axes | None = None,
    *,
    spin_ups: Mapping[float, Sequence[float]] | None = None,
) -> Axes:
    """Draw the map of growth rates over speed and amplitude; white stays in the plane.

    The line is where growth begins: the limit, and below it the tongues. It is smooth with damping,
    where what is stable decays. Grey is where no orbit was found.

    Parameters
    ----------
    data : Dataset
        As made by `rotbeam_exu.comparison.growth_out_of_plane`.
    ax : Axes, optional
        Drawn on these; otherwise on a new figure.
    spin_ups : mapping, optional
        Amplitudes |q|/L on which spin-ups end, by their speeds [rad/s]; larger ones than the map's
        are left out.
    """
    omega, a, rate = data["omega"].to_numpy(), data["a"].to_numpy(), data["growth_rate"].to_numpy()
    with house_axes(ax, column(), 3.2) as axes:
        axes.set_facecolor("0.8")
        known = np.ma.masked_invalid(rate.T)
        axes.contourf(omega, a, known, [-np.inf, 0.0], colors="white")
        drawn = axes.contourf(
            omega, a, known, _GROWTH_LEVELS, norm=SymLogNorm(0.1, vmin=0.0, vmax=100.0),
            cmap=colormap("YlOrRd"), extend="max",
        )  # fmt: skip
        bar = axes.figure.colorbar(drawn, ax=axes, ticks=_GROWTH_LEVELS, format="%g")
        bar.set_label(label(data["growth_rate"]))
        axes.contour(omega, a, known, [0.0], colors="black", linewidths=0.7)
        edge = axes.plot([], [], color="black", lw=0.7, label="limit and tongues")
        ends = [
            (speed, peak)
            for speed, peaks in (spin_ups or {}).items()
            for peak in peaks
            if peak <= a[-1]
        ]
        if ends:
            edge += axes.plot(*np.transpose(ends), "o", ms=3.2, mfc="white", mec="black", mew=0.7,
                              clip_on=False, label="ends of spin-ups")  # fmt: skip
        axes.legend(handles=edge, loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=2)
        axes.text(0.97, 0.1, "stable in the plane", transform=axes.transAxes, ha="right")
        axes.set(
            xlabel=label(data["omega"]), ylabel=label(data["a"]), yscale="log",
            xlim=(omega[0], omega[-1]), ylim=(a[0], a[-1]),
        )  # fmt: skip
        levels = [level for level in (0.01, 0.02, 0.05, 0.1, 0.2, 0.5) if a[0] <= level <= a[-1]]
        axes.set_yticks(levels, [f"{level:g}" for level in levels])
        axes.set_yticks([], minor=True)
    return axes
