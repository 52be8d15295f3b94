"""Axes for the results' own pictures: `Backbone.plot`, `Campbell.plot`, `ForcedResponse.plot`.

The only module of the theory that knows matplotlib, and that only when something is drawn. The
pictures have the reader's own settings; figures of the house are in `rotbeam_exu.figures`.
"""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from .arrays import FloatArray

if TYPE_CHECKING:
    from matplotlib.axes import Axes as Axes  # noqa: PLC0414  (for the results)


def axes_or_new(ax: Axes | None) -> Axes:
    """Return `ax`, or the axes of a new figure."""
    if ax is not None:
        return ax
    import matplotlib.pyplot as plt  # noqa: PLC0415  (the theory itself needs no matplotlib)

    return plt.subplots(layout="constrained")[1]


def apart(places: FloatArray, gap: float) -> FloatArray:
    """Return `places` in their order, moved up where two are nearer than `gap`: of labels."""
    moved = np.array(places, dtype=float)
    order = np.argsort(moved)
    for below, above in pairwise(order):
        moved[above] = max(moved[above], moved[below] + gap)
    return moved
