"""The spinning beam as a moving picture: inertial and rotating view, and the tip's deflection."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.animation import FFMpegWriter, FuncAnimation, PillowWriter
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from analytic import SpinUpResponse
from analytic.arrays import FloatArray

from ..paper import BLUE, ORANGE
from .style import STYLE, new_figure

_DPI = 100
_TRAIL = 0.6  # seconds of the tip's path that stay visible
_FINER = 8  # points of that path from one picture to the next
_CLAMP: Any = {"color": "0.6", "lw": 0.8, "ls": (0, (4, 3)), "zorder": 0}


def animate(response: SpinUpResponse, *, rate: float | None = None) -> FuncAnimation:
    """Return the animation of a spin-up, one picture per time of the response.

    Parameters
    ----------
    response : SpinUpResponse
        With `points` along the beam, at equally spaced times.
    rate : float, optional
        Pictures a second; by default real time.

    Raises
    ------
    ValueError
        If the response has no points along the beam or fewer than two times.
    """
    if response.axis.shape[1] < 2 or response.time.size < 2:
        raise ValueError(
            "nothing to animate: ask spin_up_response for points along the beam, "
            f"got {response.axis.shape[1]} of them at {response.time.size} times"
        )
    time = response.time
    interval = float(time[1] - time[0])
    turning = response.axis[..., 0] + 1j * response.axis[..., 1]
    turn = _turned(response, time)
    # Between two pictures the tip goes on along its curve, not along a chord.
    fine = _between(time)
    tip = CubicSpline(time, turning[:, -1])(fine)
    trail = _FINER * round(_TRAIL / interval)
    with mpl.rc_context(STYLE):
        inertial_view, rotating_view, history = _axes(response)
        views = [
            (_lines(inertial_view), turning * turn[:, None], tip * _turned(response, fine)),
            (_lines(rotating_view), turning, tip),
        ]
        (clamp,) = inertial_view.plot([], [], **_CLAMP)
        (dot,) = history.plot([], [], "o", color=ORANGE, ms=6, mec="white", mew=0.8)
        words = history.set_title("", loc="left", family="monospace")
        figure: Any = history.get_figure(root=True)

    def draw(n: int) -> list[Any]:
        for (beam, path, end), shapes, curve in views:
            beam.set_data(shapes[n].real, shapes[n].imag)
            past = curve[max(0, _FINER * n - trail) : _FINER * n + 1]
            path.set_data(past.real, past.imag)
            end.set_data(past[-1:].real, past[-1:].imag)
        ray = 1.1 * response.beam.length * turn[n]
        clamp.set_data([0.0, ray.real], [0.0, ray.imag])
        dot.set_data([time[n]], [response.q[n]])
        words.set_text(
            f"t = {time[n]:5.2f} s   dθ/dt = {float(response.spin_up.rate(time[n])):4.2f} rad/s   "
            f"q = {response.q[n]:+5.2f} m".replace("-", "−")
        )
        return []

    milliseconds = 1000.0 / (rate or 1.0 / interval)
    return FuncAnimation(figure, draw, frames=time.size, interval=milliseconds, blit=False)


def save_animation(
    response: SpinUpResponse,
    path: Path,
    *,
    rate: float | None = None,
    progress: Callable[[int], None] | None = None,
) -> None:
    """Write the animation of a spin-up as .gif or, with ffmpeg, as .mp4.

    Parameters
    ----------
    response, rate
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
    animation = animate(response, rate=rate)
    interval = float(response.time[1] - response.time[0])
    writer_class = PillowWriter if path.suffix == ".gif" else FFMpegWriter
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


def _axes(response: SpinUpResponse) -> tuple[Axes, Axes, Axes]:
    """Return the views, of one scale and with what does not move, and the history of q."""
    length, reach, behind = response.beam.length, 1.08, 0.12
    ratios = {"height_ratios": (3.0, 1.0), "width_ratios": (2.0 * reach, reach + behind)}
    # Solving the layout for every picture would take most of the time, and let the axes tremble.
    figure, axes = new_figure(6.4, 5.2, nrows=2, ncols=2, layout="none", **ratios)
    figure.subplots_adjust(0.09, 0.085, 0.985, 0.955, wspace=0.04, hspace=0.16)
    for ax in axes[1]:
        ax.remove()
    history = figure.add_subplot(axes[1, 0].get_gridspec()[1, :])
    for ax, left, title in zip(
        axes[0], (reach, behind), ("inertial frame", "rotating frame"), strict=True
    ):
        ax.set(xlim=(-left * length, reach * length), ylim=(-reach * length, reach * length))
        ax.set(aspect="equal", xticks=[], yticks=[])
        ax.set_title(title, loc="left")
        ax.spines[:].set_visible(False)
        ax.plot([0.0], [0.0], "s", color="0.35", ms=6, zorder=3)
    axes[0, 1].plot([0.0, 1.1 * length], [0.0, 0.0], **_CLAMP)
    bar, low = 0.25 * length, -0.98 * reach * length
    axes[0, 1].plot([0.0, bar], [low, low], color="0.35", lw=1.0)
    axes[0, 1].text(1.2 * bar, low, f"{bar:g} m", va="center", color="0.35")
    history.axvspan(0.0, response.spin_up.ramp_time, color="0.93", lw=0)
    history.axhline(0.0, color="0.6", lw=0.5)
    fine = _between(response.time)
    history.plot(fine, CubicSpline(response.time, response.q)(fine), color=BLUE)
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
    return axes[0, 0], axes[0, 1], history


def _between(time: FloatArray) -> FloatArray:
    return np.linspace(time[0], time[-1], _FINER * (time.size - 1) + 1)


def _turned(response: SpinUpResponse, time: FloatArray) -> NDArray[np.complex128]:
    turn: NDArray[np.complex128] = np.exp(1j * response.spin_up.angle(time))
    return turn


def _lines(ax: Axes) -> tuple[Line2D, Line2D, Line2D]:
    """Return the beam, the tip's path and the tip, still empty."""
    (path,) = ax.plot([], [], color=ORANGE, lw=1.0)
    (line,) = ax.plot([], [], color=BLUE, lw=2.5, solid_capstyle="round")
    (tip,) = ax.plot([], [], "o", color=ORANGE, ms=4)
    return line, path, tip
