"""Each check of a finished run, broken once."""

import numpy as np
import pytest

from rotbeam_exu import SimulationError, simulate
from rotbeam_exu.verdict import judge


@pytest.fixture(scope="module")
def good(beam, spin_up):
    return simulate(beam, spin_up, elements=4, duration=6.0, step=2e-3)


def broken(run, name, change, first=100):
    values = run[name].to_numpy().copy()
    values[first:] = change(values[first:])
    return run.assign({name: ("time", values)})


def test_a_good_run_passes(good):
    assert judge(good) == "passed"
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
        judge(broken(good, name, change))
    assert "take a smaller step than 0.002 s" in str(failure.value)


def test_energy_that_drifts_in_steady_rotation_fails(good):
    leak = np.linspace(0.0, 2.0, good.sizes["time"])
    run = good.assign(jacobi_energy=good["jacobi_energy"] - ("time", leak)[1])
    with pytest.raises(SimulationError, match="drift of the Jacobi energy"):
        judge(run)


def test_a_run_that_stopped_early_fails(good):
    with pytest.raises(SimulationError, match=r"stopped at t = 1.996 s of 6 s"):
        judge(good.isel(time=slice(0, 500)))


@pytest.mark.parametrize("frame", ["inertial", "rotating"])
def test_a_step_too_large_is_not_returned(beam, spin_up, frame):
    with pytest.raises(SimulationError, match="take a smaller step than 0.5 s"):
        simulate(beam, spin_up, step=0.5, frame=frame)


def test_a_beam_too_soft_to_hold_itself_is_not_returned(spin_up):
    from analytic import Beam

    soft = Beam.from_stiffness(
        length=8.0, axial_stiffness=200.0, bending_stiffness=566.0, mass_per_length=0.2
    )
    with pytest.raises(SimulationError, match="axial strain|gave up"):
        simulate(soft, spin_up, elements=4, duration=6.0)
