"""The kick out of the plane: it bends, does not stretch, and says where it is too large."""

import numpy as np
import pytest

from analytic import (
    Beam,
    Blade,
    Section,
    SpinUp,
    SteadyRotation,
    Tube,
    periodic_orbits,
    spin_up_response,
)
from analytic.section import OutOfPlane
from rotbeam_exu import kicked, simulate
from rotbeam_exu.runs.check import SimulationError

ALIKE = Beam.reference().with_section_out_of_plane(bending_ratio=1.0)
TUBE = Beam.reference().with_shape(Tube(radius=0.015, wall=0.00077))


def test_the_kick_bends_and_does_not_stretch():
    """An arc: a parabola of 1e-3 L stretched a blade of slenderness 1e-8 by 200 EI/L² of force."""
    x = np.linspace(0.0, ALIKE.length, 5)
    orbit = periodic_orbits(ALIKE, 2.0, [0.3])
    for planar in (None, lambda at: orbit.state(0, at, phase=0.7)):
        flat, bent = (kicked(ALIKE, kick, planar)(x) for kick in (0.0, 1e-2))
        lengths = [np.hypot(np.hypot(1.0 + s.u_slope, s.v_slope), s.w_slope) for s in (flat, bent)]
        np.testing.assert_allclose(*lengths, rtol=1e-14)
        # Places belong to the slopes: their differences are those of a blade that was turned.
        fine = np.linspace(0.0, ALIKE.length, 401)
        many = kicked(ALIKE, 1e-2, planar)(fine)
        for place, slope in (("u", "u_slope"), ("v", "v_slope"), ("w", "w_slope")):
            by_differences = np.gradient(getattr(many, place), fine)[1:-1]
            # Differences over 0.02 m err by h²/6 of the third derivative, 1e-4 of the second mode.
            np.testing.assert_allclose(getattr(many, slope)[1:-1], by_differences, atol=2e-6)
            np.testing.assert_allclose(getattr(many, place)[::100], getattr(bent, place), atol=1e-9)
    straight = kicked(ALIKE, 1e-2)(x)
    np.testing.assert_allclose(straight.w, 400.0 * (1.0 - np.cos(2.5e-3 * x)), rtol=1e-9)


def first_mode(x):
    """The clamped beam's closed form, 1 at the tip."""
    root, ends = 1.8751040687119611, np.append(x, 1.0)
    ratio = (np.cosh(root) + np.cos(root)) / (np.sinh(root) + np.sin(root))
    z = root * ends
    shape = np.cosh(z) - np.cos(z) - ratio * (np.sinh(z) - np.sin(z))
    return shape[:-1] / shape[-1]


@pytest.mark.parametrize("bending_ratio", [1.0, 25.0, 0.003])
def test_both_codes_start_in_the_first_flap_mode(bending_ratio):
    """If both planes are alike flap and lag have one frequency; of a deep blade lag is lower."""
    blade = ALIKE.with_section_out_of_plane(bending_ratio, 1.0)
    x, motion = np.linspace(0.0, blade.length, 5), SpinUp(omega=2.0, ramp_time=3.0)
    # Simpson's rule of the finite elements has 32 pieces. The flap mode of the exact response has
    # the inertia of its slices as well.
    close = 1e-7 + 2.0 * bending_ratio * blade.slenderness
    for kick, digits in ((1e-6, 1e-7), (1e-2, 1e-4)):
        found = spin_up_response(blade, motion, [0.0, 0.1], tolerance=1e-6, points=x, bent=kick)
        start = kicked(blade, kick, by_mode=True)(x)
        places = np.stack((x + start.u, start.v, start.w), axis=-1)
        np.testing.assert_allclose(found.axis[0], places, rtol=close, atol=1e-15)
        # Turned tangents have the mode's deflections but for the square of the kick.
        mode = kick * blade.length * first_mode(x / blade.length)
        np.testing.assert_allclose(start.w, mode, rtol=digits, atol=1e-15)


def test_a_kicked_tube_swings_as_exudyn_has_it():
    tube, motion = TUBE, SpinUp(omega=6.0, ramp_time=0.5)
    settings = {"element": "space_exact", "duration": 0.6, "elements": 16, "step": 2.5e-3}
    run = simulate(tube, motion, initial_state=kicked(tube, 1e-3, by_mode=True), **settings)
    exact = spin_up_response(tube, motion, run["time"].to_numpy(), tolerance=1e-5, bent=1e-3)
    assert exact.flap.min() < -0.25e-3 * tube.length
    # The element's error, of order 2: 1e-3 of each with 16 of them.
    assert np.abs(run["w"] - exact.flap).max() / tube.length < 2e-6
    assert np.abs(run["q"] - exact.q).max() / tube.length < 2e-3


@pytest.mark.parametrize(
    ("blade", "kick", "sentence"),
    [
        (TUBE, 0.2, "at most 0.1 of the length"),
        (TUBE, np.nan, "must be finite"),
        (Beam.reference(), 1e-3, r"kick.*with_section_out_of_plane\("),
        (TUBE.with_twist(0.1), 1e-3, "out of its plane, and this one"),
    ],
)
def test_kicks_that_are_refused(blade, kick, sentence):
    with pytest.raises(ValueError, match=sentence):
        spin_up_response(blade, SpinUp(omega=2.0, ramp_time=1.0), [0.5], bent=kick)
    if blade == TUBE:
        with pytest.raises(ValueError, match=sentence):
            kicked(blade, kick)


def slender(slenderness, bending_ratio):
    section = Section(
        axial_stiffness=566.0 / (slenderness * 64.0), bending_stiffness=566.0, mass_per_length=0.2,
        out_of_plane=OutOfPlane(bending_ratio=bending_ratio, torsion_ratio=0.8),
    )  # fmt: skip
    return Blade(length=8.0, section=section)


@pytest.mark.parametrize("slenderness", [1e-7, 1e-8])
def test_a_slender_blade_takes_a_small_kick_or_small_steps(slenderness):
    """The remedy is followed: a step 16 times smaller; so is a smaller kick."""
    blade = slender(slenderness, 2.0)
    motion = SteadyRotation(omega=0.4 * blade.omega_0)

    def run(kick, pieces):
        end = 0.25 / blade.omega_0
        return simulate(
            blade, motion, element="space_exact", elements=4, duration=end, step=end / pieces,
            initial_state=kicked(blade, kick),
        )  # fmt: skip

    with pytest.raises(SimulationError, match="take a smaller step than"):
        run(1e-2, 50)
    assert abs(run(1e-6, 50).w[0].item()) == pytest.approx(8e-6, rel=1e-6)
    assert run(1e-2, 800).w[0].item() == pytest.approx(8e-2, rel=1e-4)
