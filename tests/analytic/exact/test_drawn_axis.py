"""The deflected beam as it is drawn, at points that it has, in every method that takes some."""

import numpy as np
import pytest

from analytic import SpinUp, linear_modes, periodic_orbits, spin_up_response


@pytest.mark.parametrize("omega", [0.0, 6.0])
def test_axis_of_an_orbit_agrees_with_its_state(beam, omega):
    backbone = periodic_orbits(beam, omega, [0.3])
    points, phases = np.linspace(0.0, beam.length, 9), np.array([0.3, 2.0, 5.0])
    axis = backbone.axis(0, points, phases)
    assert axis.shape == (3, 9, 3)
    assert not axis[..., 2].any()
    for k, phase in enumerate(phases):
        place = backbone.state(0, points, phase).place
        np.testing.assert_allclose(axis[k], place, atol=1e-12)


def test_axis_of_a_spin_up_is_the_beam(beam):
    times, points = np.linspace(0.0, 4.0, 41), np.linspace(0.0, beam.length, 401)
    spin_up = SpinUp(omega=6.0, ramp_time=3.0)
    response = spin_up_response(beam, spin_up, times, tolerance=1e-6, points=points)
    assert response.axis.shape == (41, 401, 3)
    np.testing.assert_allclose(response.axis[:, -1, 1], response.q, atol=1e-10)
    np.testing.assert_allclose(response.axis[:, 0], 0.0, atol=1e-12)
    np.testing.assert_allclose(response.axis[0, :, 0], points, atol=1e-12)
    # Clamped: y grows as x², up to the change of curvature over 1 % of the length.
    bent = np.abs(response.axis[:, 1, 1]).argmax()
    assert response.axis[bent, 4, 1] / response.axis[bent, 2, 1] == pytest.approx(4.0, rel=0.02)
    # Hardly stretched: μw̄² is 1e-4; the chords miss 3e-6 of the arc.
    arc = np.linalg.norm(np.diff(response.axis, axis=1), axis=-1).sum(axis=1)
    np.testing.assert_allclose(arc, beam.length, rtol=2e-4)


@pytest.fixture(scope="module")
def methods(beam):
    backbone = periodic_orbits(beam, 6.0, [0.1])
    modes = linear_modes(beam, 6.0)
    spin_up = SpinUp(omega=6.0, ramp_time=3.0)
    return {
        "state": lambda x: backbone.state(0, x),
        "axis": lambda x: backbone.axis(0, x, 0.3),
        "shapes": modes.shapes,
        "spin_up": lambda x: spin_up_response(beam, spin_up, [0.01], tolerance=1e-4, points=x),
    }


@pytest.mark.parametrize("method", ["state", "axis", "shapes", "spin_up"])
def test_beyond_the_ends_and_not_a_number(methods, method):
    for x in (-1.0, 9.0, [0.0, 8.001]):
        with pytest.raises(ValueError, match=r"on the beam, from 0 to its length of 8 m, got"):
            methods[method](x)
    if method != "spin_up":
        with pytest.raises(ValueError, match="x must be finite"):
            methods[method]([0.0, np.nan])


def test_the_ends_themselves(methods):
    assert methods["state"]([0.0, 8.0]).place[0, 1] == 0.0
    round_off = np.nextafter(8.0, 9.0)
    assert methods["shapes"](round_off)[1] == pytest.approx(1.0)
