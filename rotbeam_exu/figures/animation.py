"""The spinning beam as a moving picture: in two frames, or beside the linear model."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.animation import FFMpegWriter, FuncAnimation, PillowWriter
from matplotlib.axes import Axes
from scipy.interpolate import CubicSpline

from analytic.arrays import FloatArray
from analytic.exact.driven.response import SpinUpResponse
from analytic.reduced.linear_frame import LinearResponse

from ..paper import BLUE, RED
from .style import STYLE, fitting_units, new_figure, prefix_of, quantity, shade_ramp

_LETTERS: Any = dict.fromkeys(
    ("font.size", "axes.labelsize", "axes.titlesize", "xtick.labelsize", "ytick.labelsize"), 11.0
)  # legible on a phone
_REACH = 1.08  # of a view, beyond the beam's length
_TRAIL = 0.6  # seconds of the tip's path that stay visible
_FINER = 8  # points of that path from one picture to the next
_FAR = 100.0  # lengths: what is farther is drawn there, out of every view
_CLAMP: Any = {"color": "0.6", "lw": 0.8, "ls": (0, (4, 3)), "zorder": 0}  # line of the clamp

_Response = SpinUpResponse | LinearResponse
_Moving = Callable[[int], None]  # draws a part anew at time number n


class _Gif(PillowWriter):
    """A GIF, not begun where drawing stops: matplotlib's fails of no picture, hiding why."""

    @contextmanager
    def saving(self, *arguments: Any, **options: Any) -> Iterator[PillowWriter]:
        self.setup(*arguments, **options)
        with mpl.rc_context({"savefig.bbox": None}):  # as matplotlib has it
            yield self
        self.finish()


def animate(
    response: SpinUpResponse, *, beside: LinearResponse | None = None, rate: float | None = None
) -> FuncAnimation:
    """Return the animation of a spin-up, one picture per time of the response.

    The views are from outside and turning with the clamp; or both from outside, the second of a
    linear model.

    Parameters
    ----------
    response : SpinUpResponse
        With `points` along the beam, at equally spaced times.
    beside : LinearResponse, optional
        Of the same spin-up at the same times, with points.
    rate : float, optional
        Pictures a second; by default real time.

    Raises
    ------
    ValueError
        If a response has no points along the beam or fewer than two times, or `beside` is of
        other times or of another motion.
    """
    _require_drawable(response, beside)
    time = response.time
    (scale, prefix), faster = prefix_of(time[-1]), prefix_of(response.spin_up.fastest)
    with mpl.rc_context({**STYLE, **_LETTERS}):
        history, moving = _two_models(response, beside) if beside else _two_frames(response)
        _ramp(history, response)
        words = history.set_title("", loc="left", family="monospace")
        figure: Any = history.get_figure(root=True)

    def draw(n: int) -> list[Any]:
        for move in moving:
            move(n)
        rate_now = float(response.spin_up.rate(time[n])) / faster[0]
        q = response.q[n] / response.beam.length
        line = f"t = {time[n] / scale:5.2f} {prefix}s  dθ/dt = {rate_now:4.2f} {faster[1]}rad/s"
        line += f"  q/L = {q:+5.2f}"
        if beside is not None:
            q = beside.q[n] / beside.beam.length
            line += f", linear {q:{'+6.2f' if abs(q) < 100.0 else '+6.0f'}}"
        words.set_text(line.replace("-", "−"))
        return []

    interval = 1000.0 / (rate or 1.0 / (time[1] - time[0]))  # [ms]
    return FuncAnimation(figure, draw, frames=time.size, interval=interval, blit=False)


def _require_drawable(response: SpinUpResponse, beside: LinearResponse | None) -> None:
    for one in (response, beside or response):
        if one.axis.shape[1] < 2 or one.time.size < 2:
            raise ValueError(
                "nothing to animate: ask spin_up_response for points along the beam, "
                f"got {one.axis.shape[1]} of them at {one.time.size} times"
            )
    if beside and not (
        np.array_equal(beside.time, response.time) and beside.spin_up == response.spin_up
    ):
        raise ValueError(
            "what is shown beside a spin-up must be of the same motion at the same times: give "
            "linear_response what spin_up_response was given"
        )


def save_animation(
    response: SpinUpResponse,
    path: Path,
    *,
    beside: LinearResponse | None = None,
    rate: float | None = None,
    progress: Callable[[int], None] | None = None,
) -> None:
    """Write the animation of a spin-up as .gif or, with ffmpeg, as .mp4.

    Parameters
    ----------
    response, beside, rate
        As for `animate`.
    path : Path
        The file.
    progress : callable, optional
        Called with the number of pictures drawn.

    Raises
    ------
    ValueError
        If the ending is neither, or ffmpeg is not there.
    """
    import matplotlib.pyplot as plt  # noqa: PLC0415  (pyplot opens a backend)

    check_format(path)
    animation = animate(response, beside=beside, rate=rate)
    fps: Any = rate or 1.0 / (response.time[1] - response.time[0])
    writer = _Gif(fps=fps) if path.suffix == ".gif" else FFMpegWriter(fps=fps)
    try:
        drawn = (lambda n, _: progress(n + 1)) if progress else None
        animation.save(path, writer=writer, dpi=100, progress_callback=drawn)
    finally:
        plt.close(animation._fig)  # type: ignore[attr-defined]


def check_format(path: Path) -> None:
    """Refuse an ending that cannot be written here, before any long work."""
    if path.suffix not in (".gif", ".mp4"):
        raise ValueError(f"cannot write {path.name!r}: the ending must be .gif or .mp4")
    if path.suffix == ".mp4" and not FFMpegWriter.isAvailable():
        raise ValueError(f"cannot write {path.name!r}: MP4 needs ffmpeg; install it or take .gif")


def _two_frames(response: SpinUpResponse) -> tuple[Axes, list[_Moving]]:
    """Return the history of q, and what moves: the inertial and the rotating view, in one scale."""
    behind = 0.12
    outside, inside, history = _axes(5.2, 2.0 * _REACH, _REACH + behind)
    length = response.beam.length
    _view(outside, "inertial frame", length)
    _view(inside, "rotating frame", length, behind)
    _scale_bar(inside, length)
    inside.plot([0.0, 1.1 * length], [0.0, 0.0], **_CLAMP)
    return history, [
        _beam(outside, response, "black", BLUE),
        _beam(inside, response, "black", BLUE, turning=True),
        _clamp(outside, response),
        _history(history, response, "black", BLUE),
    ]


def _two_models(response: SpinUpResponse, beside: LinearResponse) -> tuple[Axes, list[_Moving]]:
    """Return both histories, and what moves: inertial views of the exact and the linear beam."""
    exact, linear, history = _axes(4.6, 2.0 * _REACH, 2.0 * _REACH)
    length = response.beam.length
    moving = []
    for ax, of, title, color in (
        (exact, response, "exact beam", "black"),
        (linear, beside, "linear floating frame", RED),
    ):
        _view(ax, title, length)
        moving += [_clamp(ax, of), _beam(ax, of, color, color)]
    _scale_bar(exact, length, -_REACH)
    moving += [_history(history, of, c, c) for of, c in ((beside, RED), (response, "black"))]
    history.set_ylim(-_REACH, _REACH)
    _mark_instability(history, beside)
    _, path = _shapes_and_path(beside)
    seen = np.maximum(np.abs(path.real), np.abs(path.imag)) <= _REACH * length
    left = float(_between(beside.time)[seen][-1])
    if left < response.time[-1]:
        said = f"left the picture at {quantity(left, 's', 3)}"
        text = linear.text(0.0, 0.02, said, color=RED, transform=linear.transAxes)
        moving.append(lambda n: text.set_visible(response.time[n] >= left))
    return history, moving


def _shapes_and_path(response: _Response, *, turning: bool = False) -> tuple[Any, ...]:
    """Return the beam (times, points), and its tip's path, as complex numbers [m]."""
    time, angle = response.time, response.spin_up.angle
    fine = _between(time)
    # Between two pictures the tip goes on along its curve, not along a chord.
    beam = response.axis[..., 0] + 1j * response.axis[..., 1]
    tip: Any = CubicSpline(time, beam[:, -1])(fine)
    if not turning:
        beam, tip = beam * np.exp(1j * angle(time))[:, None], tip * np.exp(1j * angle(fine))
    far = _FAR * response.beam.length
    return tuple(z * (far / np.maximum(np.abs(z), far)) for z in (beam, tip))


def _beam(
    ax: Axes, response: _Response, color: str, path: str, *, turning: bool = False
) -> _Moving:
    """Return the beam, its tip and the tip's path, in a view that turns with the clamp or not."""
    shapes, tips = _shapes_and_path(response, turning=turning)
    trail = _FINER * round(_TRAIL / float(response.time[1] - response.time[0]))
    (trace,) = ax.plot([], [], color=path, lw=1.0)
    (beam,) = ax.plot([], [], color=color, lw=2.5, solid_capstyle="round")
    (tip,) = ax.plot([], [], "o", color=path, ms=4)

    def show(n: int) -> None:
        past = tips[max(0, _FINER * n - trail) : _FINER * n + 1]
        for line, z in ((beam, shapes[n]), (trace, past), (tip, past[-1:])):
            line.set_data(z.real, z.imag)

    return show


def _clamp(ax: Axes, response: _Response) -> _Moving:
    """Return the line that turns with the clamp."""
    (line,) = ax.plot([], [], **_CLAMP)
    ray = 1.1 * response.beam.length * np.exp(1j * response.spin_up.angle(response.time))
    return lambda n: line.set_data([0.0, ray[n].real], [0.0, ray[n].imag])


def _mark_instability(history: Axes, beside: LinearResponse) -> None:
    """Mark the first time at which the linear model is faster than its divergence speed."""
    fine = _between(beside.time)
    faster = beside.spin_up.rate(fine) * beside.beam.unit.setting > beside.beam.omega_0
    if beside.foreshortening or not faster.any():
        return
    start = fine[np.argmax(faster)]
    history.axvline(start, color=RED, lw=0.8, ls=(0, (4, 3)), zorder=1)
    # Where there is more room.
    side, shift = ("right", -4) if start > 0.5 * beside.time[-1] else ("left", 4)
    said = f"from {quantity(start, 's', 3)} on linear unstable"
    history.annotate(
        said, (start, 1.0), xycoords=("data", "axes fraction"), xytext=(shift, -4),
        textcoords="offset points", ha=side, va="top", color=RED,
    )  # fmt: skip


def _axes(height: float, *widths: float) -> tuple[Axes, Axes, Axes]:
    """Return the axes of two views of these widths and, beneath, of the history."""
    ratios = {"height_ratios": (3.0, 1.0), "width_ratios": widths}
    # Solving the layout for every picture would take most of the time, and let the axes tremble.
    figure, axes = new_figure(6.4, height, nrows=2, ncols=2, layout="none", **ratios)
    figure.subplots_adjust(0.11, 0.55 / height, 0.985, 1.0 - 0.3 / height, 0.04, 0.24)
    for ax in axes[1]:
        ax.remove()
    return axes[0, 0], axes[0, 1], figure.add_subplot(axes[1, 0].get_gridspec()[1, :])


def _view(ax: Axes, title: str, length: float, left: float = _REACH) -> None:
    """Make a view of a beam of that length, to scale, as far as `left` behind the clamp."""
    ax.set(xlim=(-left * length, _REACH * length), ylim=(-_REACH * length, _REACH * length))
    ax.set(aspect="equal", xticks=[], yticks=[])
    ax.set_title(title, loc="left")
    ax.spines[:].set_visible(False)
    ax.plot([0.0], [0.0], "s", color="0.35", ms=6, zorder=3)


def _scale_bar(ax: Axes, length: float, start: float = 0.0) -> None:
    """Draw a bar of a quarter of the beam's length below a view, and name the dashes beside it."""
    bar, low, left = 0.25 * length, -0.98 * _REACH * length, start * length
    ax.plot([left, left + bar], [low, low], color="0.35", lw=1.0)
    ax.text(left + 1.2 * bar, low, quantity(bar, "m"), va="center", color="0.35")
    ax.plot([left + 2.6 * bar, left + 3.3 * bar], [low, low], **_CLAMP)
    ax.text(left + 3.5 * bar, low, "clamp", va="center", color="0.35")


def _history(history: Axes, response: _Response, color: str, dot: str) -> _Moving:
    """Draw q over time, and return the point that moves on it."""
    fine = _between(response.time)
    q = response.q / response.beam.length
    history.plot(fine, CubicSpline(response.time, q)(fine), color=color)
    (point,) = history.plot([], [], "o", color=dot, ms=6, mec="white", mew=0.8)
    return lambda n: point.set_data([response.time[n]], [q[n]])


def _ramp(history: Axes, response: _Response) -> None:
    """Shade the spin-up, and name the axes."""
    shade_ramp(history, response.spin_up.ramp_time)
    history.axhline(0.0, color="0.6", lw=0.5)
    history.set(xlim=(0.0, response.time[-1]), xlabel="time [s]", ylabel="q/L")
    fitting_units(history)


def _between(time: FloatArray) -> FloatArray:
    """Return the times of pictures and, evenly, some between them."""
    return np.linspace(time[0], time[-1], _FINER * (time.size - 1) + 1)
