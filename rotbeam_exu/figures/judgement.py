"""What was judged of a case: its history over the reference, errors over mesh and step, cost."""

from __future__ import annotations

import io
import math
from collections.abc import Sequence
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes

from ..paper import BLUE, ORANGE
from ..verification.history import Histories
from ..verification.judgement import THRESHOLDS, Judgement
from ..verification.outcomes import Finding
from ..verification.submission import Run
from .style import COLUMNS, CYCLE, STYLE, new_figure

_SYMBOLS = {
    "linear frequency": "$ω_n$", "history": "$q(t)$", "amplitude": "$a$",
    "nonlinear shift": "$ω_{NL}/ω_n - 1$", "backbone": "$ω_{NL}/ω_n - 1$",
}  # fmt: skip
_MARKERS = "osD^v"
_MOST_POINTS = 3000  # of a curve: more are not seen


def judged_history(histories: Histories) -> Axes:
    """Draw q(t) of the finest run over the reference, and what each run is off by.

    Below, the largest difference up to each time: q(t) crosses zero, and so do differences.

    Returns
    -------
    Axes
        The upper ones, of a new figure.
    """
    _, (above, below) = new_figure(COLUMNS, 3.4, nrows=2, sharex=True)
    finest = histories.rows.finest
    every = max(1, finest.time.size // _MOST_POINTS)
    time = finest.time[::every]
    with mpl.rc_context(STYLE):
        above.plot(time, histories.reference.history(time), color="0.2", lw=2.2, label="reference")
        above.plot(time, finest.q[::every], color=ORANGE, lw=0.9, label=_name(finest))
        above.axhline(0.0, color="0.8", lw=0.5, zorder=0)
        above.set_ylabel("$q$ [m]")
        above.legend(loc="upper right", ncols=2, bbox_to_anchor=(1.0, 1.14))
        runs = list(dict.fromkeys((*histories.rows.meshes, *histories.rows.steps)))
        for run, color in zip(runs, _shades(len(runs)), strict=True):
            every = max(1, run.time.size // _MOST_POINTS)
            largest = np.maximum.accumulate(np.abs(histories.differences[run]))[::every]
            below.semilogy(run.time[::every], largest, color=color, label=_name(run))
        below.axhline(THRESHOLDS["history"], color="0.4", lw=0.7, ls=(0, (4, 2)))
        lowest = histories.reference.bound
        below.set(
            xlabel="time $t$ [s]", ylabel="largest difference\nso far / max|$q$|",
            xlim=(0.0, float(finest.time[-1])), ylim=(max(lowest, 1e-9), None),
        )  # fmt: skip
        below.legend(loc="lower right", ncols=3)
    upper: Axes = above
    return upper


def judged_errors(name: str, judgement: Judgement) -> Axes | None:
    """Draw what a case's meshes, steps and time bring: errors of discretization, and of q(t).

    Returns
    -------
    Axes or None
        The first ones, of a new figure; None if no quantity has two meshes.
    """
    findings = judgement.findings[name]
    drawn = {key: one for key, one in findings.items() if _has_errors(one)}
    if not drawn:
        return None
    histories = judgement.histories.get(name)
    timed = [run for run in histories.runs if run.wall > 0.0] if histories else []
    steps = histories.rows.steps if histories else ()
    count = 1 + bool(steps) + bool(timed)
    figure, grid = new_figure(COLUMNS / 3.0 * count, 2.5, ncols=count, squeeze=False)
    axes = list(grid[0])
    with mpl.rc_context(STYLE):
        _draw_meshes(axes[0], drawn, judgement.declaration.order)
        if histories and steps:
            _draw_steps(axes[1], histories, steps, judgement.declaration.order_in_step)
        if histories and timed:
            _draw_cost(axes[-1], histories, timed)
    figure.align_labels()
    first: Axes = axes[0]
    return first


def svg(axes: Axes) -> str:
    """Return the figure of `axes` as the text of an SVG, letters as curves, and close it."""
    import matplotlib.pyplot as plt  # noqa: PLC0415

    figure: Any = axes.get_figure(root=True)
    text = io.StringIO()
    with mpl.rc_context({**STYLE, "svg.fonttype": "path", "svg.hashsalt": "rotbeam"}):
        figure.savefig(text, format="svg", metadata={"Date": None})
    plt.close(figure)
    return text.getvalue()


def _name(run: Run) -> str:
    return f"{run.elements} × {1e3 * run.step:g} ms"


def _shades(count: int) -> list[Any]:
    """Return colors from light to dark."""
    return [mpl.colormaps["viridis_r"](0.15 + 0.8 * k / max(count - 1, 1)) for k in range(count)]


def _has_errors(found: Finding) -> bool:
    return found.runs is not None and math.isfinite(found.runs.limit) and found.runs.sizes.size > 1


def _draw_meshes(ax: Axes, findings: dict[str, Finding], declared: float | None) -> None:
    """Draw |run - limit| of each quantity with the bar of the limit, and the declared order."""
    largest = []
    styles = zip(findings.items(), CYCLE, _MARKERS, strict=False)
    for (quantity, found), color, marker in styles:
        assert found.runs is not None
        elements, errors = 1.0 / found.runs.sizes, np.abs(found.runs.errors)
        bars = np.minimum(found.runs.error_bars, 0.9 * errors), found.runs.error_bars
        ax.errorbar(
            elements, errors, yerr=bars, color=color, marker=marker, ms=3.5, capsize=2.0,
            elinewidth=0.6, label=_SYMBOLS[quantity],
        )  # fmt: skip
        largest.append((elements, errors))
    elements, errors = max(largest, key=lambda one: float(one[1][0]))
    if declared and errors[0]:
        line = 2.0 * errors[0] * (elements / elements[0]) ** -declared
        ax.plot(elements, line, color="0.5", lw=0.7, ls="--", label=f"order {declared:g}")
    ax.set(xscale="log", yscale="log", xlabel="elements", ylabel="|run - limit|, relative")
    _tick(ax, elements, "{:g}")
    ax.legend(loc="best")


def _draw_steps(
    ax: Axes, histories: Histories, steps: Sequence[Run], declared: float | None
) -> None:
    """Draw what q(t) changes from each step to the smallest."""
    finest = steps[-1]
    h = np.array([run.step for run in steps[:-1]]) * 1e3
    end = min(float(run.time[-1]) for run in steps)
    time = finest.time[finest.time <= end]
    last = histories.differences[finest][: time.size]
    changes = [
        float(np.abs(np.interp(time, run.time, histories.differences[run]) - last).max())
        for run in steps[:-1]
    ]
    ax.plot(h, changes, color=BLUE, marker="o", ms=3.5, label=f"{finest.elements} elements")
    if declared and changes[-1]:
        smallest = 1e3 * finest.step
        shape = h**declared - smallest**declared
        ax.plot(
            h, 2.0 * changes[-1] * shape / shape[-1], color="0.5", lw=0.7, ls="--",
            label=f"order {declared:g}",
        )  # fmt: skip
    ax.set(
        xscale="log", yscale="log", xlabel="step [ms]",
        ylabel=f"|run - run at {1e3 * finest.step:g} ms|",
    )  # fmt: skip
    _tick(ax, h, "{:g}")
    ax.legend(loc="best")


def _draw_cost(ax: Axes, histories: Histories, timed: Sequence[Run]) -> None:
    """Draw the error of q(t) over the time that it took, on the author's machine."""
    wall = np.array([run.wall for run in timed])
    error = np.array([float(np.abs(histories.differences[run]).max()) for run in timed])
    ax.plot(wall, error, color=ORANGE, marker="s", ms=3.5, ls="none")
    for run, x, y in zip(timed, wall, error, strict=True):
        ax.annotate(
            _name(run), (x, y), xytext=(0, 5), textcoords="offset points", fontsize=5.5,
            ha="center", color="0.25",
        )  # fmt: skip
    ax.set(
        xscale="log", yscale="log", xlabel="wall time [s]",
        ylabel="difference from reference, of $q(t)$",
    )  # fmt: skip
    ax.margins(0.25)


def _tick(ax: Axes, places: Any, form: str) -> None:
    """Label the meshes or steps themselves, not powers of ten."""
    ax.set_xticks(list(places), [form.format(float(f"{place:.4g}")) for place in places])
    ax.xaxis.set_minor_locator(mpl.ticker.NullLocator())
    ax.margins(0.12)
