"""run.toml drives a code: what is missing is run, what fails stays on record."""

import shutil
import sys

import pytest

from rotbeam_exu.verification.submission_files.commands import command_of, run_what_is_missing
from rotbeam_exu.verification.submission_files.faults import MalformedSubmissionError
from rotbeam_exu.verification.submission_files.reading import read_submission

CODE = """
import math, sys
case, elements, step, file = sys.argv[1:]
if elements == "4":
    print("so far so good")
    sys.exit("the matrix is singular\\nat step 3, of many")
if elements == "2":
    sys.exit(0)
with open(file, "w") as out:
    print("time,q", file=out)
    for k in range(751):
        print(f"{0.02 * k:.10g},{math.sin(0.02 * k) / int(elements):.15g}", file=out)
"""
RUN = """
command = '"{python}" code.py {{case}} {{elements}} {{step}} {{file}}'
cases = ["S1"]
meshes = [8, 16, 4, 2]
steps = [1e-3, 5e-4]
"""


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "entry.toml").write_text('benchmark = "1.0"\ncode = "mine"\n', "utf-8")
    (tmp_path / "code.py").write_text(CODE, "utf-8")
    (tmp_path / "run.toml").write_text(RUN.format(python=sys.executable), "utf-8")
    return tmp_path


def test_what_is_missing_is_run_once(folder):
    said = list(run_what_is_missing(folder))
    assert sum(line.endswith(": running") for line in said) == 5
    assert any("failed, exit code 1: at step 3, of many" in line for line in said)
    assert any("wrote no m002_h1e-3.csv: it said nothing" in line for line in said)
    found = read_submission(folder).runs
    assert [(run.elements, run.step, bool(run.failure)) for run in found] == [
        (8, 1e-3, False), (16, 1e-3, False), (4, 1e-3, True), (2, 1e-3, True), (8, 5e-4, False),
    ]  # fmt: skip
    assert all(run.wall > 0.0 for run in found)
    assert list(run_what_is_missing(folder)) == []
    # Without its row a run is made again.
    rows = (folder / "runs.csv").read_text("utf-8").splitlines()
    (folder / "runs.csv").write_text("\n".join(rows[:-1]), "utf-8")
    assert len(list(run_what_is_missing(folder))) == 2
    assert len(read_submission(folder).runs) == 5


def test_a_table_of_ones_own_is_continued(folder):
    table = "step, elements, file, failure\n1e-3,4,S1/m004_h1e-3.csv,known\n"
    (folder / "runs.csv").write_text(table, "utf-8")
    assert not any("m004" in line for line in run_what_is_missing(folder))
    assert len(read_submission(folder).runs) == 5
    (folder / "runs.csv").write_text("file,elements,step\n", "utf-8")
    with pytest.raises(MalformedSubmissionError, match="no rows below it"):
        list(run_what_is_missing(folder))
    (folder / "runs.csv").write_text("file,elements,step\nS1/m008_h1e-3.csv,8,1e-3\n", "utf-8")
    with pytest.raises(ValueError, match="no column failure"):
        list(run_what_is_missing(folder))


def test_what_takes_too_long_is_on_record(folder):
    (folder / "code.py").write_text("import time; time.sleep(60)", "utf-8")
    text = RUN.format(python=sys.executable).replace("[8, 16, 4, 2]", "[8]")
    (folder / "run.toml").write_text(text.replace(", 5e-4]", "]\ntimeout = 0.2"), "utf-8")
    said = list(run_what_is_missing(folder))
    assert said[1] == "S1/m008_h1e-3.csv: failed, took longer than 0.2 s"


def test_places_in_the_command_are_filled_and_braces_left_alone(folder):
    text = RUN.replace("code.py", "-batch run({{case}},{{elements}},{{step}})")
    (folder / "run.toml").write_text(text.format(python="matlab"), "utf-8")
    command = command_of(folder)
    assert command.filled("S1", 8, 5e-4)[:3] == ["matlab", "-batch", "run(S1,8,0.0005)"]
    assert list(command.asked())[-1] == ("S1", 8, 5e-4)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("command", "comand", "unknown key 'comand'; known are"),
        ("{{step}}", "{{steps}}", "command has {steps}; known are {case}"),
        ('"{python}"', '"{python}', "cannot be split into words"),
        ('["S1"]', '["S9"]', "'S9' is no case with a history"),
        ('["S1"]', '"S1"', "cases must be a list"),
        ("[8, 16, 4, 2]", "[8.5]", "meshes must be a whole number"),
        ("[8, 16, 4, 2]", "[]", "meshes must be a list"),
        ("5e-4", "-1", "steps must be positive"),
        ("5e-4]", "5e-4]\ntimeout = 'a'", "timeout must be a number"),
        ("5e-4]", "", "is not valid TOML"),
    ],
)
def test_what_is_wrong_with_it_is_said(folder, old, new, said):
    text = RUN.replace(old, new).format(python="python")
    (folder / "run.toml").write_text(text, "utf-8")
    with pytest.raises(MalformedSubmissionError) as caught:
        list(run_what_is_missing(folder))
    assert said in str(caught.value)
    assert all(fault.file == "run.toml" for fault in caught.value.faults)


def test_a_command_that_is_not_there(folder):
    (folder / "run.toml").write_text(RUN.format(python="no-such-program"), "utf-8")
    with pytest.raises(ValueError, match=r"run\.toml: 'no-such-program' cannot be run"):
        list(run_what_is_missing(folder))
    shutil.rmtree(folder)
    with pytest.raises(FileNotFoundError, match="there is no folder"):
        list(run_what_is_missing(folder))
