"""Changes of the speed in Exudyn: against the exact transient, in both frames, through files."""

import numpy as np
import pytest

from analytic import FourierRamp, SpeedTable, spin_up_response
from rotbeam_exu import load, save, simulate
from rotbeam_exu.runs.attributes import motion_of

DOWN = FourierRamp(start=6.0, omega=1.0, ramp_time=2.0, cosines=(-1.2, 0.2), sines=(0.2, -0.1))
TABLE = SpeedTable([0.0, 1.0, 2.0, 3.0], [2.0, 3.0, 5.0, 6.0])


@pytest.mark.parametrize(
    ("motion", "frame"),
    [
        (DOWN, "inertial"),
        (TABLE, "rotating"),
        pytest.param(DOWN, "rotating", marks=pytest.mark.slow),
        pytest.param(TABLE, "inertial", marks=pytest.mark.slow),
    ],
)
def test_against_the_exact_transient(beam, motion, frame):
    run = simulate(beam, motion, duration=4.0, step=2e-3, frame=frame)
    exact = spin_up_response(beam, motion, run["time"].to_numpy(), tolerance=1e-6)
    # 16 cubic elements at 2 ms; the exact beam swings to 0.1 of its length and more.
    assert run["q"].to_numpy() == pytest.approx(exact.q, abs=2e-4 * beam.length)
    assert np.abs(exact.q).max() > 0.1 * beam.length
    # It starts stretched, hence without axial waves.
    first, second = run["axial_strain"].to_numpy()[:2]
    assert first == pytest.approx(second, rel=1e-2)


def test_so_does_the_file_of_a_run(beam, tmp_path):
    run = simulate(beam, TABLE, elements=2, duration=3.5, step=5e-3)
    assert motion_of(load(save(run, tmp_path / "run.nc")).attrs) == TABLE
