"""Figures 8 to 13: what the reduced models say by themselves."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import matplotlib as mpl
import numpy as np
import xarray as xr
from matplotlib.axes import Axes

from .style import STYLE, column, columns, cycle, label, model_line, new_figure

_SHORT_DASHES = ("-", (0, (2, 1)), (0, (1, 1)))  # what greys do not tell from the models'
_DASHES = ("-", "--", "-.", ":", (0, (5, 1, 1, 1, 1, 1)))
_ROUND_OFF = 1e-13


def figure_8(data: xr.Dataset, ax: Axes | None = None) -> Axes:
    """Draw the backbones of CI between Ω = 0 and ∞, and the exact ones; the inset is near 1."""
    ax = ax or new_figure(column(), 3.2)[1]
    a, ratio, exact = data["amplitude"], data["ratio"], data["exact"]
    names = ("CI, Ω = 0", "CI, Ω = 1", "CI, Ω → ∞")
    line = model_line("exact")
    with mpl.rc_context(STYLE):
        near = ax.inset_axes((0.06, 0.1, 0.42, 0.5))
        near.set(xlim=(0.991, 1.005), ylim=(0.0, 0.4), xticks=(0.995, 1.0), yticks=())
        near.spines[["top", "right"]].set_visible(True)
        near.tick_params(labelsize=6.0)
        for panel in (ax, near):
            panel.fill_betweenx(a, ratio[0], ratio[-1], color="0.92", lw=0)
            for row, color, dashes, name in zip(ratio, cycle(), _DASHES, names, strict=False):
                panel.plot(row, a, color=color, ls=dashes, label=name)
            for row, short in zip(exact, _SHORT_DASHES, strict=False):
                name = f"exact, Ω = {float(row['exact_speed_ratio']):g}"
                panel.plot(row, data["exact_amplitude"], **{**line, "ls": short}, label=name)
        ax.set(xlabel=label(ratio), ylabel=label(a), xlim=(0.76, 1.06), ylim=(0.0, 0.4))
        ax.indicate_inset((0.991, 0.0, 0.014, 0.4), edgecolor="0.5", alpha=1.0)
        ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.18), ncols=2)
    return ax


def figure_9(data: xr.Dataset, ax: Sequence[Axes] | None = None) -> Sequence[Axes]:
    """Draw λ_ω and λ_x of CI against Ω."""
    return _coefficients(data, "speed_ratio", ax)


def figure_10(data: xr.Dataset, ax: Sequence[Axes] | None = None) -> Sequence[Axes]:
    """Draw λ_ω and λ_x of the polynomial shapes and of the cantilever's mode against ω."""
    return _coefficients(data, "omega", ax)


def figure_11(data: xr.Dataset, ax: Sequence[Axes] | None = None) -> Sequence[Axes]:
    """Draw λ_ω and λ_x of CE against ω for several slendernesses."""
    axes = _coefficients(data, "omega", ax)
    axes[0].set_title(f"CE; {data.attrs['held']}", loc="left", fontsize=STYLE["axes.titlesize"])
    return axes


def figure_12(data: xr.Dataset, ax: Axes | None = None) -> Axes:
    """Draw the distance of Frobenius' natural frequency from its limit over the degree."""
    ax = ax or new_figure(column(), 2.8)[1]
    off = np.abs(data["omega_n"] - data["converged"])
    degree = data.attrs["paper_degree"]
    with mpl.rc_context(STYLE):
        for row, color, mark in zip(off, cycle(), "osD^v<", strict=False):
            name = f"ω = {float(row['omega']):g} rad/s"
            # What is below is round-off.
            seen = row.where(row > _ROUND_OFF)
            ax.semilogy(data["degree"], seen, color=color, marker=mark, ms=2.5, lw=0.7, label=name)
        ax.axvline(degree, color="0.5", lw=0.5, ls=":")
        ax.annotate(
            "the paper's degree", (degree, 1.0), xycoords=("data", "axes fraction"),
            xytext=(3, -2), textcoords="offset points", va="top", color="0.4", fontsize=7,
        )  # fmt: skip
        ax.set(
            xlabel=f"{label(data['degree'])} N", ylabel="$|ω_n(N) - ω_n|$ [rad/s]",
            ylim=(_ROUND_OFF, 10.0),
        )  # fmt: skip
        ax.legend(loc="lower left")
    return ax


def figure_13(data: xr.Dataset, ax: Axes | None = None) -> Axes:
    """Draw the first mode shape at rest and in rotation."""
    ax = ax or new_figure(column(), 2.6)[1]
    with mpl.rc_context(STYLE):
        for row, color, style in zip(data["shape"], ("black", *cycle()), _DASHES, strict=False):
            omega = float(row["omega"])
            name = "cantilever at rest" if omega == 0.0 else f"ω = {omega:g} rad/s"
            ax.plot(data["eta"], row, color=color, ls=style, label=name)
        ax.set(xlabel=label(data["eta"]), ylabel=label(data["shape"]), xlim=(0, 1), ylim=(0, 1))
        ax.legend(loc="upper left")
    return ax


def _coefficients(data: xr.Dataset, axis: str, ax: Sequence[Axes] | None) -> Sequence[Axes]:
    axes: Any = new_figure(columns(), 2.8, ncols=2)[1] if ax is None else ax
    with mpl.rc_context(STYLE):
        for panel, variable, symbol in zip(
            axes, ("lambda_omega", "lambda_x"), (r"$\lambda_\omega$", r"$\lambda_x$"), strict=True
        ):
            for row, color, dashes in zip(data[variable], cycle(), _DASHES, strict=False):
                name = str(row["model"].item())
                line = model_line(name) if name == "exact" else {"color": color, "ls": dashes}
                panel.plot(data[axis], row, **line, label=name)
            panel.axhline(0.0, color="0.7", lw=0.5)
            low = float(np.nanmin(data[variable]))
            high = float(np.nanmax(data[variable]))
            margin = 0.06 * (high - low)
            panel.set(
                xlabel=label(data[axis]),
                ylabel=symbol,
                xlim=(0, float(data[axis][-1])),
                ylim=(min(low, 0.0) - margin, high + margin),
            )
        axes[0].legend(loc="best")
    return tuple(axes)
