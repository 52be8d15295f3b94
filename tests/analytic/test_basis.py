"""The clamped polynomial bases, against calculus and the cantilever's frequencies."""

import numpy as np
import pytest
from scipy import linalg

from analytic.quadrature import Grid, Running, axial_basis, gauss_points, transverse_basis


@pytest.mark.parametrize("basis", [transverse_basis, axial_basis])
def test_derivatives_and_clamp(basis):
    x, h = np.linspace(0.1, 0.9, 9), 1e-5
    ahead, behind, here = basis(10, x + h), basis(10, x - h), basis(10, x)
    # Central differences err by h²/6 times a third derivative below 1e6 at this degree.
    assert np.allclose((ahead.value - behind.value) / (2 * h), here.slope, atol=1e-4)
    assert np.allclose((ahead.slope - behind.slope) / (2 * h), here.curvature, atol=1e-4)
    root = basis(10, np.zeros(1))
    assert np.allclose(root.value, 0.0, atol=1e-14)
    if basis is transverse_basis:
        assert np.allclose(root.slope, 0.0, atol=1e-14)


def test_stiffness_is_the_identity():
    x, w = gauss_points(50)
    for matrix in (transverse_basis(40, x).curvature, axial_basis(40, x).slope):
        assert np.allclose(matrix.T @ (w[:, None] * matrix), np.eye(40), atol=1e-12)


def test_cantilever_frequencies_converge_spectrally():
    exact = np.array([3.516015269, 22.03449156, 61.69721441])
    x, w = gauss_points(40)
    errors = []
    for count in (6, 8, 10, 12, 20):
        basis = transverse_basis(count, x)
        stiffness = basis.curvature.T @ (w[:, None] * basis.curvature)
        mass = basis.value.T @ (w[:, None] * basis.value)
        # The other way round, K x = w² M x, would lose digits to the small eigenvalues of M.
        found = linalg.eigh(mass, stiffness, eigvals_only=True)[:-4:-1] ** -0.5
        errors.append(np.abs(found / exact - 1.0).max())
    assert errors[0] > 1e-5
    assert errors[3] < 1e-8
    # The literature's ten digits: half a unit in the last of 22.03449156 is 2.3e-10.
    assert errors[-1] < 2.3e-10


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
