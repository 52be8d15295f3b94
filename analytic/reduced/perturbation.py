"""What a perturbation solution says of the tip: its frequency, and its first three harmonics.

    ω_NL = ω_n (1 - λ a² - κ a⁴),      q/L = a cos ψ - h2 a² sin 2ψ - h3 a³ cos 3ψ,

a the first harmonic. Eqs. 63 and 65 are those of one mode: without κ and h2, and h3 = λ_x.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray

_STEPS = 60


@dataclass(frozen=True, kw_only=True)
class Perturbation:
    """Frequency and tip as series in the first harmonic a; no dimensions.

    Parameters
    ----------
    lambda_omega, kappa : float
        λ and κ.
    h2, h3 : float
        Second and third harmonic of the tip, over a² and a³.
    """

    lambda_omega: float
    kappa: float = 0.0
    h2: float = 0.0
    h3: float

    @property
    def largest_amplitude(self) -> float:
        """Amplitude from which on the frequency is not positive; may be infinite."""
        roots = np.roots([-self.kappa, -self.lambda_omega, 1.0])
        squares = roots.real[(abs(roots.imag) < 1e-12) & (roots.real > 0.0)]
        return math.sqrt(float(squares.min())) if squares.size else math.inf

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
