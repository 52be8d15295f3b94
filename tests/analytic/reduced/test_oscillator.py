"""Eq. 41 by multiple time scales, Eqs. 46-65, and without perturbation."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.special import ellipk

from analytic import VARIANTS, Beam, reduced_model
from analytic.reduced.model_range import model_at
from analytic.reduced.oscillator import Oscillator


@pytest.mark.parametrize("omega", [0.0, 4.0])
def test_response_leaves_a_residual_of_fifth_order(fitted_order, omega):
    """Eq. 65 put into Eq. 41: the cubic terms cancel, with a⁵ remaining."""
    model = reduced_model(Beam.reference(), omega, "FrE")
    psi = np.linspace(0.0, 2.0 * np.pi, 64, endpoint=False)
    amplitudes, residuals = np.array([0.02, 0.04, 0.08]), []
    for a in amplitudes:
        w, b = model.frequency(a) / model.blade.frequency_scale, model.lambda_x * a**3
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


def equation_41(w_n, g1, g2):
    def rates(_, y):
        x, v = y
        return [v, -(w_n**2 * x + g1 * x**3 + g2 * x * v**2) / (1 + g2 * x**2)]

    return rates


@pytest.mark.parametrize("g1", [-3.0, 0.0, 5.0])
@pytest.mark.parametrize("a", [0.01, 0.5, 0.9])
def test_duffing_by_elliptic_integrals(g1, a):
    w = 2.0
    inertia_free = w**2 + g1 * a**2
    expected = math.pi * math.sqrt(inertia_free) / (2 * ellipk(g1 * a**2 / (2 * inertia_free)))
    found = Oscillator(w_n=w, g1=g1, g2=0.0).exact_frequency(np.array(a))
    assert float(found) == pytest.approx(expected, rel=1e-14)


@pytest.mark.parametrize(
    ("g1", "g2", "a"), [(-20.0, 1.1, 0.7), (14.0, 1.1, 0.9), (-20.0, 0.0, 0.78), (3.0, -0.5, 0.9)]
)
def test_period_by_integration_in_time(g1, g2, a):
    """DOP853 at 1e-12; the quarter period ends where x passes zero."""

    def crossing(_, y):
        return y[0]

    crossing.terminal = True
    w_n = 3.6
    run = solve_ivp(
        equation_41(w_n, g1, g2),
        (0.0, 10.0),
        [a, 0.0],
        method="DOP853",
        rtol=1e-12,
        atol=1e-14,
        events=crossing,
    )
    quarter = run.t_events[0][0]
    found = Oscillator(w_n=w_n, g1=g1, g2=g2).exact_frequency(np.array(a))
    assert float(found) == pytest.approx(0.5 * math.pi / quarter, rel=1e-10)


@pytest.mark.parametrize("variant", list(VARIANTS))
@pytest.mark.parametrize("speed_ratio", [0.0, 1.0, 2.0, 3.0])
def test_perturbation_error_falls_with_the_fourth_power(fitted_order, beam, variant, speed_ratio):
    model = model_at(beam, speed_ratio * beam.omega_0, VARIANTS[variant])
    a = np.array([0.02, 0.03, 0.045, 0.07])
    error = np.abs(model.frequency(a) - model.exact_frequency(a))
    assert 3.9 < fitted_order(a, error) < 4.1


def test_frequency_of_vanishing_amplitude_is_natural(beam):
    model = reduced_model(beam, 4.0, "FrM")
    assert model.exact_frequency(0.0) == pytest.approx(model.omega_n, rel=1e-15)
    assert model.frequency(0.0) == model.omega_n


def test_frequency_dies_at_the_separatrix():
    oscillator = Oscillator(w_n=3.0, g1=-20.0, g2=1.0)
    edge = oscillator.largest_amplitude
    assert edge == pytest.approx(3.0 / math.sqrt(20.0), rel=1e-6)
    # Logarithmically: 1 - (a/edge)² of 1e-2, 1e-4 and 1e-6.
    near = np.array([edge * math.sqrt(1 - gap) for gap in (1e-2, 1e-4, 0.0)])
    periods = 1.0 / oscillator.exact_frequency(near)
    steps = np.diff(periods)
    assert (steps > 0).all()
    assert steps[1] == pytest.approx(steps[0], rel=0.05)


def test_shapes_of_input_are_kept(beam):
    model = reduced_model(beam, 4.0)
    assert isinstance(model.frequency(0.1), float)
    assert isinstance(model.exact_frequency(0.1), float)
    grid = np.full((2, 3), 0.1)
    assert model.frequency(grid).shape == model.exact_frequency(grid).shape == (2, 3)
    assert model.frequency([]).shape == model.exact_frequency([]).shape == (0,)
    assert model.response(np.zeros((4, 1)), 0.1).shape == (4, 1)
    np.testing.assert_array_equal(grid, 0.1)
