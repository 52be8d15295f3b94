"""What the other bending modes add through the Coriolis coupling, to cubic order.

The term 2w̄ ∫u₂ v̇ dx couples the first mode φ₁ quadratically to every other mode. With
v = φ₁q + Σφp, A(φ) = -½∫₀ˣ φ₁'φ' dξ and D[φ] = ∫(A(φ) φ₁ - A(φ₁) φ) dx it reads 4w̄ D q q̇ p in the
Lagrangian, so that (K + M d²/dτ²) p = 4w̄ D q q̇. As (q q̇)¨ = -4w̄₁² q q̇ to this order, the others
follow as p = s q q̇,

    (K - 4w̄₁² M) s = 4w̄ d,

and act back like an inertia: 4w̄ D·s (q q̇² + q² q̈), which is the g2 term of Eq. 41. One linear
solve takes all modes at once; D[φ₁] = 0, so the first drops out by itself. Not in the paper, and
without extension, as all of this is.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ..arrays import FloatArray
from ..lazily import linalg
from ..quadrature import gauss_points, transverse_basis
from .rotating_mode import RotatingMode

_POINTS = 48
_FUNCTIONS = 20
"""λ_ω has then converged to 1e-11 up to w̄ = 20, and to 3e-10 at 30."""


class CoriolisCoupling(NamedTuple):
    """What the coupling adds to g2 of Eq. 41, and the tip displacement per x·dx/dτ of all modes."""

    g2: float
    tip: float


def rotating_eigenproblem(w_bar: float, count: int) -> tuple[FloatArray, FloatArray]:
    """Return K and M, (count, count), of the rotating inextensible beam: K c = w̄_j² M c.

    In the Legendre-based `transverse_basis`; K holds bending, centrifugal stiffening and softening.
    """
    x, weights = gauss_points(max(_POINTS, count + 2))
    phi, slope, curvature = transverse_basis(count, x)
    M = phi.T * weights @ phi
    stiffening = slope.T * (weights * (1.0 - x**2)) @ slope
    return curvature.T * weights @ curvature + 0.5 * w_bar**2 * stiffening - w_bar**2 * M, M


def rotating_frequencies(w_bar: float, count: int = 3) -> FloatArray:
    """Return the first `count` normalized natural frequencies w̄_j [-], ascending.

    Functions are added as √w̄, which keeps ten digits of the layer at the clamp.
    """
    functions = max(_FUNCTIONS, math.ceil(4.0 * math.sqrt(w_bar)))
    K, M = rotating_eigenproblem(w_bar, functions)
    # M is nearly singular and K is not, so the reciprocal problem keeps the low modes' digits.
    reciprocal = linalg.eigh(M, K, eigvals_only=True)
    return np.asarray(1.0 / np.sqrt(reciprocal[::-1][:count]))


def coupling_vector(mode: RotatingMode, count: int) -> FloatArray:
    """Return d = D[φ_k], (count,), for every function of the `transverse_basis`."""
    x, weights = gauss_points(_POINTS)
    phi, slope, _ = transverse_basis(count, x)
    # ∫A(φ) φ₁ dx = -½∫φ₁' φ' S dx with S = ∫ₓ¹ φ₁ dξ, and A(φ₁) is φ_u of Eq. 28.
    beyond = x[:, np.newaxis] + (1.0 - x[:, np.newaxis]) * x
    outboard = (1.0 - x) * (mode.deflection(beyond) @ weights)
    return np.asarray(
        -(weights * 0.5 * outboard * mode.slope(x)) @ slope
        - (weights * mode.foreshortening(x)) @ phi
    )


def coriolis_coupling(mode: RotatingMode, count: int = _FUNCTIONS) -> CoriolisCoupling:
    """Return what all other bending modes do to the first, by one linear solve."""
    x, weights = gauss_points(_POINTS)
    d = coupling_vector(mode, count)
    K, M = rotating_eigenproblem(mode.w_bar, count)
    follow = linalg.solve(K - 4.0 * mode.w_n**2 * M, 4.0 * mode.w_bar * d, assume_a="sym")
    M_1 = weights @ mode.deflection(x) ** 2
    tip = transverse_basis(count, np.array([1.0])).value[0]
    return CoriolisCoupling(
        g2=float(4.0 * mode.w_bar * (d @ follow) / M_1), tip=float(tip @ follow)
    )
