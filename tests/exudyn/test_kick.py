"""The kick out of the plane: it bends, does not stretch, and says where it is too large."""

import numpy as np
import pytest

from analytic import Beam, Blade, Section, SteadyRotation, periodic_orbits
from analytic.section import OutOfPlane
from rotbeam_exu import kicked, simulate
from rotbeam_exu.runs.check import SimulationError

ALIKE = Beam.reference().with_section_out_of_plane(bending_ratio=1.0)


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


def test_a_slender_cable_takes_a_kick_of_a_hundredth():
    blade = slender(1e-8, 1.0)
    end = 0.25 / blade.omega_0
    run = simulate(
        blade, SteadyRotation(omega=0.4 * blade.omega_0), element="space_cable", elements=4,
        duration=end, step=end / 50, initial_state=kicked(blade, 1e-2),
    )  # fmt: skip
    assert np.abs(run.w).max() <= 8e-2
