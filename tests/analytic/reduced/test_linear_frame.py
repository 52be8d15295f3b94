"""The linear floating frame: divergent above ω0, right at small speeds, and with the one term."""

import numpy as np
import pytest

from analytic import (
    Beam,
    Damping,
    SpinUp,
    SteadyRotation,
    Theory,
    linear_modes,
    linear_response,
    spin_up_response,
)


def squared_frequency(response, step):
    """ω_n² of one mode [1/s²], negative where it grows: q(t+h) + q(t-h) = 2 cos(ω_n h) q(t)."""
    q = response.q[response.time > response.spin_up.ramp_time]
    cosine = np.vdot(q[1:-1], q[2:] + q[:-2]) / np.vdot(q[1:-1], q[1:-1]) / 2.0
    return float((np.emath.arccos(cosine) ** 2).real / step**2)


def swinging(beam, omega, **options):
    """A response after a ramp so gentle that the second mode keeps still."""
    times = np.arange(0.0, 10.0, 0.05)
    spin_up = SpinUp(omega=omega, ramp_time=6.0)
    return squared_frequency(linear_response(beam, spin_up, times, **options), 0.05)


@pytest.mark.parametrize(("omega", "psi"), [(2.0, 0.0), (2.8, 0.0), (3.0, 0.0), (6.0, 1.0)])
def test_it_softens_and_diverges_above_the_first_natural_frequency(beam, omega, psi):
    """ω_n² = ω0² - ω² cos²ψ, the oscillation left of the second mode 1e-6 of it or less."""
    expected = beam.omega_0**2 - (omega * np.cos(psi)) ** 2
    assert swinging(beam.with_setting_angle(psi), omega) == pytest.approx(
        expected, abs=2e-5 * beam.omega_0**2
    )


@pytest.mark.parametrize(
    ("blade", "omega"),
    [
        (Beam.reference(), 8.0),
        (Beam.reference().with_hub_radius(2.0), 4.0),
        (Beam.reference().with_tip_mass(0.5), 8.0),
        (Beam.reference().with_setting_angle(1.0), 4.0),
    ],
    ids=["beam", "hub", "tip mass", "set"],
)
def test_with_foreshortening_it_has_the_blades_own_frequencies(blade, omega):
    expected = linear_modes(blade, omega, theory=Theory(extension=False)).frequencies[0] ** 2
    assert swinging(blade, omega, foreshortening=True) == pytest.approx(expected, rel=1e-4)


def test_without_rotation_to_speak_of_it_is_the_exact_beam(beam, fitted_order):
    """What it leaves out, and geometric nonlinearity, are of the order of ω²."""
    speeds, times = np.array([0.02, 0.04, 0.08]), np.linspace(0.0, 4.0, 41)
    errors, blade = [], beam.with_setting_angle(0.7)
    for omega in speeds:
        spin_up = SpinUp(omega=omega, ramp_time=3.0)
        exact = spin_up_response(blade, spin_up, times, tolerance=1e-5).q
        off = linear_response(blade, spin_up, times).q - exact
        errors.append(np.abs(off).max() / np.abs(exact).max())
    assert errors[-1] < 0.01
    assert fitted_order(speeds, errors) == pytest.approx(2.0, abs=0.05)


def test_the_axis_ends_at_the_tip_and_grows_longer(beam):
    spin_up, points = SpinUp(omega=4.0, ramp_time=3.0), np.linspace(0.0, beam.length, 201)
    response = linear_response(beam, spin_up, [1.5, 1.5, 2.0], points=points)
    assert response.axis[:, -1, 1] == pytest.approx(response.q, rel=1e-12)
    assert np.all(response.axis[..., 0] == points)
    assert response.q[0] == response.q[1]
    assert linear_response(beam, spin_up, [0.0]).q.tolist() == [0.0]
    lengths = np.linalg.norm(np.diff(response.axis, axis=1), axis=-1).sum(axis=1)
    assert np.all(lengths > 1.1 * beam.length)


def test_places_are_in_the_frame_of_the_clamp_as_the_exact_ones(beam):
    """Of a set blade: lag and flap by its angle, to what bending brings nearer to the axis."""
    blade, motion, points = (
        beam.with_setting_angle(0.7),
        SpinUp(omega=1.0, ramp_time=4.0),
        [3.0, 8.0],
    )
    linear = linear_response(blade, motion, [1.0, 2.0], points=points, foreshortening=True).axis
    exact = spin_up_response(blade, motion, [1.0, 2.0], points=points, tolerance=1e-5).axis
    assert linear.shape == exact.shape
    size = np.abs(exact[..., 1:]).max()
    assert linear[..., 1:] == pytest.approx(exact[..., 1:], abs=0.02 * size)


def test_refuses(beam):
    spin_up = SpinUp(omega=25.0, ramp_time=1.0)
    with pytest.raises(RuntimeError, match="beyond all numbers before t = 40 s: ask for earlier"):
        linear_response(beam, spin_up, [40.0])
    assert np.isfinite(linear_response(beam, spin_up, [20.0]).q).all()
    with pytest.raises(ValueError, match="times must ascend from 0 s on"):
        linear_response(beam, spin_up, [-1.0])
    with pytest.raises(ValueError, match="the linear frame has no damping"):
        linear_response(beam.with_damping(Damping(bending=1e-3)), spin_up, [1.0])
    with pytest.raises(TypeError, match="must be a SpinUp, a FourierRamp, a SpeedTable or another"):
        linear_response(beam, SteadyRotation(omega=1.0), [1.0])
