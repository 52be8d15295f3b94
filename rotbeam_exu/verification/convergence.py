"""One fit to all runs of a submission: the limit of a number or a history, its bar, the orders.

A run on n elements with the step h is taken for

    q = q₀ + C (n₀/n)ᵖ + D (h/h₀)ʳ + noise,

with the finest mesh n₀ and the smallest step h₀; C and D vary by κ from one mesh or step to the
next, for no run is wholly in the asymptotic range. Given p, r, κ, D/C and the noise the best q₀ is
a weighted sum of all runs. What is not given is taken from a grid, each point as likely as it makes
the runs. So meshes at one step, steps on one mesh, diagonals and whole grids are all of use, and a
declared order counts for as much as runs leave open. The idea is that of Gauss and Richardson's
extrapolation by C. Oates and others (2024).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike

from analytic.arrays import FloatArray
from analytic.input_checks import finite_array

_ORDERS = (0.5, 0.75, 1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0)
_VARIATIONS = {0.02: 0.4, 0.1: 0.2, 0.3: 0.2, 1.0: 0.2}  # κ: 1 where there is no rule at all
_NOISES = {0.0: 0.6, 0.3: 0.1, 3.0: 0.15, 30.0: 0.15}  # of a run, over the finest's error
_RATIOS = (0.03, 0.3, 1.0, 3.0, 30.0)  # D/C
_OWN = 0.02  # of each run's error: no pair of runs is all there is to know

_BELIEVED = 0.6
"""Weight of the declared order; the rest is any order's around two, by a factor of two."""

_DECLARED_SPREAD, _ANY_SPREAD = 0.12, 0.7  # of ln p

_COVERED = 0.96
"""Probability that the limit lies within its bar; of synthetic submissions 95 % then do."""

_MOST_FREEDOM = 2
"""Degrees of freedom by which the scale of errors is known: runs of one code are not independent,
and with more of them bars of oscillating ones cover less than nine tenths."""

_LIKELY = 1e-3  # of the likeliest: what is less has no part in a bar
_TELLING = 0.5  # bar of an order over the order, above which it is not measured

_PROBABILITIES = (np.arange(60) + 0.5) / 60.0
_STUDENT = {
    1: np.tan(np.pi * (_PROBABILITIES - 0.5)),
    2: (2.0 * _PROBABILITIES - 1.0) / np.sqrt(2.0 * _PROBABILITIES * (1.0 - _PROBABILITIES)),
}
"""Quantiles of Student's distribution by degrees of freedom."""

LEAST_SHARE = 0.7
"""Least share of the declared order; coarse meshes show 3.0 to 3.9 of an order of four."""


@dataclass(frozen=True, kw_only=True)
class Order:
    """An observed order beside the declared one. It decides nothing: a code is judged by its limit.

    Attributes
    ----------
    value, bar : float
        And its standard deviation; NaN where the runs do not tell it.
    declared : float or None
    why : str
        Why it is not measured.
    """

    value: float = math.nan
    bar: float = math.nan
    declared: float | None = None
    why: str = ""

    @property
    def low(self) -> bool:
        """True where it is less than LEAST_SHARE of the declared one."""
        return self.declared is not None and self.value < LEAST_SHARE * self.declared

    def __str__(self) -> str:
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
        The number found, and the bar of what measured it; of histories the largest size.
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

    @property
    def error_bars(self) -> FloatArray:
        """Bars of `errors`, (runs,)."""
        return self.bar + self.noise


def converged(
    elements: Sequence[int],
    steps: Sequence[float] | None,
    values: ArrayLike,
    *,
    noise: float | Sequence[float] = 0.0,
    declared: tuple[float | None, float | None] = (None, None),
) -> Convergence:
    """Fit all runs of one quantity, and return its limit with a bar that covers.

    Parameters
    ----------
    elements : sequence (runs,)
    steps : sequence (runs,), optional
        In any unit; none of what is not integrated in time.
    values : array_like (runs,) or (runs, samples)
        Numbers, or functions at the same samples.
    noise : float or sequence (runs,)
        Largest error of the measurement itself, in the unit of the values.
    declared : tuple of float, optional
        Orders in mesh and step that the author declares.

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
    made = {"elements": n, "steps": h, "noise": bars, "values": _of_rows(f)}
    if np.unique(n).size == 1:
        none = np.full(n.size, math.nan)
        why = Order(declared=declared[0], why="one mesh, three are needed")
        return Convergence(
            **made, errors=none, in_mesh=none, in_step=none, limit=math.nan, bar=math.inf,
            powers=(math.nan, math.nan), orders={"mesh": why},
        )  # fmt: skip
    y = h / (h.min() or 1.0)
    if np.unique(n).size == np.unique(h).size == n.size:
        # Steps that shrink with each mesh, and with nothing else, have no part of their own.
        y, declared = np.ones(n.size), (min(filter(None, declared), default=None), None)
    models = _models(tuple(n[-1] / n), tuple(y), declared)
    # The finest run is taken off, so that its digits are not lost.
    moved = f - f[-1]
    evidence = models.prior + models.evidence(moved @ moved.T / f.shape[1], n.size)
    best = _refined(models, int(np.argmax(evidence)), moved)
    limit = f[-1] + best.weights[0] @ moved
    mesh, step = (one[0] @ best.projections[0] @ moved for one in best.parts())
    bar = _bar(models, evidence, best.weights[0], moved) + float(np.abs(best.weights[0]) @ bars)
    return Convergence(
        **made, errors=_of_rows(f - limit), in_mesh=_of_rows(mesh),
        in_step=_of_rows(step), limit=float(_of_rows(limit[None])[0]), bar=bar,
        powers=(float(best.p[0]), float(best.r[0])),
        orders=_orders(models, evidence, best, n, h, moved, bars), growths=_growths(n, h, f, bars),
    )  # fmt: skip


def _of_rows(f: FloatArray) -> FloatArray:
    """Return numbers as they are, of functions the largest sizes."""
    return f[:, 0] if f.shape[1] == 1 else np.abs(f).max(axis=1)


@dataclass(frozen=True, kw_only=True, eq=False)
class _Models:
    """Models of errors on given meshes and steps; the first axis counts models.

    x and y are sizes over the finest. For each model the limit is `weights` times the runs, what it
    leaves unexplained is a quadratic form by `projections`, `precision` is that of the limit.
    """

    x: FloatArray
    y: FloatArray
    declared: tuple[float | None, float | None]
    p: FloatArray
    r: FloatArray
    ratio: FloatArray
    variation: FloatArray
    own: FloatArray
    prior: FloatArray
    weights: FloatArray
    projections: FloatArray
    precision: FloatArray
    volume: FloatArray

    def evidence(self, gram: FloatArray, runs: int) -> FloatArray:
        """Logarithm of how likely runs are whose products are `gram`, any scale of errors alike."""
        return self.volume - 0.5 * (runs - 1) * np.log(self.left(gram))

    def left(self, gram: FloatArray) -> FloatArray:
        """Return what each model leaves unexplained."""
        form = self.projections.reshape(len(self.p), -1) @ gram.ravel()
        return np.maximum(form, 1e-300)

    def parts(self) -> tuple[FloatArray, FloatArray]:
        """Covariances (models, runs, runs) of the errors of mesh and step."""
        return _parts(self.x, self.y, self.p, self.r, self.ratio, self.variation)


def _parts(
    x: FloatArray, y: FloatArray, p: FloatArray, r: FloatArray, ratio: FloatArray, kappa: FloatArray
) -> tuple[FloatArray, FloatArray]:
    mesh, step = x ** p[:, None], ratio[:, None] * y ** r[:, None]
    k = kappa[:, None, None] ** 2
    return (
        mesh[:, :, None] * mesh[:, None, :] * (1.0 + k * (x[:, None] == x)),
        step[:, :, None] * step[:, None, :] * (1.0 + k * (y[:, None] == y)),
    )


def _model(
    x: FloatArray, y: FloatArray, declared: tuple[float | None, float | None], prior: FloatArray,
    *of: FloatArray,
) -> _Models:  # fmt: skip
    """Return the algebra of models p, r, D/C, κ and noise."""
    p, r, ratio, kappa, own = of
    covariance = np.add(*_parts(x, y, p, r, ratio, kappa))
    each = np.arange(x.size)
    size = covariance[:, each, each]
    covariance[:, each, each] += _OWN**2 * size + (own**2 * size.min(axis=1))[:, None]
    scale = np.sqrt(covariance[:, each, each])
    both = scale[:, :, None] * scale[:, None, :]
    covariance /= both
    inverse = np.linalg.inv(covariance) / both
    sums = inverse.sum(axis=2)
    precision = sums.sum(axis=1)
    weights = sums / precision[:, None]
    volume = np.linalg.slogdet(covariance)[1] + 2.0 * np.log(scale).sum(axis=1) + np.log(precision)
    return _Models(
        x=x, y=y, declared=declared, p=p, r=r, ratio=ratio, variation=kappa, own=own, prior=prior,
        weights=weights, projections=inverse - sums[:, :, None] * weights[:, None, :],
        precision=precision, volume=-0.5 * volume,
    )  # fmt: skip


@lru_cache(maxsize=64)  # all quantities of a submission have the same meshes and steps
def _models(
    x: tuple[float, ...], y: tuple[float, ...], declared: tuple[float | None, float | None]
) -> _Models:
    """Return the grid of models; its prior is the logarithm of each one's weight."""
    stepped = len(set(y)) > 1
    p = sorted({*_ORDERS, *filter(None, declared[:1])})
    r = sorted({*_ORDERS, *filter(None, declared[1:])}) if stepped else [1.0]
    ratios = _RATIOS if stepped else (0.0,)
    axes = p, r, ratios, tuple(_VARIATIONS), tuple(_NOISES)
    shares = (
        _shares(p, declared[0]), _shares(r, declared[1]) if stepped else np.ones(1),
        np.ones(len(ratios)), list(_VARIATIONS.values()), list(_NOISES.values()),
    )  # fmt: skip
    prior = np.log(math.prod(np.meshgrid(*shares, indexing="ij"))).ravel()
    of = (one.ravel() for one in np.meshgrid(*axes, indexing="ij"))
    return _model(np.array(x), np.array(y), declared, prior, *of)


def _shares(orders: Sequence[float] | FloatArray, declared: float | None) -> FloatArray:
    """Return the share that each order of a grid has before there are runs."""
    share = _density(np.asarray(orders), declared) * np.gradient(np.log(orders))
    return np.asarray(share / share.sum())


def _density(orders: FloatArray, declared: float | None) -> FloatArray:
    """Return how dense orders are over ln p before there are runs."""
    log = np.log(orders)
    anything = np.exp(-0.5 * ((log - math.log(2.0)) / _ANY_SPREAD) ** 2) / _ANY_SPREAD
    if declared is None:
        return anything
    near = np.exp(-0.5 * ((log - math.log(declared)) / _DECLARED_SPREAD) ** 2) / _DECLARED_SPREAD
    return _BELIEVED * near + (1.0 - _BELIEVED) * anything


def _refined(models: _Models, best: int, moved: FloatArray) -> _Models:
    """Return the likeliest model, its orders sought between those of the grid by zooming in."""
    gram = moved @ moved.T / moved.shape[1]
    grids = models.p, models.r, models.ratio, models.variation, models.own
    p, r, ratio, *others = (float(one[best]) for one in grids)
    stepped, width = bool(ratio), 0.3
    for _ in range(18):
        near = width * np.array([-1.0, 0.0, 1.0])
        # Ratios of the grid are farther apart than its orders.
        around = (
            p * np.exp(near),
            r * np.exp(near * stepped),
            ratio * np.exp(4.0 * near * stepped),
        )
        of = [one.ravel() for one in np.meshgrid(*around)]
        of += [np.full(of[0].size, one) for one in others]
        prior = np.log(_density(of[0], models.declared[0]))
        prior = prior + np.log(_density(of[1], models.declared[1])) * stepped
        nearest = _model(models.x, models.y, models.declared, prior, *of)
        k = int(np.argmax(prior + nearest.evidence(gram, len(moved))))
        p, r, ratio, width = *(float(one[k]) for one in of[:3]), 0.6 * width
    of = [np.array([one]) for one in (p, r, ratio, *others)]
    return _model(models.x, models.y, models.declared, np.zeros(1), *of)


def _bar(models: _Models, evidence: FloatArray, weights: FloatArray, moved: FloatArray) -> float:
    """Return how far the limit may be off, of functions at the sample that is known worst."""
    kept = evidence > evidence.max() + math.log(_LIKELY)
    share = np.exp(evidence[kept] - evidence.max())
    share /= share.sum()
    freedom = min(len(moved) - 1, _MOST_FREEDOM)
    w, of_each = models.weights[kept], models.projections[kept]
    of_each = of_each / (freedom * models.precision[kept])[:, None, None]
    apart = w - weights
    spread = np.einsum("g,gi,gj", share, apart, apart) + np.einsum("g,gij", share, of_each)
    worst = moved[:, np.argmax(np.einsum("it,ij,jt->t", moved, spread, moved))]
    own = np.sqrt(np.maximum(np.einsum("gij,i,j->g", of_each, worst, worst), 0.0))
    off = np.abs((apart @ worst)[:, None] + own[:, None] * _STUDENT[freedom]).ravel()
    order = np.argsort(off)
    covered = np.cumsum(np.repeat(share / _PROBABILITIES.size, _PROBABILITIES.size)[order])
    return float(off[order][np.searchsorted(covered, _COVERED)])


def _orders(
    models: _Models, evidence: FloatArray, best: _Models, n: FloatArray, h: FloatArray,
    moved: FloatArray, noise: FloatArray,
) -> dict[str, Order]:  # fmt: skip
    """Return the orders as observed, whatever was declared."""
    seen = float(np.abs(moved).max()) > 4.0 * float(noise.max())
    found = {}
    for k, (name, sizes, grid, value) in enumerate(
        (("mesh", n, models.p, best.p), ("step", h, models.r, best.r))
    ):
        if name == "step" and not models.ratio.any():
            continue
        stated, count = models.declared[k], np.unique(sizes).size
        grids = np.unique(grid)
        place = np.searchsorted(grids, grid)
        free = evidence + np.log(_shares(grids, None) / _shares(grids, stated))[place]
        share = np.exp(free - free.max())
        bar = math.sqrt(float(share @ (grid - value[0]) ** 2 / share.sum()))
        why = "" if bar <= _TELLING * value[0] else "the runs do not tell it"
        if not seen:
            why = "the changes are below the floor"
        if count < 3:
            why = f"{count} {'meshes' if name == 'mesh' else 'steps'}, three are needed"
        told = {} if why else {"value": float(value[0]), "bar": bar}
        found[name] = Order(declared=stated, why=why, **told)
    return found


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
        for before, after, told in zip(rate, rate[1:], change[1:] > slack[1:], strict=False):
            streak = streak + 1 if after > before and told else 0
            most = max(most, streak)
    return most
