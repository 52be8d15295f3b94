"""What the page is made of and the command that writes it, without a browser."""

import json
import os
import signal
import subprocess
import sys
import time
from concurrent.futures import Executor, Future
from contextlib import nullcontext
from pathlib import Path

import numpy as np
import pytest

from analytic import AmplitudeNotReachedError, periodic_orbits
from rotbeam_exu import explorer
from rotbeam_exu.cli import main
from rotbeam_exu.explorer import data as room
from rotbeam_exu.explorer import explorer_data, explorer_page
from tests.beams import REED_TOML

ROOT = Path(__file__).parents[2]


def test_uneven_sliders_and_ramps_that_outlast_the_page_are_refused():
    for options, sentence in (
        ({"omegas": [0.0, 1.0, 3.0]}, "omegas must ascend in equal steps"),
        ({"amplitudes": [0.2, 0.1]}, "amplitudes must ascend in equal steps"),
        *(({"exact_ramp_times": wrong}, "exact_ramp_times must ascend and end before")
          for wrong in ([3.0, 2.0], [3.0, 15.0], [])),
    ):  # fmt: skip
        with pytest.raises(ValueError, match=sentence):
            explorer_data(**options)


class OneOfMany(Executor):
    """Has done the first task, failed in the second, and begins no other."""

    def __init__(self):
        self.futures = []

    def submit(self, *task):
        self.futures.append(future := Future())
        if len(self.futures) == 1:
            future.set_result("an orbit")
        elif len(self.futures) == 2:
            future.set_exception(RuntimeError("died"))
        return future


def test_what_ctrl_c_cancels_is_not_counted_as_done(monkeypatch):
    def interrupted(*_, **__):
        raise KeyboardInterrupt

    counted, pool = [], OneOfMany()
    monkeypatch.setattr(room, "worker_pool", lambda *_: nullcontext(pool))
    monkeypatch.setattr(room, "sweep", interrupted)
    with pytest.raises(KeyboardInterrupt):
        explorer_data(progress=lambda done, total: counted.append(done))
    assert len(pool.futures) > 100
    assert all(future.done() for future in pool.futures)
    assert counted == [1]


@pytest.mark.filterwarnings("ignore::analytic.input_checks.RotbeamWarning")
def test_harmonics_left_out_are_small(beam, data):
    for omega in (0.0, 6.0, 12.0):
        kept = data["harmonics"].sel(omega=omega, a=0.6).to_numpy()
        all_of_them = periodic_orbits(beam, omega, [0.6]).harmonics[0]
        assert np.abs(kept[: all_of_them.size] - all_of_them[: kept.size]).max() < 1e-7
        assert np.abs(all_of_them[kept.size :]).sum() < 1e-6


def test_orbits_that_are_not_found_leave_a_gap(beam, monkeypatch):
    def not_the_last(beam, omega, amplitudes):
        raise AmplitudeNotReachedError("drifts", periodic_orbits(beam, omega, amplitudes[:-1]))

    monkeypatch.setattr(room, "periodic_orbits", not_the_last)
    found = room.exact_orbits(beam, 4.0, (0.1, 0.2, 0.3))
    assert np.isnan(found["exact_frequency"]).to_numpy().tolist() == [False, False, True]
    assert np.isnan(found["axis_x"].to_numpy()[2]).all()


def test_nothing_in_the_data_ends_the_script(data):
    nasty = data.copy()
    nasty["note"] = nasty["note"].astype(object)
    nasty["note"][:] = "</script><b>"
    page = explorer_page(nasty)
    assert page.count("</script>") == 2  # the theme's, before anything is drawn, and the page's
    document = page.split("const DATA = ", 1)[1].split(";\n", 1)[0]
    assert json.loads(document)["notes"][0] == "</script><b>"


def test_it_writes_one_page_and_says_where(call, tmp_path, monkeypatch):
    """A beam of a file has one of its own name."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(explorer, "explorer_data", lambda *_, **__: None)
    monkeypatch.setattr(explorer, "explorer_page", lambda _: "<!doctype html>ω")
    assert "site/explorer.html" in call("explore", "--out", "site/explorer.html")[1]
    (page,) = (tmp_path / "site").iterdir()
    assert page.read_text(encoding="utf-8") == "<!doctype html>ω"
    (tmp_path / "reed.toml").write_text(REED_TOML)
    assert "explorer-reed.html" in call("explore", "--config", "reed.toml")[1]


@pytest.mark.slow
def test_the_whole_page_is_small_enough(tmp_path):
    out = tmp_path / "explorer.html"
    main(["explore", "--out", str(out), "--jobs", "2"])
    assert 1e6 < out.stat().st_size < 6e6


def started_by(parent):
    """Return the processes that one has started."""
    return Path(f"/proc/{parent}/task/{parent}/children").read_text().split()


# The first child tracks the semaphores, the second is a worker that has not begun.
@pytest.mark.parametrize("instant", ["a worker starts", "a piece is done"])
@pytest.mark.slow
def test_ctrl_c_of_a_terminal_is_one_sentence(tmp_path, instant):
    """It goes to the command and to its workers, wherever these are."""
    job = subprocess.Popen(
        [sys.executable, "-m", "rotbeam_exu.cli", "explore", "--jobs", "2"],
        cwd=tmp_path, env={**os.environ, "PYTHONPATH": str(ROOT)}, start_new_session=True,
        text=True, stderr=subprocess.PIPE, stdout=subprocess.DEVNULL,
        # A shell's background ignores Ctrl-C.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),  # noqa: PLW1509
    )  # fmt: skip
    if instant == "a worker starts":
        while len(started_by(job.pid)) < 2:
            time.sleep(0.005)
    else:
        assert "exact orbits and spin-ups: " in job.stderr.readline()
    os.killpg(job.pid, signal.SIGINT)
    *lines, last = job.communicate(timeout=60)[1].splitlines()
    assert (job.returncode, last) == (130, "rotbeam: interrupted; nothing was written")
    assert all(line.startswith("exact orbits and spin-ups: ") for line in lines)
    assert not list(tmp_path.iterdir())
