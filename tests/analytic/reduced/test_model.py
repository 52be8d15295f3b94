"""Refusals and warnings of the reduced models; test_remedies follows the advice."""

import math
import warnings

import numpy as np
import pytest

from analytic import VARIANTS, Beam, Variant, paper_table, reduced_model
from analytic.input_checks import RotbeamWarning
from analytic.reduced.model_range import warn_if_resonant
from analytic.reduced.shapes import static_deflection

BEAM = Beam.reference()
MODEL = reduced_model(BEAM, 4.0)


@pytest.mark.parametrize(
    ("call", "sentence"),
    [
        (
            lambda: reduced_model(BEAM, 4.0, "FRE"),
            f"variant must be one of {', '.join(VARIANTS)}, got 'FRE'",
        ),
        (lambda: reduced_model(BEAM, -1.0), "omega must .*-1.0"),
        (lambda: reduced_model(BEAM, math.nan), "omega must .*nan"),
        (lambda: reduced_model(BEAM, math.inf), "omega must .*inf"),
        (lambda: reduced_model(BEAM, "4"), "omega must be a number in rad/s, got '4'"),
        (lambda: MODEL.frequency([0.1, math.nan, 0.1]), "finite, got nan"),
        (
            lambda: reduced_model(BEAM, 6.0, "FrI").exact_frequency(0.99),
            "Eq. 41 has no periodic orbit at amplitude 0.99 .*: keep it below 0.98721",
        ),
        (lambda: MODEL.response([0.0, math.nan], 0.1), "t must be finite"),
        (lambda: MODEL.response(0.0, 0.1, phase=math.nan), "phase must be finite"),
        (
            lambda: Variant(name="x", shape="cantilever", axial="cosine"),
            "axial must be one of .*, got 'cosine'",
        ),
        (lambda: Variant(name="x", shape="pinned", axial="sine"), "shape must be"),
        (
            lambda: Variant(name="x", shape="cantilever", axial="sine", coriolis=True),
            "about the rotating mode",
        ),
        (lambda: paper_table(0), "(table|number) must be"),
        (lambda: paper_table(6), "(table|number) must be"),
        (lambda: static_deflection(6), "3, 4 or 5, got 6"),
    ],
)
def test_bad_input(call, sentence):
    with pytest.raises((TypeError, ValueError), match=sentence):
        call()


@pytest.mark.parametrize("method", ["frequency", "exact_frequency"])
@pytest.mark.parametrize(
    ("amplitude", "sentence"),
    [
        (-0.1, "amplitude must not be negative, got -0.1"),
        (1.5, r"at most 1, got 1.5: meters\?"),
        (math.nan, "must be finite, got nan"),
        (math.inf, "must be finite, got inf"),
    ],
)
def test_amplitude(method, amplitude, sentence):
    with pytest.raises(ValueError, match=sentence):
        getattr(MODEL, method)(amplitude)


@pytest.mark.parametrize("value", ["0.1", True, [0.1, None], 1j])
def test_amplitude_is_a_number(value):
    with pytest.raises(TypeError, match="amplitude must be numbers"):
        MODEL.frequency(value)


def test_a_warning_points_at_its_caller_and_ends_where_the_model_is_right(beam):
    for call, sentence in (
        (lambda: MODEL.frequency([0.1, 0.3]), r"amplitude 0\.3 is above 0\.2, the paper's own"),
        (lambda: reduced_model(beam, 4.0, "FrM5").frequency(0.5), r"0\.5 is above 0\.4, .* a⁶"),
        (lambda: reduced_model(beam, 10.0, "FrE"), r"2\.22 times .*29\.62 rad/s.*take FrM"),
    ):
        with pytest.warns(RotbeamWarning, match=sentence) as caught:
            call()
        assert caught[0].filename == __file__
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        MODEL.frequency(0.2)
        reduced_model(beam, 10.0, "FrM")
        reduced_model(beam, 24.0, "FrM")
        for variant in VARIANTS:
            reduced_model(beam, 8.0, variant)


def test_resonance_with_another_mode_warns():
    with pytest.warns(RotbeamWarning, match=r"2ω_n = 6 rad/s is 5\.0% from another mode at 6\.3"):
        warn_if_resonant(3.0, np.array([6.3, 20.0]))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        warn_if_resonant(3.0, np.array([7.0, 20.0]))


def test_a_model_introduces_itself(beam):
    text = repr(reduced_model(beam, 6.0, "FrE"))
    for part in ("FrE", "Ω = 2.062", "ω_n = 3.730549 rad/s", "g1 =", "g2 =", "0.0235487", "λ_x ="):
        assert part in text
