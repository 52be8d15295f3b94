"""Where the reduced models' want of extension shows: stocky beams, and above the burst speed."""

import warnings

import pytest

from analytic import VARIANTS, periodic_orbits, reduced_model
from analytic.input_checks import RotbeamWarning
from analytic.reduced.model_range import softening_speed
from tests.beams import unit_beam


def test_a_stocky_beam_is_named_with_the_two_numbers():
    with pytest.warns(
        RotbeamWarning, match=r"μ = .* = 0\.001: its λ_ω .* than FrM's -0\.0174 .* = 4\.0e-03"
    ) as caught:
        model = reduced_model(unit_beam(1e-3), 1.0, "FrM")
    assert caught[0].filename == __file__
    exact = periodic_orbits(unit_beam(1e-3), 1.0, [0.05])
    # What the warning says is what is missing: 4μ, and μw̄² of ω_n, both to a tenth.
    assert exact.lambda_omega - model.lambda_omega == pytest.approx(4e-3, rel=0.1)
    assert 1.0 - exact.omega_n / model.omega_n == pytest.approx(1e-3, rel=0.15)


def test_fast_rotation_of_a_beam_that_is_slender_enough_at_rest():
    with pytest.warns(RotbeamWarning, match=r"lower by about μ w_bar² = 8\.0e-03 of it"):
        reduced_model(unit_beam(2e-5), 20.0, "FrM")


@pytest.mark.parametrize("variant", ["CI", "CE", "P4", "FrI", "FrC", "FrM"])
def test_above_the_burst_speed_every_model_says_so(variant):
    beam = unit_beam(1e-2)
    with pytest.warns(RotbeamWarning, match=r"is above 15\.708 rad/s, at which .* without bound"):
        reduced_model(beam, 15.8, variant)


def test_the_papers_beam_gets_no_warning(beam):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for omega in (0.0, 8.0):
            for variant in VARIANTS:
                reduced_model(beam, omega, variant)
        reduced_model(beam, 24.0, "FrM")


def test_softening_speed_of_the_extensible_beam(beam):
    # Extensible, λ_ω vanishes earlier; 2.97214 rad/s, Ω = 1.02162, to the last digit.
    for omega, sign in ((2.97213, -1.0), (2.97215, 1.0)):
        assert sign * periodic_orbits(beam, omega, [0.05]).lambda_omega > 0.0
    with pytest.raises(ValueError, match="variant must be one of"):
        softening_speed(beam, "Fr")
