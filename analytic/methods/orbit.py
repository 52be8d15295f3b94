"""A periodic orbit, free or driven: its Fourier series, its peak, and its values."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, Generic, Self, TypeVar

import numpy as np

from ..arrays import ComplexArray, FloatArray
from .fourier import Parts, Period, packed, parts_of, period, waves
from .system import Tangent

_PHASE_STEP = 1e-4  # of the last step to the peak: after it the phase is wrong by its square
_MOVES = 1e-9  # of the coordinates; less is round-off of those that stand still

S = TypeVar("S", bound=Any)  # a System; `Path` and `OrbitCurve` say which


@dataclass(frozen=True, kw_only=True)
class Orbit(Generic[S]):
    """A periodic orbit in nondimensional form, of phase φ = Ωτ.

    A driven orbit has the phase of its drive. Where time reversal leaves half a series, odd
    coordinates are zero at φ = 0.
    """

    system: S
    frequency: float  # Ω
    coefficients: FloatArray = field(repr=False)  # (2H + 1, n): the mean, H cosines and H sines
    amplitude: float = math.nan  # peak of the gauge
    peak_phase: float = 0.5 * np.pi
    frequency_error: float = math.nan  # relative change of Ω under one more refinement, if asked
    # Lowest point of a free orbit without symmetry, whose amplitude is half the distance of both;
    # NaN of others.
    low_phase: float = math.nan

    @property
    def harmonics(self) -> int:
        """Number of harmonics H."""
        return len(self.coefficients) // 2

    @cached_property
    def parts(self) -> Parts:
        """Coefficients that symmetry does not make zero (`parts_of`)."""
        free = self.system.odd is None and not self.system.driven
        pinned = self.system.pinned if free else None
        return parts_of(self.system.odd, self.system.size, self.harmonics, pinned)

    def period(self, fine: bool = False, coarse: bool = False) -> Period:
        """Return the period, or the half of it that is all of it."""
        return period(self.harmonics, self.system.odd is not None, fine, coarse)

    @property
    def sizes(self) -> FloatArray:
        """Sizes of harmonics 1 to H, (H,), of the odd coordinates where there are some."""
        cosines, sines = np.split(self.coefficients[1:], 2)
        odd = self.system.odd
        return np.asarray(
            np.linalg.norm(np.hstack((cosines, sines)) if odd is None else sines[:, odd], axis=1)
        )

    @property
    def moving(self) -> slice:
        """Unknowns by which the motion is measured: the sines, or all but the mean."""
        count = self.parts[0][0].size
        return slice(count * self.harmonics) if self.system.odd is not None else slice(count, None)

    @property
    def crests(self) -> tuple[FloatArray, FloatArray]:
        """Phases of the peak and, where it counts, of the lowest point, and their weights."""
        if math.isnan(self.low_phase):
            return np.array([self.peak_phase]), np.ones(1)
        return np.array([self.peak_phase, self.low_phase]), np.array([0.5, -0.5])

    def gauge_near(self, phase: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the gauge at a few phases, and its derivative to the phase; both (phases,)."""
        q, change = waves(phase, self.harmonics, order=1) @ self.coefficients
        return self.system.gauge(q), self.system.gauge_rate(q, change)

    def crest(self) -> Crest:
        """Return the peak of the gauge; of a full series that of its size, or half a free swing."""
        half = self.system.odd is not None
        at = self.period(fine=not half)
        gauge = self.system.gauge(self.summed(at.waves)[0])
        both = at.phase[[np.argmax(gauge), np.argmin(gauge)]]
        if half or not self.system.driven:
            return Crest(self, both[:1] if half else both)
        # Both sides are nearly as high, and samples do not tell which is higher.
        return max((Crest(self, both[[i]]) for i in (0, 1)), key=lambda crest: abs(crest.height))

    def at_peak(self) -> Self:
        """Return the orbit with its amplitude and the phase of the peak."""
        crest = self.crest()
        return replace(self, peak_phase=crest.phase, amplitude=abs(crest.height))

    def peak_gradient(self) -> FloatArray:
        """Return the derivatives of the peak to the unknowns and, zero, to the frequency.

        The phase is where the gauge is stationary, so it adds nothing to them.
        """
        phases, weights = self.crests
        wave = waves(phases, self.harmonics, order=0)[0]
        q = wave @ self.coefficients
        if phases.size == 1:
            weights = np.sign(self.system.gauge(q))
        rows = (wave.T * weights) @ self.system.gauge_gradient(q)
        return np.append(packed(rows, self.parts), 0.0)

    def coordinates(self, phase: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return q, dq/dτ, d²q/dτ² (phases, n) at the phases (phases,)."""
        return self.summed(waves(phase, self.harmonics))

    def summed(self, at: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return the same where the waves are `at`, (3, phases, 2H + 1)."""
        q, slope, bend = at @ self.coefficients
        return q, self.frequency * slope, self.frequency**2 * bend

    def drive(self, phase: FloatArray) -> tuple[()] | tuple[FloatArray, float]:
        """Return the arguments of a driven system besides its state."""
        return (phase, self.frequency) if self.system.driven else ()

    def tangent(self, phase: FloatArray) -> Tangent:
        """Return the equations' residual and derivatives at the phases (phases,)."""
        at: Tangent = self.system.tangent(*self.coordinates(phase), *self.drive(phase))
        return at

    def gauge(self, phase: FloatArray) -> FloatArray:
        """Return the gauge, (phases,)."""
        return np.asarray(self.system.gauge(self.coordinates(phase)[0]))

    @cached_property
    def _finely(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """The coordinates at the phases of the fine `period`."""
        return self.summed(self.period(fine=True).waves)

    @cached_property
    def gauge_harmonics(self) -> ComplexArray:
        """The gauge as Re Σ h_k exp(ikφ), k = 0 to H, (H + 1,)."""
        parts, H = self.period(fine=True).onto @ self.system.gauge(self._finely[0]), self.harmonics
        if self.system.odd is not None:
            parts[: H + 1] = 0.0  # the gauge is odd
        return np.asarray(parts[: H + 1] - 1j * np.append(0.0, parts[H + 1 :]))

    @property
    def gauge_sines(self) -> FloatArray:
        """Sine coefficients 1 to H of the gauge, (H,)."""
        return -self.gauge_harmonics.imag[1:]

    def defect(self, system: S) -> FloatArray:
        """Return the residual in a finer system at the phases of the fine `period`, (phases, n)."""
        state = (self.system.lifted(c, system) for c in self._finely)
        return np.asarray(system.residual(*state, *self.drive(self.period(fine=True).phase)))

    def _relative(self, defect: FloatArray) -> float:
        """Return the largest defect, over the motion of the coordinates that are measured."""
        # Mean and motion by their own sizes: a steady stretch's residual is no small motion's.
        q, odd = self._finely[0], self.system.odd
        mean, motion = defect.mean(axis=0), q - q.mean(axis=0)
        moving = motion if odd is None else motion[:, odd]
        moved = max(np.linalg.norm(moving, axis=-1).max(), _MOVES)
        of_mean = np.linalg.norm(mean) / max(np.linalg.norm(q, axis=-1).max(), _MOVES)
        of_motion = np.linalg.norm(defect - mean, axis=-1).max() / moved
        return float(of_mean + of_motion)

    @cached_property
    def finer_defect(self) -> FloatArray:
        """`defect` in the finer system."""
        return self.defect(self.finer)

    @cached_property
    def finer(self) -> S:
        """The system on more coordinates, which may be chosen by this motion."""
        phase = self.period(fine=True).phase
        finer: S = self.system.refined(*self._finely, *self.drive(phase))
        return finer

    @cached_property
    def residual(self) -> float:
        """Largest residual that harmonics and functions left out, relative to the motion."""
        return self._relative(self.finer_defect)

    @cached_property
    def truncation(self) -> float:
        """Largest residual that the harmonics left out, relative to the motion."""
        return self._relative(self.defect(self.system))

    @cached_property
    def _energies(self) -> tuple[FloatArray, float]:
        q, q_dot, _ = self._finely
        kinetic = self.system.kinetic_energy(q, q_dot)
        return kinetic + self.system.potential(q), float(kinetic.max())

    @property
    def invariant_drift(self) -> float:
        """Largest change of a free orbit's invariant along it, over the kinetic energy."""
        invariant, kinetic = self._energies
        return float(np.ptp(invariant) / kinetic)

    @property
    def invariant_noise(self) -> float:
        """Round-off of `invariant_drift`: a potential may outweigh small orbits."""
        invariant, kinetic = self._energies
        return float(4.0 * np.finfo(float).eps * np.abs(invariant).max() / kinetic)

    def constants(self) -> tuple[FloatArray, FloatArray] | None:
        """Return the flow (2n,) and the gradient of the invariant (2n,) at φ = 0.

        None under a drive: it fixes the phase, and damping or load take the energy.
        """
        if self.system.driven:
            return None
        q, q_dot, q_ddot = self.coordinates(np.zeros(1))
        n, h = self.system.size, 1e-5
        steps = h * np.eye(2 * n)
        ahead, behind = (
            self.system.kinetic_energy(q + sign * steps[:, :n], q_dot + sign * steps[:, n:])
            + self.system.potential(q + sign * steps[:, :n])
            for sign in (1.0, -1.0)
        )
        return np.concatenate((q_dot[0], q_ddot[0])), (ahead - behind) / (2.0 * h)

    def with_harmonics(self, count: int) -> Self:
        """Return the same orbit with its series cut or padded to `count` harmonics."""
        old, kept = self.harmonics, min(count, self.harmonics)
        if count == old:
            return self
        coefficients = np.zeros((2 * count + 1, self.system.size))
        coefficients[: kept + 1] = self.coefficients[: kept + 1]
        coefficients[count + 1 : count + 1 + kept] = self.coefficients[old + 1 : old + 1 + kept]
        return replace(self, coefficients=coefficients)

    def on(self, system: S) -> Self:
        """Return the same orbit in the finer `system`."""
        if system is self.system:
            return self
        return replace(
            self, system=system, coefficients=self.system.lifted(self.coefficients, system)
        )

    def scaled(self, amplitude: float) -> Self:
        """Return the orbit with harmonic k scaled as its leading order is, as amplitude^k.

        The mean departs from the equilibrium by the square; any linear extrapolation would strain
        the stiff coordinates. High harmonics are held back, or their round-off would be blown up.
        """
        factor, k = amplitude / self.amplitude, np.arange(self.harmonics + 1.0)
        powers = factor ** np.minimum(np.append(k, k[1:]), 6.0)[:, None]
        coefficients = powers * self.coefficients
        mean = self.system.equilibrium
        coefficients[0] = mean + factor**2 * (self.coefficients[0] - mean)
        return replace(self, amplitude=amplitude, coefficients=coefficients)


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
            value, slope = (part.reshape(-1, 3) for part in orbit.gauge_near(near.ravel()))
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
        self._step(*orbit.gauge_near(self._phases))

    def _step(self, value: FloatArray, slope: FloatArray) -> None:
        step = -slope / self._curvature
        self._phases = self._phases + np.clip(step, -0.2, 0.2)
        # Beyond the step's square, which is half its slope, the cube is below round-off.
        heights = value + 0.5 * step * slope
        self._moved = float(np.abs(step).max())
        self.height = float(heights[0] if heights.size == 1 else 0.5 * (heights[0] - heights[1]))
