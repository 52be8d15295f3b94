"""Exudyn in space under what moves the blade out of the plane: a kick, weight along the axis."""

import math
from functools import partial

import numpy as np
import pytest

from analytic import Beam, Gravity, SpinUp, Tube, steady_state
from analytic.exact.beam.state import kicked_state
from analytic.theory import Theory
from rotbeam_exu import simulate
from rotbeam_exu.fem.elements import SpaceExact
from rotbeam_exu.fem.linearization import Linearization

TUBE = Beam.reference().with_shape(Tube())
LEVEL = Gravity(9.81, tilt=0.5 * math.pi)


def test_the_steady_state_under_weight_tends_to_the_exact_one():
    """Of second order: the limit of 8 and 16 elements leaves their fourth."""
    blade = Beam.reference().with_section_out_of_plane(0.5, 0.6).with_twist(0.5).with_precone(0.1)
    exact = steady_state(
        blade, 4.0, gravity=9.81,
        theory=Theory(shear=SpaceExact().shear_share, rotary_inertia=True, trapeze=False),
    )  # fmt: skip
    due = np.array([*exact.tip[1:] / blade.length, exact.twist])
    coarse, fine = (
        np.array([*found.tip[1:], found.twist])
        for found in (
            Linearization.of(blade, 4.0, SpaceExact(), elements, weight=[LEVEL])
            for elements in (8, 16)
        )
    )
    off = np.abs(coarse - due).max()
    assert 1e-4 < off < 0.02
    np.testing.assert_allclose(fine + (fine - coarse) / 3.0, due, atol=0.05 * off)


def test_tilted_gravity_does_the_work_that_the_blade_gains():
    motion = SpinUp(omega=4.0, ramp_time=0.3)
    run = simulate(
        TUBE, motion, element="space_exact", elements=4, duration=0.5, step=2.5e-3,
        loads=[Gravity(tilt=0.6)],
    )  # fmt: skip
    gained = run.jacobi_energy - run.jacobi_energy[0]
    size = np.abs(run.supplied_energy).max().item()
    # Of second order in the step.
    np.testing.assert_allclose(gained, run.supplied_energy, atol=2e-3 * size)
    assert run.w[-1].item() < -0.1


def test_a_kicked_tube_starts_straight_with_the_kick():
    motion = SpinUp(omega=2.0, ramp_time=1.0)
    run = simulate(
        TUBE, motion, element="space_exact", elements=16, duration=1.1, step=0.02,
        initial_state=partial(kicked_state, TUBE.length, 2.0),
    )  # fmt: skip
    assert run.w[0].item() == 0.0
    assert run.w_dot[0].item() == pytest.approx(2.0, rel=1e-9)
    # ½∫ρA (v s)² dx = ½ m v² 104/405, with velocities linear in the elements to 1/n².
    kinetic = 0.5 * TUBE.mass * 4.0 * 104.0 / 405.0
    assert run.kinetic_energy[0].item() == pytest.approx(kinetic, rel=5e-3)
    assert run.w[1].item() > 0.0


def test_an_element_of_the_plane_refuses_tilted_gravity():
    with pytest.raises(ValueError, match="'cable' stays in the plane of rotation"):
        simulate(TUBE, SpinUp(omega=2.0, ramp_time=1.0), loads=[LEVEL])
