"""Yoo and Shin's model of lag and stretch: linear about the blade that rotation has not stretched.

With the stretch s along the blade, the deflection v, the tension N = w̄²∫ₓ¹ (δ + ξ) dm of the
unstretched blade and c = cos ψ,

    m(s̈ - 2cw̄ v̇ - w̄² s) = (EA s')'/μ,      m(v̈ + 2cw̄ ṡ - c²w̄² v) = (N v')' - (EI v'')''.

The Coriolis force couples both, which takes the frequencies most of the way from the inextensible
blade's to the true ones. The rest is the stretch e of the steady state: linearized about it, as in
`linear_modes`, the tension acts from where the mass has moved to, and the tangent turns by
v'/(1+e) rather than v', so that N/(1+e) and the curvature (v'/(1+e))' stand for N and v''.
"""

from __future__ import annotations

import math

import numpy as np

from ...arrays import FloatArray
from ...beam import AnyBlade, require_planar, require_steady_state, warn_if_rpm
from ...blade_functions import blade_functions
from ...input_checks import rotation_speed, whole_number
from ...lazily import linalg
from ...methods.gyroscopic import reciprocal_modes
from ...profiles import evaluated
from ...settled import refined, settled
from ...shape_functions import shape_functions
from ...threads import one_thread
from ...unit_blade import UnitBlade

_FEWEST, _MOST = 24, 96
_SETTLED = 1e-5
"""Relative change of the frequencies by half of the functions; of smooth blades it is 1e-9."""


@one_thread
def unstretched_frequencies(beam: AnyBlade, omega: float, count: int = 3) -> FloatArray:
    """Return natural frequencies [rad/s] as published of the unstretched beam, ascending (count,).

    The chordwise tables of Yoo and Shin (1998) and of Chung and Yoo (2002) linearize about the
    beam that rotation has not stretched. At their slenderness √(AL²/I) = 70 that is 0.03 % too
    high at w̄ = 2 and 0.4 % at w̄ = 10; `linear_modes` has the true frequencies. Axial ones are
    among them.

    Parameters
    ----------
    beam : Beam or Blade
    omega : float
        Rotation speed ω [rad/s].
    count : int
        Number of frequencies, at most 24.

    Raises
    ------
    ValueError
        If `omega` is negative, not finite, or tears the beam; if `count` is too large, or 96
        functions do not settle the frequencies to 1e-5.

    Examples
    --------
    >>> from analytic import Beam, linear_modes, unstretched_frequencies
    >>> beam = Beam.reference()
    >>> print(unstretched_frequencies(beam, omega=6.0).round(5))
    [ 3.73048 23.01044 56.64848]
    >>> print(linear_modes(beam, omega=6.0).frequencies.round(5))
    [ 3.7304  23.01006 56.64712]
    """
    omega = rotation_speed(omega)
    count = whole_number("count", count)
    if count > _MOST // 4:
        raise ValueError(f"count must be at most {_MOST // 4}, got {count}: ask for less")
    require_planar(beam)
    warn_if_rpm(beam, omega)
    require_steady_state(beam, omega)
    w_bar = omega / beam.frequency_scale
    first = min(max(_FEWEST, 2 * count), _MOST // 2)
    _, found, change = settled(
        lambda functions: _frequencies(beam.unit, beam.slenderness, w_bar, functions)[:count],
        refined(first, lambda functions: min(2 * functions, _MOST), lambda most: most == _MOST),
        _SETTLED,
        lambda found: np.log(found),  # noqa: PLW0108  (its type is told)
    )
    if change > _SETTLED:
        raise ValueError(
            f"the frequencies at omega = {omega:g} rad/s have not settled to {_SETTLED:g} with "
            f"{_MOST} functions: the last doubling changes them by {change:.1e}; rotate "
            f"slower, or take linear_modes"
        )
    return found * beam.frequency_scale


def _frequencies(blade: UnitBlade, slenderness: float, w_bar: float, count: int) -> FloatArray:
    """Return all frequencies on `count` functions for v and for s/√μ.

    With v in the sine and s in the cosine of Ωτ, K - ΩC - Ω²M is real and symmetric.
    """
    of, strains = blade_functions(blade, count), shape_functions(blade, count, "axial")
    x, dx = blade.quadrature(2 * (strains.a_panel + 4))
    along, pulled = strains.once(of.at), strains.strain(x)

    def product(left: FloatArray, measure: FloatArray, right: FloatArray) -> FloatArray:
        return np.asarray(left.T @ (measure[:, None] * right))

    inertia_along = slenderness * product(along, of.dm, along)
    stiffness_along = product(pulled, dx * evaluated(blade.axial, x), pulled)
    K = linalg.block_diag(of.stiffness(w_bar), stiffness_along - w_bar**2 * inertia_along)
    M = linalg.block_diag(of.mass, inertia_along)
    C = np.zeros_like(K)
    rate = blade.setting * w_bar * math.sqrt(slenderness)
    C[: of.tip.size, of.tip.size :] = 2.0 * rate * product(of.deflection, of.dm, along)
    C += C.T
    return 1.0 / reciprocal_modes(K, C, M)[0]
