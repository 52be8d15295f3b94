"""`rotbeam judge`: faults, mistakes, tables, files; without Exudyn."""

import json
import re
import unicodedata
from pathlib import Path

import pytest

from rotbeam_exu.cli import judge as room
from rotbeam_exu.report import page as page_room
from rotbeam_exu.verification.submission_files import write_submission

ROOT = Path(__file__).parents[2]


@pytest.fixture
def folder(submitted, tmp_path):
    return write_submission(submitted(code="mine"), tmp_path / "mine")


def test_a_right_code(call, reached, folder, tmp_path, monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")
    page, data = tmp_path / "out.html", tmp_path / "out.json"
    code, out, err = call("judge", folder, "--report", page, "--json", data)
    assert (code, err) == (0, "")
    assert "2 of 26" in out
    assert "usual mistake" not in out
    assert "reference: " in out
    tables = out.split("reference: ")[0]
    assert max(len(line) for line in tables.splitlines() if not line.startswith("!")) <= 80
    assert "<title>rotbeam judgement: mine</title>" in page.read_text("utf-8")
    found = json.loads(data.read_text("utf-8"))
    assert found["passed"]
    assert set(found["files"]) >= {"entry.toml", "runs.csv", "L.csv", "S1/m008_h1e-3.csv"}

    # A judgement may be made again: its page is no reason to refuse, ahead of it.
    assert reached(room, "judged", "judge", folder, "--report", page)


def test_a_mistake_is_named_ahead_of_the_verdict(call, submitted, tmp_path):
    code, out, _ = call("judge", write_submission(submitted(lambda q: -q), tmp_path / "mine"))
    assert code == 1
    assert out.startswith("S1: a usual mistake? q has the wrong sign")
    assert "differs" in out


def test_one_bad_file_leaves_the_others_judged(call, folder, tmp_path, monkeypatch):
    monkeypatch.setattr(page_room, "_DRAWS", False)  # figures are drawn above
    (folder / "S1" / "m016_h1e-3.csv").unlink()
    (folder / "L.csv").write_text("elements;speed;frequency\n8;0;2.9\n", "utf-8")
    page, data = tmp_path / "out.html", tmp_path / "out.json"
    code, out, err = call("judge", folder, "--report", page, "--json", data)
    assert code == 2
    assert "│ S1   │ q(t)" in out
    assert "│ ω_n" not in out
    found = json.loads(data.read_text("utf-8"))
    assert list(found["cases"]) == ["S1"]
    assert [(one["file"], one["line"]) for one in found["faults"]] == [
        ("L.csv", 1), ("S1/m016_h1e-3.csv", None)
    ]  # fmt: skip
    faults = page.read_text("utf-8").split("<h2>Not judged</h2>")[1].split("</table>")[0]
    assert re.findall("<td><code>(.*?)</code>", faults) == ["L.csv", "S1/m016_h1e-3.csv"]
    assert err.splitlines() == [
        "L.csv:1: the header is split by semicolons: separate the columns by commas, "
        "elements,speed,frequency",
        "S1/m016_h1e-3.csv: there is no such file",
        "2 faults: only the rest is judged",
    ]


def test_nothing_is_judged_of_an_unknown_code(call, folder):
    (folder / "entry.toml").unlink()
    (folder / "runs.csv").write_text("file,elements,step,colour\n", "utf-8")
    code, out, err = call("judge", folder)
    assert (code, out) == (2, "")
    assert "unknown column 'colour'" in err
    assert err.endswith("2 faults: nothing is judged\n")


HOSTILE = "\x1b]0;owned\x07\x1b[31m\x9b2J\u202eedoc"
"""Titles the window, turns red, clears the screen, and writes from right to left."""


def steers(text):
    return [letter for letter in text if unicodedata.category(letter) in ("Cc", "Cf")]


def test_a_terminal_obeys_no_author(call, folder, tmp_path):
    """Neither by the names in entry.toml, nor by remarks and failures of runs, nor by files.

    Each is refused by a sentence that shows the letters, and nothing is judged under such a name.
    """
    entry = (
        (folder / "entry.toml").read_text("utf-8").replace('"mine"', json.dumps(f"mine{HOSTILE}"))
    )
    (folder / "entry.toml").write_text(entry, "utf-8")
    listed = (folder / "runs.csv").read_text("utf-8").splitlines()
    rows = [f"{row}{HOSTILE}" if n else row for n, row in enumerate(listed)]
    rows.append(f"S1/m064_h1e-3.csv,64,1e-3,,,,,{HOSTILE},")
    (folder / "runs.csv").write_text("\n".join(rows), "utf-8")
    (folder / "L.csv").write_text(f"elements,speed,frequency\n8,{HOSTILE},1\n", "utf-8")
    code, out, err = call("judge", folder)
    assert (code, out) == (2, "")
    assert set(steers(err)) == {"\n"}
    assert [
        line.partition(" has a letter that no reader sees, ")[::2]
        for line in err.splitlines()
        if "no reader" in line
    ] == [
        ("entry.toml: code", r"'\x1b' in 'mine\x1b]0;owned\x07\x1b[31m': leave it out"),
        (
            "runs.csv:2: remark",
            r"'\x1b' in 'went on\x1b]0;owned\x07\x1b[31m': leave it out (and so in 4 more)",
        ),
        ("runs.csv:7: failure", r"'\x1b' in '\x1b]0;owned\x07\x1b[31m': leave it out"),
    ]
    path = tmp_path / f"{HOSTILE}.toml"
    path.write_text(f"{HOSTILE} = 1", "utf-8")
    assert set(steers(call("run", "--config", path)[2])) == {"\n"}


def test_one_case_is_read_and_judged_alone(call, folder):
    """A fault in another case's history is not met; frequencies still serve the shift."""
    code, whole, _ = call("judge", folder)
    with (folder / "runs.csv").open("a") as runs:
        runs.write("V/m008_h1e-3.csv,8,1e-3,,,,,,\n")
    code, out, err = call("judge", folder, "--case", "S1")
    assert (code, err) == (0, "")
    assert "│ ω_n" not in out
    assert "1 of 1" in out
    shift = next(line for line in whole.splitlines() if "│ shift" in line)
    assert shift in out
