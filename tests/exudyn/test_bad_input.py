"""Bad input to the Python interface: one sentence each, before anything is computed."""

import math

import pytest

from analytic.input_checks import RotbeamWarning
from rotbeam_exu import natural_frequencies, simulate


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        ({"elements": 0}, "elements must be at least 1, got 0"),
        ({"step": 0.0}, "step must be positive, got 0.0 s"),
        ({"step": math.nan}, "step must be finite, got nan s"),
        ({"step": 7e-4}, "not a whole number of steps of 0.0007 s; try a step of 0.000699986 s"),
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
        natural_frequencies(beam, 40.0)
