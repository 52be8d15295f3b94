"""Tables 1-3: the polynomial shapes, in exact rationals."""

import math

import pytest
import sympy as sp

from analytic import Beam, paper_table, reduced_model
from analytic.reduced.lagrangian import energy_coefficients
from analytic.reduced.shapes import static_deflection
from analytic.reduced.symbolic import MU, OMEGA, X
from analytic.reduced.symbolic import symbolic_forms as exact_forms


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
