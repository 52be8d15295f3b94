"""The spinning beam as a moving picture: in two frames, or beside the linear model."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, cast

import matplotlib as mpl
import numpy as np
from matplotlib.animation import FFMpegWriter, FuncAnimation, PillowWriter
from matplotlib.axes import Axes
from scipy.interpolate import CubicSpline

from analytic.arrays import ComplexArray, FloatArray
from analytic.motion import SpeedChange

from ..lazily import xr
from ..paper import BLUE, RED
from ..runs.attributes import beam_of, motion_of
from ..runs.shape import in_space
from .style import STYLE, fitting_units, new_figure, prefix_of, quantity, shade_ramp

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
        If there are fewer than two stations or times, or `beside` is of other times or of another
        motion.
    """
    _require_drawable(data, beside)
    time, motion = _times(data), cast(SpeedChange, motion_of(data.attrs))
    (scale, prefix), faster = prefix_of(time[-1]), prefix_of(motion.fastest)
    q, flap, space = _q(data), _flap(data), _leaves_plane(data)
    with mpl.rc_context({**STYLE, **_LETTERS}):
        history, moving = _two_models(data, beside) if beside is not None else _two_frames(data)
        _ramp(history, data)
        words = history.set_title("", loc="left", family="monospace")
        figure: Any = history.get_figure(root=True)

    def draw(n: int) -> list[Any]:
        for move in moving:
            move(n)
        rate_now = float(motion.rate(time[n])) / faster[0]
        line = f"t = {time[n] / scale:5.2f} {prefix}s  dθ/dt = {rate_now:4.2f} {faster[1]}rad/s"
        line += f"  q/L = {q[n]:+5.2f}"
        if beside is not None:
            other = _q(beside)[n]
            line += f", linear {other:{'+6.2f' if abs(other) < 100.0 else '+6.0f'}}"
        elif space:
            line += f"  w/L = {flap[n]:+5.2f}"
        words.set_text(line.replace("-", "−"))
        return []

    interval = 1000.0 / (rate or 1.0 / (time[1] - time[0]))  # [ms]
    return FuncAnimation(figure, draw, frames=time.size, interval=interval, blit=False)


def _require_drawable(data: xr.Dataset, beside: xr.Dataset | None) -> None:
    for one in (data, data if beside is None else beside):
        stations, times = (one.sizes.get(name, 0) for name in ("station", "time"))
        if "place" not in one or stations < 2 or times < 2:
            raise ValueError(
                "nothing to animate: ask spin_up_response for points along the beam, or simulate "
                f"for stations, got {stations} of them at {times} times"
            )
    if beside is not None and not (
        np.array_equal(_times(beside), _times(data))
        and motion_of(beside.attrs) == motion_of(data.attrs)
    ):
        raise ValueError(
            "what is shown beside a spin-up must be of the same motion at the same times: give "
            "linear_response what spin_up_response was given"
        )


def _times(data: xr.Dataset) -> FloatArray:
    return np.asarray(data["time"].to_numpy())


def _reach(data: xr.Dataset) -> float:
    """Return how far the blade reaches from the axis of rotation [m]."""
    blade = beam_of(data.attrs)
    return blade.length + blade.hub_radius


def _q(data: xr.Dataset) -> FloatArray:
    """Return q/L, (times,)."""
    return np.asarray(data["q"].to_numpy() / data.attrs["beam_length"])


def _flap(data: xr.Dataset) -> FloatArray:
    """Return the tip's place normal to the clamp over L, (times,)."""
    return np.asarray(data["place"].to_numpy()[:, -1, 2] / data.attrs["beam_length"])


def _leaves_plane(data: xr.Dataset) -> bool:
    return bool(data["place"].to_numpy()[..., 2].any())


def save_animation(
    data: xr.Dataset,
    path: Path,
    *,
    beside: xr.Dataset | None = None,
    rate: float | None = None,
    progress: Callable[[int], None] | None = None,
) -> None:
    """Write the animation of a blade as .gif or, with ffmpeg, as .mp4.

    Parameters
    ----------
    data, beside, rate
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
    animation = animate(data, beside=beside, rate=rate)
    fps: Any = rate or 1.0 / float(np.diff(_times(data)[:2])[0])
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


def _two_frames(data: xr.Dataset) -> tuple[Axes, list[_Moving]]:
    """Return the histories, and what moves: the inertial and the rotating view, in one scale."""
    behind = 0.12
    outside, inside, history = _axes(5.2, 2.0 * _REACH, _REACH + behind)
    reach, space = _reach(data), _leaves_plane(data)
    _view(outside, "from above" if space else "inertial frame", reach)
    _view(inside, "from the side" if space else "rotating frame", reach, behind)
    _scale_bar(inside, data, 0.0)
    ray = 1.1 * reach * np.exp(1j * beam_of(data.attrs).blade.line.precone)
    inside.plot([0.0, ray.real], [0.0, ray.imag], **_CLAMP)
    moving = [
        _beam(outside, data, "black", BLUE),
        _beam(inside, data, "black", BLUE, turning=True, up=_SIDE if space else _ABOVE),
        _clamp(outside, data),
        _history(history, data, _q(data), "black", BLUE),
    ]
    if space:
        moving.append(_history(history, data, _flap(data), RED, RED))
        size = history.yaxis.label.get_fontsize()
        history.legend(history.lines[-4::2], "qw", ncols=2, loc="lower right", fontsize=size)
    history.set_ylabel("q/L, w/L" if space else "q/L")
    return history, moving


def _two_models(data: xr.Dataset, beside: xr.Dataset) -> tuple[Axes, list[_Moving]]:
    """Return both histories, and what moves: inertial views of the exact and the linear beam."""
    exact, linear, history = _axes(4.6, 2.0 * _REACH, 2.0 * _REACH)
    reach, moving = _reach(data), []
    for ax, of, title, color in (
        (exact, data, "exact beam", "black"),
        (linear, beside, "linear floating frame", RED),
    ):
        _view(ax, title, reach)
        moving += [_clamp(ax, of), _beam(ax, of, color, color)]
    _scale_bar(exact, data, -_REACH)
    moving += [_history(history, of, _q(of), c, c) for of, c in ((beside, RED), (data, "black"))]
    history.set(ylim=(-_REACH, _REACH), ylabel="q/L")
    _mark_instability(history, beside)
    return history, moving


def _seen(data: xr.Dataset, *, turning: bool = False, up: int = _ABOVE) -> ComplexArray:
    """Return the axis and the edges of the strip in a view, (3, times, stations) [m]."""
    place, section = in_space(data.drop_vars("angle") if turning else data)
    half = 0.5 * _CHORD * data.attrs["beam_length"] * section[..., 1]
    rows = np.stack(np.broadcast_arrays(place, place + half, place - half))
    z, far = rows[..., 0] + 1j * rows[..., up], _FAR * data.attrs["beam_length"]
    return np.asarray(z * (far / np.maximum(np.abs(z), far)))


def _path(data: xr.Dataset, *, turning: bool = False, up: int = _ABOVE) -> ComplexArray:
    """Return the tip's path in a view [m]: along its curve, not along chords between pictures."""
    time = _times(data)
    given = data[["place", "angle"]].isel(station=[-1])
    finer = {
        name: (one.dims, CubicSpline(time, one.to_numpy())(_between(time)))
        for name, one in given.items()
    }
    return _seen(xr.Dataset(finer, attrs=data.attrs), turning=turning, up=up)[0, :, 0]


def _beam(
    ax: Axes, data: xr.Dataset, color: str, path: str, *, turning: bool = False, up: int = _ABOVE
) -> _Moving:
    """Return the beam, its tip and the tip's path, in a view that turns with the clamp or not."""
    shapes, *edges = _seen(data, turning=turning, up=up)
    tips = _path(data, turning=turning, up=up)
    trail = _FINER * round(_TRAIL / float(np.diff(_times(data)[:2])[0]))
    (strip,) = ax.fill([], [], color=BLUE, alpha=0.4, lw=0.0)
    (trace,) = ax.plot([], [], color=path, lw=1.0)
    space = _leaves_plane(data)
    (beam,) = ax.plot([], [], color=color, lw=1.2 if space else 2.5, solid_capstyle="round")
    (tip,) = ax.plot([], [], "o", color=path, ms=4)

    def show(n: int) -> None:
        past = tips[max(0, _FINER * n - trail) : _FINER * n + 1]
        for line, z in ((beam, shapes[n]), (trace, past), (tip, past[-1:])):
            line.set_data(z.real, z.imag)
        if space:
            around = np.concatenate((edges[0][n], edges[1][n, ::-1]))
            strip.set_xy(np.column_stack((around.real, around.imag)))

    return show


def _clamp(ax: Axes, data: xr.Dataset) -> _Moving:
    """Return the line that turns with the clamp."""
    (line,) = ax.plot([], [], **_CLAMP)
    ray = 1.1 * _reach(data) * np.exp(1j * data["angle"].to_numpy())
    return lambda n: line.set_data([0.0, ray[n].real], [0.0, ray[n].imag])


def _mark_instability(history: Axes, beside: xr.Dataset) -> None:
    """Mark the first time at which the linear model is faster than its divergence speed."""
    fine, beam = _between(_times(beside)), beam_of(beside.attrs)
    rate = np.asarray(motion_of(beside.attrs).rate(fine))
    faster = rate * beam.unit.setting > beam.omega_0
    if beside.attrs["foreshortening"] or not faster.any():
        return
    start = fine[np.argmax(faster)]
    history.axvline(start, color=RED, lw=0.8, ls=(0, (4, 3)), zorder=1)
    # Where there is more room.
    side, shift = ("right", -4) if start > 0.5 * fine[-1] else ("left", 4)
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


def _view(ax: Axes, title: str, reach: float, left: float = _REACH) -> None:
    """Make a view of a beam that reaches so far, to scale, and `left` times as far behind."""
    ax.set(xlim=(-left * reach, _REACH * reach), ylim=(-_REACH * reach, _REACH * reach))
    ax.set(aspect="equal", xticks=[], yticks=[])
    ax.set_title(title, loc="left")
    ax.spines[:].set_visible(False)
    ax.plot([0.0], [0.0], "s", color="0.35", ms=6, zorder=3)


def _scale_bar(ax: Axes, data: xr.Dataset, start: float) -> None:
    """Draw a bar of a quarter of the beam's length below a view, and name the dashes beside it."""
    bar, reach = 0.25 * data.attrs["beam_length"], _reach(data)
    low, left = -0.98 * _REACH * reach, start * reach
    ax.plot([left, left + bar], [low, low], color="0.35", lw=1.0)
    ax.text(left + 1.2 * bar, low, quantity(bar, "m"), va="center", color="0.35")
    ax.plot([left + 2.6 * bar, left + 3.3 * bar], [low, low], **_CLAMP)
    ax.text(left + 3.5 * bar, low, "clamp", va="center", color="0.35")


def _history(history: Axes, data: xr.Dataset, values: FloatArray, color: str, dot: str) -> _Moving:
    """Draw values over time, and return the point that moves on them."""
    time = _times(data)
    fine = _between(time)
    history.plot(fine, CubicSpline(time, values)(fine), color=color)
    (point,) = history.plot([], [], "o", color=dot, ms=6, mec="white", mew=0.8)
    return lambda n: point.set_data([time[n]], [values[n]])


def _ramp(history: Axes, data: xr.Dataset) -> None:
    """Shade the spin-up, and name the axis."""
    shade_ramp(history, data.attrs["ramp_time"])
    history.axhline(0.0, color="0.6", lw=0.5)
    history.set(xlim=(0.0, _times(data)[-1]), xlabel="time [s]")
    fitting_units(history)


def _between(time: FloatArray) -> FloatArray:
    """Return the times of pictures and, evenly, some between them."""
    return np.linspace(time[0], time[-1], _FINER * (time.size - 1) + 1)
