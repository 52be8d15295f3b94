"""Reissner's beam in Exudyn and on paper: elements of the one converge to the other."""

from dataclasses import replace

import numpy as np
import pytest

from analytic import (
    Beam,
    SpinUp,
    SteadyRotation,
    Theory,
    linear_modes,
    periodic_orbits,
    spin_up_response,
)
from rotbeam_exu import natural_frequencies, simulate
from rotbeam_exu.fem.elements import Ancf3, Exact
from tests.beams import SHARE, THICK

REISSNER = Theory(rotary_inertia=True, shear=SHARE)


@pytest.mark.parametrize(
    "blade", [THICK, THICK.with_hub_radius(0.5).with_tip_mass(3.0)], ids=["beam", "hub and mass"]
)
def test_frequencies_converge_with_the_fourth_power(blade, fitted_order):
    """Where shear and rotary inertia take half a per cent and more."""
    meshes = [8, 16, 32]
    exact = linear_modes(blade, 50.0, 1, theory=REISSNER).frequencies[0]
    errors = [
        natural_frequencies(blade, 50.0, element=Exact(nodes=3), elements=n, count=1)[0] / exact - 1
        for n in meshes
    ]
    assert -fitted_order(meshes, np.abs(errors)) == pytest.approx(4.0, abs=0.1)
    assert abs(errors[-1]) < 1e-7
    assert exact < 0.996 * linear_modes(blade, 50.0, 1).frequencies[0]


def with_rotary_inertia(told):
    return THICK.with_section(replace(THICK.section, rotary_inertia=told))


HOMOGENEOUS = THICK.density * THICK.second_moment


@pytest.mark.parametrize("model", [Exact(nodes=3), Ancf3()], ids=["exact", "ancf3"])
@pytest.mark.parametrize(("told", "has"), [(None, HOMOGENEOUS), (0.0, 0.0), (0.02, 0.02)])
def test_rotary_inertia_is_that_which_is_told(model, told, has):
    """Zero is none, of elements as of theory; of what is not told elements have their own."""
    theory = model.theory
    blades = with_rotary_inertia(told), with_rotary_inertia(has), with_rotary_inertia(0.05)
    found, _, heavy = (natural_frequencies(one, 50.0, element=model, elements=16) for one in blades)
    _, exact, exactly_heavy = (
        linear_modes(one, 50.0, theory=Theory(shear=theory.shear)).frequencies for one in blades
    )
    # Shear of ancf3 is another's by 2e-3; what inertia takes, 7e-3 to 9e-2, is the same.
    taken = 1.0 - exactly_heavy / exact
    assert 1.0 - heavy / found == pytest.approx(taken, rel=6e-3)
    assert linear_modes(blades[0], 50.0, 1, theory=theory).frequencies[0] == pytest.approx(
        exact[0], rel=1e-9
    )


def test_sections_without_inertia_spin_up_as_the_theory_has_it():
    motion, stubby = SpinUp(omega=30.0, ramp_time=0.2), with_rotary_inertia(0.0)
    run = simulate(
        stubby, motion, element=Exact(nodes=3), elements=8, duration=0.3, step=5e-4,
        frame="rotating",
    )  # fmt: skip
    at = np.linspace(0.0, 0.3, 31)
    q = np.interp(at, run["time"], run["q"])
    bare, heavy = (
        spin_up_response(blade, motion, at, tolerance=1e-4, theory=Theory(shear=SHARE)).q
        for blade in (stubby, with_rotary_inertia(HOMOGENEOUS))
    )
    apart = np.abs(bare - heavy).max()
    assert np.abs(q - bare).max() < 0.3 * apart


def test_started_on_an_orbit_of_its_own_it_stays_there(beam):
    """Started on that of Bernoulli and Euler's beam it leaves by the frequency, and sections ring.

    Sixteen elements leave 3e-6.
    """
    apart = []
    for theory in (REISSNER, Theory()):
        orbit = periodic_orbits(beam, 6.0, [0.1], theory=theory)
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


def test_euler_acceleration_turns_the_sections():
    """With rotary inertia θ'' loads the sections too: the frames agree only with that moment."""
    stubby = Beam(length=1.0, area=0.2, second_moment=0.2**3 / 60, youngs_modulus=1e6, density=1e3)
    spin_up = SpinUp(omega=3.0, ramp_time=0.5)
    inertial, rotating = (
        simulate(
            stubby, spin_up, element="exact", elements=4, duration=0.75, step=2.5e-4, frame=frame
        )["q"]
        for frame in ("inertial", "rotating")
    )
    assert np.abs(inertial - rotating).max() < 1e-3 * np.abs(rotating).max()
