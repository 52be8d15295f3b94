"""Eq. 41 of any straight blade: the first mode by Galerkin's method, two measures throughout.

With dm and the rotary inertia dj (point masses included) and EI dx, A[f] = -½∫φ'f' from the
clamp, the tension N = w̄²∫ₓ¹ (δ + ξ) dm, and K, M of the rotating blade (c = cos ψ its setting),

    λ = (M2 + ¼∫φ'⁴dj)/M1 - (3/(2M1ω_n²)) [½∫EIφ''²φ'² + ⅛∫Nφ'⁴ - ½w̄²M2]
        + (4c²w̄²/M1) dᵀ(K - 4ω_n²M)⁻¹d,

M1 = ∫φ² dm + ∫φ'² dj, M2 = ∫A[φ]² dm, d[f] = ∫(A[f]φ - A[φ]f) dm: g2 and g1 of Eq. 41, and the
Coriolis coupling to all other modes. Inextensible; of the uniform beam this is FrC and FrM.

The first nonlinear normal mode of any straight blade, to fifth order in its amplitude.

Inextensible, z' = exp(iθ), in the frame of the clamp, c = cos ψ of the setting angle. That the
Lagrangian, averaged over a period, is stationary reads for every δθ, with δz' = iδθ exp(iθ),

    ∫EI θ'δθ' dx + ∫θ̈ δθ dj + Re ∫ conj(δz) [z̈ + 2iw̄c ż - w̄²(δ + x + ic²y)] dm = 0,

and is solved order by order in the amplitude ε, the periodic motion being odd in φ = Ωτ,

    θ = ε φ' sin φ + ε² θ₂ + ε³ θ₃ + ...,      Ω² = ω_n² + ε² (Ω²)₂ + ε⁴ (Ω²)₄ + ...

Harmonic m of order k is (K - m²ω_n²M) θ = -(residual of the lower orders): one linear solve takes
all modes at once. In the first harmonic that has a solution for one (Ω²)_{k-1} only. Harmonics
above the third never come back to (Ω²)₄. Nothing is fitted; λ comes out as FrM's, derived anew.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..arrays import ComplexArray, FloatArray
from ..lazily import linalg
from ..methods.fourier import period
from ..settled import ResultT, settled
from ..shape_functions import BladeFunctions, blade_functions
from ..unit_blade import UnitBlade
from .oscillator import Oscillator

_SETTLED = 1e-9, 1e-8
"""Change of ω_n and λ from one basis to the next, and of λ and κ of the normal mode."""
_KINKED = 1e-5
"""Change that is left where a section has kinks, with an algebraic tail."""
_FEWEST, _MOST = 16, 120
_A_ROOT = 3.5
"""Rotation bends the blade in a layer √2/w̄ thin: 3.5 √w̄ functions have ten digits of λ_ω."""
_ON_PANEL = 3, 20
"""Least and most functions on each panel, whatever their sum."""
_ORDER = 5
_HARMONICS = 3


def _settled(
    solve: Callable[[int], ResultT],
    blade: UnitBlade,
    w_bar: float,
    tolerance: float,
    of: Callable[[ResultT], tuple[float, ...]],
    name: str,
) -> ResultT:
    """Return what `solve` finds with the first number of functions that settles its numbers."""
    fewest = min(max(_FEWEST, _A_ROOT * math.sqrt(w_bar)), 2 * _MOST / 3)
    panels = blade.panel_count
    sizes = [max(_ON_PANEL[0], math.ceil(fewest / panels))]
    while (more := math.ceil(1.5 * sizes[-1])) <= max(_ON_PANEL[1], _MOST // panels):
        sizes.append(more)
    remedy, counts = "rotate slower, or smooth the section", (panels * size for size in sizes)
    return settled(solve, counts, tolerance, of, name, remedy, left=_KINKED)[1]


class BladeOscillator(NamedTuple):
    """Eq. 41, and the lowest two w̄_j of all other modes."""

    oscillator: Oscillator
    others: tuple[float, float]


@lru_cache(maxsize=64)
def blade_oscillator(blade: UnitBlade, w_bar: float, coriolis: bool) -> BladeOscillator:
    """Return Eq. 41 of the blade's first mode at w̄, with or without the other modes."""
    return _settled(
        lambda count: _oscillator(blade, w_bar, coriolis, count),
        blade,
        w_bar,
        _SETTLED[0],
        lambda solution: (math.log(solution.oscillator.w_n), solution.oscillator.lambda_omega),
        "the first mode",
    )


def _oscillator(blade: UnitBlade, w_bar: float, coriolis: bool, count: int) -> BladeOscillator:
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


class NormalMode(NamedTuple):
    """Frequency and tip of the nonlinear normal mode; no dimensions.

    Ω = w̄_n (1 - λa² - κa⁴), and to leading order q/L = a sin φ + h2 a² sin 2φ + h3 a³ sin 3φ.
    """

    w_n: float
    lambda_omega: float
    kappa: float  # a being the first harmonic of q/L
    kappa_of_peak: float  # a being its peak
    h2: float
    h3: float


@lru_cache(maxsize=64)
def normal_mode(blade: UnitBlade, w_bar: float) -> NormalMode:
    """Return the first nonlinear normal mode of the blade at w̄."""
    return _settled(
        lambda count: _mode(blade, w_bar, count),
        blade,
        w_bar,
        _SETTLED[1],
        lambda mode: (mode.lambda_omega, mode.kappa_of_peak),
        "the nonlinear normal mode",
    )


def _mode(blade: UnitBlade, w_bar: float, count: int) -> NormalMode:
    of = blade_functions(blade, count)
    first, w_n, _ = of.first_mode(w_bar)
    K = of.stiffness(w_bar)
    M_first = of.mass @ first
    work = _VirtualWork(of, w_bar)
    theta = np.zeros((_ORDER + 1, _HARMONICS, first.size))
    theta[1, 0] = first
    square, rate = np.zeros(_ORDER + 1), np.zeros(_ORDER + 1)  # of Ω² and of Ω
    square[0], rate[0] = w_n**2, w_n
    for k in range(2, _ORDER + 1):
        left = work.harmonics(theta, rate, square, k)
        if k % 2 == 0:
            theta[k, 1] = -linalg.solve(K - 4.0 * w_n**2 * of.mass, left[1], assume_a="sym")
            continue
        square[k - 1] = (first @ left[0]) / (first @ M_first)
        rate[k - 1] = (square[k - 1] - rate[1 : k - 1] @ rate[k - 2 : 0 : -1]) / (2.0 * w_n)
        # The mode's own share stays ε: what is added is orthogonal to it.
        bordered = np.block([[K - w_n**2 * of.mass, M_first[:, None]], [M_first, 0.0]])
        right = np.append(square[k - 1] * M_first - left[0], 0.0)
        theta[k, 0] = linalg.solve(bordered, right, assume_a="sym")[:-1]
        theta[k, 2] = -linalg.solve(K - 9.0 * w_n**2 * of.mass, left[2], assume_a="sym")
    return _of_series(w_n, rate / w_n, work.tip(theta))


class _VirtualWork:
    """Virtual work of a motion θ, a series in its amplitude (orders, harmonics, n) of sin mφ."""

    def __init__(self, of: BladeFunctions, w_bar: float) -> None:
        self._of, self._w_bar = of, w_bar
        self._green = of.to_masses.T @ (of.dm[:, None] * of.to_masses)
        self._hub = w_bar**2 * of.blade.hub * (of.dm @ of.to_masses)
        half, sines = period(_ORDER, half=True), slice(_ORDER + 1, _ORDER + 1 + _HARMONICS)
        self._waves, self._onto = half.waves[..., sines], half.onto[sines]

    def harmonics(
        self, theta: FloatArray, rate: FloatArray, square: FloatArray, k: int
    ) -> FloatArray:
        """Return harmonics 1 to 3 of order k of the work (harmonics, n), without the bending's.

        `rate` and `square` are the orders of Ω and of Ω².
        """
        of, c = self._of, self._of.blade.setting
        rate, square = rate[:, None, None], square[:, None, None]
        angle, first, second = (wave @ theta @ of.slope.T for wave in self._waves)
        at = turn(angle)
        # z̈' and 2iw̄c ż' over exp(iθ), and the centrifugal force of z' itself.
        inertia = 1j * product(square, second) - product(square, product(first, first))
        inertia -= 2.0 * self._w_bar * c * product(rate, first)
        centrifugal = self._w_bar**2 * (at.real + 1j * c**2 * at.imag)
        beyond = (product(at, inertia) - centrifugal) @ self._green
        beyond[0] -= self._hub
        work = product(at.conj(), beyond)[k].imag @ of.slope
        work += product(square, self._waves[2] @ theta)[k] @ of.turning
        return np.asarray(self._onto @ work)

    def tip(self, theta: FloatArray) -> FloatArray:
        """Return the orders of harmonics 1 to 3 of the tip's deflection, (harmonics, orders)."""
        at: ComplexArray = turn(self._waves[0] @ theta @ self._of.slope.T)
        return np.asarray(self._onto @ (at.imag @ self._of.weights).T)


def _of_series(w_n: float, rate: FloatArray, tip: FloatArray) -> NormalMode:
    """Return the normal mode from the orders of Ω/ω_n and of the tip's harmonics (3, orders)."""
    more, h2, h3 = float(tip[0, 3]), float(tip[1, 2]), float(tip[2, 3])
    lambda_omega, quartic = -float(rate[2]), -float(rate[4])
    # The first harmonic is ε + more ε³, and the peak where cos φ = 2 h2 ε is ε + peak ε³.
    peak = more - h3 + 2.0 * h2**2
    return NormalMode(
        w_n=w_n,
        lambda_omega=lambda_omega,
        kappa=quartic - 2.0 * more * lambda_omega,
        kappa_of_peak=quartic - 2.0 * peak * lambda_omega,
        h2=h2,
        h3=h3,
    )


def product(f: NDArray[Any], g: NDArray[Any]) -> NDArray[Any]:
    """Return the product of two power series, their first axes the orders, to the order of both."""
    return np.array([sum(f[j] * g[k - j] for j in range(k + 1)) for k in range(len(f))])


def turn(theta: FloatArray) -> ComplexArray:
    """Return exp(iθ) of a series θ that begins with order 1, by its derivative iθ' exp(iθ)."""
    result = np.zeros(theta.shape, dtype=np.complex128)
    result[0] = 1.0
    for k in range(1, len(theta)):
        result[k] = sum(1j * j / k * theta[j] * result[k - j] for j in range(1, k + 1))
    return result
