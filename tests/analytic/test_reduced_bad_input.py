"""What the reduced models refuse, and where they warn."""

import math
import warnings

import numpy as np
import pytest

from analytic import VARIANTS, Variant, paper_table, reduced_model
from analytic.input_checks import RotbeamWarning
from analytic.reduced.model_range import warn_if_resonant
from analytic.reduced.shapes import static_deflection


def test_unknown_variant_lists_the_known_ones(beam):
    with pytest.raises(ValueError, match="CI, CE, FrI, FrE, P3, P4, P5, FrC, FrM, FrM5, got 'FRE'"):
        reduced_model(beam, 4.0, "FRE")


@pytest.mark.parametrize("omega", [-1.0, math.nan, math.inf])
def test_rotation_speed(beam, omega):
    with pytest.raises(ValueError, match=f"omega must .*{omega}"):
        reduced_model(beam, omega)


def test_rotation_speed_is_a_number(beam):
    with pytest.raises(TypeError, match="omega must be a number in rad/s, got '4'"):
        reduced_model(beam, "4")


@pytest.mark.parametrize("method", ["frequency", "exact_frequency", "orbit"])
@pytest.mark.parametrize(
    ("amplitude", "sentence"),
    [
        (-0.1, "amplitude must not be negative, got -0.1|a0 must not be negative, got -0.1"),
        (1.5, r"at most 1, got 1.5: meters\?"),
        (math.nan, "must be finite, got nan"),
        (math.inf, "must be finite, got inf"),
    ],
)
def test_amplitude(beam, method, amplitude, sentence):
    with pytest.raises(ValueError, match=sentence):
        getattr(reduced_model(beam, 4.0), method)(amplitude)


def test_one_bad_amplitude_among_many(beam):
    with pytest.raises(ValueError, match="finite, got nan"):
        reduced_model(beam, 4.0).frequency([0.1, math.nan, 0.1])


@pytest.mark.parametrize("value", ["0.1", True, [0.1, None], 1j])
def test_amplitude_is_a_number(beam, value):
    with pytest.raises(TypeError, match="amplitude must be numbers"):
        reduced_model(beam, 4.0).frequency(value)


def test_no_periodic_orbit_names_the_largest_amplitude(beam):
    model = reduced_model(beam, 6.0, "FrI")
    with pytest.raises(ValueError, match=r"Eq. 41 has no periodic orbit .* below 0\.98721"):
        model.exact_frequency(0.99)
    with pytest.raises(ValueError, match=r"Eq. 41 has no periodic orbit"):
        model.orbit(0.99)
    with pytest.warns(RotbeamWarning):
        assert model.exact_frequency(0.999 * model.largest_amplitude) > 0


def test_no_frequency_of_equation_63_names_the_largest_amplitude(beam):
    with pytest.warns(RotbeamWarning, match="FrI leaves out"):
        model = reduced_model(beam, 11.0, "FrI")
    largest = 1 / math.sqrt(model.lambda_omega)
    with pytest.raises(ValueError, match=f"Eq. 63 has no frequency .* below {largest:.6g}"):
        model.frequency([0.1, 0.999])


def test_response_arguments(beam):
    model = reduced_model(beam, 4.0)
    with pytest.raises(ValueError, match="t must be finite"):
        model.response([0.0, math.nan], 0.1)
    with pytest.raises(ValueError, match="phase must be finite"):
        model.response(0.0, 0.1, phase=math.nan)
    with pytest.raises(ValueError, match="n must be at least 2"):
        model.orbit(0.1, n=1)


def test_large_amplitude_warns_with_the_papers_bound(beam):
    model = reduced_model(beam, 4.0)
    with pytest.warns(RotbeamWarning, match=r"amplitude 0\.3 is above 0\.2") as caught:
        model.frequency([0.1, 0.3])
    assert caught[0].filename == __file__
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        model.frequency(0.2)


def test_fast_rotation_warns_where_the_next_mode_matters(beam):
    with pytest.warns(RotbeamWarning, match=r"2\.22 times .*29\.62 rad/s.*take FrM") as caught:
        reduced_model(beam, 10.0, "FrE")
    assert caught[0].filename == __file__
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for variant in VARIANTS:
            reduced_model(beam, 8.0, variant)
        reduced_model(beam, 10.0, "FrM")


def test_revolutions_per_minute_warn(beam):
    with pytest.warns(RotbeamWarning) as caught:
        reduced_model(beam, 60.0, "CI")
    assert "rpm?" in str(caught[0].message)


def test_resonance_with_another_mode_warns():
    with pytest.warns(RotbeamWarning, match=r"2ω_n = 6 rad/s is 5\.0% from another mode at 6\.3"):
        warn_if_resonant(3.0, np.array([6.3, 20.0]))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        warn_if_resonant(3.0, np.array([7.0, 20.0]))


def test_settings_of_a_variant():
    with pytest.raises(ValueError, match="axial must be one of none, inextensible"):
        Variant(name="x", shape="cantilever", axial="cosine")
    with pytest.raises(ValueError, match="shape must be"):
        Variant(name="x", shape="pinned", axial="sine")
    with pytest.raises(ValueError, match="about the rotating mode"):
        Variant(name="x", shape="cantilever", axial="sine", coriolis=True)


@pytest.mark.parametrize("number", [0, 6])
def test_tables_are_five(number):
    with pytest.raises(ValueError, match=r"(table|number) must be"):
        paper_table(number)


def test_degrees_of_static_deflections():
    with pytest.raises(ValueError, match="3, 4 or 5, got 6"):
        static_deflection(6)


def test_a_model_introduces_itself(beam):
    text = repr(reduced_model(beam, 6.0, "FrE"))
    for part in ("FrE", "Ω = 2.062", "ω_n = 3.730549 rad/s", "g1 =", "g2 =", "0.0235487", "λ_x ="):
        assert part in text
