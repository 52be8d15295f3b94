"""What Eq. 1 leaves over its ramp time."""

from __future__ import annotations

import matplotlib as mpl
import numpy as np
import xarray as xr
from matplotlib.axes import Axes

from ..paper import BLUE, RED
from .style import STYLE, column, ink, label, new_figure


def residual(data: xr.Dataset, ax: Axes | None = None) -> Axes:
    """Draw the amplitude left over the ramp time: closed form, exact, finite elements, quiet ramps.

    Parameters
    ----------
    data : Dataset
        As made by `rotbeam_exu.comparison.residual`.
    ax : Axes, optional
        Drawn on these; otherwise on a new figure.
    """
    ax = ax or new_figure(column(), 3.2)[1]
    assert ax is not None
    with mpl.rc_context(STYLE):
        blue, red = ink(BLUE), ink(RED)
        ax.semilogy(
            data["ramp_time"], data["linear"], color=blue, label="linear modes, closed form"
        )
        ax.semilogy(
            data["ramp_time"], data["corrected"], color=blue, ls="--", lw=0.8,
            label="corrected by the backbone",
        )  # fmt: skip
        for name, text, marker in (
            (
                "exact",
                "exact transient",
                {"marker": "o", "ms": 3.5, "mfc": "black", "mec": "black"},
            ),
            (
                "finite_element",
                "finite elements",
                {"marker": "s", "ms": 6, "mew": 0.8, "mfc": "none"},
            ),
        ):
            if data[name].size:
                at = data[f"{name}_ramp_time"]
                ax.semilogy(
                    at, data[name], ls="none", color="black", label=text, clip_on=False, **marker
                )
        if data["quiet"].size:
            at = data["quiet_ramp_time"]
            ax.semilogy(
                at, data["quiet"], ls="none", marker="v", ms=5, color=red, label="quiet ramps"
            )
            for T, left in zip(at.to_numpy(), data["quiet"].to_numpy(), strict=True):
                ax.annotate(
                    f"{T:.2f} s", (T, left), xytext=(0, -5), textcoords="offset points",
                    ha="center", va="top", size=6.5, color=red,
                )  # fmt: skip
        lowest = float(np.nanmin(np.append(data["linear"], data["quiet"])))
        ax.set(
            xlabel=label(data["ramp_time"]), ylabel="amplitude left, $|q|/L$",
            xlim=(float(data["ramp_time"][0]), float(data["ramp_time"][-1])),
            ylim=(0.3 * lowest, 1.5),
        )  # fmt: skip
        ax.set_title(f"ω = {data.attrs['omega']:g} rad/s", loc="left")
        ax.legend(loc="upper right")
    return ax
