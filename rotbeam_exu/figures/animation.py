"""The spinning beam as a moving picture: in two frames, or beside the linear model."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NamedTuple

import matplotlib as mpl
import numpy as np
from matplotlib.animation import FFMpegWriter, FuncAnimation, PillowWriter
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from scipy.interpolate import CubicSpline

from analytic import LinearResponse, SpinUpResponse

from ..paper import BLUE, ORANGE, RED
from .moving_beam import CLAMP, REACH, MovingBeam, Response, between, scale_bar, turned, view
from .style import STYLE, new_figure

_DPI = 100


class _Gif(PillowWriter):
    """A GIF, not begun where drawing stops: matplotlib's fails of no picture, hiding why."""

    @contextmanager
    def saving(self, *arguments: Any, **options: Any) -> Iterator[PillowWriter]:
        self.setup(*arguments, **options)
        with mpl.rc_context({"savefig.bbox": None}):  # as matplotlib has it
            yield self
        self.finish()


class _Scene(NamedTuple):
    """What moves: beams, lines that turn with the clamp, points on histories, and what it says."""

    beams: list[MovingBeam]
    clamps: list[Line2D]
    dots: list[tuple[Line2D, Response]]
    history: Axes
    notes: list[tuple[float, Any]]
    """Times [s] from which on a text is seen."""


def animate(
    response: SpinUpResponse, *, beside: LinearResponse | None = None, rate: float | None = None
) -> FuncAnimation:
    """Return the animation of a spin-up, one picture per time of the response.

    Seen from outside and turning with the clamp, or from outside, twice, beside what a linear
    model makes of it.

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
    interval = float(time[1] - time[0])
    turn = turned(response, time)
    with mpl.rc_context(STYLE):
        scene = _two_frames(response) if beside is None else _two_models(response, beside)
        _ramp(scene.history, response)
        words = scene.history.set_title("", loc="left", family="monospace")
        figure: Any = scene.history.get_figure(root=True)

    def draw(n: int) -> list[Any]:
        for beam in scene.beams:
            beam.show(n)
        ray = 1.1 * response.beam.length * turn[n]
        for clamp in scene.clamps:
            clamp.set_data([0.0, ray.real], [0.0, ray.imag])
        for dot, of in scene.dots:
            dot.set_data([time[n]], [of.q[n]])
        for start, text in scene.notes:
            text.set_visible(time[n] >= start)
        rate_now = float(response.spin_up.rate(time[n]))
        line = f"t = {time[n]:5.2f} s   dθ/dt = {rate_now:4.2f} rad/s   q = {response.q[n]:+5.2f} m"
        if beside is not None:
            form = "+5.2f" if abs(beside.q[n]) < 100.0 else "+.1e"
            line += f"   linear {beside.q[n]:{form}} m"
        words.set_text(line.replace("-", "−"))
        return []

    milliseconds = 1000.0 / (rate or 1.0 / interval)
    return FuncAnimation(figure, draw, frames=time.size, interval=milliseconds, blit=False)


def _require_drawable(response: SpinUpResponse, beside: LinearResponse | None) -> None:
    for one in (response, beside or response):
        if one.axis.shape[1] < 2 or one.time.size < 2:
            raise ValueError(
                "nothing to animate: ask spin_up_response for points along the beam, "
                f"got {one.axis.shape[1]} of them at {one.time.size} times"
            )
    if beside is not None and not (
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
    interval = float(response.time[1] - response.time[0])
    writer_class = _Gif if path.suffix == ".gif" else FFMpegWriter
    writer = writer_class(fps=rate or 1.0 / interval)  # type: ignore[arg-type]
    try:
        animation.save(
            path,
            writer=writer,
            dpi=_DPI,
            progress_callback=lambda n, _: progress(n + 1) if progress else None,
        )
    finally:
        plt.close(animation._fig)  # type: ignore[attr-defined]


def check_format(path: Path) -> None:
    """Refuse an ending that cannot be written here, before any long work."""
    if path.suffix not in (".gif", ".mp4"):
        raise ValueError(f"cannot write {path.name!r}: the ending must be .gif or .mp4")
    if path.suffix == ".mp4" and not FFMpegWriter.isAvailable():
        raise ValueError(f"cannot write {path.name!r}: MP4 needs ffmpeg; install it or take .gif")


def _two_frames(response: SpinUpResponse) -> _Scene:
    """Return the inertial and the rotating view, of one scale, and the history of q."""
    behind = 0.12
    outside, inside, history = _axes(5.2, 2.0 * REACH, REACH + behind)
    length = response.beam.length
    view(outside, "inertial frame", length)
    view(inside, "rotating frame", length, behind)
    scale_bar(inside, length)
    inside.plot([0.0, 1.1 * length], [0.0, 0.0], **CLAMP)
    beams = [MovingBeam(outside, response), MovingBeam(inside, response, turning=True)]
    (clamp,) = outside.plot([], [], **CLAMP)
    dot = _history(history, response, BLUE, ORANGE)
    return _Scene(beams, [clamp], [(dot, response)], history, [])


def _two_models(response: SpinUpResponse, beside: LinearResponse) -> _Scene:
    """Return the inertial views of the exact beam and of the linear one, and both histories."""
    *views, history = _axes(4.6, 2.0 * REACH, 2.0 * REACH)
    length = response.beam.length
    beams, clamps, notes = [], [], []
    for ax, of, title, color in (
        (views[0], response, "exact beam", BLUE),
        (views[1], beside, "linear floating frame", RED),
    ):
        view(ax, title, length)
        clamps += ax.plot([], [], **CLAMP)
        beams.append(MovingBeam(ax, of, color=color, path=color))
    scale_bar(views[0], length, -REACH)
    dots = [(_history(history, of, c, c), of) for of, c in ((beside, RED), (response, BLUE))]
    history.set_ylim(-REACH * length, REACH * length)
    _mark_instability(history, beside)
    left = _time_of_leaving(beside, beams[1])
    if left < response.time[-1]:
        said = f"left the picture at {left:.2f} s"
        # A fixed place: that of a title that is not seen yet would put the other one anywhere.
        text = views[1].set_title(said, loc="right", color=RED, y=1.0)
        notes.append((left, text))
    return _Scene(beams, clamps, dots, history, notes)


def _mark_instability(history: Axes, beside: LinearResponse) -> None:
    """Mark the first time at which the linear model is faster than its divergence speed."""
    fine = between(beside.time)
    faster = beside.spin_up.rate(fine) * beside.beam.unit.setting > beside.beam.omega_0
    if beside.foreshortening or not faster.any():
        return
    start, speed = fine[np.argmax(faster)], beside.beam.omega_0 / beside.beam.unit.setting
    history.axvline(start, color=RED, lw=0.8, ls=(0, (4, 3)), zorder=1)
    late = start > 0.5 * beside.time[-1]  # then there is more room on the left
    history.annotate(
        f"from {start:.2f} s on faster than {speed:.2f} rad/s: linear unstable",
        (start, 1.0),
        xycoords=("data", "axes fraction"),
        xytext=(-4 if late else 4, -4),
        textcoords="offset points",
        ha="right" if late else "left",
        va="top",
        color=RED,
    )


def _time_of_leaving(response: Response, beam: MovingBeam) -> float:
    """Return the last time [s] at which the tip is in the view."""
    reach = REACH * response.beam.length
    seen = np.maximum(np.abs(beam.path.real), np.abs(beam.path.imag)) <= reach
    return float(between(response.time)[seen][-1])


def _axes(height: float, *widths: float) -> tuple[Axes, Axes, Axes]:
    """Return the axes of two views of these widths and, beneath, of the history."""
    ratios = {"height_ratios": (3.0, 1.0), "width_ratios": widths}
    # Solving the layout for every picture would take most of the time, and let the axes tremble.
    figure, axes = new_figure(6.4, height, nrows=2, ncols=2, layout="none", **ratios)
    figure.subplots_adjust(0.09, 0.44 / height, 0.985, 1.0 - 0.23 / height, 0.04, 0.16)
    for ax in axes[1]:
        ax.remove()
    return axes[0, 0], axes[0, 1], figure.add_subplot(axes[1, 0].get_gridspec()[1, :])


def _history(history: Axes, response: Response, color: str, dot: str) -> Line2D:
    """Draw q over time, and return the point that moves on it."""
    fine = between(response.time)
    history.plot(fine, CubicSpline(response.time, response.q)(fine), color=color)
    (point,) = history.plot([], [], "o", color=dot, ms=6, mec="white", mew=0.8)
    return point


def _ramp(history: Axes, response: Response) -> None:
    """Shade the spin-up, and name the axes."""
    history.axvspan(0.0, response.spin_up.ramp_time, color="0.93", lw=0, zorder=0)
    history.axhline(0.0, color="0.6", lw=0.5)
    history.set(xlim=(0.0, response.time[-1]), xlabel="time [s]", ylabel="q [m]")
    history.annotate(
        "spin-up",
        (0.0, 1.0),
        xycoords="axes fraction",
        xytext=(4, -4),
        textcoords="offset points",
        va="top",
        color="0.35",
    )
