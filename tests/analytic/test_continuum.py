"""The equations of motion of the exact beam against the energies in displacements."""

import numpy as np
import pytest

from analytic.exact.beam.steady import continuum
from analytic.quadrature import gauss_points
from analytic.unit_blade import UNIFORM


def test_energy_norm_of_the_coordinates_is_the_elastic_energy():
    model = continuum(1e-3, 8, 6)
    rng = np.random.default_rng(5)
    q = 0.2 * rng.normal(size=model.size)
    x, weights = gauss_points(30)
    h = 1e-6
    slope, ahead, behind = (model.slope(q, at) for at in (x, x + h, x - h))
    curvature = (slope.conj() * (ahead - behind) / (2.0 * h)).imag / np.abs(slope) ** 2
    energy = 0.5 * weights @ (curvature**2 + (np.abs(slope) - 1.0) ** 2 / 1e-3)
    assert energy == pytest.approx(0.5 * q @ q, rel=1e-7)


@pytest.mark.parametrize("shear", [None, 0.3])
def test_rates_and_gradients_of_a_shape_are_those_of_differences(shear):
    """Of the tip, the slope, the shear angle; the curvature and e' are derivatives to x."""
    model = continuum(1e-2, 6, 5, UNIFORM, shear)
    q, q_dot = 0.3 * np.random.default_rng(4).normal(size=(2, 3, model.size))
    x, h = np.array([0.2, 0.7]), 1e-6

    def rate(of):
        return (of(q + h * q_dot) - of(q - h * q_dot)) / (2.0 * h)

    assert model.tip_rate(q, q_dot) == pytest.approx(rate(model.tip), abs=1e-8)
    gradient = np.sum(model.tip_gradient(q) * q_dot, axis=1)
    assert gradient == pytest.approx(rate(model.tip), abs=1e-8)
    slope = rate(lambda at: model.slope(at, x))
    assert model.slope_rate(q, q_dot, x) == pytest.approx(slope, abs=1e-8)
    sheared = rate(lambda at: model.shear_angle(at, q_dot, x)[0])
    assert model.shear_angle(q, q_dot, x)[1] == pytest.approx(sheared, abs=1e-8)
    curvature, extension, change = (one[0] for one in model.bent(q[:1]))
    slopes = [model.slope(q[:1], model.points + step)[0] for step in (h, 0.0, -h)]
    shears = [model.shear_angle(q[:1], q_dot[:1], model.points + s)[0][0] for s in (h, 0.0, -h)]
    angles = np.array([np.angle(z) - s for z, s in zip(slopes, shears, strict=True)])
    stretches = np.array([np.abs(z) * np.cos(s) for z, s in zip(slopes, shears, strict=True)])
    assert curvature == pytest.approx((angles[0] - angles[2]) / (2.0 * h), abs=1e-6)
    assert extension == pytest.approx(stretches[1] - 1.0, abs=1e-12)
    assert change == pytest.approx((stretches[0] - stretches[2]) / (2.0 * h), abs=1e-6)
