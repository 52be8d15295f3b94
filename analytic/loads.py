"""Loads on a blade, as values in SI units.

A load answers for itself: its force, what that acts on, and itself in other units. A new one is a
class that inherits from `HarmonicLoad` or `Load`, here or elsewhere; theory, Exudyn, files and
figures then know it.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields, replace
from typing import Any, ClassVar, Literal, Self

import numpy as np

from .arrays import ComplexArray, FloatArray
from .description import Described, kinds_of
from .input_checks import finite_number, not_negative
from .motion import Rippled, Rotation

_CARRIERS = ("mass", "length", "tip")


class Load(Described, abstract=True):
    """Force or motion that acts on a blade; a frozen dataclass whose first field is its size.

    Attributes
    ----------
    unit, symbol, called : str
        Of the size: its unit in SI and the theory's letter; and the load in a sentence, by the name
        of its class unless told, never by that of a base.
    dimension : tuple of three int
        Powers of length, mass and time in the size.
    dimensions : mapping
        The same of other numbers among the fields, by name; zeros of an angle.
    acts_on : {"mass", "length", "tip"} or None
        Carrier of the force, which is per unit of it; None for a load that moves the clamp.
    frequency : float or None
        ν [rad/s] of a harmonic load, where it is given.
    varied : {"frequency", "speed"} or None
        Abscissa of a response: the load's frequency, or the rotation speed if the load goes around
        once a turn; None for a load without a response.
    """

    unit: ClassVar[str]
    symbol: ClassVar[str]
    called: ClassVar[str]
    dimension: ClassVar[tuple[int, int, int]]
    dimensions: ClassVar[Mapping[str, tuple[int, int, int]]] = {}
    acts_on: ClassVar[Literal["mass", "length", "tip"] | None]
    varied: ClassVar[Literal["frequency", "speed"] | None] = None
    frequency: float | None = None

    def __init_subclass__(cls, **rest: bool) -> None:
        super().__init_subclass__(**rest)
        words = re.sub("(?<=.)(?=[A-Z])", " ", cls.__name__).lower()
        article = "an" if words[0] in "aeiou" else "a"
        cls.called = vars(cls).get("called", f"{article} {words}")

    @property
    def size(self) -> float:
        """Amplitude, in `unit`."""
        return float(getattr(self, self._of_size()))

    def _of_size(self) -> str:
        return fields(self)[0].name  # type: ignore[arg-type]

    def force(self, phase: FloatArray, angle: FloatArray, setting: float) -> ComplexArray:
        """Return the force (samples,): real part along the undeformed blade, imaginary across.

        Parameters
        ----------
        phase, angle : ndarray (samples,)
            νt and θ [rad].
        setting : float
            c = cos ψ.
        """
        raise NotImplementedError

    @property
    def leaves_plane(self) -> bool:
        """Whether it moves the blade out of the plane of rotation: unless told, with a lift."""
        return type(self).lift is not Load.lift

    def lift(self, phase: FloatArray) -> FloatArray:
        """Return the force along the axis of rotation, (samples,)."""
        return 0.0 * phase

    def rate(self, phase: FloatArray) -> FloatArray:
        """Return the change of the clamp's speed, (samples,)."""
        return 0.0 * phase

    def acceleration(self, phase: FloatArray, frequency: float) -> FloatArray:
        """Return the change of its acceleration at ν = `frequency`, (samples,)."""
        return 0.0 * frequency * phase

    def require_in_time(self) -> None:
        """Refuse a load without the values that a motion in time needs."""

    def moved(self, rotation: Rotation) -> Rotation:
        """Return the rotation of the clamp with the load's share."""
        return rotation

    def in_units(self, length: float, mass: float, time: float) -> Self:
        """Return the load in units of length [m], mass [kg] and time [s].

        TypeError of a number whose dimension the class does not tell.
        """
        dimensions, scaled = {self._of_size(): self.dimension, **self.dimensions}, {}
        for name in (one.name for one in fields(self)):  # type: ignore[arg-type]
            value = getattr(self, name)
            if name == "frequency":
                scaled[name] = None if value is None else value * time
            elif name in dimensions:
                for unit, power in zip((length, mass, time), dimensions[name], strict=True):
                    value /= unit**power
                scaled[name] = value
            elif not isinstance(value, str | None):
                raise TypeError(
                    f"{self} has {name} of unknown dimension: let {type(self).__name__} have "
                    f"dimensions = {{{name!r}: powers of length, mass and time}}, 0 of an angle"
                )
        return replace(self, **scaled)  # type: ignore[type-var]

    def times(self, factor: float) -> Self:
        """Return the load with `factor` times its size."""
        return replace(self, **{self._of_size(): factor * self.size})  # type: ignore[type-var]

    def __str__(self) -> str:
        return f"{self.called} of {self.size:g} {self.unit}"


@dataclass(frozen=True, kw_only=True)
class HarmonicLoad(Load, abstract=True):
    """Load of one frequency, as the cosine; unless a kind says otherwise, across the blade.

    Its force goes by the phase alone, not by the angle.
    """

    amplitude: float
    frequency: float | None = None

    varied: ClassVar[Literal["frequency", "speed"] | None] = "frequency"

    def __post_init__(self) -> None:
        self._keep(amplitude=finite_number("amplitude", self.amplitude, self.unit))
        if self.frequency is not None:
            self._keep(frequency=not_negative("frequency", self.frequency, "rad/s"))

    def force(self, phase: FloatArray, angle: FloatArray, setting: float) -> ComplexArray:
        """Return F cos νt across the undeformed blade."""
        del angle, setting
        return 1j * self.amplitude * np.cos(phase)

    def require_in_time(self) -> None:
        """Refuse a load without its frequency."""
        if self.frequency is None:
            raise ValueError(
                f"a motion in time needs the frequency of {self}: give frequency= [rad/s]"
            )

    def __str__(self) -> str:
        at = "" if self.frequency is None else f" at {self.frequency:g} rad/s"
        return f"{super().__str__()}{at}"


@dataclass(frozen=True, kw_only=True)
class SpeedRipple(HarmonicLoad):
    """A ripple of the speed: the clamp turns at ω + ε cos νt.

    Parameters
    ----------
    amplitude : float
        ε [rad/s].
    frequency : float, optional
        ν [rad/s]; `forced_response` sweeps it, a motion in time needs it.
    """

    unit: ClassVar[str] = "rad/s"
    symbol: ClassVar[str] = "ε"
    called: ClassVar[str] = "a ripple"
    dimension: ClassVar[tuple[int, int, int]] = (0, 0, -1)
    acts_on: ClassVar[None] = None

    def rate(self, phase: FloatArray) -> FloatArray:
        """Return ε cos νt."""
        return np.asarray(self.amplitude * np.cos(phase))

    def acceleration(self, phase: FloatArray, frequency: float) -> FloatArray:
        """Return -εν sin νt."""
        return np.asarray(-self.amplitude * frequency * np.sin(phase))

    def require_in_time(self) -> None:
        """Refuse a ripple without a frequency, or of zero."""
        super().require_in_time()
        if self.frequency == 0.0:
            raise ValueError(
                "a ripple of frequency 0 is another speed: give a frequency above 0 rad/s, or "
                "add the amplitude to omega"
            )

    def moved(self, rotation: Rotation) -> Rotation:
        """Return the rotation with the ripple."""
        if self.frequency is None:
            return rotation
        return Rippled(rotation=rotation, amplitude=self.amplitude, frequency=self.frequency)


@dataclass(frozen=True, kw_only=True)
class TipForce(HarmonicLoad):
    """A force on the tip across the undeformed blade, F cos νt, turning with the clamp.

    Parameters
    ----------
    amplitude : float
        F [N].
    frequency : float, optional
        ν [rad/s]; `forced_response` sweeps it, a motion in time needs it.

    Examples
    --------
    >>> from analytic import Beam, Damping, TipForce, forced_response
    >>> blade = Beam.reference().with_damping(Damping(external=0.1))
    >>> found = forced_response(blade, 6.0, TipForce(amplitude=0.5), [3.6, 3.7], functions=8)
    >>> print(f"{found.amplitude[-1]:.4f} L at {found.frequency[-1]:.1f} rad/s")
    0.0768 L at 3.7 rad/s
    """

    unit: ClassVar[str] = "N"
    symbol: ClassVar[str] = "F"
    dimension: ClassVar[tuple[int, int, int]] = (1, 1, -2)
    acts_on: ClassVar[Literal["tip"]] = "tip"


@dataclass(frozen=True, kw_only=True)
class DistributedForce(HarmonicLoad):
    """A force per undeformed length across the blade, p cos νt, turning with the clamp.

    Parameters
    ----------
    amplitude : float
        p [N/m].
    frequency : float, optional
        ν [rad/s]; `forced_response` sweeps it, a motion in time needs it.
    """

    unit: ClassVar[str] = "N/m"
    symbol: ClassVar[str] = "p"
    dimension: ClassVar[tuple[int, int, int]] = (0, 1, -2)
    acts_on: ClassVar[Literal["length"]] = "length"


@dataclass(frozen=True)
class Gravity(Load):
    """Gravity, -g(cos δ (sin θ i + cos ψ cos θ j) + sin δ k) with the axis of rotation k.

    At θ = 0 the blade points sideways, and gravity bends it back.

    Parameters
    ----------
    gravity : float
        g [m/s²].
    tilt : float
        δ [rad], by which the axis of rotation points up: 0 if the plane of rotation stands
        vertical, π/2 if it lies level, and gravity then is normal to it.

    Examples
    --------
    >>> from analytic import Beam, Damping, Gravity, forced_response
    >>> blade = Beam.reference().with_damping(Damping(external=0.3))
    >>> found = forced_response(blade, [5.0, 5.5], Gravity(1.62), functions=8)
    >>> found.load
    Gravity(gravity=1.62, tilt=0.0)
    >>> print(f"{found.amplitude[0]:.4f} L at {found.omega[0]:.1f} rad/s, on the moon")
    0.0220 L at 5.0 rad/s, on the moon
    """

    gravity: float = 9.81
    tilt: float = 0.0

    unit: ClassVar[str] = "m/s²"
    symbol: ClassVar[str] = "g"
    called: ClassVar[str] = "gravity"
    dimension: ClassVar[tuple[int, int, int]] = (1, 0, -2)
    dimensions: ClassVar[Mapping[str, tuple[int, int, int]]] = {"tilt": (0, 0, 0)}
    acts_on: ClassVar[Literal["mass"]] = "mass"
    varied: ClassVar[Literal["frequency", "speed"] | None] = "speed"

    def __post_init__(self) -> None:
        self._keep(
            gravity=finite_number("gravity", self.gravity, "m/s^2"),
            tilt=finite_number("tilt", self.tilt, "rad"),
        )

    @property
    def leaves_plane(self) -> bool:
        """With a tilt only."""
        return self.tilt != 0.0

    def lift(self, phase: FloatArray) -> FloatArray:
        """Return the share of the weight of a unit mass along the axis of rotation."""
        return np.full_like(phase, -self.gravity * math.sin(self.tilt))

    def force(self, phase: FloatArray, angle: FloatArray, setting: float) -> ComplexArray:
        """Return the weight of a unit mass, which goes around once a turn."""
        del phase
        in_plane = -self.gravity * math.cos(self.tilt)
        return np.asarray(in_plane * (np.sin(angle) + 1j * setting * np.cos(angle)))


def require_load(load: object) -> None:
    """Refuse a value that is no load, and a load that acts on what blades do not have."""
    if not isinstance(load, Load):
        *others, last = kinds_of(Load)
        raise TypeError(f"a load must be a {', '.join(others)} or {last}, got {load!r}")
    if load.acts_on not in (*_CARRIERS, None):
        raise TypeError(
            f"{load} acts on {load.acts_on!r}: let it be one of {', '.join(_CARRIERS)}, or None"
        )


def loads_in_time(loads: Any) -> tuple[Load, ...]:
    """Return the loads of a motion in time as a tuple; refuse one that lacks its frequency."""
    if not isinstance(loads, (tuple, list)):
        raise TypeError(f"loads must be several, as in loads=(Gravity(),), got {loads!r}")
    for load in loads:
        require_load(load)
        load.require_in_time()
    return tuple(loads)


def rippled(rotation: Rotation, loads: Sequence[Load]) -> Rotation:
    """Return the rotation of the clamp with the ripples among the loads."""
    for load in loads:
        rotation = load.moved(rotation)
    return rotation
