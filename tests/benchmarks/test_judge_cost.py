"""What it costs to judge a whole submission; meant for a machine that does nothing else."""

import os
import resource
import subprocess
import sys

import numpy as np
import pytest

from analytic.theory import BERNOULLI_EULER
from rotbeam_exu.verification.case import Asked
from rotbeam_exu.verification.cases import CASES
from rotbeam_exu.verification.references import reference
from rotbeam_exu.verification.submission import Declaration, Row, Run, Submission
from rotbeam_exu.verification.submission_files import write_submission

pytestmark = pytest.mark.benchmarks

MESHES, STEPS = (8, 16, 32), (5e-4, 1e-3, 2e-3)


def whole(factor):
    """All cases of thin beams in the plane, five histories each at 2 ms; q(t) times a factor."""
    runs, rows = [], []
    resolutions = [(n, 1e-3) for n in MESHES] + [(16, h) for h in STEPS if h != 1e-3]
    for name, case in CASES.items():
        if case.in_space or name in {"T", "TL"}:
            continue  # other theories' cases
        truth = reference(case, BERNOULLI_EULER)
        if case.asked is Asked.FREQUENCIES:
            rows += [
                Row(elements=n, speed=w, values=(truth.first_frequency(w) + 0.01 / n**2,))
                for n in MESHES
                for w in case.speeds
            ]  # fmt: skip
        elif case.asked is Asked.BACKBONE:
            rows += [
                Row(
                    case="B",
                    elements=n,
                    speed=w,
                    amplitude=a,
                    values=(float(truth.frequency_at(a, w)),),
                )
                for n in MESHES
                for w in case.speeds
                for a in case.amplitudes
            ]
        else:
            time = np.linspace(0.0, case.duration, round(500 * case.duration) + 1)
            q = truth.history(time)
            runs += [
                Run(
                    case=name, elements=n, step=h, time=time, wall=1.0,
                    q=factor * q * (1.0 + 0.1 / n**2 + 100.0 * h**2),
                )
                for n, h in resolutions
            ]  # fmt: skip
    return Submission(
        declaration=Declaration(code="mine", order=2.0, order_in_step=2.0),
        rows=tuple(rows), runs=tuple(runs),
    )  # fmt: skip


def cpu_of(*arguments, threads=None, code=0):
    """CPU of a call of the command line [s], and what it prints."""
    given = {name: one for name, one in os.environ.items() if not name.endswith("_NUM_THREADS")}
    given |= {"OMP_NUM_THREADS": threads, "OPENBLAS_NUM_THREADS": threads} if threads else {}
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    call = [sys.executable, "-m", "rotbeam_exu.cli", *map(str, arguments)]
    run = subprocess.run(call, env=given, capture_output=True, text=True, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    assert run.returncode == code, run.stderr
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return seconds, run.stdout


@pytest.mark.parametrize("threads", ["1", None])
@pytest.mark.parametrize("factor", [1.0, -1.0])
def test_a_whole_submission_is_judged_in_ten_seconds(tmp_path, factor, threads):
    """Right, and with the wrong sign in all cases, which is looked for and named."""
    folder = write_submission(whole(factor), tmp_path / "mine")
    seconds, out = cpu_of("judge", folder, threads=threads, code=int(factor < 0.0))
    assert out.count("usual mistake?") == (factor < 0.0)
    assert seconds < 10.0


def test_one_case_is_judged_in_a_second_beyond_the_start(tmp_path):
    folder = write_submission(whole(1.0), tmp_path / "mine")
    start, _ = cpu_of("judge", "--help")
    seconds, out = cpu_of("judge", folder, "--case", "S1")
    assert "S1 q(t)" in out
    assert "S2" not in out
    assert seconds - start < 1.0
