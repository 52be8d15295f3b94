"""Speed, ramp, duration and step of a beam of one's own: the paper's, scaled by ω_0."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from analytic import Beam
from rotbeam_exu.cli.motion import chosen_motion, chosen_times
from tests.beams import REED


def test_the_paper_s_beam_keeps_the_paper_s_motion():
    motion = chosen_motion(Beam.reference())
    assert (motion.spin_up.omega, motion.spin_up.ramp_time) == (6.0, 3.0)
    assert (motion.duration, motion.step) == (15.0, 1e-3)
    assert chosen_times(Beam.reference(), 3.375, digits=4) == [3.375]


@pytest.mark.filterwarnings("ignore:youngs_modulus = .* in GPa:analytic.RotbeamWarning")
@given(scale=st.floats(1e-6, 1e6), ramp=st.none() | st.floats(1e-3, 1e3))
def test_ratios_to_omega_0_are_the_paper_s(scale, ramp):
    paper = Beam.reference()
    # E times s² makes every frequency s times as high.
    beam = Beam(
        length=8.0, area=paper.area, second_moment=paper.second_moment,
        youngs_modulus=paper.youngs_modulus * scale**2, density=paper.density,
    )  # fmt: skip
    motion = chosen_motion(beam, ramp_time=None if ramp is None else ramp / scale)
    # Two digits round by 5 % at most.
    assert motion.spin_up.omega == pytest.approx(6.0 * scale, rel=0.05)
    assert motion.step * scale <= 1e-3 * (1.0 + 1e-9)
    assert motion.spin_up.ramp_time >= 20 * motion.step
    steps = motion.duration / motion.step
    assert steps == pytest.approx(round(steps), rel=1e-10)
    assert motion.duration - motion.spin_up.ramp_time > 4.9 * 2.0 * math.pi / beam.omega_0
    if ramp is None:
        assert motion.duration == pytest.approx(15.0 / scale, rel=0.05)
        assert motion.step * scale > 0.39e-3


def test_what_is_given_is_kept_and_the_rest_fitted_to_it():
    by_duration = chosen_motion(REED, duration=0.01234567)
    assert by_duration.duration == 0.01234567
    assert by_duration.duration / by_duration.step == pytest.approx(
        round(by_duration.duration / by_duration.step), rel=1e-12
    )
    by_step = chosen_motion(REED, step=7e-7)
    assert by_step.step == 7e-7
    assert by_step.duration / 7e-7 == pytest.approx(round(by_step.duration / 7e-7), rel=1e-12)
    assert chosen_motion(Beam.reference(), ramp_time=14.0).duration >= 14.0 + 5 * 2.15


@pytest.mark.parametrize("name", ["ramp_time", "duration", "step"])
@pytest.mark.parametrize("value", [math.nan, math.inf, -1.0, 0.0])
def test_bad_times_are_refused_by_name(name, value):
    with pytest.raises(ValueError, match=name):
        chosen_motion(Beam.reference(), **{name: value})
