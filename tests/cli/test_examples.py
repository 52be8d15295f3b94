"""Every example that --help prints is read, and run if slow tests are asked for.

What takes minutes in it is replaced.
"""

import shlex
import shutil

import numpy as np
import pytest
import xarray as xr

from rotbeam_exu import explorer
from rotbeam_exu.cli import _COMMANDS, app, documented
from rotbeam_exu.sweeps import grid
from rotbeam_exu.verification import verify as room
from rotbeam_exu.verification.judgement import Judgement
from rotbeam_exu.verification.submission import Declaration
from tests.beams import BEAM_TOML

EXAMPLES = [example for command in _COMMANDS for example in documented(command)[1]]
BEAM = (
    f"{BEAM_TOML}[motion]\nomega = 6\nramp_time = 3\n"
    "[numerics]\nelements = 2\nstep = 0.01\nduration = 8\n"
)


def measured_at_once(cases, *_):
    """As `solved` yields it, of spin-ups that nobody computed."""
    for point in cases:
        result = xr.Dataset({"q": ("time", np.zeros(2))}, {"time": [0.0, 1.0]})
        numbers = dict.fromkeys(grid.MEASURED, 1e-3) | {
            "amplitude": 0.1, "frequency": 3.73, "omega_n": 3.73,
        }  # fmt: skip
        yield point, result.assign_attrs(numbers, verdict="passed", failure="")


@pytest.fixture
def folder(tmp_path, monkeypatch, call):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "beam.toml").write_text(BEAM)
    monkeypatch.setattr(grid, "solved", measured_at_once)
    monkeypatch.setattr(explorer, "explorer_data", lambda *_, **__: None)
    monkeypatch.setattr(explorer, "explorer_page", lambda _: "<title>Rotating beam explorer")
    monkeypatch.setattr(
        room,
        "verify",
        lambda entry, **_: Judgement(
            declaration=Declaration(code=entry.name),
            findings={},
            histories={},
            sources={},
            remarks={},
            asked=(),
        ),
    )
    return tmp_path


def test_every_command_has_examples_that_fit_into_eighty_columns():
    assert all(documented(command)[1] for command in _COMMANDS)
    assert all(example.startswith("rotbeam ") for example in EXAMPLES)
    assert max(map(len, EXAMPLES)) <= 80


@pytest.mark.parametrize("example", EXAMPLES)
def test_an_example_is_read(example):
    command, *arguments = shlex.split(example)[1:]
    function, bound, _ = app.parse_args([command, *arguments], exit_on_error=False)
    assert function.__name__ == command
    assert bound.kwargs or bound.args or not arguments


@pytest.mark.slow
@pytest.mark.parametrize("example", EXAMPLES)
def test_an_example_ends_well(call, folder, example):
    _, command, *arguments = shlex.split(example)
    if command == "judge":
        assert call("kit", "benchmark")[0] == 0
        shutil.copytree(folder / "benchmark" / "sample", folder / arguments[0])
    if command == "explore":  # which has sliders for the motion, and refuses one
        (folder / "beam.toml").write_text(BEAM.partition("[motion]")[0])
    code, out, error = call(command, *arguments)
    assert code == 0, error
    assert out
