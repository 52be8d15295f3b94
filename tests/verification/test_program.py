"""An author's program, run until the judge decides: a script that knows the answer, with errors."""

import sys
import time
from pathlib import Path

import numpy as np
import pytest

from rotbeam_exu.verification.cases import CASES
from rotbeam_exu.verification.judgement import judged
from rotbeam_exu.verification.program import Program
from rotbeam_exu.verification.references import reference
from rotbeam_exu.verification.refining import Record, until_decided
from rotbeam_exu.verification.submission_files import read_submission

S1, L = CASES["S1"], CASES["L"]
OUT = "{case} {elements} {step} {out}"

SCRIPT = """
import sys
from pathlib import Path
import numpy as np
here = Path(__file__).parent
case, elements, step, out = sys.argv[1], int(sys.argv[2]), float(sys.argv[3]), sys.argv[4]
with (here / "calls").open("a") as file:
    file.write(f"{case} {elements} {step}\\n")
known = np.load(here / "known.npz")
if case == "L":
    rows = [(elements, speed, w * (1 + SIZE / elements**2)) for speed, w in known["L"]]
    np.savetxt(out, rows, "%.17g", ",", header="elements,speed,frequency", comments="")
else:
    if step > LARGEST:
        print("it runs away\\x07", file=sys.stderr)
        sys.exit(3)
    time, q = known["S1"]
    q = OFF * q * (1 + SIZE / elements**2 + 1e3 * step**2)
    np.savetxt(out, np.c_[time, q], "%.17g", ",", header="time,q", comments="")
"""


@pytest.fixture(scope="module")
def known(tmp_path_factory):
    time = np.linspace(0.0, 15.0, 1501)
    frequencies = [(speed, reference(L).row(speed)[0]) for speed in L.speeds]
    path = tmp_path_factory.mktemp("known") / "known.npz"
    np.savez(path, S1=[time, reference(S1).history(time)], L=frequencies)
    return path.read_bytes()


@pytest.fixture
def script(tmp_path, known):
    """Return a function that writes the script with constants, and returns its command."""

    def write(size=1.0, largest=1.0, off=1.0, words=OUT):
        (tmp_path / "known.npz").write_bytes(known)
        constants = f"SIZE, LARGEST, OFF = {size!r}, {largest!r}, {off!r}\n"
        (tmp_path / "mine.py").write_text(constants + SCRIPT)
        return f"{sys.executable} {tmp_path / 'mine.py'} {words}"

    return write


def calls(folder):
    return (folder / "calls").read_text().splitlines()


def test_runs_until_all_is_decided_and_goes_on_where_it_stopped(script, tmp_path):
    """On the first meshes the error is thresholds and more: it asks for finer ones."""
    command, folder = script(size=10.0), tmp_path / "mine"
    record = Record(folder, Program(command=command), "mine")
    ends = until_decided(record, [L, S1], elements=8, step=1e-3)
    assert ends == {"L": "decided", "S1": "decided"}
    made = calls(tmp_path)
    assert len(set(made)) == len(made)
    assert max(int(one.split()[1]) for one in made) > 16
    submission = read_submission(folder)
    assert judged(submission).passed
    assert record.submission.declaration == submission.declaration
    assert record.spent > 0.0
    # To repeat a run, its row and its file are deleted.
    dropped = max(submission.runs, key=lambda run: run.fineness)
    (folder / dropped.file).unlink()
    rows = (folder / "runs.csv").read_text().splitlines()
    kept = [row for row in rows if not row.startswith(dropped.file)]
    (folder / "runs.csv").write_text("\n".join(kept) + "\n")
    anew = Record(folder, Program(command=command), "mine")
    assert until_decided(anew, [L, S1], elements=8, step=1e-3) == ends
    extra = calls(tmp_path)[len(made) :]
    assert extra == [f"S1 {dropped.elements} {dropped.step}"]
    made += extra
    again = Record(folder, Program(command=command), "mine")
    assert until_decided(again, [L, S1], elements=8, step=1e-3) == ends
    assert calls(tmp_path) == made
    assert again.spent == 0.0


def test_a_wrong_code_is_decided_too(script, tmp_path):
    record = Record(tmp_path / "mine", Program(command=script(off=1.1)), "mine")
    assert until_decided(record, [S1]) == {"S1": "decided"}
    assert judged(read_submission(tmp_path / "mine")).passed is False


def test_steps_are_halved_where_the_program_fails_and_failures_stay_on_record(script, tmp_path):
    """As of an explicit code; the sentence is its last line, letters that nobody sees escaped."""
    record = Record(tmp_path / "mine", Program(command=script(largest=1.1e-3)), "mine")
    assert until_decided(record, [S1], step=1e-3) == {"S1": "decided"}
    runs = read_submission(tmp_path / "mine").runs
    failed = [one for one in runs if one.failure]
    assert {one.failure for one in failed} == {r"exit code 3: it runs away\x07"}
    assert min(one.step for one in failed) > 1.1e-3
    assert max(one.step for one in runs if not one.failure) == 1e-3


def test_without_out_it_writes_the_names_of_the_kit_where_it_runs(script, tmp_path, monkeypatch):
    """A program and a script that are named from here are found from there; S1 is no file."""
    (tmp_path / "S1").touch()
    words = "{case} {elements} {step}"
    script()
    text = (tmp_path / "mine.py").read_text()
    text = text.replace("sys.argv[4]", 'f"S1/m{int(sys.argv[2]):03d}_h{sys.argv[3]}.csv"')
    (tmp_path / "mine.py").write_text(
        text.replace("import sys", "import sys, os\nos.mkdir('S1')", 1)
    )
    monkeypatch.chdir(tmp_path)
    record = Record("mine", Program(command=f"{sys.executable} mine.py {words}"), "mine")
    made = record.run_of(S1, 8, 1e-3)
    assert "File exists" in made.failure  # the runner has made the folder
    (tmp_path / "mine.py").write_text(text)
    assert not record.run_of(S1, 16, 1e-3).failure
    assert (tmp_path / "mine" / "S1" / "m016_h1e-3.csv").is_file()
    assert read_submission("mine").runs[1].elements == 16


def test_tolerances(script, tmp_path):
    command = script(words="{case} {elements} {tolerance} {out}")
    record = Record(tmp_path / "mine", Program(command=command), "mine")
    assert until_decided(record, [S1], step=1e-5) == {"S1": "decided"}
    runs = read_submission(tmp_path / "mine").runs
    assert all(one.is_adaptive for one in runs)
    assert {one.tolerance for one in runs} >= {1e-5, 2e-5, 4e-5}


def python(tmp_path, text, **limits):
    (tmp_path / "mine.py").write_text(text)
    program = Program(command=f"{sys.executable} {tmp_path / 'mine.py'} {OUT}", **limits)
    return Record(tmp_path / "mine", program, "mine")


def test_a_run_that_takes_too_long_is_stopped_with_all_that_it_started(tmp_path):
    """Its child would write a file two seconds later."""
    late = tmp_path / "late"
    text = (
        "import subprocess, sys, time\n"
        f"late = {f'import time; time.sleep(2); open({str(late)!r}, {chr(119)!r}).close()'!r}\n"
        "subprocess.Popen([sys.executable, '-c', late])\n"
        "time.sleep(60)\n"
    )
    record = python(tmp_path, text, seconds=1.0)
    started = time.monotonic()
    ends = until_decided(record, [S1])
    assert ends == {"S1": "was stopped after 1 s"}
    assert time.monotonic() - started < 30.0
    assert len(record.submission.runs) == 1  # no smaller step helps
    time.sleep(2.5)
    assert not late.exists()


@pytest.mark.skipif(sys.platform != "linux", reason="limits of memory are those of a POSIX shell")
def test_a_run_that_takes_too_much_memory_fails(tmp_path):
    text = "held = bytearray(2**31)\n"
    assert "MemoryError" in python(tmp_path, text, memory=1.0).run_of(S1, 8, 1e-3).failure
    enough = python(tmp_path, text, memory=16.0).run_of(S1, 16, 1e-3)
    assert enough.failure == "ended well, and wrote no file m016_h1e-3.csv"


def test_no_run_begins_when_the_budget_is_spent(script, tmp_path):
    record = Record(tmp_path / "mine", Program(command=script(size=10.0)), "mine")
    assert until_decided(record, [S1], budget=1e-6) == {"S1": "the budget is spent"}
    assert len(calls(tmp_path)) == 1


@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        ("", "is empty: begin with the header time,q"),
        ("time,q\n0.0,nan\n", "nan"),
        ("time,q\n0.000000,1.000000\n0.010000,2.000000\n", "lasts 15 s: run it whole"),
        ("t;q\n0;1\n", "semicolons"),
    ],
)
def test_a_file_that_cannot_be_judged_is_a_failure_and_no_file(tmp_path, content, sentence):
    text = f"import sys\nopen(sys.argv[4], 'w').write({content!r})\n"
    record = python(tmp_path, text)
    failure = record.run_of(S1, 8, 1e-3).failure
    assert failure.startswith("writes what cannot be judged: ")
    assert sentence in failure
    assert sorted(p.name for p in (tmp_path / "mine").iterdir()) == ["entry.toml", "runs.csv"]
    assert read_submission(tmp_path / "mine").runs[0].failure == failure


def test_a_table_without_rows_of_the_mesh_is_a_failure(tmp_path):
    text = (
        "import sys\n"
        "open(sys.argv[4], 'w').write('elements,speed,frequency\\n4,6.0,3.731123456\\n')\n"
    )
    (first, *_) = python(tmp_path, text).rows_of(L, 8)
    assert first.failure == "writes no row of 8 elements into L.csv"
    assert not python(tmp_path, text).rows_of(L, 4)[0].failure
    assert {one.elements for one in read_submission(tmp_path / "mine").rows} == {4, 8}


def test_an_interrupt_leaves_what_is_on_record_and_nothing_else(script, tmp_path, monkeypatch):
    record = Record(tmp_path / "mine", Program(command=script()), "mine")
    record.run_of(S1, 8, 1e-3)

    def interrupted(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr("subprocess.Popen.wait", interrupted)
    with pytest.raises(KeyboardInterrupt):
        record.run_of(S1, 16, 1e-3)
    names = sorted(p.name for p in (tmp_path / "mine").iterdir())
    assert names == ["S1", "entry.toml", "runs.csv"]
    assert len(read_submission(tmp_path / "mine").runs) == 1


@pytest.mark.parametrize(
    ("command", "limits", "sentence"),
    [
        ("true", {}, r"must have \{case\} and \{elements\}"),
        ("true {case} {elements}", {}, r"and \{step\} or \{tolerance\}"),
        ("true {case} {elements} {step} {tolerance}", {}, r"and \{step\} or \{tolerance\}"),
        ("true {case} {elemnts} {step}", {}, r"has \{elemnts\}; did you mean \{elements\}"),
        ("./no-such-code {case} {elements} {step}", {}, "no program './no-such-code'"),
        ("true {case} {elements} {step}", {"seconds": float("nan")}, "seconds must be"),
        ("true {case} {elements} {step}", {"seconds": 0.0}, "seconds must be"),
        ("true {case} {elements} {step}", {"memory": -1.0}, "memory must be"),
        ("true '{case} {elements} {step}", {}, "No closing quotation"),
    ],
)
def test_bad_commands(command, limits, sentence):
    with pytest.raises(ValueError, match=sentence):
        Program(command=command, **limits)


@pytest.mark.parametrize("given", [{"elements": 2.5}, {"elements": True}, {"step": -1e-3}])
def test_bad_starts(tmp_path, given):
    record = Record(tmp_path / "mine", Program(command=f"true {OUT}"), "mine")
    with pytest.raises((TypeError, ValueError), match="elements|step"):
        until_decided(record, [S1], **given)


def test_nothing_of_a_submission_is_run(script, tmp_path):
    """An entry.toml that names a command has an unknown key, which is refused."""
    folder = Path(tmp_path, "mine")
    folder.mkdir()
    (folder / "entry.toml").write_text('benchmark = "1.1"\ncode = "x"\ncommand = "rm -r x"\n')
    (folder / "L.csv").write_text("elements,speed,frequency\n8,6.0,3.731123456\n")
    with pytest.raises(ValueError, match="unknown key 'command'"):
        Record(folder, Program(command=script()), "mine")
