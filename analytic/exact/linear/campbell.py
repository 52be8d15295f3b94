"""Campbell diagram of the rotating beam: frequencies over the speed, tracked by shape."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from itertools import chain, pairwise
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from ...arrays import FloatArray
from ...blade import Blade
from ...blade_checks import warn_if_rpm
from ...input_checks import finite_values, require_ascending, rotation_speed, whole_number
from ...lazily import interpolate
from ...plotting import DASHES, apart, axes_or_new, cycled, free_place
from ...settled import require_tolerance
from ...theory import BERNOULLI_EULER, Theory
from ...threads import one_thread
from ..continuum.rotation import rotating_blade
from .families import Family, LinearModes, mode_names, places_of
from .modes import modes_from
from .speeds import SpeedRange, Stop, range_between

if TYPE_CHECKING:
    from ...plotting import Axes

_SOLVED, _DRAWN = 9, 61  # speeds of a picture's curves, besides their own: chords below a pixel
_SPARE_MODES = 3  # resolved beyond those asked for, as some rise above others
_HERTZ, _PER_MINUTE = (
    (lambda x, n=n: x * n / (2.0 * np.pi), lambda x, n=n: x * (2.0 * np.pi) / n) for n in (1, 60)
)
_KNOWN = 1e-6  # by which two models may differ in a frequency


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
        Least modal assurance criterion of each mode on the way from one speed to the next, by
        steps that are halved where it is below 0.7; where it still is, the tracking is in doubt.
    crossings : tuple of Crossing
        Where frequencies cross the lines kω, k from 1, within the speeds.
    names : tuple of str
        The name of each column, "lag 1" say, by the shares of the mode at the lowest speed.
    last_names : tuple of str
        The same at the highest speed: where modes veer, they exchange their shares.
    theory : Theory
    error : float
        Largest relative change of the frequencies by the last refinement at both ends, and by the
        last speed that was solved between them.

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
    last_names: tuple[str, ...]
    theory: Theory
    error: float
    _between: SpeedRange = field(repr=False)
    _places: list[int] = field(repr=False)

    @property
    def titles(self) -> tuple[str, ...]:
        """The names, and where another one is the last both, as "flap 1 → lag 1"."""
        pairs = zip(self.names, self.last_names, strict=True)
        return tuple(first if first == last else f"{first} → {last}" for first, last in pairs)

    @cached_property
    def _curves(self) -> tuple[FloatArray, FloatArray]:
        """Speeds near enough for a picture, and the frequencies there, (speeds, columns)."""
        speeds = np.union1d(np.linspace(self.omegas[0], self.omegas[-1], _SOLVED), self.omegas)
        scale = self.blade.frequency_scale
        frequencies = scale * _frequencies(self._between.way(speeds / scale, self._places))
        drawn = np.union1d(np.linspace(speeds[0], speeds[-1], _DRAWN), speeds)
        # Squares of frequencies are nearly straight over those of the speed.
        squares = interpolate.PchipInterpolator(speeds**2, frequencies**2)(drawn**2)
        return drawn, np.sqrt(squares)

    def plot(
        self,
        ax: Axes | None = None,
        *,
        highest: float | None = None,
        deviations: FloatArray | None = None,
    ) -> Axes:
        """Draw the frequencies, named, the lines kω that they cross, and where; return the axes.

        The curves go through speeds of their own, as many as a smooth picture takes.

        Parameters
        ----------
        ax : Axes, optional
            Drawn on these; otherwise on a new figure.
        highest : float, optional
            Frequency [rad/s] up to which is drawn; otherwise all are.
        deviations : ndarray (speeds, count), optional
            Standard deviations of the frequencies [rad/s]: bands of two of them are shaded.
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
        wide = np.zeros_like(self.frequencies) if deviations is None else 2.0 * deviations
        for kind, title, row, height, band in zip(
            kinds, self.titles, curves.T, heights, wide.T, strict=True
        ):
            if row[-1] > top:
                continue  # leaves the frame, or never is in it
            color = cycled(list(DASHES).index(kind))
            (line,) = ax.plot(omegas, row, color=color, ls=DASHES[kind])
            if deviations is not None:
                half = np.interp(omegas, self.omegas, band)
                ax.fill_between(omegas, row - half, row + half, color=color, alpha=0.2, lw=0.0)
            ax.annotate(
                title, (high, height), xytext=(4, 0), textcoords="offset points",
                color=line.get_color(), va="center", annotation_clip=False,
            )  # fmt: skip
        crossed = np.array([(c.omega, c.frequency) for c in met]).reshape(-1, 2)
        ax.plot(*crossed.T, "k.", ms=4)
        ax.set(
            xlabel="angular velocity ω [rad/s]", ylabel="natural frequency [rad/s]",
            xlim=(low, high), ylim=(0.0, top),
        )  # fmt: skip
        # Names are at the right, and orders on top.
        ax.secondary_xaxis(-0.22, functions=_PER_MINUTE).set_xlabel("speed [rpm]")
        ax.secondary_yaxis(-0.2, functions=_HERTZ).set_ylabel("[Hz]")
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
    warn_if_rpm(blade, float(speeds[-1]))
    ends = np.unique(speeds[[0, -1]]).tolist()

    def resolved(omega: float, wanted: int, near: LinearModes | None) -> LinearModes:
        functions = max(20, 2 * wanted)
        return modes_from(near, blade, omega, wanted, only, theory, functions, tolerance)

    wanted = count + _SPARE_MODES
    low = resolved(ends[0], wanted, None)
    while True:
        modes = [low, *(resolved(omega, wanted, low) for omega in ends[1:])]
        # A model that resolves the modes at both ends does so between them.
        finest = max(modes, key=lambda one: one.model.size)
        steady = [
            one.steady
            if one.model is finest.model
            else rotating_blade(finest.blade, one.omega, finest.model)
            for one in modes
        ]
        known = modes[-1].frequencies[-1] / blade.frequency_scale
        told = int(np.searchsorted(steady[-1].vibration[0], (1.0 + _KNOWN) * known))
        between, error = range_between(
            steady,
            told,
            require_tolerance(tolerance, finest.model.tolerance),
            f"the frequencies from {ends[0]:g} to {ends[-1]:g} rad/s",
        )
        all_names = mode_names(steady[0].shares)
        places = places_of(all_names, count, only)
        ways = between.way(speeds / blade.frequency_scale, places)
        last = ways[-1][-1]
        if last.places.max() < told:
            break
        # One of them has risen above others.
        below = mode_names(last.steady.shares)[: last.places.max() + 1]
        wanted = max(wanted + 1, len(places_of(below, len(below), only)))

    names = tuple(all_names[place] for place in places)
    at_last = mode_names(last.steady.shares)
    crossings = [
        Crossing(
            mode=names[column],
            order=order,
            omega=rate * blade.frequency_scale,
            frequency=order * (rate * blade.frequency_scale),
        )
        for before, after in pairwise(chain.from_iterable(ways))
        for column, order, rate in between.crossings(before, after, orders)
    ]
    return Campbell(
        blade=blade,
        omegas=speeds,
        frequencies=_frequencies(ways) * blade.frequency_scale,
        mac=np.array(
            [np.min([stop.assurance for stop in way], axis=0) for way in ways[1:]]
        ).reshape(-1, count),
        crossings=tuple(sorted(crossings, key=lambda c: (names.index(c.mode), c.order))),
        names=names,
        last_names=tuple(at_last[place] for place in last.places),
        theory=theory,
        error=max(error, *(one.error for one in modes)),
        _between=between,
        _places=places,
    )


def _frequencies(ways: list[list[Stop]]) -> FloatArray:
    """Return the frequencies where each way ends, (speeds, columns)."""
    return np.array([way[-1].steady.vibration[0][way[-1].places] for way in ways])
