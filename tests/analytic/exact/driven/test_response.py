"""Spin-up of the exact beam: reference values, own refinement, an independent integrator."""

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from analytic import SpinUp, SteadyRotation, Theory, spin_up_response
from analytic.methods.collocation import gauss, radau
from analytic.methods.system import Tangent


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


@pytest.mark.parametrize("method", [radau(3), radau(8), gauss(5)])
def test_one_tangent_at_all_nodes_is_solved_in_eigenvectors_as_the_whole_matrix_is(method):
    random, h, s, n = np.random.default_rng(0), 0.3, method.nodes.size, 4
    defect, *parts = random.standard_normal((4, n, n))
    tangent = Tangent(defect[0], *parts[:2], parts[2] + 3.0 * np.eye(n))
    whole = method.matrix(h, Tangent(np.zeros((s, n)), *(np.stack(s * [x]) for x in tangent[1:])))
    wanted = random.standard_normal(s * n)
    assert method.solver(h, tangent)(whole @ wanted) == pytest.approx(wanted, abs=1e-10)


def test_the_order_does_not_depend_on_the_tangent(fitted_order):
    """A pendulum by steps with the tangent of another place: Newton's root is the same."""
    method, counts, ends = radau(3), np.array([8, 12, 16, 24]), []

    def residual(q, q_dot, q_ddot):
        return q_ddot + np.sin(q)

    def tangent(*state):
        one = np.ones((3, 1, 1))
        return Tangent(residual(*state), np.cos(state[0])[..., None], 0.0 * one, one)

    one = np.ones((1, 1))
    near = Tangent(one[0], 0.5 * one, 0.0 * one, one)
    for count in (*counts, 400):
        q, q_dot, a = np.ones(1), np.zeros(1), np.zeros((3, 1))
        for _ in range(count):
            h = 2.0 / count
            a = method.step(h, q, q_dot, a, residual=residual, tangent=tangent, near=near).z
            q, q_dot = (part[-1] for part in method.stages(h, q, q_dot, a)[:2])
        ends.append(np.concatenate((q, q_dot)))
    errors = np.linalg.norm(np.array(ends[:-1]) - ends[-1], axis=1)
    assert fitted_order(1.0 / counts, errors) == pytest.approx(5.0, abs=0.3)


@pytest.mark.slow
def test_in_space_the_error_told_is_not_smaller_than_the_true_one(beam):
    """A soft twisted blade whose tip lags by a third of its length; against a finer solution."""
    blade = beam.with_section_out_of_plane(0.25, 0.2).with_twist(0.6)
    spin_up, times = SpinUp(omega=2.0, ramp_time=2.0), np.linspace(0.0, 3.0, 31)
    theory = Theory(extension=False, trapeze=False)
    *several, true = (
        spin_up_response(blade, spin_up, times, tolerance=tolerance, theory=theory)
        for tolerance in (1e-2, 1e-3, 1e-4, 1e-6)
    )
    size = np.abs(true.tip[:, 1:]).max()
    assert size > 0.1 * blade.length
    for found, tolerance in zip(several, (1e-2, 1e-3, 1e-4), strict=True):
        assert np.abs(found.tip - true.tip).max() / size < found.error < tolerance
        assert np.abs(found.twist - true.twist).max() * blade.length / size < found.error


def test_velocity_and_tip_belong_to_the_deflection(beam):
    spin_up, times = SpinUp(omega=4.0, ramp_time=3.0), np.linspace(0.0, 5.0, 1001)
    response = spin_up_response(beam, spin_up, times, tolerance=1e-6)
    assert response.q_dot == pytest.approx(CubicSpline(times, response.q)(times, 1), abs=1e-4)
    angle = spin_up.angle(times)
    x, y, _ = response.from_axis.T
    across = -np.sin(angle) * x + np.cos(angle) * y
    assert across == pytest.approx(response.q, abs=1e-12)  # Eq. 16
    assert response.tip[0] == pytest.approx([beam.length, 0.0, 0.0])


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


def test_a_beam_that_turns_already_stays_straight(beam):
    found = spin_up_response(beam, SteadyRotation(omega=6.0), [0.0, 1.0])
    assert np.abs(found.q).max() < 1e-13 * beam.length
    assert found.tip[1] == pytest.approx(found.tip[0], abs=1e-12)


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
        ([1.0], 1e-14, "at least 1e-11"),
        ([1.0], -1.0, "tolerance must be positive"),
    ],
)
def test_bad_input(beam, times, tolerance, sentence):
    with pytest.raises(ValueError, match=sentence):
        spin_up_response(beam, SpinUp(omega=1.0, ramp_time=1.0), times, tolerance=tolerance)
