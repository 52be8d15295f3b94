"""What sweeps cost, and what two cores bring; meant for a machine that does nothing else."""

import time

import pytest

from rotbeam_exu import paper, sweep

pytestmark = pytest.mark.benchmarks

GRID = {"omegas": paper.SPEEDS, "ramp_times": paper.RAMP_TIMES}


def timed(beam, **options):
    started = time.perf_counter()
    sweep(beam, **GRID, **options)
    return time.perf_counter() - started


def test_two_processes_are_nearly_twice_as_fast_and_resuming_is_free(beam, tmp_path):
    # 32 elements, so that starting two interpreters, some seconds, is a small part.
    two = timed(beam, elements=32, jobs=2, cache=tmp_path)
    resumed = timed(beam, elements=32, jobs=2, cache=tmp_path)
    one = timed(beam, elements=32, jobs=1)
    assert resumed < 2.0
    assert one > 1.8 * two, (one, two)


@pytest.mark.parametrize(
    ("elements", "frame", "limit"), [(16, "inertial", 45.0), (64, "rotating", 180.0)]
)
def test_the_papers_grid(beam, elements, frame, limit):
    assert timed(beam, elements=elements, frame=frame, jobs=2) < limit
