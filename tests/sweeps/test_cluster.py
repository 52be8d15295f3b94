"""A sweep on a Dask cluster: a worker dies, the scheduler dies, two clients share a cache."""

import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, contextmanager
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from analytic import linear_modes
from analytic.sensitivity import sampled
from rotbeam_exu import SimulationError, load, sweep

distributed = pytest.importorskip("distributed", reason="no Dask: install the extra cluster")
pytestmark = pytest.mark.slow  # ten seconds or more each: processes start, or are missed

ROOT = Path(__file__).parents[2]
CASES = {"omegas": [2.0, 4.0, 6.0, 8.0], "ramp_times": [2.0, 2.5, 3.0]}
COARSE = {"elements": 2, "step": 1e-2, "duration": 9.0}


@pytest.fixture(scope="module")
def serial(beam):
    return sweep(beam, **CASES, **COARSE, jobs=1)


@contextmanager
def process(*arguments):
    with subprocess.Popen(
        [sys.executable, "-m", *arguments], env={**os.environ, "PYTHONPATH": str(ROOT)},
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
    ) as started:  # fmt: skip
        try:
            yield started
        finally:
            started.kill()


@pytest.fixture
def cluster(tmp_path):
    """Two workers and their scheduler, all processes, and the file by which clients find it."""
    where = ("--scheduler-file", str(tmp_path / "scheduler.json"))
    at = ("--host", "127.0.0.1", "--no-dashboard")
    one = ("--nthreads", "1", "--no-nanny", "--no-dashboard", "--local-directory", str(tmp_path))
    with ExitStack() as started:
        scheduler = "distributed.cli.dask_scheduler", "--port", "0", *at
        of = [started.enter_context(process(*scheduler, *where))]
        worker = "distributed.cli.dask_worker", *one
        of += [started.enter_context(process(*worker, *where)) for _ in range(2)]
        yield where[1], of


@contextmanager
def executor(file):
    with distributed.Client(scheduler_file=file, timeout=5) as client:
        client.wait_for_workers(2, timeout=60)
        yield client.get_executor()


def test_samples_are_the_same_as_here(beam, cluster):
    answer, scatter = linear_modes(beam, 2.0, 2), {"EI3": 0.05}
    with executor(cluster[0]) as workers:
        found = sampled(answer, scatter, count=4, executor=workers)
    np.testing.assert_array_equal(found, sampled(answer, scatter, count=4))


def test_a_worker_that_dies_costs_no_case(beam, cluster, serial, tmp_path):
    file, (_, worker, _) = cluster
    counts = []

    def progress(done, total):
        counts.append((done, total))
        if done == 3:
            worker.kill()

    with executor(file) as workers:
        found = sweep(
            beam, **CASES, **COARSE, executor=workers, cache=tmp_path / "c", progress=progress
        )
    xr.testing.assert_identical(found, serial)
    assert counts[-1] == (12, 12)
    assert worker.wait() < 0


def test_a_lost_scheduler_is_one_sentence_and_the_sweep_resumes(beam, cluster, serial, tmp_path):
    file, (scheduler, *_) = cluster
    said = r"its executor ended, with \d of 12 cases to do; run again to resume from the cache"

    def progress(done, total):
        if done == 3:
            scheduler.kill()

    with executor(file) as workers, pytest.raises(SimulationError, match=said):
        sweep(beam, **CASES, **COARSE, executor=workers, cache=tmp_path / "c", progress=progress)
    kept = {path: path.stat().st_mtime_ns for path in (tmp_path / "c").iterdir()}
    assert len(kept) >= 3
    again = sweep(beam, **CASES, **COARSE, jobs=1, cache=tmp_path / "c")
    xr.testing.assert_identical(again, serial)
    assert all(path.stat().st_mtime_ns == time for path, time in kept.items())


def test_two_clients_on_one_cache_have_equal_results_and_whole_files(
    beam, cluster, serial, tmp_path
):
    def swept(_):
        with executor(cluster[0]) as workers:
            return sweep(beam, **CASES, **COARSE, executor=workers, cache=tmp_path / "c")

    with ThreadPoolExecutor(2) as clients:
        for found in clients.map(swept, range(2)):
            xr.testing.assert_identical(found, serial)
    files = sorted((tmp_path / "c").iterdir())
    assert len(files) == 12
    assert all(load(path).attrs["case"] == path.stem for path in files)
