"""Drawings of frames, signs and axes, as SVG: part of `make images`.

Lines of beams and blades are computed by the package, so that a drawing has the signs of the code.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Arc, Circle, Polygon
from numpy.typing import ArrayLike

from analytic import Beam, Blade, SpinUp, spin_up_response, steady_state
from analytic.arrays import FloatArray
from rotbeam_exu.figures import STYLE
from rotbeam_exu.paper import BLUE, GREEN, ORANGE, PURPLE, RED

HERE = Path(__file__).parent
_INK, _PALE = "0.15", "0.45"


def _empty(size: tuple[float, float], panels: int = 1) -> tuple[Figure, list[Axes]]:
    fig, axes = plt.subplots(1, panels, figsize=size, squeeze=False)
    for ax in axes[0]:
        ax.set_aspect("equal")
        ax.axis("off")
    return fig, list(axes[0])


def _turned(points: ArrayLike, degrees: float) -> FloatArray:
    """Return points of the plane, turned counterclockwise."""
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return np.asarray(points, dtype=float) @ np.array([[c, s], [-s, c]])


def _name(ax: Axes, place: ArrayLike, text: str, at: ArrayLike = (0, 0), **how: Any) -> None:
    """Write a text `at` points from a place."""
    style = {"ha": "center", "va": "center", "fontsize": 9, "color": _INK, **how}
    ax.annotate(text, place, xytext=at, textcoords="offset points", **style)


def _arrow(
    ax: Axes, start: ArrayLike, end: ArrayLike, text: str = "", at: ArrayLike = (0, 0),
    color: str = _INK, **line: Any,
) -> None:  # fmt: skip
    """Draw an arrow, with its name `at` points from its head."""
    head = "-|>,head_width=0.18,head_length=0.4"
    style = {"arrowstyle": head, "shrinkA": 0, "shrinkB": 0, "color": color, "lw": 0.9, **line}
    ax.annotate("", end, start, arrowprops=style)
    _name(ax, end, text, at, color=color)


def _angle(
    ax: Axes, center: ArrayLike, radius: float, first: float, last: float, text: str,
    at: ArrayLike = (0, 0), color: str = _INK,
) -> None:  # fmt: skip
    """Draw an angle from `first` to `last` [degrees], its name `at` points from the middle."""
    low, high = sorted((first, last))
    ax.add_patch(Arc(center, 2 * radius, 2 * radius, theta1=low, theta2=high, color=color, lw=0.9))
    near = last - np.sign(last - first)
    a, b, middle = (
        np.asarray(center) + _turned((radius, 0.0), t) for t in (near, last, 0.5 * (first + last))
    )
    _arrow(ax, a, b, color=color)
    _name(ax, middle, text, at, color=color)


def _axis(ax: Axes, place: ArrayLike, text: str, at: ArrayLike, *, towards: bool = True) -> None:
    """Draw an axis that points to the reader, or away."""
    ax.add_patch(Circle(place, 0.035, fc="white", ec=_INK, lw=0.9, zorder=5))
    if towards:
        ax.add_patch(Circle(place, 0.011, color=_INK, zorder=6))
    _name(ax, place, text, at)


def clamp() -> Figure:
    """Return the top view: axes at rest and turning, θ, and q of the beam after its spin-up."""
    beam = Beam.reference()
    times, points = np.linspace(3.0, 5.0, 201), np.linspace(0.0, beam.length, 41)
    found = spin_up_response(beam, SpinUp(omega=6.0, ramp_time=3.0), times, points=points)
    line = np.asarray(found.axis[np.argmax(found.q)])[:, :2] / beam.length
    theta = 24.0
    foot = np.array([line[-1, 0], 0.0])
    fig, (ax,) = _empty((5.6, 3.5))
    _arrow(ax, (0, 0), (0.62, 0), "X", (7, 0), _PALE)
    _arrow(ax, (0, 0), (0, 0.5), "Y", (0, 8), _PALE)
    _arrow(ax, (0, 0), _turned((1.12, 0), theta), "x", (7, 3), ls="--")
    _arrow(ax, (0, 0), _turned((0, 0.5), theta), "y", (-3, 8), ls="--")
    ax.plot(*_turned(line, theta).T, color=BLUE, lw=3, solid_capstyle="round")
    ax.plot(*_turned([[0, -0.05], [0, 0.05]], theta).T, color=_INK, lw=3)
    _arrow(ax, _turned(foot, theta), _turned(line[-1], theta), color=RED, lw=1.4)
    _name(ax, _turned(0.5 * (foot + line[-1]), theta), "q > 0", (19, 4), color=RED)
    _angle(ax, (0, 0), 0.42, 0, theta, "θ(t)", (15, 1))
    _angle(ax, (0, 0), 0.17, 150, 250, "ω", (-9, 0), PURPLE)
    _name(ax, (0, 0), "clamp", (18, -10), fontsize=8)
    _name(ax, _turned(line[24], theta), "beam, length L", (-42, 10), color=BLUE)
    _name(ax, (0.75, 0.06), "X, Y are at rest\nx, y turn with the clamp", ha="left", fontsize=8)
    ax.set(xlim=(-0.25, 1.2), ylim=(-0.2, 0.86))
    return fig


def _airfoil() -> FloatArray:
    """Return a contour of chord 1, its leading edge at +0.35 and its line at 0."""
    x = 0.5 * (1.0 - np.cos(np.linspace(0.0, np.pi, 60)))
    half = 0.9 * (0.2969 * np.sqrt(x) - 0.126 * x - 0.3516 * x**2 + 0.2843 * x**3 - 0.1036 * x**4)
    around = np.concatenate([np.c_[x, half], np.c_[x, -half][::-1]])
    return np.c_[0.35 - around[:, 0], around[:, 1]]


def section() -> Figure:
    """Return the section, seen from the tip: its axes, its twist and its centers."""
    twist = 18.0
    fig, (ax,) = _empty((5.6, 3.3))
    contour = _turned(_airfoil(), twist)
    ax.add_patch(Polygon(contour, fc="0.93", ec=_INK, lw=1.0))
    _arrow(ax, (0, 0), (0.75, 0), "b$_2$, direction\nof rotation", (-6, -14), _PALE, ls="--")
    _arrow(ax, (0, 0), (0, 0.52), "b$_3$", (0, 8), _PALE, ls="--")
    _arrow(ax, (0, 0), _turned((0.62, 0), twist), "2, to the\nleading edge", (24, 12))
    _arrow(ax, (0, 0), _turned((0, 0.42), twist), "3, thickness", (-32, 4))
    _axis(ax, (0, 0), "1, along the blade,\nto the reader", (62, -38))
    _angle(ax, (0, 0), 0.52, 0, twist, "twist > 0", (34, 1), PURPLE)
    for place, text, color, at in (
        ((-0.24, 0.03), "center of mass", RED, (8, -44)),
        ((-0.14, 0.045), "tension center", GREEN, (-62, 8)),
        ((0.13, 0.03), "shear center", ORANGE, (44, 44)),
    ):
        ax.plot(*_turned(place, twist), "o", color=color, ms=5, zorder=7)
        line = {"arrowstyle": "-", "color": color, "lw": 0.6, "shrinkB": 3}
        ax.annotate(
            text, _turned(place, twist), at, textcoords="offset points", color=color, fontsize=8,
            ha="center", va="center", arrowprops=line,
        )  # fmt: skip
    _name(ax, _turned((-0.65, 0.0), twist), "trailing edge", (0, -9), fontsize=8)
    ax.set(xlim=(-0.72, 0.86), ylim=(-0.36, 0.6))
    return fig


def _line(blade: Blade) -> FloatArray:
    """Return the line of a blade without load over its length, in axes b from its clamp."""
    found = steady_state(blade, 0.0)
    return found.axis(np.linspace(0.0, blade.length, 41)) / blade.length


def blade_line() -> Figure:
    """Return the side view with hub, precone and prebend, and the top view with sweep."""
    blade = Beam.reference().with_section_out_of_plane(0.2, 0.1)
    cone, hub = 12.0, 0.16
    fig, (side, top) = _empty((7.2, 2.6), 2)
    _arrow(side, (0, -0.12), (0, 0.62), "axis of rotation", (0, 8), _PALE)
    _angle(side, (0, 0.5), 0.09, 200, 340, "ω", (22, 8), PURPLE)
    side.plot([0, 1.1], [0, 0], ls="--", lw=0.7, color=_PALE)
    _name(side, (0.98, 0), "plane of rotation", (0, -9), color=_PALE, fontsize=8)
    root = np.array([hub, 0.0])  # the hub is radial: the cone begins at the clamp
    _arrow(side, (0, 0), root, color=_INK, lw=2.0)
    _name(side, 0.5 * root, "R", (0, -9))
    for each, color, ls in ((blade, _PALE, ":"), (blade.with_prebend(-0.06), BLUE, "-")):
        side.plot(*(root + _turned(_line(each)[:, [0, 2]], cone)).T, color=color, ls=ls, lw=2)
    _arrow(side, root, root + _turned((0.32, 0), cone), "b$_1$", (2, -8))
    _arrow(side, root, root + _turned((0, 0.28), cone), "b$_3$", (-2, 8))
    _angle(side, root, 0.5, 0, cone, "precone β > 0", (38, -1), GREEN)
    _name(side, (0.72, 0.43), "prebend < 0", (-18, 4), color=BLUE)
    side.set_title("side view")
    for each, color, ls in ((blade, _PALE, ":"), (blade.with_sweep(-0.06), BLUE, "-")):
        line = _line(each)[:, :2]
        top.plot(hub + line[:, 0], line[:, 1], color=color, ls=ls, lw=2)
    _arrow(top, (0, 0), (hub, 0), color=_INK, lw=2.0)
    _axis(top, (0, 0), "axis of rotation", (10, -26))
    _arrow(top, (hub, 0), (hub + 0.32, 0), "b$_1$", (0, 9))
    _arrow(top, (hub, 0), (hub, 0.28), "b$_2$", (0, 8))
    _angle(top, (0, 0), 0.1, 100, 250, "ω", (-9, 0), PURPLE)
    _name(top, (0.75, -0.3), "sweep < 0: the tip is behind", (-20, -10), color=BLUE)
    top.set_title("view from above, along the axis of rotation")
    for ax in (side, top):
        ax.set(xlim=(-0.25, 1.2))
    side.set(ylim=(-0.2, 0.75))
    top.set(ylim=(-0.45, 0.5))
    return fig


def other_axes() -> Figure:
    """Return the axes of the section here, in BeamDyn and in HAWC2, and the sense of twist."""
    fig, panels = _empty((7.2, 1.9), 3)
    for ax, (title, along, chord, thick, twist) in zip(
        panels,
        (
            ("this package", "1", ("2", 1), ("3", 1), 1),
            ("BeamDyn", "z (3)", ("y (2)", -1), ("x (1)", 1), -1),
            ("HAWC2", "z", ("x", 1), ("y", 1), 1),
        ),
        strict=True,
    ):
        ax.add_patch(Polygon(_airfoil(), fc="0.93", ec=_INK, lw=1.0))
        name, sign = chord
        _arrow(
            ax, (0, 0), (sign * (0.62 if sign > 0 else 0.9), 0), name, ((9 if sign > 0 else -15), 0)
        )
        name, sign = thick
        _arrow(ax, (0, 0), (0, sign * 0.42), name, (14, 0))
        _axis(ax, (0, 0), along, (-2, -16))
        first, last = (5, 32) if twist > 0 else (-5, -32)
        _angle(ax, (0, 0), 0.5, first, last, "twist", (20, 5 if twist > 0 else -5), PURPLE)
        ax.set_title(title)
        ax.set(xlim=(-1.15, 0.9), ylim=(-0.34, 0.5))
    return fig


def write() -> None:
    """Write all drawings."""
    for draw in (clamp, section, blade_line, other_axes):
        with mpl.rc_context(STYLE):
            figure = draw()
            place = HERE / f"{draw.__name__}.svg"
            figure.savefig(
                place,
                metadata={"Date": None},
                transparent=True,
                bbox_inches="tight",
                pad_inches=0.03,
            )
            plt.close(figure)


if __name__ == "__main__":
    mpl.use("agg")
    write()
