"""The prescribed rotation of the clamped end, Eq. 1."""

from __future__ import annotations

from dataclasses import dataclass
from typing import overload

import numpy as np
from numpy.typing import NDArray

from .input_checks import positive, rotation_speed

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class SpinUp:
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
    >>> spin_up = SpinUp(omega=6.0, ramp_time=3.0)
    >>> spin_up.angle(3.0), spin_up.rate(3.0)
    (9.0, 6.0)
    """

    omega: float
    ramp_time: float

    def __post_init__(self) -> None:
        object.__setattr__(self, "omega", rotation_speed(self.omega))
        object.__setattr__(self, "ramp_time", positive("ramp_time", self.ramp_time, "s"))

    @overload
    def angle(self, t: float) -> float: ...
    @overload
    def angle(self, t: FloatArray) -> FloatArray: ...
    def angle(self, t: float | FloatArray) -> float | FloatArray:
        """Angle θ(t) [rad], Eq. 1; `t` [s] scalar or array, result of the same shape."""
        ramp = self._clipped(t)
        frequency = 2.0 * np.pi / self.ramp_time
        during = (
            self.omega
            / self.ramp_time
            * (0.5 * ramp**2 - (2.0 / frequency**2) * np.sin(0.5 * frequency * ramp) ** 2)
        )
        return _like(t, during + self.omega * np.maximum(np.asarray(t) - self.ramp_time, 0.0))

    @overload
    def rate(self, t: float) -> float: ...
    @overload
    def rate(self, t: FloatArray) -> FloatArray: ...
    def rate(self, t: float | FloatArray) -> float | FloatArray:
        """Angular velocity dθ/dt [rad/s]; `t` [s] scalar or array."""
        ramp = self._clipped(t)
        frequency = 2.0 * np.pi / self.ramp_time
        return _like(t, self.omega / self.ramp_time * (ramp - np.sin(frequency * ramp) / frequency))

    @overload
    def acceleration(self, t: float) -> float: ...
    @overload
    def acceleration(self, t: FloatArray) -> FloatArray: ...
    def acceleration(self, t: float | FloatArray) -> float | FloatArray:
        """Angular acceleration d²θ/dt² [rad/s²]; `t` [s] scalar or array."""
        ramp = self._clipped(t)
        return _like(
            t, 2.0 * self.omega / self.ramp_time * np.sin(np.pi * ramp / self.ramp_time) ** 2
        )

    def _clipped(self, t: float | FloatArray) -> FloatArray:
        clipped: FloatArray = np.clip(np.asarray(t, dtype=np.float64), 0.0, self.ramp_time)
        return clipped


def _like(t: float | FloatArray, value: FloatArray) -> float | FloatArray:
    return float(value) if np.ndim(t) == 0 else value
