"""Figures 5 and 14: frequency against amplitude."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import matplotlib as mpl
import numpy as np
import xarray as xr
from matplotlib.axes import Axes

from ..paper import MODEL_NAMES
from .style import STYLE, column, columns, cycle, label, model_line, new_figure


def figure_5(data: xr.Dataset, ax: Axes | None = None) -> Axes:
    """Draw the finite element points and fitted curves, amplitude upwards as in the paper."""
    ax = ax or new_figure(column(), 3.0)[1]
    with mpl.rc_context(STYLE):
        for omega, color, marker in zip(data["omega"], cycle(), "osD^", strict=False):
            here = data.sel(omega=omega)
            ax.plot(here["fit"], here["a"], color=color)
            ax.errorbar(
                here["ratio"],
                here["amplitude"],
                xerr=here["ratio_error"],
                yerr=here["amplitude_error"],
                color=color,
                marker=marker,
                ms=3.5,
                mfc="white",
                ls="none",
                label=f"ω = {float(omega):g} rad/s: $λ_ω = {float(here['lambda_omega']):#.3g}$",
            )
        ax.axvline(1.0, color="0.7", lw=0.5)
        ax.set(xlabel=label(data["ratio"]), ylabel=label(data["amplitude"]), ylim=(0.0, 0.88))
        ax.legend(loc="lower left")
    return ax


def figure_14(data: xr.Dataset, ax: Sequence[Axes] | None = None) -> Sequence[Axes]:
    """Draw the backbones of all models, the exact one, and the finite element points, by speed.

    On axes of a figure narrower than 6 in the legend has the models' short names.
    """
    count = data.sizes["omega"]
    rows, height = (count + 1) // 2, 2.6 if count > 1 else 3.6
    axes: Any = (
        np.ravel(new_figure(columns(), height * rows, nrows=rows, ncols=min(count, 2))[1])
        if ax is None
        else ax
    )
    with mpl.rc_context(STYLE):
        for panel, omega, letter in zip(axes, data["omega"], "abcdefgh", strict=False):
            here = data.sel(omega=omega)
            for model in here["model"].to_numpy():
                row = here["backbone"].sel(model=model)
                panel.plot(
                    np.append(1.0, row),
                    np.append(0.0, here["a"]),
                    label=str(model),
                    **model_line(str(model)),
                )
            for mesh, marker, face in (("paper", "s", "white"), ("converged", "o", "black")):
                if mesh not in here["mesh"]:
                    continue
                points = here.sel(mesh=mesh)
                panel.errorbar(
                    points["ratio"],
                    points["amplitude"],
                    xerr=points["ratio_error"],
                    yerr=points["amplitude_error"],
                    ls="none",
                    marker=marker,
                    ms=4.5 if mesh == "paper" else 2.5,
                    color="black",
                    mfc=face,
                    mew=0.6,
                    label={"paper": "16 elements", "converged": "64 elements, step → 0"}[mesh],
                    zorder=5,
                )
            panel.axvline(1.0, color="0.8", lw=0.5, zorder=0)
            panel.set(
                xlabel=label(data["ratio"]),
                ylabel=label(data["amplitude"]),
                xlim=(0.978, 1.006),
                ylim=(0.0, 0.62),
            )
            which = f"{letter}) " if count > 1 else ""
            panel.set_title(f"{which}ω = {float(omega):g} rad/s", loc="left")
        _spelled_legend(axes[0])
    return tuple(axes)


def _spelled_legend(ax: Axes) -> None:
    """Say below the figure what the lines are: in words where there is room for them."""
    handles, names = ax.get_legend_handles_labels()
    figure: Any = ax.get_figure(root=True)
    if figure.get_figwidth() > 6.0:
        names = [f"{name}: {MODEL_NAMES[name]}" if name in MODEL_NAMES else name for name in names]
    figure.legend(handles, names, loc="outside lower center", ncols=3, columnspacing=1.4)
