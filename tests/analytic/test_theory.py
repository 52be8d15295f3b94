"""The theory of the beam: extension, shear, rotary inertia, of beams and of blades."""

from dataclasses import replace

import numpy as np
import pytest

from analytic import Section, SpinUp, linear_modes, spin_up_response
from analytic.theory import BERNOULLI_EULER, Theory
from tests.beams import SHARE, unit_beam

SHEARED = Theory(rotary_inertia=True, shear=SHARE)
STUBBY = unit_beam(1e-3)


def first_frequency(blade, theory):
    return linear_modes(blade, 3.0, 1, theory=theory).frequencies[0]


def test_a_taper_has_the_inertia_of_its_own_sections():
    blade = STUBBY.with_taper(0.2, 0.4)
    own = replace(
        blade.section, rotary_inertia=tuple(np.multiply(1e-3, blade.section.bending_stiffness))
    )
    heavy = first_frequency(blade, Theory(rotary_inertia=True))
    assert heavy == pytest.approx(
        first_frequency(replace(blade, section=own), BERNOULLI_EULER), rel=1e-12
    )
    assert heavy < first_frequency(blade, BERNOULLI_EULER)


def test_inertia_that_the_section_says_stays():
    said = Section(
        axial_stiffness=1e3, bending_stiffness=1.0, mass_per_length=1.0, rotary_inertia=0.1
    )
    blade = replace(STUBBY.blade, section=said)
    heavy = first_frequency(blade, Theory(rotary_inertia=True))
    assert heavy == first_frequency(blade, BERNOULLI_EULER)


def test_a_section_without_one_density_is_refused():
    section = replace(STUBBY.blade.section, mass_per_length=(1.0, -0.5))
    blade = replace(STUBBY.blade, section=section)
    with pytest.raises(ValueError, match="give Section\\(rotary_inertia"):
        first_frequency(blade, SHEARED)
    remedied = replace(blade, section=replace(section, rotary_inertia=(1e-3, -5e-4)))
    assert first_frequency(remedied, SHEARED) > 0.0


def test_the_spin_up_without_extension_is_the_limit_of_slender_beams():
    """The axial motion leaves q by the slenderness μ, to first order."""
    spin_up, times = SpinUp(omega=2.0, ramp_time=1.0), np.linspace(0.0, 2.0, 21)
    limit = spin_up_response(
        STUBBY, spin_up, times, tolerance=1e-6, theory=Theory(extension=False)
    ).q
    apart = [
        np.abs(spin_up_response(beam, spin_up, times, tolerance=1e-6).q - limit).max()
        for beam in (unit_beam(1e-3), unit_beam(1e-4))
    ]
    assert 8.0 < apart[0] / apart[1] < 12.0
