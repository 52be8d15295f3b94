"""Cost of a real blade, and of threads."""

import os
import statistics
import subprocess
import sys
import time
from pathlib import Path

import pytest

from analytic import (
    Blade,
    Damping,
    Gravity,
    Rectangle,
    Section,
    SpinUp,
    TipForce,
    campbell,
    forced_response,
    linear_modes,
    periodic_orbits,
    spin_up_response,
)
from rotbeam_exu.files.beam_file import load_beam

pytestmark = pytest.mark.benchmarks


def seconds(work, beam):
    started = time.perf_counter()
    work(beam)
    return time.perf_counter() - started


def test_an_amplitude_out_of_the_plane_costs_a_fraction_of_a_second(beam):
    """The orbit, and what grows about it at two resolutions, with a twist that has inertia."""
    blade = beam.with_shape(Rectangle())
    periodic_orbits(blade, 4.0, [0.05]).out_of_plane()  # the first time is no measure
    took = [seconds(lambda b: periodic_orbits(b, 4.0, [0.02, 0.035, 0.05]).stable, blade) / 3.0]
    took += [seconds(lambda b: periodic_orbits(b, 4.0, [0.02, 0.035, 0.05]).stable, blade) / 3.0]
    assert min(took) < 1.0


NREL = Path(__file__).parents[2] / "models" / "blades" / "nrel_5mw_edgewise.toml"
DAMPING = Damping(external=5.0)
ON_A_REAL_BLADE = {
    "modes": lambda blade: linear_modes(blade, 1.267),
    "campbell": lambda blade: campbell(blade, [0.0, 0.5, 1.0, 1.5]),
    "orbits": lambda blade: periodic_orbits(blade, 1.267, [0.1, 0.3]),
    "their stability": lambda blade: periodic_orbits(blade, 1.267, [0.1]).stable,
    "spin-up": lambda blade: spin_up_response(
        blade, SpinUp(omega=1.267, ramp_time=5.0), [10.0], tolerance=1e-6
    ),
    "gravity": lambda blade: forced_response(blade.with_damping(DAMPING), [0.6, 0.8], Gravity()),
    "tip force": lambda blade: forced_response(
        blade.with_damping(DAMPING), 1.267, TipForce(amplitude=1000.0), [6.0, 7.0]
    ),
}


@pytest.mark.parametrize("name", ON_A_REAL_BLADE)
def test_a_blade_of_49_stations_costs_at_most_twenty_uniform_ones(name):
    work, real = ON_A_REAL_BLADE[name], load_beam(NREL)
    section = Section(
        axial_stiffness=real.axial_stiffness,
        bending_stiffness=real.bending_stiffness,
        mass_per_length=real.mass_per_length,
    )
    uniform = Blade(length=real.length, section=section, hub_radius=real.hub_radius)
    seconds(work, real), seconds(work, uniform)  # the first times are no measure
    pairs = [seconds(work, real) / seconds(work, uniform) for _ in range(3)]
    assert statistics.median(pairs) < 20.0, pairs


_QUESTIONS = """
import time
import numpy as np
from analytic import Beam, SpinUp, backbone_curve, periodic_orbits, spin_up_response
beam = Beam.reference()
start = time.process_time()
periodic_orbits(beam, 6.0, np.linspace(0.03, 0.3, 10))
backbone_curve(beam, 6.0)
spin_up_response(beam, SpinUp(omega=6.0, ramp_time=3.0), np.linspace(0.0, 15.0, 101))
print(time.process_time() - start)
"""


def test_threads_of_blas_cost_nothing():
    """As every user runs it, without OMP_NUM_THREADS=1: up to 40 times the CPU before."""
    variables = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
    bare = {name: value for name, value in os.environ.items() if name not in variables}

    def cpu(**more):
        command = [sys.executable, "-c", _QUESTIONS]
        run = subprocess.run(
            command, env={**bare, **more}, capture_output=True, text=True, check=True
        )
        return float(run.stdout)

    pairs = [cpu() / cpu(OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1") for _ in range(5)]
    assert 1.0 / 1.2 < statistics.median(pairs) < 1.2, pairs
