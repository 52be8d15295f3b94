"""A Timoshenko beam in steady rotation: what Reissner's elements converge to in linear vibration.

About the stretched state x + u₀, of elongation e and tension N = EA e, with the deflection v, the
angle φ of the section and the stretch u, Reissner's strains (1 + u')cos φ + v' sin φ - 1,
v' cos φ - (1 + u') sin φ and φ' give, to second order, the energy

    ½∫ [EA u'² + k_s GA (v' - (1 + e)φ)² + EI φ'² + N (2 φ v' - (1 + e) φ²)] dx.

Without shear φ = v'/(1 + e), and the tension's part is N v'²/(1 + e): the beam of `linear_modes`.
Inertia in the rotating frame couples v and u by Coriolis' force and softens both by w̄².
"""

from __future__ import annotations

import math

import numpy as np

from ..arrays import FloatArray
from ..beam import Beam, require_steady_state, warn_if_rpm
from ..input_checks import flag, positive, rotation_speed, whole_number
from ..lazily import linalg
from ..methods.gyroscopic import reciprocal_modes
from ..quadrature import axial_basis, gauss_points, integrals_from_clamp
from ..threads import one_thread

_FEWEST, _MOST = 16, 128
_SETTLED = 1e-9


@one_thread
def timoshenko_frequencies(
    beam: Beam,
    omega: float,
    count: int = 3,
    *,
    shear_share: float,
    rotary_inertia: bool = True,
) -> FloatArray:
    """Return natural frequencies [rad/s] of the shear-deformable beam in steady rotation, (count,).

    In the plane of rotation, undamped, about the stretched state; ascending, axial ones and those
    of shear among them. For shear_share → ∞ and without rotary inertia they are those of
    `linear_modes`.

    Parameters
    ----------
    beam : Beam
    omega : float
        Rotation speed ω [rad/s].
    count : int
        Number of frequencies, at most 32.
    shear_share : float
        Shear stiffness over axial stiffness, k_s GA/(EA) = k_s/(2 (1 + ν)).
    rotary_inertia : bool
        Give the sections their inertia ρI against rotation.

    Raises
    ------
    ValueError
        If the beam is no uniform `Beam`; if `omega` is negative, not finite, or tears it; if
        `shear_share` is not positive or `count` too large; if 128 functions for each unknown do
        not settle the frequencies to 1e-9.

    Examples
    --------
    >>> from analytic import Beam, timoshenko_frequencies
    >>> print(timoshenko_frequencies(Beam.reference(), omega=6.0, shear_share=0.32).round(5))
    [ 3.73022 23.00789 56.63317]
    """
    if not isinstance(beam, Beam):
        raise ValueError("timoshenko_frequencies takes the uniform Beam, not a Blade")
    omega, count = rotation_speed(omega), whole_number("count", count)
    share = positive("shear_share", shear_share)
    if count > _MOST // 4:
        raise ValueError(f"count must be at most {_MOST // 4}, got {count}: ask for less")
    warn_if_rpm(beam, omega)
    require_steady_state(beam, omega)
    w_bar = omega / beam.frequency_scale
    rotary = beam.slenderness if flag("rotary_inertia", rotary_inertia) else 0.0

    def frequencies(functions: int) -> FloatArray:
        return _frequencies(beam.slenderness, w_bar, share, rotary, functions)[:count]

    functions = max(_FEWEST, 2 * count)
    found, change = frequencies(functions), math.inf
    while change > _SETTLED and functions < _MOST:
        functions = min(3 * functions // 2, _MOST)
        before, found = found, frequencies(functions)
        change = float(np.abs(before / found - 1.0).max())
    if change > _SETTLED:
        raise ValueError(
            f"the frequencies at omega = {omega:g} rad/s have not settled to {_SETTLED:g} with "
            f"{_MOST} functions: they change by {change:.1e}; rotate slower"
        )
    return found * beam.frequency_scale


def _frequencies(
    slenderness: float, w_bar: float, share: float, rotary: float, count: int
) -> FloatArray:
    """Return all frequencies, on `count` functions each for the shear angle, φ and u/√μ.

    Polynomials of φ' and of the shear strain γ are orthonormal, v' = (1 + e)φ + γ: then neither
    shear nor its absence locks. With v and φ in the sine, u in the cosine of Ωτ, K - ΩC - Ω²M is
    real and symmetric.
    """
    x, dx = gauss_points(2 * count + 8)
    k, root = math.sqrt(slenderness) * w_bar, math.sqrt(slenderness)
    stretch = np.cos(k * x) / math.cos(k)  # 1 + e
    tension = (stretch - 1.0) / slenderness
    basis = axial_basis(count, x)
    integral = integrals_from_clamp(x.size, x)
    none, gamma = np.zeros_like(basis.value), math.sqrt(slenderness / share) * basis.slope
    turning = np.hstack([none, basis.value])
    slope = np.hstack([gamma, stretch[:, None] * basis.value])
    across, along = integral @ slope, root * basis.value

    def product(left: FloatArray, right: FloatArray, weight: FloatArray = dx) -> FloatArray:
        return np.asarray(left.T @ (weight[:, None] * right))

    # γ'γ and φ'φ' are the identity; N(2φv' - (1+e)φ²) = N(2φγ + (1+e)φ²).
    sheared = product(turning, np.hstack([gamma, none]), tension * dx)
    K = linalg.block_diag(
        np.eye(2 * count)
        + sheared
        + sheared.T
        + product(turning, turning, tension * stretch * dx)
        - w_bar**2 * product(across, across),
        np.eye(count) - w_bar**2 * product(along, along),
    )
    M = linalg.block_diag(
        product(across, across) + rotary * product(turning, turning), product(along, along)
    )
    C = np.zeros_like(K)
    C[: 2 * count, 2 * count :] = 2.0 * w_bar * product(across, along)
    C += C.T
    return 1.0 / reciprocal_modes(K, C, M)[0]
