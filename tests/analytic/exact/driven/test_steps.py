"""States of a motion between the ends of its steps: of polynomials they are exact."""

import numpy as np
import pytest

from analytic.exact.driven.steps import STAGES, Steps
from analytic.methods.collocation import radau


def cubic(ends, per_second):
    """Return the steps of q = τ³ with τ without units."""
    x = per_second * (ends[:-1, None] + np.outer(np.diff(ends), radau(STAGES).nodes))
    at = per_second * ends
    return Steps(ends, np.stack((at**3, 3.0 * at**2))[..., None], 6.0 * x[..., None], per_second)


@pytest.mark.parametrize("seed", range(3))
def test_nodes_and_times_of_any_steps(seed):
    """The start, the ends, and what round-off puts beyond them, as it does with some last nodes."""
    ends = np.append(0.0, np.sort(np.random.default_rng(seed).uniform(0.0, 20.0, 400)))
    steps = cubic(ends, 2.0)
    for time in (steps.nodes.ravel(), ends, np.nextafter(ends, np.inf)):
        x = 2.0 * time
        expected = np.stack((x**3, 3.0 * x**2, 6.0 * x))[..., None]
        np.testing.assert_allclose(steps.at(time), expected, rtol=1e-9, atol=1e-9)


def test_a_motion_without_steps_is_its_start():
    steps = Steps(np.zeros(1), np.array([[[2.0]], [[3.0]]]), np.empty((0, STAGES, 1)), 1.0)
    np.testing.assert_allclose(steps.at(np.zeros(2))[:, :, 0], [[2.0, 2.0], [3.0, 3.0], [0.0, 0.0]])
    assert steps.nodes.shape == (0, STAGES)
