"""Campbell diagram of the rotating beam: frequencies over the speed, tracked by shape."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import TYPE_CHECKING, Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..arrays import FloatArray
from ..beam import AnyBlade
from ..input_checks import finite_values, rotation_speed, whole_number
from ..lazily import optimize
from ..plotting import apart, axes_or_new, cycled, free_place
from .continuum import Continuum
from .modes import LinearModes, Plane, linear_modes, modes_on
from .out_of_plane_modes import flap_blade

if TYPE_CHECKING:
    from ..plotting import Axes

_MOST_ORDERS = 1000
_SPARE_MODES = 3  # beyond those asked for, so that a mode that sinks is still found


@dataclass(frozen=True, kw_only=True)
class Crossing:
    """Where a mode's frequency is a multiple of the speed: `mode` meets the line kω.

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
        Its family: "lag", "flap" or "torsion".
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

    @property
    def names(self) -> list[str]:
        """The name of each column, as "flap 1"."""
        return [
            f"{plane} {self.planes[:column].count(plane) + 1}"
            for column, plane in enumerate(self.planes)
        ]

    def plot(self, ax: Axes | None = None, *, highest: float | None = None) -> Axes:
        """Draw the frequencies, named, the lines kω that they cross, and where; return the axes.

        Parameters
        ----------
        ax : Axes, optional
            Drawn on these; otherwise on a new figure.
        highest : float, optional
            Frequency [rad/s] up to which is drawn; otherwise all are.

        Examples
        --------
        >>> from analytic import Beam, campbell
        >>> ax = campbell(Beam.reference(), [0.0, 4.0, 8.0, 12.0]).plot()
        """
        ax = axes_or_new(ax)
        low, high = float(self.omegas[0]), float(self.omegas[-1])
        top = 1.05 * float(self.frequencies.max()) if highest is None else highest
        met = [c for c in self.crossings if c.frequency <= top]
        last = max((c.order for c in met), default=1)
        for order in range(1, last + 1):
            ax.plot([low, high], [order * low, order * high], color="0.75", lw=0.6, zorder=0)
            # Where the line leaves the frame: above it, or at its right where no mode passes.
            above = order * high > top
            at = top / order if above else free_place(self.omegas, self.frequencies, order, top)
            ax.text(
                at, min(order * at, top), f"{order}ω", color="0.45", fontsize="small",
                ha="center" if above and order < last else "right", va="bottom", clip_on=False,
            )  # fmt: skip
        families = list(dict.fromkeys(self.planes))
        heights = apart(self.frequencies[-1], 0.045 * top)
        for plane, name, row, height in zip(
            self.planes, self.names, self.frequencies.T, heights, strict=True
        ):
            if row[-1] > top:
                continue  # leaves the frame, or never is in it
            family = families.index(plane)
            (line,) = ax.plot(self.omegas, row, color=cycled(family), ls=("-", "--", "-.")[family])
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


def campbell(
    beam: AnyBlade,
    omegas: ArrayLike,
    count: int = 3,
    orders: int = 10,
    *,
    planes: Sequence[Plane] = ("lag",),
) -> Campbell:
    """Return the Campbell diagram of the first `count` modes, by default of those in the plane.

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
    if np.any(np.diff(speeds) <= 0.0):
        raise ValueError(f"omegas must ascend, got {speeds.tolist()} rad/s")
    count, orders = whole_number("count", count), whole_number("orders", orders, most=_MOST_ORDERS)
    if not planes or len(set(planes)) < len(planes):
        raise ValueError(f"planes must name families once each, got {list(planes)}")
    families = [
        _twisting(beam, speeds, count, orders)
        if plane == "torsion"
        else _bending(beam, speeds, count, orders, plane)
        for plane in planes
    ]
    crossings = [
        replace(crossing, plane=plane)
        for plane, family in zip(planes, families, strict=True)
        for crossing in sorted(family.crossings, key=lambda c: (c.mode, c.order))
    ]
    return Campbell(
        beam=beam,
        omegas=speeds,
        frequencies=np.hstack([family.frequencies for family in families]),
        mac=np.hstack([family.mac for family in families]),
        crossings=tuple(crossings),
        planes=tuple(plane for plane in planes for _ in range(count)),
    )


class _Family(NamedTuple):
    frequencies: FloatArray
    mac: FloatArray
    crossings: list[Crossing]


def _twisting(beam: AnyBlade, speeds: FloatArray, count: int, orders: int) -> _Family:
    """Return the torsional modes, which know nothing of the speed."""
    modes = linear_modes(beam, float(speeds[0]), count, plane="torsion")
    crossings = [
        Crossing(mode=mode, order=order, omega=frequency / order, frequency=frequency)
        for mode, frequency in enumerate(modes.frequencies.tolist(), start=1)
        for order in range(1, orders + 1)
        if speeds[0] <= frequency / order <= speeds[-1]
    ]
    ones = np.ones((speeds.size, count))
    return _Family(ones * modes.frequencies, ones[1:], crossings)


def _bending(
    beam: AnyBlade, speeds: FloatArray, count: int, orders: int, plane: Literal["lag", "flap"]
) -> _Family:
    wanted = count + _SPARE_MODES

    def modes_at(omega: float) -> LinearModes:
        return linear_modes(beam, omega, wanted, plane=plane, functions=max(20, 2 * wanted))

    bent = flap_blade(beam) if plane == "flap" else beam
    here = modes_at(float(speeds[0]))
    tracked = np.arange(count)
    frequencies, assurances = [here.frequencies[:count]], []
    crossings: list[Crossing] = []
    for low, high in pairwise(speeds.tolist()):
        there = modes_at(high)
        assurance = _assurance(here, there)[tracked]
        following = _followed(assurance)
        frequencies.append(there.frequencies[following])
        assurances.append(assurance[np.arange(count), following])

        # What resolves the modes at both ends does so between them.
        finer = max(here.model, there.model, key=lambda model: model.bending)

        def detuning(
            omega: float,
            mode: int,
            order: int,
            start: LinearModes = here,
            rows: NDArray[np.intp] = tracked,
            model: Continuum = finer,
        ) -> float:
            modes = modes_on(model, bent, omega, wanted)
            same = _followed(_assurance(start, modes)[rows])[mode]
            return float(modes.frequencies[same] - order * omega)

        for column in range(count):
            for order in range(1, orders + 1):
                before = frequencies[-2][column] - order * low
                after = frequencies[-1][column] - order * high
                if before > 0.0 >= after or before < 0.0 <= after:
                    omega = optimize.brentq(
                        detuning, low, high, args=(column, order), xtol=1e-13 * high, rtol=1e-13
                    )
                    crossings.append(
                        Crossing(mode=column + 1, order=order, omega=omega, frequency=order * omega)
                    )
        here, tracked = there, following
    return _Family(np.array(frequencies), np.array(assurances).reshape(-1, count), crossings)


def _followed(assurance: FloatArray) -> NDArray[np.intp]:
    """Return the mode that continues each tracked one, all of them different."""
    return np.asarray(optimize.linear_sum_assignment(-assurance)[1])


def _assurance(one: LinearModes, other: LinearModes) -> FloatArray:
    """Modal assurance criterion of all pairs, in the energy norm of the beam at rest."""
    larger = max(one.model, other.model, key=lambda model: model.bending)
    a, b = (modes.model.padded(modes.coordinates, larger) for modes in (one, other))
    a = a / np.linalg.norm(a, axis=1, keepdims=True)
    b = b / np.linalg.norm(b, axis=1, keepdims=True)
    return np.asarray((a @ b.T) ** 2)
