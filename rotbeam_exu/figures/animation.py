"""The spinning beam as a moving picture: in two frames, or next to the linear model."""

from __future__ import annotations

import math
import shutil
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from time import monotonic
from typing import Any, cast

import matplotlib as mpl
import numpy as np
from matplotlib.animation import FFMpegWriter, FuncAnimation, PillowWriter
from matplotlib.axes import Axes
from rich.console import Console
from rich.progress import Progress
from scipy.interpolate import CubicSpline

from analytic.arrays import ComplexArray, FloatArray
from analytic.motion import SpeedChange

from ..files.results import whole_file
from ..labels import one_two_five
from ..lazily import xr
from ..paper import BLUE, RED
from ..runs.attributes import beam_of, motion_of
from ..runs.shape import in_space
from .style import STYLE, figure_of, fitting_units, new_figure, prefix_of, quantity, shade_ramp

_LETTERS: Any = dict.fromkeys(
    ("font.size", "axes.labelsize", "axes.titlesize", "xtick.labelsize", "ytick.labelsize"), 11.0
)  # legible on a phone
_REACH = 1.08  # of a view, beyond the beam's length
_TRAIL = 0.6  # seconds of the tip's path that stay visible
_FINER = 8  # points of that path from one picture to the next
_FAR = 100.0  # lengths: what is farther is drawn there, out of every view
_CLAMP: Any = {"color": "0.6", "lw": 0.8, "ls": (0, (4, 3)), "zorder": 0}  # line of the clamp
_CHORD = 0.1  # of the strip that shows how sections stand, over the length
_ABOVE, _SIDE = 1, 2  # the direction that goes up in a view, y or z; x goes to the right
_LEAST = 1e-6  # of q and w over L, that digits of their numbers tell
_SOON = 5.0  # seconds that need no bar
_Moving = Callable[[int], None]  # draws a part anew at time number n


class _Gif(PillowWriter):
    """A GIF. Without a picture matplotlib's own fails at its end, and hides the reason."""

    def finish(self) -> None:
        if self._frames:  # type: ignore[attr-defined]
            super().finish()


class _Shown:
    """A blade in motion, with all of it that is drawn: times [s], q and w over L, its reach [m]."""

    def __init__(self, data: xr.Dataset) -> None:
        stations, times = (data.sizes.get(name, 0) for name in ("station", "time"))
        if "place" not in data or stations < 2 or times < 2:
            raise ValueError(
                "nothing to animate: ask spin_up_response for points along the beam, or simulate "
                f"for stations, got {stations} of them at {times} times"
            )
        self.data, self.blade = data, beam_of(data.attrs)
        self.motion = cast(SpeedChange, motion_of(data.attrs))
        self.time = np.asarray(data["time"].to_numpy())
        self.fine = np.linspace(self.time[0], self.time[-1], _FINER * (times - 1) + 1)
        self.length, self.reach = self.blade.length, self.blade.length + self.blade.hub_radius
        out_of_plane = data["place"].to_numpy()[..., 2]
        self.leaves_plane = bool(out_of_plane.any())
        self.q, self.flap = data["q"].to_numpy() / self.length, out_of_plane[:, -1] / self.length

    def seen(self, data: xr.Dataset, *, turning: bool = False, up: int = _ABOVE) -> ComplexArray:
        """Return the axis and the edges of the strip in a view, (3, times, stations) [m]."""
        place, section = in_space(data.drop_vars("angle") if turning else data)
        half = 0.5 * _CHORD * self.length * section[..., 1]
        rows = np.stack(np.broadcast_arrays(place, place + half, place - half))
        z, far = rows[..., 0] + 1j * rows[..., up], _FAR * self.length
        return np.asarray(z * (far / np.maximum(np.abs(z), far)))

    def path(self, **view: Any) -> ComplexArray:
        """Return the tip's path in a view [m]: a curve, not chords between pictures."""
        finer = {
            name: (one.dims, CubicSpline(self.time, one.to_numpy())(self.fine))
            for name, one in self.data[["place", "angle"]].isel(station=[-1]).items()
        }
        return self.seen(xr.Dataset(finer, attrs=self.data.attrs), **view)[0, :, 0]


def animate(
    data: xr.Dataset, *, beside: xr.Dataset | None = None, rate: float | None = None
) -> FuncAnimation:
    """Return the animation of a blade, one picture per time of the data.

    The views are from outside and turning with the clamp; or both from outside, the second of a
    linear model. A blade that leaves its plane is seen from above and, turning with the clamp, from
    the side; a strip of one width shows how the chords of its sections stand.

    Parameters
    ----------
    data : Dataset
        With stations, at equally spaced times: what `dataset_of` makes of a response with points,
        or a run of `simulate` with stations.
    beside : Dataset, optional
        What `dataset_of` makes of a LinearResponse to the same spin-up at the same times.
    rate : float, optional
        Pictures a second; by default real time.

    Raises
    ------
    ValueError
        If stations or times are fewer than two, or `beside` has other times or another motion.
    """
    main, other = _Shown(data), None if beside is None else _Shown(beside)
    time = main.time
    if other and not (np.array_equal(other.time, time) and other.motion == main.motion):
        raise ValueError(
            "what is shown next to a spin-up must be of the same motion at the same times: give "
            "linear_response what spin_up_response was given"
        )
    (scale, prefix), faster = prefix_of(time[-1]), prefix_of(main.motion.fastest)
    with mpl.rc_context({**STYLE, **_LETTERS}):
        history, moving = _two_models(main, other) if other else _two_frames(main)
        if data.attrs["ramp_time"]:
            shade_ramp(history, data.attrs["ramp_time"])
        history.axhline(0.0, color="0.6", lw=0.5)
        history.set(xlim=(0.0, time[-1]), xlabel="time [s]")
        fitting_units(history)
        words = history.set_title("", loc="left", family="monospace")
        figure = figure_of(history)

    largest = max(np.abs(main.q).max(), np.abs(main.flap).max(), _LEAST)
    digits = max(2, 1 - math.floor(math.log10(largest)))

    def draw(n: int) -> list[Any]:
        for move in moving:
            move(n)
        rate_now = float(main.motion.rate(time[n])) / faster[0]
        line = f"t = {time[n] / scale:5.2f} {prefix}s  dθ/dt = {rate_now:4.2f} {faster[1]}rad/s"
        line += f"  q/L = {main.q[n]:+5.{digits}f}"
        if other:
            line += f", linear {other.q[n]:{'+6.2f' if abs(other.q[n]) < 100.0 else '+6.0f'}}"
        elif main.leaves_plane:
            line += f"  w/L = {main.flap[n]:+5.{digits}f}"
        words.set_text(line.replace("-", "−"))
        return []

    interval = 1.0 / rate if rate else time[1] - time[0]  # [s]
    return FuncAnimation(figure, draw, frames=time.size, interval=1000.0 * interval, blit=False)


def save_animation(
    data: xr.Dataset,
    path: Path,
    *,
    beside: xr.Dataset | None = None,
    rate: float | None = None,
    progress: Callable[[int], None] | None = None,
) -> None:
    """Write the animation of a blade as .gif or, with ffmpeg, as .mp4; whole or not at all.

    It is drawn in the system's folder for temporary files.

    Parameters
    ----------
    data, beside, rate
        As for `animate`.
    path : Path
        The file.
    progress : callable, optional
        Called with the number of pictures drawn; without it, a terminal has a bar after 5 s.

    Raises
    ------
    ValueError
        If the ending is neither, or ffmpeg is not there.
    """
    import matplotlib.pyplot as plt  # noqa: PLC0415  (pyplot opens a backend)

    check_format(path)
    animation = animate(data, beside=beside, rate=rate)
    canvas: Any = animation._fig.canvas  # type: ignore[attr-defined]
    canvas.draw_idle = lambda: None  # Agg would draw each picture now, and once more to save it
    fps: Any = rate or 1.0 / float(data["time"][1] - data["time"][0])
    writer = _Gif(fps=fps) if path.suffix == ".gif" else FFMpegWriter(fps=fps)
    try:
        # Not in the folder of the film: what is killed would leave half of it there.
        with TemporaryDirectory() as folder, _bar(data.sizes["time"]) as drawn:
            film, done = Path(folder) / path.name, progress or drawn
            animation.save(film, writer=writer, dpi=100, progress_callback=lambda n, _: done(n + 1))
            with whole_file(path) as partial:
                shutil.copyfile(film, partial)
    finally:
        plt.close(animation._fig)  # type: ignore[attr-defined]


@contextmanager
def _bar(count: int) -> Iterator[Callable[[int], None]]:
    """Give a function to call with the pictures drawn: on a terminal a bar shows them after 5 s."""
    errors, start = Console(stderr=True), monotonic()
    with Progress(console=errors, transient=True, disable=not errors.is_terminal) as drawn:
        task = drawn.add_task("drawing", total=count, visible=False)
        yield lambda n: drawn.update(task, completed=n, visible=monotonic() > start + _SOON)


def check_format(path: Path) -> None:
    """Refuse an ending that cannot be written here, before any long work."""
    if path.suffix not in (".gif", ".mp4"):
        raise ValueError(
            f"cannot write {path.name!r}: the ending must be .gif or .mp4, or .pvd for ParaView, "
            "of rotbeam animate and save_vtk"
        )
    if path.suffix == ".mp4" and not FFMpegWriter.isAvailable():
        raise ValueError(f"cannot write {path.name!r}: MP4 needs ffmpeg; install it or take .gif")


def _two_frames(of: _Shown) -> tuple[Axes, list[_Moving]]:
    """Return the histories, and what moves: the inertial and the rotating view, in one scale."""
    behind, space = 0.12, of.leaves_plane
    outside, inside, history = _axes(5.2, 2.0 * _REACH, _REACH + behind)
    _view(outside, "from above" if space else "inertial frame", of.reach)
    _view(inside, "from the side" if space else "rotating frame", of.reach, behind)
    _scale_bar(inside, of, 0.0)
    ray = 1.1 * of.reach * np.exp(1j * of.blade.line.precone)
    inside.plot([0.0, ray.real], [0.0, ray.imag], **_CLAMP)
    moving = [
        _beam(outside, of, "black", BLUE),
        _beam(inside, of, "black", BLUE, turning=True, up=_SIDE if space else _ABOVE),
        _clamp(outside, of),
        _history(history, of, of.q, "black", BLUE),
    ]
    if space:
        moving.append(_history(history, of, of.flap, RED, RED))
        size = history.yaxis.label.get_fontsize()
        history.legend(history.lines[-4::2], "qw", ncols=2, loc="lower right", fontsize=size)
    history.set_ylabel("q/L, w/L" if space else "q/L")
    return history, moving


def _two_models(of: _Shown, beside: _Shown) -> tuple[Axes, list[_Moving]]:
    """Return both histories, and what moves: inertial views of the exact and the linear beam."""
    exact, linear, history = _axes(4.6, 2.0 * _REACH, 2.0 * _REACH)
    moving = []
    for ax, one, title, color in (
        (exact, of, "exact beam", "black"), (linear, beside, "linear floating frame", RED),
    ):  # fmt: skip
        _view(ax, title, of.reach)
        moving += [_clamp(ax, one), _beam(ax, one, color, color)]
    _scale_bar(exact, of, -_REACH)
    moving += [_history(history, one, one.q, c, c) for one, c in ((beside, RED), (of, "black"))]
    history.set(ylim=(-_REACH, _REACH), ylabel="q/L")
    _mark_instability(history, beside)
    return history, moving


def _beam(ax: Axes, of: _Shown, color: str, path: str, **view: Any) -> _Moving:
    """Return the beam, its tip and the tip's path, in a view that turns with the clamp or not."""
    shapes, *edges = of.seen(of.data, **view)
    tips = of.path(**view)
    trail = _FINER * round(_TRAIL / float(of.time[1] - of.time[0]))
    (strip,) = ax.fill([], [], color=BLUE, alpha=0.4, lw=0.0)
    (trace,) = ax.plot([], [], color=path, lw=1.0)
    width = 1.2 if of.leaves_plane else 2.5
    (blade,) = ax.plot([], [], color=color, lw=width, solid_capstyle="round")
    (tip,) = ax.plot([], [], "o", color=path, ms=4)

    def show(n: int) -> None:
        past = tips[max(0, _FINER * n - trail) : _FINER * n + 1]
        for line, z in ((blade, shapes[n]), (trace, past), (tip, past[-1:])):
            line.set_data(z.real, z.imag)
        if of.leaves_plane:
            around = np.concatenate((edges[0][n], edges[1][n, ::-1]))
            strip.set_xy(np.column_stack((around.real, around.imag)))

    return show


def _clamp(ax: Axes, of: _Shown) -> _Moving:
    """Return the line that turns with the clamp."""
    (line,) = ax.plot([], [], **_CLAMP)
    ray = 1.1 * of.reach * np.exp(1j * of.data["angle"].to_numpy())
    return lambda n: line.set_data([0.0, ray[n].real], [0.0, ray[n].imag])


def _mark_instability(history: Axes, of: _Shown) -> None:
    """Mark the first time at which the linear model is faster than its divergence speed."""
    rate = np.asarray(of.motion.rate(of.fine))
    faster = rate * of.blade.unit.setting > of.blade.omega_0
    if of.data.attrs["foreshortening"] or not faster.any():
        return
    start = of.fine[np.argmax(faster)]
    history.axvline(start, color=RED, lw=0.8, ls=(0, (4, 3)), zorder=1)
    # Where there is more room.
    side, shift = ("right", -4) if start > 0.5 * of.fine[-1] else ("left", 4)
    history.annotate(
        f"from {quantity(start, 's', 3)} on linear unstable", (start, 1.0), ha=side, va="top",
        xycoords=("data", "axes fraction"), xytext=(shift, -4), textcoords="offset points",
        color=RED,
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


def _view(ax: Axes, title: str, reach: float, left: float = _REACH) -> None:
    """Make a view of a beam that reaches so far, to scale, and `left` times as far behind."""
    ax.set(xlim=(-left * reach, _REACH * reach), ylim=(-_REACH * reach, _REACH * reach))
    ax.set(aspect="equal", xticks=[], yticks=[])
    ax.set_title(title, loc="left")
    ax.spines[:].set_visible(False)
    ax.plot([0.0], [0.0], "s", color="0.35", ms=6, zorder=3)


def _scale_bar(ax: Axes, of: _Shown, start: float) -> None:
    """Draw a bar of a round part of the beam's length below a view, and name the dashes above."""
    bar = one_two_five(0.5 * of.length)
    low, left, reach = -0.98 * _REACH * of.reach, start * of.reach, of.reach
    ax.plot([left, left + bar], [low, low], color="0.35", lw=1.0)
    ax.text(left + bar + 0.05 * reach, low, quantity(bar, "m"), va="center", color="0.35")
    above = low + 0.14 * reach
    ax.plot([left, left + 0.2 * reach], [above, above], **_CLAMP)
    ax.text(left + 0.25 * reach, above, "clamp", va="center", color="0.35")


def _history(history: Axes, of: _Shown, values: FloatArray, color: str, dot: str) -> _Moving:
    """Draw values over time, and return the point that moves on them."""
    history.plot(of.fine, CubicSpline(of.time, values)(of.fine), color=color)
    (point,) = history.plot([], [], "o", color=dot, ms=6, mec="white", mew=0.8)
    return lambda n: point.set_data([of.time[n]], [values[n]])
