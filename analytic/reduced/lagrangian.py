"""The one Lagrangian of Secs. 3 and 4, with two switches: the shape, and the axial model.

On the unit beam (m = EI = L = 1) ω becomes w̄ and EA becomes 1/μ. The point x moves to (x + u, v),
v = φ_v q, in a frame that turns at w̄. Eqs. 31, 37, 71, 76 and 77 give, to fourth order,

    T = ½M q̇² + 2 q² q̇² ∫φ_u² dx + ½w̄² ∫[v² + (x + u)²] dx,    V = V_b + V_l,

so that every model is Eq. 41 and differs from the others only in u, one definition each for numbers
and for symbols:

    "none"          u = 0                                     linear model, Eq. 45
    "inextensible"  u' = -½v'²                                Eq. 25, as printed
    "consistent"    u' = -½v'² - ⅛v'⁴                         with the term Eq. 25 drops
    "sine"          u = φ_u q² + Δl, φ_ω = sin(πx/2)          Eqs. 66-68, as printed
    "static"        u = φ_u q² + Δl, φ_ω = (3x - x³)/2        the static solution

The coefficients of Eq. 41 come from quadrature here and in symbols from `symbolic`.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal, NamedTuple

import numpy as np

from ..arrays import FloatArray
from ..quadrature import gauss_points
from .shapes import Shape

Axial = Literal["none", "inextensible", "consistent", "sine", "static"]

Elongation = Callable[[Any, Any], tuple[Any, Any, Any]]
"""φ_ω, φ_ω', φ_ω'' at x, with sin, cos and pi of the library given: numpy or sympy."""


class AxialModel(NamedTuple):
    """The order of the foreshortening, and the shape of the elongation."""

    order: int = 2  # highest power of v' kept in u' = -½v'² - ⅛v'⁴: 0, 2 or 4
    elongation: Elongation | None = None  # φ_ω of Δl ~ μ w̄² φ_ω, Eq. 67; None if inextensible


def _sine(x: Any, library: Any) -> tuple[Any, Any, Any]:
    """Return Eq. 68, the first axial mode, which is not the static solution."""
    k = library.pi / 2
    return library.sin(k * x), k * library.cos(k * x), -(k**2) * library.sin(k * x)


def _static(x: Any, library: Any) -> tuple[Any, Any, Any]:
    """Return what solves the static problem EA u'' = -mω²x/L, Eq. 67."""
    del library
    return (3 * x - x**3) / 2, 3 * (1 - x**2) / 2, -3 * x


AXIAL_MODELS = {
    "none": AxialModel(order=0),
    "inextensible": AxialModel(),
    "consistent": AxialModel(order=4),
    "sine": AxialModel(elongation=_sine),
    "static": AxialModel(elongation=_static),
}


def axial_model(name: str) -> AxialModel:
    """Return the axial model of that name, refusing others with a list of them."""
    if name not in AXIAL_MODELS:
        raise ValueError(f"axial must be one of {', '.join(AXIAL_MODELS)}, got {name!r}")
    return AXIAL_MODELS[name]


_POINTS = 48
"""Exact to polynomials of degree 95, and to round-off for every shape in use."""


@dataclass(frozen=True, kw_only=True)
class EnergyCoefficients:
    """Eq. 41 of one shape and axial model, as a function of w̄ and μ; all nondimensional.

    ω_n² = bending + spin w̄² + μ (thinning w̄² + stretching w̄⁴),  g1 = cubic_bending + cubic_spin w̄².
    """

    modal_mass: float  # M = ∫φ_v² dx, in units of the beam's mass
    bending: float
    spin: float  # centrifugal stiffening less softening
    thinning: float  # share of the elongation Δl ~ μw̄² in bending, Table 4
    stretching: float  # and in V_l and T
    cubic_bending: float
    cubic_spin: float
    g2: float

    def omega_n_squared(self, w_bar: float, mu: float) -> float:
        """Return ω_n² of Eq. 41, Eq. 42 and Table 4 [-]."""
        s = w_bar**2
        return self.bending + self.spin * s + mu * (self.thinning * s + self.stretching * s**2)

    def g1(self, w_bar: float) -> float:
        """Return g1 of Eq. 41, Eq. 43 and Table 4 [-]."""
        return self.cubic_bending + self.cubic_spin * w_bar**2


def energy_coefficients(shape: Shape, axial: Axial) -> EnergyCoefficients:
    """Return the coefficients of Eq. 41 by Gauss quadrature of the energies, for a shape φ_v.

    Corrected against the print: Eq. 31 has no outer square, and in Eq. 76 it is φ_u' q² that
    multiplies 2Δl'.
    """
    x, weights = gauss_points(_POINTS)
    phi, slope, curvature = shape.deflection(x), shape.slope(x), shape.curvature(x)
    # φ_u' = -½φ_v'², Eq. 28; the linear model knows no axial displacement.
    model = axial_model(axial)
    present = 1.0 if model.order else 0.0
    phi_u, phi_u_slope = present * shape.foreshortening(x), -0.5 * present * slope**2
    elongation = strain = strain_slope = np.zeros_like(x)
    if model.elongation is not None:
        elongation, strain, strain_slope = model.elongation(x, np)

    def integral(integrand: FloatArray) -> float:
        return float(weights @ integrand)

    M = integral(phi**2)
    # Eqs. 31 and 77: T of fourth order is 2 q²q̇² ∫φ_u² + ½w̄² q⁴ ∫φ_u², and w̄² q⁴ ∫xχ with
    # χ' = -⅛φ_v'⁴ where the foreshortening is consistent; ∫xχ = -(1/16) ∫(1-x²) φ_v'⁴.
    axial_inertia = integral(phi_u**2)
    cubic_spin = -2.0 * axial_inertia
    if model.order == 4:
        cubic_spin += 0.25 * integral((1.0 - x**2) * slope**4)
    # Eq. 76: V_l = ½∫EA ε_l², with EA Δl' = ⅓ w̄² φ_ω' after Eq. 75.
    cubic_spin += 2.0 / 3.0 * integral(strain * phi_u_slope**2)
    return EnergyCoefficients(
        modal_mass=M,
        # Eqs. 37 and 71 with φ_u'' = -φ_v' φ_v''.
        bending=integral(curvature**2) / M,
        cubic_bending=4.0
        * present
        * integral(curvature**2 * phi_u_slope + (curvature * slope) ** 2)
        / M,
        spin=-1.0 - 2.0 * integral(x * phi_u) / M,
        thinning=-integral(4.0 * strain * curvature**2 + 2.0 * strain_slope * slope * curvature)
        / (3.0 * M),
        stretching=(
            2.0 / 9.0 * integral(strain**2 * phi_u_slope) - 2.0 / 3.0 * integral(elongation * phi_u)
        )
        / M,
        cubic_spin=cubic_spin / M,
        g2=4.0 * axial_inertia / M,
    )
