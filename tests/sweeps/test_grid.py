"""Sweeps: same numbers however they are run, nothing lost, failures on record."""

import json
import os
import shutil
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import (
    CancelledError,
    Executor,
    Future,
    ProcessPoolExecutor,
    ThreadPoolExecutor,
)
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from analytic import SpinUp
from analytic.input_checks import RotbeamWarning
from rotbeam_exu import SimulationError, simulate, steady_oscillation, sweep
from rotbeam_exu.fem.elements import Cable
from rotbeam_exu.fem.linearization import Linearization
from rotbeam_exu.sweeps import grid as sweeps
from rotbeam_exu.sweeps.cases import worker_pool

SMALL = {"omegas": [4.0, 6.0], "ramp_times": [3.0, 2.0]}
COARSE = {"elements": 2, "step": 1e-2, "duration": 9.0}


@pytest.fixture(scope="module")
def finished(tmp_path_factory):
    return tmp_path_factory.mktemp("finished")


@pytest.fixture(scope="module")
def solved():
    """What was computed, by case."""
    return {}


@pytest.fixture(scope="module")
def serial(beam, finished, solved):
    """The sweep that is computed once; it fills the cache `finished`."""
    solve = sweeps.solve

    def kept(case):
        return solved.setdefault(json.dumps(case.describe()), solve(case))

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(sweeps, "solve", kept)
        return sweep(beam, **SMALL, **COARSE, jobs=1, cache=finished)


@pytest.fixture
def at_once(serial, solved, monkeypatch):
    """Its cases are not computed again; each result is a copy, as of a process."""
    monkeypatch.setattr(sweeps, "solve", lambda case: solved[json.dumps(case.describe())].copy())


@pytest.fixture
def cache(serial, finished, tmp_path):
    """The cache of the finished sweep, a copy for each test."""
    return shutil.copytree(finished, tmp_path / "cache")


def test_a_sweep_is_its_runs(beam, serial):
    run = simulate(beam, SpinUp(omega=6.0, ramp_time=2.0), **COARSE)
    steady = steady_oscillation(run)
    here = serial.sel(omega=6.0, ramp_time=2.0)
    assert here["frequency"].item() == steady.frequency
    assert here["amplitude"].item() == steady.amplitude
    assert here["omega_n"].item() == Linearization.of(beam, 6.0, "cable", 2).frequencies(1)[0]
    assert here["verdict"].item() == "passed"


def test_processes_give_the_same_bits(beam, serial):
    """One case, for which one process starts; several come together in the tests of executors."""
    found = sweep(beam, omegas=[4.0], ramp_times=[2.0], **COARSE, jobs=2)
    xr.testing.assert_identical(found, serial.sel(omega=[4.0], ramp_time=[2.0]))


def test_a_finished_sweep_is_read_not_run(beam, serial, cache, monkeypatch):
    monkeypatch.setattr(sweeps, "solve", lambda case: pytest.fail("ran a finished case"))
    again = sweep(beam, **SMALL, **COARSE, cache=cache)
    xr.testing.assert_identical(again, serial)


def test_another_case_is_not_mistaken_for_a_finished_one(beam, cache, monkeypatch):
    ran = []
    monkeypatch.setattr(sweeps, "solve", lambda case: ran.append(case) or failed())
    sweep(beam, **SMALL, **{**COARSE, "elements": 3}, jobs=1, cache=cache, on_error="record")
    assert len(ran) == 4


def failed():
    return xr.Dataset(attrs={"verdict": "failed", "failure": "made up"})


@pytest.mark.usefixtures("at_once")
def test_a_damaged_file_is_named_set_aside_and_computed_again(beam, serial, cache):
    victim = sorted(cache.glob("*.nc"))[0]
    victim.write_bytes(victim.read_bytes()[:1000])
    with pytest.warns(RotbeamWarning, match=f"{victim.name}.*set aside as .*computed again"):
        again = sweep(beam, **SMALL, **COARSE, jobs=1, cache=cache)
    xr.testing.assert_identical(again, serial)
    assert victim.exists()
    assert victim.with_suffix(".damaged").stat().st_size == 1000


def test_a_failed_case_stays_on_record_with_its_sentence(beam, tmp_path):
    # 9 s end 0.5 s after the longer ramp: less than two cycles.
    grid = {"omegas": [6.0], "ramp_times": [3.0, 8.5], "jobs": 1}
    found = sweep(beam, **grid, **COARSE, on_error="record", cache=tmp_path)
    assert found["verdict"].to_numpy().tolist() == [["passed", "failed"]]
    assert "run for" in found["failure"].to_numpy()[0, 1]
    assert np.isnan(found["frequency"].to_numpy()[0, 1])
    assert list(sweeps.failures(found).values()) == [[(6.0, 8.5)]]
    sentence = r"omega = 6 rad/s, ramp_time = 8\.5 s: .*record"
    with pytest.raises(SimulationError, match=sentence):
        sweep(beam, **grid, **COARSE, cache=tmp_path)


@dataclass(frozen=True, kw_only=True)
class Misshapen(Cable):
    """An element with a mistake, as its author makes."""

    def axial_strain(self, beam, coordinates):
        return np.zeros(2) + np.zeros(3)


def test_a_mistake_in_an_element_is_no_failed_case(beam):
    with pytest.raises(ValueError, match="could not be broadcast together"):
        sweep(beam, **SMALL, **COARSE, jobs=1, element=Misshapen(), on_error="record")


def test_numbers_of_numpy_are_numbers(beam, serial, cache):
    known = {path.name for path in cache.glob("*.nc")}
    grid = {name: np.array(values) for name, values in SMALL.items()}
    coarse = {"elements": np.int64(2), "step": np.float64(1e-2), "duration": np.int64(9)}
    found = sweep(beam, **grid, **coarse, jobs=1, cache=cache)
    xr.testing.assert_identical(found, serial)
    assert {path.name for path in cache.glob("*.nc")} == known


class DyingPool(Executor):
    """Finishes its first task, and loses its worker or its scheduler with the second."""

    def __init__(self, error):
        self.tasks, self.error = 0, error

    def submit(self, function, /, *arguments, **options):
        future = Future()
        self.tasks += 1
        if self.tasks == 1:
            future.set_result(function(*arguments, **options))
        else:
            future.set_exception(self.error)
        return future


# Of Dask's client, whose scheduler is gone, the second.
@pytest.mark.usefixtures("at_once")
@pytest.mark.parametrize("error", [BrokenProcessPool("a worker died"), CancelledError()])
def test_a_dying_worker_loses_no_finished_case(beam, serial, tmp_path, error):
    said = "a worker process died, or its executor ended, with . of 4 cases to do; run again"
    with pytest.raises(SimulationError, match=said):
        sweep(beam, **SMALL, **COARSE, cache=tmp_path, executor=DyingPool(error))
    kept = {path: path.stat().st_mtime_ns for path in tmp_path.glob("*.nc")}
    assert len(kept) <= 1
    again = sweep(beam, **SMALL, **COARSE, cache=tmp_path, jobs=1)
    xr.testing.assert_identical(again, serial)
    assert all(path.stat().st_mtime_ns == time for path, time in kept.items())


@pytest.mark.usefixtures("at_once")
def test_any_executor_will_do(beam, serial):
    with ThreadPoolExecutor(1) as pool:
        found = sweep(beam, **SMALL, **COARSE, executor=pool)
    xr.testing.assert_identical(found, serial)


def idle():
    time.sleep(60.0)


@pytest.mark.parametrize("late", [False, True])
def test_an_interrupted_pool_ends_its_processes_and_its_thread_says_nothing(monkeypatch, late):
    """A process that dies while canceled work waits made the pool's thread end in a traceback."""
    said, shutdown = [], ProcessPoolExecutor.shutdown
    monkeypatch.setattr(threading, "excepthook", lambda given: said.append(given.exc_value))
    if late:  # as on a busy machine: whatever is ended before has ended

        def after_them(pool, **options):
            for process in list(pool._processes.values()):
                process.join(0.3)
            time.sleep(0.1)
            shutdown(pool, **options)

        monkeypatch.setattr(ProcessPoolExecutor, "shutdown", after_them)
    with pytest.raises(KeyboardInterrupt), worker_pool(None, 1, 9) as pool:
        futures = [pool.submit(idle) for _ in range(9)]
        processes = list(pool._processes.values())
        while not futures[1].running():  # one begins, one is ready, seven wait
            time.sleep(0.01)
        try:
            raise KeyboardInterrupt
        finally:
            for future in futures:
                future.cancel()
    assert not any(process.is_alive() for process in processes)
    assert said == []


def test_ctrl_c_does_not_meet_a_process_that_starts():
    """A terminal sends it to all, also to one that has not yet chosen what to do with it."""
    with pytest.raises(KeyboardInterrupt), worker_pool(None, 1, 1) as pool:
        pool.submit(idle)
        (process,) = pool._processes.values()
        os.kill(process.pid, signal.SIGINT)
        process.join(0.5)
        assert process.is_alive()
        raise KeyboardInterrupt


def living(group):
    """Processes of a group that have not ended."""
    found = []
    for status in Path("/proc").glob("[0-9]*/stat"):
        try:
            state, _, its_group = status.read_text().rpartition(")")[2].split()[:3]
        except OSError:
            continue
        if int(its_group) == group and state not in "ZX":
            found.append(status.parent.name)
    return found


@pytest.mark.parametrize(
    # Slow: nine seconds of processes. A worker that dies, and a run that is interrupted, are not.
    "signal_number",
    [signal.SIGKILL, signal.SIGINT],
)
@pytest.mark.slow
def test_a_killed_sweep_resumes_and_leaves_no_process(tmp_path, signal_number):
    arguments = [
        sys.executable, "-m", "rotbeam_exu.cli", "sweep", "--omega", "4", "6", "8",
        "--ramp-time", "3", "2", "--elements", "8", "--step", "0.002", "--duration", "12",
        "--cache", tmp_path / "cache", "--out", tmp_path / "out", "--jobs", "2",
    ]  # fmt: skip
    here = {"cwd": Path(__file__).parents[2], "start_new_session": True, "text": True}
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    job = subprocess.Popen(
        arguments, **here, **pipes,
        # A shell's background ignores Ctrl-C.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),  # noqa: PLW1509
    )  # fmt: skip
    deadline = time.monotonic() + 60.0
    while not (finished := list((tmp_path / "cache").glob("[0-9a-f]*.nc"))):
        assert time.monotonic() < deadline
        time.sleep(0.02)
    if signal_number == signal.SIGINT:
        os.killpg(job.pid, signal_number)  # as a terminal does
    else:
        job.send_signal(signal_number)
    _, error = job.communicate(timeout=20.0)
    if signal_number == signal.SIGINT:
        assert job.returncode == 130
        assert "Traceback" not in error
    deadline = time.monotonic() + 5.0
    while living(job.pid):
        assert time.monotonic() < deadline
        time.sleep(0.05)
    before = {path: path.stat().st_mtime_ns for path in finished}
    again = subprocess.run(arguments, **here, capture_output=True, timeout=120, check=False)
    assert again.returncode == 0, again.stderr
    assert all(path.stat().st_mtime_ns == time for path, time in before.items())
    assert len(list((tmp_path / "cache").glob("[0-9a-f]*.nc"))) == 6
    assert "solved" in again.stdout


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        ({"omegas": []}, "omegas must be a sequence of numbers"),
        ({"ramp_times": [3.0, 2.0, 3.0]}, "ramp_times holds 3 more than once"),
        ({"omegas": [-1.0]}, "omega must not be negative"),
        ({"on_error": "ignore"}, "unknown on_error 'ignore'"),
        ({"jobs": -1}, "jobs must be at least 1"),
        ({"jobs": True}, "jobs must be a whole number, got True"),
        ({"duration": 2.5}, "duration 2.5 s ends before .* begins at ramp_time 3 s; take a longer"),
        ({"element": "brick"}, "unknown element 'brick'"),
        ({"element": Cable}, "element must be the name of a formulation, or an instance"),
        ({"omegas": ["6"]}, "omegas must be numbers in rad/s"),
        ({"omegas": [6.0, np.nan]}, "omegas must be finite, got nan rad/s"),
        ({"omegas": [1e6]}, "leaves no steady state"),
    ],
)
def test_bad_input_is_refused_before_any_work(beam, monkeypatch, options, sentence):
    monkeypatch.setattr(sweeps, "solve", lambda case: pytest.fail("worked"))
    with pytest.raises((TypeError, ValueError), match=sentence):
        sweep(beam, **{**SMALL, **COARSE, "jobs": 1, **options})
