"""The coefficients of Eq. 41 in symbols, expanded by sympy from the energies themselves.

Nothing is expanded by hand here. The ordering of Secs. 3 and 4, q ~ ε and μ ~ ε² (so that Δl ~ q²),
is put into the Lagrangian of Eqs. 31, 32, 34 and 72; terms up to order ε⁴ are kept.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import sympy as sp  # type: ignore[import-untyped]

from .lagrangian import Axial, AxialModel, axial_model
from .oscillator import Oscillator
from .shapes import PolynomialShape

OMEGA = sp.Symbol("Omega", nonnegative=True)
"""Ω = ω/ω0, with the frequency ω0 of the shape itself."""
MU = sp.Symbol("mu", positive=True)
X = sp.Symbol("x", real=True)

_Q, _Q_DOT, _W = sp.symbols("q q_dot w", real=True)
_EPSILON = sp.Symbol("epsilon", positive=True)


@dataclass(frozen=True, kw_only=True)
class SymbolicForms:
    """Eq. 41 and its solution in the symbols Ω and μ, as in Tables 1-4.

    Shapes φ_v and φ_u of x = η/L, ω0² in units of EI/(mL³), the coefficients of Eq. 41, and those
    of Eqs. 64 and 65.
    """

    phi_v: sp.Expr
    phi_u: sp.Expr
    omega_0_squared: sp.Expr
    omega_n_squared: sp.Expr
    g1: sp.Expr
    g2: sp.Expr
    lambda_omega: sp.Expr
    lambda_x: sp.Expr


@cache
def symbolic_forms(shape: PolynomialShape, axial: Axial) -> SymbolicForms:
    """Return Eq. 41 of a polynomial shape with rational coefficients, exactly."""
    phi_v = sum((sp.Rational(c) * X**k for k, c in enumerate(shape.coefficients)), sp.Integer(0))
    phi_u = -_antiderivative(sp.diff(phi_v, X) ** 2) / 2

    lagrangian = sp.Poly(_lagrangian(phi_v, phi_u, axial_model(axial)), _Q, _Q_DOT)
    half_mass = lagrangian.coeff_monomial(_Q_DOT**2)
    # The Euler-Lagrange equation of ½M q̇² + c q²q̇² - ½k q² - ¼h q⁴ over M is Eq. 41.
    omega_n_squared = -lagrangian.coeff_monomial(_Q**2) / half_mass
    omega_0_squared = omega_n_squared.subs(_W, 0)
    spin = {_W: OMEGA * sp.sqrt(omega_0_squared)}
    omega_n_squared = sp.expand(omega_n_squared.subs(spin))
    g1 = sp.expand((-2 * lagrangian.coeff_monomial(_Q**4) / half_mass).subs(spin))
    g2 = lagrangian.coeff_monomial(_Q**2 * _Q_DOT**2) / half_mass

    oscillator = Oscillator(w_n=sp.sqrt(omega_n_squared), g1=g1, g2=g2)
    return SymbolicForms(
        phi_v=phi_v,
        phi_u=sp.expand(phi_u),
        omega_0_squared=omega_0_squared,
        omega_n_squared=omega_n_squared,
        g1=g1,
        g2=g2,
        lambda_omega=sp.cancel(sp.together(oscillator.lambda_omega)),
        lambda_x=sp.cancel(sp.together(oscillator.lambda_x)),
    )


def _lagrangian(phi_v: sp.Expr, phi_u: sp.Expr, axial: AxialModel) -> sp.Expr:
    """L = T - V of the unit beam to order ε⁴, integrated over the length."""
    v = phi_v * _Q
    u = phi_u * _Q**2 if axial.order else sp.Integer(0)
    if axial.order == 4:
        u += -_antiderivative(sp.diff(v, X) ** 4) / 8
    elongation = sp.Integer(0)
    if axial.elongation is not None:
        # Eqs. 67 and 68, with m = L = 1 and EA = 1/μ.
        elongation = MU * _W**2 / 3 * axial.elongation(X, sp)[0]
    u += elongation

    # Velocity in the turning frame, Eqs. 30 and 77, and twice the kinetic energy density.
    velocity_x = sp.diff(u, _Q) * _Q_DOT - _W * v
    velocity_y = _W * (X + u) + sp.diff(v, _Q) * _Q_DOT
    density = velocity_x**2 + velocity_y**2

    # κ² of Eq. 34; its denominator (1 + z)³ is 1/(1 - 3z) to the order kept. The inextensible line
    # has z = 0, and the linear model keeps the linear curvature.
    u_x, v_x = sp.diff(u, X), sp.diff(v, X)
    z = 2 * sp.diff(elongation, X)
    curvature = (1 + u_x) * sp.diff(v, X, 2) - sp.diff(u, X, 2) * v_x
    density -= curvature**2 * (1 - 3 * z)

    # Eqs. 72 and 73; an inextensible line stores no longitudinal energy.
    if elongation != 0:
        strain = sp.expand(u_x + (u_x**2 + v_x**2) / 2)
        density -= strain**2 / MU

    return sp.integrate(_truncated(density), (X, 0, 1)) / 2


def _truncated(density: sp.Expr) -> sp.Expr:
    """Keep orders ε² and ε⁴, q, q̇ ~ ε and μ ~ ε²; odd ones, linear in q̇, are total derivatives."""
    ordered = sp.expand(
        density.subs({_Q: _EPSILON * _Q, _Q_DOT: _EPSILON * _Q_DOT, MU: _EPSILON**2 * MU})
    )
    return sp.expand(ordered.coeff(_EPSILON, 2) + ordered.coeff(_EPSILON, 4))


def _antiderivative(f: sp.Expr) -> sp.Expr:
    """Integrate from the clamp."""
    return sp.integrate(sp.expand(f), X)
