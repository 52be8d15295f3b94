"""The beam's data and scales, against the paper's Sec. 2 and Eq. 40."""

import math

import pytest

from analytic import Beam
from analytic.beam import BETA_1


def test_scales_of_the_paper_beam(beam):
    assert beam.mass == pytest.approx(1.61570664, rel=1e-9)
    assert beam.frequency_scale == pytest.approx(0.827424257935, rel=1e-11)
    assert beam.omega_0 == pytest.approx(2.90923632, rel=2e-9)
    assert beam.slenderness == pytest.approx(1.758374435e-6, rel=1e-9)


def test_beta_is_the_first_root_of_the_cantilever():
    assert math.cos(BETA_1) * math.cosh(BETA_1) == pytest.approx(-1.0, abs=1e-14)


def test_a_beam_given_by_its_stiffness_keeps_it():
    beam = Beam.from_stiffness(
        length=10.0, axial_stiffness=2.8e7, bending_stiffness=1.4e4, mass_per_length=1.2
    )
    assert beam.axial_stiffness == pytest.approx(2.8e7)
    assert beam.bending_stiffness == pytest.approx(1.4e4)
    assert beam.mass == pytest.approx(12.0)
    assert beam.slenderness == pytest.approx(1.4e4 / (2.8e7 * 100.0))


@pytest.mark.parametrize("name", ["length", "area", "second_moment", "youngs_modulus", "density"])
@pytest.mark.parametrize("value", [0.0, -1.0, math.nan, math.inf])
def test_bad_values_are_refused_by_name(name, value):
    good = {"length": 1.0, "area": 1.0, "second_moment": 1.0, "youngs_modulus": 1.0, "density": 1.0}
    with pytest.raises(ValueError, match=rf"^{name} must be .* got {value}"):
        Beam(**{**good, name: value})


@pytest.mark.parametrize("value", ["8", None, True, [8.0]])
def test_what_is_no_number_is_refused(value):
    with pytest.raises(TypeError, match="length must be a number in m"):
        Beam(length=value, area=1.0, second_moment=1.0, youngs_modulus=1.0, density=1.0)
