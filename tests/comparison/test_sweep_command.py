"""`rotbeam sweep` as a user meets it."""

import pytest

from rotbeam_exu import load
from rotbeam_exu.cli import main
from rotbeam_exu.sweeps import grid
from tests.beams import REED_TOML

COARSE = {"--elements": "2", "--step": "0.005", "--duration": "9", "--jobs": "1"}


def call(tmp_path, *options):
    coarse = [
        text for name, value in COARSE.items() if name not in options for text in (name, value)
    ]
    main(["sweep", *coarse, "--cache", f"{tmp_path}/cache", "--out", f"{tmp_path}/out", *options])


def test_table_files_and_failures_by_cause(tmp_path, capsys):
    with pytest.raises(SystemExit) as stop:
        call(tmp_path, "--omega", "4", "6", "--ramp-time", "3", "8.5", "--history")
    assert stop.value.code == 1
    printed = capsys.readouterr().out
    assert "the tip does not oscillate within the" in printed
    assert printed.count("passed") == 2
    data = load(tmp_path / "out" / "sweep-cable-2.nc")
    assert dict(data.sizes) == {"omega": 2, "ramp_time": 2, "time": 1801}
    text = (tmp_path / "out" / "sweep-cable-2.csv").read_text()
    lines = [line for line in text.splitlines() if not line.startswith("#")]
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
        (["--shard", "5/4"], "shard 5/4: the part must be between 1 and 4"),
        (["--shard", "two"], "shard must read k/n, as 1/4, got 'two'"),
        (["--omega", "4", "4"], "omegas holds 4 more than once"),
        (["--elements", "0"], "elements must be at least 1, got 0"),
        (["--step", "nan"], "step must be finite, got nan s"),
        (["--step", "inf"], "step must be finite, got inf s"),
        (["--step", "-1"], "step must be positive, got -1.0 s"),
        (["--duration", "nan"], "duration must be finite, got nan s"),
        (["--omega", "0", "4"], "at omega = 0 rad/s the beam stays at rest"),
        (["--ramp-time", "3", "-3"], "ramp_time must be positive, got -3.0 s"),
        (["--jobs", "0"], "jobs must be at least 1, got 0"),
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


def test_a_sweep_of_which_nothing_passes_exits_with_1(tmp_path, capsys):
    with pytest.raises(SystemExit) as stop:
        call(tmp_path, "--omega", "6", "--ramp-time", "8.5")
    assert stop.value.code == 1
    assert "1 of 1 spin-ups failed; why is above, and as `failure` in" in capsys.readouterr().err


def test_a_beam_of_one_s_own_is_swept_over_the_paper_s_ratios(tmp_path, capsys, monkeypatch):
    asked = {}

    def stop(beam, **options):
        asked.update(options)
        raise KeyboardInterrupt

    monkeypatch.setattr(grid, "sweep", stop)
    config = tmp_path / "reed.toml"
    config.write_text(REED_TOML)
    with pytest.raises(SystemExit):
        main(["sweep", "--config", str(config), "--out", str(tmp_path)])
    # ω_0 is 1050.4 rad/s, 361.06 times the paper's.
    assert asked["omegas"] == [720.0, 1400.0, 2200.0, 2900.0]
    assert asked["ramp_times"][0] == pytest.approx(3.375 / 361.06, rel=1e-3)
    assert asked["duration"] == pytest.approx(0.042)
    assert asked["step"] == 2e-6
    assert "omega 720, 1400, 2200, 2900 rad/s" in capsys.readouterr().out
