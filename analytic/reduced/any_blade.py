"""Eq. 41 of any straight blade: the first mode by Galerkin's method, two measures throughout.

With dm and the rotary inertia dj (point masses included) and EI dx, A[f] = -½∫φ'f' from the
clamp, the tension N = w̄²∫ₓ¹ (δ + ξ) dm, and K, M of the rotating blade (c = cos ψ its setting),

    λ = (M2 + ¼∫φ'⁴dj)/M1 - (3/(2M1ω_n²)) [½∫EIφ''²φ'² + ⅛∫Nφ'⁴ - ½w̄²M2]
        + (4c²w̄²/M1) dᵀ(K - 4ω_n²M)⁻¹d,

M1 = ∫φ² dm + ∫φ'² dj, M2 = ∫A[φ]² dm, d[f] = ∫(A[f]φ - A[φ]f) dm: g2 and g1 of Eq. 41, and the
Coriolis coupling to all other modes. Inextensible; of the uniform beam this is FrC and FrM.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from scipy.linalg import eigh, solve

from ..arrays import FloatArray
from ..profiles import evaluated
from ..quadrature import gauss_points_on, integrals_from_clamp, transverse_basis
from ..unit_blade import UnitBlade
from .oscillator import Oscillator

_FEWEST, _MOST = 20, 80
_SETTLED = 1e-9
"""Change of ω_n and λ from one basis to the next; those of smooth blades settle at once."""


class BladeOscillator(NamedTuple):
    """Eq. 41, the tip displacement per x·dx/dτ of all other modes, and their lowest two w̄_j."""

    oscillator: Oscillator
    tip: float
    others: tuple[float, float]


@lru_cache(maxsize=64)
def blade_oscillator(blade: UnitBlade, w_bar: float, coriolis: bool) -> BladeOscillator:
    """Return Eq. 41 of the blade's first mode at w̄, with or without the other modes.

    Raises
    ------
    ValueError
        If 80 functions do not settle it to 1e-9, as where a section changes in steps.
    """
    count = _FEWEST
    found = _with_functions(blade, w_bar, coriolis, count)
    while True:
        count += 12
        finer = _with_functions(blade, w_bar, coriolis, count)
        change = max(
            abs(finer.oscillator.w_n / found.oscillator.w_n - 1.0),
            abs(finer.oscillator.lambda_omega - found.oscillator.lambda_omega),
        )
        if change <= _SETTLED:
            return finer
        if count + 12 > _MOST:
            if change < 1e-5:
                return finer  # kinks of the section leave an algebraic tail, of this size
            raise ValueError(
                f"the first mode has not settled with {count} functions: twelve more change it "
                f"by {change:.1e}; rotate slower, or smooth the section"
            )
        found = finer


def _with_functions(blade: UnitBlade, w_bar: float, coriolis: bool, count: int) -> BladeOscillator:
    a_panel, panels = math.ceil(count / blade.panel_count), blade.panels
    points = a_panel + 4 + blade.degree
    x, weights = blade.quadrature(2 * points)
    bent = weights * evaluated(blade.bending, x)
    at, dm = blade.inertia(2 * points)
    jx = np.append(x, [position for position, _, _ in blade.masses])
    dj = np.append(
        weights * evaluated(blade.rotary, x), [inertia for _, _, inertia in blade.masses]
    )
    lever = (blade.hub + at) * dm
    # Values at these points to integrals from the clamp to the masses: products of two slopes.
    inner, _ = gauss_points_on(2 * points, panels)
    to_masses = integrals_from_clamp(2 * points, at, panels)
    tension = lever @ to_masses  # ∫N f dx / w̄² = tension @ f(inner)

    phi = transverse_basis(a_panel, at, panels).value
    slope_in = transverse_basis(a_panel, inner, panels).slope
    slope_j = transverse_basis(a_panel, jx, panels).slope
    basis = transverse_basis(a_panel, x, panels)
    at_tip = transverse_basis(a_panel, np.ones(1), panels).value[0]
    M = phi.T @ (dm[:, None] * phi) + slope_j.T @ (dj[:, None] * slope_j)
    softening = blade.setting**2 * w_bar**2 * (phi.T @ (dm[:, None] * phi))
    K = (
        basis.curvature.T @ (bent[:, None] * basis.curvature)
        + w_bar**2 * slope_in.T @ (tension[:, None] * slope_in)
        - softening
    )
    # M is nearly singular and K is not: the reciprocal problem keeps the low modes' digits.
    reciprocal, vectors = eigh(M, K)
    first = vectors[:, -1] / (at_tip @ vectors[:, -1])
    w_n = 1.0 / math.sqrt(reciprocal[-1])

    v, s_in, s = phi @ first, slope_in @ first, basis.slope @ first
    s_j = slope_j @ first
    foreshortening = to_masses @ s_in**2  # -2 A[φ] at the masses
    M1 = float(dm @ v**2 + dj @ s_j**2)
    M2 = float(0.25 * dm @ foreshortening**2)
    quartic = (
        0.5 * bent @ ((basis.curvature @ first) * s) ** 2
        + 0.125 * w_bar**2 * tension @ s_in**4
        - 0.5 * w_bar**2 * M2
    )
    g2 = 4.0 * (M2 + 0.25 * float(dj @ s_j**4)) / M1
    tip = 0.0
    if coriolis:
        rate = blade.setting * w_bar
        d = _coupling(to_masses, slope_in, s_in, phi, v, foreshortening, dm)
        follow = solve(K - 4.0 * w_n**2 * M, 4.0 * rate * d, assume_a="sym")
        g2 += float(4.0 * rate * (d @ follow) / M1)
        tip = float(at_tip @ follow)
    oscillator = Oscillator(w_n=w_n, g1=float(4.0 * quartic / M1), g2=g2)
    second, third = (1.0 / np.sqrt(reciprocal[-2:-4:-1])).tolist()
    return BladeOscillator(oscillator, tip, (second, third))


def _coupling(
    to_masses: FloatArray,
    slopes: FloatArray,
    slope: FloatArray,
    phi: FloatArray,
    v: FloatArray,
    foreshortening: FloatArray,
    dm: FloatArray,
) -> FloatArray:
    """Return d[φ_k] = ∫(A[φ_k]φ - A[φ]φ_k) dm for every function."""
    mixed = -0.5 * to_masses @ (slope[:, None] * slopes)
    return np.asarray((dm * v) @ mixed + 0.5 * (dm * foreshortening) @ phi)
