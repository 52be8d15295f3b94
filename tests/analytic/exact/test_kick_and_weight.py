"""A kick out of the plane, and gravity along the axis of rotation."""

import math

import numpy as np
import pytest

from analytic import (
    Beam,
    Gravity,
    SpinUp,
    Tube,
    spin_up_response,
    steady_state,
)
from analytic.exact.continuum.state import flap_of_kick
from analytic.exact.linear.steady_state import kicked_state

TUBE = Beam.reference().with_shape(Tube())
STRIP = Beam.reference().with_section_out_of_plane(0.5, 0.6).with_twist(0.5)
STILL = SpinUp(omega=0.0, ramp_time=1.0)


def test_a_kick_at_rest_excites_the_modes_of_a_cantilever():
    """Σ φ_k(1) ∫φ_k s dx sin(ω_k t)/ω_k, of which ∫φ_k s dx = 8/β⁴ ∫φ_k dx by parts."""
    beta = np.array([1.87510406871196, 4.69409113297417, 7.85475743823761, 10.9955407348755])
    sigma = (np.cosh(beta) + np.cos(beta)) / (np.sinh(beta) + np.sin(beta))
    shares = 2.0 * (-1.0) ** np.arange(4) * 8.0 / beta**4 * 2.0 * sigma / beta
    omega = TUBE.frequency_scale * beta**2
    t, kick = np.linspace(0.0, 1.0, 21), 1e-3
    exact = kick * np.sin(np.outer(t, omega)) @ (shares / omega)
    found = spin_up_response(TUBE, STILL, t, tolerance=1e-4, kick=kick)
    # The modes that are left out have 2e-4 of the speed, and 2e-6 of the place.
    np.testing.assert_allclose(found.flap, exact, atol=1e-4 * np.abs(exact).max())
    assert np.abs(found.lag).max() < 1e-12


def test_the_kick_has_no_moment_and_no_force_at_its_end():
    x = np.linspace(0.0, 1.0, 101)
    assert flap_of_kick(1.0) == pytest.approx(1.0)
    assert flap_of_kick(1.0, 2) == pytest.approx(0.0, abs=1e-14)
    assert flap_of_kick(1.0, 3) == pytest.approx(0.0, abs=1e-14)
    state = kicked_state(Beam.reference(), 2.0, 8.0 * x)
    slopes = np.gradient(state.velocity[:, 2], 8.0 * x)
    # Central differences err by h²/6 of the third derivative, which is 8 at most.
    np.testing.assert_allclose(state.slope_rate[1:-1, 2], slopes[1:-1], atol=2.0 / 8.0 * 1.4e-4)


def test_a_round_tube_at_rest_falls_to_any_side_alike():
    """Released under gravity, it moves in the plane that gravity and the clamp span."""
    t, tilt = np.linspace(0.0, 0.1, 5), 0.6
    level = spin_up_response(TUBE, STILL, t, tolerance=1e-3, loads=[Gravity()])
    tilted = spin_up_response(TUBE, STILL, t, tolerance=1e-3, loads=[Gravity(tilt=tilt)])
    size = np.abs(level.q).max()
    np.testing.assert_allclose(tilted.lag, math.cos(tilt) * level.q, atol=2e-3 * size)
    np.testing.assert_allclose(tilted.flap, math.sin(tilt) * level.q, atol=2e-3 * size)
    # Rates are known to ten times the tolerance.
    fast = np.abs(level.q_dot).max()
    np.testing.assert_allclose(tilted.q_dot, math.cos(tilt) * level.q_dot, atol=1e-2 * fast)


def test_the_clamp_carries_the_weight():
    """At rest: the weight, by its parts in axes that the precone tilts, and its lever."""
    cone, weight = 0.3, 0.5 * TUBE.mass
    found = steady_state(TUBE.with_precone(cone), 0.0, gravity=0.5)
    down = -weight * np.array([math.sin(cone), 0.0, math.cos(cone)])
    loads = found.section_loads([0.0])
    np.testing.assert_allclose(loads.force[0], down, atol=1e-9 * weight)
    x, share = np.polynomial.legendre.leggauss(24)
    center = 0.5 * share @ found.axis(0.5 * TUBE.length * (1.0 + x))
    moment = np.cross(center, down)
    np.testing.assert_allclose(loads.moment[0], moment, atol=1e-8 * weight * TUBE.length)


def test_gravity_from_below_turns_the_blade_by_half():
    """By half a turn about the clamp's line; whichever way it rotates, its state is the same."""
    down, up = (steady_state(STRIP, 4.0, gravity=g) for g in (9.81, -9.81))
    np.testing.assert_allclose(up.tip, down.tip * [1.0, -1.0, -1.0], rtol=1e-7)
    assert up.twist == pytest.approx(down.twist, rel=1e-6)
    assert down.tip[2] < 0.0


def test_what_stays_in_its_plane_is_refused():
    for kicked in ({"kick": 0.1}, {"loads": [Gravity(tilt=0.1)]}):
        with pytest.raises(ValueError, match=r"kick .*with_section_out_of_plane"):
            spin_up_response(Beam.reference(), STILL, [0.1], **kicked)
    with pytest.raises(ValueError, match="by itself: leave them out"):
        spin_up_response(STRIP, STILL, [0.1], kick=0.1)
