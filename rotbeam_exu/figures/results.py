"""Results over one number, as speed, frequency, amplitude or ramp time, and maps over two."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import matplotlib as mpl
import numpy as np
import xarray as xr
from matplotlib.axes import Axes

from analytic.arrays import FloatArray
from analytic.exact.linear.campbell import Campbell
from analytic.plotting import FOLD, UNSTABLE, backbone_drawn, draw_response
from analytic.sensitivity import Sensitivity, Spread
from analytic.theory import BERNOULLI_EULER

from ..paper import BLUE, ORANGE, RED
from ..runs.attributes import theory_of
from .style import colormap, column, house_axes, ink, label, quantity, ramp

_GROWTH = {"period doubling": ("s", BLUE), "divergence": ("^", RED), "sum resonance": ("o", ORANGE)}
_DAMPINGS = {"bending": ("$η_b$", "s"), "axial": ("$η_a$", "s"), "external": ("$d$", "kg/(m s)")}


def campbell(
    diagram: Campbell,
    ax: Axes | None = None,
    *,
    highest: float | None = None,
    deviations: FloatArray | None = None,
) -> Axes:
    """Draw lag, flap and torsional frequencies over the speed, and the lines kω.

    Up to the frequency `highest` [rad/s], or all; with bands of two standard `deviations`.
    """
    with house_axes(ax, column(), 3.2) as axes:
        return diagram.plot(axes, highest=highest, deviations=deviations)


def tornado(found: Sensitivity | Spread, output: str | None = None, ax: Axes | None = None) -> Axes:
    """Draw what most changes an output, or most adds to its deviation; the first by default."""
    with house_axes(ax, column(), 2.6) as axes:
        return found.plot(output, axes)


def over_time(found: Spread, number: str = "tip y", ax: Axes | None = None) -> Axes:
    """Draw a number of a spin-up over time with its band, as `Spread.plot_over_time` does."""
    with house_axes(ax, column(), 2.2) as axes:
        return found.plot_over_time(number, axes)


def forced_response(data: xr.Dataset | Sequence[xr.Dataset], ax: Axes | None = None) -> Axes:
    """Draw response curves as `ForcedResponse.plot` does, and the backbone thin.

    Several are of one blade under one kind of load, at one speed.
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
            axes.set_title(_of(highest), loc="left")
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


def _of(data: xr.Dataset) -> str:
    """Return the speed, and the theory where it is another than Bernoulli and Euler's."""
    speed, theory = f"ω = {quantity(data.attrs['omega'], 'rad/s')}", theory_of(data.attrs)
    return speed if theory == BERNOULLI_EULER else f"{speed}, {theory}"


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
        axes.set_title(_of(data), loc="left")
        axes.legend()
    return axes


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
        axes.semilogy(times, data["linear"], color=blue, label=f"{data.attrs['mode']}, closed form")
        more, name = data["corrected"], "corrected by the backbone"
        if not np.isfinite(more).any():
            more, name = data["all_modes"], "lowest modes together"
        axes.semilogy(times, more, color=blue, ls="--", lw=0.8, label=name)
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
            xlabel=label(times), ylabel="residual amplitude over $L$",
            xlim=(float(times[0]), float(times[-1])), ylim=(0.3 * lowest, 1.5),
        )  # fmt: skip
        axes.set_title(f"ω = {quantity(data.attrs['omega'], 'rad/s')}", loc="left")
        axes.legend(loc="upper right")
    return axes


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


def growth_out_of_plane(data: xr.Dataset, ax: Axes | None = None) -> Axes:
    """Draw where planar orbits leave their plane, over speed and amplitude; white stays in it.

    The line is where growth begins: the limit, and below it the tongues. It is smooth with damping,
    where what is stable decays. Gray is where no orbit was found.
    """
    omega, a, rate = data["omega"].to_numpy(), data["a"].to_numpy(), data["growth_rate"].to_numpy()
    with house_axes(ax, column(), 3.2) as axes:
        axes.set_facecolor("0.8")
        where_orbits_are = np.ma.masked_invalid(rate.T)
        shade = mpl.colormaps[colormap("YlOrRd")](0.2)
        axes.contourf(omega, a, where_orbits_are, [-np.inf, 0.0, np.inf], colors=["white", shade])
        axes.contour(omega, a, where_orbits_are, [0.0], colors="black", linewidths=0.7)
        axes.plot([], [], color="black", lw=0.7, label="limit and tongues")
        axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=2)
        axes.text(0.03, 0.6, "leaves the plane", transform=axes.transAxes)
        axes.text(0.97, 0.1, "stable in the plane", transform=axes.transAxes, ha="right")
        axes.set(
            xlabel=label(data["omega"]), ylabel=label(data["a"]), yscale="log",
            xlim=(omega[0], omega[-1]), ylim=(a[0], a[-1]),
        )  # fmt: skip
        levels = [level for level in (0.01, 0.02, 0.05, 0.1, 0.2, 0.5) if a[0] <= level <= a[-1]]
        axes.set_yticks(levels, [f"{level:g}" for level in levels])
        axes.set_yticks([], minor=True)
    return axes
