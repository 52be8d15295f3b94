"""Reissner's beam in Exudyn and on paper: elements of the one converge to the other."""

from functools import partial

import numpy as np
import pytest

from analytic import Beam, SteadyRotation, linear_modes, periodic_orbits, spin_up_response
from rotbeam_exu import natural_frequencies, simulate
from rotbeam_exu.fem.elements import Exact
from rotbeam_exu.verification.theory import Theory

SHARE = (5.0 / 6.0) / 2.6
REISSNER = Theory(rotary_inertia=True, shear_share=SHARE)
THICK = Beam(length=1.0, area=1e-2, second_moment=1e-2 / 1200, youngs_modulus=1e9, density=1e3)


@pytest.mark.parametrize(
    "blade", [THICK, THICK.with_hub_radius(0.5).with_tip_mass(3.0)], ids=["beam", "hub and mass"]
)
def test_frequencies_converge_with_the_fourth_power(blade, fitted_order):
    """Where shear and rotary inertia take half a per cent and more."""
    meshes = [8, 16, 32]
    exact = REISSNER.first_frequency(blade, 50.0)
    errors = [
        natural_frequencies(blade, 50.0, element=Exact(nodes=3), elements=n, count=1)[0] / exact - 1
        for n in meshes
    ]
    assert -fitted_order(meshes, np.abs(errors)) == pytest.approx(4.0, abs=0.1)
    assert abs(errors[-1]) < 1e-7
    assert exact < 0.996 * linear_modes(blade, 50.0, 1).frequencies[0]


def test_started_on_an_orbit_of_its_own_it_stays_there(beam):
    """Started on that of Bernoulli and Euler's beam it leaves by the frequency, and sections ring.

    Sixteen elements leave 3e-6.
    """
    apart = []
    for sections in ({"rotary_inertia": True, "shear_share": SHARE}, {}):
        orbit = periodic_orbits(beam, 6.0, [0.1], **sections)
        period = 2.0 * np.pi / orbit.frequency[0]
        run = simulate(
            beam, SteadyRotation(omega=6.0), element=Exact(nodes=3), elements=16, frame="rotating",
            step=period / 2000, duration=period / 4,
            initial_state=lambda x, orbit=orbit: orbit.state(0, x, phase=1.0),
        )  # fmt: skip
        predicted = beam.length * orbit.response(run["time"].to_numpy(), 0, phase=1.0)
        apart.append(np.abs(run["q"] - predicted).max().item() / (0.1 * beam.length))
    assert apart[0] < 5e-6
    assert apart[1] > 5e-5


@pytest.mark.slow
def test_a_spin_up_converges_to_the_sheared_beam(beam, spin_up):
    """The limit in step and mesh; Bernoulli and Euler's beam is off by 1.3e-3 of max|q|."""
    run = partial(simulate, beam, spin_up, element=Exact(nodes=3), duration=15.0, frame="rotating")
    coarse, middle, fine = (run(elements=16, step=h) for h in (4e-3, 2e-3, 1e-3))
    mesh = run(elements=32, step=2e-3)["q"] - middle["q"]
    step = fine["q"] - middle["q"]
    # The trapezoidal rule has order 2, quadratic elements have order 4.
    assert np.abs(middle["q"] - coarse["q"]).max() / np.abs(step).max() == pytest.approx(
        4, rel=0.05
    )
    limit = (fine["q"] + step / 3.0 + mesh * 16.0 / 15.0).to_numpy()
    times = fine["time"].to_numpy()
    sheared = REISSNER.history(beam, spin_up, times).q
    thin = spin_up_response(beam, spin_up, times).q
    scale = np.abs(sheared).max()
    assert np.abs(limit - sheared).max() < 2e-7 * scale
    assert np.abs(limit - thin).max() == pytest.approx(1.28e-3 * scale, rel=0.01)
