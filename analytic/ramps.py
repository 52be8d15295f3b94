"""Smooth changes of the speed beside Eq. 1: Fourier series of the acceleration, and tables."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, overload

import numpy as np

from .arrays import FloatArray
from .input_checks import finite_values, positive, rotation_speed
from .lazily import interpolate
from .motion import Motion, SpinUp, SteadyRotation, instants

_MOST_WAVES = 100
_ROUND_OFF = 1e-9


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
        Shortest period of what the acceleration is made of [s].
    """

    start: float
    omega: float
    ramp_time: float
    shortest_wave: float

    @abstractmethod
    def _within(self, t: Any, derivative: int) -> Any:
        """Angle, or its first or second derivative, at t from 0 to `ramp_time`."""

    @overload
    def angle(self, t: float) -> float: ...
    @overload
    def angle(self, t: FloatArray) -> FloatArray: ...
    def angle(self, t: float | FloatArray) -> float | FloatArray:
        """Angle θ(t) [rad], zero at t = 0; `t` [s] scalar or array, result of the same shape."""
        within, t = self._clipped(t), instants(t)
        beyond = np.where(t > within, self.omega, self.start) * (t - within)
        angle: float | FloatArray = _like(t, self._within(within, 0) + beyond)
        return angle

    @overload
    def rate(self, t: float) -> float: ...
    @overload
    def rate(self, t: FloatArray) -> FloatArray: ...
    def rate(self, t: float | FloatArray) -> float | FloatArray:
        """Angular velocity dθ/dt [rad/s]; `t` [s] scalar or array."""
        rate: float | FloatArray = _like(t, self._within(self._clipped(t), 1))
        return rate

    @overload
    def acceleration(self, t: float) -> float: ...
    @overload
    def acceleration(self, t: FloatArray) -> FloatArray: ...
    def acceleration(self, t: float | FloatArray) -> float | FloatArray:
        """Angular acceleration d²θ/dt² [rad/s²]; `t` [s] scalar or array."""
        acceleration: float | FloatArray = _like(t, self._within(self._clipped(t), 2))
        return acceleration

    def _clipped(self, t: Any) -> Any:
        return np.minimum(np.maximum(instants(t), 0.0), self.ramp_time)


def _like(t: Any, value: Any) -> Any:
    return value if isinstance(t, np.ndarray) else float(value)


@dataclass(frozen=True, kw_only=True)
class SmoothRamp(SpeedChange):
    """Change of the speed from `start` to `omega` whose acceleration is a Fourier series.

    With s = t/T, 0 ≤ s ≤ 1,

        θ̈ = (ω - ω_start)/T [1 + Σ A_k cos 2πks + Σ B_k sin 2πks],    ΣA_k = -1,  Σ k B_k = 0,

    so that acceleration and jerk vanish at both ends: the speed is twice continuously
    differentiable. A_1 = -1 alone is Eq. 1. A slower `omega` than `start` is a spin-down.

    Parameters
    ----------
    omega : float
        Speed after the ramp [rad/s]; zero or positive.
    ramp_time : float
        T [s].
    start : float
        Speed before the ramp [rad/s]; zero or positive.
    cosines, sines : sequence of float
        A_k and B_k from k = 1 on, as `design_ramp` finds them.

    Raises
    ------
    ValueError
        If a number is not finite or of the wrong sign, or the sums are others.

    Examples
    --------
    >>> from analytic import SmoothRamp
    >>> SmoothRamp(start=6.0, omega=0.0, ramp_time=4.0).rate(2.0)
    3.0
    """

    omega: float
    ramp_time: float
    start: float = 0.0
    cosines: Sequence[float] = (-1.0,)
    sines: Sequence[float] = ()

    def __post_init__(self) -> None:
        for name, value in (
            ("omega", rotation_speed(self.omega)),
            ("ramp_time", positive("ramp_time", self.ramp_time, "s")),
            ("start", rotation_speed(self.start, "start")),
            ("cosines", _coefficients("cosines", self.cosines)),
            ("sines", _coefficients("sines", self.sines)),
        ):
            object.__setattr__(self, name, value)
        k = np.arange(1, len(self.sines) + 1)
        sums = (("cosines", math.fsum(self.cosines), -1.0), ("sines", float(k @ self.sines), 0.0))
        for name, found, wanted in sums:
            if abs(found - wanted) > _ROUND_OFF:
                weighted = "k times " if name == "sines" else ""
                raise ValueError(
                    f"the sum of {weighted}the {name} must be {wanted:g}, for the acceleration "
                    f"and the jerk to vanish at both ends, got {found:.9g}: change one of them "
                    f"by {wanted - found:.3g}{' over its k' if weighted else ''}"
                )

    @property
    def shortest_wave(self) -> float:  # type: ignore[override]
        """Period of the last term [s]."""
        return self.ramp_time / max(len(self.cosines), len(self.sines))

    @cached_property
    def _waves(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        count = max(len(self.cosines), len(self.sines))
        A, B = np.zeros(count), np.zeros(count)
        A[: len(self.cosines)], B[: len(self.sines)] = self.cosines, self.sines
        return np.asarray(2.0 * np.pi * np.arange(1.0, count + 1.0)), A, B

    def _within(self, t: Any, derivative: int) -> Any:
        T, change = self.ramp_time, self.omega - self.start
        w, A, B = self._waves
        s = np.asarray(t) / T
        sine, cosine = np.sin(s[..., None] * w), np.cos(s[..., None] * w)
        if derivative == 2:
            return change / T * (1.0 + cosine @ A + sine @ B)
        if derivative == 1:
            return self.start + change * (s + sine @ (A / w) + (1.0 - cosine) @ (B / w))
        waves = (1.0 - cosine) @ (A / w**2) - sine @ (B / w**2)
        return self.start * t + change * T * (0.5 * s**2 + waves + s * (B / w).sum())


@dataclass(frozen=True)
class Table(SpeedChange):
    """Speed given at instants, steady before the first and after the last.

    Between two instants the speed stays between the two that are given there, as of a measured
    table it should: it is the monotone cubic of Fritsch and Carlson ("PCHIP"), level at both ends,
    whose acceleration is continuous, and linear between two instants. It differs from a smooth
    motion by the third power of the spacing: a hundred intervals of Eq. 1 move the tip by less than
    1e-6 L. Noise of the speeds is more noise of the acceleration: smooth measured speeds before.

    Parameters
    ----------
    times : sequence of float
        Instants [s], ascending from 0, two at least.
    speeds : sequence of float
        Speeds there [rad/s]; zero or positive.

    Raises
    ------
    ValueError
        If a number is not finite, the instants do not ascend from 0, or there is not one speed for
        each.

    Examples
    --------
    >>> from analytic import Table
    >>> table = Table([0.0, 1.0, 2.0, 3.0], [0.0, 2.0, 5.0, 6.0])
    >>> round(table.rate(1.0), 12), table.ramp_time
    (2.0, 3.0)
    """

    times: Sequence[float]
    speeds: Sequence[float]

    def __post_init__(self) -> None:
        times = finite_values("times", self.times, "s")
        speeds = finite_values("speeds", self.speeds, "rad/s")
        if times.size != speeds.size or times.size < 2:
            raise ValueError(
                f"a table has a speed at each of two instants or more, got {times.size} times and "
                f"{speeds.size} speeds"
            )
        back = np.flatnonzero(np.diff(times) <= 0.0)
        if times[0] != 0.0 or back.size:
            where = (
                f"{times[back[0] + 1]:g} s comes after {times[back[0]]:g} s: sort them, each once"
                if back.size
                else f"the first is {times[0]:g} s: subtract it from all"
            )
            raise ValueError(f"times must ascend from 0 s on, but {where}")
        for speed in speeds:
            rotation_speed(speed, "speeds")
        object.__setattr__(self, "times", tuple(times.tolist()))
        object.__setattr__(self, "speeds", tuple(speeds.tolist()))
        with np.errstate(all="ignore"):
            steepest = 3.0 * np.abs(np.diff(speeds) / np.diff(times) / np.diff(times) ** 2)
        beyond = np.flatnonzero(~np.isfinite(steepest))
        if beyond.size:
            k = beyond[0]
            raise ValueError(
                f"from {times[k]:g} to {times[k + 1]:g} s the speed goes from {speeds[k]:g} to "
                f"{speeds[k + 1]:g} rad/s, beyond what floating point numbers resolve: leave one "
                f"of the two out"
            )

    @property
    def start(self) -> float:  # type: ignore[override]
        """Speed before [rad/s]."""
        return self.speeds[0]

    @property
    def omega(self) -> float:  # type: ignore[override]
        """Speed after [rad/s]."""
        return self.speeds[-1]

    @property
    def ramp_time(self) -> float:  # type: ignore[override]
        """The last instant [s]."""
        return self.times[-1]

    @property
    def shortest_wave(self) -> float:  # type: ignore[override]
        """The shortest interval [s], but no less than a hundredth of the whole."""
        return max(float(np.diff(self.times).min()), self.ramp_time / _MOST_WAVES)

    @cached_property
    def _cubics(self) -> tuple[Any, Any, Any]:
        t, speeds = np.array(self.times), np.array(self.speeds)
        # Steady before and after, for which one more instant at each end makes the ends level.
        around = np.pad(t, 1), np.pad(speeds, 1, mode="edge")
        around[0][[0, -1]] = 2.0 * t[[0, -1]] - t[[1, -2]]
        slopes = interpolate.PchipInterpolator(*around)(t, 1)
        rate = interpolate.CubicHermiteSpline(t, speeds, slopes)
        return rate.antiderivative(), rate, rate.derivative()

    def _within(self, t: Any, derivative: int) -> Any:
        return self._cubics[derivative](t)


def _coefficients(name: str, values: object) -> tuple[float, ...]:
    if np.size(np.asarray(values, dtype=object)) == 0:
        return ()
    numbers = finite_values(name, values)
    if numbers.size > _MOST_WAVES:
        raise ValueError(f"at most {_MOST_WAVES} {name} are taken, got {numbers.size}")
    largest, most = float(np.abs(numbers).max()), _ROUND_OFF / np.finfo(float).eps
    if largest > most:
        raise ValueError(
            f"{name} go up to {largest:.3g}: at most {most:.1g} is taken, beyond round-off decides"
        )
    return tuple(numbers.tolist())


AnyRamp = SpinUp | SpeedChange
"""A motion with a beginning and an end, between two steady speeds."""


def require_ramp(motion: object) -> None:
    """Refuse what is no change of the speed, a steady rotation for one."""
    if not isinstance(motion, AnyRamp):
        raise TypeError(
            f"spin_up must be a SpinUp, a SmoothRamp, a Table or another SpeedChange, got "
            f"{motion!r}; for a beam that turns steadily take periodic_orbits"
        )


def fastest(motion: AnyRamp | SteadyRotation) -> float:
    """Return the highest speed of a motion [rad/s]."""
    if isinstance(motion, SpinUp | SteadyRotation):
        return motion.omega
    if isinstance(motion, Table):
        return max(motion.speeds)
    return float(motion.rate(np.linspace(0.0, motion.ramp_time, 20 * _MOST_WAVES + 1)).max())
