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

from ..arrays import FloatArray
from ..blade_functions import BladeFunctions, blade_functions, settled_functions
from ..lazily import linalg
from ..unit_blade import UnitBlade
from .oscillator import Oscillator

_SETTLED = 1e-9
"""Change of ω_n and λ from one basis to the next; for smooth blades they settle at once."""


class BladeOscillator(NamedTuple):
    """Eq. 41, and the lowest two w̄_j of all other modes."""

    oscillator: Oscillator
    others: tuple[float, float]


@lru_cache(maxsize=64)
def blade_oscillator(blade: UnitBlade, w_bar: float, coriolis: bool) -> BladeOscillator:
    """Return Eq. 41 of the blade's first mode at w̄, with or without the other modes."""
    return settled_functions(
        lambda count: _with_functions(blade, w_bar, coriolis, count),
        blade,
        w_bar,
        _SETTLED,
        lambda found: (math.log(found.oscillator.w_n), found.oscillator.lambda_omega),
        "the first mode",
    )


def _with_functions(blade: UnitBlade, w_bar: float, coriolis: bool, count: int) -> BladeOscillator:
    of = blade_functions(blade, count)
    first, w_n, others = of.first_mode(w_bar)
    v, s_in, s_j = of.deflection @ first, of.slope @ first, of.slope_turning @ first
    foreshortening = of.to_masses @ s_in**2  # -2 A[φ] at the masses
    M1 = float(of.dm @ v**2 + of.dj @ s_j**2)
    M2 = float(0.25 * of.dm @ foreshortening**2)
    quartic = (
        0.5 * of.bent @ ((of.curvature @ first) * (of.slope_bent @ first)) ** 2
        + 0.125 * w_bar**2 * of.tension @ s_in**4
        - 0.5 * w_bar**2 * M2
    )
    g2 = 4.0 * (M2 + 0.25 * float(of.dj @ s_j**4)) / M1
    if coriolis:
        rate = blade.setting * w_bar
        d = coupling_vector(of, first)
        dynamic = of.stiffness(w_bar) - 4.0 * w_n**2 * of.mass
        follow = linalg.solve(dynamic, 4.0 * rate * d, assume_a="sym")
        g2 += float(4.0 * rate * (d @ follow) / M1)
    oscillator = Oscillator(w_n=w_n, g1=float(4.0 * quartic / M1), g2=g2)
    return BladeOscillator(oscillator, others)


def coupling_vector(of: BladeFunctions, first: FloatArray) -> FloatArray:
    """Return d[φ_k] = ∫(A[φ_k]φ - A[φ]φ_k) dm (n,) for every function, φ the mode `first`."""
    v, slope = of.deflection @ first, of.slope @ first
    mixed = -0.5 * of.to_masses @ (slope[:, None] * of.slope)
    return np.asarray(
        (of.dm * v) @ mixed + 0.5 * (of.dm * (of.to_masses @ slope**2)) @ of.deflection
    )
