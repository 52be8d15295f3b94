"""Loads on a blade, as values in SI units.

A load answers for itself: its force, what that acts on, and itself in other units. A new one is a
class that inherits from `HarmonicLoad` or `Load`, here or elsewhere; theory, Exudyn, files and
figures then know it.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, Literal

import numpy as np

from .arrays import ComplexArray, FloatArray
from .description import kinds_of
from .input_checks import finite_number, not_negative
from .load import Load as Load  # noqa: PLC0414  (everyone has these from here)
from .motion import Rippled, Rotation
from .span_loads import LoadTable as LoadTable  # noqa: PLC0414
from .span_loads import PointLoad as PointLoad  # noqa: PLC0414

_CARRIERS = ("mass", "length", "tip", "span")


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


def loads_at_once(loads: Any) -> tuple[Load, ...]:
    """Return several loads as a tuple."""
    if not isinstance(loads, (tuple, list)):
        raise TypeError(f"loads must be several, as in loads=(Gravity(),), got {loads!r}")
    for load in loads:
        require_load(load)
    return tuple(loads)


def loads_in_time(loads: Any) -> tuple[Load, ...]:
    """Return the loads of a motion in time as a tuple; refuse one that lacks its frequency."""
    several = loads_at_once(loads)
    for load in several:
        load.require_in_time()
    return several


def rippled(rotation: Rotation, loads: Sequence[Load]) -> Rotation:
    """Return the rotation of the clamp with the ripples among the loads."""
    for load in loads:
        rotation = load.moved(rotation)
    return rotation
