"""Every remedy that the command line prints is followed: the complaint is gone, or another."""

import re

import pytest

from rotbeam_exu.fem import simulation

QUICK = {"--elements": "2", "--step": "0.01", "--duration": "8"}


def run(call, tmp_path, *more, **options):
    arguments = {**QUICK, **{f"--{k.replace('_', '-')}": str(v) for k, v in options.items()}}
    flat = [text for pair in arguments.items() for text in pair]
    return call("run", "--no-figure", "--out", tmp_path / "out", "--force", *flat, *more)


def test_a_step_that_does_not_fit_names_one_that_does(call, tmp_path):
    code, _, error = run(call, tmp_path, step=0.011)
    assert code == 2
    step, duration = re.search(r"try a step of (\S+) s or a duration of (\S+) s", error).groups()
    assert run(call, tmp_path, "--no-exact", step=step)[0] == 0
    assert run(call, tmp_path, "--no-exact", step=0.011, duration=duration)[0] == 0


def test_the_warnings_of_mesh_and_step_end_with_more_elements_and_smaller_steps(call, tmp_path):
    coarse = run(call, tmp_path, elements=4)[2]
    assert "take more elements than 4" in coarse
    assert "take a smaller step than 0.01 s" in coarse
    # In the rotating frame the step's error is 14 times smaller: 2 ms do.
    fine = run(call, tmp_path, elements=16, step=0.002, frame="rotating")
    assert fine[0] == 0
    assert fine[2] == ""


def test_a_folder_that_cannot_be_written_is_exchanged_for_another(call, tmp_path, monkeypatch):
    (tmp_path / "taken").write_text("a file")
    short = ("run", "--elements", "1", "--step", "0.01", "--duration", "8", "--out")
    with monkeypatch.context() as patch:
        patch.setattr(simulation, "run_case", lambda *_, **__: pytest.fail("computed first"))
        code, _, error = call(*short, tmp_path / "taken")
    assert code != 0
    assert "taken: File exists; choose another" in error
    assert call(*short, tmp_path / "free", "--no-figure", "--no-exact")[0] == 0
