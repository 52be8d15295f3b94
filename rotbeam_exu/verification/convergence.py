"""One fit to all runs of a submission: the limit of a number or a history, and the orders.

Meshes at one step, steps on one mesh, diagonals and whole grids are all of use, and a declared
order counts for as much as runs leave open; `error_models` says how.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import partial

import numpy as np
from numpy.typing import ArrayLike

from analytic.arrays import FloatArray
from analytic.input_checks import finite_array

from .error_models import Declared, Models, bar_of, likeliest, models_of, shares

_TELLING = 0.5  # bar of an order over the order, above which it is not measured

_STEEPEST = 10.0
"""Order in the mesh beyond which errors fall faster than by any element that is refined, whose
order is 8 at most: exponentially, as where its degree is raised."""

_EXPONENTIAL = "exponential"

LEAST_SHARE = 0.7
"""Least share of the declared order; coarse meshes show 3.0 to 3.9 of an order of four."""


@dataclass(frozen=True, kw_only=True)
class Order:
    """An observed order and the declared one. Neither decides: a code is judged by its limit.

    Attributes
    ----------
    value, bar : float
        And its standard deviation; NaN where the runs do not determine it.
    declared : float or None
    why : str
        Why it is not measured; "exponential" of errors that fall faster than any power.
    """

    value: float = math.nan
    bar: float = math.nan
    declared: float | None = None
    why: str = ""

    @property
    def low(self) -> bool:
        """True where it is less than LEAST_SHARE of the declared one."""
        return self.declared is not None and self.value < LEAST_SHARE * self.declared

    @property
    def surely_low(self) -> bool:
        """True where it is as low with its standard deviation added."""
        return self.declared is not None and self.value + self.bar < LEAST_SHARE * self.declared

    @property
    def exponential(self) -> bool:
        """True of spectral methods and of elements whose degree is raised."""
        return self.why == _EXPONENTIAL

    def __str__(self) -> str:
        if self.exponential:
            return self.why
        if math.isnan(self.value):
            return f"not measured: {self.why}"
        return f"{self.value:.1f}" + (f" of {self.declared:g}" if self.declared else "")


@dataclass(frozen=True, kw_only=True)
class Convergence:
    """The limit of all runs, and how they tend to it; made by `converged`.

    Attributes
    ----------
    elements, steps : ndarray (runs,)
        The finest mesh last, on it the smallest step; steps are zero where there are none.
    values, noise : ndarray (runs,)
        The number found, and the uncertainty of what measured it; of histories the largest size.
    errors, in_mesh, in_step : ndarray (runs,)
        Value less limit, and the parts that mesh and step have in it; of histories the largest.
    limit, bar : float
        The number on infinitely fine meshes with infinitely small steps; NaN and infinity of a
        single mesh.
    powers : tuple of float
        p and r of the likeliest model, be they measured or not.
    orders : dict
        By "mesh", and "step" if there are several, the `Order` as observed.
    growths : int
        How often in a row changes grow from one mesh or step to the next.
    refined : str
        "step" or "tolerance", as steps are called.
    """

    elements: FloatArray = field(repr=False)
    steps: FloatArray = field(repr=False)
    values: FloatArray
    noise: FloatArray = field(repr=False)
    errors: FloatArray
    in_mesh: FloatArray = field(repr=False)
    in_step: FloatArray = field(repr=False)
    limit: float
    bar: float
    powers: tuple[float, float]
    orders: dict[str, Order]
    growths: int = 0
    refined: str = "step"


def converged(
    elements: Sequence[int],
    steps: Sequence[float] | None,
    values: ArrayLike,
    *,
    noise: float | Sequence[float] = 0.0,
    declared: Declared = (None, None),
    refined: str = "step",
) -> Convergence:
    """Fit all runs of one quantity, and return its limit with an uncertainty that covers.

    Parameters
    ----------
    elements : sequence (runs,)
    steps : sequence (runs,), optional
        In any unit, or tolerances; none of what is not integrated in time.
    values : array_like (runs,) or (runs, samples)
        Numbers, or functions at the same samples.
    noise : float or sequence (runs,)
        Largest error of the measurement itself, in the unit of the values.
    declared : tuple of float, optional
        Orders in mesh and step that the author declares.
    refined : str, optional
        "step" or "tolerance", as `steps` are called.

    Raises
    ------
    ValueError
        If there is no run, a resolution is there twice or not positive, or a value is not finite.
    """
    n, f = finite_array("elements", elements), finite_array("values", values)
    h = np.zeros(n.shape) if steps is None else finite_array("steps", steps)
    if not n.size or not n.shape == h.shape == f.shape[:1]:
        raise ValueError(f"each run has a mesh, a step and a value, got {n.size} and {len(f)}")
    if (n <= 0.0).any() or (h < 0.0).any() or len(set(zip(n, h, strict=True))) < n.size:
        raise ValueError("meshes and steps must be positive, and no two runs the same in both")
    finest_last = np.lexsort((-h, n))
    n, h, f = n[finest_last], h[finest_last], f[finest_last].reshape(n.size, -1)
    bars = np.broadcast_to(finite_array("noise", noise), n.shape)[finest_last]
    made = partial(
        Convergence, elements=n, steps=h, noise=bars, values=_of_rows(f), refined=refined
    )
    if np.unique(n).size == 1:
        none = np.full(n.size, math.nan)
        why = Order(declared=declared[0], why="one mesh, three are needed")
        return made(
            errors=none, in_mesh=none, in_step=none, limit=math.nan, bar=math.inf,
            powers=(math.nan, math.nan), orders={"mesh": why},
        )  # fmt: skip
    y = h / (h.min() or 1.0)
    if np.unique(n).size == np.unique(h).size == n.size:
        # Steps that shrink with each mesh, and with nothing else, have no part of their own.
        y, declared = np.ones(n.size), (min(filter(None, declared), default=None), None)
    models = models_of(tuple(n[-1] / n), tuple(y), declared)
    # The finest run is taken off, so that its digits are not lost.
    moved = f - f[-1]
    evidence = models.evidence(moved)
    best = likeliest(models, evidence, moved)
    limit = f[-1] + best.weights[0] @ moved
    mesh, step = (one[0] @ best.projections[0] @ moved for one in best.parts())
    bar = bar_of(models, evidence, best.weights[0], moved) + float(np.abs(best.weights[0]) @ bars)
    return made(
        errors=_of_rows(f - limit), in_mesh=_of_rows(mesh),
        in_step=_of_rows(step), limit=float(_of_rows(limit[None])[0]), bar=bar,
        powers=(float(best.given[0][0]), float(best.given[1][0])),
        orders=_orders(models, evidence, best, n, h, moved, bars, refined),
        growths=_growths(n, h, f, bars),
    )  # fmt: skip


def _of_rows(f: FloatArray) -> FloatArray:
    """Return numbers as they are, of functions the largest sizes."""
    return f[:, 0] if f.shape[1] == 1 else np.abs(f).max(axis=1)


def _orders(
    models: Models, evidence: FloatArray, best: Models, n: FloatArray, h: FloatArray,
    moved: FloatArray, noise: FloatArray, refined: str,
) -> dict[str, Order]:  # fmt: skip
    """Return the orders as observed, whatever was declared."""
    visible = float(np.abs(moved).max()) > 4.0 * float(noise.max())
    orders = {}
    for k, (name, sizes) in enumerate((("mesh", n), ("step", h))):
        if name == "step" and not models.given[2].any():
            continue
        grid, value = models.given[k], float(best.given[k][0])
        stated, count = models.declared[k], np.unique(sizes).size
        grids = np.unique(grid)
        place = np.searchsorted(grids, grid)
        free = evidence + np.log(shares(grids, None) / shares(grids, stated))[place]
        share = np.exp(free - free.max())
        bar = math.sqrt(float(share @ (grid - value) ** 2 / share.sum()))
        why = "" if bar <= _TELLING * value else "the runs do not determine it"
        if not visible:
            why = "the changes are below the floor"
        if name == "mesh" and visible and value > max(_STEEPEST, stated or 0.0):
            why = _EXPONENTIAL
        if count < 3:
            why = f"{count} {'meshes' if name == 'mesh' else refined + 's'}, three are needed"
        estimate = {} if why else {"value": value, "bar": bar}
        orders[name] = Order(declared=stated, why=why, **estimate)
    return orders


def _growths(n: FloatArray, h: FloatArray, f: FloatArray, noise: FloatArray) -> int:
    """Return how often in a row changes grow, over their share of ln n or ln h."""
    rows = [(np.flatnonzero(h == one), np.log(n)) for one in np.unique(h)]
    rows += [(np.flatnonzero(n == one), -np.log(np.maximum(h, 1e-300))) for one in np.unique(n)]
    if all(len(row) < 3 for row, _ in rows):
        last = np.flatnonzero(np.append(np.diff(n) > 0.0, [True]))  # of each mesh its finest
        rows = [(last, np.log(n))]
    most = 0
    for row, level in rows:
        change = np.abs(np.diff(f[row], axis=0)).max(axis=1) if len(row) > 1 else np.empty(0)
        slack = noise[row][1:] + noise[row][:-1]
        rate, streak = change / np.diff(level[row]), 0
        for before, after, counts in zip(rate, rate[1:], change[1:] > slack[1:], strict=False):
            streak = streak + 1 if after > before and counts else 0
            most = max(most, streak)
    return most
