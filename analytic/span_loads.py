"""Loads on the span: forces and moments in three directions, at a point or by a table."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, ClassVar, Literal, Self

import numpy as np

from .arrays import FloatArray
from .input_checks import (
    finite_array,
    finite_number,
    finite_values,
    flag,
    not_negative,
    require_ascending,
    stepped,
    three_numbers,
)
from .lazily import interpolate
from .load import Load
from .quadrature import gauss_points

_NONE = (0.0, 0.0, 0.0)
_MOST_NUMBERS = 1_000_000


class SpanLoad(Load, abstract=True):
    """Load by force and moment on the line, constant or as a cosine of νt + φ."""

    force: Any  # numbers, in place of the function of the base
    moment: Any
    phase: float

    acts_on: ClassVar[Literal["span"]] = "span"
    varied: ClassVar[Literal["frequency", "speed"] | None] = "frequency"

    def _check_time(self) -> None:
        """Refuse a frequency, a phase and a flag that are none."""
        if self.frequency is not None:
            self._keep(frequency=not_negative("frequency", self.frequency, "rad/s"))
        self._keep(
            phase=finite_number("phase", self.phase, "rad"),
            following=flag("following", self.following),
        )
        if self.phase and self.frequency is None:
            raise ValueError(
                f"phase = {self.phase:g} rad is that of a cosine: give its frequency, or leave it "
                "out of a constant load"
            )

    def points(self, cells: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return points [m] and weights [m, or 1] to sum `wrench` over cells between places [m]."""
        raise NotImplementedError

    def _wave(self, phase: FloatArray) -> FloatArray:
        return np.asarray(np.cos(phase + self.phase))[:, None, None]

    @property
    def size(self) -> float:
        """Largest component of the force, or of the moment without one."""
        force, moment = (float(np.abs(one).max()) for one in (self.force, self.moment))
        return force or moment

    @property
    def leaves_plane(self) -> bool:
        """With a force out of it, with any moment, and where it follows the sections."""
        return bool(self.following or np.any(self.moment) or np.any(np.asarray(self.force)[..., 2]))

    def times(self, factor: float) -> Self:
        """Return the load with `factor` times its force and moment."""
        parts = {name: factor * np.asarray(getattr(self, name)) for name in ("force", "moment")}
        return replace(self, **parts)  # type: ignore[type-var]

    def __str__(self) -> str:
        unit = self.unit if np.any(self.force) else f"{self.unit} m"
        at = "" if self.frequency is None else f" at {self.frequency:g} rad/s"
        return f"{self.called} of {self.size:g} {unit.replace('/m m', '')}{at}"


@dataclass(frozen=True, kw_only=True)
class PointLoad(SpanLoad):
    """A force and a moment on one section: of the tip, or of a point of the span.

    Three components, along the clamp, in the direction of rotation (lag) and normal to both (flap),
    in the frame that turns with the clamp and has its precone; or in the section's axes. Constant,
    or times cos(νt + φ).

    Parameters
    ----------
    force, moment : array_like (3,)
        On the line [N], [N m].
    position : float, optional
        From the clamp [m]; the tip, unless given.
    following : bool
        Whether they keep to the section's axes, 1 normal to it, 2 along the chord, 3 across, as it
        moves; else they keep their directions in the turning frame.
    frequency : float, optional
        ν [rad/s].
    phase : float
        φ [rad].

    Examples
    --------
    >>> import math
    >>> from analytic import Beam, PointLoad, steady_state
    >>> blade = Beam.reference().with_section_out_of_plane(4.0, 4.0)
    >>> roll = math.pi * blade.bending_stiffness / blade.length  # to half a circle
    >>> moment = PointLoad(moment=(0.0, 0.0, roll), following=True)
    >>> print((steady_state(blade, 0.0, loads=[moment]).tip * math.pi / blade.length).round(6))
    [0. 2. 0.]
    """

    force: Any = _NONE
    moment: Any = _NONE
    position: float | None = None
    following: bool = False
    frequency: float | None = None
    phase: float = 0.0

    unit: ClassVar[str] = "N"
    symbol: ClassVar[str] = "F"
    dimension: ClassVar[tuple[int, int, int]] = (1, 1, -2)
    dimensions: ClassVar[Mapping[str, tuple[int, int, int]]] = {
        "moment": (2, 1, -2), "position": (1, 0, 0), "phase": (0, 0, 0),
    }  # fmt: skip

    def __post_init__(self) -> None:
        self._keep(
            force=three_numbers("force", self.force, "N"),
            moment=three_numbers("moment", self.moment, "N m"),
        )
        if self.position is not None:
            self._keep(position=not_negative("position", self.position, "m"))
        self._check_time()

    @property
    def stations(self) -> tuple[float, ...]:  # type: ignore[override]
        """The position, none of the tip."""
        return () if self.position is None else (self.position,)

    def points(self, cells: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the position, with the weight one."""
        at = cells[-1] if self.position is None else self.position
        return np.array([at]), np.ones(1)

    def wrench(self, phase: FloatArray, x: FloatArray) -> FloatArray:
        """Return force and moment (samples, 1, 6)."""
        del x
        return np.asarray(self._wave(phase) * np.concatenate((self.force, self.moment)))


@dataclass(frozen=True, kw_only=True)
class LoadTable(SpanLoad):
    """Force and moment per length by a table over the span, and over time, as another code has it.

    Components as those of a `PointLoad`. They act from the first station to the last, linear
    between stations. Over time they are a cubic spline, constant before the first instant and after
    the last; without times constant, or times cos(νt + φ).

    Parameters
    ----------
    x : array_like (stations,)
        Points of the span [m], ascending, two at least.
    force, moment : array_like (times, stations, 3) or (stations, 3)
        Per undeformed length on the line [N/m], [N]; zero unless given.
    time : array_like (times,), optional
        Instants [s], ascending, two at least.
    following : bool
        Whether they keep to the sections' axes, as of a `PointLoad`.
    frequency : float, optional
        ν [rad/s], without times.
    phase : float
        φ [rad].

    Examples
    --------
    >>> from analytic import Beam, LoadTable, steady_state
    >>> blade = Beam.reference().with_section_out_of_plane(0.0625, 0.08)
    >>> lift = LoadTable(x=[4.0, 8.0], force=[[0.0, 0.0, 2.0], [0.0, 0.0, 6.0]])
    >>> print(steady_state(blade, 6.0, loads=[lift]).tip[[0, 2]].round(4))
    [7.9712 0.664 ]
    """

    force: Any = field(default=_NONE, repr=False)
    moment: Any = field(default=_NONE, repr=False)
    x: Any = field(repr=False)
    time: Any = field(default=None, repr=False)
    following: bool = False
    frequency: float | None = None
    phase: float = 0.0

    unit: ClassVar[str] = "N/m"
    symbol: ClassVar[str] = "p"
    dimension: ClassVar[tuple[int, int, int]] = (0, 1, -2)
    dimensions: ClassVar[Mapping[str, tuple[int, int, int]]] = {
        "moment": (1, 1, -2), "x": (1, 0, 0), "time": (0, 0, 1), "phase": (0, 0, 0),
    }  # fmt: skip

    def __post_init__(self) -> None:
        x = finite_values("x", self.x, "m")
        if x.size < 2 or x[0] < 0.0:
            raise ValueError(
                f"x must be two stations or more from the clamp on, got {x.size} from {x[0]:g} m: "
                "give a load on a single one as a PointLoad"
            )
        self._keep(x=tuple(stepped("x", x).tolist()))
        instants = ()
        if self.time is not None:
            time = finite_values("time", self.time, "s")
            if time.size < 2 or self.frequency is not None:
                raise ValueError(
                    f"a table over time has two instants or more, and no frequency, got "
                    f"{time.size}: leave the time out of a load that is constant or a cosine"
                )
            require_ascending("time", time, "s")
            self._keep(time=tuple(time.tolist()))
            instants = time.shape
        for name, unit in (("force", "N/m"), ("moment", "N")):
            values = finite_array(name, getattr(self, name), unit)
            if values.shape == (3,) and not values.any():
                values = np.zeros((*instants, x.size, 3))
            if values.shape != (*instants, x.size, 3):
                raise ValueError(
                    f"{name} must be three numbers at each of {' × '.join(map(str, instants))}"
                    f"{' instants and ' * bool(instants)}{x.size} stations, got the shape "
                    f"{values.shape}"
                )
            if values.size > _MOST_NUMBERS:
                raise ValueError(
                    f"{name} has {values.size} numbers, and at most {_MOST_NUMBERS} are taken: "
                    "give fewer instants or stations"
                )
            self._keep(**{name: _tuples(values.tolist())})
        self._check_time()

    @property
    def stations(self) -> tuple[float, ...]:  # type: ignore[override]
        """The points of the span."""
        return tuple(self.x)

    @property
    def varied(self) -> Literal["frequency"] | None:  # type: ignore[override]
        """The frequency, of a table without times."""
        return "frequency" if self.time is None else None

    def phase_at(self, t: FloatArray) -> FloatArray:
        """Return the time itself, or νt without instants."""
        return t if self.time is not None else super().phase_at(t)

    @cached_property
    def _over_time(self) -> Any:
        values = np.concatenate((self.force, self.moment), axis=-1)
        return values if self.time is None else interpolate.CubicSpline(self.time, values)

    def points(self, cells: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return Gauss points between cells and stations, with their lengths."""
        ends = np.union1d(cells, self.x)
        ends = ends[(ends >= self.x[0]) & (ends <= self.x[-1])]
        inner, weights = gauss_points(2)  # a linear load by a linear function
        width = np.diff(ends)
        return (ends[:-1, None] + np.outer(width, inner)).ravel(), np.outer(width, weights).ravel()

    def wrench(self, phase: FloatArray, x: FloatArray) -> FloatArray:
        """Return force and moment per length, (samples, places, 6)."""
        if self.time is None:
            values = self._wave(phase) * self._over_time
        else:
            values = self._over_time(np.clip(phase, self.time[0], self.time[-1]))
        at = np.array(self.x)
        onto = np.stack([np.interp(x, at, one) for one in np.eye(at.size)])
        return np.asarray(np.einsum("snk,nx->sxk", values, onto))


def _tuples(values: Any) -> Any:
    return tuple(map(_tuples, values)) if isinstance(values, Sequence) else values
