"""Eq. 1 and its derivatives."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from analytic import SpinUp, SteadyRotation

speeds = st.floats(0.1, 20.0)
times = st.floats(0.1, 20.0)


@given(speeds, times, st.floats(0.0, 3.0))
def test_angle_is_equation_1(omega, ramp_time, share):
    t = share * ramp_time
    printed = (
        omega
        / ramp_time
        * (t**2 / 2 + ramp_time**2 / (4 * math.pi**2) * (math.cos(2 * math.pi * t / ramp_time) - 1))
        if t < ramp_time
        else omega * (t - ramp_time / 2)
    )
    # The print loses digits to 1 - cos; relative to its larger terms it is exact.
    assert SpinUp(omega=omega, ramp_time=ramp_time).angle(t) == pytest.approx(
        printed, abs=1e-14 * omega * (t + ramp_time)
    )


def test_largest_acceleration_is_twice_the_mean():
    """The speed's derivatives and its two ends are tested with the other ramps."""
    spin_up = SpinUp(omega=6.0, ramp_time=3.0)
    assert spin_up.angle(3.0) == pytest.approx(9.0)
    t = np.linspace(0.0, 3.0, 30001)
    assert spin_up.acceleration(t).max() == pytest.approx(2.0 * 6.0 / 3.0)


def test_steady_rotation_is_a_spin_up_long_past():
    steady, spin_up = SteadyRotation(omega=6.0), SpinUp(omega=6.0, ramp_time=3.0)
    t = np.array([4.0, 5.5])
    assert np.allclose(np.diff(steady.angle(t)), np.diff(spin_up.angle(t)))
    assert np.allclose(steady.rate(t), spin_up.rate(t), rtol=1e-15)
    assert np.allclose(steady.acceleration(t), spin_up.acceleration(t), atol=1e-30)


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ({"omega": 6.0, "ramp_time": -2.0}, "ramp_time must be positive, got -2.0 s"),
        ({"omega": 6.0, "ramp_time": 0.0}, "ramp_time must be positive, got 0.0 s"),
        ({"omega": math.nan, "ramp_time": 3.0}, "omega must be finite, got nan rad/s"),
        ({"omega": -6.0, "ramp_time": 3.0}, "omega must not be negative, .* mirror image"),
    ],
)
def test_bad_input_is_one_sentence(arguments, sentence):
    with pytest.raises(ValueError, match=sentence):
        SpinUp(**arguments)
