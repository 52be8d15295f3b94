"""Harmonic balance of a driven system: response curves, with all they pass through.

Damped and driven orbits have no symmetry in time: their series is full, and its phase is the
drive's. The unknowns are its coefficients and the drive's parameter, one more than the projected
equations: a curve, which `response_curve` follows.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, Generic, Literal, TypeVar

import numpy as np

from ..arrays import FloatArray
from .arclength import NoWayOnError
from .fourier import full_period, full_waves
from .system import DrivenSystem, Tangent, relative_defect

D = TypeVar("D", bound=DrivenSystem)

_DIFFERENCE = 1e-6  # of the parameter, for derivatives to it
_TRUNCATED = 5e-6  # residual of the harmonics left out, which leave 1e-6 of the amplitude
_UNRESOLVED = 1e-4  # residual of the functions left out; the amplitude is off by its square
_MOST_HARMONICS = 40
_MOST_FUNCTIONS = 64
_MOST_UNKNOWNS = 4000

Mark = Literal["", "asked", "fold", "peak", "branch point"]


@dataclass(frozen=True, kw_only=True)
class DrivenOrbit(Generic[D]):
    """A periodic orbit under a drive of the same phase, φ = 0 where the drive is greatest.

    Attributes
    ----------
    system : DrivenSystem
    parameter : float
        What is varied along the curve.
    coefficients : ndarray (2H + 1, n)
        The mean, H cosines and H sines.
    mark : str
        What is special about it: "asked" for, a "fold" where the curve turns around, a "peak" of
        the amplitude, a "branch point" where another curve crosses.
    """

    system: D
    parameter: float
    coefficients: FloatArray = field(repr=False)
    mark: Mark = ""

    @property
    def harmonics(self) -> int:
        """Number of harmonics H."""
        return len(self.coefficients) // 2

    @property
    def frequency(self) -> float:
        """Rate of the phase."""
        return self.system.frequency(self.parameter)

    def coordinates(self, phase: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return q, dq/dτ, d²q/dτ² (phases, n) at the phases (phases,)."""
        return self._sums(full_waves(phase, self.harmonics))

    def _sums(self, waves: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        q, slope, bend = waves @ self.coefficients
        return q, self.frequency * slope, self.frequency**2 * bend

    def gauge(self, phase: FloatArray) -> FloatArray:
        """Return the gauge, (phases,)."""
        return self.system.gauge(self.coordinates(phase)[0])

    @cached_property
    def _fine_phases(self) -> FloatArray:
        count = 8 * self.harmonics + 8
        return 2.0 * np.pi * (np.arange(count) + 0.5) / count

    @cached_property
    def gauge_harmonics(self) -> FloatArray:
        """Mean, H cosines and H sines of the gauge, (2H + 1,)."""
        phase = self._fine_phases
        parts = 2.0 / phase.size * full_waves(phase, self.harmonics)[0].T @ self.gauge(phase)
        parts[0] *= 0.5
        return np.asarray(parts)

    @cached_property
    def peak_phase(self) -> float:
        """Phase at which the gauge's size is greatest."""
        gauge = self.gauge(self._fine_phases)
        # Both sides are nearly as high, and samples do not tell which is higher.
        sides = [
            self._stationary(float(self._fine_phases[i(gauge)])) for i in (np.argmax, np.argmin)
        ]
        return sides[int(np.argmax(np.abs(self.gauge(np.array(sides)))))]

    def _stationary(self, phase: float) -> float:
        """Return where the gauge's rate is zero near a phase, by Newton's method."""
        for _ in range(8):
            q, q_dot, _ = self.coordinates(phase + np.array([-1e-4, 0.0, 1e-4]))
            rate = self.system.gauge_rate(q, q_dot)
            step = -2e-4 * rate[1] / (rate[2] - rate[0])
            phase += float(np.clip(step, -0.2, 0.2))
            if abs(step) < 1e-8:  # the peak is wrong by the square of this
                break
        return phase

    @cached_property
    def amplitude(self) -> float:
        """Largest size of the gauge."""
        return float(abs(self.gauge(np.array([self.peak_phase]))[0]))

    def amplitude_slope(self, along: FloatArray) -> float:
        """Return how the amplitude changes as the coefficients change by `along` (2H + 1, n)."""
        at = np.array([self.peak_phase])
        q = self.coordinates(at)[0]
        change = self.system.gauge_gradient(q)[0] @ (full_waves(at, self.harmonics)[0, 0] @ along)
        return float(np.sign(self.system.gauge(q)[0]) * change)

    def _defect(self, system: D) -> float:
        """Return the largest residual in `system`, over the motion's size, at many phases."""
        phase = self._fine_phases
        q, q_dot, q_ddot = (self.system.lifted(c, system) for c in self.coordinates(phase))
        defect = system.residual(q, q_dot, q_ddot, phase, self.parameter)
        return relative_defect(defect, q, slice(None))

    @cached_property
    def truncation(self) -> float:
        """Largest residual that the harmonics left out, relative to the motion."""
        return self._defect(self.system)

    @cached_property
    def residual(self) -> float:
        """Largest residual that harmonics and functions left out, relative to the motion."""
        return self._defect(self.system.refined())

    def tangent(self, phase: FloatArray) -> Tangent:
        """Return the equations' residual and derivatives at the phases (phases,)."""
        return self.system.tangent(*self.coordinates(phase), phase, self.parameter)

    def constants(self) -> None:
        """Return None: the drive fixes the phase, and damping or load take the energy."""

    def with_harmonics(self, count: int) -> DrivenOrbit[D]:
        """Return the same orbit with its series cut or padded to `count` harmonics."""
        coefficients = np.zeros((2 * count + 1, self.system.size))
        kept, old = min(count, self.harmonics), self.harmonics
        coefficients[: kept + 1] = self.coefficients[: kept + 1]
        coefficients[count + 1 : count + 1 + kept] = self.coefficients[old + 1 : old + 1 + kept]
        return replace(self, coefficients=coefficients)

    def on(self, system: D) -> DrivenOrbit[D]:
        """Return the same orbit in the finer `system`."""
        if system is self.system:
            return self
        return replace(
            self, system=system, coefficients=self.system.lifted(self.coefficients, system)
        )


@dataclass(frozen=True, eq=False)
class ResponseCurve(Generic[D]):
    """The projected equations of a driven system, as a curve in coefficients and parameter.

    Attributes
    ----------
    system : DrivenSystem
    harmonics : int
    origin, scale : float
        The parameter is the origin plus the scale times the last unknown.
    """

    system: D
    harmonics: int
    origin: float
    scale: float

    def unknowns(self, orbit: DrivenOrbit[Any]) -> FloatArray:
        """Return the unknowns of an orbit, cut or padded to these harmonics and functions."""
        orbit = orbit.with_harmonics(self.harmonics).on(self.system)
        return np.append(orbit.coefficients.ravel(), (orbit.parameter - self.origin) / self.scale)

    def finer(self, orbit: DrivenOrbit[Any]) -> ResponseCurve[D] | None:
        """Return the curve on more harmonics or functions, if the orbit lacks any."""
        if orbit.truncation > _TRUNCATED:
            curve = replace(self, harmonics=self.harmonics + 2)
        elif orbit.residual > _UNRESOLVED:
            curve = replace(self, system=self.system.refined())
        else:
            return None
        if (
            curve.harmonics > _MOST_HARMONICS
            or curve.system.functions > _MOST_FUNCTIONS
            or (2 * curve.harmonics + 1) * curve.system.size > _MOST_UNKNOWNS
        ):
            short_of_functions = orbit.truncation <= _TRUNCATED
            raise NoWayOnError(
                f"{orbit.harmonics} harmonics and {orbit.system.functions} functions leave a "
                f"residual of {orbit.residual:.1e}",
                "no damping helps where functions are missing: smooth the steps of the section, or "
                "rotate slower"
                if short_of_functions
                else "",
            )
        return curve

    def orbit(self, z: FloatArray) -> DrivenOrbit[D]:
        """Return the orbit of the unknowns."""
        coefficients = z[:-1].reshape(2 * self.harmonics + 1, self.system.size)
        return DrivenOrbit(
            system=self.system,
            parameter=float(self.origin + self.scale * z[-1]),
            coefficients=coefficients,
        )

    def residual(self, z: FloatArray) -> FloatArray:
        """Return the projected residual, as many as there are coefficients."""
        orbit, period = self.orbit(z), full_period(self.harmonics)
        state = orbit._sums(period.waves)
        defect = self.system.residual(*state, period.phase, orbit.parameter)
        return np.asarray((period.onto @ defect).ravel())

    def jacobian(self, z: FloatArray) -> FloatArray:
        """Return its derivatives to all unknowns."""
        orbit, period, n = self.orbit(z), full_period(self.harmonics), self.system.size
        state = orbit._sums(period.waves)
        tangent = self.system.tangent(*state, period.phase, orbit.parameter)
        rows = len(period.onto)
        powers = orbit.frequency ** np.arange(3.0)
        # From samples (3 phases, n n) to harmonics of the residual to harmonics of q.
        in_time = np.concatenate((tangent.stiffness, tangent.damping, tangent.mass))
        waves = powers[:, None, None] * period.waves
        products = period.onto[:, None, None, :] * waves.transpose(2, 0, 1)[None]
        blocks = products.reshape(rows * rows, -1) @ in_time.reshape(len(in_time), -1)
        result = np.empty((rows * n, rows * n + 1))
        result[:, :-1] = (
            blocks.reshape(rows, rows, n, n).transpose(0, 2, 1, 3).reshape(rows * n, -1)
        )
        step = np.zeros_like(z)
        step[-1] = _DIFFERENCE * abs(orbit.parameter) / self.scale
        ahead, behind = self.residual(z + step), self.residual(z - step)
        result[:, -1] = (ahead - behind) / (2.0 * step[-1])
        return result
