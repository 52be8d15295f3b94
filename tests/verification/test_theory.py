"""Theories by which codes are judged: on beams, and on blades of which nothing but EI is said."""

from dataclasses import replace

import numpy as np
import pytest

from analytic import Beam, Section, SpinUp, linear_modes
from rotbeam_exu.verification.theory import BERNOULLI_EULER, Theory

SHARE = (5.0 / 6.0) / 2.6
SHEARED = Theory(rotary_inertia=True, shear_share=SHARE)
STUBBY = Beam.from_stiffness(
    length=1.0, axial_stiffness=1e3, bending_stiffness=1.0, mass_per_length=1.0
)


@pytest.mark.parametrize("theory", [BERNOULLI_EULER, Theory(rotary_inertia=True), SHEARED])
def test_the_beam_as_a_blade_is_the_same(theory):
    """Its section is homogeneous: ρI = m EI/EA, which is what the beam has."""
    blade, spin_up = STUBBY.blade, SpinUp(omega=2.0, ramp_time=1.0)
    for answer in (
        lambda one: theory.first_frequency(one, 3.0),
        lambda one: theory.orbits(one, 3.0, [0.2]).frequency,
        lambda one: theory.history(one, spin_up, [0.5, 1.0], tolerance=1e-5).q,
    ):
        assert answer(blade) == pytest.approx(answer(STUBBY), rel=1e-10)


def test_each_has_its_own_frequency():
    thin, heavy, soft = (
        one.first_frequency(STUBBY, 3.0)
        for one in (BERNOULLI_EULER, Theory(rotary_inertia=True), SHEARED)
    )
    assert thin == linear_modes(STUBBY, 3.0, 1).frequencies[0]
    assert soft < heavy < thin
    sheared = linear_modes(STUBBY, 3.0, 1, shear_share=SHARE, rotary_inertia=True)
    assert soft == sheared.frequencies[0]


def test_orbits_and_histories_shear():
    spin_up, times = SpinUp(omega=2.0, ramp_time=1.0), np.linspace(0.0, 2.0, 21)
    thin, soft = (one.history(STUBBY, spin_up, times).q for one in (BERNOULLI_EULER, SHEARED))
    assert 1e-3 < np.abs(soft - thin).max() / np.abs(thin).max() < 1e-1
    orbit = SHEARED.orbits(STUBBY, 3.0, [1e-3])
    assert orbit.frequency[0] == pytest.approx(SHEARED.first_frequency(STUBBY, 3.0), rel=1e-6)


def test_a_taper_has_the_inertia_of_its_own_sections():
    blade = STUBBY.with_taper(0.2, 0.4)
    own = replace(
        blade.section, rotary_inertia=tuple(np.multiply(1e-3, blade.section.bending_stiffness))
    )
    heavy = Theory(rotary_inertia=True).first_frequency(blade, 3.0)
    assert heavy == pytest.approx(
        BERNOULLI_EULER.first_frequency(replace(blade, section=own), 3.0), rel=1e-12
    )
    assert heavy < BERNOULLI_EULER.first_frequency(blade, 3.0)


def test_inertia_that_the_section_says_stays():
    said = Section(
        axial_stiffness=1e3, bending_stiffness=1.0, mass_per_length=1.0, rotary_inertia=0.1
    )
    blade = replace(STUBBY.blade, section=said)
    heavy = Theory(rotary_inertia=True).first_frequency(blade, 3.0)
    assert heavy == BERNOULLI_EULER.first_frequency(blade, 3.0)


def test_a_section_without_one_density_is_refused():
    section = replace(STUBBY.blade.section, mass_per_length=(1.0, -0.5))
    blade = replace(STUBBY.blade, section=section)
    with pytest.raises(ValueError, match="give Section\\(rotary_inertia"):
        SHEARED.first_frequency(blade, 3.0)
    remedied = replace(blade, section=replace(section, rotary_inertia=(1e-3, -5e-4)))
    assert SHEARED.first_frequency(remedied, 3.0) > 0.0
