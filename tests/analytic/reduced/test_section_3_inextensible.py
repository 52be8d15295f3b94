"""Sec. 3: the cantilever mode, inextensible as printed (Eqs. 39, 42-45, 57-65)."""

import math

import numpy as np
import pytest

from analytic import Beam, Variant, reduced_model
from analytic.beam import BETA_1
from analytic.reduced.lagrangian import energy_coefficients
from analytic.reduced.shapes import CantileverMode
from analytic.reduced.tables import closed_form, half_unit

INEXTENSIBLE = energy_coefficients(CantileverMode(), "inextensible")
M = INEXTENSIBLE.modal_mass


def assert_printed(derived, printed):
    """Every printed digit: within half a unit of the last, and a hair for binary fractions."""
    assert abs(derived - float(printed)) <= half_unit(printed) * (1 + 1e-9)


@pytest.mark.parametrize(
    ("derived", "printed"),
    [
        (M, "0.25"),
        (M * INEXTENSIBLE.bending, "3.0906"),
        (M * INEXTENSIBLE.spin, "0.048334"),
        (M * INEXTENSIBLE.cubic_bending, "2.5275"),
        (M * INEXTENSIBLE.cubic_spin, "-0.14365"),
        (M * INEXTENSIBLE.g2, "0.28730"),
    ],
)
def test_equation_39(derived, printed):
    assert_printed(derived, printed)


@pytest.mark.parametrize(
    ("entry", "printed"),
    [
        (("ω0", "1"), "3.516"),
        (("ω_n²", "1"), "12.362"),
        (("ω_n²", "Ω²"), "2.3901"),
        (("g1", "1"), "10.110"),
        (("g1", "Ω²"), "-7.1034"),
        (("g2", "1"), "1.1492"),
        (("λ_ω ω_n²", "Ω²"), "3.3504"),
        (("λ_ω ω_n²", "1"), "-0.23963"),
        (("λ_x ω_n²", "Ω²"), "0.39365"),
        (("λ_x ω_n²", "1"), "0.57198"),
    ],
)
def test_equations_40_to_44_and_62_to_65(entry, printed):
    assert_printed(closed_form(INEXTENSIBLE)[entry], printed)


def test_equations_57_to_61():
    c, s = INEXTENSIBLE, BETA_1**4
    # Eq. 57: -3 g1/8 and g2/4; Eq. 60: -g1/4 + g2 ω_n²/2.
    assert_printed(-0.375 * c.cubic_spin * s, "2.6638")
    assert_printed(-0.375 * c.cubic_bending, "-3.7913")
    assert_printed(c.g2 / 4, "0.2873")
    assert_printed((0.5 * c.g2 * c.spin - 0.25 * c.cubic_spin) * s, "3.1492")
    assert_printed(0.5 * c.g2 * c.bending - 0.25 * c.cubic_bending, "4.5758")


def test_cantilever_mode_is_an_eigenfunction():
    """Its Rayleigh quotient is stationary, so the energy gives β⁴ to round-off."""
    assert INEXTENSIBLE.bending == pytest.approx(BETA_1**4, rel=1e-13)
    assert pytest.approx(0.25, rel=1e-13) == M


@pytest.mark.parametrize("order", [0, 1])
def test_cantilever_derivatives_are_consistent(order):
    mode, x = CantileverMode(), np.linspace(0.1, 0.9, 5)
    f, df = [(mode.deflection, mode.slope), (mode.slope, mode.curvature)][order]
    h = 1e-5
    # A central difference: h² f''' / 6 ~ 1e-9.
    np.testing.assert_allclose((f(x + h) - f(x - h)) / (2 * h), df(x), atol=1e-8)


def test_linear_model_of_equation_45_diverges_above_omega_0():
    linear = energy_coefficients(CantileverMode(), "none")
    assert_printed(linear.bending, "12.362")
    assert linear.spin == pytest.approx(-1.0, rel=1e-14)
    assert linear.g2 == linear.cubic_bending == linear.cubic_spin == 0.0


def test_linear_model_softens_to_no_oscillation():
    beam = Beam.reference()
    eq_45 = Variant(name="Eq. 45", shape="cantilever", axial="none")
    model = reduced_model(beam, 0.6 * beam.omega_0, eq_45)
    assert model.omega_n == pytest.approx(beam.omega_0 * math.sqrt(1 - 0.36), rel=1e-12)
    with pytest.raises(ValueError, match="no oscillation at omega = .*; lower omega, or take FrM"):
        reduced_model(beam, 1.001 * beam.omega_0, eq_45)
