"""Multiple time scales on Eq. 41, Eqs. 46-65, carried out by sympy.

With ψ = ω_n T0 + φ(T1) and z = exp(jψ), every function on the way is a Laurent polynomial in z, and
the derivatives with respect to the two times are D0 = jω_n z ∂/∂z and D1 = a' ∂/∂a + jφ' z ∂/∂z.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import sympy as sp  # type: ignore[import-untyped]

OMEGA_N = sp.Symbol("omega_n", positive=True)
G1, G2 = sp.symbols("g1 g2", real=True)
A = sp.Symbol("a", positive=True)
A_PRIME, PHI_PRIME = sp.symbols("a' phi'", real=True)

_EPSILON = sp.Symbol("epsilon", positive=True)
_Z = sp.Symbol("z")


@dataclass(frozen=True, kw_only=True)
class TimeScales:
    """What the method finds for Eq. 41, in the symbols ω_n, g1, g2 and a of this module.

    Parameters
    ----------
    amplitude_condition, phase_condition : sympy.Expr
        The solvability conditions, Eqs. 56 and 57; both are zero.
    forcing : sympy.Expr
        Coefficient of cos 3ψ on the right of Eq. 60, per a³.
    lambda_omega : sympy.Expr
        λ_ω of Eq. 64: ω_NL = ω_n (1 - λ_ω a²).
    lambda_x : sympy.Expr
        λ_x of Eq. 65: x = a cos ψ - λ_x a³ cos 3ψ.
    """

    amplitude_condition: sp.Expr
    phase_condition: sp.Expr
    forcing: sp.Expr
    lambda_omega: sp.Expr
    lambda_x: sp.Expr


@cache
def multiple_time_scales() -> TimeScales:
    """Derive λ_ω and λ_x from Eq. 41.

    Corrected: Eq. 60 is of order ε, and since Eq. 61 has no homogeneous part the response starts
    from x(0) = a(1 - λ_x a²), not from the initial value Eq. 53 asks for.
    """
    # Eq. 55, and the third harmonic of Eq. 61 with its amplitude b unknown.
    b = sp.Symbol("b", real=True)
    x_0 = A / 2 * (_Z + 1 / _Z)
    x_1 = b / 2 * (_Z**3 + 1 / _Z**3)
    x = x_0 + _EPSILON * x_1

    # Eqs. 48 and 49, and the residual of Eq. 51.
    velocity = _total_derivative(x)
    acceleration = _total_derivative(velocity)
    nonlinear = G1 * x**3 + G2 * (x * velocity**2 + acceleration * x**2)
    residual = sp.expand(acceleration + OMEGA_N**2 * x + _EPSILON * nonlinear)
    if residual.coeff(_EPSILON, 0) != 0:
        raise AssertionError("Eq. 55 does not solve Eq. 52")
    order_1 = sp.expand(residual.coeff(_EPSILON, 1))

    # Eqs. 56 and 57: nothing on the right of Eq. 53 may resonate.
    secular = sp.expand(order_1.coeff(_Z, 1))
    phase_condition = -sp.re(secular)
    phase_rate = sp.solve(phase_condition, PHI_PRIME)[0]

    third = order_1.coeff(_Z, 3)
    amplitude = sp.solve(third, b)[0]
    return TimeScales(
        amplitude_condition=sp.im(secular) / OMEGA_N,
        phase_condition=sp.expand(phase_condition),
        forcing=sp.expand(-2 * third.subs(b, 0) / A**3),
        lambda_omega=sp.expand(-phase_rate / (OMEGA_N * A**2)),
        lambda_x=sp.expand(-amplitude / A**3),
    )


def _total_derivative(f: sp.Expr) -> sp.Expr:
    """d/dτ = D0 + ε D1, Eq. 48."""
    turning = sp.I * _Z * sp.diff(f, _Z)
    return OMEGA_N * turning + _EPSILON * (A_PRIME * sp.diff(f, A) + PHI_PRIME * turning)
