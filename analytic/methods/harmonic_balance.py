"""Harmonic balance: one periodic orbit of a system that time reversal maps onto itself.

The residual of the orbit's Fourier series, projected onto its waves at midpoints of half a period,
and the peak of the gauge, fixed to the amplitude a, are as many equations as the coefficients and
the frequency Ω are unknowns. Newton's method solves them with the exact tangent. For a rotating
beam the gauge is the tip's deflection, and the Coriolis force brings in even harmonics.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, Generic, TypeVar

import numpy as np
from numpy.typing import NDArray
from scipy import linalg

from ..arrays import FloatArray
from .fourier import Waves, half_period, packed, unpacked
from .system import System, Tangent

_NEWTON_STEPS = 15
_CONVERGED = 1e-13  # of the odd coordinates and of Ω
_ROUND_OFF = 1e-9  # of the same: where small orbits may stagnate, by the round-off of the mean
_SLOW = 0.1  # a contraction worse than this pays for a new tangent


S = TypeVar("S", bound=System)
_Indices = NDArray[np.intp]


class NoOrbitError(Exception):
    """Newton's method found no orbit; the message says why, `last` is the last orbit found."""

    def __init__(self, message: str, last: PeriodicOrbit[Any] | None = None) -> None:
        super().__init__(message)
        self.last = last


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
    """

    system: S
    amplitude: float
    frequency: float
    coefficients: FloatArray
    peak_phase: float = 0.5 * np.pi

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

    def gauge(self, phase: FloatArray) -> FloatArray:
        """Return the gauge, (phases,)."""
        return self.system.gauge(self.coordinates(phase)[0])

    @cached_property
    def _fine_phases(self) -> FloatArray:
        count = 4 * self.harmonics + 8
        return np.pi * (np.arange(count) + 0.5) / count

    @cached_property
    def gauge_harmonics(self) -> FloatArray:
        """Sine coefficients 1 to H of the gauge, (H,)."""
        phase = self._fine_phases
        k = np.arange(1, self.harmonics + 1)
        return 2.0 / phase.size * self.gauge(phase) @ np.sin(np.multiply.outer(phase, k))

    @cached_property
    def residual(self) -> float:
        """Largest residual along the orbit, relative to the odd coordinates' own size.

        At four times as many phases as harmonics and in the refined system, so that it also sees
        what both truncations left out.
        """
        finer = self.system.refined()
        state = self.coordinates(self._fine_phases)
        q, q_dot, q_ddot = (self.system.lifted(c, finer) for c in state)
        defect = finer.residual(q, q_dot, q_ddot)
        size = np.linalg.norm(q[:, finer.odd], axis=-1).max()
        return float(np.linalg.norm(defect, axis=-1).max() / size)

    @cached_property
    def invariant_drift(self) -> float:
        """Largest change of the invariant along the orbit, over the kinetic energy."""
        q, q_dot, _ = self.coordinates(self._fine_phases)
        invariant = self.system.invariant(q, q_dot)
        return float(np.ptp(invariant) / self.system.kinetic_energy(q, q_dot).max())

    @cached_property
    def invariant_noise(self) -> float:
        """Round-off of `invariant_drift`: a potential may outweigh small orbits."""
        q, q_dot, _ = self.coordinates(self._fine_phases)
        size = np.abs(self.system.invariant(q, q_dot)).max()
        kinetic = self.system.kinetic_energy(q, q_dot).max()
        return float(4.0 * np.finfo(float).eps * size / kinetic)

    def tangent(self, phase: FloatArray) -> Tangent:
        """Return the equations' residual and derivatives at the phases (phases,)."""
        return self.system.tangent(*self.coordinates(phase))

    def constants(self) -> tuple[FloatArray, FloatArray]:
        """Return the flow (2n,) and the gradient of the invariant (2n,) at φ = 0."""
        q, q_dot, q_ddot = self.coordinates(np.zeros(1))
        n, h = self.system.size, 1e-5
        steps = h * np.eye(2 * n)
        ahead, behind = (
            self.system.invariant(q + sign * steps[:, :n], q_dot + sign * steps[:, n:])
            for sign in (1.0, -1.0)
        )
        return np.concatenate((q_dot[0], q_ddot[0])), (ahead - behind) / (2.0 * h)

    def with_harmonics(self, count: int) -> PeriodicOrbit[S]:
        """Return the same orbit with its series cut or padded to `count` harmonics."""
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


def jacobian(orbit: PeriodicOrbit[Any]) -> FloatArray:
    """Return the derivatives of the harmonics of the residual to those of q and to Ω.

    The last row is left to the amplitude, or to whatever picks one orbit of the branch.
    """
    half, system = half_period(orbit.harmonics), orbit.system
    q, q_dot, q_ddot = orbit.coordinates(half.phase)
    tangent = system.tangent(q, q_dot, q_ddot)
    in_time = np.concatenate(
        (
            tangent.stiffness,
            orbit.frequency * tangent.damping,
            orbit.frequency**2 * tangent.mass,
        )
    )
    sides = (
        (np.flatnonzero(system.odd), half.onto_odd, half.waves.odd),
        (np.flatnonzero(~system.odd), half.onto_even, half.waves.even),
    )

    def block(rows: _Indices, onto: FloatArray, columns: _Indices, waves: FloatArray) -> FloatArray:
        part = in_time[:, rows[:, None], columns]
        products = onto[:, None, None, :] * waves.transpose(2, 0, 1)[None]
        count, functions, others = len(onto), part.shape[1], part.shape[2]
        result = products.reshape(-1, len(part)) @ part.reshape(len(part), -1)
        result = result.reshape(count, -1, functions, others).transpose(0, 2, 1, 3)
        return np.asarray(result.reshape(count * functions, -1))

    by_harmonics = np.block(
        [
            [block(rows, onto, columns, waves) for columns, _, waves in sides]
            for rows, onto, _ in sides
        ]
    )
    by_frequency = (tangent.damping @ q_dot[..., None] + 2.0 * tangent.mass @ q_ddot[..., None])[
        ..., 0
    ] / orbit.frequency
    unknowns = len(by_harmonics) + 1
    matrix = np.zeros((unknowns, unknowns))
    matrix[:-1, :-1] = by_harmonics
    matrix[:-1, -1] = half.project(by_frequency, system.odd)
    return matrix


def at_peak(orbit: PeriodicOrbit[S]) -> tuple[PeriodicOrbit[S], float, FloatArray]:
    """Return the orbit with its peak's phase, the peak and its derivatives to the unknowns.

    The phase is where the gauge is stationary, so it adds nothing to the derivatives.
    """
    system = orbit.system
    phases = half_period(orbit.harmonics).phase
    phase = float(phases[np.argmax(orbit.gauge(phases))])
    for _ in range(6):
        around = phase + np.array([-1e-4, 0.0, 1e-4])
        q, q_dot, _ = orbit.coordinates(around)
        rate = system.gauge_rate(q, q_dot)
        step = -rate[1] / ((rate[2] - rate[0]) / 2e-4)
        phase += float(np.clip(step, -0.2, 0.2))
        if abs(step) < 1e-8:  # the peak is wrong by the square of this
            break
    at = np.array([phase])
    q = orbit.coordinates(at)[0]
    k = np.arange(orbit.harmonics + 1)[:, None]
    waves = np.where(system.odd, np.sin(k * phase), np.cos(k * phase))
    row = np.append(packed(waves * system.gauge_gradient(q)[0], system.odd), 0.0)
    return replace(orbit, peak_phase=phase), float(system.gauge(q)[0]), row


def solve(guess: PeriodicOrbit[S], amplitude: float) -> PeriodicOrbit[S]:
    """Return the orbit near `guess` whose gauge has the peak `amplitude`.

    The tangent is factored anew only where the iteration contracts slowly.

    Raises
    ------
    NoOrbitError
        If Newton's method does not converge.
    """
    orbit, factors, last = guess, None, np.inf
    half, odd = half_period(orbit.harmonics), orbit.system.odd
    for _ in range(_NEWTON_STEPS):
        orbit, peak, row = at_peak(orbit)
        defect = orbit.system.residual(*orbit.coordinates(half.phase))
        defect = np.append(half.project(defect, odd), peak - amplitude)
        if not np.all(np.isfinite(defect)):
            break
        if factors is None:
            matrix = jacobian(orbit)
            matrix[-1] = row
            factors = linalg.lu_factor(matrix, check_finite=False)
        change = linalg.lu_solve(factors, defect, check_finite=False)
        orbit = replace(
            orbit,
            coefficients=orbit.coefficients - unpacked(change[:-1], odd),
            frequency=orbit.frequency - float(change[-1]),
        )
        size = float(
            np.linalg.norm(change[:-1]) / np.linalg.norm(orbit.sines)
            + abs(change[-1]) / orbit.frequency
        )
        contraction = size / last if np.isfinite(last) else 1.0
        stagnates = size < _ROUND_OFF and contraction > _SLOW
        if stagnates or size * min(1.0, contraction) < _CONVERGED:
            return replace(at_peak(orbit)[0], amplitude=amplitude)
        if size > 1.0 or orbit.frequency <= 0.0:
            break
        if contraction > _SLOW and np.isfinite(last):
            factors = None
        last = size
    raise NoOrbitError("Newton's method does not converge")
