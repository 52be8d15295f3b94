"""A periodic orbit that time reversal maps onto itself: its Fourier series, and what that tells."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, Generic, TypeVar

import numpy as np

from ..arrays import FloatArray
from .fourier import Waves, fine_half_period, half_period, packed
from .system import System, Tangent, relative_defect

_PHASE_STEP = 1e-4  # of the last step to the peak: after it the phase is wrong by its square

S = TypeVar("S", bound=System)


@dataclass(frozen=True, kw_only=True)
class PeriodicOrbit(Generic[S]):
    """A periodic orbit in nondimensional form: phase φ = Ωτ, odd coordinates zero at φ = 0.

    Attributes
    ----------
    system : System
    amplitude : float
        Peak of the gauge.
    frequency : float
        Ω.
    coefficients : ndarray (H + 1, n)
        Harmonics 0 to H: of sines for the odd coordinates, of cosines for the others.
    peak_phase : float
        Phase at which the gauge is greatest.
    frequency_error : float
        Relative change of Ω under one more refinement; NaN where it was not asked for.
    """

    system: S
    amplitude: float
    frequency: float
    coefficients: FloatArray
    peak_phase: float = 0.5 * np.pi
    frequency_error: float = math.nan

    @property
    def harmonics(self) -> int:
        """Number of harmonics H."""
        return len(self.coefficients) - 1

    @property
    def sines(self) -> FloatArray:
        """Harmonics 1 to H of the odd coordinates, (H, odd)."""
        return self.coefficients[1:, self.system.odd]

    def coordinates(self, phase: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return q, dq/dτ, d²q/dτ² (phases, n) at the phases (phases,)."""
        waves = Waves(phase, self.harmonics)
        return waves.sums(self.coefficients, self.system.odd, self.frequency)

    def at_waves(self, waves: Waves) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return the same at the phases of `waves`, which has as many harmonics."""
        return waves.sums(self.coefficients, self.system.odd, self.frequency)

    def gauge(self, phase: FloatArray) -> FloatArray:
        """Return the gauge, (phases,)."""
        return self.system.gauge(self.coordinates(phase)[0])

    def gauge_near(self, phase: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the gauge at a few phases, and its derivative to the phase; both (phases,)."""
        k = np.arange(self.harmonics + 1.0)
        turns = np.multiply.outer(phase, k)
        sin, cos = np.sin(turns), np.cos(turns)
        onto_sin, onto_cos, by_sin, by_cos = (
            np.stack((sin, cos, k * cos, -k * sin)) @ self.coefficients
        )
        odd, system = self.system.odd, self.system
        q, change = np.where(odd, onto_sin, onto_cos), np.where(odd, by_sin, by_cos)
        return system.gauge(q), system.gauge_rate(q, change)

    @cached_property
    def _finely(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """The coordinates at four times as many phases of half a period as harmonics."""
        return self.at_waves(fine_half_period(self.harmonics).waves)

    @cached_property
    def gauge_harmonics(self) -> FloatArray:
        """Sine coefficients 1 to H of the gauge, (H,)."""
        sines = fine_half_period(self.harmonics).waves.odd[0]
        return np.asarray(2.0 / len(sines) * self.system.gauge(self._finely[0]) @ sines)

    @cached_property
    def finer_defect(self) -> FloatArray:
        """Residual in the refined system at the phases of `fine_half_period`, (phases, n)."""
        finer = self.system.refined()
        return finer.residual(*(self.system.lifted(c, finer) for c in self._finely))

    @cached_property
    def residual(self) -> float:
        """Largest residual along the orbit, relative to the odd coordinates, as `relative_defect`.

        At four times as many phases as harmonics and in the refined system, so that it also sees
        what both truncations left out.
        """
        return relative_defect(self.finer_defect, self._finely[0], self.system.odd)

    @cached_property
    def _energies(self) -> tuple[FloatArray, float]:
        q, q_dot, _ = self._finely
        kinetic = self.system.kinetic_energy(q, q_dot)
        return kinetic + self.system.potential(q), float(kinetic.max())

    @property
    def invariant_drift(self) -> float:
        """Largest change of the invariant along the orbit, over the kinetic energy."""
        invariant, kinetic = self._energies
        return float(np.ptp(invariant) / kinetic)

    @property
    def invariant_noise(self) -> float:
        """Round-off of `invariant_drift`: a potential may outweigh small orbits."""
        invariant, kinetic = self._energies
        return float(4.0 * np.finfo(float).eps * np.abs(invariant).max() / kinetic)

    def tangent(self, phase: FloatArray) -> Tangent:
        """Return the equations' residual and derivatives at the phases (phases,)."""
        return self.system.tangent(*self.coordinates(phase))

    def constants(self) -> tuple[FloatArray, FloatArray]:
        """Return the flow (2n,) and the gradient of the invariant (2n,) at φ = 0."""
        q, q_dot, q_ddot = self.coordinates(np.zeros(1))
        n, h = self.system.size, 1e-5
        steps = h * np.eye(2 * n)
        ahead, behind = (
            self.system.kinetic_energy(q + sign * steps[:, :n], q_dot + sign * steps[:, n:])
            + self.system.potential(q + sign * steps[:, :n])
            for sign in (1.0, -1.0)
        )
        return np.concatenate((q_dot[0], q_ddot[0])), (ahead - behind) / (2.0 * h)

    def with_harmonics(self, count: int) -> PeriodicOrbit[S]:
        """Return the same orbit with its series cut or padded to `count` harmonics."""
        if count == self.harmonics:
            return self
        coefficients = np.zeros((count + 1, self.system.size))
        kept = min(count, self.harmonics) + 1
        coefficients[:kept] = self.coefficients[:kept]
        return replace(self, coefficients=coefficients)

    def on(self, system: S) -> PeriodicOrbit[S]:
        """Return the same orbit in the finer `system`."""
        if system is self.system:
            return self
        return replace(
            self, system=system, coefficients=self.system.lifted(self.coefficients, system)
        )

    def scaled(self, amplitude: float) -> PeriodicOrbit[S]:
        """Return the orbit with harmonic k scaled as its leading order is, as amplitude^k.

        The mean departs from the equilibrium by the square; any linear extrapolation would strain
        what is stiff. High harmonics are held back, or their round-off would be blown up.
        """
        factor = amplitude / self.amplitude
        powers = factor ** np.minimum(np.arange(self.harmonics + 1.0), 6.0)[:, None]
        coefficients = powers * self.coefficients
        mean = self.system.equilibrium
        coefficients[0] = mean + factor**2 * (self.coefficients[0] - mean)
        return replace(self, amplitude=amplitude, coefficients=coefficients)


def at_peak(orbit: PeriodicOrbit[S]) -> tuple[PeriodicOrbit[S], float, FloatArray]:
    """Return the orbit with its peak's phase, the peak and its derivatives to the unknowns.

    The phase is where the gauge is stationary, so it adds nothing to the derivatives.
    """
    crest = Crest(highest(orbit))
    orbit = replace(orbit, peak_phase=crest.phase)
    return orbit, crest.height, peak_gradient(orbit)


def highest(orbit: PeriodicOrbit[S]) -> PeriodicOrbit[S]:
    """Return the orbit with the phase near which its gauge is greatest."""
    half = half_period(orbit.harmonics)
    values = orbit.system.gauge(orbit.at_waves(half.waves)[0])
    return replace(orbit, peak_phase=float(half.phase[np.argmax(values)]))


class Crest:
    """The peak of the gauge near the phase that an orbit has, by Newton's method.

    `follow` takes one more step, with the same curvature, as the orbit changes a little.

    Parameters
    ----------
    orbit : PeriodicOrbit

    Attributes
    ----------
    phase, height : float
        Of the peak.
    """

    def __init__(self, orbit: PeriodicOrbit[Any]) -> None:
        around = orbit.peak_phase + np.array([-1e-4, 0.0, 1e-4])
        (_, value, _), (behind, slope, ahead) = orbit.gauge_near(around)
        self.phase = orbit.peak_phase
        self._curvature = (ahead - behind) / 2e-4
        self._step(value, slope)
        for _ in range(5):
            if self._moved < _PHASE_STEP:
                break
            self.follow(orbit)

    def follow(self, orbit: PeriodicOrbit[Any]) -> None:
        """Take the next step."""
        (value,), (slope,) = orbit.gauge_near(np.array([self.phase]))
        self._step(value, slope)

    def _step(self, value: float, slope: float) -> None:
        step = -float(slope) / self._curvature
        self.phase += max(-0.2, min(0.2, step))
        # Beyond the step's square, which is half its slope, the cube is below round-off.
        self._moved, self.height = abs(step), float(value) + 0.5 * step * float(slope)


def peak_gradient(orbit: PeriodicOrbit[Any]) -> FloatArray:
    """Return the derivatives of the gauge at the peak's phase to the unknowns."""
    phase, odd = orbit.peak_phase, orbit.system.odd
    q = orbit.coordinates(np.array([phase]))[0]
    k = np.arange(orbit.harmonics + 1)[:, None]
    waves = np.where(odd, np.sin(k * phase), np.cos(k * phase))
    return np.append(packed(waves * orbit.system.gauge_gradient(q)[0], odd), 0.0)
