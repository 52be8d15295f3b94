"""Style of the figures: sizes for a journal's column, and colors that all readers can tell."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

import matplotlib as mpl
import numpy as np
import xarray as xr
from cycler import cycler
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..files.results import whole_file
from ..paper import BLUE, GREEN, MODEL_LINES, ORANGE, PURPLE, RED, SKY

_Given = TypeVar("_Given")  # axes, or some
_CYCLE = (BLUE, RED, GREEN, PURPLE, ORANGE, SKY)

# Where a grey is near another's, dashes and marks tell the two apart.
_GREYS = {BLUE: "0.45", RED: "0.3", GREEN: "0.2", PURPLE: "0.55", ORANGE: "0.65", SKY: "0.6"}
_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
_RAMP = {False: (0.15, 0.8), True: (0.9, 0.4)}  # parts of viridis, and of the greys

STYLE: Any = {
    "font.size": 8.0,
    "axes.labelsize": 8.0,
    "axes.titlesize": 8.0,
    "xtick.labelsize": 7.0,
    "ytick.labelsize": 7.0,
    "legend.fontsize": 7.0,
    "legend.frameon": False,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.linewidth": 0.6,
    "axes.prop_cycle": cycler(color=(*_CYCLE, "0.4")),
    "lines.linewidth": 1.0,
    "figure.constrained_layout.use": True,
    "figure.figsize": (3.5, 2.6),
    "savefig.dpi": 300,
    "pdf.fonttype": 42,
    "svg.hashsalt": "rotbeam",
}
"""Matplotlib's settings of the house, for drawings of one's own: `plt.style.use(figures.STYLE)`."""


@dataclass(frozen=True, kw_only=True)
class Style:
    """Style of a figure, as a journal asks for it.

    Parameters
    ----------
    column, columns : float
        Widths of one and of two columns [mm].
    grey : bool
        Black and greys only; lines are told apart by dashes and marks.
    formats : tuple of str
        Endings of the saved files, such as "svg".
    """

    column: float = 88.9
    columns: float = 182.88
    grey: bool = False
    formats: tuple[str, ...] = ("png", "pdf")


STYLES = {
    "house": Style(),
    "journal": Style(column=84.0, columns=174.0, formats=("pdf", "svg")),
    "grey": Style(column=84.0, columns=174.0, grey=True, formats=("pdf", "svg")),
}
"""Styles by name: "journal" has Springer's widths, "grey" is that without colors."""

_ACTIVE: ContextVar[Style] = ContextVar("style", default=STYLES["house"])


@contextmanager
def style(wanted: str | Style = "journal") -> Iterator[Style]:
    """Draw and save in another style: with figures.style("grey"): figures.figure_8(data).

    Parameters
    ----------
    wanted : {"house", "journal", "grey"} or Style
        `Style(column=90.0, columns=190.0, grey=True, formats=("svg",))` is one of your own.

    Raises
    ------
    ValueError
        If there is no style of that name.
    """
    if not isinstance(wanted, Style) and wanted not in STYLES:
        raise ValueError(
            f"unknown style {wanted!r}; known are {', '.join(STYLES)}; another is a figures.Style"
        )
    chosen = wanted if isinstance(wanted, Style) else STYLES[wanted]
    before = _ACTIVE.set(chosen)
    try:
        with mpl.rc_context({**STYLE, "axes.prop_cycle": cycler(color=(*cycle(), "0.4"))}):
            yield chosen
    finally:
        _ACTIVE.reset(before)


def column() -> float:
    """Return the width of a journal's column [in]."""
    return _ACTIVE.get().column / 25.4


def columns() -> float:
    """Return the width of two columns [in]."""
    return _ACTIVE.get().columns / 25.4


def ink(color: str) -> str:
    """Return a color of the palette, or its grey."""
    return _GREYS.get(color, color) if _ACTIVE.get().grey else color


def cycle() -> tuple[str, ...]:
    """Return the colors of lines, in order."""
    return tuple(map(ink, _CYCLE))


def model_line(name: str) -> dict[str, Any]:
    """Return how a model's line is drawn."""
    line = MODEL_LINES[name]
    return {**line, "color": ink(line["color"])}


def ramp(count: int) -> list[Any]:
    """Return colors in order, dark to light: of meshes, degrees or slendernesses."""
    return list(mpl.colormaps[colormap("viridis")](np.linspace(*_RAMP[_ACTIVE.get().grey], count)))


def colormap(name: str) -> str:
    """Return a color map, or the greys."""
    return "Greys" if _ACTIVE.get().grey else name


def new_figure(width: float, height: float, **layout: Any) -> tuple[Figure, Any]:
    """Return a figure of the family, in inches, and its axes."""
    import matplotlib.pyplot as plt  # noqa: PLC0415  (pyplot opens a backend)

    with mpl.rc_context(STYLE):
        figure, axes = plt.subplots(figsize=(width, height), **layout)
    return figure, axes


@contextmanager
def house_axes(ax: _Given | None, width: float, height: float, **layout: Any) -> Iterator[_Given]:
    """Draw in the house's style: on `ax`, or on the axes of a new figure [in]."""
    given = new_figure(width, height, **layout)[1] if ax is None else ax
    with mpl.rc_context(STYLE):
        yield given


def shade_ramp(ax: Axes, ramp_time: float) -> None:
    """Shade the spin-up, in every figure over time, and name it."""
    ax.axvspan(0.0, ramp_time, color="0.92", lw=0, zorder=0)
    ax.annotate(
        "spin-up", (0.0, 1.0), xycoords=("data", "axes fraction"), xytext=(4, -4),
        textcoords="offset points", va="top", color="0.35",
    )  # fmt: skip


def label(variable: xr.DataArray) -> str:
    """Return an axis label, long name and unit, from a variable's attributes."""
    unit = variable.attrs.get("units", "")
    name = str(variable.attrs.get("long_name", variable.name))
    # The names' underscores are subscripts; ω₀ is written ω0 in some.
    name = re.sub(r"ω0\b", "ω_0", name)
    name = re.sub(r"(\w)_(\w+)", r"$\1_{\2}$", name)
    return f"{name} [{unit}]" if unit and unit != "1" else name


def typeset(words: str) -> str:
    """Return words with the minus and the powers of print: −33.4, 1.758·10⁻⁶."""
    words = re.sub(
        r"(?<=\d)e([+-]\d+)", lambda power: "·10" + str(int(power[1])).translate(_RAISED), words
    )
    return re.sub(r"(?<![\w)-])-(?=[\d.])", "−", words)


def save_figure(axes: Axes, path: Path) -> tuple[Path, ...]:
    """Write the figure of `axes` as `path` with the style's endings, each whole or not; close it.

    Returns
    -------
    tuple of Path
        By default .png and .pdf.
    """
    import matplotlib.pyplot as plt  # noqa: PLC0415

    figure: Any = axes.get_figure(root=True)
    written = tuple(path.with_name(f"{path.name}.{end}") for end in _ACTIVE.get().formats)
    for target in written:
        with whole_file(target) as partial, mpl.rc_context(STYLE):
            figure.savefig(partial)
    plt.close(figure)
    return written
