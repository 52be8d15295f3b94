"""`rotbeam explore` as a user meets it."""

import pytest

from rotbeam_exu import explorer
from rotbeam_exu.cli import main


def test_it_writes_one_page_and_says_where(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(explorer, "explorer_page", lambda **_: "<!doctype html>ω")
    out = tmp_path / "site" / "explorer.html"
    main(["explore", "--out", str(out)])
    assert out.read_text(encoding="utf-8") == "<!doctype html>ω"
    assert "explorer.html" in capsys.readouterr().out
    assert [path.name for path in out.parent.iterdir()] == ["explorer.html"]


def test_another_ending_is_refused_before_any_work(call, tmp_path, monkeypatch):
    monkeypatch.setattr(explorer, "explorer_page", lambda **_: pytest.fail("computed first"))
    code, _, error = call("explore", "--out", tmp_path / "explorer.pdf")
    assert code == 2
    assert "the ending must be .html" in error


@pytest.mark.slow
def test_the_whole_page_is_small_enough(tmp_path):
    out = tmp_path / "explorer.html"
    main(["explore", "--out", str(out), "--jobs", "2"])
    assert 1e6 < out.stat().st_size < 6e6
