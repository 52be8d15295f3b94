"""The peak of an orbit's gauge, which is called its amplitude, and its derivatives."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np

from ..arrays import FloatArray
from .fourier import packed, waves
from .orbit import Orbit, S

_PHASE_STEP = 1e-4  # of the last step to the peak: after it the phase is wrong by its square


class Crest:
    """The peak of the gauge near a phase, or half the swing to it from the lowest point.

    By Newton's method. `follow` takes one more step, with the same curvature, as the orbit changes
    a little. The phases are near the peak (1,) or near that and the lowest point (2,); `height` is
    the peak's, or half the distance.
    """

    def __init__(self, orbit: Orbit[Any], phases: FloatArray) -> None:
        self._phases = phases
        for _ in range(6):
            near = np.add.outer(self._phases, [-1e-4, 0.0, 1e-4])
            value, slope = (part.reshape(-1, 3) for part in _gauge_near(orbit, near.ravel()))
            self._curvature = (slope[:, 2] - slope[:, 0]) / 2e-4
            self._step(value[:, 1], slope[:, 1])
            if self._moved < _PHASE_STEP:
                break

    @property
    def phase(self) -> float:
        """Phase of the peak."""
        return float(self._phases[0])

    @property
    def low_phase(self) -> float:
        """Phase of the lowest point; NaN where there is none."""
        return float(self._phases[1]) if self._phases.size > 1 else math.nan

    def follow(self, orbit: Orbit[Any]) -> None:
        """Take the next step."""
        self._step(*_gauge_near(orbit, self._phases))

    def _step(self, value: FloatArray, slope: FloatArray) -> None:
        step = -slope / self._curvature
        self._phases = self._phases + np.clip(step, -0.2, 0.2)
        # Beyond the step's square, which is half its slope, the cube is below round-off.
        heights = value + 0.5 * step * slope
        self._moved = float(np.abs(step).max())
        self.height = float(heights[0] if heights.size == 1 else 0.5 * (heights[0] - heights[1]))


def _gauge_near(orbit: Orbit[Any], phase: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the gauge at a few phases, and its derivative to the phase; both (phases,)."""
    q, change = waves(phase, orbit.harmonics, order=1) @ orbit.coefficients
    return orbit.system.gauge(q), orbit.system.gauge_rate(q, change)


def crest_of(orbit: Orbit[Any]) -> Crest:
    """Return the peak of the gauge; of a full series that of its size or, free, half its swing."""
    half = orbit.system.odd is not None
    at = orbit.period(fine=not half)
    gauge = orbit.system.gauge(orbit.summed(at.waves)[0])
    both = at.phase[[np.argmax(gauge), np.argmin(gauge)]]
    if half or not orbit.system.driven:
        return Crest(orbit, both[:1] if half else both)
    # Both sides are nearly as high, and samples do not tell which is higher.
    return max((Crest(orbit, both[[i]]) for i in (0, 1)), key=lambda crest: abs(crest.height))


def at_peak(orbit: Orbit[S]) -> Orbit[S]:
    """Return the orbit with its amplitude and the phase of the peak."""
    crest = crest_of(orbit)
    return replace(orbit, peak_phase=crest.phase, amplitude=abs(crest.height))


def peak_gradient(orbit: Orbit[Any]) -> FloatArray:
    """Return the derivatives of the peak to the unknowns and, zero, to the frequency.

    The phase is where the gauge is stationary, so it adds nothing to them.
    """
    phases, weights = np.array(orbit.crests).T
    wave = waves(phases, orbit.harmonics, order=0)[0]
    q = wave @ orbit.coefficients
    if phases.size == 1:
        weights = np.sign(orbit.system.gauge(q))
    rows = (wave.T * weights) @ orbit.system.gauge_gradient(q)
    return np.append(packed(rows, orbit.parts), 0.0)
