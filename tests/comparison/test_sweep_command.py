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


# The longer ramp leaves less than a cycle.
GRID = ("--omega", "6", "--ramp-time", "2.5", "9.5", "--elements", "2", "--step", "0.01",
        "--duration", "10", "--jobs", "1")  # fmt: skip


def test_table_files_and_a_failed_case_whose_sentence_is_whole(call, tmp_path, monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")
    code, out, error = call("sweep", *GRID, "--cache", tmp_path / "cache", "-o", tmp_path)
    data = load(tmp_path / "sweep-cable-2.nc")
    failed = [str(text) for text in data["failure"].to_numpy().ravel() if text]
    assert dict(data.sizes) == {"omega": 1, "ramp_time": 2}
    assert len(failed) == 1
    assert "the tip does not oscillate within the" in failed[0]
    assert code == 1
    assert out.count("passed") == 1
    for sentence in failed:
        assert sentence in out
    assert "…" not in out
    assert "failed at ω = " in out
    assert f"{len(failed)} of 2 spin-ups failed; why is above, and as `failure` in" in error
    assert "nan" not in out
    assert [line for line in out.splitlines() if line.startswith("written ")] == [
        f"written {tmp_path}/sweep-cable-2.{kind}" for kind in ("nc", "csv")
    ]
    text = (tmp_path / "sweep-cable-2.csv").read_text()
    lines = [line for line in text.splitlines() if not line.startswith("#")]
    assert lines[0].startswith("omega [rad/s],ramp_time [s],amplitude,")
    assert len(lines) == 3
    # Without a terminal each finished case is a line on standard error.
    lines = [line.partition(" done")[0] for line in error.splitlines()]
    assert [line for line in lines if line[:8] == "spin-ups"] == [
        "spin-ups: 1 of 2", "spin-ups: 2 of 2",
    ]  # fmt: skip
    assert "spin-ups:" not in out


def test_equal_sentences_are_printed_once_with_all_their_places(call, tmp_path, monkeypatch):
    sentences = {"the step is too large": [(2.0, 2.5), (6.0, 2.5)]}
    monkeypatch.setattr(grid, "failures", lambda _: sentences)
    one = (*GRID[:4], *GRID[5:])
    code, out, _ = call("sweep", *one, "--cache", tmp_path / "cache", "-o", tmp_path)
    assert code == 1
    assert "failed at ω = 2 rad/s, T = 2.5 s; ω = 6 rad/s, T = 2.5 s: the step is too large" in out


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
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
