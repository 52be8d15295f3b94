"""Tables 1 to 5: polynomials in exact rationals, the sine, and the rotating mode by Frobenius."""

import dataclasses
import math

import numpy as np
import pytest
import sympy as sp
from numpy.polynomial import Polynomial
from scipy.optimize import brentq

from analytic import Beam, paper_table, reduced_model
from analytic.beam import BETA_1
from analytic.reduced.lagrangian import energy_coefficients
from analytic.reduced.shapes import (
    CantileverMode,
    converged_degree,
    frequency_equation,
    rotating_frequency,
    rotating_mode,
    static_deflection,
)
from analytic.reduced.symbolic import MU, OMEGA, X
from analytic.reduced.symbolic import symbolic_forms as exact_forms
from analytic.reduced.tables import PRINTED_BETA, closed_form, half_unit
from analytic.shape_functions import blade_functions
from analytic.unit_blade import UNIFORM


def forms(degree):
    return exact_forms(static_deflection(degree), "inextensible")


@pytest.mark.parametrize("number", [1, 2])
def test_every_entry_of_tables_1_and_2_is_exact(number):
    rows = paper_table(number).rows
    assert len(rows) == 8
    assert {row.difference for row in rows} == {"0"}
    assert not any(row.note for row in rows)


def test_table_3_differs_from_the_print_only_in_its_errata():
    rows = {row.quantity: row for row in paper_table(3).rows}
    wrong = {name for name, row in rows.items() if row.difference != "0"}
    assert wrong == {"ω0", "g1", "g2", "λ_ω", "λ_x"}
    assert all(bool(row.note) == (name in wrong) for name, row in rows.items())


def test_table_3_corrected():
    q = sp.Rational
    f = forms(5)
    assert f.omega_0_squared == q(32670, 2641)
    assert f.g1 == q(40633500, 4154293) - q(828367611375, 117150101276) * OMEGA**2
    assert f.g2 == q(55224507425, 48306119004)
    expected = (16545041526500300 * OMEGA**2 - 660934414291675) / (
        11579025031377804 * OMEGA**2 + 61747006780148976
    )
    assert sp.cancel(f.lambda_omega - expected) == 0
    # The print's λ_x is exact, one row too high.
    printed = (15442484235760175 * OMEGA**2 + 23089508813459450) / (
        92632200251022432 * OMEGA**2 + 493976054241191808
    )
    assert sp.cancel(f.lambda_x - printed) == 0


@pytest.mark.parametrize(("degree", "load"), [(3, 0), (4, 1), (5, X)])
def test_shape_is_the_static_deflection_the_paper_names(degree, load):
    phi = forms(degree).phi_v
    fourth = sp.diff(phi, X, 4)
    assert sp.simplify(fourth - load * fourth.subs(X, 1)) == 0
    assert phi.subs(X, 1) == 1
    assert phi.subs(X, 0) == sp.diff(phi, X).subs(X, 0) == sp.diff(phi, X, 2).subs(X, 1) == 0
    shear = sp.diff(phi, X, 3).subs(X, 1)
    assert shear == 0 if degree > 3 else shear < 0


# Each degree and each axial motion but the sine, whose terms Table 4 prints.
@pytest.mark.parametrize(
    ("degree", "axial"), [(3, "static"), (3, "consistent"), (4, "inextensible"), (5, "none")]
)
def test_quadrature_agrees_with_sympy(degree, axial):
    """At a speed and slenderness where every term counts: no term below 1 % of its sum."""
    exact = exact_forms(static_deflection(degree), axial)
    numeric = energy_coefficients(static_deflection(degree), axial)
    speed, mu = 1.3, 0.01
    w_bar = speed * math.sqrt(exact.omega_0_squared)
    values = {OMEGA: sp.Rational(13, 10), MU: sp.Rational(1, 100)}
    expected = [float(e.subs(values).evalf(30)) for e in (exact.omega_n_squared, exact.g1)]
    # Quadrature of 48 points is exact here; round-off of a few hundred operations remains.
    assert [numeric.omega_n_squared(w_bar, mu), numeric.g1(w_bar)] == pytest.approx(
        expected, rel=1e-12
    )
    assert numeric.g2 == pytest.approx(float(exact.g2), rel=1e-12)


@pytest.mark.parametrize(("variant", "degree"), [("P3", 3), ("P4", 4), ("P5", 5)])
def test_reduced_model_is_the_exact_form_at_its_speed(variant, degree):
    beam, f = Beam.reference(), forms(degree)
    model = reduced_model(beam, 4.0, variant)
    # The tables' Ω refers to the shape's own ω0.
    speed = 4.0 / (beam.frequency_scale * math.sqrt(f.omega_0_squared))
    for numeric, exact in (
        (model.w_n**2, f.omega_n_squared),
        (model.lambda_omega, f.lambda_omega),
        (model.lambda_x, f.lambda_x),
    ):
        assert numeric == pytest.approx(float(exact.subs(OMEGA, speed)), rel=1e-11)


CE = energy_coefficients(CantileverMode(), "sine")


def printed_entries():
    return [(tuple(row.quantity.split(": ")), row.printed, row.note) for row in paper_table(4).rows]


@pytest.mark.parametrize(("entry", "printed", "note"), printed_entries())
def test_every_printed_digit_with_the_printed_root(entry, printed, note):
    derived = closed_form(CE, PRINTED_BETA)[entry]
    assert abs(derived - float(printed)) <= half_unit(printed) * (1 + 1e-9)


def test_the_full_root_moves_only_two_last_digits():
    """β to eight powers: in λ's Ω⁴μ terms the rounding of 1.8751 reaches the fifth digit."""
    moved = {entry for entry, _, note in printed_entries() if note}
    assert moved == {("λ_ω ω_n²", "Ω⁴μ"), ("λ_x ω_n²", "Ω⁴μ")}


def test_elongation_by_the_static_solution():
    c = energy_coefficients(CantileverMode(), "static")
    assert c.thinning * BETA_1**4 == pytest.approx(-250.618, abs=5e-4)
    assert c.stretching * BETA_1**8 == pytest.approx(10.5686, abs=5e-5)
    assert c.cubic_spin * BETA_1**4 == pytest.approx(2.86208, abs=5e-6)


@pytest.mark.parametrize("mu", [1e-6, 1e-3, 1e-2])
def test_closed_form_is_the_model_of_a_beam_of_that_slenderness(mu):
    reference = Beam.reference()
    beam = dataclasses.replace(reference, second_moment=mu * reference.area * reference.length**2)
    speed = 1.4
    model = reduced_model(beam, speed * beam.omega_0, "CE")
    terms = {"1": 1.0, "Ω²": speed**2, "Ω²μ": mu * speed**2, "Ω⁴μ": mu * speed**4}
    sums = dict.fromkeys(("ω_n²", "g1", "g2", "λ_ω ω_n²", "λ_x ω_n²"), 0.0)
    for (quantity, monomial), value in closed_form(CE).items():
        if quantity in sums:
            sums[quantity] += value * terms[monomial]
    square = sums["ω_n²"]
    np.testing.assert_allclose(
        [model.w_n**2, model.g1, model.g2, model.lambda_omega, model.lambda_x],
        [square, sums["g1"], sums["g2"], sums["λ_ω ω_n²"] / square, sums["λ_x ω_n²"] / square],
        rtol=1e-11,
    )


def test_print_within_the_rounding_of_its_constants():
    """The print's β = 1.8751 is 2.2e-6 off, (1.8751)² 4.4e-6: times 4 rad/s, and one last digit."""
    bound = {"ω_n": 1.75e-5, "λ_ω": 2.8e-6, "λ_x": 1e-6}
    rows = paper_table(5).rows
    assert [row.note for row in rows].count("") == 2  # of 12
    for row in rows:
        assert abs(float(row.derived) - float(row.printed)) <= bound[row.quantity.split()[0]]


@pytest.mark.parametrize("w_bar", [0.0, 2.0, 10.0, 20.0, 30.0])
def test_power_series_and_legendre_basis_agree(w_bar):
    # Cancellation between the two series grows like exp(w̄/√2) ulps.
    tolerance = 1e-12 + 4e-16 * np.exp(w_bar / np.sqrt(2))
    expected = blade_functions(UNIFORM, 24).first_mode(w_bar).w_n
    assert rotating_mode(w_bar).w_n == pytest.approx(expected, rel=tolerance)


@pytest.mark.parametrize("w_bar", [0.0, 3.0, 9.67])
def test_mode_solves_the_differential_equation(w_bar):
    mode = rotating_mode(w_bar)
    v, x = Polynomial(mode.coefficients), Polynomial([0.0, 1.0])
    tension = 0.5 * w_bar**2 * (1 - x**2)
    residual = v.deriv(4) - (tension * v.deriv()).deriv() - (w_bar**2 + mode.w_n**2) * v
    points = np.linspace(0.0, 1.0, 21)
    # Fourth derivatives of a degree 60 series, against terms of order w̄² · 10.
    assert np.abs(residual(points)).max() < 1e-8 * (10.0 + w_bar**4)
    assert v(0.0) == v.deriv()(0.0) == 0.0
    assert v(1.0) == pytest.approx(1.0, abs=1e-13)
    assert v.deriv(2)(1.0) == pytest.approx(0.0, abs=1e-10)
    assert v.deriv(3)(1.0) == pytest.approx(0.0, abs=1e-8)


def test_degree_36_has_not_converged_at_8_rad_per_s(beam):
    scale = beam.frequency_scale
    w_bar = 8.0 / scale
    converged = rotating_mode(w_bar)
    assert rotating_frequency(w_bar, 36) * scale == pytest.approx(4.124777, abs=5e-7)
    assert converged.w_n * scale == pytest.approx(4.124564, abs=5e-7)
    assert converged.degree > 50
    again = rotating_frequency(w_bar, 2 * converged.degree)
    assert converged.w_n == pytest.approx(again, rel=1e-12)


def test_degree_grows_with_speed():
    degrees = [converged_degree(w_bar) for w_bar in (0.0, 2.0, 5.0, 10.0, 20.0, 30.0)]
    assert degrees == sorted(set(degrees))


def test_equation_81_as_printed_is_wrong(beam, monkeypatch):
    """With the printed numerator the frequency at 2 rad/s is 5.140 rad/s instead of 3.035."""

    def as_printed(r, w_bar, w_n, degree):
        a = np.zeros(degree + 1)
        a[r] = 1.0
        for k in range(r + 2, degree + 1):
            a[k] = 0.5 * w_bar**2 * a[k - 2] / (k * (k - 1))
            if k >= r + 4:
                numerator = w_bar**2 * (k - 3) * (k - 4) - w_n**2
                a[k] -= 0.5 * numerator * a[k - 4] / (k * (k - 1) * (k - 2) * (k - 3))
        return a

    monkeypatch.setattr("analytic.reduced.shapes.frobenius_series", as_printed)
    w_bar = 2.0 / beam.frequency_scale
    w_n = brentq(lambda w: frequency_equation(w_bar, w, 40), 5.0, 8.0)
    assert w_n * beam.frequency_scale == pytest.approx(5.140, abs=5e-4)


def test_speed_beyond_the_series():
    with pytest.raises(ValueError, match=r"up to w_bar = .* = 30, got 31"):
        rotating_mode(31.0)
