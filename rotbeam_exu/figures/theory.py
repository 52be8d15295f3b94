"""Figures 8 to 13: the reduced models by themselves."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes

from ..paper import MODEL_LINES, MODEL_NAMES
from .paper_figure import EXACT, EXACT_BEAM, listed, paper_figure
from .style import (
    column,
    columns,
    cycle,
    figure_of,
    house_axes,
    inset,
    label,
    model_line,
    ramp,
    typeset,
)

_NEAR = "Inset: the same near zero."
_SHORT_DASHES = ("-", (0, (2, 1)), (0, (1, 1)))  # what greys do not tell from the models'
_DASHES = ("-", "--", "-.", (0, (5, 1, 1, 1, 1, 1)), ":")
_ROUND_OFF = 1e-13
_COEFFICIENTS = "λ_ω of ω_NL = ω_n (1 − λ_ω a²) and λ_x of Eq. 65, a → 0,"
_RATIO = "Ω = ω/ω₀, ω₀ the first frequency at rest"


@paper_figure(
    shows=lambda data: (
        f"Backbones of the model CI ({MODEL_NAMES['CI']}), Eq. 63, at Ω = 0, 1 and → ∞, shaded "
        f"between; {EXACT}, at Ω = {listed(data['exact_speed_ratio'])}; {_RATIO}. Inset: the "
        "marked strip, of the same height. The model's a is the first harmonic of q/L, the exact "
        "beam's half peak to peak."
    ),
    claim=(
        "The paper states that all backbones lie in the shaded area. In the model they do, and at "
        "rest it is right; in rotation it softens far too much, because Eq. 25 drops −v'⁴/8."
    ),
)
def figure_8(data: xr.Dataset, ax: Axes | None = None) -> Axes:
    """Draw the backbones of CI between Ω = 0 and ∞, and the exact ones; the inset is near 1."""
    a, ratio, exact = data["amplitude"], data["ratio"], data["exact"]
    names = ("CI, Ω = 0", "CI, Ω = 1", "CI, Ω → ∞")
    line = model_line("exact")
    with house_axes(ax, column(), 3.2) as axes:
        near = inset(
            axes, (0.1, 0.1, 0.38, 0.5), xlim=(0.991, 1.005), ylim=(0.0, 0.4),
            xticks=(0.995, 1.0), yticks=(0.0, 0.2, 0.4),
        )  # fmt: skip
        for panel in (axes, near):
            panel.fill_betweenx(a, ratio[0], ratio[-1], color="0.92", lw=0)
            for row, color, dashes, name in zip(ratio, cycle(), _DASHES, names, strict=False):
                panel.plot(row, a, color=color, ls=dashes, label=name)
            for row, short in zip(exact, _SHORT_DASHES, strict=False):
                name = f"exact, Ω = {float(row['exact_speed_ratio']):g}"
                panel.plot(row, data["exact_amplitude"], **{**line, "ls": short}, label=name)
        axes.set(xlabel=label(ratio), ylabel=label(a), xlim=(0.76, 1.06), ylim=(0.0, 0.4))
        axes.indicate_inset((0.991, 0.0, 0.014, 0.4), edgecolor="0.5", alpha=1.0)
        axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.18), ncols=2)
    return axes


@paper_figure(
    shows=lambda _: (
        f"{_COEFFICIENTS} against {_RATIO}: the model CI ({MODEL_NAMES['CI']}); {EXACT}. {_NEAR}"
    ),
    claim=(
        "The paper states that softening grows with speed. In the model it does, because of Eq. "
        "25: the exact λ_ω stays below 0.025."
    ),
)
def figure_9(data: xr.Dataset, ax: Sequence[Axes] | None = None) -> Sequence[Axes]:
    """Draw λ_ω and λ_x of CI against Ω."""
    return _coefficients(data, "speed_ratio", ax, near=True)


@paper_figure(
    shows=lambda _: (
        f"{_COEFFICIENTS} against ω, inextensible, by the cantilever's mode (CI) and by "
        f"polynomials of degree 3, 4 and 5; {EXACT}. {_NEAR}"
    ),
    claim=(
        "The paper states that degree 5 is closest to the mode at low speed, and that degree 4 "
        "never hardens. We confirm this. From 4 rad/s on the effect of the shape is small compared "
        "with the distance from the exact beam; at rest only the mode is right."
    ),
)
def figure_10(data: xr.Dataset, ax: Sequence[Axes] | None = None) -> Sequence[Axes]:
    """Draw λ_ω and λ_x of the polynomial shapes and of the cantilever's mode against ω."""
    return _coefficients(data, "omega", ax, near=True)


@paper_figure(
    shows=lambda data: (
        f"{_COEFFICIENTS} against ω by the model CE ({MODEL_NAMES['CE']}) for several "
        f"slendernesses μ = I/(AL²); {data.attrs['held']}; dashed: {EXACT_BEAM}, of "
        "the same μ in the same color, up to 0.6 of the speed that stretches it without bound."
    ),
    claim=(
        "The paper does not state its μ. We reproduce the shape of the curves. The elongation by a "
        "sine is an assumption, and for a slender beam λ_ω changes in the wrong direction."
    ),
)
def figure_11(data: xr.Dataset, ax: Sequence[Axes] | None = None) -> Sequence[Axes]:
    """Draw λ_ω and λ_x of CE against ω for several slendernesses."""
    return _coefficients(data, "omega", ax)


def _coefficients(
    data: xr.Dataset, axis: str, ax: Sequence[Axes] | None, *, near: bool = False
) -> Sequence[Axes]:
    lines = _lines(data["model"].values.tolist())
    with house_axes(ax, columns(), 3.0, ncols=2) as axes:
        for panel, variable, letter in zip(axes, ("lambda_omega", "lambda_x"), "ab", strict=True):
            _rows(panel, data[axis], data[variable], lines)
            panel.set(xlabel=label(data[axis]), ylabel=label(data[variable]))
            panel.set_title(f"{letter})", loc="left")
        if near:
            around_zero = axes[0].inset_axes((0.5, 0.2, 0.5, 0.5))
            _rows(around_zero, data[axis], data["lambda_omega"], lines)
            around_zero.set_ylim(-0.05, 0.05)
            around_zero.tick_params(labelsize=6.0)
        figure = figure_of(axes[0])
        named = axes[0].get_legend_handles_labels()
        figure.legend(*named, loc="outside lower center", ncols=min(len(lines), 5))
    return tuple(axes)


def _rows(ax: Axes, x: xr.DataArray, rows: xr.DataArray, lines: dict[str, dict[str, Any]]) -> None:
    for (name, line), row in zip(lines.items(), rows, strict=True):
        ax.plot(x, row, **({"label": typeset(name)} | line))
    ax.axhline(0.0, color="0.7", lw=0.5)
    ax.set_xlim(0.0, float(x[-1]))


def _lines(names: Sequence[str]) -> dict[str, dict[str, Any]]:
    """Return how each row is drawn: "exact, μ = ..." dashed, in the color of "μ = ..."."""
    lines: dict[str, dict[str, Any]] = {}
    others = [name for name in names if name not in MODEL_LINES and "exact" not in name]
    colors = dict(zip(others, ramp(len(others)), strict=True))
    paired = any(name.startswith("exact, ") for name in names)
    looks = ("-",) * len(others) if paired else _DASHES[1:]
    for name in names:
        if name in colors:
            lines[name] = {"color": colors[name], "ls": looks[others.index(name)]}
        elif name in MODEL_LINES:
            lines[name] = model_line(name)
        else:
            of = name.removeprefix("exact, ")
            named = "exact, of the same μ" if of == others[0] else "_"
            lines[name] = {"color": colors[of], "ls": "--", "label": named}
    return lines


def _shows_12(data: xr.Dataset) -> str:
    first = [int(data["degree"][np.isfinite(row.to_numpy())][0]) for row in data["omega_n"]]
    return (
        "Distance of the natural frequency by Frobenius' series from its limit, over the degree N "
        f"of the polynomial, for even N, at ω = {listed(data['omega'])} rad/s. "
        f"Before N = {listed(first)} there is no point, because Eq. 86 has no root near the first "
        "frequency. Differences below 10⁻¹³ rad/s are round-off and not shown."
    )


@paper_figure(
    shows=_shows_12,
    claim="The paper uses degree 36. At 8 rad/s the error is 2.1·10⁻⁴ rad/s. Eq. 81 is corrected.",
)
def figure_12(data: xr.Dataset, ax: Axes | None = None) -> Axes:
    """Draw the distance of Frobenius' natural frequency from its limit over the degree."""
    off = np.abs(data["omega_n"] - data["converged"])
    degree = data.attrs["paper_degree"]
    with house_axes(ax, column(), 2.8) as axes:
        for row, color, mark in zip(off, cycle(), "osD^v<", strict=False):
            name = f"ω = {float(row['omega']):g} rad/s"
            # What is below is round-off.
            visible = row.where(row > _ROUND_OFF)
            axes.semilogy(
                data["degree"], visible, color=color, marker=mark, ms=2.5, lw=0.7, label=name
            )
        axes.axvline(degree, color="0.5", lw=0.5, ls=":")
        axes.annotate(
            "the paper's degree", (degree, 1.0), xycoords=("data", "axes fraction"),
            xytext=(3, -2), textcoords="offset points", va="top", color="0.4", fontsize=7,
        )  # fmt: skip
        axes.set(
            xlabel=f"{label(data['degree'])} N", ylabel="$|ω_n(N) - ω_n|$ [rad/s]",
            ylim=(_ROUND_OFF, 10.0),
        )  # fmt: skip
        axes.legend(loc="lower left")
    return axes


def _shows_13(data: xr.Dataset) -> str:
    rise = data["shape"][1:] - data["shape"][0]
    highest = [f"{float(row.max()):.3f}" for row in rise]
    return (
        "First mode shape, 1 at the tip, at rest and by Frobenius' series at "
        f"ω = {listed(data['omega'][1:])} rad/s. It lies above the cantilever's by up to "
        f"{', '.join(highest[:-1])} and {highest[-1]}, there at η/L = "
        f"{float(data['eta'][np.argmax(rise[-1].to_numpy())]):.2g}."
    )


@paper_figure(
    shows=_shows_13,
    claim="The paper states that the difference grows with speed. It does: tension straightens.",
)
def figure_13(data: xr.Dataset, ax: Axes | None = None) -> Axes:
    """Draw the first mode shape at rest and in rotation."""
    with house_axes(ax, column(), 2.6) as axes:
        for row, color, style in zip(data["shape"], ("0.5", *cycle()), _DASHES, strict=False):
            omega = float(row["omega"])
            name = "cantilever at rest" if omega == 0.0 else f"ω = {omega:g} rad/s"
            axes.plot(data["eta"], row, color=color, ls=style, label=name)
        axes.set(xlabel=label(data["eta"]), ylabel=label(data["shape"]), xlim=(0, 1), ylim=(0, 1))
        axes.legend(loc="upper left")
    return axes
