"""Commands over a grid, of a beam of one's own: the paper's ratios to its ω_0."""

import numpy as np
import pytest

from analytic import Beam
from rotbeam_exu import comparison, explorer, paper
from rotbeam_exu.cli import paper as compare_job
from rotbeam_exu.cli.motion import ChosenMotion, grid_motion
from rotbeam_exu.files.beam_file import load_beam
from rotbeam_exu.sweeps import grid
from tests.beams import REED_TOML


@pytest.fixture
def reed(tmp_path):
    path = tmp_path / "reed.toml"
    path.write_text(REED_TOML)
    return path


def test_the_explorer_of_a_reed_has_its_own_speeds(reached, tmp_path, monkeypatch, reed):
    monkeypatch.chdir(tmp_path)
    (beam,), seen = reached(explorer, "explorer_data", "explore", "--config", reed)
    assert beam == load_beam(reed)
    scale = beam.omega_0 / Beam.reference().omega_0
    # Speeds are rounded to two digits.
    assert seen["omegas"] == pytest.approx(0.25 * scale * np.arange(49), rel=0.05)
    assert np.ptp(np.diff(seen["omegas"])) < 1e-9 * seen["omegas"][1]
    # The slider stops where finite elements are: between its stops none would be seen.
    assert seen["finite_element_omegas"] == [seen["omegas"][i] for i in (8, 16, 24, 32)]
    assert seen["step"] * scale <= 1e-3 * (1.0 + 1e-9)
    assert seen["duration"] * scale == pytest.approx(15.0, rel=0.05)


def test_compare_and_sweep_take_the_beam_of_the_file(reached, tmp_path, reed):
    command = ("--config", reed, "--out", tmp_path)
    (beam,), seen = reached(comparison, "figure_14", "compare", *command)
    assert beam == load_beam(reed)
    assert len(seen["omegas"]) == len(paper.SPEEDS)
    steps = seen["duration"] / seen["step"]
    # Twice the step fits as well.
    assert steps / 2 == pytest.approx(round(steps / 2), rel=1e-9)
    _, seen = reached(grid, "sweep", "sweep", *command)
    # ω_0 is 1050.4 rad/s, 361.06 times the paper's.
    assert seen["omegas"] == [720.0, 1400.0, 2200.0, 2900.0]
    assert seen["ramp_times"][0] == pytest.approx(3.375 / 361.06, rel=1e-3)
    assert (seen["duration"], seen["step"]) == (pytest.approx(0.042), 2e-6)


def test_of_the_papers_beam_nothing_changes():
    motion = grid_motion(Beam.reference(), paper.SPEEDS, paper.RAMP_TIMES)
    assert (motion.duration, motion.step) == (15.0, 1e-3)
    assert compare_job._even(motion) == motion
    odd = ChosenMotion(spin_up=motion.spin_up, duration=1.5, step=0.1)
    assert round(1.5 / compare_job._even(odd).step) == 16
