"""Harmonic balance: one periodic orbit of the exact beam in rotating steady state.

The motion (θ, e)(t) → (-θ, e)(-t) maps orbits onto orbits, so an orbit through the straight beam
is θ = Σ s_k sin kφ, k ≥ 1, and e = Σ c_k cos kφ, k ≥ 0, φ = Ωτ, with all k: the Coriolis force
brings even harmonics into θ. The residual of these series, projected onto sin kφ and cos kφ at
midpoints of half a period (exact for the products kept), and the peak of the tip's deflection,
fixed to the amplitude a, are as many equations as s, c and Ω are unknowns. Newton's method solves
them with the exact tangent.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property, lru_cache

import numpy as np
from scipy import linalg

from ..exact.continuum import Continuum, finer_model
from ..quadrature import FloatArray

_NEWTON_STEPS = 15
_CONVERGED = 1e-13  # of the coordinates of θ and of Ω
_ROUND_OFF = 1e-9  # of the same: where small orbits may stagnate, by the round-off of steady e
_SLOW = 0.1  # a contraction worse than this pays for a new tangent


class NoOrbitError(Exception):
    """Newton's method found no orbit; the message says why, `last` is the last orbit found."""

    def __init__(self, message: str, last: PeriodicOrbit | None = None) -> None:
        super().__init__(message)
        self.last = last


@dataclass(frozen=True, kw_only=True)
class PeriodicOrbit:
    """A periodic orbit in nondimensional form: phase φ = Ωτ, straight beam at φ = 0.

    Attributes
    ----------
    model : Continuum
    rate : float
        w, the rate of the frame.
    amplitude : float
        Peak deflection of the tip, over L.
    frequency : float
        Ω.
    sines : ndarray (H, bending)
        Harmonics 1 to H of the coordinates of θ.
    cosines : ndarray (H + 1, axial)
        Harmonics 0 to H of the coordinates of e.
    peak_phase : float
        Phase at which the tip's deflection is greatest.
    """

    model: Continuum
    rate: float
    amplitude: float
    frequency: float
    sines: FloatArray
    cosines: FloatArray
    peak_phase: float = 0.5 * np.pi

    @property
    def harmonics(self) -> int:
        """Number of harmonics H."""
        return len(self.sines)

    def coordinates(self, phase: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return q, dq/dτ, d²q/dτ² (phases, n) at the phases (phases,)."""
        k = np.arange(self.harmonics + 1)
        sin, cos = np.sin(np.multiply.outer(phase, k)), np.cos(np.multiply.outer(phase, k))
        theta = [sin[:, 1:], k[1:] * cos[:, 1:], -(k[1:] ** 2) * sin[:, 1:]]
        epsilon = [cos, -k * sin, -(k**2) * cos]
        q, q_dot, q_ddot = (
            self.frequency**i * np.concatenate((t @ self.sines, e @ self.cosines), axis=-1)
            for i, (t, e) in enumerate(zip(theta, epsilon, strict=True))
        )
        return q, q_dot, q_ddot

    def tip(self, phase: FloatArray) -> FloatArray:
        """Return the tip's deflection v(1), (phases,)."""
        return self.model.tip(self.coordinates(phase)[0]).imag

    @cached_property
    def _fine_phases(self) -> FloatArray:
        count = 4 * self.harmonics + 8
        return np.pi * (np.arange(count) + 0.5) / count

    @cached_property
    def tip_harmonics(self) -> FloatArray:
        """Sine coefficients 1 to H of the tip's deflection, (H,)."""
        phase = self._fine_phases
        k = np.arange(1, self.harmonics + 1)
        return 2.0 / phase.size * self.tip(phase) @ np.sin(np.multiply.outer(phase, k))

    @cached_property
    def residual(self) -> float:
        """Largest residual of the equations of motion along the orbit, relative to θ's own.

        At four times as many phases as harmonics and on half as many functions again as the
        orbit was computed with, so that it also sees what both truncations left out.
        """
        finer = finer_model(self.model)
        state = self.coordinates(self._fine_phases)
        q, q_dot, q_ddot = (self.model.padded(c, finer) for c in state)
        defect = finer.residual(q, q_dot, q_ddot, self.rate)
        size = np.linalg.norm(q[:, : finer.bending], axis=-1).max()
        return float(np.linalg.norm(defect, axis=-1).max() / size)

    @cached_property
    def jacobi_drift(self) -> float:
        """Largest change of the Jacobi integral along the orbit, over the kinetic energy."""
        q, q_dot, _ = self.coordinates(self._fine_phases)
        integral = self.model.jacobi_integral(q, q_dot, self.rate)
        return float(np.ptp(integral) / self.model.kinetic_energy(q, q_dot).max())

    @cached_property
    def jacobi_noise(self) -> float:
        """Round-off of `jacobi_drift`: the centrifugal part outweighs small orbits."""
        q, q_dot, _ = self.coordinates(self._fine_phases)
        size = np.abs(self.model.jacobi_integral(q, q_dot, self.rate)).max()
        kinetic = self.model.kinetic_energy(q, q_dot).max()
        return float(4.0 * np.finfo(float).eps * size / kinetic)

    def with_harmonics(self, count: int) -> PeriodicOrbit:
        """Return the same orbit with its series cut or padded to `count` harmonics."""
        sines = np.zeros((count, self.model.bending))
        cosines = np.zeros((count + 1, self.model.axial))
        kept = min(count, self.harmonics)
        sines[:kept] = self.sines[:kept]
        cosines[: kept + 1] = self.cosines[: kept + 1]
        return replace(self, sines=sines, cosines=cosines)

    def with_functions(self, model: Continuum) -> PeriodicOrbit:
        """Return the same orbit in the larger basis of `model`."""
        sines = np.pad(self.sines, ((0, 0), (0, model.bending - self.model.bending)))
        cosines = np.pad(self.cosines, ((0, 0), (0, model.axial - self.model.axial)))
        return replace(self, model=model, sines=sines, cosines=cosines)

    def scaled(self, amplitude: float, steady: FloatArray) -> PeriodicOrbit:
        """Return the orbit with harmonic k scaled as its leading order is, as amplitude^k.

        The mean elongation departs from its `steady` value (axial,) by the square; any linear
        extrapolation would stretch the stiff axis. High harmonics are held back, or their
        round-off would be blown up.
        """
        factor = amplitude / self.amplitude
        powers = factor ** np.minimum(np.arange(self.harmonics + 1.0), 6.0)[:, None]
        cosines = powers * self.cosines
        cosines[0] = steady + factor**2 * (self.cosines[0] - steady)
        return replace(self, amplitude=amplitude, sines=powers[1:] * self.sines, cosines=cosines)


class _Series:
    """sin and cos of the harmonics and their derivatives, at midpoints of half a period."""

    def __init__(self, harmonics: int) -> None:
        count = 2 * harmonics + 2
        self.phase = np.pi * (np.arange(count) + 0.5) / count
        k = np.arange(harmonics + 1)
        sin, cos = np.sin(np.outer(self.phase, k)), np.cos(np.outer(self.phase, k))
        self.theta = np.stack((sin, k * cos, -(k**2) * sin))[..., 1:]
        self.epsilon = np.stack((cos, -k * sin, -(k**2) * cos))
        self.onto_sines = 2.0 / count * sin[:, 1:].T
        self.onto_cosines = 2.0 / count * cos.T
        self.onto_cosines[0] *= 0.5


@lru_cache(maxsize=64)
def _series(harmonics: int) -> _Series:
    return _Series(harmonics)


def _project(series: _Series, samples: FloatArray, bending: int) -> FloatArray:
    """Return the harmonics (unknowns,) of coordinates given at the sampled phases."""
    return np.concatenate(
        (
            (series.onto_sines @ samples[:, :bending]).ravel(),
            (series.onto_cosines @ samples[:, bending:]).ravel(),
        )
    )


def _jacobian(orbit: PeriodicOrbit) -> FloatArray:
    """Return the derivatives of the harmonics of the residual to those of q and to Ω."""
    series, bending = _series(orbit.harmonics), orbit.model.bending
    q, q_dot, q_ddot = orbit.coordinates(series.phase)
    tangent = orbit.model.tangent(q, q_dot, q_ddot, orbit.rate)
    in_time = np.concatenate(
        (
            tangent.stiffness,
            orbit.frequency * tangent.damping,
            orbit.frequency**2 * tangent.mass,
        )
    )
    theta, epsilon = slice(0, bending), slice(bending, None)
    sides = (
        (theta, series.onto_sines, series.theta),
        (epsilon, series.onto_cosines, series.epsilon),
    )

    def block(rows: slice, onto: FloatArray, columns: slice, waves: FloatArray) -> FloatArray:
        part = in_time[:, rows, columns]
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
    jacobian = np.zeros((unknowns, unknowns))
    jacobian[:-1, :-1] = by_harmonics
    jacobian[:-1, -1] = _project(series, by_frequency, bending)
    return jacobian


def _at_peak(orbit: PeriodicOrbit) -> tuple[PeriodicOrbit, float, FloatArray]:
    """Return the orbit with its peak's phase, the peak and its derivatives to the unknowns.

    The phase is where the deflection is stationary, so it adds nothing to the derivatives.
    """
    model = orbit.model
    phases = _series(orbit.harmonics).phase
    phase = float(phases[np.argmax(orbit.tip(phases))])
    for _ in range(6):
        around = phase + np.array([-1e-4, 0.0, 1e-4])
        q, q_dot, _ = orbit.coordinates(around)
        rate = model.tip_rate(q, q_dot).imag
        step = -rate[1] / ((rate[2] - rate[0]) / 2e-4)
        phase += float(np.clip(step, -0.2, 0.2))
        if abs(step) < 1e-8:  # the peak is wrong by the square of this
            break
    q = orbit.coordinates(np.array([phase]))[0]
    gradient = model.tip_gradient(q).imag[0]
    k = np.arange(orbit.harmonics + 1)
    row = np.concatenate(
        (
            np.outer(np.sin(k[1:] * phase), gradient[: model.bending]).ravel(),
            np.outer(np.cos(k * phase), gradient[model.bending :]).ravel(),
            [0.0],
        )
    )
    return replace(orbit, peak_phase=phase), float(model.tip(q).imag[0]), row


def solve(guess: PeriodicOrbit, amplitude: float) -> PeriodicOrbit:
    """Return the orbit near `guess` whose tip deflects to the peak `amplitude`, over L.

    The tangent is factored anew only where the iteration contracts slowly.

    Raises
    ------
    NoOrbitError
        If Newton's method does not converge.
    """
    orbit, factors, last = guess, None, np.inf
    series, bending = _series(orbit.harmonics), orbit.model.bending
    for _ in range(_NEWTON_STEPS):
        orbit, peak, row = _at_peak(orbit)
        defect = orbit.model.residual(*orbit.coordinates(series.phase), orbit.rate)
        defect = np.append(_project(series, defect, bending), peak - amplitude)
        if not np.all(np.isfinite(defect)):
            break
        if factors is None:
            jacobian = _jacobian(orbit)
            jacobian[-1] = row
            factors = linalg.lu_factor(jacobian, check_finite=False)
        change = linalg.lu_solve(factors, defect, check_finite=False)
        cut = orbit.sines.size
        orbit = replace(
            orbit,
            sines=orbit.sines - change[:cut].reshape(orbit.sines.shape),
            cosines=orbit.cosines - change[cut:-1].reshape(orbit.cosines.shape),
            frequency=orbit.frequency - float(change[-1]),
        )
        size = float(
            np.linalg.norm(change[:-1]) / np.linalg.norm(orbit.sines)
            + abs(change[-1]) / orbit.frequency
        )
        contraction = size / last if np.isfinite(last) else 1.0
        stagnates = size < _ROUND_OFF and contraction > _SLOW
        if stagnates or size * min(1.0, contraction) < _CONVERGED:
            return replace(_at_peak(orbit)[0], amplitude=amplitude)
        if size > 1.0 or orbit.frequency <= 0.0:
            break
        if contraction > _SLOW and np.isfinite(last):
            factors = None
        last = size
    raise NoOrbitError("Newton's method does not converge")
