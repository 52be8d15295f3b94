"""Bad input to the Python interface: one sentence each, before anything is computed."""

import math
import re

import pytest

from analytic import Beam, linear_modes
from analytic.input_checks import RotbeamWarning
from rotbeam_exu import natural_frequencies, simulate


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        ({"elements": 0}, "elements must be at least 1, got 0"),
        ({"step": 0.0}, "step must be positive, got 0.0 s"),
        ({"step": math.nan}, "step must be finite, got nan s"),
        ({"step": 7e-4}, r"whole number of steps of 0.0007 s; try a step of 0\.000699986\d+ s"),
        ({"step": 0.1}, r"leaves 16\.8 steps in a period .* 1\.684 s: take 0\.0842 s or less"),
        ({"step": 0.2}, "ramp_time 3 s holds 15 steps of 0.2 s, .* take a step of 0.15 s or less"),
        ({"step": 0.2, "frame": "rotating"}, "ramp_time 3 s holds 15 steps of 0.2 s"),
        ({"duration": -1.0}, "duration must be positive"),
        ({"duration": 2.0}, "duration 2 s ends before the steady rotation"),
        ({"element": "cabel"}, "unknown element 'cabel'; known are 'cable', 'exact'"),
        ({"frame": "lab"}, "unknown frame 'lab'; known are 'inertial' and 'rotating'"),
    ],
)
def test_simulate_refuses(beam, spin_up, options, sentence):
    with pytest.raises(ValueError, match=sentence):
        simulate(beam, spin_up, **options)


def test_half_an_element_is_refused(beam, spin_up):
    with pytest.raises(TypeError, match=r"elements must be a whole number, got 1\.5"):
        simulate(beam, spin_up, elements=1.5)


def test_natural_frequencies_refuse(beam):
    with pytest.raises(ValueError, match="omega must not be negative"):
        natural_frequencies(beam, -1.0)
    with pytest.raises(ValueError, match="count = 9 is more than the 5 modes"):
        natural_frequencies(beam, 1.0, elements=1, count=9)


def test_a_speed_in_rpm_is_noticed(beam):
    with pytest.warns(RotbeamWarning, match="40 rad/s is 14 times .* rpm"):
        natural_frequencies(beam, 40.0, elements=32)


def test_a_mesh_too_coarse_for_the_boundary_layer_is_noticed(beam, recwarn):
    """At w̄ = 60 sixteen elements are 2.3 % off; what the warning asks for is within 1e-3."""
    omega = 60.0 * beam.frequency_scale
    exact = linear_modes(beam, omega, 1).frequencies[0]
    off = natural_frequencies(beam, omega, elements=16)[0] / exact - 1.0
    sentence = next(str(w.message) for w in recwarn if "clamp" in str(w.message))
    assert off > 0.02
    asked = int(re.search(r"take (\d+) elements", sentence)[1])
    recwarn.clear()
    better = natural_frequencies(beam, omega, elements=asked)[0] / exact - 1.0
    assert abs(better) < 1e-3
    assert not any("clamp" in str(w.message) for w in recwarn)


def test_a_beam_too_stiff_for_double_precision_is_refused(beam, spin_up):
    stiff = Beam.from_stiffness(
        length=8.0, axial_stiffness=1e14, bending_stiffness=566.0, mass_per_length=0.2
    )
    with pytest.raises(ValueError, match=r"below 1e-11, .* lower the axial .* below 8\.84e\+11 N"):
        simulate(stiff, spin_up)
    with pytest.raises(ValueError, match="below 1e-11"):
        natural_frequencies(stiff, 6.0)
    softer = Beam.from_stiffness(
        length=8.0, axial_stiffness=8.8e11, bending_stiffness=566.0, mass_per_length=0.2
    )
    exact = linear_modes(softer, 6.0, 1).frequencies[0]
    # Sixteen cables; round-off adds 1e-6.
    assert natural_frequencies(softer, 6.0, count=1)[0] == pytest.approx(exact, rel=5e-5)
