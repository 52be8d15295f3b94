"""A forced response over its frequency: stable and unstable, with folds and backbone."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import matplotlib as mpl
import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from scipy.interpolate import PchipInterpolator

from analytic.plotting import backbone_drawn

from .style import STYLE, column, cycle, label, new_figure

_DAMPINGS = {"bending": ("$η_b$", "s"), "axial": ("$η_a$", "s"), "external": ("$d$", "kg/(m s)")}
_UNSTABLE: Any = {"ls": (0, (2.5, 1.5)), "lw": 0.8}
_FOLD: Any = {"ls": "none", "marker": "o", "ms": 3.5, "mfc": "white"}
_FINE = 10  # pieces of what is drawn between two points


def forced_response(data: xr.Dataset | Sequence[xr.Dataset], ax: Axes | None = None) -> Axes:
    """Draw response curves: stable solid, unstable dashed, folds as rings, the backbone thin.

    Between the points of a curve a cubic is drawn that is monotone where they are.

    Parameters
    ----------
    data : Dataset or sequence of Dataset
        As made by `rotbeam_exu.comparison.forced_response`; several of one blade under one kind of
        load, at one speed.
    ax : Axes, optional
        Drawn on these; otherwise on a new figure.
    """
    ax = ax or new_figure(column(), 3.2)[1]
    assert ax is not None
    curves = [data] if isinstance(data, xr.Dataset) else list(data)
    highest = max(curves, key=lambda curve: float(curve["amplitude"].max()))
    with mpl.rc_context(STYLE):
        for curve, color in zip(curves, cycle(), strict=False):
            stable, unstable = _parts(curve)
            ax.plot(*stable, color=color, label=_title(curve))
            ax.plot(*unstable, color=color, **_UNSTABLE)
            folds = curve.isel(point=(curve["mark"] == "fold").to_numpy())
            ax.plot(folds["frequency"], folds["amplitude"], mec=color, **_FOLD)
        if "backbone_frequency" in highest:
            free = highest["backbone_frequency"].to_numpy()
            line = backbone_drawn(free, highest["backbone_amplitude"].to_numpy())
            ax.plot(*line, color="0.3", lw=0.5, zorder=1, label="backbone")
            ax.set_title(f"ω = {highest.attrs['omega']:g} rad/s", loc="left")
        if any(not curve["stable"].all() for curve in curves):
            ax.plot([], [], color="0.3", label="unstable", **_UNSTABLE)
        if any((curve["mark"] == "fold").any() for curve in curves):
            ax.plot([], [], mec="0.3", label="fold", **_FOLD)
        ax.set(
            xlabel=label(highest["frequency"]), ylabel=label(highest["amplitude"]),
            xlim=(highest["frequency"][0], highest["frequency"][-1]), ylim=(0.0, None),
        )  # fmt: skip
        ax.xaxis.set_major_locator(mpl.ticker.MaxNLocator(6, steps=[1, 2, 5, 10]))
        ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=2, columnspacing=1.2)
    return ax


def _parts(curve: xr.Dataset) -> tuple[Any, Any]:
    """Return frequencies and amplitudes of the stable and of the unstable parts, NaN between."""
    line = np.array([curve["frequency"], curve["amplitude"]])
    # At a fold, where a multiplier is 1, both parts end.
    calm = curve["stable"].to_numpy() | (curve["mark"].to_numpy() == "fold")
    along = np.linalg.norm(np.diff(line / np.ptp(line, axis=1, keepdims=True)), axis=0)
    distinct = np.append(True, along > 0.0)
    place = np.append(0.0, np.cumsum(along))[distinct]
    line, calm = line[:, distinct], calm[distinct]
    count = place.size - 1
    at = np.interp(np.linspace(0.0, count, _FINE * count + 1), np.arange(count + 1), place)
    drawn = PchipInterpolator(place, line, axis=1)(at)
    solid = np.repeat(calm[:-1] & calm[1:], _FINE)
    # A point belongs to the pieces on both of its sides.
    return tuple(
        np.where(np.append(part[0], part) | np.append(part, part[-1]), drawn, np.nan)
        for part in (solid, ~solid)
    )  # type: ignore[return-value]


def _title(curve: xr.Dataset) -> str:
    """Return load and damping in the theory's symbols."""
    attrs = curve.attrs
    parts = [f"{attrs['load_symbol']} = {attrs['load_size']:g} {attrs['load_unit']}"]
    parts += [
        f"{symbol} = {attrs[f'damping_{name}']:.3g} {unit}"
        for name, (symbol, unit) in _DAMPINGS.items()
        if attrs[f"damping_{name}"]
    ]
    return ", ".join(parts)
