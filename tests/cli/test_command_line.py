"""`rotbeam` as a user meets it."""

import os
import runpy
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from rotbeam_exu import load

REPOSITORY = Path(__file__).parents[2]
SHORT = ["--elements", "4", "--step", "0.005", "--duration", "8"]


def test_the_script_is_the_command_that_writes_four_files(tmp_path, capsys, monkeypatch):
    script = REPOSITORY / "models" / "rotating_beam.py"
    monkeypatch.setattr(sys, "argv", [str(script), *SHORT, "--out", str(tmp_path)])
    runpy.run_path(str(script), run_name="__main__")
    assert "nonlinear effect" in capsys.readouterr().out
    assert sorted(path.suffix for path in tmp_path.iterdir()) == [
        ".csv",
        ".json",
        ".nc",
        ".pdf",
        ".png",
    ]
    assert load(next(tmp_path.glob("*.nc"))).attrs["elements"] == 4


def seconds_used_by(pid):
    """CPU time of a process [s]."""
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return sum(map(int, fields[11:13])) / os.sysconf("SC_CLK_TCK")


@pytest.mark.parametrize("frame", ["inertial", pytest.param("rotating", marks=pytest.mark.slow)])
def test_interrupt_stops_the_solver_and_leaves_nothing(tmp_path, frame):
    job = subprocess.Popen(
        [sys.executable, "-m", "rotbeam_exu.cli", "run", "--step", "1e-5", "--frame", frame,
         "--out", tmp_path],
        cwd=REPOSITORY, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        env={**os.environ, "PYTHONUNBUFFERED": "1"},
        # A shell's background jobs, and what they start, ignore Ctrl-C.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),  # noqa: PLW1509
    )  # fmt: skip
    try:
        # Well into the solver, however busy the machine: to import takes a second at most.
        while seconds_used_by(job.pid) < 1.5:
            assert job.poll() is None
            time.sleep(0.05)
        job.send_signal(signal.SIGINT)
        asked = time.monotonic()
        _, error = job.communicate(timeout=30.0)
        waited = time.monotonic() - asked
    finally:
        job.kill()
    assert job.returncode == 130
    assert "interrupted" in error
    assert not list(tmp_path.iterdir())
    # 0.4 s on a free machine, most of it Python's own exit; on a loaded one more. A solver that
    # does not listen would go on for minutes.
    assert waited < 10.0


def test_doctor(call):
    printed = call("doctor")[1]
    assert "figure        drawn" in printed
    assert "spin-up       passed" in printed
