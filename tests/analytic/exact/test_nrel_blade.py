"""NREL's 5 MW blade in space: its report, OpenFAST's linearization, and finite elements."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from analytic import Blade, Theory, linear_modes, steady_state
from rotbeam_exu.files.beam_file import load_beam

FILE = Path(__file__).parents[3] / "models" / "blades" / "nrel_5mw.toml"
RATED = 12.1 * np.pi / 30.0
MORE_MASS = 1.05315  # by which the file's mass is more than the table's
BEAM = Theory(trapeze=False)  # as the other codes have it

# pyBModes 1.19.1, 16 elements between any two stations [Hz], without cone, which it leaves out.
# Beams of Euler and Bernoulli: the mass of the table, no offset, rigid in torsion and extension.
SLENDER = {
    0.0: [0.692898, 1.110801, 1.998157, 4.098960, 4.657939, 8.257752],
    RATED: [0.743573, 1.119347, 2.056212, 4.120977, 4.711207, 8.311844],
}
# All of the file but the rotary inertia of bending, which it leaves out, about the pitch axis.
WHOLE = {
    0.0: [0.674806, 1.082395, 1.945265, 3.993392, 4.504375, 5.453490, 8.002128],
    RATED: [0.726784, 1.091165, 2.004629, 4.016051, 4.555126, 5.459761, 8.055336],
}


@pytest.fixture(scope="module")
def nrel():
    return load_beam(FILE)


def hertz(blade, omega, count):
    return linear_modes(blade, omega, count, theory=BEAM).frequencies / (2.0 * np.pi)


def changed(blade, stiffness=1.0, mass=1.0):
    """The blade without cone, entries of its matrices multiplied."""
    section = blade.section
    other = Blade.from_stations(
        section.x, np.array(section.stiffness) * stiffness, np.array(section.mass) * mass
    )
    line = replace(blade.line, precone=0.0)
    return replace(blade, section=other.section, line=line)


def test_it_weighs_what_the_report_says(nrel):
    """NREL/TP-500-38060, Table 2-2: 17 740 kg, 363 231 kg m and 11 776 047 kg m² about the root."""
    x, mass = np.array(nrel.section.mass_per_length).T
    at = np.linspace(0.0, nrel.length, 100_001)
    moments = [np.trapezoid(np.interp(at, x, mass) * at**k, at) for k in range(3)]
    assert nrel.mass == pytest.approx(17_740.0, rel=1e-5)
    assert moments[0] == pytest.approx(nrel.mass, rel=1e-6)
    # The report has sums over elements.
    assert moments[1:] == pytest.approx([363_231.0, 11_776_047.0], rel=3e-3)


@pytest.mark.parametrize("omega", SLENDER)
def test_a_slender_blade_has_the_frequencies_of_finite_elements(nrel, omega):
    """Twist, flap and lag alone, and the centrifugal force."""
    soft, heavy = np.ones((6, 6)), np.zeros((6, 6))
    soft[0, 0], soft[3, 3] = 1e3, 1e3
    heavy[np.arange(3), np.arange(3)] = 1.0 / MORE_MASS
    heavy[np.arange(3, 6), np.arange(3, 6)] = 1e-5
    found = hertz(changed(nrel, soft, heavy), omega, 6)
    # Elements of constant sections come from below, by 3e-6 of the first: eight have 13e-6 less.
    assert found == pytest.approx(SLENDER[omega], rel=7e-6)


@pytest.mark.parametrize("omega", WHOLE)
def test_flap_lag_and_torsion_are_those_of_finite_elements(nrel, omega):
    found = hertz(changed(nrel), omega, 7)
    # Rotary inertia of bending lowers the fourth, of lag, by 3e-3, the most of all.
    assert found == pytest.approx(WHOLE[omega], rel=4e-3)
    assert np.all(found < WHOLE[omega])


def test_without_rotary_inertia_of_bending_it_is_theirs(nrel):
    """At rest: in rotation the propeller moment needs that inertia."""
    mass = np.array(nrel.section.mass)
    mass[:, 4, 4] = 0.0
    mass[:, 5, 5] = mass[:, 0, 5] ** 2 / mass[:, 0, 0]  # of the offset
    # Inertia about the pitch axis is linear there.
    blade = Blade.from_stations(
        nrel.section.x, nrel.section.stiffness, mass, interpolation="matrix"
    )
    found = hertz(replace(blade, line=nrel.line), 0.0, 7)
    flaps = [0, 2]
    assert found[flaps] == pytest.approx(np.array(WHOLE[0.0])[flaps], rel=5e-6)
    # Offsets have rotary inertia in lag, too. Their torsion is 6e-4 high: linear elements of a rod
    # with this GJ and j1, without twist and offset, come to ours, 5.43338 Hz, not to 5.43685.
    assert found == pytest.approx(WHOLE[0.0], rel=7e-4)


def test_it_is_near_the_published_frequencies(nrel):
    # OpenFAST 3.5.1, ElastoDyn, the blade alone at rest: 0.672, 1.079 and 1.981 Hz. It has two
    # shapes of flap and one of lag, which is little for the second flap.
    stiffness = [[17.98, -1.349, -5.581], [-0.08621, 47.51, -14.64], [-3.410, -11.53, 153.2]]
    elastodyn = np.sqrt(np.sort(np.linalg.eigvals(stiffness).real)) / (2.0 * np.pi)
    at_rest = hertz(nrel, 0.0, 3)
    assert at_rest[:2] == pytest.approx(elastodyn[:2], rel=0.006)
    assert at_rest[2] == pytest.approx(elastodyn[2], rel=0.02)
    # The report's Table 9-1, by FAST, a rotor at rest with flexible shaft and tower: the first
    # asymmetric flap and lag of pitch; those of yaw are 0.6664 and 1.0898 Hz.
    assert at_rest[:2] == pytest.approx([0.6675, 1.0793], rel=0.012)
    # pyBModes' table of reference turbines at 12.1 rpm, with the mass of the table: its 20 elements
    # have 0.734 Hz, its many 0.744 Hz.
    lighter = changed(nrel, mass=1.0 / MORE_MASS)
    assert hertz(lighter, RATED, 3) == pytest.approx([0.734, 1.108, 2.018], rel=0.02)


def test_the_trapeze_effect_raises_torsion_in_rotation(nrel):
    """By 0.6 %, as the page on real blades says."""
    with_it, without = (
        linear_modes(nrel, RATED, 6, theory=Theory(trapeze=trapeze)).frequencies[5]
        for trapeze in (True, False)
    )
    assert 0.0055 < with_it / without - 1.0 < 0.0065


def test_the_cone_is_pulled_flat(nrel):
    tip = steady_state(nrel, RATED).tip
    coned = steady_state(nrel, 1e-3).tip
    assert coned == pytest.approx([61.5, 0.0, 0.0], abs=1e-5)
    # Upwind, along -3; the twist takes some of it along.
    assert 0.3 < tip[2] < 0.33
    assert tip[1] == pytest.approx(0.045, abs=0.002)
