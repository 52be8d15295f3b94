"""Table 4: the cantilever mode with the elongation by the sine, as a function of Ω and μ."""

import dataclasses

import numpy as np
import pytest

from analytic import Beam, paper_table, reduced_model
from analytic.beam import BETA_1
from analytic.reduced.lagrangian import energy_coefficients
from analytic.reduced.shapes import CantileverMode
from analytic.reduced.tables import PRINTED_BETA, closed_form, half_unit

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
