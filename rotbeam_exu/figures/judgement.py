"""A judged case: its history over the reference, errors over mesh and step, cost."""

from __future__ import annotations

import io
import math
import re
from collections.abc import Iterator, Mapping
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes

from ..paper import ORANGE
from ..verification.convergence import Convergence
from ..verification.history import Histories
from ..verification.judgement import THRESHOLDS, Judgement
from ..verification.submission import Run
from .style import STYLE, columns, cycle, figure_of, ink, new_figure

_SYMBOLS = {
    "linear frequency": "$ω_n$", "history": "$q(t)$", "amplitude": "$a$",
    "nonlinear shift": "$ω_{NL}/ω_n - 1$", "backbone": "$ω_{NL}/ω_n - 1$",
    "frequencies": "$ω_k$", "steady deflection": "tip",
}  # fmt: skip
_UNITS = {"q": "m", "lag": "m", "flap": "m", "twist": "rad"}
_MARKERS = "osD^v"
_MOST_POINTS = 1000  # of a curve: more are not seen


def judged_figures(name: str, judgement: Judgement) -> Iterator[tuple[str, str]]:
    """Yield the figures of a case, each as the text of an SVG with its caption.

    Its history, if there is one, and its errors, if a quantity has two meshes.
    """
    histories, declared = judgement.histories.get(name), judgement.declaration
    with mpl.rc_context(STYLE):
        if histories is not None:
            caption = (
                f"{name}: the finest run over the reference, and the largest difference of each "
                "run up to each time; dashed: the threshold for a limit."
            )
            yield svg(_history(histories)), caption
        drawn = {  # what has a limit
            quantity: one.runs
            for quantity, one in judgement.findings[name].items()
            if one.runs is not None and math.isfinite(one.runs.limit)
        }
        if not drawn:
            return
        steps = any(np.unique(runs.steps).size > 1 for runs in drawn.values())
        timed = histories is not None and any(run.wall > 0.0 for run in histories.runs)
        count = 1 + steps + timed
        axes = new_figure(columns() / 3.0 * count, 2.5, ncols=count, squeeze=False)[1][0]
        _draw_errors(axes[0], drawn, declared.order)
        axes[0].set(xlabel="elements", ylabel="error of the mesh")
        if steps:
            refined = next(iter(drawn.values())).refined
            _draw_errors(axes[1], drawn, declared.order_in_step, in_step=True)
            unit = " [ms]" * (refined == "step")
            axes[1].set(xlabel=f"{refined}{unit}", ylabel=f"error of the {refined}")
        if histories and timed:
            _draw_cost(axes[-1], histories)
        machine = declared.machine or "the author's machine"
        caption = f"{name}: distance from the limit by the mesh{' and by the step' * steps}"
        caption += f", with the limit's uncertainty{f'; error and time on {machine}' * timed}."
        yield svg(axes[0]), caption


def svg(axes: Axes) -> str:
    """Return the figure of `axes` as an SVG element for a page, small, and close it."""
    import matplotlib.pyplot as plt  # noqa: PLC0415

    figure = figure_of(axes)
    text = io.StringIO()
    # Letters as text, in one font: curves of letters, or all fonts' names, are most of a file.
    letters: Any = {"svg.fonttype": "none", "font.sans-serif": ["DejaVu Sans", "Arial"]}
    with mpl.rc_context({**STYLE, **letters}):
        figure.savefig(text, format="svg", metadata={"Date": None})
    plt.close(figure)
    element = text.getvalue()[text.getvalue().index("<svg") :]
    small = re.sub(r"<metadata>.*?</metadata>|<!--.*?-->", "", element, flags=re.DOTALL)
    # Hundredths of a point are not seen; only markers and clips are referred to.
    small = re.sub(r'(?<=[ "(]|-)(\d+\.\d\d)\d+', r"\1", re.sub(r"\s*\n\s*", " ", small))
    return re.sub(r' id="[\w.]+_\d+"', "", small)


def _history(histories: Histories) -> Axes:
    """Draw q(t) of the finest run over the reference, and what each run is off by.

    Below, the largest difference up to each time: q(t) crosses zero, and so do differences.
    """
    _, (above, below) = new_figure(columns(), 3.4, nrows=2, sharex=True)
    finest = histories.finest
    every = max(1, finest.time.size // _MOST_POINTS)
    time = finest.time[::every]
    # In space the component that is off by most.
    worst = np.abs(histories.differences[finest]).reshape(finest.time.size, -1).max(axis=0).argmax()
    true, mine = (
        q.reshape(time.size, -1)[:, worst]
        for q in (histories.reference.history(time), finest.q[::every])
    )
    above.plot(time, true, color="0.2", lw=2.2, label="reference")
    above.plot(time, mine, color=ink(ORANGE), lw=0.9, label=_name(finest))
    above.axhline(0.0, color="0.8", lw=0.5, zorder=0)
    name = histories.case.columns[worst]
    above.set_ylabel(f"{'$q$' if name == 'q' else name} [{_UNITS[name]}]")
    above.legend(loc="upper right", ncols=2, bbox_to_anchor=(1.0, 1.14))
    for run, color in _colors(histories).items():
        every = max(1, run.time.size // _MOST_POINTS)
        off = np.abs(histories.differences[run]).reshape(run.time.size, -1).max(axis=1)
        largest = np.maximum.accumulate(off)[::every]
        below.semilogy(run.time[::every], largest, color=color, label=_name(run))
    below.axhline(THRESHOLDS["history"], color="0.4", lw=0.7, ls=(0, (4, 2)))
    below.set(
        xlabel="time $t$ [s]", ylabel="largest difference\nso far / max|$q$|",
        xlim=(0.0, float(finest.time[-1])), ylim=(max(histories.reference.bound, 1e-9), None),
    )  # fmt: skip
    below.legend(loc="lower right", ncols=3)
    upper: Axes = above
    return upper


def _name(run: Run) -> str:
    return f"{run.elements} × {run.step_in_words}"


def _colors(histories: Histories) -> dict[Run, object]:
    """Return a color for each run, from light to dark, the finest last."""
    runs = sorted(histories.runs, key=lambda run: run.fineness)
    shades = np.linspace(0.3, 1.0, len(runs))
    return dict(zip(runs, map(mpl.colormaps["viridis_r"], shades), strict=True))


def _draw_errors(
    ax: Axes,
    convergences: Mapping[str, Convergence],
    declared: float | None,
    *,
    in_step: bool = False,
) -> None:
    """Draw the errors of meshes or steps, the limit's error bar, and the declared order above."""
    top, places = 0.0, np.empty(0)
    scale = 1e3 if next(iter(convergences.values())).refined == "step" else 1.0
    for (quantity, runs), color, marker in zip(
        convergences.items(), cycle(), _MARKERS, strict=False
    ):
        sizes, parts = (
            (scale * runs.steps, runs.in_step) if in_step else (runs.elements, runs.in_mesh)
        )
        places, first = np.unique(sizes, return_index=True)
        errors = np.maximum(np.abs(parts[first]), 1e-16)
        bars = np.minimum(runs.bar, 0.9 * errors), np.full(errors.size, runs.bar)
        ax.errorbar(
            places, errors, yerr=bars, color=color, marker=marker, ms=3.5, capsize=2.0,
            elinewidth=0.6, label=_SYMBOLS[quantity],
        )  # fmt: skip
        top = max(top, float(errors.max()))
    if declared:
        falls = (places / places[-1]) ** declared if in_step else (places[0] / places) ** declared
        ax.plot(
            places, 2.5 * top * falls, color="0.5", lw=0.7, ls="--", label=f"order {declared:g}"
        )
    ax.set(xscale="log", yscale="log")
    ax.set_xticks(places, [f"{float(f'{place:.4g}'):g}" for place in places])
    ax.xaxis.set_minor_locator(mpl.ticker.NullLocator())
    ax.margins(0.12)
    _whole_decades(ax)
    ax.legend(loc="best")


def _draw_cost(ax: Axes, histories: Histories) -> None:
    """Draw the error of q(t) over the time that it took, on the author's machine."""
    for run, color in _colors(histories).items():
        if run.wall > 0.0:
            error = float(np.abs(histories.differences[run]).max())
            ax.plot(run.wall, error, color=color, marker="s", ms=4.5, ls="none", label=_name(run))
    ax.set(xscale="log", yscale="log", xlabel="wall time [s]")
    ax.set_ylabel("|run − reference|, of $q(t)$")
    ax.margins(0.2)
    _whole_decades(ax)
    low, high = ax.get_xlim()
    ax.set_xlim(low / 1.3, 1.3 * high)
    ax.xaxis.set_minor_formatter(mpl.ticker.NullFormatter())
    if high / low < 10.0:  # round times where no power of ten is in sight
        ax.xaxis.set_major_locator(mpl.ticker.LogLocator(subs=(1.0, 2.0, 5.0)))
        ax.xaxis.set_major_formatter(mpl.ticker.FormatStrFormatter("%g"))
    ax.legend(loc="best")


def _whole_decades(ax: Axes) -> None:
    """Let the axis of errors begin and end at powers of ten, and label these alone."""
    low, high = ax.get_ylim()
    ax.set_ylim(10.0 ** math.floor(math.log10(low)), 10.0 ** math.ceil(math.log10(high)))
    ax.yaxis.set_minor_locator(mpl.ticker.NullLocator())
