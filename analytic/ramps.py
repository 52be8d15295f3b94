"""Smooth changes of the speed other than Eq. 1: Fourier series of the acceleration, and tables."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from .arrays import FloatArray
from .input_checks import finite_values, positive, require_ascending, rotation_speed
from .lazily import interpolate
from .motion import SpeedChange

_MOST_WAVES = 100
_ROUND_OFF = 1e-9


@dataclass(frozen=True, kw_only=True)
class FourierRamp(SpeedChange):
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
    >>> from analytic import FourierRamp
    >>> FourierRamp(start=6.0, omega=0.0, ramp_time=4.0).rate(2.0)
    3.0
    """

    omega: float
    ramp_time: float
    start: float = 0.0
    cosines: Sequence[float] = (-1.0,)
    sines: Sequence[float] = ()

    def __post_init__(self) -> None:
        self._keep(
            omega=rotation_speed(self.omega),
            ramp_time=positive("ramp_time", self.ramp_time, "s"),
            start=rotation_speed(self.start, "start"),
            cosines=_coefficients("cosines", self.cosines),
            sines=_coefficients("sines", self.sines),
        )
        k = np.arange(1, len(self.sines) + 1)
        sums = (("cosines", math.fsum(self.cosines), -1.0), ("sines", float(k @ self.sines), 0.0))
        for name, value, target in sums:
            if abs(value - target) > _ROUND_OFF:
                weighted = "k times " if name == "sines" else ""
                raise ValueError(
                    f"the sum of {weighted}the {name} must be {target:g}, for the acceleration "
                    f"and the jerk to vanish at both ends, got {value:.9g}: change one of them "
                    f"by {target - value:.3g}{' over its k' if weighted else ''}"
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
class SpeedTable(SpeedChange):
    """Speed given at instants, steady before the first and after the last.

    Between two instants the speed stays between the two given speeds. It is the monotone cubic of
    Fritsch and Carlson ("PCHIP"), level at both ends; its acceleration is continuous, and linear
    between two instants. It differs from a smooth motion by the third power of the spacing: a
    hundred intervals of Eq. 1 move the tip by less than 1e-6 L. Noise of the speeds is more noise
    of the acceleration: smooth measured speeds before.

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
    >>> from analytic import SpeedTable
    >>> table = SpeedTable([0.0, 1.0, 2.0, 3.0], [0.0, 2.0, 5.0, 6.0])
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
        if times[0] != 0.0:
            raise ValueError(f"times must begin at 0 s, got {times[0]:g} s: subtract it from all")
        require_ascending("times", times, "s")
        for speed in speeds:
            rotation_speed(speed, "speeds")
        self._keep(times=tuple(times.tolist()), speeds=tuple(speeds.tolist()))

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

    @property
    def fastest(self) -> float:
        """The highest of the speeds [rad/s]."""
        return max(self.speeds)

    @property
    def corners(self) -> FloatArray:
        """The instants [s]."""
        return np.array(self.times)

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
    return tuple(finite_values(name, values).tolist())
