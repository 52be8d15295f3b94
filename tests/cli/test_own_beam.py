"""`rotbeam compare` and `rotbeam explore` of a beam of one's own: the paper's ratios to its ω_0."""

import numpy as np
import pytest

from analytic import Beam
from rotbeam_exu import comparison, explorer, paper
from rotbeam_exu.cli import paper as compare_job
from rotbeam_exu.cli.motion import ChosenMotion, grid_motion
from rotbeam_exu.files.beam_file import load_beam
from tests.beams import BLADE_TOML, REED_TOML


class StoppedError(Exception):
    pass


@pytest.fixture
def reed(tmp_path):
    path = tmp_path / "reed.toml"
    path.write_text(REED_TOML)
    return path


def test_the_explorer_of_a_reed_has_its_own_speeds(call, tmp_path, monkeypatch, reed):
    seen = {}
    monkeypatch.setattr(explorer, "explorer_data", lambda beam, **o: seen.update(o, beam=beam))
    monkeypatch.setattr(explorer, "explorer_page", lambda _: "")
    monkeypatch.chdir(tmp_path)
    code, out, _ = call("explore", "--config", reed)
    assert code == 0
    assert "explorer-reed.html" in out
    beam, scale = load_beam(reed), load_beam(reed).omega_0 / Beam.reference().omega_0
    assert seen["beam"] == beam
    # Speeds are rounded to two digits.
    assert seen["omegas"] == pytest.approx(0.25 * scale * np.arange(49), rel=0.05)
    assert np.ptp(np.diff(seen["omegas"])) < 1e-9 * seen["omegas"][1]
    # The slider stops where finite elements are: between its stops none would be seen.
    assert seen["finite_element_omegas"] == [seen["omegas"][i] for i in (8, 16, 24, 32)]
    assert seen["step"] * scale <= 1e-3 * (1.0 + 1e-9)
    assert seen["duration"] * scale == pytest.approx(15.0, rel=0.05)
    assert call("explore")[0] == 0
    assert seen["beam"] == Beam.reference()


def test_compare_takes_the_beam_of_the_file_to_every_part(call, tmp_path, monkeypatch, reed):
    seen = {}

    def stopped(beam, **options):
        seen.update(options, beam=beam)
        raise StoppedError

    monkeypatch.setattr(comparison, "figure_14", stopped)
    with pytest.raises(StoppedError):
        call("compare", "--config", reed, "--out", tmp_path)
    beam = load_beam(reed)
    assert seen["beam"] == beam
    assert len(seen["omegas"]) == len(paper.SPEEDS)
    steps = seen["duration"] / seen["step"]
    # Twice the step fits as well.
    assert steps / 2 == pytest.approx(round(steps / 2), rel=1e-9)


def test_compare_is_of_uniform_beams(call, tmp_path):
    blade = tmp_path / "blade.toml"
    blade.write_text(BLADE_TOML)
    code, _, error = call("compare", "--config", blade, "--out", tmp_path)
    assert code == 2
    assert "for a [blade] take rotbeam backbone --variant FrM --exact" in error
    remedy = ("--variant", "FrM", "--exact", "--omega", "6", "--amplitude", "0.1")
    assert call("backbone", "--config", blade, *remedy)[0] == 0


def test_of_the_papers_beam_nothing_changes():
    motion = grid_motion(Beam.reference(), paper.SPEEDS, paper.RAMP_TIMES)
    assert (motion.duration, motion.step) == (15.0, 1e-3)
    assert compare_job._even(motion) == motion
    odd = ChosenMotion(spin_up=motion.spin_up, duration=1.5, step=0.1)
    assert round(1.5 / compare_job._even(odd).step) == 16


def test_figures_are_of_the_paper_and_say_so(call, reed):
    code, _, error = call("figure", "8", "--config", reed)
    assert code == 2
    assert "Unknown option: --config" in error
    assert "Figures show the paper's beam" in " ".join(call("figure", "--help")[1].split())
