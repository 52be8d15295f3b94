"""Figures 3, 4 and 15, coarse meshes spun up, their steady orbits and the models', and one run."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes

from ..paper import BLUE
from .paper_figure import listed, models, numerics, paper_figure
from .style import (
    column,
    columns,
    cycle,
    figure_of,
    house_axes,
    ink,
    inset,
    label,
    model_line,
    quantity,
    ramp,
    shade_ramp,
)

_DASHES = ((0, (1, 1)), (0, (5, 1, 1, 1)), "--")
_POINTS: Any = {
    "ls": "none", "marker": "o", "ms": 3.0, "mfc": "white", "mec": "black", "mew": 0.6, "zorder": 6,
}  # fmt: skip
_DASHES_OF_ORBITS = ("-.", (0, (5, 1)), (0, (3, 1, 1, 1)), (0, (1, 1)))


def _shows_3(data: xr.Dataset) -> str:
    attrs = data.attrs
    both = xr.concat([data["q"], data["exact"].expand_dims(elements=[0])], dim="elements")
    steady = both.where(data["time"] >= attrs["ramp_time"], drop=True)
    size, period = np.ptp(steady.to_numpy(), axis=1), [_period(row) for row in steady]
    off = [
        f"{_elements(int(n))}: {100.0 * (a / size[-1] - 1.0):+.1f} and "
        f"{100.0 * (p / period[-1] - 1.0):+.1f} %"
        for n, a, p in zip(data["elements"].to_numpy(), size, period, strict=False)
    ]
    return (
        f"Tip displacement with {listed(data['elements'])} elements, brought to "
        f"ω = {attrs['omega']:g} rad/s in T = {attrs['ramp_time']:g} s; black: the geometrically "
        "exact beam. Shaded: spin-up; inset: the last quarter of the steady rotation. "
        f"Amplitude and period of the steady oscillation, compared with the exact beam: "
        f"{'; '.join(off)}. {numerics(data)}"
    )


@paper_figure(
    shows=_shows_3,
    claim=(
        "The paper states that even one element gives a stable solution. We confirm this; the "
        "phase of the steady oscillation needs more."
    ),
)
def figure_3(data: xr.Dataset, ax: Axes | None = None) -> Axes:
    """Draw the tip displacement of coarse meshes, and the exact one; the inset shows phases."""
    ramp_time, end = float(data.attrs["ramp_time"]), float(data["time"][-1])
    last = data["q"].where(data["time"] >= end - 0.25 * (end - ramp_time), drop=True)
    height = 1.15 * float(np.abs(last).max())
    with house_axes(ax, column(), 2.9) as axes:
        within = {"xlim": (last["time"][0], end), "ylim": (-height, height)}
        near = inset(axes, (0.52, 0.14, 0.46, 0.48), **within)
        shade_ramp(axes, ramp_time)
        for panel in (axes, near):
            panel.plot(data["time"], data["exact"], label="exact", **model_line("exact"))
            colors = ramp(data.sizes["elements"])
            for row, color, style in zip(data["q"], colors, _DASHES, strict=False):
                name = _elements(int(row["elements"]))
                panel.plot(data["time"], row, color=color, ls=style, label=name)
        low = float(data["q"].min())
        axes.set(
            xlabel=label(data["time"]), ylabel=label(data["q"]), xlim=(0.0, end),
            ylim=(1.08 * low, 0.2 * abs(low)),
        )  # fmt: skip
        axes.indicate_inset_zoom(near, edgecolor="0.5", alpha=1.0)
        axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.18), ncols=2)
        axes.set_title(_motion(data), loc="left")
    return axes


def _motion(data: xr.Dataset) -> str:
    attrs = data.attrs
    return f"ω = {quantity(attrs['omega'], 'rad/s')}, T = {quantity(attrs['ramp_time'], 's')}"


def _elements(count: int) -> str:
    return f"{count} element{'s' if count > 1 else ''}"


def _period(q: xr.DataArray) -> float:
    """Return the mean distance of upward zero crossings."""
    time, x = q["time"].to_numpy(), q.to_numpy()
    before = np.flatnonzero((x[:-1] < 0.0) & (x[1:] >= 0.0))
    crossed = time[before] - x[before] * np.diff(time)[before] / np.diff(x)[before]
    return float(np.diff(crossed).mean())


def _shows_4(data: xr.Dataset) -> str:
    smeared = data.isel(case=int(np.argmax(data["smear"].to_numpy())))
    return (
        f"Steady orbits of the tip with {data.attrs['elements']} elements, a) by ramp time, b) by "
        "speed, with the same scale; grey: the case in both. Lines: the first turn; pale: all "
        "turns. The normalization is that of Eqs. 17 and 18, with the mass m = ρAL: "
        "q₀ = mωL⁴/(T(EI + mω²L³)) and, corrected, q̇₀ = q₀√(EI/mL³ + ω²). "
        f"{numerics(data)} The orbit of ω = {float(smeared['omega']):g} "
        f"rad/s, T = {float(smeared['ramp_time']):g} s is smeared: "
        f"{100.0 * float(smeared['smear']):.1f} % of its velocity belongs to the second mode, "
        "which such a short ramp excites, too."
    )


@paper_figure(
    shows=_shows_4,
    claim="The paper states that orbits of large amplitude are distorted. We confirm this.",
)
def figure_4(data: xr.Dataset, ax: Sequence[Axes] | None = None) -> Sequence[Axes]:
    """Draw normalized steady orbits: (a) by ramp time, (b) by speed.

    The first turn is the line; all turns lie behind it, pale. A case that both panels have looks
    the same in both, and they have one scale.
    """
    width, height = (1.08 * float(np.abs(data[name]).max()) for name in ("q_bar", "q_dot_bar"))
    keys = list(zip(data["omega"].values.tolist(), data["ramp_time"].values.tolist(), strict=True))
    fresh = iter(zip(cycle(), _DASHES_OF_ORBITS, strict=False))
    looks: dict[object, tuple[str, Any]]
    looks = {key: ("0.4", "-") for key in keys if keys.count(key) > 1}
    with house_axes(ax, columns(), 2.9, ncols=2) as axes:
        for case, key in enumerate(keys):
            if key not in looks:
                looks[key] = next(fresh)
            (color, dashes), row = looks[key], data.isel(case=case)
            letter = row["panel"].item()
            panel = axes["ab".index(letter)]
            q, rate = row["q_bar"].to_numpy(), row["q_dot_bar"].to_numpy()
            names = f"ω = {key[0]:g} rad/s", f"T = {key[1]:g} s"
            held, name = names if letter == "a" else names[::-1]
            once = _first_turn(q, rate)
            panel.plot(q, rate, color=color, lw=0.4, alpha=0.25)
            panel.plot(q[once], rate[once], color=color, ls=dashes, label=name)
            panel.set_title(f"{letter}) {held}", loc="left")
        for panel in axes:
            panel.set(
                xlabel=label(data["q_bar"]), ylabel=label(data["q_dot_bar"]),
                xlim=(-width, width), ylim=(-height, height),
            )  # fmt: skip
            panel.legend(loc="center")
    return tuple(axes)


def _first_turn(q: Any, rate: Any) -> slice:
    """Return the samples of an orbit once around."""
    turned = np.unwrap(np.arctan2(rate, q)[np.isfinite(q)])
    around = np.flatnonzero(np.abs(turned - turned[0]) >= 2.0 * np.pi)
    return slice(0, int(around[0]) + 1 if around.size else None)


@paper_figure(
    shows=lambda data: (
        f"One period of the tip's orbit at ω = {data.attrs['omega']:g} rad/s, "
        f"T = {data.attrs['ramp_time']:g} s: finite elements, {models(data)} and the exact beam at "
        f"the same peak |q|/L = {data.attrs['amplitude']:.4f}. a) Dots: the end of each orbit; "
        "inset: orbits that end near the start. b) Radial deviation from the exact orbit, both in "
        f"units of its half axes. {numerics(data)}"
    ),
    claim=(
        "The paper states that FrI is close but open, with too low a frequency, and that CI and "
        "CE are significantly inaccurate. It does not state T. At T = 3.375 and 3.25 s (a = 0.20, "
        "0.23) the paper's order of the models holds: FrI deviates by 3.0 and 3.4 % of the half "
        "axes, CI by 4.3 and 3.9 %, CE by 6 %. From T = 3 s on (a = 0.32) it does not: FrI "
        "deviates by 6.2 % and misses its start by 35 %, CI only by 2.3 and 7.5 %, because its "
        "errors of ω_n and of the softening cancel. FrI's frequency is too low at every T. At "
        "T = 3 s FrM, FrC and FrE close to 1.2 %. FrC and FrE deviate by 2 %, because they lack "
        "the second harmonic, which Coriolis forces cause; FrM has it and deviates by 0.2 %."
    ),
)
def figure_15(data: xr.Dataset, ax: Sequence[Axes] | None = None) -> Sequence[Axes]:
    """Draw the orbits of models, exact beam and finite elements over one period of the latter.

    (a) A dot marks the end of each orbit; the inset shows the orbits that end near the start.
    (b) Distance from the origin, in units of the exact half axes, less that of the exact orbit.
    """
    amplitude = float(data.attrs["amplitude"])
    fastest = float(data["q_dot_bar"].sel(model="finite element").max())
    with house_axes(ax, columns(), 3.4, ncols=2) as (axes, apart):
        near = inset(
            axes, (0.31, 0.28, 0.35, 0.44), xlim=(0.9 * amplitude, 1.02 * amplitude),
            ylim=(-0.45 * fastest, 0.45 * fastest), xticks=[], yticks=[],
        )  # fmt: skip
        for panel in (axes, near):
            _orbits(panel, data)
        axes.indicate_inset_zoom(near, edgecolor="0.5", alpha=1.0)
        axes.set(xlabel=label(data["q_bar"]), ylabel=label(data["q_dot_bar"]))
        axes.set_title(f"a) ω = {data.attrs['omega']:g} rad/s, a = {amplitude:.4f}", loc="left")
        _deviations(apart, data)
        axes.plot([], [], "o", color="0.4", ms=4.0, label="end of the period")
        figure = figure_of(axes)
        figure.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncols=5)
    return axes, apart


def _deviations(ax: Axes, data: xr.Dataset) -> None:
    """Draw how far outside the exact orbit the others lie, over the angle around it."""
    exact = data.sel(model="exact")
    half_axes = [np.abs(exact[name]).max() for name in ("q_bar", "q_dot_bar")]

    def around(model: str) -> tuple[Any, Any]:
        q, rate = (data[k].sel(model=model) for k in ("q_bar", "q_dot_bar"))
        z = (q / half_axes[0] - 1j * rate / half_axes[1]).to_numpy()
        return np.degrees(np.unwrap(np.angle(z))), np.abs(z)

    on = around("exact")
    for model in data["model"].values.tolist():
        angle, radius = around(model)
        off = 100.0 * (radius / np.interp(angle, *on, period=360.0) - 1.0)
        if model == "finite element":
            ax.plot(angle[::8], off[::8], **_POINTS)
        else:
            ax.plot(angle, off, **model_line(model))
    ax.set(
        xlabel="angle around the orbit [°]", ylabel="radial deviation [%]", xlim=(0.0, 360.0),
        xticks=range(0, 361, 90),
    )  # fmt: skip
    ax.set_title("b) distance from the exact orbit", loc="left")


def _orbits(ax: Axes, data: xr.Dataset) -> None:
    for model in data["model"].values.tolist():
        q, rate = (data[name].sel(model=model) for name in ("q_bar", "q_dot_bar"))
        if model == "finite element":
            ax.plot(q[::8], rate[::8], **_POINTS, label=f"{data.attrs['elements']} elements")
            continue
        line = model_line(model)
        ax.plot(q, rate, label=model, **line)
        ax.plot(q[-1], rate[-1], marker="o", ms=4.0, color=line["color"], zorder=7)


def spin_up(run: xr.Dataset, ax: Sequence[Axes] | None = None) -> tuple[Axes, Axes]:
    """Draw q(t), the ramp shaded, and the steady orbit (q, q_dot) of a run by `simulate`.

    On two Axes, of the time history and of phase space.
    """
    ramp_time, end = float(run.attrs["ramp_time"]), float(run["time"][-1])
    steady = run.where(run["time"] >= ramp_time, drop=True)
    with house_axes(ax, columns(), 2.6, ncols=2, width_ratios=(1.7, 1.0)) as (history, phase):
        shade_ramp(history, ramp_time)
        history.axhline(0.0, color="0.6", lw=0.5)
        history.plot(run["time"], run["q"], color=ink(BLUE))
        history.set(xlabel=label(run["time"]), ylabel=label(run["q"]), xlim=(0.0, end))
        history.set_title(
            f"{_motion(run)}, {run.attrs['elements']} {run.attrs['element']} elements",
            loc="left",
        )
        phase.plot(steady["q"], steady["q_dot"], color=ink(BLUE), lw=0.6)
        phase.set(xlabel=label(run["q"]), ylabel=label(run["q_dot"]))
        phase.set_title(f"steady orbit, t > {quantity(ramp_time, 's')}", loc="left")
    return history, phase
