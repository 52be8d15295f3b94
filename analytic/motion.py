"""The prescribed rotation of the clamped end, Eq. 1."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ClassVar, Protocol, overload

import numpy as np

from .arrays import FloatArray
from .description import Described
from .input_checks import positive, rotation_speed


def instants(t: Any) -> Any:
    """Return a time as a float, several as an array of them, of whatever precision they were."""
    return t.astype(np.float64, copy=False) if isinstance(t, np.ndarray) else float(t)


class Rotation(Protocol):
    """A prescribed rotation: angle, rate and acceleration as functions of time."""

    @overload
    def angle(self, t: float) -> float: ...
    @overload
    def angle(self, t: FloatArray) -> FloatArray: ...

    @overload
    def rate(self, t: float) -> float: ...
    @overload
    def rate(self, t: FloatArray) -> FloatArray: ...

    @overload
    def acceleration(self, t: float) -> float: ...
    @overload
    def acceleration(self, t: FloatArray) -> FloatArray: ...


class Motion(Described, abstract=True):
    """Base of all rotations of the clamp, by which files know them."""


@dataclass(frozen=True, kw_only=True)
class SteadyRotation(Motion):
    """Rotation at a constant angular velocity from t = 0 on.

    Parameters
    ----------
    omega : float
        Angular velocity ω [rad/s]; zero or positive.

    Examples
    --------
    >>> from analytic import SteadyRotation
    >>> motion = SteadyRotation(omega=6.0)
    >>> print(motion.angle(0.5), motion.rate(0.5))
    3.0 6.0
    """

    omega: float

    def __post_init__(self) -> None:
        object.__setattr__(self, "omega", rotation_speed(self.omega))

    @overload
    def angle(self, t: float) -> float: ...
    @overload
    def angle(self, t: FloatArray) -> FloatArray: ...
    def angle(self, t: float | FloatArray) -> float | FloatArray:
        """Angle ωt [rad]; `t` [s] scalar or array."""
        angle: float | FloatArray = self.omega * instants(t)
        return angle

    @overload
    def rate(self, t: float) -> float: ...
    @overload
    def rate(self, t: FloatArray) -> FloatArray: ...
    def rate(self, t: float | FloatArray) -> float | FloatArray:
        """Angular velocity ω [rad/s], in the shape of `t`."""
        rate: float | FloatArray = self.omega + 0.0 * instants(t)
        return rate

    @overload
    def acceleration(self, t: float) -> float: ...
    @overload
    def acceleration(self, t: FloatArray) -> FloatArray: ...
    def acceleration(self, t: float | FloatArray) -> float | FloatArray:
        """Angular acceleration, zero [rad/s²], in the shape of `t`."""
        acceleration: float | FloatArray = 0.0 * instants(t)
        return acceleration


@dataclass(frozen=True, kw_only=True)
class SpinUp(Motion):
    """Smooth spin-up from rest to a constant angular velocity, Eq. 1.

    Angle, rate and acceleration are continuous at t = 0 and t = T; the acceleration is
    (ω/T)(1 - cos(2πt/T)), at most 2ω/T. Before t = 0 the beam is at rest.

    Parameters
    ----------
    omega : float
        Steady angular velocity ω [rad/s]; zero or positive.
    ramp_time : float
        Time T from rest to the steady angular velocity [s].

    Raises
    ------
    ValueError
        If `omega` is negative or not finite, or `ramp_time` not finite and positive.

    Examples
    --------
    >>> from analytic import SpinUp
    >>> spin_up = SpinUp(omega=6.0, ramp_time=3.0)
    >>> spin_up.angle(3.0), spin_up.rate(3.0)
    (9.0, 6.0)
    """

    omega: float
    ramp_time: float
    start: ClassVar[float] = 0.0

    def __post_init__(self) -> None:
        object.__setattr__(self, "omega", rotation_speed(self.omega))
        object.__setattr__(self, "ramp_time", positive("ramp_time", self.ramp_time, "s"))

    @property
    def shortest_wave(self) -> float:
        """Period of the acceleration during the ramp, T [s]."""
        return self.ramp_time

    @overload
    def angle(self, t: float) -> float: ...
    @overload
    def angle(self, t: FloatArray) -> FloatArray: ...
    def angle(self, t: float | FloatArray) -> float | FloatArray:
        """Angle θ(t) [rad], Eq. 1; `t` [s] scalar or array, result of the same shape."""
        ramp, sin = self._ramp(t)
        wave = self.ramp_time / np.pi * sin(np.pi * ramp / self.ramp_time)
        during = 0.5 * self.omega / self.ramp_time * (ramp - wave) * (ramp + wave)
        t = instants(t)
        after = self.omega * (t - ramp) * (t > self.ramp_time)
        angle: float | FloatArray = during + after
        return angle

    @overload
    def rate(self, t: float) -> float: ...
    @overload
    def rate(self, t: FloatArray) -> FloatArray: ...
    def rate(self, t: float | FloatArray) -> float | FloatArray:
        """Angular velocity dθ/dt [rad/s]; `t` [s] scalar or array."""
        ramp, sin = self._ramp(t)
        frequency = 2.0 * np.pi / self.ramp_time
        rate: float | FloatArray = (
            self.omega / self.ramp_time * (ramp - sin(frequency * ramp) / frequency)
        )
        return rate

    @overload
    def acceleration(self, t: float) -> float: ...
    @overload
    def acceleration(self, t: FloatArray) -> FloatArray: ...
    def acceleration(self, t: float | FloatArray) -> float | FloatArray:
        """Angular acceleration d²θ/dt² [rad/s²]; `t` [s] scalar or array."""
        ramp, sin = self._ramp(t)
        acceleration: float | FloatArray = (
            2.0 * self.omega / self.ramp_time * sin(np.pi * ramp / self.ramp_time) ** 2
        )
        return acceleration

    def _ramp(self, t: float | FloatArray) -> tuple[Any, Callable[[Any], Any]]:
        """Time within [0, T] and the sine for its type: a solver asks for one t at a time, fast."""
        t = instants(t)
        if isinstance(t, np.ndarray):
            return np.clip(t, 0.0, self.ramp_time), np.sin
        return min(max(t, 0.0), self.ramp_time), math.sin


@dataclass(frozen=True, kw_only=True)
class Rippled(Motion):
    """A rotation whose rate has a ripple, ε cos νt, from t = 0 on.

    Parameters
    ----------
    rotation : Rotation
        Without the ripple.
    amplitude : float
        ε [rad/s].
    frequency : float
        ν [rad/s], not zero.
    """

    rotation: Rotation
    amplitude: float
    frequency: float

    @overload
    def angle(self, t: float) -> float: ...
    @overload
    def angle(self, t: FloatArray) -> FloatArray: ...
    def angle(self, t: float | FloatArray) -> float | FloatArray:
        """Angle [rad], with (ε/ν) sin νt; `t` [s] scalar or array."""
        angle: float | FloatArray = self.rotation.angle(t) + (
            self.amplitude / self.frequency * np.sin(self.frequency * t)
        )
        return angle

    @overload
    def rate(self, t: float) -> float: ...
    @overload
    def rate(self, t: FloatArray) -> FloatArray: ...
    def rate(self, t: float | FloatArray) -> float | FloatArray:
        """Angular velocity [rad/s], in the shape of `t`."""
        rate: float | FloatArray = self.rotation.rate(t) + (
            self.amplitude * np.cos(self.frequency * t)
        )
        return rate

    @overload
    def acceleration(self, t: float) -> float: ...
    @overload
    def acceleration(self, t: FloatArray) -> FloatArray: ...
    def acceleration(self, t: float | FloatArray) -> float | FloatArray:
        """Angular acceleration [rad/s²], in the shape of `t`."""
        acceleration: float | FloatArray = self.rotation.acceleration(t) - (
            self.amplitude * self.frequency * np.sin(self.frequency * t)
        )
        return acceleration
