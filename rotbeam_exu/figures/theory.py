"""Figures 8 to 13: what the reduced models say by themselves."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import matplotlib as mpl
import numpy as np
import xarray as xr
from matplotlib.axes import Axes

from ..paper import BLUE
from .style import STYLE, column, columns, cycle, label, new_figure


def figure_8(data: xr.Dataset, ax: Axes | None = None) -> Axes:
    """Draw the backbones of CI between Ω = 0 and ∞."""
    ax = ax or new_figure(column(), 2.6)[1]
    a, ratio = data["amplitude"], data["ratio"]
    names = ("Ω = 0", "Ω = 1", "Ω → ∞")
    with mpl.rc_context(STYLE):
        ax.fill_betweenx(a, ratio[0], ratio[-1], color="0.92", lw=0)
        for row, color, style in zip(ratio, cycle(), ("-", "--", "-."), strict=False):
            ax.plot(row, a, color=color, ls=style)
        for row, name, at, side in zip(
            ratio, names, (0.34, 0.34, 0.3), ("left", "right", "right"), strict=True
        ):
            ax.annotate(
                name,
                (float(row.interp(amplitude=at)), at),
                xytext=(5 if side == "left" else -5, 0),
                textcoords="offset points",
                ha=side,
                va="center",
                fontsize=7,
            )
        ax.set(xlabel=label(ratio), ylabel=label(a), xlim=(0.76, 1.06), ylim=(0.0, 0.4))
    return ax


def figure_9(data: xr.Dataset, ax: Sequence[Axes] | None = None) -> Sequence[Axes]:
    """Draw λ_ω and λ_x of CI against Ω."""
    return _coefficients(data, "speed_ratio", ax, names=False)


def figure_10(data: xr.Dataset, ax: Sequence[Axes] | None = None) -> Sequence[Axes]:
    """Draw λ_ω and λ_x of the polynomial shapes and of the cantilever's mode against ω."""
    return _coefficients(data, "omega", ax)


def figure_11(data: xr.Dataset, ax: Sequence[Axes] | None = None) -> Sequence[Axes]:
    """Draw λ_ω and λ_x of CE against ω for several slendernesses."""
    return _coefficients(data, "omega", ax)


def figure_12(data: xr.Dataset, ax: Axes | None = None) -> Axes:
    """Draw the convergence of Frobenius' natural frequency with the degree."""
    ax = ax or new_figure(column(), 2.6)[1]
    with mpl.rc_context(STYLE):
        for row, exact, color in zip(data["omega_n"], data["converged"], cycle(), strict=False):
            ax.axhline(float(exact), color="0.75", lw=0.5)
            ax.plot(data["degree"], row, color=color, marker="o", ms=2.0)
            ax.annotate(
                f"ω = {float(row['omega']):g} rad/s",
                (float(data["degree"][-1]), float(exact)),
                xytext=(-2, 3),
                textcoords="offset points",
                ha="right",
                color=color,
                fontsize=7,
            )
        ax.axvline(data.attrs["paper_degree"], color="0.5", lw=0.5, ls=":")
        ax.annotate(
            "the paper's degree",
            (data.attrs["paper_degree"], 2.55),
            xytext=(3, 0),
            textcoords="offset points",
            color="0.4",
            fontsize=7,
        )
        ax.set(xlabel=label(data["degree"]), ylabel=label(data["omega_n"]), ylim=(2.5, 5.0))
    return ax


def figure_13(data: xr.Dataset, ax: Axes | None = None) -> Axes:
    """Draw the first mode shape at rest and in rotation."""
    ax = ax or new_figure(column(), 2.6)[1]
    styles = ("-", "--", "-.", ":", (0, (5, 1, 1, 1, 1, 1)))
    with mpl.rc_context(STYLE):
        for row, color, style in zip(data["shape"], ("black", *cycle()), styles, strict=False):
            omega = float(row["omega"])
            name = "cantilever at rest" if omega == 0.0 else f"ω = {omega:g} rad/s"
            ax.plot(data["eta"], row, color=color, ls=style, label=name)
        ax.set(xlabel=label(data["eta"]), ylabel=label(data["shape"]), xlim=(0, 1), ylim=(0, 1))
        ax.legend(loc="upper left")
    return ax


def _coefficients(
    data: xr.Dataset, axis: str, ax: Sequence[Axes] | None, *, names: bool = True
) -> Sequence[Axes]:
    axes: Any = new_figure(columns(), 2.6, ncols=2)[1] if ax is None else ax
    with mpl.rc_context(STYLE):
        for panel, variable, symbol in zip(
            axes, ("lambda_omega", "lambda_x"), (r"$\lambda_\omega$", r"$\lambda_x$"), strict=True
        ):
            for row, color, style in zip(
                data[variable], cycle(), ("-", "--", "-.", ":"), strict=False
            ):
                panel.plot(data[axis], row, color=color, ls=style, label=str(row["model"].item()))
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
        if names:
            axes[0].legend(loc="best")
        else:
            for panel, row in zip(
                axes, (data["lambda_omega"][0], data["lambda_x"][0]), strict=True
            ):
                panel.lines[0].set_color(BLUE)
                panel.set_title(f"{row['model'].item()}", loc="left")
    return tuple(axes)
