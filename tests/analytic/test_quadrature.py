"""Polynomials on a cut interval, and integrals from its start."""

import numpy as np
import pytest

from analytic.quadrature import Grid, Running, polynomials_on


def test_polynomials_are_orthonormal_on_their_panels_and_have_their_derivatives():
    panels, h = np.array([0.0, 0.3, 1.0]), 1e-5
    grid = Grid(panels, np.array([12, 12]))
    values = polynomials_on(8, grid.points, panels).value
    assert values.T @ (grid.weights[:, None] * values) == pytest.approx(np.eye(16), abs=1e-13)
    x = np.array([0.05, 0.2, 0.4, 0.9])
    ahead, behind, here = (polynomials_on(8, x + s, panels) for s in (h, -h, 0.0))
    # Central differences err by h²/6 times a third derivative below 1e7 at this degree.
    assert (ahead.value - behind.value) / (2.0 * h) == pytest.approx(here.slope, abs=1e-3)
    assert (ahead.slope - behind.slope) / (2.0 * h) == pytest.approx(here.curvature, abs=1e-2)


def test_running_sums_are_the_matrix_of_all_points():
    """Also cut at the end of a cell, to places out of order and on ends; and its transpose."""
    rng = np.random.default_rng(0)
    grid = Grid(np.sort(np.append(rng.uniform(size=11), (0.0, 1.0))), rng.integers(4, 9, size=12))
    places = np.concatenate((grid.points, [1.0, 0.7, grid.ends[3], 0.0]))
    running, whole = Running(grid, places, [grid.ends[1]]), grid.integral(places)
    assert running.stretches[0].own == slice(0, grid.counts[0])
    inner, outer = rng.normal(size=(2, 3, grid.points.size)), rng.normal(size=(2, 3, places.size))
    assert running.of(inner) == pytest.approx(inner @ whole.T, abs=1e-14)
    assert running.beyond(outer) == pytest.approx(outer @ whole, abs=1e-14)
