"""Eq. 41, the oscillator to which every reduced model comes down.

    ẍ + ω_n² x + g1 x³ + g2 (x ẋ² + x² ẍ) = 0

Multiplied by ẋ it integrates to ½(1 + g2 x²) ẋ² + ½ω_n² x² + ¼g1 x⁴ = E. On the orbit through
(a, 0),

    ẋ² = (a² - x²) [ω_n² + ½g1 (a² + x²)] / (1 + g2 x²).
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray

_STEPS = 60
_MARGIN = 1e-6
"""Relative distance in a² kept from the separatrix, where the period is infinite."""


@dataclass(frozen=True, kw_only=True)
class Oscillator:
    """Eq. 41 with its coefficients: ω_n over √(EI/mL³), g1 and g2."""

    w_n: float
    g1: float
    g2: float

    @property
    def lambda_omega(self) -> float:
        """λ_ω of Eq. 64 = g2/4 - 3 g1/(8 ω_n²) [-]; positive softens."""
        return self.g2 / 4 - 3 * self.g1 / (8 * self.w_n**2)

    @property
    def lambda_x(self) -> float:
        """λ_x of Eq. 65 = g2/16 - g1/(32 ω_n²) [-]."""
        return self.g2 / 16 - self.g1 / (32 * self.w_n**2)

    @property
    def largest_amplitude(self) -> float:
        """Amplitude below which every orbit is periodic; may be infinite.

        The restoring force ω_n² a + g1 a³ must point back, and the inertia 1 + g2 a² be positive.
        """
        squares = (
            -(self.w_n**2) / self.g1 if self.g1 < 0.0 else math.inf,
            -1.0 / self.g2 if self.g2 < 0.0 else math.inf,
        )
        return math.sqrt(min(squares) * (1.0 - _MARGIN))

    def exact_frequency(self, a: FloatArray) -> FloatArray:
        """Return 2π over the exact period at amplitude `a`, of any shape, in units of 1/τ.

        With x = a sin ψ the period is ∫₀^2π √((1 + g2 x²)/(ω_n² + ½g1 (a² + x²))) dψ. The integrand
        is analytic and periodic: the midpoint rule converges geometrically, at the rate set by its
        nearest singularity in the complex plane.
        """
        count = self._midpoints(float(np.max(a**2, initial=0.0)))
        total = np.zeros_like(a)
        for _, inertia, stiffness in self._quarter(a, count):
            total += np.sqrt(inertia / stiffness)
        return count / total

    def action(self, a: FloatArray) -> FloatArray:
        """Return the action (1/2π)∮ p dx, p = (1 + g2 x²) ẋ, at amplitudes `a`; ½ω_n a² if small.

        It stays the same while ω_n, g1 and g2 change slowly over a period.
        """
        count = 64
        total = np.zeros_like(a)
        for psi, inertia, stiffness in self._quarter(a, count):
            total += (a * math.cos(psi)) ** 2 * np.sqrt(inertia * stiffness)
        return total / count

    def _quarter(self, a: FloatArray, count: int) -> Iterator[tuple[float, FloatArray, FloatArray]]:
        """Yield midpoints ψ of a quarter period, and what inertia and stiffness are there."""
        for psi in (np.arange(count) + 0.5) * (0.5 * np.pi / count):
            x_square = a**2 * math.sin(psi) ** 2
            stiffness = self.w_n**2 + 0.5 * self.g1 * (a**2 + x_square)
            yield psi, 1.0 + self.g2 * x_square, stiffness

    def _midpoints(self, square: float) -> int:
        """Midpoints on a quarter period that bring the error exp(-4 n y) below round-off."""
        # y is the distance from the real axis of the nearest ψ where inertia or stiffness under
        # the root vanish at a² = `square`: where sin²ψ is one of two values outside [0, 1].
        if square < 1e-30:
            return 1
        zeros = []
        if self.g2 != 0.0:
            zeros.append(-1.0 / (self.g2 * square))
        if self.g1 != 0.0:
            zeros.append(-2.0 * self.w_n**2 / (self.g1 * square) - 1.0)
        distances = [
            math.asinh(math.sqrt(-s)) if s < 0.0 else math.acosh(math.sqrt(s)) for s in zeros
        ]
        return 2 + math.ceil(9.5 / min(distances, default=math.inf))


@dataclass(frozen=True, kw_only=True)
class Perturbation:
    """Perturbation solution as series in the first harmonic a: frequency and tip; no dimensions.

        ω_NL = ω_n (1 - λ a² - κ a⁴),      q/L = a cos ψ - h2 a² sin 2ψ - h3 a³ cos 3ψ.

    Eqs. 63 and 65 hold for one mode: without κ and h2, and h3 = λ_x.
    """

    lambda_omega: float
    kappa: float = 0.0
    h2: float = 0.0
    h3: float = 0.0

    @property
    def largest_amplitude(self) -> float:
        """Amplitude from which on the frequency is not positive; may be infinite."""
        roots = np.roots([-self.kappa, -self.lambda_omega, 1.0])
        squares = roots.real[(abs(roots.imag) < 1e-12) & (roots.real > 0.0)]
        return math.sqrt(float(squares.min())) if squares.size else math.inf

    def ratio(self, a: FloatArray) -> FloatArray:
        """Return ω_NL/ω_n, of the shape of `a`."""
        square = a * a
        return 1.0 - square * (self.lambda_omega + self.kappa * square)

    def deflection(self, psi: FloatArray, a: FloatArray | float) -> FloatArray:
        """Return q/L at the phases ψ."""
        second, third = self.h2 * a**2, self.h3 * a**3
        return np.asarray(a * np.cos(psi) - second * np.sin(2.0 * psi) - third * np.cos(3.0 * psi))

    def rate(self, psi: FloatArray, a: FloatArray | float) -> FloatArray:
        """Return the derivative of q/L to ψ."""
        second, third = 2.0 * self.h2 * a**2, 3.0 * self.h3 * a**3
        return np.asarray(third * np.sin(3.0 * psi) - a * np.sin(psi) - second * np.cos(2.0 * psi))

    def peak_phase(self, a: FloatArray) -> FloatArray:
        """Return the ψ next to zero at which q is greatest, of the shape of `a`."""
        # Stationary where sin ψ = -2 h2 a cos 2ψ + 3 h3 a² sin 3ψ: a contraction.
        psi = np.zeros_like(a)
        for _ in range(_STEPS):
            last = psi
            slope = 3.0 * self.h3 * a**2 * np.sin(3.0 * psi) - 2.0 * self.h2 * a * np.cos(2.0 * psi)
            psi = np.arcsin(np.clip(slope, -1.0, 1.0))
            if np.abs(psi - last).max(initial=0.0) < 1e-12:
                break
        return psi

    def peak(self, a: FloatArray) -> FloatArray:
        """Return the greatest q/L, of the shape of `a`."""
        return self.deflection(self.peak_phase(a), a)

    def first_harmonic(self, peak: FloatArray) -> FloatArray:
        """Return the a at which q/L has this `peak`, of its shape."""
        a = peak.copy()
        for _ in range(_STEPS):
            last = a
            a = peak + (a - self.peak(a))
            if np.abs(a - last).max(initial=0.0) < 1e-15:
                break
        return a
