"""The figures of the paper by number: what computes each, what draws it, and what it claims."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from . import comparison, figures
from .figures.captions import CAPTIONS
from .lazily import xr


@dataclass(frozen=True, kw_only=True)
class PaperFigure:
    """A figure that has data.

    Attributes
    ----------
    data : callable
        Returns its Dataset; of the function of the same name in `comparison`.
    draw : callable
        Draws it; returns Axes, or some.
    caption : str
        What the paper claims of it, and what is true; `figures.caption` describes it too.
    sweeps : bool
        Whether the data are those of a sweep, which takes `jobs`, `cache` and `progress`.
    """

    data: Callable[..., xr.Dataset]
    draw: Callable[..., Any]
    caption: str
    sweeps: bool = False


_SWEEPS = {5, 14}

PAPER_FIGURES: dict[int, PaperFigure] = {
    number: PaperFigure(data=data, draw=draw, caption=CAPTIONS[number], sweeps=number in _SWEEPS)
    for number, data, draw in (
        (3, comparison.figure_3, figures.figure_3),
        (4, comparison.figure_4, figures.figure_4),
        (5, comparison.figure_5, figures.figure_5),
        (8, comparison.figure_8, figures.figure_8),
        (9, comparison.figure_9, figures.figure_9),
        (10, comparison.figure_10, figures.figure_10),
        (11, comparison.figure_11, figures.figure_11),
        (12, comparison.figure_12, figures.figure_12),
        (13, comparison.figure_13, figures.figure_13),
        (14, comparison.figure_14, figures.figure_14),
        (15, comparison.figure_15, figures.figure_15),
    )
}
"""All but Figures 1, 2, 6 and 7, which are drawings."""
