"""Blades in Exudyn: hub, point masses and taper against the exact blade, and their files."""

import math

import numpy as np
import pytest

from analytic import Beam, linear_modes
from analytic.exact.continuum.rotation import rotating_blade
from rotbeam_exu import natural_frequencies
from rotbeam_exu.fem.linearization import Linearization

BEAM = Beam.reference()
HEAVY = BEAM.with_hub_radius(0.8).with_tip_mass(0.5)
TURNING = BEAM.with_tip_mass(BEAM.mass, 0.1 * BEAM.mass * BEAM.length**2)
"""With an inertia; a constant mass of the slope would stretch its tip more on each finer mesh."""


@pytest.mark.parametrize(
    ("blade", "omega", "order", "finest"),
    [
        (HEAVY, 6.0, 4.0, 1e-6),
        (HEAVY.with_setting_angle(0.25 * math.pi), 6.0, 4.0, 1e-7),
        (HEAVY.with_setting_angle(0.5 * math.pi), 6.0, 4.0, 1e-7),
        (TURNING, 4.0 * BEAM.frequency_scale, 4.0, 1e-7),
        (TURNING.with_setting_angle(0.25 * math.pi), 4.0 * BEAM.frequency_scale, 4.0, 1e-7),
        # The cable has a section of its own in each element: in steps.
        (BEAM.with_hub_radius(0.8).with_taper(0.3, 0.5), 6.0, 2.0, 1.2e-4),
    ],
    ids=["heavy", "heavy at 45°", "heavy in flap", "turning", "turning at 45°", "tapered"],
)
def test_frequencies_keep_the_order_of_the_element(blade, omega, order, finest, fitted_order):
    exact = linear_modes(blade, omega, 2).frequencies
    meshes = np.array([16, 32, 64])
    errors = [natural_frequencies(blade, omega, elements=n, count=2) / exact - 1.0 for n in meshes]
    assert np.abs(errors[-1]).max() < finest
    for mode in np.abs(errors).T:
        assert fitted_order(1.0 / meshes, mode) == pytest.approx(order, abs=0.05)


def test_a_hub_and_a_tip_mass_stretch_the_blade_as_they_should(beam):
    blade = beam.with_hub_radius(2.0).with_tip_mass(0.3)
    exact = linear_modes(blade, 6.0, 1)
    steady = rotating_blade(blade, 6.0, exact.model)
    wanted = blade.length * (exact.model.tip(steady.equilibrium[None])[0, 0] - 1.0)
    # The difference of two lengths: 1e-15 of one of them.
    assert Linearization.of(blade, 6.0, elements=32).stretch == pytest.approx(wanted, abs=1e-12)
    assert wanted > 1.5 * Linearization.of(beam, 6.0).stretch


def test_cantilever_at_rest(beam):
    found = natural_frequencies(beam, 0.0, elements=64) / beam.frequency_scale
    # Six printed digits; 64 elements are within 2e-7 of the exact third frequency.
    assert found == pytest.approx([3.516015, 22.034492, 61.697214], rel=3e-7)


@pytest.mark.parametrize(
    ("omega", "exact"), [(2.0, 3.034885), (4.0, 3.345616), (6.0, 3.730401), (8.0, 4.123895)]
)
def test_steady_rotation_converges_to_the_continuum(beam, omega, exact):
    # Asked: 1e-6 relative. The mesh error at 64 elements is below 2e-7, the print's rounding too.
    assert natural_frequencies(beam, omega, elements=64)[0] == pytest.approx(exact, rel=1e-6)
