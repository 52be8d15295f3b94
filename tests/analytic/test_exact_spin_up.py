"""Spin-up of the exact beam: reference values, own refinement, an independent integrator."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline

from analytic import SpinUp, SteadyRotation, spin_up_response
from analytic.exact.beam.state import Driven
from analytic.exact.beam.steady import continuum
from analytic.methods.collocation import radau


def test_reference_values(beam):
    response = spin_up_response(
        beam, SpinUp(omega=6.0, ramp_time=3.0), [1.5, 3.0, 6.0, 10.0, 15.0], tolerance=1e-6
    )
    assert response.error < 1e-6
    expected = [-4.887901, 1.441960, 2.349072, -0.895043, -0.287494]
    assert response.q == pytest.approx(expected, abs=1e-6)


@pytest.mark.slow
def test_hardest_case_agrees_with_its_refinement_to_1e_8(beam):
    spin_up, times = SpinUp(omega=8.0, ramp_time=2.0), np.linspace(0.0, 15.0, 1501)
    response = spin_up_response(beam, spin_up, times)
    finer = spin_up_response(beam, spin_up, times, tolerance=1e-10)
    true = np.abs(response.q - finer.q).max() / np.abs(finer.q).max()
    assert finer.steps > response.steps
    assert finer.functions > response.functions
    assert true < response.error < 1e-8


def test_agrees_with_a_library_integrator(beam):
    """The same small discretization by scipy's Radau, accelerations from a linear solve."""
    spin_up = SpinUp(omega=6.0, ramp_time=1.0)
    model, per_second = continuum(beam.slenderness, 6, 3), beam.frequency_scale
    n = model.size

    def derivative(tau, y):
        q, q_dot = y[None, :n], y[None, n:]
        rates = (
            spin_up.rate(tau / per_second) / per_second,
            spin_up.acceleration(tau / per_second) / per_second**2,
        )
        at = model.tangent(q, q_dot, np.zeros_like(q), Driven(*rates))
        return np.append(q_dot, -np.linalg.solve(at.mass[0], at.residual[0]))

    end = 0.5 * per_second
    library = solve_ivp(
        derivative, (0.0, end), np.zeros(2 * n), method="Radau", rtol=1e-8, atol=1e-10
    )
    method, steps = radau(8), 20
    h = end / steps
    q, q_dot, acceleration = np.zeros(n), np.zeros(n), np.zeros((8, n))
    for k in range(steps):
        times = (k + method.nodes) * h / per_second
        rates = spin_up.rate(times) / per_second, spin_up.acceleration(times) / per_second**2
        acceleration = method.step(
            h,
            q,
            q_dot,
            acceleration,
            residual=lambda *state, rates=rates: model.residual(*state, Driven(*rates)),
            tangent=lambda *state, rates=rates: model.tangent(*state, Driven(*rates)),
        ).z
        positions, velocities, _ = method.stages(h, q, q_dot, acceleration)
        q, q_dot = positions[-1], velocities[-1]
    ours, theirs = model.tip(q), model.tip(library.y[:n, -1])
    assert abs(ours - theirs) < 1e-6  # of the length; the library's own error at 1e-8 a step


def test_order_of_the_collocation(fitted_order):
    """ÿ = -y: order 2s - 1 of Radau IIA."""
    method = radau(3)
    counts = np.array([8, 12, 16, 24])
    errors = []
    for count in counts:
        h, y, y_dot = 2.0 / count, 1.0, 0.0
        for _ in range(count):
            matrix = np.eye(3) + h**2 * method.position
            a = -np.linalg.solve(matrix, y + h * method.nodes * y_dot)
            y += h * y_dot + h**2 * method.position[-1] @ a
            y_dot += h * method.velocity[-1] @ a
        errors.append(np.hypot(y - np.cos(2.0), y_dot + np.sin(2.0)))
    assert fitted_order(1.0 / counts, errors) == pytest.approx(5.0, abs=0.2)


def test_velocity_and_tip_belong_to_the_deflection(beam):
    spin_up, times = SpinUp(omega=4.0, ramp_time=3.0), np.linspace(0.0, 5.0, 1001)
    response = spin_up_response(beam, spin_up, times, tolerance=1e-6)
    assert response.q_dot == pytest.approx(CubicSpline(times, response.q)(times, 1), abs=1e-4)
    angle = spin_up.angle(times)
    across = -np.sin(angle) * response.tip[:, 0] + np.cos(angle) * response.tip[:, 1]
    assert across == pytest.approx(response.q, abs=1e-12)  # Eq. 16
    assert response.tip[0] == pytest.approx([beam.length, 0.0])


def test_times_may_repeat_and_stand_still(beam):
    spin_up = SpinUp(omega=6.0, ramp_time=3.0)
    once = spin_up_response(beam, spin_up, [0.5, 1.0], tolerance=1e-5)
    twice = spin_up_response(beam, spin_up, [0.0, 0.5, 0.5, 1.0, 1.0], tolerance=1e-5)
    # Sums of one sample and of two may be rounded differently.
    assert twice.q == pytest.approx([0.0, *np.repeat(once.q, 2)], rel=1e-14)
    assert spin_up_response(beam, spin_up, [0.0, 0.0]).q.tolist() == [0.0, 0.0]


def test_a_ramp_far_shorter_than_the_period_is_a_blow(beam):
    """The beam keeps its place for an instant: the clamp's turn is what the tip lags behind."""
    spin_up, time = SpinUp(omega=0.1, ramp_time=1e-4), 0.02
    response = spin_up_response(beam, spin_up, [time], tolerance=1e-3)
    # Bending waves have reached √(√(EI/ρA) t) = 0.13 of the length from the clamp.
    assert response.q[0] == pytest.approx(-beam.length * spin_up.angle(time), rel=1e-3)


def test_a_slow_spin_up_is_that_of_a_faster_one_scaled(beam):
    """Linear in ω where nothing but the Euler force counts, down to 1e-9 rad/s."""
    slow, slower = (
        spin_up_response(beam, SpinUp(omega=omega, ramp_time=3.0), [4.0], tolerance=1e-5).q[0]
        for omega in (1e-4, 1e-9)
    )
    assert slower / 1e-9 == pytest.approx(slow / 1e-4, rel=1e-5)


def test_a_beam_that_turns_already_is_no_spin_up(beam):
    with pytest.raises(TypeError, match="a SpeedTable or another SpeedChange, got SteadyRotat"):
        spin_up_response(beam, SteadyRotation(omega=6.0), [1.0])


def test_no_rotation_no_motion(beam):
    response = spin_up_response(beam, SpinUp(omega=0.0, ramp_time=1.0), [0.0, 2.0])
    assert response.q == pytest.approx(0.0, abs=0.0)
    assert response.error < 1e-12


@pytest.mark.parametrize(
    ("times", "tolerance", "sentence"),
    [
        ([-1.0, 1.0], 1e-8, "ascend from 0 s on"),
        ([2.0, 1.0], 1e-8, "ascend from 0 s on"),
        ([1.0, np.nan], 1e-8, "times must be finite"),
        ([], 1e-8, "times must be a sequence of numbers"),
        ([1e12], 1e-8, "steps, more than the 1e\\+05 at most"),
        ([1.0], 1e-14, "at least 1e-11"),
        ([1.0], -1.0, "tolerance must be positive"),
    ],
)
def test_bad_input(beam, times, tolerance, sentence):
    with pytest.raises(ValueError, match=sentence):
        spin_up_response(beam, SpinUp(omega=1.0, ramp_time=1.0), times, tolerance=tolerance)
