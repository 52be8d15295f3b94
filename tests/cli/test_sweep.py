"""`rotbeam sweep` as a user meets it."""

from rotbeam_exu import load
from rotbeam_exu.sweeps import grid

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
    assert out.count("solved") == 1
    for sentence in failed:
        assert sentence in out
    assert "…" not in out
    assert "failed at ω = " in out
    assert f"{len(failed)} of 2 spin-ups failed; why is above, and as `failure` in" in error
    assert "nan" not in out
    assert [line for line in out.splitlines() if line.startswith("written ")] == [
        f"written {tmp_path}/sweep-cable-2.{kind}" for kind in ("nc", "csv", "json")
    ]
    text = (tmp_path / "sweep-cable-2.csv").read_text()
    lines = text.splitlines()
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
