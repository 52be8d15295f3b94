"""Limits and invariances of the reduced models."""

import dataclasses

import numpy as np
import pytest

from analytic import VARIANTS, Beam, Variant, reduced_model
from analytic.reduced.lagrangian import energy_coefficients
from analytic.reduced.model_range import model_at
from analytic.reduced.shapes import CantileverMode, rotating_mode

BEAM = Beam.reference()


@pytest.mark.parametrize("variant", ["CI", "CE", "FrI", "FrE", "FrC", "FrM"])
def test_at_rest(beam, variant):
    model = reduced_model(beam, 0.0, variant)
    assert model.omega_n == pytest.approx(beam.omega_0, rel=1e-13)
    # By 30-digit quadrature of the same integrals.
    assert model.lambda_omega == pytest.approx(-0.01938354688117, abs=1e-13)
    assert model.oscillator.lambda_x == pytest.approx(0.04626775131107, abs=1e-13)


@pytest.mark.parametrize("variant", list(VARIANTS))
def test_slow_rotation_approaches_rest_quadratically(fitted_order, beam, variant):
    rest = model_at(beam, 0.0, VARIANTS[variant]).lambda_omega
    speeds = np.array([0.01, 0.02, 0.04])
    change = [
        abs(model_at(beam, s * beam.omega_0, VARIANTS[variant]).lambda_omega - rest) for s in speeds
    ]
    assert fitted_order(speeds, change) == pytest.approx(2.0, abs=0.02)


@pytest.mark.parametrize("shape", [CantileverMode(), rotating_mode(7.0)], ids=["C", "Fr"])
def test_stiff_axis_makes_exact_elongation_the_consistent_foreshortening(shape):
    static, consistent = (energy_coefficients(shape, a) for a in ("static", "consistent"))
    assert static.omega_n_squared(7.0, 0.0) == consistent.omega_n_squared(7.0, 0.0)
    assert static.g1(7.0) == pytest.approx(consistent.g1(7.0), rel=1e-13)
    assert static.g2 == consistent.g2
    # The paper's sine and its inextensible line do not reach that limit.
    for axial in ("sine", "inextensible"):
        assert abs(energy_coefficients(shape, axial).g1(7.0) / consistent.g1(7.0) - 1) > 0.05


def test_difference_to_the_consistent_model_falls_with_slenderness(fitted_order):
    static = Variant(name="static", shape="rotating", axial="static")
    slenderness = np.array([1e-7, 1e-6, 1e-5])
    differences = []
    for mu in slenderness:
        beam = dataclasses.replace(BEAM, second_moment=mu * BEAM.area * BEAM.length**2)
        omega = 2.0 * beam.omega_0
        differences.append(
            abs(
                reduced_model(beam, omega, static).lambda_omega
                - reduced_model(beam, omega, "FrC").lambda_omega
            )
        )
    assert fitted_order(slenderness, differences) == pytest.approx(1, abs=0.01)
