"""Sec. 3.1: the multiple time scales of Eqs. 46-65."""

import numpy as np
import pytest

from analytic import Beam, reduced_model


@pytest.mark.parametrize("omega", [0.0, 4.0])
def test_response_leaves_a_residual_of_fifth_order(fitted_order, omega):
    """Eq. 65 put into Eq. 41: the cubic terms cancel, with a⁵ remaining."""
    model = reduced_model(Beam.reference(), omega, "FrE")
    psi = np.linspace(0.0, 2.0 * np.pi, 64, endpoint=False)
    amplitudes, residuals = np.array([0.02, 0.04, 0.08]), []
    for a in amplitudes:
        w, b = model.frequency(a) / model.beam.frequency_scale, model.lambda_x * a**3
        x = model.response(psi / model.frequency(a), a)
        np.testing.assert_allclose(x, a * np.cos(psi) - b * np.cos(3 * psi), atol=1e-15)
        v = w * (-a * np.sin(psi) + 3 * b * np.sin(3 * psi))
        acceleration = w**2 * (-a * np.cos(psi) + 9 * b * np.cos(3 * psi))
        residual = (
            acceleration
            + model.w_n**2 * x
            + model.g1 * x**3
            + model.g2 * (x * v**2 + acceleration * x**2)
        )
        residuals.append(np.abs(residual).max())
    slope = fitted_order(amplitudes, residuals)
    assert 4.9 < slope < 5.1


def test_response_starts_below_a0_by_the_third_harmonic():
    model = reduced_model(Beam.reference(), 6.0)
    assert float(model.response(0.0, 0.1)) == pytest.approx(0.1 * (1 - model.lambda_x * 0.01))
    half_turn = np.pi / model.frequency(0.1)
    assert float(model.response(half_turn, 0.1)) == pytest.approx(-float(model.response(0.0, 0.1)))
    assert float(model.response(0.0, 0.1, phase=np.pi / 2)) == pytest.approx(0.0, abs=1e-15)
