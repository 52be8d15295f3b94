"""However a command ends: no leavings, no traceback, sentences that are printed as they are."""

import io
import os
import resource
import signal
import subprocess
import sys
import warnings
from contextlib import contextmanager, suppress

import pytest
import xarray as xr
from matplotlib.animation import PillowWriter

from analytic.input_checks import RotbeamWarning
from rotbeam_exu import save
from rotbeam_exu.cli import INTERNAL
from rotbeam_exu.cli import backbone as job
from rotbeam_exu.cli.output import write_utf8
from rotbeam_exu.files.results import whole_file, writable_folder

BACKBONE = ("backbone", "--omega", "6", "--amplitude", "0.1")


@contextmanager
def files_of_at_most(size):
    """As on a disk that is full: each file ends there."""
    before, cached = resource.getrlimit(resource.RLIMIT_FSIZE), sys.dont_write_bytecode
    sys.dont_write_bytecode = True  # half a module in a cache would be read by the next
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
        sys.dont_write_bytecode = cached


def test_ctrl_c_while_a_film_is_drawn(call, tmp_path, monkeypatch):
    """In the first picture matplotlib's writer had nothing to finish, and said so instead."""

    def interrupted(self, **options):
        raise KeyboardInterrupt

    monkeypatch.setattr(PillowWriter, "grab_frame", interrupted)
    monkeypatch.setattr(PillowWriter, "finish", lambda _: pytest.fail("wrote half a film"))
    film = ("--ramp-time", "1", "--duration", "1", "--rate", "3", "-o", tmp_path / "film.gif")
    code, _, error = call("animate", *film)
    assert (code, error) == (130, "rotbeam: interrupted; nothing was written\n")
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("error", [ImportError, RuntimeError])
def test_ctrl_c_that_a_library_tells_as_its_own_error(call, monkeypatch, error):
    """As Exudyn does while it is imported, and while its model is made."""

    def interrupted(*_, **__):
        with suppress(KeyboardInterrupt):
            signal.raise_signal(signal.SIGINT)
        raise error("initialization failed")

    before = signal.getsignal(signal.SIGINT)
    monkeypatch.setattr(job, "_print_coefficients", interrupted)
    assert call(*BACKBONE)[::2] == (130, "rotbeam: interrupted; nothing was written\n")
    assert signal.getsignal(signal.SIGINT) is before


def test_a_full_disk_names_the_file(tmp_path):
    data = xr.Dataset({"q": ("time", [0.0] * 4000)}, {"time": [float(k) for k in range(4000)]})
    with files_of_at_most(8192), pytest.raises(OSError, match=r"File too large: .*run\.nc"):
        save(data, tmp_path / "run.nc")
    with pytest.raises(FileNotFoundError, match="another"), whole_file(tmp_path / "run.nc"):
        (tmp_path / "another").read_bytes()
    assert not list(tmp_path.iterdir())
    # It is willing to make a file, and then to write nothing into it.
    with files_of_at_most(0), pytest.raises(OSError, match="cannot write to the folder .* choose"):
        writable_folder(tmp_path)


@pytest.mark.parametrize(("failure", "code"), [(ValueError, 2), (RuntimeError, 1)])
def test_warnings_and_the_reason_of_a_failure_are_a_line_each(call, monkeypatch, failure, code):
    def failing(*_, **__):
        for text in ("1 is\nsmall", "1 is\nsmall", "2 is small"):
            with warnings.catch_warnings():
                warnings.warn(text, RotbeamWarning, stacklevel=2)
        raise failure("no")

    monkeypatch.setattr(job, "_print_coefficients", failing)
    for _ in range(2):  # what one command has said, the next says too
        found, _, error = call(*BACKBONE)
        assert found == code
        assert error.splitlines() == ["warning: 1 is small", "warning: 2 is small", "rotbeam: no"]


@pytest.mark.parametrize("error", [IndexError("7"), KeyError("x"), AssertionError(), EOFError()])
def test_an_error_of_the_program_has_an_exit_code_of_its_own(call, monkeypatch, error):
    """It was a traceback, and the code of a run that fails."""

    def failing(*_, **__):
        raise error

    monkeypatch.setattr(job, "_print_coefficients", failing)
    code, _, said = call(*BACKBONE)
    assert code == INTERNAL == 70
    assert said.startswith(f"rotbeam: internal error, not of your input: {type(error).__name__}")
    assert len(said.splitlines()) == 1
    assert "test_endings.py:" in said


def test_a_pipe_that_nobody_reads_is_no_failed_run():
    """Of the judge 1 would be a code that differs."""
    unread, pipe = os.pipe()
    os.close(unread)
    command = [sys.executable, "-m", "rotbeam_exu.cli", "doctor"]
    done = subprocess.run(command, stdout=pipe, stderr=subprocess.PIPE, check=False)
    os.close(pipe)
    assert (done.returncode, done.stderr) == (141, b"")


def test_paths_are_no_markup(call, tmp_path):
    for name in ("a [red] b", "[/]", "[link=x]y"):
        code, _, error = call("run", "--config", tmp_path / f"{name}.toml")
        assert code == 2
        assert f"{name}.toml" in error
    out = tmp_path / "a [red] [bold] :smile:"
    short = ("--elements", "1", "--step", "0.01", "--duration", "8", "--no-figure")
    code, printed, _ = call("run", *short, "--out", out)
    assert code == 0
    assert f"{out}/cable-1-omega-6-ramp-3.nc" in printed


def test_pipes_and_files_of_windows_take_every_letter(monkeypatch):
    raw = io.BytesIO()
    monkeypatch.setattr(sys, "stdout", io.TextIOWrapper(raw, encoding="cp1252"))
    write_utf8()
    sys.stdout.write("ω_NL ± λ \udcff")
    sys.stdout.flush()
    assert raw.getvalue().decode("utf-8") == "ω_NL ± λ ?"
