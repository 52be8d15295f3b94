"""Blades that are refused, and the sentences that say what to try."""

import math

import pytest

from analytic import Blade, Section, reduced_model
from analytic.input_checks import RotbeamWarning
from tests.beams import UNIT

HUB_AND_ALL = UNIT.with_hub_radius(0.5).with_tip_mass(0.3, 0.02).with_taper(0.2, 0.3)


@pytest.mark.parametrize(
    ("make", "sentence"),
    [
        (lambda: UNIT.with_hub_radius(-1.0), "hub_radius must not be negative"),
        (lambda: UNIT.with_tip_mass(-1.0), "mass must not be negative"),
        (lambda: UNIT.with_tip_mass(2000.0), "2e\\+03 times the blade's 1 kg: give it in kg"),
        (lambda: UNIT.with_point_mass(0.1, 1.5), "is beyond the tip at 1 m: take a position from"),
        (lambda: UNIT.with_point_mass(0.1, 0.0), "does not move with the blade: leave it out, it"),
        (lambda: UNIT.with_point_mass(0.1, -0.5), "position must not be negative.*from the clamp"),
        (lambda: UNIT.with_taper(1.0), "axial_stiffness vanishes at x = 1 m"),
        (lambda: UNIT.with_taper(height=1.5), "vanishes at x = 0\\.6"),
        (lambda: reduced_model(HUB_AND_ALL, 1.0, "FrE"), "a hub and point masses and a variable"),
    ],
)  # fmt: skip
def test_bad_blades_are_refused(make, sentence):
    with pytest.raises(ValueError, match=sentence):
        make()


@pytest.mark.parametrize(
    ("profile", "sentence"),
    [
        (((0.0, 1.0), (0.5, 1.0), (0.4, 1.0)), "ascend, but 0.4 m comes after 0.5 m: sort them"),
        (((0.0, 1.0), (0.5, 1.0), (0.5, 2.0), (1.0, 2.0)),
         "two stations of bending_stiffness are at 0.5 m: keep one, or set them apart"),
        (((0.0, 1.0),), "has one station, at 0 m: give two at least, or a number"),
        (((0.0, 1.0), (0.5, math.nan), (1.0, 1.0)), "NaN: leave the station out if its cell is"),
        (((0.0, 1.0), (math.inf, 1.0)), "bending_stiffness\\[1\\] must be finite, got inf m"),
        (((0.0, "1.0"), (1.0, "2.0")), "is the text '1.0': read numbers, as numpy.loadtxt does"),
        ("blade.csv", "bending_stiffness must be a number in N m\\^2, got 'blade.csv'"),
        (((0.0, 1.0, 2.0),), "must be a station \\(x, value\\), got"),
        ((), "is empty: give a number, coefficients or stations"),
        (((0.0, 1.0), (0.5, 1.0)), "run from 0 to 0.5 m: give them from 0 to the length, 1 m"),
        (((-0.1, 1.0), (1.0, 1.0)), "run from -0.1 to 1 m: give them from 0 to the length, 1 m"),
        (((0.0, 1.0), (0.8, 0.0), (1.0, 1.0)), "vanishes at x = 0.8 m, where it is 0: end the"),
        # Between the points of any grid.
        (((0.0, 1.0), (0.123, 1.0), (0.1231, -1.0), (0.1232, 1.0), (1.0, 1.0)), "at x = 0.1231 m"),
        (-1.0, "bending_stiffness must be positive at the clamp, got -1"),
    ],
)  # fmt: skip
def test_bad_profiles_are_refused(profile, sentence):
    with pytest.raises((ValueError, TypeError), match=sentence):
        Blade(
            length=1.0,
            section=Section(axial_stiffness=1.0, mass_per_length=1.0, bending_stiffness=profile),
        )


def test_a_setting_angle_in_degrees_is_warned_of():
    with pytest.warns(RotbeamWarning, match=r"degrees\? 45 degrees are 0.7854 rad"):
        UNIT.with_setting_angle(45.0)


def test_a_stocky_blade_on_a_hub_is_warned_of():
    stocky = Blade(length=1.0, section=Section(
        axial_stiffness=1e5, bending_stiffness=1.0, mass_per_length=1.0))  # fmt: skip
    with pytest.warns(RotbeamWarning, match="FrM is inextensible"):
        reduced_model(stocky.with_hub_radius(5.0), 5.0, "FrM")
