"""Prescribed rotations of the clamped end: Eq. 1, steady, and the base of others."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Protocol

import numpy as np

from .arrays import FloatArray, NumbersT
from .description import Described
from .input_checks import positive, rotation_speed

_INSTANTS = 2001  # for the highest speed of a motion that does not tell it


def instants(t: Any) -> Any:
    """Return a time as a float, several as an array of them, of whatever precision they were."""
    return t.astype(np.float64, copy=False) if isinstance(t, np.ndarray) else float(t)


class Rotation(Protocol):
    """A prescribed rotation: angle, rate and acceleration as functions of time."""

    def angle(self, t: NumbersT, /) -> NumbersT:
        """Return the angle [rad] at `t` [s]."""

    def rate(self, t: NumbersT, /) -> NumbersT:
        """Return its rate [rad/s]."""

    def acceleration(self, t: NumbersT, /) -> NumbersT:
        """Return its acceleration [rad/s²]."""


class Motion(Described, ABC, abstract=True):
    """Rotation of the clamp, as files know it."""

    @abstractmethod
    def _at(self, t: Any, derivative: int) -> Any:
        """Return the angle, or its first or second derivative, at a float or an array of times."""

    def angle(self, t: NumbersT) -> NumbersT:
        """Return the angle θ [rad], zero at t = 0; `t` [s] scalar or array, result in its shape."""
        angle: NumbersT = self._at(instants(t), 0)
        return angle

    def rate(self, t: NumbersT) -> NumbersT:
        """Return the angular velocity dθ/dt [rad/s]; `t` [s] scalar or array."""
        rate: NumbersT = self._at(instants(t), 1)
        return rate

    def acceleration(self, t: NumbersT) -> NumbersT:
        """Return the angular acceleration d²θ/dt² [rad/s²]; `t` [s] scalar or array."""
        acceleration: NumbersT = self._at(instants(t), 2)
        return acceleration


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
        self._keep(omega=rotation_speed(self.omega))

    ramp_time = 0.0
    shortest_wave = math.inf

    @property
    def start(self) -> float:
        """Speed before t = 0, ω [rad/s]."""
        return self.omega

    @property
    def fastest(self) -> float:
        """The highest speed, ω [rad/s]."""
        return self.omega

    def _at(self, t: Any, derivative: int) -> Any:
        return (self.omega * t, self.omega + 0.0 * t, 0.0 * t)[derivative]


class SpeedChange(Motion, ABC, abstract=True):
    """A change of the speed from t = 0 to `ramp_time`, steady before and after.

    A new one is a frozen dataclass that inherits from it, here or elsewhere.

    Attributes
    ----------
    start, omega : float
        Speed before and after [rad/s].
    ramp_time : float
        Duration [s].
    shortest_wave : float
        Shortest period in the acceleration [s].
    """

    start: float
    omega: float
    ramp_time: float
    shortest_wave: float

    @abstractmethod
    def _within(self, t: Any, derivative: int) -> Any:
        """Return the angle, or its first or second derivative, at t from 0 to `ramp_time`."""

    @cached_property
    def fastest(self) -> float:
        """The highest speed [rad/s]."""
        return float(self.rate(np.linspace(0.0, self.ramp_time, _INSTANTS)).max())

    @property
    def corners(self) -> FloatArray:
        """Instants [s], both ends among them, between which the motion is smooth."""
        return np.array([0.0, self.ramp_time])

    def _at(self, t: Any, derivative: int) -> Any:
        # A solver asks for one t at a time, fast.
        several = isinstance(t, np.ndarray)
        within = np.clip(t, 0.0, self.ramp_time) if several else min(max(t, 0.0), self.ramp_time)
        value = self._within(within, derivative)
        if derivative == 0:
            value = value + (self.start * (t < 0.0) + self.omega * (t > 0.0)) * (t - within)
        return value if several else float(value)


def require_ramp(motion: object) -> None:
    """Refuse all but changes of the speed, a steady rotation for one."""
    if not isinstance(motion, SpeedChange):
        raise TypeError(
            "spin_up must be a SpinUp, a FourierRamp, a SpeedTable or another SpeedChange, got "
            f"{motion!r}; for a beam that turns steadily take periodic_orbits"
        )


@dataclass(frozen=True, kw_only=True)
class SpinUp(SpeedChange):
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

    start = 0.0

    def __post_init__(self) -> None:
        self._keep(
            omega=rotation_speed(self.omega), ramp_time=positive("ramp_time", self.ramp_time, "s")
        )

    @property
    def shortest_wave(self) -> float:  # type: ignore[override]
        """Period of the acceleration during the ramp, T [s]."""
        return self.ramp_time

    @property
    def fastest(self) -> float:
        """The highest speed, ω [rad/s]."""
        return self.omega

    def _within(self, t: Any, derivative: int) -> Any:
        sin: Any = np.sin if isinstance(t, np.ndarray) else math.sin
        strength = self.omega / self.ramp_time
        if derivative == 2:
            return 2.0 * strength * sin(np.pi * t / self.ramp_time) ** 2
        if derivative == 1:
            frequency = 2.0 * np.pi / self.ramp_time
            return strength * (t - sin(frequency * t) / frequency)
        wave = self.ramp_time / np.pi * sin(np.pi * t / self.ramp_time)
        return 0.5 * strength * (t - wave) * (t + wave)


@dataclass(frozen=True, kw_only=True)
class Rippled(Motion):
    """A rotation whose rate has a ripple, ε cos νt, from t = 0 on."""

    rotation: Rotation
    amplitude: float  # ε [rad/s]
    frequency: float  # ν [rad/s], not zero

    def _at(self, t: Any, derivative: int) -> Any:
        phase = self.frequency * t
        if derivative == 2:
            return self.rotation.acceleration(t) - self.amplitude * self.frequency * np.sin(phase)
        if derivative == 1:
            return self.rotation.rate(t) + self.amplitude * np.cos(phase)
        return self.rotation.angle(t) + self.amplitude / self.frequency * np.sin(phase)
