"""Campbell diagram of the rotating beam: frequencies over the speed, tracked by shape."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import cached_property
from itertools import pairwise, product
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import optimize
from scipy.interpolate import PchipInterpolator

from ...arrays import FloatArray
from ...blade import Blade
from ...blade_checks import warn_if_rpm
from ...input_checks import finite_values, require_ascending, rotation_speed, whole_number
from ...plotting import apart, axes_or_new, cycled, free_place
from ...theory import BERNOULLI_EULER, Theory
from ...threads import one_thread
from .families import Family, LinearModes
from .modes import modes_from, modes_on

if TYPE_CHECKING:
    from ...plotting import Axes

_SOLVED, _DRAWN = 9, 61  # speeds of a picture's curves, besides their own: chords below a pixel
_LOOKS = ("lag", "flap", "torsion", "axial")  # families, by colors and dashes
_SPARE_MODES = 3  # beyond those asked for, so that a mode that sinks is still found


@dataclass(frozen=True, kw_only=True)
class Crossing:
    """A crossing of a Campbell diagram: the frequency of `mode` is k times the speed.

    Attributes
    ----------
    mode : str
        Name of the mode, as of its column.
    order : int
        Engine order k.
    omega : float
        Speed [rad/s].
    frequency : float
        Frequency kω [rad/s].
    """

    mode: str
    order: int
    omega: float
    frequency: float


@dataclass(frozen=True, kw_only=True)
class Campbell:
    """Frequencies against the speed; made by `campbell`.

    Attributes
    ----------
    blade : Blade
    omegas : ndarray (speeds,)
        Rotation speeds [rad/s].
    frequencies : ndarray (speeds, count)
        Frequencies in the rotating frame [rad/s], one column for each tracked mode.
    mac : ndarray (speeds - 1, count)
        Modal assurance criterion of each mode from one speed to the next; well below 1 the
        tracking is in doubt and the speeds are too far apart.
    crossings : tuple of Crossing
        Where frequencies cross the lines kω, k from 1, within the speeds.
    names : tuple of str
        The name of each column, "lag 1" say, by the shares of the mode at the lowest speed.
    theory : Theory
    error : float
        Largest relative change of the frequencies at both ends by the last refinement.

    Examples
    --------
    >>> from analytic import Beam, campbell
    >>> diagram = campbell(Beam.reference(), omegas=range(13), count=2, orders=5)
    >>> print(diagram.frequencies[-1].round(4), f"rad/s, tracked by {diagram.mac.min():.3f}")
    [ 4.8604 33.3739] rad/s, tracked by 0.994
    >>> axes = diagram.plot()
    """

    blade: Blade
    omegas: FloatArray
    frequencies: FloatArray
    mac: FloatArray
    crossings: tuple[Crossing, ...]
    names: tuple[str, ...]
    theory: Theory
    error: float
    _only: Family | None = field(repr=False)
    _tolerance: float | None = field(repr=False)

    @cached_property
    def _curves(self) -> tuple[FloatArray, FloatArray]:
        """Speeds near enough for a picture, and the frequencies there, (speeds, columns)."""
        even = np.linspace(self.omegas[0], self.omegas[-1], _SOLVED)
        apart_ = np.abs(even[:, None] - self.omegas).min(axis=1) > 0.5 * (even[1] - even[0])
        speeds, frequencies = self.omegas, self.frequencies
        if apart_.any():
            speeds = np.sort(np.concatenate((speeds, even[apart_])))
            more = _diagram(
                self.blade, speeds, len(self.names), 0, self._only, self.theory, self._tolerance
            )
            frequencies = more.frequencies
        drawn = np.union1d(np.linspace(speeds[0], speeds[-1], _DRAWN), speeds)
        # Squares of frequencies are nearly straight over those of the speed.
        squares = PchipInterpolator(speeds**2, frequencies**2)(drawn**2)
        return drawn, np.sqrt(squares)

    def plot(self, ax: Axes | None = None, *, highest: float | None = None) -> Axes:
        """Draw the frequencies, named, the lines kω that they cross, and where; return the axes.

        The curves go through speeds of their own, as many as a smooth picture takes.

        Parameters
        ----------
        ax : Axes, optional
            Drawn on these; otherwise on a new figure.
        highest : float, optional
            Frequency [rad/s] up to which is drawn; otherwise all are.
        """
        ax = axes_or_new(ax)
        low, high = float(self.omegas[0]), float(self.omegas[-1])
        omegas, curves = self._curves
        top = 1.05 * float(curves.max()) if highest is None else highest
        met = [c for c in self.crossings if c.frequency <= top]
        last = max((c.order for c in met), default=1)
        for order in range(1, last + 1):
            ax.plot([low, high], [order * low, order * high], color="0.75", lw=0.6, zorder=0)
            # Where the line leaves the frame: above it, or at its right where no mode passes.
            above = order * high > top
            at = top / order if above else free_place(omegas, curves, order, top)
            ax.text(
                at, min(order * at, top), f"{order}ω", color="0.45", fontsize="small",
                ha="center" if above and order < last else "right", va="bottom", clip_on=False,
            )  # fmt: skip
        kinds = [name.split()[0] for name in self.names]
        heights = apart(curves[-1], 0.045 * top)
        for kind, name, row, height in zip(kinds, self.names, curves.T, heights, strict=True):
            if row[-1] > top:
                continue  # leaves the frame, or never is in it
            family = _LOOKS.index(kind)
            (line,) = ax.plot(omegas, row, color=cycled(family), ls=("-", "--", "-.", ":")[family])
            ax.annotate(
                name, (high, height), xytext=(4, 0), textcoords="offset points",
                color=line.get_color(), va="center", annotation_clip=False,
            )  # fmt: skip
        crossed = np.array([(c.omega, c.frequency) for c in met]).reshape(-1, 2)
        ax.plot(*crossed.T, "k.", ms=4)
        ax.set(
            xlabel="angular velocity ω [rad/s]", ylabel="natural frequency [rad/s]",
            xlim=(low, high), ylim=(0.0, top),
        )  # fmt: skip
        return ax


@one_thread
def campbell(
    blade: Blade,
    omegas: ArrayLike,
    count: int = 3,
    orders: int = 6,
    *,
    only: Family | None = None,
    theory: Theory = BERNOULLI_EULER,
    tolerance: float | None = None,
) -> Campbell:
    """Return the Campbell diagram of the first `count` modes, tracked by their shapes.

    Parameters
    ----------
    blade : Blade
    omegas : array_like
        Rotation speeds [rad/s], ascending.
    count : int
        Number of modes, those lowest at the first speed.
    orders : int
        Lines kω up to this k.
    only : {"flap", "lag", "torsion", "axial"}, optional
        One family, as of `linear_modes`.
    theory : Theory
        Extension, shear, rotary inertia and trapeze effect.
    tolerance : float, optional
        As of `linear_modes`.

    Raises
    ------
    ValueError
        If the speeds do not ascend from 0 or above, or `linear_modes` refuses one.

    Examples
    --------
    >>> from analytic import Beam, campbell
    >>> diagram = campbell(Beam.reference(), omegas=range(0, 13, 3), count=2, orders=4)
    >>> for meeting in diagram.crossings[:3]:
    ...     print(f"{meeting.mode} meets {meeting.order}ω at {meeting.omega:.3f} rad/s")
    lag 1 meets 1ω at 3.208 rad/s
    lag 1 meets 2ω at 1.490 rad/s
    lag 1 meets 3ω at 0.980 rad/s
    """
    speeds = finite_values("omegas", omegas, "rad/s")
    for speed in speeds:
        rotation_speed(float(speed), "omegas")
    require_ascending("omegas", speeds, "rad/s")
    count, orders = whole_number("count", count), whole_number("orders", orders)
    return _diagram(blade, speeds, count, orders, only, theory, tolerance)


def _diagram(
    blade: Blade,
    speeds: FloatArray,
    count: int,
    orders: int,
    only: Family | None,
    theory: Theory,
    tolerance: float | None,
) -> Campbell:
    """Return the diagram of so many modes."""
    wanted = count + _SPARE_MODES
    ends: list[LinearModes] = []
    warn_if_rpm(blade, float(speeds[-1]))
    for omega in sorted({float(speeds[0]), float(speeds[-1])}):
        near = ends[-1] if ends else None
        ends.append(
            modes_from(near, blade, omega, wanted, only, theory, max(20, 2 * wanted), tolerance)
        )
    # A model that resolves the modes at both ends does so between them.
    finest = max(ends, key=lambda modes: modes.model.size)

    def modes_at(omega: float, near: LinearModes | None = None) -> LinearModes:
        return modes_on(finest.model, finest.blade, omega, wanted, theory, only, near=near)

    found: list[LinearModes] = []
    for omega in speeds.tolist():
        found.append(modes_at(omega, *found[-1:]))
    columns = [np.arange(count)]
    assurances = []
    for here, there in pairwise(found):
        assurance = _assurance(here, there)[columns[-1]]
        columns.append(_followed(assurance))
        assurances.append(assurance[np.arange(count), columns[-1]])

    names = found[0].names[:count]
    crossings = [
        Crossing(mode=names[column], order=order, omega=omega, frequency=order * omega)
        for pair, places in zip(pairwise(found), pairwise(columns), strict=True)
        for column, order, omega in _met(pair, places, orders, modes_at)
    ]
    return Campbell(
        blade=blade,
        omegas=speeds,
        frequencies=np.array([m.frequencies[c] for m, c in zip(found, columns, strict=True)]),
        mac=np.array(assurances).reshape(-1, count),
        crossings=tuple(sorted(crossings, key=lambda c: (names.index(c.mode), c.order))),
        names=names,
        theory=theory,
        error=max(modes.error for modes in ends),
        _only=only,
        _tolerance=tolerance,
    )


def _met(
    ends: tuple[LinearModes, LinearModes],
    columns: tuple[NDArray[np.intp], NDArray[np.intp]],
    orders: int,
    modes_at: Callable[..., LinearModes],
) -> Iterator[tuple[int, int, float]]:
    """Yield column, k and ω where frequencies cross kω between two speeds.

    In ascending order frequencies are continuous. A mode followed by its shape changes its place
    at once where two of them veer, and passes a line in between without being there.
    """
    known = {modes.omega: modes for modes in ends}

    def at(square: float) -> LinearModes:
        omega = math.sqrt(square)
        if omega not in known:
            known[omega] = modes_at(omega, min(ends, key=lambda modes: abs(modes.omega - omega)))
        return known[omega]

    def detuning(square: float, place: int, order: int) -> float:
        # Squares of frequencies are nearly straight over that of the speed.
        return float(at(square).frequencies[place] ** 2 - order**2 * square)

    for place, order in product(np.union1d(*columns).tolist(), range(1, orders + 1)):
        before, after = (modes.frequencies[place] - order * modes.omega for modes in ends)
        if before > 0.0 >= after or before < 0.0 <= after:
            low, high = (modes.omega**2 for modes in ends)
            square = optimize.toms748(
                detuning, low, high, args=(place, order), xtol=1e-13 * high, rtol=1e-13
            )
            held = _followed(_assurance(ends[0], at(square))[columns[0]])
            for column in np.flatnonzero(held == place).tolist():
                yield column, order, math.sqrt(square)


def _followed(assurance: FloatArray) -> NDArray[np.intp]:
    """Return the mode that continues each tracked one, all of them different."""
    return np.asarray(optimize.linear_sum_assignment(-assurance)[1])


def _assurance(one: LinearModes, other: LinearModes) -> FloatArray:
    """Modal assurance criterion of all pairs, in the energy norm of the beam at rest."""
    a, b = one.coordinates, other.coordinates
    a = a / np.linalg.norm(a, axis=1, keepdims=True)
    b = b / np.linalg.norm(b, axis=1, keepdims=True)
    return np.asarray(np.abs(a.conj() @ b.T) ** 2)
