"""Axes for the results' own pictures: `Orbits.plot`, `LinearModes.plot`, `ForcedResponse.plot`.

The only module of the theory that knows matplotlib, and that only when something is drawn. The
pictures have the reader's own settings; figures of the house are in `rotbeam_exu.figures`.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from .arrays import FloatArray

if TYPE_CHECKING:
    from matplotlib.axes import Axes as Axes  # noqa: PLC0414  (for the results)

_DRAWN = 61  # amplitudes, besides the orbits' own
_BARS = 12
_FINE = 10  # pieces of what is drawn between two points of a response
UNSTABLE: Any = {"ls": (0, (2.5, 1.5)), "lw": 0.8}
DASHES = {"lag": "-", "flap": "--", "torsion": "-.", "axial": ":"}
"""Lines of families of modes."""
FOLD: Any = {"ls": "none", "marker": "o", "ms": 3.5, "mfc": "white"}
"""Line of the unstable part of a response, and marks of its folds."""


def axes_or_new(ax: Axes | None) -> Axes:
    """Return `ax`, or the axes of a new figure."""
    if ax is not None:
        return ax
    import matplotlib.pyplot as plt  # noqa: PLC0415  (the theory itself needs no matplotlib)

    return plt.subplots(layout="constrained")[1]


def cycled(number: int) -> str:
    """Return a color of the cycle in use now; "C0" would be looked up at the time of drawing."""
    from matplotlib.colors import to_hex  # noqa: PLC0415

    return to_hex(f"C{number}")


def apart(places: FloatArray, gap: float) -> FloatArray:
    """Return `places` in their order, moved up where two are nearer than `gap`: of labels."""
    moved = np.array(places, dtype=float)
    order = np.argsort(moved)
    for below, above in pairwise(order):
        moved[above] = max(moved[above], moved[below] + gap)
    return moved


def backbone_drawn(
    frequency: FloatArray, amplitude: FloatArray, slope: float | None = None
) -> tuple[FloatArray, FloatArray]:
    """Return frequencies and amplitudes of a smooth curve through the orbits of a backbone.

    It is a cubic spline of the frequency over a². The first point is at a = 0, where the spline has
    the `slope` dω/d(a²) if it is known.
    """
    from scipy.interpolate import CubicSpline  # noqa: PLC0415  (for pictures only)

    square, first = np.unique(amplitude**2, return_index=True)
    ends: Any = (
        "not-a-knot" if slope is None else (1, slope),
        "not-a-knot" if square.size > 2 else (2, 0.0),
    )
    a = np.union1d(np.linspace(0.0, amplitude.max(), _DRAWN), amplitude)
    return CubicSpline(square, frequency[first], bc_type=ends)(a**2), a


def draw_response(
    ax: Axes,
    frequency: FloatArray,
    amplitude: FloatArray,
    stable: NDArray[np.bool_],
    fold: NDArray[np.bool_],
    **line: Any,
) -> None:
    """Draw a response through its points in order: unstable dashed, folds as rings.

    Between two points is a cubic that is monotone where they are: no peak or fold is drawn that is
    none. A fold ends both parts, for a multiplier is 1 there.
    """
    from scipy.interpolate import PchipInterpolator  # noqa: PLC0415  (for pictures only)

    points, calm = np.array([frequency, amplitude]), stable | fold
    along = np.linalg.norm(np.diff(points / np.ptp(points, axis=1, keepdims=True)), axis=0)
    distinct = np.append(True, along > 0.0)
    place = np.append(0.0, np.cumsum(along))[distinct]
    points, calm = points[:, distinct], calm[distinct]
    count = place.size - 1
    at = np.interp(np.linspace(0.0, count, _FINE * count + 1), np.arange(count + 1), place)
    drawn = PchipInterpolator(place, points, axis=1)(at)
    firm = np.repeat(calm[:-1] & calm[1:], _FINE)
    # A point belongs to the pieces on both of its sides.
    solid, dashed = (
        np.where(np.append(part[0], part) | np.append(part, part[-1]), drawn, np.nan)
        for part in (firm, ~firm)
    )
    (curve,) = ax.plot(*solid, **line)
    color = curve.get_color()
    ax.plot(*dashed, **{**line, **UNSTABLE, "color": color, "label": "_unstable"})
    ax.plot(frequency[fold], amplitude[fold], mec=color, **FOLD)


def free_place(omegas: FloatArray, frequencies: FloatArray, order: int, top: float) -> float:
    """Return the speed farthest right whose label, left of it above kω, no mode crosses."""
    low, high = float(omegas[0]), float(omegas[-1])
    for at in np.linspace(high, low, 51)[1:26]:
        under = np.linspace(max(at - 0.07 * (high - low), low), at, 5)
        modes = np.array([np.interp(under, omegas, row) for row in frequencies.T])
        if not np.any((modes > order * at - 0.005 * top) & (modes < order * at + 0.05 * top)):
            return float(at)
    return high


def tornado(names: Sequence[str], parts: FloatArray, label: str, ax: Axes | None) -> Axes:
    """Draw parts as bars, the largest on top, up to 12; return the axes."""
    ax = axes_or_new(ax)
    kept = np.argsort(-np.abs(parts), kind="stable")[:_BARS][::-1]
    ax.barh([names[k] for k in kept], parts[kept], height=0.7)
    ax.axvline(0.0, color="0.3", lw=0.6)
    ax.set(xlabel=label)
    ax.tick_params(axis="y", length=0.0)
    return ax
