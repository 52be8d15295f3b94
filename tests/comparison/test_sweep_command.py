"""`rotbeam sweep` as a user meets it."""

import pytest

from rotbeam_exu import load
from rotbeam_exu.cli import main

COARSE = ["--step", "0.005", "--duration", "9", "--jobs", "1"]


def call(tmp_path, *options):
    if "--elements" not in options:
        options = ("--elements", "2", *options)
    main(["sweep", *COARSE, "--cache", f"{tmp_path}/cache", "--out", f"{tmp_path}/out", *options])


def test_table_files_and_failures_by_cause(tmp_path, capsys):
    call(tmp_path, "--omega", "4", "6", "--ramp-time", "3", "8.5", "--history")
    printed = capsys.readouterr().out
    assert "failed 2 ×: the tip does not oscillate within the" in printed
    assert printed.count("passed") == 2
    data = load(tmp_path / "out" / "sweep-cable-2.nc")
    assert dict(data.sizes) == {"omega": 2, "ramp_time": 2, "time": 1801}
    lines = (tmp_path / "out" / "sweep-cable-2.csv").read_text().splitlines()
    assert lines[0].startswith("omega [rad/s],ramp_time [s],amplitude,")
    assert len(lines) == 5


def test_shards_share_a_cache(tmp_path, capsys):
    grid = ("--omega", "4", "6", "--ramp-time", "3")
    call(tmp_path, *grid, "--shard", "1/2")
    assert "pending" in capsys.readouterr().out
    call(tmp_path, *grid, "--shard", "2/2")
    assert (tmp_path / "out" / "sweep-cable-2-shard-2-2.nc").exists()
    call(tmp_path, *grid)
    assert "pending" not in capsys.readouterr().out.split("sweep-cable-2-shard-2-2")[1]


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (["--executor", "dask"], "the Dask executor needs --scheduler ADDRESS"),
        (["--shard", "5/4"], "shard 5/4: the part must be between 1 and 4"),
        (["--shard", "two"], "shard must read k/n, as 1/4, got 'two'"),
        (["--omega", "4", "4"], "omegas holds 4 more than once"),
        (["--elements", "0"], "elements must be at least 1, got 0"),
        (["--element", "brick"], "unknown element 'brick'"),
    ],
)
def test_bad_input_exits_with_2_and_one_sentence(tmp_path, capsys, options, sentence):
    with pytest.raises(SystemExit) as stop:
        call(tmp_path, "--omega", "6", "--ramp-time", "3", *options)
    error = capsys.readouterr().err
    assert stop.value.code == 2
    assert sentence in error
    assert len(error.splitlines()) == 1


def test_a_cache_of_another_version_exits_with_2(tmp_path, capsys):
    (tmp_path / "cache").mkdir()
    (tmp_path / "cache" / "rotbeam-cache.json").write_text('{"format": 0}')
    with pytest.raises(SystemExit) as stop:
        call(tmp_path, "--omega", "6", "--ramp-time", "3")
    assert stop.value.code == 2
    assert "has format 0, this version writes 1" in capsys.readouterr().err
