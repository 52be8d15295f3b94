"""Each check of a finished run, broken once."""

import math
import re

import numpy as np
import pytest

from analytic import Beam, SpinUp
from rotbeam_exu import SimulationError, simulate
from rotbeam_exu.runs.check import check_run


@pytest.fixture(scope="module")
def good(beam, spin_up):
    return simulate(beam, spin_up, elements=4, duration=6.0, step=2e-3)


def broken(run, name, change, first=50):
    values = run[name].to_numpy().copy()
    values[first:] = change(values[first:])
    return run.assign({name: ("time", values)})


def test_a_good_run_passes(good):
    assert check_run(good) == "passed"
    assert good.attrs["verdict"] == "passed"


@pytest.mark.parametrize(
    ("name", "change", "sentence"),
    [
        ("q", lambda v: v * np.nan, "q is not finite at t = 0.4 s"),
        ("tip_x", lambda v: v + 9.0, "tip's distance .* at t = 0.4 s, above 1.05"),
        ("axial_strain", lambda v: v + 0.06, "axial strain reaches 0.06 at t = 0.4 s"),
        ("clamp_residual", lambda v: v + 1e-6, "clamp's position error"),
        ("direction_residual", lambda v: v - 1e-6, "root's direction error"),
    ],
)
def test_a_broken_run_names_time_number_and_remedy(good, name, change, sentence):
    with pytest.raises(SimulationError, match=sentence) as failure:
        check_run(broken(good, name, change))
    assert "take a smaller step than 0.002 s" in str(failure.value)


def test_a_run_that_stopped_early_fails(good):
    with pytest.raises(SimulationError, match=r"stopped at t = 1.992 s of 6 s"):
        check_run(good.isel(time=slice(0, 250)))


@pytest.mark.slow
def test_a_beam_that_breaks_into_waves_is_told_what_helps(beam):
    """A ramp of 1 s swings it to 0.93 L: no step cures that, a longer ramp or a shorter run do."""
    wild = SpinUp(omega=6.0, ramp_time=1.0)
    for step in (5e-4, 1e-3):
        with pytest.raises(SimulationError, match="drift of the steady Jacobi energy") as failure:
            simulate(beam, wild, step=step)
        assert "take a longer ramp_time, or a duration below" in str(failure.value)
    before = math.floor(float(re.search(r"below ([\d.]+) s", str(failure.value))[1]))
    assert simulate(beam, wild, duration=before).attrs["verdict"] == "passed"
    assert simulate(beam, SpinUp(omega=6.0, ramp_time=2.0)).attrs["verdict"] == "passed"


def test_a_beam_too_soft_to_hold_itself_is_not_returned(spin_up):
    soft = Beam.from_stiffness(
        length=8.0, axial_stiffness=200.0, bending_stiffness=566.0, mass_per_length=0.2
    )
    with pytest.raises(SimulationError, match="axial strain .* lower omega below") as failure:
        simulate(soft, spin_up, elements=4, duration=6.0)
    slower = float(re.search(r"below ([\d.]+) rad/s, or raise", str(failure.value))[1])
    run = simulate(soft, SpinUp(omega=slower, ramp_time=3.0), elements=4, duration=6.0)
    assert run.attrs["verdict"] == "passed"
