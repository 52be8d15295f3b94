"""Every example that --help prints is read, and run if slow tests are asked for.

What takes minutes in it is replaced.
"""

import shlex
import shutil

import pytest

from rotbeam_exu import explorer
from rotbeam_exu.cli import _COMMANDS, app, documented
from rotbeam_exu.sweeps import grid
from rotbeam_exu.verification import refining
from rotbeam_exu.verification import verify as room
from tests.beams import BEAM_TOML

EXAMPLES = [example for command in _COMMANDS for example in documented(command)[1]]
BEAM = (
    f"{BEAM_TOML}[motion]\nomega = 6\nramp_time = 3\n"
    "[numerics]\nelements = 2\nstep = 0.01\nduration = 8\n"
)


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
def test_an_example_ends_well_or_begins_what_takes_minutes(call, tmp_path, monkeypatch, example):
    def begun(*_, **__):
        raise KeyboardInterrupt

    for place, name in (
        (grid, "solved"), (explorer, "explorer_data"), (room, "verify"), (refining, "until_decided")
    ):  # fmt: skip
        monkeypatch.setattr(place, name, begun)
    monkeypatch.chdir(tmp_path)
    (tmp_path / "beam.toml").write_text(BEAM)
    (tmp_path / "mine").touch(mode=0o755)
    (tmp_path / "measured.csv").write_text("mode,frequency [Hz]\nlag 1,1.1\nlag 2,7\n")
    _, command, *arguments = shlex.split(example)
    if command == "judge":
        assert call("kit", "benchmark")[0] == 0
        shutil.copytree(tmp_path / "benchmark" / "sample", tmp_path / arguments[0])
    if command in ("explore", "blade", "compare"):  # which refuse a mesh, or a motion too
        (tmp_path / "beam.toml").write_text(BEAM.partition("[motion]")[0])
    code, out, error = call(command, *arguments)
    assert code == 130 or (code == 0 and out), error
