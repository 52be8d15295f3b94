"""A beam that moves in a view: what the animations draw, picture by picture."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from analytic import LinearResponse, SpinUpResponse
from analytic.arrays import ComplexArray, FloatArray

from ..paper import BLUE, ORANGE

REACH = 1.08  # of a view, beyond the beam's length
CLAMP: Any = {"color": "0.6", "lw": 0.8, "ls": (0, (4, 3)), "zorder": 0}
"""How the line that turns with the clamp is drawn."""

_TRAIL = 0.6  # seconds of the tip's path that stay visible
_FINER = 8  # points of that path from one picture to the next
_FAR = 100.0  # lengths: what is farther is drawn there, out of every view

Response = SpinUpResponse | LinearResponse


class MovingBeam:
    """A beam, the path of its tip and the tip, in a view.

    Parameters
    ----------
    ax : Axes
        The view.
    response : SpinUpResponse or LinearResponse
        With points along the beam, at equally spaced times.
    turning : bool
        Whether the view turns with the clamp.
    color, path : str
        Of the beam, and of its tip.
    """

    def __init__(
        self,
        ax: Axes,
        response: Response,
        *,
        turning: bool = False,
        color: str = BLUE,
        path: str = ORANGE,
    ) -> None:
        time = response.time
        fine = between(time)
        # Between two pictures the tip goes on along its curve, not along a chord.
        beam = response.axis[..., 0] + 1j * response.axis[..., 1]
        tip: Any = CubicSpline(time, beam[:, -1])(fine)
        if not turning:
            beam, tip = beam * turned(response, time)[:, None], tip * turned(response, fine)
        far = _FAR * response.beam.length
        self.shapes, self.path = _nearer(beam, far), _nearer(tip, far)
        self._trail = _FINER * round(_TRAIL / float(time[1] - time[0]))
        (self._path,) = ax.plot([], [], color=path, lw=1.0)
        (self._beam,) = ax.plot([], [], color=color, lw=2.5, solid_capstyle="round")
        (self._tip,) = ax.plot([], [], "o", color=path, ms=4)

    def show(self, n: int) -> None:
        """Draw the beam at time number `n`."""
        past = self.path[max(0, _FINER * n - self._trail) : _FINER * n + 1]
        for line, z in (
            (self._beam, self.shapes[n]),
            (self._path, past),
            (self._tip, past[-1:]),
        ):
            line.set_data(z.real, z.imag)


def view(ax: Axes, title: str, length: float, left: float = REACH) -> None:
    """Make a view of a beam of that length, to scale, as far as `left` behind the clamp."""
    ax.set(xlim=(-left * length, REACH * length), ylim=(-REACH * length, REACH * length))
    ax.set(aspect="equal", xticks=[], yticks=[])
    ax.set_title(title, loc="left")
    ax.spines[:].set_visible(False)
    ax.plot([0.0], [0.0], "s", color="0.35", ms=6, zorder=3)


def scale_bar(ax: Axes, length: float, start: float = 0.0) -> None:
    """Draw a bar of a quarter of the beam's length below a view, and what the dashes are beside."""
    bar, low, left = 0.25 * length, -0.98 * REACH * length, start * length
    ax.plot([left, left + bar], [low, low], color="0.35", lw=1.0)
    ax.text(left + 1.2 * bar, low, f"{bar:g} m", va="center", color="0.35")
    ax.plot([left + 2.4 * bar, left + 3.2 * bar], [low, low], **CLAMP)
    ax.text(left + 3.4 * bar, low, "clamp", va="center", color="0.35")


def between(time: FloatArray) -> FloatArray:
    """Return the times of pictures and, evenly, some between them."""
    return np.linspace(time[0], time[-1], _FINER * (time.size - 1) + 1)


def turned(response: Response, time: FloatArray) -> NDArray[np.complex128]:
    """Return exp(iθ) of the clamp."""
    turn: NDArray[np.complex128] = np.exp(1j * response.spin_up.angle(time))
    return turn


def _nearer(z: ComplexArray, far: float) -> ComplexArray:
    return np.asarray(z * (far / np.maximum(np.abs(z), far)))
