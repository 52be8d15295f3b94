"""What commands import: help and theory need neither Exudyn nor what else is slow to import.

One child process each, which asks for many commands one after the other.
"""

import json
import os
import subprocess
import sys

import pytest

from rotbeam_exu.cli import _COMMANDS
from rotbeam_exu.verification.kit import write_kit

SLOW = (
    "exudyn", "xarray", "pandas", "h5netcdf", "h5py", "matplotlib", "sympy", "scipy.linalg",
    "scipy.optimize", "scipy.interpolate", "scipy.sparse", "distributed",
)  # fmt: skip

ASK = """
import contextlib, io, json, sys
import analytic, rotbeam_exu.fem.elements
from rotbeam_exu.cli import main

def answer(line):
    out, error, code = io.StringIO(), io.StringIO(), 0
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(error):
        try:
            main(line.split())
        except SystemExit as stopped:
            code = stopped.code
    slow = sorted(set(json.loads(sys.argv[2])) & set(sys.modules))
    return {"code": code, "out": out.getvalue(), "error": error.getvalue(), "slow": slow}

if __name__ == "__main__":
    for name in sys.argv[3:]:
        sys.modules[name] = None  # an import of it raises ImportError
    answers = {line: answer(line) for line in json.loads(sys.argv[1])}
    sys.__stdout__.write(json.dumps(answers))
"""


NOT_TO_JUDGE = ("exudyn", "xarray", "pandas", "h5netcdf", "matplotlib", "sympy", "distributed")


def answers_of(lines, folder, *without):
    script = folder / "ask.py"
    script.write_text(ASK)
    run = subprocess.run(
        [sys.executable, str(script), json.dumps(lines), json.dumps(SLOW), *without],
        cwd=folder, env={**os.environ, "PYTHONWARNINGS": "default"}, capture_output=True,
        text=True, encoding="utf-8", check=False,
    )  # fmt: skip
    assert run.returncode == 0, run.stderr
    return json.loads(run.stdout)


HELPS = ["--help", *(f"{command} --help" for command in _COMMANDS)]
PRINTING = ["backbone --omega 6 --variant FrM", "campbell --points 3 --count 2", "table 1"]
THEORY = {
    "table 3": "Table 3",
    "backbone --omega 6 --all-variants --exact --amplitude 0.1": "exact",
    "campbell --points 3 --count 2": "Crossings",
    "ramp --omega 2 --longest 4 --points 1 --finite-element-points 0 -o out": "written",
    "stability --omega 6 --section tube --amplitude 0.02 -o out": "written",
    "reference --samples 11 --duration 4 --tolerance 1e-3 -o out": "written",
    "respond --tip-force 1e-3 --omega 6 --damping-ratio 0.1 --from 3 --to 3.1 --points 2 "
    "--no-figure -o out": "written",
    "animate --duration 0.1 --rate 10 -o out/film.gif": "written",
    "figure 13 -o out": "written",
    "kit out/kit": "files in",
    "explore -o out/explorer.html": "written",
    "judge out/kit/sample --report out/page.html": "outcome",
}
NEEDS_EXUDYN = (
    "run --elements 2 -o out", "verify --element cable", "compare -o out",
    "ramp --omega 2 --longest 4 --points 1 -o out/other",
)  # fmt: skip


# A second each, of the theory that the others ask as well.
DEAR = ("backbone", "campbell", "ramp", "respond", "stability", "figure", "table", "kit", "judge")


def check_theory(got):
    for line in THEORY.keys() & got:
        assert (line, got[line]["code"], got[line]["error"]) == (line, 0, got[line]["error"])
        assert THEORY[line] in got[line]["out"]


@pytest.mark.slow
def test_all_theory_works_without_exudyn(tmp_path):
    dear = [line for line in THEORY if line.startswith(DEAR)]
    check_theory(answers_of(dear, tmp_path, "exudyn"))


def test_without_exudyn_theory_works_and_the_rest_says_what_is_missing(tmp_path):
    """Help imports nothing slow, nor do the packages; what only prints, no xarray.

    In this order, for what one has imported stays.
    """
    quick = [line for line in THEORY if not line.startswith(DEAR)]
    lines = [*HELPS, *PRINTING, *quick, "doctor", *NEEDS_EXUDYN]
    got = answers_of(lines, tmp_path, "exudyn")
    for line in HELPS:
        assert (line, got[line]["code"], got[line]["slow"]) == (line, 0, ["exudyn"])
        assert "Usage" in got[line]["out"]
    assert {line: got[line]["code"] for line in PRINTING} == dict.fromkeys(PRINTING, 0)
    not_theory = {"xarray", "pandas", "h5netcdf", "h5py", "matplotlib", "distributed"}
    assert not set(got["table 1"]["slow"]) & not_theory
    assert "sympy" not in got["campbell --points 3 --count 2"]["slow"]
    check_theory(got)
    assert got["doctor"]["code"] == 0
    assert "not run: Exudyn cannot be imported" in got["doctor"]["out"]
    for line in NEEDS_EXUDYN:
        assert got[line]["code"] == 2
        assert "Exudyn cannot be imported" in got[line]["error"]
        assert "Traceback" not in got[line]["error"]
    assert "--finite-element-points 0" in got[NEEDS_EXUDYN[-1]]["error"]


def test_the_judge_does_without_what_only_models_and_figures_need(tmp_path):
    """As docs/howto/judge.md installs it; the last line has a mistake to be looked for."""
    wrong = write_kit(tmp_path / "wrong") / "sample"
    for history in (wrong / "S1").iterdir():
        head, *rows = history.read_text(encoding="utf-8").splitlines()
        cells = (row.split(",") for row in rows)
        rows = [",".join([time, f"{-float(q):.12g}", *rest]) for time, q, *rest in cells]
        history.write_text("\n".join([head, *rows]), encoding="utf-8")
    lines = ["kit kit", "judge kit/sample --report page.html --json found.json"]
    with_a_mistake = "judge wrong/sample --case S1"
    got = answers_of([*lines, with_a_mistake], tmp_path, *NOT_TO_JUDGE)
    assert {line: got[line]["code"] for line in lines} == dict.fromkeys(lines, 0)
    page = (tmp_path / "page.html").read_text(encoding="utf-8")
    assert "pip install matplotlib xarray" in page
    assert "<figure" not in page
    assert json.loads((tmp_path / "found.json").read_text(encoding="utf-8"))["passed"]
    judged = got[with_a_mistake]
    assert (judged["code"], judged["error"]) == (1, "")
    assert "S1: a usual mistake?" in judged["out"]
