"""Pseudo-arclength continuation: N equations in N + 1 unknowns, followed around folds.

Keller's method: from a point with the unit tangent t the next is sought in the plane across t at
the distance h, where the equations with t as their last row stay regular at a fold. There the last
entry of t, that of the parameter, changes its sign; the determinant of the same matrix changes its
sign where another branch crosses (Keller 1977; Govaerts, 2000, Secs. 4 and 8).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from ..arrays import FloatArray
from ..lazily import linalg, optimize

_NEWTON_STEPS = 15
_CONVERGED = 1e-12  # of the unknowns, which are of order 1
_STAGNATES = 1e-9  # where a contraction that fails is round-off
_SLOW = 0.2  # a contraction worse than this pays for a new factorization
_EASY, _HARD = 7, 11  # Newton steps that lengthen and shorten the next one
_LARGEST_TURN = 0.9  # least cosine between the tangents of two points
_HALVINGS = 12
_LOCATED = 1e-9  # of the way between two points; what is stationary there is right to the square
_SINGULAR = 1e-3  # least singular value over the next at a branch point


class Curve(Protocol):
    """Equations whose solutions form a curve; all unknowns scaled to be of order 1."""

    def residual(self, z: FloatArray) -> FloatArray:
        """Return the N residuals at the N + 1 unknowns, the parameter last."""
        ...

    def jacobian(self, z: FloatArray) -> FloatArray:
        """Return their derivatives, (N, N + 1)."""
        ...


class NoWayOnError(Exception):
    """The curve cannot be followed on; the message says why, `remedy` what else to try."""

    def __init__(self, message: str, remedy: str = "") -> None:
        super().__init__(message)
        self.remedy = remedy


@dataclass(frozen=True, eq=False)
class Point:
    """A point of a curve.

    Attributes
    ----------
    z : ndarray (N + 1,)
    tangent : ndarray (N + 1,)
        Of unit length, along the way the curve is followed.
    determinant : float
        Of the equations' Jacobian with the tangent as its last row, by its N-th root, with its
        sign: that changes where another branch crosses.
    steps : int
        Newton steps that it took.
    factors : tuple
        LU factors of that matrix.
    """

    z: FloatArray
    tangent: FloatArray
    determinant: float
    steps: int
    factors: tuple[Any, Any]


def corrected(
    curve: Curve, guess: FloatArray, across: FloatArray, factors: tuple[Any, Any] | None = None
) -> Point:
    """Return the point in the plane through `guess` across the direction `across`.

    Raises
    ------
    NoWayOnError
        If Newton's method does not converge.
    """
    z, last, fresh = guess, np.inf, False
    for count in range(1, _NEWTON_STEPS + 1):
        if factors is None:
            factors, fresh = _factored(curve.jacobian(z), across), True
        defect = np.append(curve.residual(z), across @ (z - guess))
        if not np.all(np.isfinite(defect)):
            break
        change = linalg.lu_solve(factors, defect, check_finite=False)
        z = z - change
        size = float(np.linalg.norm(change))
        contraction = size / last if np.isfinite(last) else 1.0
        if size * min(1.0, contraction) < _CONVERGED or (
            size < _STAGNATES and fresh and contraction > _SLOW
        ):
            return _with_tangent(curve, z, across, count)
        if not size < 10.0:
            break
        if contraction > _SLOW and np.isfinite(last):
            factors = None
        last = size
    raise NoWayOnError("Newton's method does not converge")


def _factored(jacobian: FloatArray, row: FloatArray) -> tuple[Any, Any]:
    factors: tuple[Any, Any] = linalg.lu_factor(np.vstack((jacobian, row)), check_finite=False)
    return factors


def _with_tangent(curve: Curve, z: FloatArray, along: FloatArray, steps: int) -> Point:
    """Return the point `z` with the tangent that goes the way of `along`."""
    jacobian = curve.jacobian(z)
    factors = _factored(jacobian, along)
    tangent = linalg.lu_solve(factors, np.eye(1, z.size, z.size - 1)[0], check_finite=False)
    # The last row of the matrix was `along`; times the length it is the tangent's, in sign.
    tangent /= np.linalg.norm(tangent)
    lu, pivots = factors
    swaps = np.count_nonzero(pivots != np.arange(pivots.size))
    diagonal = np.diag(lu)
    sign = (-1.0) ** swaps * np.prod(np.sign(diagonal))
    size = np.exp(np.log(np.maximum(np.abs(diagonal), np.finfo(float).tiny)).mean())
    return Point(z, tangent, float(sign * size), steps, factors)


def advanced(curve: Curve, point: Point, step: float, longest: float) -> tuple[Point, float]:
    """Return the next point at about the distance `step`, and the step to try after it.

    Raises
    ------
    NoWayOnError
        If no step, however short, finds one.
    """
    for _ in range(_HALVINGS):
        try:
            found = corrected(curve, point.z + step * point.tangent, point.tangent, point.factors)
        except NoWayOnError:
            step *= 0.5
            continue
        if found.tangent @ point.tangent < _LARGEST_TURN:
            step *= 0.5
            continue
        if found.steps <= _EASY:
            return found, min(1.5 * step, longest)
        return found, step if found.steps < _HARD else 0.5 * step
    raise NoWayOnError(f"steps down to {step:.1e} of the curve's length find no next point")


def located(
    curve: Curve, start: Point, end: Point, function: Callable[[Point], float]
) -> Point | None:
    """Return the point between two where `function` is zero, None if its sign does not change."""
    found: dict[float, Point] = {}
    reach = float(start.tangent @ (end.z - start.z))

    def at(share: float) -> float:
        if share not in found:
            guess = start.z + share * (end.z - start.z)
            # The plane at this distance along the start's tangent, whatever the guess.
            found[share] = corrected(curve, guess, start.tangent)
        return function(found[share])

    found[0.0], found[1.0] = start, end
    if at(0.0) * at(1.0) > 0.0 or reach == 0.0:
        return None
    share = optimize.brentq(at, 0.0, 1.0, xtol=_LOCATED)
    at(share)
    return found[share]


def crossing(curve: Curve, start: Point, end: Point) -> tuple[FloatArray, FloatArray] | None:
    """Return where another branch crosses between two points, and the way it goes there.

    At a branch point the equations' Jacobian has two null vectors: the tangent, and one that leads
    off. None if there is none in between: the determinant changes its sign through infinity too,
    where a narrow excursion of the curve is stepped over.
    """
    try:
        found = located(curve, start, end, lambda point: point.determinant)
    except NoWayOnError:
        return None
    if found is None:
        return None
    _, sizes, vectors = np.linalg.svd(curve.jacobian(found.z))
    if sizes[-1] > _SINGULAR * sizes[-2]:
        return None
    null = vectors[-2:]
    tangent = start.tangent / np.linalg.norm(null @ start.tangent)
    along = null.T @ (null @ tangent)
    # Across the tangent, within the two.
    others = null - np.outer(null @ along, along)
    off = others[int(np.argmax(np.linalg.norm(others, axis=1)))]
    return found.z, off / np.linalg.norm(off)
