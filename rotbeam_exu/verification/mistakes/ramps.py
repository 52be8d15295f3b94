"""Ramps that are taken for Eq. 1's: same speed, same time, another way from one to the other."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from analytic import SpinUp


@dataclass(frozen=True, kw_only=True)
class LinearRamp(SpinUp):
    """A rate that grows linearly, ωt/T: Eq. 1 without its sine."""

    def angle(self, t: Any) -> Any:
        """Angle [rad]; `t` [s] scalar or array."""
        ramp = np.clip(t, 0.0, self.ramp_time)
        return self.omega * (t - ramp + 0.5 * ramp**2 / self.ramp_time)

    def rate(self, t: Any) -> Any:
        """Angular velocity [rad/s]; `t` [s] scalar or array."""
        return self.omega / self.ramp_time * np.clip(t, 0.0, self.ramp_time)

    def acceleration(self, t: Any) -> Any:
        """Angular acceleration [rad/s²]; `t` [s] scalar or array."""
        return self.omega / self.ramp_time * (np.asarray(t) < self.ramp_time)


@dataclass(frozen=True, kw_only=True)
class CosineRamp(SpinUp):
    """A rate that grows as half a cosine, (ω/2)(1 - cos(πt/T))."""

    def angle(self, t: Any) -> Any:
        """Angle [rad]; `t` [s] scalar or array."""
        ramp, k = np.clip(t, 0.0, self.ramp_time), np.pi / self.ramp_time
        return self.omega * (t - ramp + 0.5 * (ramp - np.sin(k * ramp) / k))

    def rate(self, t: Any) -> Any:
        """Angular velocity [rad/s]; `t` [s] scalar or array."""
        ramp = np.clip(t, 0.0, self.ramp_time)
        return self.omega * np.sin(0.5 * np.pi * ramp / self.ramp_time) ** 2

    def acceleration(self, t: Any) -> Any:
        """Angular acceleration [rad/s²]; `t` [s] scalar or array."""
        ramp, k = np.clip(t, 0.0, self.ramp_time), np.pi / self.ramp_time
        return 0.5 * self.omega * k * np.sin(k * ramp)


RAMPS: dict[str, type[SpinUp]] = {
    "a rate that grows linearly, without the sine of Eq. 1": LinearRamp,
    "a rate that grows as half a cosine": CosineRamp,
}
