"""Derivatives of orbits: laws of similarity, and orbits that are solved anew."""

import numpy as np
import pytest

from analytic import (
    Beam,
    Damping,
    Gravity,
    Theory,
    TipForce,
    forced_response,
    linear_modes,
    periodic_orbits,
)
from analytic.sensitivity import parameters_of, sensitivity
from tests.beams import unit_beam

STRIP = unit_beam(1e-3).with_section_out_of_plane(0.25, 0.2).with_twist(0.4)


def test_similarity_at_rest():
    """All stiffness times k, or all mass over k: ω times √k, and the softening stays."""
    orbits = periodic_orbits(Beam.reference(), 0.0, [0.1, 0.4])
    found = sensitivity(orbits, ["EA", "EI3", "m"])
    assert found.outputs[::2] == ("frequency at a = 0.1", "softening at a = 0.1")
    stiff = found.relative[:, 0] + found.relative[:, 1]
    for relative, sign in ((stiff, 1.0), (found.relative[:, 2], -1.0)):
        np.testing.assert_allclose(relative[:2], sign * 0.5, rtol=1e-7)
        np.testing.assert_allclose(relative[2:], 0.0, atol=1e-4)


@pytest.mark.parametrize(
    ("blade", "omega", "mode", "name"),
    [
        (Beam.reference().with_hub_radius(0.5), 6.0, "lag 1", "hub_radius"),
        (Beam.reference().with_tip_mass(0.05), 6.0, "lag 1", "point_mass[0]"),
        (STRIP, 2.0, "lag 1", "EI2"),
        (STRIP.with_precone(0.05).with_hub_radius(0.2), 2.0, "flap 1", "precone"),
    ],
)
def test_against_orbits_solved_anew(blade, omega, mode, name):
    """Frequencies to 1e-7; the softening over a² has what ω_n's derivative leaves."""
    amplitude = 0.1
    orbits = periodic_orbits(blade, omega, [amplitude], mode=mode)
    (found,) = sensitivity(orbits, [name]).derivatives.T
    parameter = parameters_of(blade, Theory())[name]
    change = 1e-3 * parameter.size
    ahead, behind = (
        periodic_orbits(parameter.changed(parameter.value + step), omega, [amplitude], mode=mode)
        for step in (change, -change)
    )
    size = parameter.size / orbits.frequency
    expected = (ahead.frequency - behind.frequency) / (2.0 * change)
    np.testing.assert_allclose(found[:1] * size, expected * size, rtol=3e-6, atol=1e-6)
    soft = [(1.0 - one.frequency / one.omega_n) / amplitude**2 for one in (behind, ahead)]
    expected = np.diff(soft, axis=0)[0] / (2.0 * change)
    np.testing.assert_allclose(
        found[1:] * parameter.size, expected * parameter.size, atol=5e-6 / amplitude**2
    )


def test_the_hub_decides_the_softening_of_the_papers_beam():
    """As the page says: 11 % by a hundredth of the length, 0.5 % by a hundredth of EI."""
    found = sensitivity(periodic_orbits(Beam.reference(), 6.0, [0.1]), ["hub_radius", "EI3"])
    hub, stiff = 0.01 * found.derivatives[1] * [8.0, 1.0] / found.values[1]
    assert hub == pytest.approx(0.11, abs=0.005)
    assert stiff == pytest.approx(-0.005, abs=5e-4)


def test_names_of_orbits():
    orbits = periodic_orbits(Beam.reference(), 6.0, [0.1])
    found = sensitivity(orbits, ["m"])
    assert found.units == ("rad/s", "1")
    assert found.values[0] == orbits.frequency[0]
    assert found.values[1] == pytest.approx(orbits.lambda_omega, rel=0.05)
    with pytest.raises(ValueError, match=r"there is no 'tip x': known are frequency at a = 0\.1"):
        found.of("tip x", "m")


def pushed(blade):
    frequencies = [3.4, 3.7, 4.4]
    return forced_response(blade, 6.0, TipForce(amplitude=0.5), frequencies, harmonics=6)


def weighed(blade):
    return forced_response(blade, [4.5, 5.0, 5.5], Gravity(), harmonics=6)


@pytest.mark.parametrize(("respond", "count"), [(pushed, 4), (weighed, 3)])
def test_peaks_against_responses_that_are_solved_anew(respond, count):
    """Where asked for, and at resonance, where the frequency of the peak does not matter."""
    damping = Damping(external=0.1, bending=1e-3)
    blade = Beam.reference().with_hub_radius(0.3).with_damping(damping)
    found = sensitivity(respond(blade), ["EI3", "m", "hub_radius"])
    assert len(found.outputs) == count
    for parameter, slopes in zip(found.parameters, found.derivatives.T, strict=True):
        change = 3e-4 * parameter.size
        ahead, behind = (
            sensitivity(respond(parameter.changed(parameter.value + step)), []).values
            for step in (change, -change)
        )
        size = parameter.size
        expected = (ahead - behind) / (2.0 * change)
        np.testing.assert_allclose(size * slopes, size * expected, rtol=3e-6, atol=5e-6)


STIRRED = STRIP.with_damping(Damping(bending=0.05, torsion=0.05, out_of_plane=0.05, external=0.1))


def test_peaks_in_space_against_responses_that_are_solved_anew():
    """Their damping is that of the other blade: of strains it goes with the stiffness."""

    def peaks(blade, omega=2.0, size=0.05):
        load = TipForce(amplitude=size)
        return forced_response(blade, omega, load, [2.0, 2.1], harmonics=4)

    found = sensitivity(peaks(STIRRED), ["EI3", "m", "omega", "loads[0]"])
    for parameter, slopes in zip(found.parameters, found.derivatives.T, strict=True):
        change = 1e-3 * parameter.size
        several = []
        for value in (parameter.value + change, parameter.value - change):
            given = {"omega": (STIRRED, value), "loads[0]": (STIRRED, 2.0, 0.05 * value)}
            anew = given.get(parameter.name) or (parameter.changed(value),)
            several.append(sensitivity(peaks(*anew), []).values)
        expected = (several[0] - several[1]) / (2.0 * change)
        assert np.abs(expected).max() > 0.0
        size = parameter.size
        np.testing.assert_allclose(size * slopes, size * expected, rtol=1e-5, atol=5e-6)


def test_speed_and_load():
    """Of orbits the speed; of responses to gravity, whose speed is given, its size."""
    orbits = periodic_orbits(Beam.reference(), 6.0, [0.3])
    ahead, behind = (periodic_orbits(Beam.reference(), w, [0.3]) for w in (6.01, 5.99))
    found = sensitivity(orbits, ["omega"])
    slope = (ahead.frequency - behind.frequency) / 0.02
    np.testing.assert_allclose(found.derivatives[0], slope, rtol=1e-5)
    weight = sensitivity(weighed(Beam.reference().with_damping(Damping(external=0.1))))
    assert weight.names[-1] == "loads[0]"
    assert "omega" not in weight.names


@pytest.mark.parametrize("name", ["damping_external", "damping_bending"])
def test_a_peak_goes_with_one_over_the_damping(name):
    """Of a small load, at resonance; free vibration does not depend on it."""
    damping = {name.removeprefix("damping_"): 0.02}
    blade = Beam.reference().with_damping(Damping(**damping))
    response = forced_response(blade, 6.0, TipForce(amplitude=1e-3), [3.6, 3.9], harmonics=4)
    found = sensitivity(response, [name])
    assert "peak" in response.marks
    row = int(np.argmax(found.values))
    assert found.relative[row, 0] == pytest.approx(-1.0, abs=2e-3)
    still = sensitivity(linear_modes(blade, 6.0, 2), [name])
    assert (still.derivatives == 0.0).all()
