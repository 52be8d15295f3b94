"""Cost of a run in memory, of an element over another, and of a sweep in time."""

import gc
import os
import time
from pathlib import Path
from statistics import median

import pytest

from analytic import SpinUp
from rotbeam_exu import paper, simulate, sweep

pytestmark = pytest.mark.benchmarks


def test_memory_of_a_hundred_runs(beam):
    def resident():
        gc.collect()
        pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1])
        return pages * os.sysconf("SC_PAGE_SIZE") / 2**20

    spin_up = SpinUp(omega=6.0, ramp_time=0.5)

    def once():
        simulate(beam, spin_up, elements=16, duration=1.0, step=5e-3)

    for _ in range(5):
        once()
    before = resident()
    for _ in range(100):
        once()
    assert resident() - before < 20.0


def test_the_papers_element_costs_less_than_eight_cables(beam, spin_up):
    simulate(beam, spin_up, element="ancf3", elements=2, duration=4.0)  # imports and caches
    ratios = []
    for _ in range(3):
        cable, own = (
            simulate(beam, spin_up, element=element, duration=5.0).attrs["wall_time"]
            for element in ("cable", "ancf3")
        )
        ratios.append(own / cable)
    # The median of pairs, because the machine's speed drifts.
    assert median(ratios) < 8.0, ratios


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
