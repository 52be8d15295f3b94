"""One run: the tip's displacement with the steady window shaded, and its orbit in phase space."""

from __future__ import annotations

from collections.abc import Sequence

import matplotlib as mpl
import xarray as xr
from matplotlib.axes import Axes

from ..paper import BLUE, ORANGE
from .style import STYLE, columns, ink, label, new_figure


def spin_up(run: xr.Dataset, ax: Sequence[Axes] | None = None) -> tuple[Axes, Axes]:
    """Draw q(t) and the steady orbit (q, q_dot) of a run.

    Parameters
    ----------
    run : Dataset
        As made by `simulate`.
    ax : two Axes, optional
        Drawn on these; otherwise on a new figure.

    Returns
    -------
    tuple of Axes
        Time history and phase space.
    """
    if ax is None:
        _, ax = new_figure(columns(), 2.6, ncols=2, width_ratios=(1.7, 1.0))
    history, phase = ax
    ramp_time = float(run.attrs["ramp_time"])
    end = float(run["time"][-1])
    steady = run.where(run["time"] >= ramp_time, drop=True)
    with mpl.rc_context(STYLE):
        history.axvspan(ramp_time, end, color="0.92", lw=0)
        history.axhline(0.0, color="0.6", lw=0.5)
        history.plot(run["time"], run["q"], color=ink(BLUE))
        history.set(xlabel=label(run["time"]), ylabel=label(run["q"]), xlim=(0.0, end))
        history.annotate(
            "steady rotation",
            (end, 0.0),
            xycoords=("data", "axes fraction"),
            xytext=(-4, 4),
            textcoords="offset points",
            ha="right",
            va="bottom",
            color="0.35",
        )
        history.set_title(
            f"ω = {run.attrs['omega']:g} rad/s, T = {ramp_time:g} s, "
            f"{run.attrs['elements']} {run.attrs['element']} elements",
            loc="left",
        )
        phase.plot(steady["q"], steady["q_dot"], color=ink(ORANGE), lw=0.6)
        phase.set(xlabel=label(run["q"]), ylabel=label(run["q_dot"]))
        phase.set_title(f"steady orbit, t > {ramp_time:g} s", loc="left")
    return history, phase
