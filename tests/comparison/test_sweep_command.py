"""`rotbeam sweep` as a user meets it."""

import pytest

from rotbeam_exu import load
from rotbeam_exu.sweeps import grid
from tests.beams import REED_TOML

COARSE = {"--elements": "2", "--step": "0.005", "--duration": "9", "--jobs": "1"}


@pytest.fixture
def swept(call, tmp_path):
    def run(*options):
        coarse = (pair for pair in COARSE.items() if pair[0] not in options)
        out = ("--cache", tmp_path / "cache", "--out", tmp_path / "out")
        return call("sweep", *sum(coarse, ()), *out, *options)

    return run


def test_table_files_and_failures_by_cause(swept, tmp_path):
    code, printed, error = swept("--omega", "4", "6", "--ramp-time", "3", "8.5", "--history")
    assert code == 1
    assert "2 of 4 spin-ups failed; why is above, and as `failure` in" in error
    assert "the tip does not oscillate within the" in printed
    assert printed.count("passed") == 2
    data = load(tmp_path / "out" / "sweep-cable-2.nc")
    assert dict(data.sizes) == {"omega": 2, "ramp_time": 2, "time": 1801}
    text = (tmp_path / "out" / "sweep-cable-2.csv").read_text()
    lines = [line for line in text.splitlines() if not line.startswith("#")]
    assert lines[0].startswith("omega [rad/s],ramp_time [s],amplitude,")
    assert len(lines) == 5


@pytest.mark.slow  # test_sweep has them through Python
def test_shards_share_a_cache(swept, tmp_path):
    grid = ("--omega", "4", "6", "--ramp-time", "3")
    assert "pending" in swept(*grid, "--shard", "1/2")[1]
    swept(*grid, "--shard", "2/2")
    assert (tmp_path / "out" / "sweep-cable-2-shard-2-2.nc").exists()
    assert "pending" not in swept(*grid)[1]


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (["--shard", "5/4"], "shard 5/4: the part must be between 1 and 4"),
        (["--shard", "two"], "shard must read k/n, as 1/4, got 'two'"),
        (["--omega", "4", "4"], "omegas holds 4 more than once"),
        (["--step", "nan"], "step must be finite, got nan s"),
        (["--omega", "0", "4"], "at omega = 0 rad/s the beam stays at rest"),
        (["--ramp-time", "3", "-3"], "ramp_time must be positive, got -3.0 s"),
    ],
)
def test_bad_input_exits_with_2_and_one_sentence(swept, options, sentence):
    code, _, error = swept("--omega", "6", "--ramp-time", "3", *options)
    assert code == 2
    assert sentence in error
    assert len(error.splitlines()) == 1


def test_a_beam_of_one_s_own_is_swept_over_the_paper_s_ratios(call, tmp_path, monkeypatch):
    asked = {}

    def stop(beam, **options):
        asked.update(options)
        raise KeyboardInterrupt

    monkeypatch.setattr(grid, "sweep", stop)
    config = tmp_path / "reed.toml"
    config.write_text(REED_TOML)
    out = call("sweep", "--config", config, "--out", tmp_path)[1]
    # ω_0 is 1050.4 rad/s, 361.06 times the paper's.
    assert asked["omegas"] == [720.0, 1400.0, 2200.0, 2900.0]
    assert asked["ramp_times"][0] == pytest.approx(3.375 / 361.06, rel=1e-3)
    assert asked["duration"] == pytest.approx(0.042)
    assert asked["step"] == 2e-6
    assert "ω = 720, 1400, 2200, 2900 rad/s" in out
