"""`rotbeam` as a user meets it."""

import os
import runpy
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from matplotlib.artist import Artist

from rotbeam_exu import load
from rotbeam_exu.cli import main
from rotbeam_exu.fem import simulation

REPOSITORY = Path(__file__).parents[2]
SHORT = ["--elements", "4", "--step", "0.005", "--duration", "8"]


def refused(capsys, *arguments):
    with pytest.raises(SystemExit) as stop:
        main(arguments)
    return stop.value.code, capsys.readouterr().err


def test_the_main_job_prints_a_summary_and_writes_four_files(tmp_path, capsys):
    main(["run", *SHORT, "--out", str(tmp_path)])
    summary = capsys.readouterr().out
    for word in (
        "natural frequency", "steady amplitude", "steady frequency", "exact ω_n", "exact ω_NL",
        "nonlinear effect", "constraint residual",
        "energy drift", "wall time", "verdict               checks passed",
    ):  # fmt: skip
        assert word in summary
    assert sorted(path.suffix for path in tmp_path.iterdir()) == [".csv", ".nc", ".pdf", ".png"]
    run = load(next(tmp_path.glob("*.nc")))
    assert run.attrs["elements"] == 4


def test_the_script_is_the_command(tmp_path, capsys, monkeypatch):
    script = REPOSITORY / "models" / "rotating_beam.py"
    assert len(script.read_text().splitlines()) < 40
    monkeypatch.setattr(sys, "argv", [str(script), *SHORT, "--out", str(tmp_path)])
    runpy.run_path(str(script), run_name="__main__")
    printed = capsys.readouterr()
    assert "verdict               checks passed" in printed.out
    # Four elements in steps of 5 ms cannot show the nonlinear effect, and say so.
    assert [line.partition(" is ")[0] for line in printed.err.splitlines()] == [
        "warning: the error of the mesh",
        "warning: the error of the step, and the mesh in the swing,",
    ]


def test_another_beam_from_toml(tmp_path, capsys):
    config = tmp_path / "beam.toml"
    config.write_text(
        "[beam]\nlength = 10\naxial_stiffness = 2.8e7\n"
        "bending_stiffness = 1.4e4\nmass_per_length = 1.2\n"
    )
    main(["run", *SHORT, "--config", str(config), "--out", str(tmp_path / "out")])
    assert "L = 10 m, EI = 14000 N m²" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("[beam]\nlenght = 8.0\n", "unknown key 'lenght' in [beam]; did you mean 'length'?"),
        ("[beam]\nlength = 8.0\n", "[beam] lacks area, second_moment, youngs_modulus, density"),
        ("[beem]\nlength = 8.0\n", "unknown table or key 'beem'"),
        ("length = \n", "is not valid TOML"),
        ("", "has no table [beam]"),
        (
            "[beam]\nlength = -8.0\narea = 1\nsecond_moment = 1\nyoungs_modulus = 1\ndensity = 1\n",
            "length must be positive, got -8.0 m",
        ),
    ],
)
def test_a_bad_beam_file_is_one_sentence(tmp_path, capsys, text, sentence):
    config = tmp_path / "beam.toml"
    config.write_text(text)
    code, error = refused(capsys, "run", "--config", str(config), "--out", str(tmp_path))
    assert code == 2
    assert sentence in error
    assert len(error.splitlines()) == 1


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["--ramp-time", "-2"], "ramp_time must be positive, got -2.0 s"),
        (["--omega", "nan"], "omega must be finite"),
        (["--duration", "2"], "duration 2 s ends before"),
        (["--step", "0"], "step must be positive"),
        (["--elements", "0"], "elements must be at least 1"),
        (["--elements", "many"], "many"),
        (["--element", "brick"], "unknown element 'brick'; known are 'cable'"),
        (["--config", "none.toml"], "there is no file none.toml"),
        (["--speed", "6"], "--speed"),
    ],
)
def test_bad_arguments_exit_with_2_and_one_sentence(tmp_path, capsys, arguments, sentence):
    code, error = refused(capsys, "run", "--out", str(tmp_path), *arguments)
    assert code == 2
    assert sentence in error
    assert "Traceback" not in error
    assert len(error.splitlines()) == 1


def test_an_unwritable_folder_is_found_before_the_simulation(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(simulation, "run_case", lambda *_, **__: pytest.fail("simulated first"))
    (tmp_path / "file").write_text("")
    code, error = refused(capsys, "run", "--out", str(tmp_path / "file"))
    assert code == 2
    assert "cannot write to the folder" in error


def test_a_failed_run_exits_with_1(tmp_path, capsys):
    code, error = refused(
        capsys, "run", "--step", "0.08", "--duration", "8", "--out", str(tmp_path)
    )
    assert code == 1
    assert "take a smaller step than 0.08 s" in error
    assert {path.stem for path in tmp_path.iterdir()} == {"cable-16-omega-6-ramp-3-failed"}


def test_rpm_is_a_warning_on_the_command_line(tmp_path, capsys):
    _, error = refused(capsys, "run", *SHORT, "--omega", "400", "--out", str(tmp_path))
    assert "warning: omega = 400 rad/s is 137 times" in error


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
    )  # fmt: skip
    try:
        # Well into the solver, however busy the machine: to import takes a second and a half.
        while seconds_used_by(job.pid) < 4.0:
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


def test_doctor(capsys):
    main(["doctor"])
    printed = capsys.readouterr().out
    assert "figure        drawn" in printed
    assert "spin-up       passed" in printed


def test_doctor_notices_a_matplotlib_that_cannot_draw(capsys, monkeypatch):
    """As 3.9 was, whose figures have no root."""
    monkeypatch.setattr(Artist, "get_figure", lambda self: self.figure)
    code, error = refused(capsys, "doctor")
    assert code == 1
    assert "cannot draw a figure" in error
    assert "--upgrade matplotlib" in error
