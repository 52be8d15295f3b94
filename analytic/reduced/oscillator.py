"""Eq. 41 without perturbation: its first integral, the exact period and the orbit.

Multiplied by dx/dτ, Eq. 41 integrates to ½(1 + g2 x²) ẋ² + ½ω_n² x² + ¼g1 x⁴ = E. On the orbit
through (a, 0),

    ẋ² = (a² - x²) [ω_n² + ½g1 (a² + x²)] / (1 + g2 x²).
"""

from __future__ import annotations

import math

import numpy as np

from ..arrays import FloatArray

_MARGIN = 1e-6
"""Relative distance in a² kept from the separatrix, where the period is infinite."""


def largest_amplitude(w_n: float, g1: float, g2: float) -> float:
    """Return the amplitude below which every orbit of Eq. 41 is periodic; may be infinite.

    The restoring force ω_n² a + g1 a³ must point back, and the inertia 1 + g2 a² be positive.
    """
    squares = [-(w_n**2) / g1 if g1 < 0.0 else math.inf, -1.0 / g2 if g2 < 0.0 else math.inf]
    return math.sqrt(min(squares) * (1.0 - _MARGIN))


def exact_frequency(a: FloatArray, w_n: float, g1: float, g2: float) -> FloatArray:
    """Return 2π over the exact period of Eq. 41 at amplitude `a`, of any shape, in units of 1/τ.

    With x = a sin ψ the period is ∫₀^2π √((1 + g2 x²)/(ω_n² + ½g1 (a² + x²))) dψ, an analytic
    periodic integrand: the midpoint rule converges geometrically, at the rate set by the
    integrand's nearest singularity in the complex plane.
    """
    square = a**2
    count = _midpoints(float(np.max(square, initial=0.0)), w_n, g1, g2)
    total = np.zeros_like(square)
    for psi in (np.arange(count) + 0.5) * (0.5 * np.pi / count):
        x_square = square * math.sin(psi) ** 2
        total += np.sqrt((1.0 + g2 * x_square) / (w_n**2 + 0.5 * g1 * (square + x_square)))
    return count / total


def orbit(a: float, n: int, w_n: float, g1: float, g2: float) -> tuple[FloatArray, FloatArray]:
    """Return x and dx/dτ, each (n,), once around the orbit through (a, 0); the ends coincide."""
    psi = np.linspace(0.0, 2.0 * np.pi, n)
    x = a * np.cos(psi)
    speed = np.sqrt((w_n**2 + 0.5 * g1 * (a**2 + x**2)) / (1.0 + g2 * x**2))
    return x, -a * np.sin(psi) * speed


def _midpoints(square: float, w_n: float, g1: float, g2: float) -> int:
    """Midpoints on a quarter period that bring the error exp(-4 n y) below round-off.

    y is the distance from the real axis of the nearest ψ where, at a² = `square`, the inertia or
    the stiffness under the root vanishes: where sin²ψ takes one of two values outside [0, 1].
    """
    if square < 1e-30:
        return 1
    zeros = []
    if g2 != 0.0:
        zeros.append(-1.0 / (g2 * square))
    if g1 != 0.0:
        zeros.append(-2.0 * w_n**2 / (g1 * square) - 1.0)
    distances = [math.asinh(math.sqrt(-s)) if s < 0.0 else math.acosh(math.sqrt(s)) for s in zeros]
    return 2 + math.ceil(9.5 / min(distances, default=math.inf))
