"""Whatever stands in a stranger's entry.toml and runs.csv: a sentence or a judgement, no more."""

import json
import random

import numpy as np
import pytest

from rotbeam_exu.cli import INTERNAL
from rotbeam_exu.cli import judge as room
from rotbeam_exu.verification.convergence import converged
from rotbeam_exu.verification.outcomes import Outcome, finding_of
from rotbeam_exu.verification.submission import LONGEST_NAME, Declaration
from rotbeam_exu.verification.submission_files import read_submission, write_submission
from rotbeam_exu.verification.submission_files.faults import MalformedSubmissionError
from rotbeam_exu.verification.submission_files.tables import LEAST, MOST

KEYS = ("benchmark", "code", "version", "element", "remarks", "authors", "order", "order_in_step",
        "tags", "shear")  # fmt: skip
UNSEEN = "\x00\x1b\x7f\x85\u200b\u200d\u202e\u2028\u2066\ufeff\u2800\u3164\ufe0f\U000e0041"
VALUES = ("400.0", "1e4", "1e300", "-1", "0", "0.0", "nan", "inf", "-inf", "true", "1e-300", "2.0",
          "9" * 400, "20", "0.1", "1979-05-27", "[]", "{}", "[[]]", '"mine"', '""', '"1.1"',
          '["a", "b"]', "[1, 2]", '["shear"]', "{share = 0.3}", "{share = 1e300}",
          "{k_s = 0.8, nu = -0.9999999999999999}", "{k_s = 1e-9, nu = true}",
          '{share = 0.3, law = "x"}', '"' + "x" * 300 + '"', '["' + "x" * 9999 + '"]',
          "[" + '"a",' * 999 + "]")  # fmt: skip
HEADERS = ("file", "elements", "step", "tolerance", "dof", "wall_s", "cpu_s", "failure", "remark")
CELLS = ("S1/m008_h1e-3.csv", "S1/m016_h1e-3.csv", "S9/m1_h1.csv", "../entry.toml", "8", "16",
         "1e-3", "1e-300", "1e300", "-1", "0", "nan", "", "x", "x" * 3000, "1e12", "\u202e",
         '"a\x1b"', "0.001", "9" * 400)  # fmt: skip
TABLE = "elements,speed,frequency\n8,6.0,3.731123456\n16,6.0,3.7303456\n32,6.0,3.7303010\n"


def quoted(rng):
    """Return a text with a letter that is not seen, as TOML has it."""
    text = "mine" + rng.choice(UNSEEN) + "a"
    return json.dumps(text).replace("\\udb40\\udc41", "\\U000e0041").replace("\x7f", "\\u007f")


@pytest.mark.parametrize("seed", range(40))
def test_values_of_any_kind_are_a_sentence_or_a_judgement(call, tmp_path, seed):
    """The whole command, of which a traceback once was the exit code of a code that differs."""
    rng = random.Random(seed)
    stated = {"benchmark": '"1.1"', "code": '"mine"'}
    for key in rng.sample(KEYS, rng.randint(1, 2)):
        stated[key] = quoted(rng) if rng.random() < 0.3 else rng.choice(VALUES)
    text = "".join(f"{key} = {value}\n" for key, value in stated.items())
    (tmp_path / "entry.toml").write_text(text, "utf-8")
    (tmp_path / "L.csv").write_text(TABLE, "utf-8")
    if seed % 4 == 0:
        columns = [*HEADERS[:3], *rng.sample(HEADERS[3:], 2)]
        rows = [[CELLS[0], "8", "1e-3", *rng.choices(CELLS, k=2)], rng.choices(CELLS, k=5)]
        lines = [",".join(row) for row in (columns, *rows)]
        (tmp_path / "runs.csv").write_text("\n".join(lines), "utf-8")
    code, out, err = call("judge", tmp_path)
    assert code in {0, 1, 2, 3}, err
    assert (code == 2) == bool(err)
    assert len(out + err) < 20_000
    assert "Traceback" not in err
    assert not set(UNSEEN) & set(out + err)
    for line in err.splitlines()[:-1]:
        assert line.startswith(("entry.toml", "runs.csv", "S1/"))


def test_runs_of_any_size_have_a_limit_or_none():
    """Meshes, steps and values as they may be read: no order that is tried leaves the numbers."""
    rng = random.Random(1)
    size = np.log10([LEAST, MOST])
    for _ in range(60):
        count = rng.randint(2, 5)
        n = [float(round(10 ** rng.uniform(0, size[1]))) for _ in range(count)]
        h = [10 ** rng.uniform(*size) for _ in range(count)]
        values = [rng.choice([1.0, 10 ** rng.uniform(*size)]) for _ in range(count)]
        order = rng.choice([None, 0.1, 2.0, 20.0])
        with np.errstate(over="raise", invalid="raise", divide="raise"):
            fit = converged(n, h, values, declared=(order, order))
            found = finding_of(fit, tolerance=1e-3, bound=1e-9, where="here")
        assert isinstance(found.outcome, Outcome)


@pytest.mark.parametrize(("key", "value"), [("order", 400.0), ("order", 1e-9), ("order_in_step", 0),
                         ("code", "x" * (LONGEST_NAME + 1)), ("code", "a\u202eb"),
                         ("authors", ("a\u200b",)), ("remarks", "a\x1b")])  # fmt: skip
def test_a_declaration_in_python_passes_the_same_door(key, value):
    with pytest.raises(ValueError, match=f"{key}.*(must be from 0.1 to 20|200|no reader sees)"):
        Declaration(**{"code": "a", key: value})


@pytest.mark.parametrize("letter", UNSEEN[1:])
def test_letters_that_are_not_seen_are_shown(tmp_path, letter):
    name = json.dumps(f"rotbeam {letter}ref").replace("\\udb40\\udc41", "\\U000e0041")
    name = name.replace("\x7f", "\\u007f")
    (tmp_path / "entry.toml").write_text(f'benchmark = "1.1"\ncode = {name}', "utf-8")
    (tmp_path / "L.csv").write_text(TABLE, "utf-8")
    with pytest.raises(MalformedSubmissionError) as caught:
        read_submission(tmp_path)
    spelled = ascii(letter)
    said = f"entry.toml: code has a letter that no reader sees, {spelled} in 'rotbeam "
    assert str(caught.value) == f"{said}{spelled[1:-1]}ref': leave it out"


def test_histories_are_read_where_runs_csv_is_missing_or_faulty(submitted, tmp_path):
    """Their faults, in whatever order they are mended."""
    folder = write_submission(submitted(), tmp_path / "mine")
    file = "S1/m016_h1e-3.csv"
    (folder / file).write_text("t,q\n0,0\n", "utf-8")
    (folder / "S1" / "m16.csv").write_text("time,q\n0,0\n", "utf-8")
    listed = (folder / "runs.csv").read_text("utf-8")
    said = [
        f"{file}:1: unknown column 't'; did you mean 'time'?",
        f"{file}:1: there is no column time: the header is time,q",
        "S1/m16.csv: 'S1/m16.csv' is no name of a history: write S1/m032_h1e-3.csv, or _t1e-6 of a "
        "tolerance",
    ]
    for change, fault in (
        (None, "runs.csv: there is no such file"),
        (listed.replace("file,", "name,"), "runs.csv:1: unknown column 'name'"),
        (listed.replace("16,0.001", "17,0.001"), "runs.csv:"),
    ):
        (folder / "runs.csv").unlink()
        if change is not None:
            (folder / "runs.csv").write_text(change, "utf-8")
        else:
            assert not (folder / "runs.csv").exists()
        with pytest.raises(MalformedSubmissionError) as caught:
            read_submission(folder)
        found = list(map(str, caught.value.faults))
        assert found[0].startswith(fault)
        assert set(said) <= set(found)
        (folder / "runs.csv").write_text(listed, "utf-8")


def test_times_are_printed_where_they_are_known(call, submitted, tmp_path, monkeypatch):
    monkeypatch.setenv("COLUMNS", "120")
    folder = write_submission(submitted(), tmp_path / "mine")
    lines = [row.split(",") for row in (folder / "runs.csv").read_text("utf-8").splitlines()]
    for kept, due in ((("cpu_s",), "CPU s"), (("wall_s", "cpu_s"), "seconds"), ((), None)):
        names = ["file", "elements", "step", *kept]
        rows = [dict(zip(lines[0], row, strict=True)) | {"wall_s": "1.5", "cpu_s": "2.5"}
                for row in lines[1:]]  # fmt: skip
        text = "\n".join(",".join(row[name] for name in names) for row in rows)
        (folder / "runs.csv").write_text(",".join(names) + "\n" + text, "utf-8")
        out = call("judge", folder)[1]
        assert "nan" not in out
        (header,) = [line for line in out.splitlines() if "order in mesh" in line]
        assert ("CPU s" in header) == (due == "CPU s")
        assert ("seconds" in header) == (due == "seconds")


@pytest.mark.parametrize(
    "error", [IndexError, KeyError, RuntimeError, ValueError, ZeroDivisionError]
)
def test_an_error_of_the_judge_is_neither_a_difference_nor_a_fault(
    call, submitted, tmp_path, monkeypatch, error
):
    def failing(*_, **__):
        raise error("out of\x1b" + " bounds" * 999)

    monkeypatch.setattr(room, "judged", failing)
    code, out, err = call("judge", write_submission(submitted(), tmp_path / "mine"))
    assert (code, out) == (INTERNAL, "")
    assert err.startswith(f"rotbeam: internal error, not of your input: {error.__name__}: ")
    assert "test_hostile_values.py:" in err
    assert err.endswith("please report it with the command\n")
    assert len(err) < 500
    assert "\x1b" not in err
