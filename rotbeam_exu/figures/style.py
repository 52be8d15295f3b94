"""What makes the figures one family: sizes for a journal's column, and colors that all can tell."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import matplotlib as mpl
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..files.results import whole_file
from ..paper import BLUE, GREEN, ORANGE, PURPLE, RED, SKY

COLUMN = 3.5
"""Width of a journal's column [in]."""

COLUMNS = 7.2
"""Width of two columns [in]."""

CYCLE = (BLUE, RED, GREEN, PURPLE, ORANGE, SKY)

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
    "lines.linewidth": 1.0,
    "figure.constrained_layout.use": True,
    "savefig.dpi": 300,
    "pdf.fonttype": 42,
}


def new_figure(width: float, height: float, **layout: Any) -> tuple[Figure, Any]:
    """Return a figure of the family, in inches, and its axes."""
    import matplotlib.pyplot as plt  # noqa: PLC0415  (pyplot opens a backend)

    with mpl.rc_context(STYLE):
        figure, axes = plt.subplots(figsize=(width, height), **layout)
    return figure, axes


def label(variable: xr.DataArray) -> str:
    """Return an axis label, long name and unit, from a variable's attributes."""
    unit = variable.attrs.get("units", "")
    name = str(variable.attrs.get("long_name", variable.name))
    # The names' underscores are subscripts.
    name = re.sub(r"(\w)_(\w+)", r"$\1_{\2}$", name)
    return f"{name} [{unit}]" if unit and unit != "1" else name


def save_figure(axes: Axes, path: Path) -> tuple[Path, Path]:
    """Write the figure of `axes` as `path` with .png and .pdf, each whole or not, and close it."""
    import matplotlib.pyplot as plt  # noqa: PLC0415

    figure: Any = axes.get_figure(root=True)
    written = (path.with_name(f"{path.name}.png"), path.with_name(f"{path.name}.pdf"))
    for target in written:
        with whole_file(target) as partial, mpl.rc_context(STYLE):
            figure.savefig(partial)
    plt.close(figure)
    return written
