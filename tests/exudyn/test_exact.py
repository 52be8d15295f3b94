"""Exudyn's geometrically exact beam, two and three nodes."""

import numpy as np
import pytest

from analytic import Beam, SpinUp
from rotbeam_exu import simulate, steady_oscillation
from rotbeam_exu.fem.elements import Exact
from rotbeam_exu.runs.check import energy_drift


@pytest.mark.slow  # frequencies, an orbit and spin-ups of sections with shear are in test_shear
@pytest.mark.parametrize(("nodes", "frequency"), [(2, 3.72223), (3, 3.72233)])
def test_nonlinear_frequency(beam, spin_up, nodes, frequency):
    """Sixteen elements at ω = 6, T = 3, h = 1e-3: shear and mesh shift it by digits known."""
    run = simulate(beam, spin_up, element=Exact(nodes=nodes))
    # The print's rounding; a step of 1e-3 is part of the number.
    assert steady_oscillation(run).frequency == pytest.approx(frequency, abs=6e-6)
    assert energy_drift(run)[0] < 1e-5
    assert np.abs(run["direction_residual"]).max() < 1e-12


def test_euler_acceleration_turns_the_sections():
    """With rotary inertia θ'' loads the sections too: the frames agree only with that moment."""
    stubby = Beam(length=1.0, area=0.2, second_moment=0.2**3 / 60, youngs_modulus=1e6, density=1e3)
    spin_up = SpinUp(omega=3.0, ramp_time=0.5)
    inertial, rotating = (
        simulate(
            stubby, spin_up, element="exact", elements=4, duration=1.0, step=2.5e-4, frame=frame
        )["q"]
        for frame in ("inertial", "rotating")
    )
    assert np.abs(inertial - rotating).max() < 1e-3 * np.abs(rotating).max()
