"""Campbell diagram of the rotating beam: frequencies over the speed, tracked by shape."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise, product
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import optimize
from scipy.interpolate import PchipInterpolator

from ...arrays import FloatArray
from ...beam import AnyBlade
from ...input_checks import finite_values, require_ascending, rotation_speed, whole_number
from ...plotting import apart, axes_or_new, cycled, free_place
from ...theory import BERNOULLI_EULER, Theory
from ...threads import one_thread
from ..space.modes import LinearModes, space_modes_on
from ..space.steady import lives_in_space
from .modes import Plane, linear_modes, modes_on

if TYPE_CHECKING:
    from ...plotting import Axes

_SOLVED, _DRAWN = 9, 61  # speeds of a picture's curves, besides their own: chords below a pixel
_SPARE_MODES = 3  # beyond those asked for, so that a mode that sinks is still found
_TURNED = 1e-12  # of cos ψ, which is no number of its own at a right angle


@dataclass(frozen=True, kw_only=True)
class Crossing:
    """A crossing of a Campbell diagram: the frequency of `mode` is k times the speed.

    Attributes
    ----------
    mode : int
        Mode, from 1, in the order of its family's frequencies at the lowest speed.
    order : int
        Engine order k.
    omega : float
        Speed [rad/s].
    frequency : float
        Frequency kω [rad/s].
    plane : str
        Its family: "lag", the blade's own plane of bending, "flap" or "torsion".
    """

    mode: int
    order: int
    omega: float
    frequency: float
    plane: Plane = "lag"


@dataclass(frozen=True, kw_only=True)
class Campbell:
    """Frequencies against the speed; made by `campbell`.

    Attributes
    ----------
    beam : Beam or Blade
    omegas : ndarray (speeds,)
        Rotation speeds [rad/s].
    frequencies : ndarray (speeds, count)
        Frequencies in the rotating frame [rad/s], one column for each tracked mode, family by
        family.
    mac : ndarray (speeds - 1, count)
        Modal assurance criterion of each mode from one speed to the next; well below 1 the
        tracking is in doubt and the speeds are too far apart.
    crossings : tuple of Crossing
        Where frequencies cross the lines kω, k from 1, within the speeds.
    planes : tuple of str
        The family of each column.
    theory : Theory

    Examples
    --------
    >>> from analytic import Beam, campbell
    >>> diagram = campbell(Beam.reference(), omegas=range(13), count=2, orders=5)
    >>> print(diagram.frequencies[-1].round(4), f"rad/s, tracked by {diagram.mac.min():.3f}")
    [ 4.8604 33.3739] rad/s, tracked by 0.994
    >>> axes = diagram.plot()
    """

    beam: AnyBlade
    omegas: FloatArray
    frequencies: FloatArray
    mac: FloatArray
    crossings: tuple[Crossing, ...]
    planes: tuple[Plane, ...]
    theory: Theory

    @property
    def names(self) -> list[str]:
        """The name of each column: as "flap 1", or "mode 1 at 45°" of a blade set at an angle.

        Set at a right angle the blade's own plane of bending is that of flap.
        """
        numbers = [self.planes[:k].count(plane) + 1 for k, plane in enumerate(self.planes)]
        across = abs(self.beam.unit.setting)
        if lives_in_space(self.beam):
            return [f"mode {k}" for k in numbers]
        if "lag" not in self.planes or across > 1.0 - _TURNED:
            return [f"{plane} {k}" for plane, k in zip(self.planes, numbers, strict=True)]
        if across < _TURNED:
            return [f"flap {k}" for k in numbers]
        angle = math.degrees(math.acos(across))
        return [f"mode {k} at {angle:.4g}°" for k in numbers]

    def name_of(self, crossing: Crossing) -> str:
        """Return the name of the mode that crosses."""
        return self.names[self.planes.index(crossing.plane) + crossing.mode - 1]

    @cached_property
    def _curves(self) -> tuple[FloatArray, FloatArray]:
        """Speeds near enough for a picture, and the frequencies there, (speeds, columns)."""
        even = np.linspace(self.omegas[0], self.omegas[-1], _SOLVED)
        apart_ = np.abs(even[:, None] - self.omegas).min(axis=1) > 0.5 * (even[1] - even[0])
        speeds, frequencies = self.omegas, self.frequencies
        if apart_.any():
            speeds = np.sort(np.concatenate((speeds, even[apart_])))
            counts = Counter(self.planes)
            frequencies = _diagram(self.beam, speeds, counts, 0, self.theory).frequencies
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
        families = list(dict.fromkeys(self.planes))
        heights = apart(curves[-1], 0.045 * top)
        for plane, name, row, height in zip(
            self.planes, self.names, curves.T, heights, strict=True
        ):
            if row[-1] > top:
                continue  # leaves the frame, or never is in it
            family = families.index(plane)
            (line,) = ax.plot(omegas, row, color=cycled(family), ls=("-", "--", "-.")[family])
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
    beam: AnyBlade,
    omegas: ArrayLike,
    count: int = 3,
    orders: int = 6,
    *,
    planes: Sequence[Plane] = ("lag",),
    theory: Theory = BERNOULLI_EULER,
) -> Campbell:
    """Return the Campbell diagram of the first `count` modes, by default of modes in the plane.

    Parameters
    ----------
    beam : Beam or Blade
    omegas : array_like
        Rotation speeds [rad/s], ascending.
    count : int
        Number of modes of each family, those lowest at the first speed.
    orders : int
        Lines kω up to this k.
    planes : sequence of str
        Families: "lag", "flap" and "torsion", as in `linear_modes`.
    theory : Theory
        Extension, shear, rotary inertia and trapeze effect.

    Raises
    ------
    ValueError
        If the speeds do not ascend from 0 or above, or `linear_modes` refuses one.

    Examples
    --------
    >>> from analytic import Beam, campbell
    >>> diagram = campbell(Beam.reference(), omegas=range(0, 13, 3), count=2, orders=4)
    >>> for meeting in diagram.crossings[:3]:
    ...     print(f"mode {meeting.mode} meets {meeting.order}ω at {meeting.omega:.3f} rad/s")
    mode 1 meets 1ω at 3.208 rad/s
    mode 1 meets 2ω at 1.490 rad/s
    mode 1 meets 3ω at 0.980 rad/s
    """
    speeds = finite_values("omegas", omegas, "rad/s")
    for speed in speeds:
        rotation_speed(float(speed), "omegas")
    require_ascending("omegas", speeds, "rad/s")
    count, orders = whole_number("count", count), whole_number("orders", orders)
    if not planes or len(set(planes)) < len(planes):
        raise ValueError(f"planes must name families once each, got {list(planes)}")
    return _diagram(beam, speeds, dict.fromkeys(planes, count), orders, theory)


def _diagram(
    beam: AnyBlade, speeds: FloatArray, counts: Mapping[Plane, int], orders: int, theory: Theory
) -> Campbell:
    """Return the diagram of so many modes of each family."""
    parts = [_family(beam, speeds, n, orders, plane, theory) for plane, n in counts.items()]
    return replace(
        parts[0],
        frequencies=np.hstack([one.frequencies for one in parts]),
        mac=np.hstack([one.mac for one in parts]),
        crossings=tuple(crossing for one in parts for crossing in one.crossings),
        planes=tuple(plane for one in parts for plane in one.planes),
    )


def _family(
    beam: AnyBlade, speeds: FloatArray, count: int, orders: int, plane: Plane, theory: Theory
) -> Campbell:
    """Return the diagram of one family."""
    wanted = count + _SPARE_MODES * (plane != "torsion")  # whose modes keep their order
    ends = [
        linear_modes(
            beam, omega, wanted, plane=plane, theory=theory, functions=max(20, 2 * wanted)
        ).model
        for omega in {float(speeds[0]), float(speeds[-1])}
    ]
    # A model that resolves the modes at both ends does so between them.
    model: Any = max(ends, key=lambda one: one.bending)
    family = None if plane == "lag" else plane
    in_space = plane != "lag" or lives_in_space(beam)

    def modes_at(omega: float, near: Any = None) -> LinearModes:
        if not in_space:
            return modes_on(model, beam, omega, wanted, theory)
        return space_modes_on(model, beam, omega, wanted, family=family, near=near)

    found: list[LinearModes] = []
    for omega in speeds.tolist():
        found.append(modes_at(omega, *found[-1:]))
    columns = [np.arange(count)]
    assurances = []
    for here, there in pairwise(found):
        assurance = _assurance(here, there)[columns[-1]]
        columns.append(_followed(assurance))
        assurances.append(assurance[np.arange(count), columns[-1]])

    crossings = [
        replace(crossing, plane=plane)
        for pair, places in zip(pairwise(found), pairwise(columns), strict=True)
        for crossing in _met(pair, places, orders, modes_at)
    ]
    return Campbell(
        beam=beam,
        omegas=speeds,
        frequencies=np.array([m.frequencies[c] for m, c in zip(found, columns, strict=True)]),
        mac=np.array(assurances).reshape(-1, count),
        crossings=tuple(sorted(crossings, key=lambda c: (c.mode, c.order))),
        planes=(plane,) * count,
        theory=theory,
    )


def _met(
    ends: tuple[LinearModes, LinearModes],
    columns: tuple[NDArray[np.intp], NDArray[np.intp]],
    orders: int,
    modes_at: Callable[..., LinearModes],
) -> Iterator[Crossing]:
    """Yield where frequencies cross kω between two speeds, of the modes that hold these places.

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
                omega = math.sqrt(square)
                yield Crossing(mode=column + 1, order=order, omega=omega, frequency=order * omega)


def _followed(assurance: FloatArray) -> NDArray[np.intp]:
    """Return the mode that continues each tracked one, all of them different."""
    return np.asarray(optimize.linear_sum_assignment(-assurance)[1])


def _assurance(one: LinearModes, other: LinearModes) -> FloatArray:
    """Modal assurance criterion of all pairs, in the energy norm of the beam at rest."""
    a, b = one.coordinates, other.coordinates
    a = a / np.linalg.norm(a, axis=1, keepdims=True)
    b = b / np.linalg.norm(b, axis=1, keepdims=True)
    return np.asarray(np.abs(a.conj() @ b.T) ** 2)
