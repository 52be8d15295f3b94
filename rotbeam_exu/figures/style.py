"""Style of the figures: sizes for a journal's column, and colors for all readers."""

from __future__ import annotations

import math
import os
import re
from collections.abc import Iterator, Sequence
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
class _Style:
    """Widths of one and of two columns [mm], colors or greys, and endings of the saved files."""

    column: float = 88.9
    columns: float = 182.88
    grey: bool = False
    formats: tuple[str, ...] = ("png", "pdf")

    @property
    def settings(self) -> Any:
        """Matplotlib's settings of the style."""
        colors = tuple(_GREYS[color] for color in _CYCLE) if self.grey else _CYCLE
        return {**STYLE, "axes.prop_cycle": cycler(color=(*colors, "0.4"))}


_PRINT = ("pdf", "svg")
_STYLES = {
    "house": _Style(),
    "journal": _Style(column=84.0, columns=174.0, formats=_PRINT),
    "grey": _Style(column=84.0, columns=174.0, grey=True, formats=_PRINT),
}
_GAP = 6.0  # between two columns [mm]
_ACTIVE: ContextVar[_Style] = ContextVar("style", default=_STYLES["house"])


@contextmanager
def style(name: str | float = "journal") -> Iterator[None]:
    """Draw and save in another style: with figures.style("grey"): figures.figure_8(data).

    Parameters
    ----------
    wanted : {"house", "journal", "grey"} or float
        "journal" has Springer's columns of 84 and 174 mm, "grey" is that without colors. Or the
        width of a journal's column [mm]; two columns are twice that and a gap of 6 mm.

    Raises
    ------
    ValueError
        If there is no style of that name.
    """
    if isinstance(name, int | float):
        chosen = _Style(column=name, columns=2.0 * name + _GAP, formats=_PRINT)
    elif name in _STYLES:
        chosen = _STYLES[name]
    else:
        raise ValueError(
            f"unknown style {name!r}; known are {', '.join(_STYLES)}, or a column's width in mm"
        )
    before = _ACTIVE.set(chosen)
    try:
        with mpl.rc_context(chosen.settings):
            yield
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

    with mpl.rc_context(_ACTIVE.get().settings):
        figure, axes = plt.subplots(figsize=(width, height), **layout)
    return figure, axes


def figure_of(ax: Axes) -> Figure:
    """Return the figure that holds axes, be they in one of its parts."""
    figure = ax.get_figure(root=True)
    if figure is None:
        raise ValueError("these axes were removed from their figure: make new ones")
    return figure


@contextmanager
def house_axes(ax: _Given | None, width: float, height: float, **layout: Any) -> Iterator[_Given]:
    """Draw in the house's style: on `ax`, or on the axes of a new figure [in].

    The axes have units of a fitting size.
    """
    given: Any = new_figure(width, height, **layout)[1] if ax is None else ax
    with mpl.rc_context(_ACTIVE.get().settings):
        yield given
        for one in np.ravel(np.asarray(given, dtype=object)).tolist():
            fitting_units(one)


_PREFIXES = {-4: "p", -3: "n", -2: "µ", -1: "m", 0: "", 1: "k", 2: "M", 3: "G", 4: "T"}
_PREFIXED = "m", "s", "rad/s", "m/s", "N", "N m", "J", "Pa"  # units that take one


def prefix_of(largest: float, least: float = 0.1) -> tuple[float, str]:
    """Return the factor and the prefix of a unit for numbers up to `largest`: 1e-6 and µ.

    None from `least` to ten thousand, where the numbers of the paper's beam are.
    """
    if not (0.0 < abs(largest) < least or 1e4 <= abs(largest) < math.inf):
        return 1.0, ""
    power = min(max(math.floor(math.log10(abs(largest)) / 3.0), min(_PREFIXES)), max(_PREFIXES))
    return 1e3**power, _PREFIXES[power]


def quantity(value: float, unit: str, digits: int = 6) -> str:
    """Return a number with its unit, which has a prefix where it is small or large."""
    factor, prefix = prefix_of(value, 1e-4) if unit in _PREFIXED else (1.0, "")
    return f"{value / factor:.{digits}g} {prefix}{unit}"


def fitting_units(ax: Axes) -> None:
    """Give the axes units with a prefix, as µm, where numbers are small or large.

    The data stays in SI units, and so does what is drawn later.
    """
    for name, axis in (("x", ax.xaxis), ("y", ax.yaxis)):
        words, _, unit = axis.get_label_text().removesuffix("]").rpartition(" [")
        factor, prefix = prefix_of(float(np.abs(axis.get_view_interval()).max()))
        if unit not in _PREFIXED or not prefix or axis.get_scale() == "log":
            continue
        axis.set_label_text(f"{words} [{prefix}{unit}]")
        for one in (ax, *ax.child_axes):
            form = mpl.ticker.FuncFormatter(
                lambda x, _, factor=factor: f"{x / factor:.6g}".replace("-", "−")
            )
            getattr(one, f"{name}axis").set_major_formatter(form)


def shade_ramp(ax: Axes, ramp_time: float) -> None:
    """Shade the spin-up, in every figure over time, and name it."""
    ax.axvspan(0.0, ramp_time, color="0.92", lw=0, zorder=0)
    ax.annotate(
        "spin-up", (0.0, 1.0), xycoords=("data", "axes fraction"), xytext=(4, -4),
        textcoords="offset points", va="top", color="0.35",
    )  # fmt: skip


def inset(ax: Axes, place: tuple[float, float, float, float], **settings: Any) -> Axes:
    """Return framed axes within others, with small numbers."""
    near = ax.inset_axes(place)
    near.set(**settings)
    near.spines[["top", "right"]].set_visible(True)
    near.tick_params(labelsize=6.0)
    return near


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


def save_figure(axes: Axes | Sequence[Axes], path: str | os.PathLike[str]) -> tuple[Path, ...]:
    """Write a figure as `path` with the style's endings, each whole or not; close it.

    Parameters
    ----------
    axes : Axes or sequence of Axes
        As drawings return them.
    path : path
        Without an ending.

    Returns
    -------
    tuple of Path
        By default .png and .pdf.
    """
    import matplotlib.pyplot as plt  # noqa: PLC0415

    first = axes if isinstance(axes, Axes) else axes[0]
    figure, target = figure_of(first), Path(path)
    active = _ACTIVE.get()
    written = tuple(target.with_name(f"{target.name}.{end}") for end in active.formats)
    for one in written:
        with whole_file(one) as partial, mpl.rc_context(active.settings):
            figure.savefig(partial)
    plt.close(figure)
    return written
