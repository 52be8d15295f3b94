"""Newton's method with a factored tangent that serves as long as it contracts.

Of many unknowns it serves longer where a tangent's products are at hand, as their preconditioner.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from ..arrays import FloatArray
from ..lazily import linalg, sparse

Vector = Callable[[FloatArray], FloatArray]

LARGE = 1000  # unknowns, from which on a step by products costs less than new factors
_PRODUCTS, _LEFT = 40, 1e-4  # at most, and what they leave of a step


class NoOrbitError(Exception):
    """No orbit was found, or no way on; the message says why.

    Attributes
    ----------
    last : Orbit, list or None
        The last orbit found, or all along a curve.
    remedy : str
        What to try, where the usual remedies do not help.
    """

    def __init__(self, message: str, last: Any = None, remedy: str = "") -> None:
        super().__init__(message)
        self.last, self.remedy = last, remedy


class Root(NamedTuple):
    """Solution (N,) of N equations, the last factors of their tangent, and the steps it took."""

    z: FloatArray
    factors: Any
    steps: int


@dataclass(frozen=True, kw_only=True)
class Newton:
    """Newton's method, with its tolerances."""

    converged: float  # size of a change that is left out
    slow: float  # a contraction worse than this pays for a new tangent
    steps: int  # at most
    tangents: int = 100  # at most
    stagnates: float = 0.0  # size of changes that round-off no longer lets contract
    largest: float = np.inf  # size of a change that leads nowhere
    patience: float = np.inf  # unknowns, from which on a new tangent is judged by two steps
    broyden: bool = False  # improve the steps of an old tangent by what those before tell of it

    def root(
        self,
        z: FloatArray,
        residual: Vector,
        linearized: Callable[[FloatArray], tuple[Any, FloatArray]],
        *,
        size: Callable[[FloatArray, FloatArray], float] = lambda z, change: length(change),
        factors: Any = None,
        solve: Callable[[Any, FloatArray], FloatArray] | None = None,
    ) -> Root | None:
        """Return the root near `z`, None if none is found.

        Parameters
        ----------
        z : ndarray (N,)
        residual : callable
            Of z, (N,).
        linearized : callable
            Of z: the factors of the tangent and the residual.
        size : callable
            Of z and a change: small after convergence.
        factors : optional
            Factors of a tangent near by, tried first.
        solve : callable, optional
            Of factors and a residual: the change. By default `solved`, of what `factored` returns.
        """
        last, exact, tangents, steps = np.inf, False, 0, list[FloatArray]()
        anew = factors is None
        for count in range(1, self.steps + 1):
            if anew:
                tangents += 1
                if tangents > self.tangents:
                    return None
                exact, steps = True, []
                last = np.inf if z.size > self.patience else last
                (factors, defect), anew = linearized(z), False
            else:
                defect = residual(z)
            if not np.all(np.isfinite(defect)):
                return None
            change = (solve or solved)(factors, defect)
            if self.broyden:
                change = _improved(change, steps)
                steps.append(change)
            z = z - change
            now = size(z, change)
            contraction = now / last if np.isfinite(last) else 1.0
            stagnates = exact and now < self.stagnates and contraction > self.slow
            if stagnates or now * min(1.0, contraction) < self.converged:
                return Root(z, factors, count)
            if not now <= self.largest:
                return None
            if contraction > self.slow and np.isfinite(last):
                anew = True
            last = now
        return None


def length(vector: FloatArray) -> float:
    """Return the length of a vector; many times faster than numpy's norm."""
    return float(np.sqrt(vector @ vector))


def factored(matrix: FloatArray, *, single: bool = True) -> Any:
    """Return the LU factors of a matrix, which is overwritten where its order allows.

    Large ones in single precision if they may be, in half the time: good to about 1e-3 of a step.
    """
    if single and len(matrix) > LARGE:
        matrix = matrix.astype(np.float32, order="F")
    return linalg.lu_factor(matrix, overwrite_a=True, check_finite=False)


def solved(factors: Any, vector: FloatArray) -> FloatArray:
    """Return the solution of the factored equations."""
    # As `linalg.lu_solve`, whose checks take longer than it does.
    single = factors[0].dtype == np.float32
    solve = linalg.lapack.sgetrs if single else linalg.lapack.dgetrs
    return np.asarray(solve(*factors, vector)[0], dtype=float)


def by_products(
    product: Vector, factors: Any, vector: FloatArray, left: float = _LEFT
) -> FloatArray | None:
    """Return the solution of product(x) = vector, preconditioned by factors; None if too far off.

    By GMRES; `left` is what it leaves, as a share of the solution.
    """
    start = solved(factors, vector)
    if not np.all(np.isfinite(start)):
        return None
    near_one: Any = sparse.linalg.LinearOperator(
        2 * (start.size,), matvec=lambda x: solved(factors, product(x)), dtype=float
    )
    norms = [0.0]  # by the recurrence: the last residual itself has noise of single precision
    x, _ = sparse.linalg.gmres(
        near_one, start, rtol=left, restart=_PRODUCTS, maxiter=1,
        callback=norms.append, callback_type="pr_norm",
    )  # fmt: skip
    return np.asarray(x) if norms[-1] <= left else None


def _improved(step: FloatArray, steps: Sequence[FloatArray]) -> FloatArray:
    """Return a step improved by those before: Broyden's method by steps (Kelley 1995, Sec. 7.3)."""
    if not steps:
        return step
    for last, following in pairwise(steps):
        step = step + following * (last @ step) / (last @ last)
    return np.asarray(step / (1.0 - (steps[-1] @ step) / (steps[-1] @ steps[-1])))
