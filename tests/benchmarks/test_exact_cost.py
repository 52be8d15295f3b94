"""Cost of exact answers, against the simulation they judge, in the same run; and models."""

import time
from pathlib import Path
from statistics import median

import numpy as np
import pytest

from analytic import (
    Beam,
    Damping,
    SpeedRipple,
    SpinUp,
    Theory,
    backbone_curve,
    forced_response,
    periodic_orbits,
    reduced_model,
    residual_amplitude,
    spin_up_response,
)
from analytic.quadrature import gauss_points
from analytic.sensitivity import sensitivity
from rotbeam_exu import simulate
from rotbeam_exu.files.beam_file import load_beam
from tests.beams import unit_beam

pytestmark = pytest.mark.benchmarks
BLADES = Path(__file__).parents[2] / "models" / "blades"


def seconds(function, repeats=3, clock=time.perf_counter):
    taken = []
    for _ in range(repeats):
        start = clock()
        function()
        taken.append(clock() - start)
    return median(taken)


def cpu_seconds(function, repeats=3):
    """Of one thread, whatever else the machine does."""
    return seconds(function, repeats, time.process_time)


def share(function, omega):
    """What a function takes of a 16-element run of 15 s: five pairs, one after the other.

    Of the short one the fastest of five, or what the machine does besides would be measured.
    """
    beam, spin_up = Beam.reference(), SpinUp(omega=omega, ramp_time=3.0)
    shares = []
    for _ in range(5):
        run = seconds(lambda: simulate(beam, spin_up, elements=16, duration=15.0), repeats=1)
        shares.append(min(seconds(function, repeats=1) for _ in range(5)) / run)
    return median(shares)


@pytest.mark.parametrize("omega", [2.0, 4.0, 6.0, 8.0])
def test_ten_orbits_take_a_twenty_fifth_of_a_simulation(beam, omega):
    amplitudes = np.linspace(0.03, 0.3, 10)
    assert share(lambda: periodic_orbits(beam, omega, amplitudes), omega) < 0.04


@pytest.mark.parametrize("omega", [4.0, 6.0, 8.0])
def test_a_curve_takes_a_twentieth_of_a_simulation(beam, omega):
    assert share(lambda: backbone_curve(beam, omega), omega) < 0.05


FLAT = unit_beam(1e-4).with_section_out_of_plane(1.0 / 16.0, 0.08)


@pytest.mark.parametrize(
    ("blade", "omega", "mode"),
    [
        (FLAT.with_twist(0.5236), 1.0, "flap 1"),
        (FLAT.with_twist(0.5236), 2.0, "flap 1"),
        (FLAT.with_precone(0.0873), 1.0, "flap 1"),
    ],
)
def test_orbits_in_space_take_forty_times_those_in_the_plane(blade, omega, mode):
    plane = cpu_seconds(lambda: periodic_orbits(FLAT, omega, [0.05, 0.1]), repeats=9)
    space = cpu_seconds(lambda: periodic_orbits(blade, omega, [0.05, 0.1], mode=mode))
    assert space < 40.0 * plane, f"{space:.3f} s against {plane:.4f} s"


def test_a_spin_up_in_space_takes_forty_times_that_in_the_plane():
    motion, times = SpinUp(omega=4.0, ramp_time=12.0), np.linspace(0.0, 20.0, 21)
    plane, space = (
        cpu_seconds(lambda b=blade: spin_up_response(b, motion, times, tolerance=1e-6))
        for blade in (FLAT, FLAT.with_twist(0.5236))
    )
    assert space < 40.0 * plane, f"{space:.3f} s against {plane:.4f} s"


def test_a_real_blade_spins_up_in_seconds_and_by_digits():
    """NREL's blade for 15 s, whose 49 stations are in space."""
    blade = load_beam(Path(__file__).parents[2] / "models" / "blades" / "nrel_5mw.toml")
    motion, times = SpinUp(omega=1.267, ramp_time=10.0), np.linspace(0.0, 15.0, 151)
    three, four, six = (
        cpu_seconds(lambda t=tolerance: spin_up_response(blade, motion, times, tolerance=t))
        for tolerance in (1e-3, 1e-4, 1e-6)
    )
    assert four < 3.0
    assert six < 10.0
    assert three < 0.2 * six, f"{three:.3f} s against {six:.3f} s"


def test_a_blade_whose_tip_lags_by_most_of_its_length_spins_up_in_seconds():
    blade, theory = FLAT.with_twist(0.6), Theory(rotary_inertia=True, trapeze=False)
    motion, times = SpinUp(omega=3.0, ramp_time=1.2), [0.5, 1.0, 1.5]
    took = cpu_seconds(
        lambda: spin_up_response(blade, motion, times, tolerance=1e-4, theory=theory)
    )
    assert took < 5.0


@pytest.mark.parametrize(("omega", "ramp_time"), [(6.0, 3.0), (8.0, 2.0)])
def test_spin_up_to_1e_6_takes_less_than_64_elements(beam, omega, ramp_time):
    spin_up, times = SpinUp(omega=omega, ramp_time=ramp_time), np.linspace(0.0, 15.0, 1501)
    run = seconds(lambda: simulate(beam, spin_up, elements=64, duration=15.0), repeats=1)
    exact = seconds(lambda: spin_up_response(beam, spin_up, times, tolerance=1e-6))
    assert exact < run, f"{exact:.3f} s against {run:.3f} s"


def test_a_response_curve_with_two_folds_takes_less_than_a_simulation(beam):
    """Case D3, a hundred points asked for."""
    scale = beam.frequency_scale
    blade = beam.with_damping(Damping(external=0.008 * beam.mass_per_length * scale))
    frequencies = 4.50886824 * scale * np.linspace(0.985, 1.015, 60)

    def curve():
        found = forced_response(
            blade,
            6.0,
            SpeedRipple(amplitude=0.003 * scale),
            frequencies,
            theory=Theory(extension=False),
        )
        assert found.frequency.size >= 100
        assert len(found.folds) == 2

    spin_up = SpinUp(omega=6.0, ramp_time=3.0)
    run = seconds(lambda: simulate(beam, spin_up, elements=16, duration=15.0))
    response = seconds(curve)
    assert response < run, f"{response:.3f} s against {run:.3f} s"


def test_a_thousand_ramp_times_take_a_twentieth_of_one_transient(beam):
    """The closed form, once the modes over the speed are known."""
    spin_up, ramp_times = SpinUp(omega=6.0, ramp_time=10.0), np.linspace(1.0, 10.0, 1000)
    residual_amplitude(beam, spin_up, ramp_times)
    form = seconds(lambda: residual_amplitude(beam, spin_up, ramp_times))
    times = np.linspace(0.0, 12.0, 101)
    exact = seconds(lambda: spin_up_response(beam, spin_up, times, tolerance=1e-6))
    assert form < exact / 20.0, f"{form:.4f} s against {exact:.3f} s"


@pytest.mark.parametrize(("variant", "limit"), [("FrE", 5e-3), ("FrM", 50e-3)])
def test_one_model(benchmark, variant, limit):
    # From nothing: without the cached quadrature points.
    model = benchmark.pedantic(
        reduced_model,
        args=(Beam.reference(), 6.0, variant),
        setup=gauss_points.cache_clear,
        rounds=50,
    )
    assert model.w_n > 3.5
    if benchmark.enabled:
        assert benchmark.stats.stats.median < limit


@pytest.mark.parametrize(
    ("blade", "omega", "most"),
    [
        (Beam.reference(), 4.0, 4.0),
        (Beam.reference().with_section_out_of_plane(4.0, 0.5).with_twist(0.3), 4.0, 4.0),
        (load_beam(BLADES / "nrel_5mw.toml"), 1.0, 15.0),
    ],
)
def test_derivatives_of_a_spin_up_cost_a_few_motions(blade, omega, most):
    """Two to three were measured, and nine of NREL's, as docs/howto/sensitivity.md says."""
    motion, times = SpinUp(omega=omega, ramp_time=5.0), np.linspace(0.0, 9.0, 61)
    begin = time.process_time()
    response = spin_up_response(blade, motion, times, tolerance=1e-5)
    solved = time.process_time()
    sensitivity(response)
    assert (time.process_time() - solved) / (solved - begin) < most
