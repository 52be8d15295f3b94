"""However a command ends: no leavings, no traceback, a sentence that names the file."""

import io
import os
import resource
import signal
import subprocess
import sys
from contextlib import contextmanager, redirect_stdout
from pathlib import Path

import pytest
import xarray as xr
from matplotlib.animation import PillowWriter

from rotbeam_exu import save
from rotbeam_exu.cli import endings, main
from rotbeam_exu.files.results import whole_file, writable_folder

ROOT = Path(__file__).parents[2]
FILM = ("animate", "--ramp-time", "1", "--duration", "2", "--rate", "3", "--out")


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


def test_signals_are_ctrl_c_once_and_only_while_a_command_runs(monkeypatch):
    before = [signal.getsignal(one) for one in (signal.SIGTERM, signal.SIGHUP)]
    with endings.stopped_as_by_ctrl_c() as met:
        with pytest.raises(KeyboardInterrupt):
            signal.raise_signal(signal.SIGTERM)
        # What is removed now is removed to the end.
        signal.raise_signal(signal.SIGTERM)
        signal.raise_signal(signal.SIGHUP)
    assert met == [signal.SIGTERM]
    assert [signal.getsignal(one) for one in (signal.SIGTERM, signal.SIGHUP)] == before


def test_what_nohup_ignores_stays_ignored():
    before = signal.signal(signal.SIGHUP, signal.SIG_IGN)
    try:
        with endings.stopped_as_by_ctrl_c() as met:
            signal.raise_signal(signal.SIGHUP)
        assert met == []
    finally:
        signal.signal(signal.SIGHUP, before)


@pytest.mark.parametrize("picture", [0, 2])
def test_ctrl_c_while_a_film_is_drawn(call, tmp_path, monkeypatch, picture):
    """In the first picture matplotlib's writer had nothing to finish, and said so instead."""
    grab, drawn = PillowWriter.grab_frame, []

    def interrupted(self, **options):
        if len(drawn) == picture:
            raise KeyboardInterrupt
        drawn.append(grab(self, **options))

    monkeypatch.setattr(PillowWriter, "grab_frame", interrupted)
    monkeypatch.setattr(PillowWriter, "finish", lambda _: pytest.fail("wrote half a film"))
    code, _, error = call(*FILM, tmp_path / "film.gif")
    assert (code, error) == (130, "rotbeam: interrupted; nothing was written\n")
    assert not list(tmp_path.iterdir())


def test_a_full_disk_names_the_file(call, tmp_path):
    target = tmp_path / "film.gif"
    with files_of_at_most(8192):
        code, _, error = call(*FILM, target)
    assert code == 2
    said = "File too large; make room, or write elsewhere"
    assert error == f"rotbeam: cannot write {target}: {said}\n"
    assert not list(tmp_path.iterdir())


def test_the_library_names_the_file_as_well(tmp_path):
    data = xr.Dataset({"q": ("time", [0.0] * 4000)}, {"time": [float(k) for k in range(4000)]})
    with files_of_at_most(8192), pytest.raises(OSError, match=r"File too large: .*run\.nc"):
        save(data, tmp_path / "run.nc")
    with pytest.raises(FileNotFoundError, match="another"), whole_file(tmp_path / "run.nc"):
        (tmp_path / "another").read_bytes()
    assert not list(tmp_path.iterdir())


def test_a_full_disk_is_found_out_ahead_of_the_work(tmp_path):
    """It is willing to make a file, and then to write nothing into it."""
    with files_of_at_most(0), pytest.raises(OSError, match="cannot write to the folder .* choose"):
        writable_folder(tmp_path)


def test_the_kit_names_its_folder_on_a_full_disk(call, tmp_path):
    with files_of_at_most(8192):
        code, _, error = call("kit", tmp_path / "kit")
    assert code == 2
    assert f"cannot write to {tmp_path}: File too large; choose another folder" in error
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("buffered", [True, False])
def test_standard_output_that_takes_no_more_is_named(monkeypatch, capsys, buffered):
    raw = Path("/dev/full").open("wb", buffering=0)  # noqa: SIM115
    stream = io.BufferedWriter(raw) if buffered else raw
    full = io.TextIOWrapper(stream, encoding="utf-8", write_through=not buffered)
    with redirect_stdout(full), pytest.raises(SystemExit) as stop:
        main(["table", "4"])
    assert stop.value.code == 2
    error = capsys.readouterr().err
    assert "rotbeam: cannot write to standard output" in error
    assert "No space left on device; " in error
    # What Python writes at its exit goes nowhere, and into no second complaint.
    full.close()


def test_closed_outputs_are_no_reason_to_stop():
    """As by >&- and 2>&-: what is None is not written to, and no file takes the number."""
    text = (
        "import os, sys; from rotbeam_exu.cli import main; main(['table', '4']); "
        "print('lost', file=sys.stderr); "
        "assert os.readlink('/proc/self/fd/1') == os.readlink('/proc/self/fd/2') == os.devnull"
    )
    done = subprocess.run(
        ["sh", "-c", f'"{sys.executable}" -c "{text}" >&- 2>&-'], cwd=ROOT, check=False,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
    )  # fmt: skip
    assert done.returncode == 0


def test_a_file_that_may_not_be_read_is_named():
    said = endings.sentence_on(PermissionError(13, "Permission denied", "beam.toml"))
    assert said == "beam.toml: Permission denied; check that it is there, and who may read and " \
                   "write it"  # fmt: skip
    assert endings.sentence_on(OSError("a sentence of ours")) == "a sentence of ours"
