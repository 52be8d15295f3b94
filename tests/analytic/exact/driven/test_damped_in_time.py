"""The damped and loaded blade in time: it decays as it should and settles where it should."""

import numpy as np
import pytest

from analytic import (
    Beam,
    Damping,
    Gravity,
    SpinUp,
    TipForce,
    damping_ratios,
    linear_modes,
    spin_up_response,
)

BEAM = Beam.reference()
SCALE = BEAM.frequency_scale
FORCE = BEAM.bending_stiffness / BEAM.length**3  # unit of force per length


def by_mass(c):
    """The beam with mass-proportional damping c, over its frequency scale."""
    return BEAM.with_damping(Damping(external=c * BEAM.mass_per_length * SCALE))


def test_damping_ratios_in_rotation():
    frequencies = linear_modes(BEAM, 6.0).frequencies
    by_the_mass = damping_ratios(by_mass(0.008), 6.0)
    # Mass-proportional: c/(2ω_j), however fast it turns, but for the Coriolis coupling to axial
    # motion, of the order μw̄².
    assert by_the_mass == pytest.approx(0.5 * 0.008 * SCALE / frequencies, rel=3e-4)
    at_rest = damping_ratios(BEAM.with_damping(Damping.from_ratio(BEAM, 2, 0.01)), 0.0)
    assert at_rest[1] == pytest.approx(0.01, rel=1e-9)
    assert at_rest[0] / at_rest[1] == pytest.approx(3.5160153 / 22.034492, rel=1e-5)
    # The centrifugal stiffness is not damped, but makes the beam bend more at the clamp.
    turning = damping_ratios(BEAM.with_damping(Damping.from_ratio(BEAM)), 6.0)
    assert 0.01 * BEAM.omega_0 / frequencies[0] < turning[0] < 0.01
    with pytest.raises(ValueError, match="mode 3 is damped so much that it does not oscillate"):
        damping_ratios(BEAM.with_damping(Damping.from_ratio(BEAM, 1, 0.1)), 0.0)


@pytest.mark.parametrize(
    "damping",
    [Damping(bending=2e-3), Damping(external=0.02 * BEAM.mass_per_length * SCALE)],
    ids=["bending", "external"],
)
def test_free_vibration_decays_at_the_damping_ratio(damping):
    """After a slow spin-up that leaves little, the first mode rings on alone."""
    blade = BEAM.with_damping(damping)
    omega = 4.0
    frequency = linear_modes(BEAM, omega).frequencies[0]
    ratio = damping_ratios(blade, omega)[0]
    spin_up = SpinUp(omega=omega, ramp_time=8.0)
    period = 2.0 * np.pi / frequency
    time = 10.0 + period * np.arange(400) / 100.0
    q = spin_up_response(blade, spin_up, time, tolerance=1e-5).q
    # ∫q² over a period falls by exp(-4πζ), higher modes decaying faster or being 1e-3 of it.
    energy = np.sum((q**2).reshape(4, 100), axis=1)
    found = -np.polyfit(np.arange(4), np.log(energy), 1)[0] / (4.0 * np.pi)
    assert found == pytest.approx(ratio, rel=1e-3)


@pytest.mark.parametrize(
    ("loads", "error", "sentence"),
    [
        (Gravity(), TypeError, "loads must be several"),
        ((TipForce(amplitude=1.0),), ValueError, "needs the frequency of"),
        ((1.0,), TypeError, "a load must be a"),
    ],
)
def test_loads_in_time_are_checked(loads, error, sentence):
    with pytest.raises(error, match=sentence):
        spin_up_response(BEAM, SpinUp(omega=1.0, ramp_time=3.0), [1.0], loads=loads)
