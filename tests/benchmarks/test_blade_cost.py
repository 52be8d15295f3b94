"""What a Blade costs that is the paper's beam."""

import statistics
import time

import pytest

from analytic import SpinUp, linear_modes, periodic_orbits, planar_stability, reduced_model
from rotbeam_exu import simulate

pytestmark = pytest.mark.benchmarks

WORK = {
    "modes": lambda beam: linear_modes(beam, 6.0),
    "orbits": lambda beam: periodic_orbits(beam, 6.0, [0.1, 0.3]),
    "FrM": lambda beam: reduced_model(beam, 6.0, "FrM"),
    "simulation": lambda beam: simulate(
        beam, SpinUp(omega=6.0, ramp_time=3.0), duration=4.0, step=2e-3
    ),
}


def seconds(work, beam):
    started = time.perf_counter()
    work(beam)
    return time.perf_counter() - started


@pytest.mark.parametrize("name", WORK)
def test_a_blade_that_is_the_beam_costs_what_the_beam_does(beam, name):
    work, blade = WORK[name], beam.blade
    seconds(work, beam), seconds(work, blade)  # the first times are no measure
    pairs = [seconds(work, blade) / seconds(work, beam) for _ in range(9)]
    assert statistics.median(pairs) < 1.1


def test_an_amplitude_out_of_the_plane_costs_a_fraction_of_a_second(beam):
    """The orbit, and what grows about it at two resolutions, with a twist that has inertia."""
    blade = beam.rectangle()
    planar_stability(blade, 4.0, [0.05])  # the first time is no measure
    took = [seconds(lambda b: planar_stability(b, 4.0, [0.02, 0.035, 0.05]), blade) / 3.0]
    took += [seconds(lambda b: planar_stability(b, 4.0, [0.02, 0.035, 0.05]), blade) / 3.0]
    assert min(took) < 1.0
