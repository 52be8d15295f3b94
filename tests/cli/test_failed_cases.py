"""A sweep with a failed case: exit code 1, the whole reason, and where; progress in plain lines."""

from rotbeam_exu import load
from rotbeam_exu.sweeps import grid

# Steps of 80 ms lose the run at 6 rad/s, not at 2 rad/s.
GRID = ("--omega", "2", "6", "--ramp-time", "2.5", "--elements", "2", "--step", "0.08",
        "--duration", "10", "--jobs", "1")  # fmt: skip


def test_a_failed_case_is_exit_code_one_and_its_whole_sentence(call, tmp_path, monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")
    code, out, error = call("sweep", *GRID, "--cache", tmp_path / "cache", "-o", tmp_path)
    data = load(tmp_path / "sweep-cable-2.nc")
    failed = [str(text) for text in data["failure"].to_numpy().ravel() if text]
    assert 0 < len(failed) <= 2
    assert code == 1
    for sentence in failed:
        assert sentence in out
    assert "…" not in out
    assert "failed at ω = " in out
    assert f"{len(failed)} of 2 spin-ups failed; why is above, and as `failure` in" in error
    assert "nan" not in out
    assert [line for line in out.splitlines() if line.startswith("written ")] == [
        f"written {tmp_path}/sweep-cable-2.{kind}" for kind in ("nc", "csv")
    ]
    # Without a terminal each finished case is a line on standard error.
    lines = [line.partition(" done")[0] for line in error.splitlines()]
    assert [line for line in lines if line[:8] == "spin-ups"] == [
        "spin-ups: 1 of 2", "spin-ups: 2 of 2",
    ]  # fmt: skip
    assert "spin-ups:" not in out


def test_equal_sentences_are_printed_once_with_all_their_places(call, tmp_path, monkeypatch):
    sentences = {"the step is too large": [(2.0, 2.5), (6.0, 2.5)]}
    monkeypatch.setattr(grid, "failures", lambda _: sentences)
    code, out, _ = call("sweep", *GRID, "--cache", tmp_path / "cache", "-o", tmp_path)
    assert code == 1
    assert "failed at ω = 2 rad/s, T = 2.5 s; ω = 6 rad/s, T = 2.5 s: the step is too large" in out
