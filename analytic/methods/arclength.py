"""Pseudo-arclength continuation: N equations in N + 1 unknowns, followed around folds.

Keller's method: from a point with the unit tangent t the next point is sought in the plane normal
to t at the distance h. The equations with t as their last row stay regular at a fold. There the
last entry of t, the parameter's, changes its sign; the determinant of the same matrix changes its
sign where another branch crosses (Keller 1977; Govaerts, 2000, Secs. 4 and 8).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, partial
from typing import Any, Protocol

import numpy as np

from ..arrays import FloatArray
from ..lazily import linalg, optimize
from .newton import LARGE, Newton, NoOrbitError, Vector, by_products, factored, length, solved

# Of the unknowns, which are of order 1.
_NEWTON = Newton(converged=1e-12, stagnates=1e-9, slow=0.2, steps=15, largest=10.0)
_EASY, _HARD = 7, 11  # Newton steps that lengthen and shorten the next one
_LARGEST_TURN = 0.9  # least cosine between the tangents of two points
_HALVINGS = 12
_LOCATED = 1e-9  # of the way between two points; what is stationary there is right to the square
_TANGENT = 1e-6  # of a tangent's length, that products may leave, twice
_ENOUGH, _SMALL = 7, 0.1  # values that tell whether a determinant gets small, over both ends
_SINGULAR = 1e-3  # least singular value over the next at a branch point


class Curve(Protocol):
    """Equations whose solutions form a curve; all unknowns scaled to be of order 1."""

    def residual(self, z: FloatArray) -> FloatArray:
        """Return the N residuals at the N + 1 unknowns, the parameter last."""

    def jacobian(self, z: FloatArray) -> FloatArray:
        """Return their derivatives, (N, N + 1)."""

    def products(self, z: FloatArray) -> Vector:
        """Return the function that multiplies them with a vector (N + 1,)."""


@dataclass(frozen=True, eq=False)
class Point:
    """A point of a curve.

    Its matrix is the equations' Jacobian with a vector along the tangent as its last row. The
    factors are those of the matrix here or, of many unknowns, at a point before.
    """

    z: FloatArray  # (N + 1,)
    tangent: FloatArray  # (N + 1,) of unit length, along the way the curve is followed
    steps: int  # of Newton's method
    factors: Any
    matrix: Callable[[], FloatArray]
    factors_here: Any  # factors of the matrix here, if they were made

    @cached_property
    def determinant(self) -> float:
        """Determinant of the matrix in sign, which changes where a branch crosses.

        In size what a right side of unit length is over its solution: zero there, and smooth.
        """
        lu, pivots = self.factors_here or linalg.lu_factor(self.matrix(), check_finite=False)
        swaps = np.count_nonzero(pivots != np.arange(pivots.size))
        sign = (-1.0) ** swaps * np.prod(np.sign(np.diag(lu)))
        side = np.random.default_rng(0).normal(size=self.z.size)
        return float(sign * length(side) / length(solved((lu, pivots), side)))


def corrected(
    curve: Curve, guess: FloatArray, across: FloatArray, factors: tuple[Any, Any] | None = None
) -> Point:
    """Return the point in the plane through `guess` across `across`; raises NoOrbitError."""

    def residual(z: FloatArray) -> FloatArray:
        return np.append(curve.residual(z), across @ (z - guess))

    def matrix(z: FloatArray) -> FloatArray:
        return np.vstack((curve.jacobian(z), across))

    def products(z: FloatArray) -> Vector:
        product = curve.products(z)
        return lambda change: np.append(product(change), across @ change)

    root = _NEWTON.root(
        guess,
        residual,
        lambda z: (factored(matrix(z)), residual(z)),
        factors=factors,
        products=products,
    )
    if root is None:
        raise NoOrbitError("Newton's method does not converge")
    # The last row of the matrix is `across`; times the length it is the tangent's, in sign.
    z, last, here = root.z, np.eye(1, guess.size, guess.size - 1)[0], None
    if z.size > LARGE:
        factors, product = root.factors, products(z)
        tangent = _by_products(product, factors, last)
        if tangent is None:
            factors = factored(matrix(z))
            tangent = _by_products(product, factors, last)
        if tangent is None:
            raise NoOrbitError("the curve's direction is not found")
    else:
        factors = here = factored(matrix(z))
        tangent = solved(factors, last)
    tangent /= np.linalg.norm(tangent)
    return Point(z, tangent, root.steps, factors, partial(matrix, z), here)


def _by_products(product: Vector, factors: Any, vector: FloatArray) -> FloatArray | None:
    """Return the same as `by_products`, with what single precision left of it."""
    first = by_products(product, factors, vector, _TANGENT)
    if first is None:
        return None
    second = by_products(product, factors, vector - product(first), _TANGENT)
    return None if second is None else first + second


def advanced(curve: Curve, point: Point, step: float, longest: float) -> tuple[Point, float]:
    """Return the next point at about `step`, and the step after it; raises NoOrbitError."""
    for _ in range(_HALVINGS):
        try:
            ahead = corrected(curve, point.z + step * point.tangent, point.tangent, point.factors)
        except NoOrbitError:
            step *= 0.5
            continue
        if ahead.tangent @ point.tangent < _LARGEST_TURN:
            step *= 0.5
            continue
        if ahead.steps <= _EASY:
            return ahead, min(1.5 * step, longest)
        return ahead, step if ahead.steps < _HARD else 0.5 * step
    raise NoOrbitError(f"steps down to {step:.1e} of the curve's length find no next point")


def located(
    curve: Curve, start: Point, end: Point, function: Callable[[Point], float]
) -> Point | None:
    """Return the point between two where `function` is zero, None if its sign does not change."""
    points: dict[float, Point] = {}
    reach = float(start.tangent @ (end.z - start.z))

    def at(share: float) -> float:
        if share not in points:
            guess = start.z + share * (end.z - start.z)
            # The plane at this distance along the start's tangent, whatever the guess.
            points[share] = corrected(curve, guess, start.tangent, start.factors)
        return function(points[share])

    points[0.0], points[1.0] = start, end
    if at(0.0) * at(1.0) > 0.0 or reach == 0.0:
        return None
    share = optimize.brentq(at, 0.0, 1.0, xtol=_LOCATED)
    at(share)
    return points[share]


def crossing(curve: Curve, start: Point, end: Point) -> FloatArray | None:
    """Return where another branch crosses between two points, if one does.

    There the equations' Jacobian has two null vectors. The determinant changes its sign through
    infinity too, where a narrow excursion of the curve is stepped over.
    """
    determinants = list[float]()

    def singular(point: Point) -> float:
        determinants.append(abs(point.determinant))
        if len(determinants) > _ENOUGH and determinants[-1] > _SMALL * min(determinants[:2]):
            raise NoOrbitError("the determinant changes its sign, but not through zero")
        return point.determinant

    try:
        crossed = located(curve, start, end, singular)
    except NoOrbitError:
        return None
    if crossed is None:
        return None
    sizes = np.linalg.svd(curve.jacobian(crossed.z), compute_uv=False)
    # N singular values of N rows: the tangent's is not among them.
    return crossed.z if sizes[-1] <= _SINGULAR * sizes[-2] else None
