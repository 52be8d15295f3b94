"""Measured numbers from CSV files."""

import math

import pytest

from analytic import PointLoad, SpinUp
from analytic.sensitivity import MeasuredFrequency, MeasuredMotion, MeasuredState
from rotbeam_exu.files.measured_file import measured_of


def read(tmp_path, text):
    path = tmp_path / "measured.csv"
    path.write_text(text, encoding="utf-8")
    return measured_of(path)


def test_frequencies_with_their_units(tmp_path):
    text = "mode,omega [rpm],frequency [Hz],deviation [%]\nlag 1,60,0.5,1\n2,0,3,2\n"
    first, second = read(tmp_path, text)
    assert first == MeasuredFrequency(
        mode="lag 1", omega=math.tau, value=math.pi, deviation=0.01 * math.pi
    )
    assert (second.mode, second.omega) == (2, 0.0)
    (bare,) = read(tmp_path, "frequency [rad/s],mode\n3.5, flap 1 \n")
    assert bare == MeasuredFrequency(mode="flap 1", value=3.5)


def test_pulls(tmp_path):
    one, other = read(tmp_path, "x [m],fz [kN],deflection_z [mm]\n4,0.5,31\n8,0,0\n")
    load = PointLoad(force=(0.0, 0.0, 500.0), position=4.0)
    assert one == MeasuredState(output="deflection z", value=0.031, loads=[load])
    assert other.loads == ()
    (moment,) = read(tmp_path, "omega [rad/s],root_moment_y [kN m]\n2,-3\n")
    assert (moment.output, moment.value, moment.omega) == ("root moment y", -3000.0, 2.0)


def test_a_motion(tmp_path):
    """The deviation is a part of the largest value, for a motion goes through zero."""
    first, second = read(
        tmp_path,
        "time [ms],tip_y [mm],omega [rpm],ramp_time [s],deviation [%]\n"
        "0,0,60,3,1\n500,-40,60,3,1\n",
    )
    motion = SpinUp(omega=math.tau, ramp_time=3.0)
    assert second == MeasuredMotion(
        output="tip y", time=0.5, value=-0.04, spin_up=motion, deviation=4e-4
    )
    assert (first.value, first.deviation) == (0.0, 4e-4)


MOVING = "time [s],omega [rpm],ramp_time [s],deviation [%],"


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("time [s],tip_y [m]\n1,2\n", "lacks omega, ramp_time, deviation, which a spin-up needs"),
        (MOVING + "deflection_y [m]\n1,3,3,1,2\n", "output must be one of tip x"),
        (MOVING + "tip_y [m],fz [N]\n1,3,3,1,2,1\n", "has fz, which tip_y does not use"),
        (MOVING + "mode,frequency [Hz]\n1,3,3,1,lag 1,2\n", "which frequency does not use"),
        (MOVING + "tip_y [m]\n-1,3,3,1,2\n", "time must not be negative"),
        (MOVING + "tip_y [m]\n1,3,0,1,2\n", "ramp_time must be positive"),
        (MOVING + "tip_y [m]\n1,3,3,1,0\n", "deviation must be positive"),
        (MOVING + "tip_y [m]\n1,3,3,nan,1\n", "'nan' in column deviation, which is no number"),
        ("mode,omega [rpm]\nlag 1,3\n", "has 0 columns of what was measured: give one of frequen"),
        ("mode,frequency [Hz],tip_z [m]\nlag 1,3,1\n", "has 2 columns of what was measured"),
        ("frequency [Hz]\n3\n", "lacks the column mode, as lag 1 or its number"),
        ("mode,frequency [Hz],fz [N]\nlag 1,3,1\n", "has fz, which frequency does not use"),
        ("mode,tip_z [m]\nlag 1,3\n", "has mode, which tip_z does not use: take it out"),
        ("mode,frequency\nlag 1,3\n", "give the unit of column 'frequency', as frequency"),
        ("mode [m],frequency [Hz]\nlag 1,3\n", "give the unit of column"),
        ("mode,frequency [Hz]\nlag 1,nan\n", "'nan' in column frequency, which is no number"),
        ("mode,frequency [Hz]\nlag 1,True\n", "'True' in column frequency, which is no number"),
        ("mode,frequency [Hz]\nlag 1,-3\n", "value must be positive"),
        ("mode,frequency [Hz],deviation [%]\nlag 1,3,0\n", "deviation must be positive"),
        ("mode,frequency [Hz]\nlag 1,3,4\n", "has 3 cells, the header 2"),
        ("mode,frequency [Hz]\n", "has a header and no rows"),
        ("mode,height [m]\nlag 1,3\n", "unknown column 'height'"),
        ("1,2\n3,4\n", "begins with no title of a known column"),
        ("mode,frequency [Hz]\n0,3\n", "mode must be at least 1"),
    ],
)
def test_what_is_no_measurement_is_refused(tmp_path, text, sentence):
    with pytest.raises(ValueError, match=sentence.replace("[", r"\[")):
        read(tmp_path, text)


def test_a_file_that_is_not_there(tmp_path):
    with pytest.raises(FileNotFoundError, match="there is no file"):
        measured_of(tmp_path / "none.csv")
