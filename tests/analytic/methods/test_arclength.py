"""Arclength continuation on curves that are known: a fold, and a pitchfork."""

from itertools import pairwise

import numpy as np
import pytest

from analytic.methods.arclength import advanced, corrected, crossing, located
from analytic.methods.newton import NoOrbitError


@pytest.fixture(params=["few", "many"], autouse=True)
def unknowns(request, monkeypatch):
    """Few unknowns, or as of many: coarse factors, and directions by differences."""
    if request.param == "many":
        monkeypatch.setattr("analytic.methods.arclength.LARGE", 0)


class Circle:
    """x² + p² = 1: two folds in p."""

    def residual(self, z):
        return np.array([z @ z - 1.0])

    def jacobian(self, z, *, coarse=False):
        return (1.8 if coarse else 2.0) * z[None]


class Pitchfork:
    """x (x² + y - p) = 0 and y - x² p = 0: the branch x = y = 0, and one that crosses it at p = 0.

    On that x² + x² p - p = 0, so that x² = p/(1 + p).
    """

    def residual(self, z):
        x, y, p = z
        return np.array([x * (x**2 + y - p), y - x**2 * p])

    def jacobian(self, z, *, coarse=False):
        x, y, p = z
        return np.array([[3.0 * x**2 + y - p, x, -x], [-2.0 * x * p, 1.0, -(x**2)]])


def followed(curve, z, tangent, count, step=0.1):
    point = corrected(curve, np.array(z, dtype=float), np.array(tangent, dtype=float))
    points = [point]
    for _ in range(count):
        point, step = advanced(curve, point, step, 0.2)
        points.append(point)
    return points


def test_around_a_circle_through_both_folds():
    points = followed(Circle(), (0.0, 1.0), (1.0, 0.0), 80)
    around = np.unwrap([np.arctan2(point.z[1], point.z[0]) for point in points])
    assert np.all(np.diff(around) < 0.0)
    assert around[0] - around[-1] > 2.0 * np.pi
    folds = [
        located(Circle(), one, other, lambda point: float(point.tangent[-1]))
        for one, other in pairwise(points)
    ]
    found = [fold.z for fold in folds if fold is not None]
    assert len(found) >= 2
    for z in found:
        assert np.abs(z) == pytest.approx([0.0, 1.0], abs=1e-9)
    assert not any(one.determinant * other.determinant < 0.0
                   for one, other in pairwise(points))  # fmt: skip


def test_a_pitchfork_is_found():
    curve = Pitchfork()
    points = followed(curve, (0.0, 0.0, -0.5), (0.0, 0.0, 1.0), 10)
    pairs = [pair for pair in pairwise(points)
             if pair[0].determinant * pair[1].determinant < 0.0]  # fmt: skip
    (pair,) = pairs
    assert crossing(curve, *pair) == pytest.approx(np.zeros(3), abs=1e-9)


def test_where_there_is_no_curve_it_says_so():
    class Nowhere(Circle):
        def residual(self, z):
            return np.array([z @ z + 1.0])

    with pytest.raises(NoOrbitError, match="does not converge"):
        corrected(Nowhere(), np.array([0.5, 0.5]), np.array([0.0, 1.0]))
