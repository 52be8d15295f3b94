"""Results over one number: speed, frequency, amplitude, ramp time or number of substructures."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import matplotlib as mpl
import numpy as np
import xarray as xr
from cycler import cycler
from matplotlib.axes import Axes

from analytic.exact.linear.campbell import Campbell
from analytic.plotting import FOLD, UNSTABLE, backbone_drawn, draw_response

from ..paper import BLUE, ORANGE, RED
from .style import column, cycle, house_axes, ink, label, quantity, ramp, takes_own

_GROWTH = {"period doubling": ("s", BLUE), "divergence": ("^", RED), "sum resonance": ("o", ORANGE)}
_DAMPINGS = {"bending": ("$η_b$", "s"), "axial": ("$η_a$", "s"), "external": ("$d$", "kg/(m s)")}


@takes_own
def campbell(diagram: Campbell, ax: Axes | None = None, *, highest: float | None = None) -> Axes:
    """Draw lag, flap and torsional frequencies over the speed, and the lines kω.

    Parameters
    ----------
    diagram : Campbell
        As made by `analytic.campbell`.
    ax : Axes, optional
        Drawn on these; otherwise on a new figure.
    highest : float, optional
        Frequency [rad/s] up to which is drawn; otherwise all are.
    """
    with (
        house_axes(ax, column(), 3.2, layout="constrained") as axes,
        mpl.rc_context({"axes.prop_cycle": cycler(color=cycle())}),
    ):
        return diagram.plot(axes, highest=highest)


@takes_own
def forced_response(data: xr.Dataset | Sequence[xr.Dataset], ax: Axes | None = None) -> Axes:
    """Draw response curves as `ForcedResponse.plot` does, and the backbone thin.

    Parameters
    ----------
    data : Dataset or sequence of Dataset
        As made by `rotbeam_exu.dataset_of`; several of one blade under one kind of load, at one
        speed.
    ax : Axes, optional
        Drawn on these; otherwise on a new figure.
    """
    curves = [data] if isinstance(data, xr.Dataset) else list(data)
    highest = max(curves, key=lambda curve: float(curve["amplitude"].max()))
    folds = [curve["mark"].to_numpy() == "fold" for curve in curves]
    with house_axes(ax, column(), 3.2) as axes:
        for curve, fold, color in zip(curves, folds, ramp(len(curves)), strict=True):
            nu, a, stable = (curve[k].to_numpy() for k in ("frequency", "amplitude", "stable"))
            draw_response(axes, nu, a, stable, fold, color=color, label=_title(curve))
        if "backbone_frequency" in highest:
            free = highest["backbone_frequency"].to_numpy()
            line = backbone_drawn(free, highest["backbone_amplitude"].to_numpy())
            axes.plot(*line, color="0.3", lw=0.5, zorder=1, label="backbone")
            axes.set_title(f"ω = {quantity(highest.attrs['omega'], 'rad/s')}", loc="left")
        if any(not curve["stable"].all() for curve in curves):
            axes.plot([], [], color="0.3", label="unstable", **UNSTABLE)
        if any(fold.any() for fold in folds):
            axes.plot([], [], mec="0.3", label="fold", **FOLD)
        axes.set(
            xlabel=label(highest["frequency"]), ylabel=label(highest["amplitude"]),
            xlim=(highest["frequency"][0], highest["frequency"][-1]), ylim=(0.0, None),
        )  # fmt: skip
        axes.xaxis.set_major_locator(mpl.ticker.MaxNLocator(6, steps=[1, 2, 5, 10]))
        axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=2, columnspacing=1.2)
    return axes


def _title(curve: xr.Dataset) -> str:
    """Return load and damping in the theory's symbols."""
    attrs = curve.attrs
    parts = [f"{attrs['load_symbol']} = {quantity(attrs['load_size'], attrs['load_unit'])}"]
    parts += [
        f"{symbol} = {quantity(attrs[f'damping_{name}'], unit, 3)}"
        for name, (symbol, unit) in _DAMPINGS.items()
        if attrs[f"damping_{name}"]
    ]
    return ", ".join(parts)


@takes_own
def planar_stability(data: xr.Dataset, ax: Axes | None = None) -> Axes:
    """Draw the growth rate out of the plane over the amplitude, at one speed."""
    a, rate = data["a"].to_numpy(), data["growth_rate"].to_numpy()
    kinds, stable = data["kind"].to_numpy(), rate == 0.0
    with house_axes(ax, column(), 2.6) as axes:
        for kind, (mark, color) in _GROWTH.items():
            here = kinds == kind
            if here.any():
                axes.plot(a[here], rate[here], mark, color=ink(color), ms=3.5, label=kind)
        axes.plot(
            a[stable], np.zeros(stable.sum()), "o", color="black", ms=3, label="stays in plane",
            transform=axes.get_xaxis_transform(), clip_on=False,
        )  # fmt: skip
        limit = float(data.get("limit", np.inf))
        if np.isfinite(limit):
            axes.axvline(limit, color="0.5", lw=0.7, ls="--", label=f"limit, a = {limit:.3g}")
        if stable.all():
            axes.set(ylim=(0.0, 1.0), yticks=[0.0])
        else:
            axes.set_yscale("log")
        axes.set(xlabel=label(data["a"]), ylabel=label(data["growth_rate"]), xlim=(0.0, None))
        axes.set_title(f"ω = {quantity(data.attrs['omega'], 'rad/s')}", loc="left")
        axes.legend()
    return axes


@takes_own
def residual(data: xr.Dataset, ax: Axes | None = None) -> Axes:
    """Draw the amplitude left over the ramp time: closed form, exact, by elements, quiet ramps."""
    times, blue, red = data["ramp_time"], ink(BLUE), ink(RED)
    points: dict[str, dict[str, Any]] = {
        "exact": {"color": "black", "marker": "o", "ms": 3.5, "label": "exact transient"},
        "finite_element": {
            "color": "black", "marker": "s", "ms": 6, "mew": 0.8, "mfc": "none",
            "label": "finite elements",
        },
        "quiet": {"color": red, "marker": "v", "ms": 5, "label": "quiet ramps"},
    }  # fmt: skip
    with house_axes(ax, column(), 3.2) as axes:
        axes.semilogy(times, data["linear"], color=blue, label="linear modes, closed form")
        corrected = {"ls": "--", "lw": 0.8, "label": "corrected by the backbone"}
        axes.semilogy(times, data["corrected"], color=blue, **corrected)
        for name, look in points.items():
            if data[name].size:
                at, clipped = data[f"{name}_ramp_time"], name == "quiet"
                axes.semilogy(at, data[name], ls="none", clip_on=clipped, **look)
        for T, left in zip(data["quiet_ramp_time"].values, data["quiet"].values, strict=True):
            axes.annotate(
                quantity(T, "s", 3), (T, left), xytext=(0, -5),
                textcoords="offset points", ha="center", va="top", size=6.5, color=red,
            )  # fmt: skip
        lowest = float(np.nanmin(np.append(data["linear"], data["quiet"])))
        axes.set(
            xlabel=label(times), ylabel="residual amplitude $|q|/L$",
            xlim=(float(times[0]), float(times[-1])), ylim=(0.3 * lowest, 1.5),
        )  # fmt: skip
        axes.set_title(f"ω = {quantity(data.attrs['omega'], 'rad/s')}", loc="left")
        axes.legend(loc="upper right")
    return axes


@takes_own
def divergence_speed(data: xr.Dataset, ax: Axes | None = None) -> Axes:
    """Draw the divergence speed over the number of substructures, for either frame."""
    omega_0, counts = float(data.attrs["omega_0"]), data["substructures"]
    with house_axes(ax, column(), 2.6) as axes:
        axes.axhline(omega_0, color="0.6", lw=0.5)
        place = (int(counts[-1]), omega_0)
        axes.annotate("$ω_0$", place, xytext=(0, 3), textcoords="offset points", ha="right")
        for frame, color, mark in (("tangent", BLUE, "o"), ("pinned", ORANGE, "s")):
            speeds = data["divergence_speed"].sel(frame=frame)
            name = f"{frame} frames"
            axes.plot(counts, speeds, color=ink(color), marker=mark, ms=3.0, label=name)
        axes.set(xscale="log", yscale="log", xlabel=label(counts), ylabel=label(speeds))
        axes.xaxis.set_major_locator(mpl.ticker.FixedLocator([float(n) for n in counts]))
        axes.xaxis.set_major_formatter(mpl.ticker.ScalarFormatter())
        axes.xaxis.set_minor_locator(mpl.ticker.NullLocator())
        axes.legend()
    return axes
