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
from itertools import count
from typing import Any, Protocol

import numpy as np

from ..arrays import FloatArray
from ..lazily import optimize
from .newton import LARGE, Newton, NoOrbitError, Vector, by_products, factored, length, solved

# Of the unknowns, which are of order 1.
_NEWTON = Newton(converged=1e-12, stagnates=1e-9, slow=0.2, steps=15, largest=10.0, patience=LARGE)
_EASY, _HARD = 7, 11  # Newton steps that lengthen and shorten the next one
_LARGEST_TURN = 0.9  # least cosine between the tangents of two points
_HALVINGS = 12
_LOCATED = 1e-9  # of the way between two points; what is stationary there is right to the square
_TANGENT = 1e-6  # of a tangent's length, that products may leave, twice
_DIFFERENCE = 1e-5  # of the unknowns
_ENOUGH, _SMALL = 7, 0.1  # values that tell whether a determinant gets small, over both ends
_SINGULAR = 1e-3  # least singular value over the next at a branch point


class Curve(Protocol):
    """Equations whose solutions form a curve; all unknowns scaled to be of order 1."""

    def residual(self, z: FloatArray) -> FloatArray:
        """Return the N residuals at the N + 1 unknowns, the parameter last."""

    def jacobian(self, z: FloatArray, *, coarse: bool = False) -> FloatArray:
        """Return their derivatives, (N, N + 1); of many unknowns they may be `coarse`."""


@dataclass(frozen=True, eq=False)
class Point:
    """A point of a curve.

    Its matrix is the equations' Jacobian with a vector along the tangent as its last row. Of many
    unknowns the factors are those of a coarse one.
    """

    z: FloatArray  # (N + 1,)
    tangent: FloatArray  # (N + 1,) of unit length, along the way the curve is followed
    steps: int  # of Newton's method
    factors: Any
    matrix: Callable[[], FloatArray]

    @cached_property
    def near_determinant(self) -> float:
        """Determinant of the matrix that the factors are of.

        In size what a right side of unit length is over its solution: zero where a branch crosses,
        where the sign changes, and smooth.
        """
        return _determinant(self.factors)

    @cached_property
    def determinant(self) -> float:
        """The same of the matrix itself."""
        if self.z.size <= LARGE:
            return self.near_determinant
        return _determinant(factored(self.matrix(), single=False))


def _determinant(factors: Any) -> float:
    lu, pivots = factors
    swaps = np.count_nonzero(pivots != np.arange(pivots.size))
    sign = (-1.0) ** swaps * np.prod(np.sign(np.diag(lu)))
    side = np.random.default_rng(0).normal(size=pivots.size)
    return float(sign * length(side) / length(solved(factors, side)))


def corrected(
    curve: Curve, guess: FloatArray, across: FloatArray, factors: tuple[Any, Any] | None = None
) -> Point:
    """Return the point in the plane through `guess` across `across`; raises NoOrbitError."""

    def residual(z: FloatArray) -> FloatArray:
        return np.append(curve.residual(z), across @ (z - guess))

    many, made = guess.size > LARGE, count()

    def matrix(z: FloatArray, **kind: bool) -> FloatArray:
        return np.vstack((curve.jacobian(z, **kind), across))

    def near(z: FloatArray) -> Any:
        # Where coarse ones contract slowly exact ones follow.
        return factored(matrix(z, coarse=True) if many and next(made) == 0 else matrix(z))

    root = _NEWTON.root(guess, residual, lambda z: (near(z), residual(z)), factors=factors)
    if root is None:
        raise NoOrbitError("Newton's method does not converge")
    # The last row of the matrix is `across`; times the length it is the tangent's, in sign.
    z, last = root.z, np.eye(1, guess.size, guess.size - 1)[0]
    # For many unknowns the factors of this iteration are near enough.
    factors = near(z) if not many or root.factors is factors else root.factors
    tangent = _by_products(_differences(residual, z), factors, last) if many else None
    if tangent is None:
        tangent = solved(factored(matrix(z)) if many else factors, last)
    tangent /= np.linalg.norm(tangent)
    steps = root.steps // 2 if many else root.steps  # by a coarse tangent they are shorter
    return Point(z, tangent, steps, factors, partial(matrix, z))


def _differences(function: Vector, z: FloatArray) -> Vector:
    """Return the function that multiplies derivatives at `z` with a vector."""

    def product(change: FloatArray) -> FloatArray:
        step = _DIFFERENCE / length(change)
        ahead, behind = (function(z + by * change) for by in (step, -step))
        return (ahead - behind) / (2.0 * step)

    return product


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
    near = np.array([start.near_determinant, end.near_determinant])
    if np.prod(near) > 0.0 and np.ptp(np.log(np.abs(near))) < -np.log(_SMALL):
        return None
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
