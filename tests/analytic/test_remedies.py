"""What the sentences advise is done: the complaint is gone then, or it is another."""

import math
import re
import warnings

import pytest

from analytic import (
    AmplitudeNotReachedError,
    Beam,
    SpinUp,
    Theory,
    linear_modes,
    periodic_orbits,
    reduced_model,
    spin_up_response,
)
from analytic.input_checks import RotbeamWarning
from analytic.methods.continuation import Care
from analytic.reduced.model_range import softening_speed
from tests.beams import unit_beam


def complaint(function, *arguments, **options):
    """The sentence of an error, or of the last warning."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            function(*arguments, **options)
        except (ValueError, RuntimeError, TypeError) as error:
            return str(error)
    return str(caught[-1].message) if caught else ""


@pytest.mark.filterwarnings("ignore::analytic.input_checks.RotbeamWarning")
def test_beyond_the_power_series_of_the_rotating_mode_frm_goes_on():
    beam = unit_beam(1e-8)
    said = complaint(reduced_model, beam, 31.0, "FrE")
    assert said.endswith("lower omega, or take FrM")
    assert reduced_model(beam, 31.0, "FrM").lambda_omega > 0.0
    assert reduced_model(beam, 29.0, "FrE").lambda_omega > 0.0  # lower omega


@pytest.mark.filterwarnings("ignore::analytic.input_checks.RotbeamWarning")
def test_a_mode_that_no_number_of_functions_settles():
    beam = unit_beam(1e-10)
    assert "differ by" in complaint(reduced_model, beam, 3e3, "FrM")
    assert reduced_model(beam, 1e3, "FrM").perturbation.h3 > 0.0  # rotate slower


def test_a_stocky_beam_is_named_with_the_two_numbers():
    with pytest.warns(
        RotbeamWarning, match=r"μ = .* = 0\.001: its λ_ω .* than FrM's -0\.0174 .* = 4\.0e-03"
    ) as caught:
        model = reduced_model(unit_beam(1e-3), 1.0, "FrM")
    assert caught[0].filename == __file__
    exact = periodic_orbits(unit_beam(1e-3), 1.0, [0.05])
    # The warning's numbers are those that are missing: 4μ, and μw̄² of ω_n, both to a tenth.
    assert exact.lambda_omega - model.lambda_omega == pytest.approx(4e-3, rel=0.1)
    assert 1.0 - exact.omega_n / model.omega_n == pytest.approx(1e-3, rel=0.15)


def test_fast_rotation_of_a_beam_that_is_slender_enough_at_rest():
    with pytest.warns(RotbeamWarning, match=r"lower by about μ w_bar² = 8\.0e-03 of it"):
        reduced_model(unit_beam(2e-5), 20.0, "FrM")


def test_softening_speed_of_the_extensible_beam(beam):
    # Extensible, λ_ω vanishes earlier; 2.97214 rad/s, Ω = 1.02162, to the last digit.
    for omega, sign in ((2.97213, -1.0), (2.97215, 1.0)):
        assert sign * periodic_orbits(beam, omega, [0.05]).lambda_omega > 0.0
    with pytest.raises(ValueError, match="variant must be one of"):
        softening_speed(beam, "Fr")


def test_burst(beam):
    for variant in ("CI", "CE", "P4", "FrI", "FrC", "FrM"):
        assert complaint(reduced_model, unit_beam(1e-2), 16.0, variant).endswith("rotate slower")
        assert "without bound" not in complaint(reduced_model, unit_beam(1e-2), 15.0, variant)
    said = complaint(linear_modes, beam, 1000.0)
    assert "rotate slower or raise the axial stiffness" in said
    assert "without bound" not in complaint(linear_modes, beam, 100.0)
    stiff = Beam.from_stiffness(
        length=beam.length,
        axial_stiffness=100.0 * beam.axial_stiffness,
        bending_stiffness=beam.bending_stiffness,
        mass_per_length=beam.mass_per_length,
    )
    assert "without bound" not in complaint(linear_modes, stiff, 1000.0)


def test_rpm(beam):
    said = complaint(linear_modes, beam, 60.0)
    assert "60 rad/s is 21 times" in said
    omega = float(re.search(r"60 rpm are ([0-9.]+) rad/s", said)[1])
    assert complaint(linear_modes, beam, omega) == ""


@pytest.mark.filterwarnings("ignore::analytic.input_checks.RotbeamWarning")
@pytest.mark.parametrize("method", ["frequency", "exact_frequency"])
def test_largest_amplitude(beam, method):
    model = reduced_model(beam, 11.0, "FrI")
    said = complaint(getattr(model, method), 0.9999)
    largest = float(re.search(r"keep it below ([0-9.]+)", said)[1])
    assert getattr(model, method)(largest * (1.0 - 1e-5)) > 0.0


def test_functions_and_modes(beam):
    functions = int(
        re.search(r"ask for functions=(\d+)", complaint(linear_modes, beam, 1.0, 12))[1]
    )
    assert complaint(linear_modes, beam, 1.0, 12, functions=functions) == ""
    assert complaint(linear_modes, beam, 1.0, functions=257).endswith("ask for less")
    assert complaint(linear_modes, beam, 1.0, functions=100) == ""


def test_unsettled_frequencies(monkeypatch):
    monkeypatch.setattr("analytic.exact.continuum.planar.Continuum.most_functions", 60)
    beam = unit_beam(1e-12)
    options = {"count": 1, "theory": Theory(extension=False), "functions": 40}
    assert complaint(linear_modes, beam, 2e3, **options).endswith("rotate slower")
    assert "differ" not in complaint(linear_modes, beam, 2e2, **options)


def test_amplitude_not_reached(beam, monkeypatch):
    monkeypatch.setattr("analytic.exact.free.path.THOROUGH", Care(harmonics=12))
    with pytest.raises(AmplitudeNotReachedError, match="; ask for smaller amplitudes$") as caught:
        periodic_orbits(beam, 6.0, [0.1, 0.6])
    assert caught.value.part.amplitude.tolist() == [0.1]
    reached = float(re.search(r"last amplitude reached is ([0-9.]+)", str(caught.value))[1])
    assert complaint(periodic_orbits, beam, 6.0, [0.99 * reached]) == ""


def test_orbit_too_small(beam):
    assert "take linear_modes" in complaint(periodic_orbits, beam, 6.0, [1e-14])
    assert complaint(linear_modes, beam, 6.0) == ""


def test_orbits_too_fast(beam, monkeypatch):
    monkeypatch.setattr("analytic.exact.free.path.MOST_FUNCTIONS", 16)
    assert complaint(periodic_orbits, beam, 80.0, [0.05]).endswith("rotate slower")
    assert complaint(periodic_orbits, beam, 8.0, [0.05]) == ""


def test_spin_up_tolerance(beam, monkeypatch):
    monkeypatch.setattr("analytic.exact.driven.spin_up._REFINEMENTS", 2)
    jerk, times = SpinUp(omega=2.0, ramp_time=0.3), [0.5]
    said = complaint(spin_up_response, beam, jerk, times, tolerance=1e-10)
    tolerance = float(re.search(r"take tolerance=([0-9.e+-]+) or a longer ramp", said)[1])
    assert complaint(spin_up_response, beam, jerk, times, tolerance=tolerance) == ""
    assert "at least 1e-11" in complaint(spin_up_response, beam, jerk, times, tolerance=1e-13)


def test_spin_up_before_anything_moves(beam):
    spin_up = SpinUp(omega=6.0, ramp_time=3.0)
    said = complaint(spin_up_response, beam, spin_up, [1e-4])
    assert said.endswith("ask for later times as well")
    assert complaint(spin_up_response, beam, spin_up, [1e-4, 0.5], tolerance=1e-6) == ""


def test_spin_up_ramp_too_short(beam):
    said = complaint(spin_up_response, beam, SpinUp(omega=6.0, ramp_time=1e-300), [0.1])
    assert said.endswith("take a longer ramp")
    ramp = SpinUp(omega=6.0, ramp_time=0.5)
    assert complaint(spin_up_response, beam, ramp, [0.1], tolerance=1e-4) == ""


def test_a_negative_amplitude_is_a_phase(beam):
    model = reduced_model(beam, 4.0)
    assert "the phase, not the sign" in complaint(model.frequency, -0.1)
    start = model.response(0.0, 0.1)
    assert model.response(0.0, 0.1, phase=math.pi) == pytest.approx(-start)
