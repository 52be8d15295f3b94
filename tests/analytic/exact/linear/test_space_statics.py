"""The blade in space under dead loads at its tip: published numbers and closed forms."""

import math

import numpy as np
import pytest

from analytic import Beam, Blade, Theory, steady_state
from tests.beams import unit_beam

SHEARED = Theory(shear=True, trapeze=False)
RIGID = Theory(extension=False, trapeze=False)
MASS = np.diag([1.0, 1.0, 1.0, 2e-4, 1e-4, 1e-4])
ROUND = unit_beam(1e-4).with_section_out_of_plane(1.0, 1.0)


def bar(length, stiffness):
    return Blade.from_stations([0.0, length], [stiffness, stiffness], [MASS, MASS])


def test_the_composite_beam_of_beamdyn():
    """Wang et al. (2017), to the digits that two other codes print."""
    stiffness = 1e3 * np.diag([1368.17, 88.56, 38.78, 16.96, 59.12, 141.47])
    for i, j, value in ((3, 4, 17.61), (3, 5, -0.351), (4, 5, -0.370)):
        stiffness[i, j] = stiffness[j, i] = 1e3 * value
    state = steady_state(bar(10.0, stiffness), 0.0, force=(0.0, 0.0, 150.0), theory=SHEARED)
    known = [-0.0902726627566, -0.0647488486259, 1.2297364829237]
    assert state.tip - [10.0, 0.0, 0.0] == pytest.approx(known, abs=1e-13)  # half the last digit


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_the_bend_of_45_degrees(side):
    """Bathe and Bolourchi (1979) -23.5 -13.4 53.4; the digits are another code's."""
    beam = Beam.from_stiffness(
        length=25.0 * math.pi,
        axial_stiffness=1e7,
        bending_stiffness=1e7 / 12.0,
        mass_per_length=1.0,
    )
    blade = beam.with_section_out_of_plane(1.0, 1.0).with_sweep(0.01 * side)
    theory = Theory(shear=0.5, trapeze=False)
    unloaded = steady_state(blade, 0.0, theory=theory).tip
    arc = 100.0 * np.array([math.sin(0.25 * math.pi), side * (1.0 - math.cos(0.25 * math.pi)), 0.0])
    assert unloaded == pytest.approx(arc, abs=1e-11)
    state = steady_state(blade, 0.0, force=(0.0, 0.0, 600.0), theory=theory)
    known = [-23.5602395, -13.6045213 * side, 53.4748588]
    assert state.tip - unloaded == pytest.approx(known, abs=1e-7)  # the last digit
    assert state.error < 1e-10


def test_the_princeton_beam():
    """Bauchau et al. (2016): 8.896 N at 45° from the chord; the digits are another code's."""
    stiffness = np.diag([2.842e6, 0.6401e6, 0.9039e6, 3.103, 2.429, 36.28])
    force = 8.896 * math.sqrt(0.5) * np.array([0.0, 1.0, 1.0])
    state = steady_state(bar(0.508, stiffness), 0.0, force=force, theory=SHEARED)
    known = [-0.01438644, 0.00889000, 0.10903069]
    assert state.tip - [0.508, 0.0, 0.0] == pytest.approx(known, abs=6e-9)  # half the last digit


@pytest.mark.parametrize("about", [(0.0, 0.0, 1.0), (0.0, 0.6, 0.8)])
@pytest.mark.parametrize("turns", [0.25, 2.0])
def test_a_moment_rolls_a_bar_up(beam, about, turns):
    """To a circle of curvature M/EI, through any angle, and about any axis across the bar."""
    angle = 2.0 * math.pi * turns
    bent = angle * beam.bending_stiffness / beam.length
    round_ = beam.with_section_out_of_plane(1.0, 1.0)
    state = steady_state(round_, 0.0, moment=bent * np.array(about), theory=RIGID)
    across = np.cross(about, [1.0, 0.0, 0.0])
    known = np.array([math.sin(angle), 0.0, 0.0]) + (1.0 - math.cos(angle)) * across
    assert state.tip == pytest.approx(known * beam.length / angle, abs=1e-11)


def test_a_column_is_followed_to_where_it_buckles():
    """Euler's load π²EI/4L²: refused beyond it, at 1/1.005 of the load."""
    critical = 0.25 * math.pi**2
    straight = steady_state(ROUND, 0.0, force=(-0.99 * critical, 0.0, 0.0), theory=RIGID)
    assert straight.tip == pytest.approx([1.0, 0.0, 0.0], abs=1e-12)
    with pytest.raises(ValueError, match=r"at 0\.995\d* of the load.* load it less"):
        steady_state(ROUND, 0.0, force=(-1.005 * critical, 0.0, 0.0), theory=RIGID)


def test_a_twisted_column_leans_to_the_side_to_which_it_is_pushed():
    """Far beyond buckling it would stand on the other side too; followed from rest it does not."""
    strip = ROUND.with_section_out_of_plane(1.0 / 16.0, 0.08).with_twist(1.0)
    state = steady_state(strip, 0.0, force=(-1.0, 0.0, 0.02), theory=RIGID)
    assert state.tip[2] > 0.5
