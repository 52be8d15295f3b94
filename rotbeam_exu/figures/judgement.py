"""A judged case: its history over the reference, errors over mesh and step, cost."""

from __future__ import annotations

import io
import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from numpy.typing import ArrayLike

from analytic.arrays import FloatArray

from ..paper import ORANGE
from ..verification.convergence import Convergence, convergence, convergence_of_functions
from ..verification.history import HISTORY_FLOOR, Histories
from ..verification.judgement import THRESHOLDS, Judgement
from ..verification.submission import Run
from .style import STYLE, columns, cycle, ink, new_figure

_SYMBOLS = {
    "linear frequency": "$ω_n$", "history": "$q(t)$", "amplitude": "$a$",
    "nonlinear shift": "$ω_{NL}/ω_n - 1$", "backbone": "$ω_{NL}/ω_n - 1$",
}  # fmt: skip
_MARKERS = "osD^v"
_MOST_POINTS = 3000  # of a curve: more are not seen


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
        drawn = _in_mesh(judgement, name)
        if not drawn:
            return
        steps = histories.rows.steps if histories else ()
        timed = histories is not None and any(run.wall > 0.0 for run in histories.runs)
        count = 1 + bool(steps) + timed
        axes = new_figure(columns() / 3.0 * count, 2.5, ncols=count, squeeze=False)[1][0]
        elements = 1.0 / next(iter(drawn.values())).sizes
        _draw_errors(axes[0], drawn, elements, declared.order)
        axes[0].set(xlabel="elements", ylabel="|run − limit| in the mesh")
        if histories and steps:
            sizes = np.array([run.step for run in steps])
            runs = _of_functions(histories, steps, sizes, declared.order_in_step)
            _draw_errors(axes[1], {"history": runs}, 1e3 * sizes, declared.order_in_step)
            where = f"step [ms], {steps[0].elements} elements"
            axes[1].set(xlabel=where, ylabel="|run − limit| in the step")
        if histories and timed:
            _draw_cost(axes[-1], histories)
        machine = declared.machine or "the author's machine"
        caption = f"{name}: distance from the limit in the mesh{' and in the step' * bool(steps)}"
        caption += f", with the limit's uncertainty{f'; error and time on {machine}' * timed}."
        yield svg(axes[0]), caption


def svg(axes: Axes) -> str:
    """Return the figure of `axes` as the text of an SVG, letters as curves, and close it."""
    import matplotlib.pyplot as plt  # noqa: PLC0415

    figure: Any = axes.get_figure(root=True)
    text = io.StringIO()
    with mpl.rc_context({**STYLE, "svg.fonttype": "path", "svg.hashsalt": "rotbeam"}):
        figure.savefig(text, format="svg", metadata={"Date": None})
    plt.close(figure)
    return text.getvalue()


def _history(histories: Histories) -> Axes:
    """Draw q(t) of the finest run over the reference, and what each run is off by.

    Below, the largest difference up to each time: q(t) crosses zero, and so do differences.
    """
    _, (above, below) = new_figure(columns(), 3.4, nrows=2, sharex=True)
    finest = histories.rows.finest
    every = max(1, finest.time.size // _MOST_POINTS)
    time = finest.time[::every]
    above.plot(time, histories.reference.history(time), color="0.2", lw=2.2, label="reference")
    above.plot(time, finest.q[::every], color=ink(ORANGE), lw=0.9, label=_name(finest))
    above.axhline(0.0, color="0.8", lw=0.5, zorder=0)
    above.set_ylabel("$q$ [m]")
    above.legend(loc="upper right", ncols=2, bbox_to_anchor=(1.0, 1.14))
    for run, color in _colors(histories).items():
        every = max(1, run.time.size // _MOST_POINTS)
        largest = np.maximum.accumulate(np.abs(histories.differences[run]))[::every]
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
    return f"{run.elements} × {1e3 * run.step:g} ms"


def _colors(histories: Histories) -> dict[Run, Any]:
    """Return a color for each run, from light to dark, the finest last."""
    rows = histories.rows
    runs = sorted({*rows.meshes, *rows.steps}, key=lambda run: (run.elements, -run.step))
    shades = np.linspace(0.3, 1.0, len(runs))
    return dict(zip(runs, map(mpl.colormaps["viridis_r"], shades), strict=True))


def _draw_errors(
    ax: Axes, found: Mapping[str, Convergence], places: FloatArray, declared: float | None
) -> None:
    """Draw the distance from the limit with its bar, and the declared order above the first."""
    for (quantity, runs), color, marker in zip(found.items(), cycle(), _MARKERS, strict=False):
        errors = np.maximum(np.abs(runs.errors), 1e-16)
        bars = np.minimum(runs.error_bars, 0.9 * errors), runs.error_bars
        ax.errorbar(
            places, errors, yerr=bars, color=color, marker=marker, ms=3.5, capsize=2.0,
            elinewidth=0.6, label=_SYMBOLS[quantity],
        )  # fmt: skip
    sizes = next(iter(found.values())).sizes
    top = max(float(np.abs(runs.errors).max()) for runs in found.values())
    if declared and top:
        line = 2.5 * top * (sizes / sizes[0]) ** declared
        ax.plot(places, line, color="0.5", lw=0.7, ls="--", label=f"order {declared:g}")
    ax.set(xscale="log", yscale="log")
    ax.set_xticks(places, [f"{float(f'{place:.4g}'):g}" for place in places])
    ax.xaxis.set_minor_locator(mpl.ticker.NullLocator())
    ax.margins(0.12)
    _whole_decades(ax)
    ax.legend(loc="best")


def _in_mesh(judgement: Judgement, name: str) -> dict[str, Convergence]:
    """Return what tends to a limit in the mesh, the step left as it is."""
    found, histories = {}, judgement.histories.get(name)
    declared = judgement.declaration.order
    for quantity, one in judgement.findings[name].items():
        runs = one.runs
        if runs is None or runs.sizes.size < 2:
            continue
        if quantity == "history" and histories is not None:
            found[quantity] = _of_functions(histories, histories.rows.meshes, runs.sizes, declared)
        elif math.isfinite(runs.limit):
            noise = runs.noise.tolist()
            found[quantity] = convergence(
                runs.sizes.tolist(), runs.values.tolist(), noise=noise, declared=declared
            )
    return found


def _of_functions(
    histories: Histories, runs: Sequence[Run], sizes: ArrayLike, declared: float | None
) -> Convergence:
    functions = np.array([histories.aligned[run] for run in runs])
    size = np.asarray(sizes, dtype=float).tolist()
    return convergence_of_functions(size, functions, noise=HISTORY_FLOOR, declared=declared)[0]


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
    ax.yaxis.set_minor_formatter(mpl.ticker.NullFormatter())
