"""Models of how errors depend on mesh and step, and the limit of runs by all of them.

A run on n elements with the step h is taken for

    q = q₀ + C (n₀/n)ᵖ + D (h/h₀)ʳ + noise,

with the finest mesh n₀ and the smallest step h₀; C and D vary by κ from one mesh or step to the
next, or by less on finer ones, for no run is wholly in the asymptotic range. Given p, r, κ, D/C and
the noise the best q₀ is a weighted sum of all runs. What is not given is taken from a grid, each
point as likely as it makes the runs. The idea is that of Gauss and Richardson's extrapolation by
C. Oates and others (2024).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from analytic.arrays import FloatArray
from analytic.lazily import special

Declared = tuple[float | None, float | None]
"""Orders in mesh and step that an author declares."""

_ORDERS = (0.5, 0.75, 1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0)
_STEEP = (12.0, 18.0, 27.0)
"""Orders of the mesh alone: on a few meshes a power so high stands for an exponential fall."""

_VARIATIONS = {
    (0.02, 0.0): 0.28,
    (0.1, 0.0): 0.1,
    (0.3, 0.0): 0.1,
    (1.0, 0.0): 0.3,
    (1.0, 1.0): 0.22,
}
"""κ of mesh and step on the coarsest, and the power by which it falls to the finest.

(1, 0) has no rule at all; in (1, 1) a term one order higher is as large on the coarsest.
"""

_ALIKE = 0.5
"""Share of models whose mesh and step have the same κ; a good ladder of steps on one coarse mesh
tells nothing about the mesh."""

_NOISES = {0.0: 0.9, 0.3: 0.03, 3.0: 0.04, 30.0: 0.03}  # of a run, over the finest's error
_RATIOS = (3e-6, 1e-4, 3e-3, 0.1, 1.0, 10.0, 300.0, 1e4)  # D/C: small of many steps on one mesh
_OWN = 0.02  # of each run's error: no pair of runs is all there is to know
_LEAST = 1e-4  # the same of what mesh or step has alone, so that sums of both can be told apart

_BELIEVED = 0.5
"""Weight of the declared order; the rest is that of any order around two."""

_DECLARED_SPREAD, _ANY_SPREADS = 0.12, {0.5: 0.65, 1.3: 0.35}  # of ln p, each with its share

_COVERED, _COVERED_BY_FEW = 0.945, 0.98
"""Probability that the limit lies within its bar, and of few runs on meshes that hardly differ."""

_FEW, _NEAR = 3, 3.0
"""Number of such runs, and how many times finer their finest mesh is at most."""

_MOST_FREEDOM = 2
"""Degrees of freedom by which the scale of errors is known: runs of one code are not independent,
and with more of them bars of oscillating ones cover less than nine tenths."""

_FARTHEST = 230.0  # of the logarithms of errors
_ROUND_OFF = 1e-13
_LIKELY = 1e-3  # of the likeliest: what is less has no part in a bar
_PROBABILITIES = (np.arange(60) + 0.5) / 60.0


@dataclass(frozen=True, kw_only=True, eq=False)
class Models:
    """Models of errors on given meshes and steps; the first axis counts models.

    Attributes
    ----------
    x, y : ndarray (runs,)
        Mesh sizes and steps over the finest; y is one where steps have no part of their own.
    declared : tuple of float
    given : tuple of ndarray (models,)
        p, r, D/C, κ of mesh and step, the powers by which they fall, and the noise.
    prior : ndarray (models,)
        Logarithm of its weight before there are runs.
    weights, projections : ndarray (models, runs), (models, runs, runs)
        The limit is `weights` times the runs, and `projections` a quadratic form of what it leaves.
    precision, volume : ndarray (models,)
        Of the limit, and the logarithm by which models that explain anything are less likely.
    """

    x: FloatArray
    y: FloatArray
    declared: Declared
    given: tuple[FloatArray, ...]
    prior: FloatArray
    weights: FloatArray
    projections: FloatArray
    precision: FloatArray
    volume: FloatArray

    def evidence(self, runs: FloatArray) -> FloatArray:
        """Logarithm of how likely models are, (models,); runs (runs, samples) of any scale."""
        gram = runs @ runs.T / runs.shape[1]
        forms = self.projections.reshape(len(self.prior), -1)
        left = forms @ gram.ravel()
        # Round-off alone is left of steps that go down by a hundred to the eighth power.
        least = _ROUND_OFF * (np.abs(forms) @ np.abs(gram.ravel())) + 1e-300
        likely = self.volume - 0.5 * (len(runs) - 1) * np.log(np.maximum(left, least))
        return np.asarray(self.prior + likely)

    def parts(self) -> tuple[FloatArray, FloatArray]:
        """Covariances (models, runs, runs) of the errors of mesh and step."""
        return _parts(self.x, self.y, *self.given[:7])


def _parts(
    x: FloatArray, y: FloatArray, p: FloatArray, r: FloatArray, ratio: FloatArray,
    in_mesh: FloatArray, in_step: FloatArray, mesh_falls: FloatArray, step_falls: FloatArray,
) -> tuple[FloatArray, FloatArray]:  # fmt: skip
    mesh, step = _power(x, p), ratio[:, None] * _power(y, r)
    k = in_mesh[:, None] * _power(x / x.max(), mesh_falls)
    m = in_step[:, None] * _power(y / (y.max() or 1.0), step_falls)
    return (
        mesh[:, :, None] * mesh[:, None, :] * (1.0 + k[:, :, None] ** 2 * (x[:, None] == x)),
        step[:, :, None] * step[:, None, :] * (1.0 + m[:, :, None] ** 2 * (y[:, None] == y)),
    )


def _power(x: FloatArray, p: FloatArray) -> FloatArray:
    """Return xᵖ, (models, runs), with orders so small that its squares are numbers."""
    return np.asarray(x ** np.minimum(p, _FARTHEST / math.log(max(x.max(), 2.0)))[:, None])


def _modeled(
    x: FloatArray, y: FloatArray, declared: Declared, prior: FloatArray, *given: FloatArray
) -> Models:
    """Return the algebra of models."""
    mesh, step = _parts(x, y, *given[:7])
    covariance = mesh + step
    each = np.arange(x.size)
    size = covariance[:, each, each]
    # Errors of mesh and step together end where either does.
    smaller = np.minimum(mesh[:, each, each], step[:, each, each]) if step.any() else size
    of_runs = _OWN**2 * smaller + _LEAST**2 * size
    covariance[:, each, each] += of_runs + (given[7] ** 2 * size.min(axis=1))[:, None]
    scale = np.sqrt(covariance[:, each, each])
    both = scale[:, :, None] * scale[:, None, :]
    covariance /= both
    inverse = np.linalg.inv(covariance) / both
    sums = inverse.sum(axis=2)
    precision = sums.sum(axis=1)
    weights = sums / precision[:, None]
    volume = np.linalg.slogdet(covariance)[1] + 2.0 * np.log(scale).sum(axis=1) + np.log(precision)
    return Models(
        x=x, y=y, declared=declared, given=given, prior=prior, weights=weights,
        projections=inverse - sums[:, :, None] * weights[:, None, :], precision=precision,
        volume=-0.5 * volume,
    )  # fmt: skip


@lru_cache(maxsize=64)  # all quantities of a submission have the same meshes and steps
def models_of(x: tuple[float, ...], y: tuple[float, ...], declared: Declared) -> Models:
    """Return the grid of models on sizes x and y over the finest."""
    stepped = len(set(y)) > 1
    p = sorted({*_ORDERS, *_STEEP, *filter(None, declared[:1])})
    r = sorted({*_ORDERS, *filter(None, declared[1:])}) if stepped else [1.0]
    ratios = _RATIOS if stepped else (0.0,)
    pairs = [
        (k, m, share * (_ALIKE * (k == m) + (1.0 - _ALIKE) * other))
        for k, share in _VARIATIONS.items()
        for m, other in _VARIATIONS.items()
        if k == m or (stepped and min(k, m) == min(_VARIATIONS))
    ]
    axes = p, r, ratios, range(len(pairs)), tuple(_NOISES)
    likely = (
        shares(p, declared[0]), shares(r, declared[1]) if stepped else np.ones(1),
        np.ones(len(ratios)), [share for *_, share in pairs], list(_NOISES.values()),
    )  # fmt: skip
    prior = np.log(math.prod(np.meshgrid(*likely, indexing="ij"))).ravel()
    *given, pair, noise = (one.ravel() for one in np.meshgrid(*axes, indexing="ij"))
    kappas = np.array([(k[0], m[0], k[1], m[1]) for k, m, _ in pairs])[pair].T
    given += [*kappas, noise]
    return _modeled(np.array(x), np.array(y), declared, prior, *given)


def shares(orders: Sequence[float] | FloatArray, declared: float | None) -> FloatArray:
    """Return the share that each order of a grid has before there are runs, but for a factor."""
    return np.asarray(_density(np.asarray(orders), declared) * np.gradient(np.log(orders)))


def _density(orders: FloatArray, declared: float | None) -> FloatArray:
    """Return how dense orders are over ln p before there are runs."""
    log = np.log(orders)
    anything = np.zeros_like(log)
    for spread, share in _ANY_SPREADS.items():
        anything += share * np.exp(-0.5 * ((log - math.log(2.0)) / spread) ** 2) / spread
    if declared is None:
        return anything
    near = np.exp(-0.5 * ((log - math.log(declared)) / _DECLARED_SPREAD) ** 2) / _DECLARED_SPREAD
    return _BELIEVED * near + (1.0 - _BELIEVED) * anything


def likeliest(models: Models, evidence: FloatArray, runs: FloatArray) -> Models:
    """Return the likeliest model alone, sought between those of the grid by zooming in.

    From the best one, and from the best smooth one, whose order may lie between those of the grid.
    """
    smooth = (models.given[3] == min(_VARIATIONS)[0]) & (models.given[4] == min(_VARIATIONS)[0])
    starts = {int(np.argmax(one)) for one in (evidence, np.where(smooth, evidence, -np.inf))}
    found = [_zoomed(models, start, runs) for start in sorted(starts)]
    _, given = max(found, key=lambda one: one[0])
    return _modeled(models.x, models.y, models.declared, np.zeros(1), *given)


def _zoomed(models: Models, start: int, runs: FloatArray) -> tuple[float, list[FloatArray]]:
    """Return the largest evidence around a model, and what is given there."""
    p, r, ratio, *others = (float(one[start]) for one in models.given)
    stepped, width, best = bool(ratio), 0.3, -math.inf
    for _ in range(18):
        near = width * np.array([-1.0, 0.0, 1.0])
        # Ratios of the grid are farther apart than its orders.
        around = p * np.exp(near), r * np.exp(near * stepped), ratio * np.exp(4.0 * near * stepped)
        given = [one.ravel() for one in np.meshgrid(*around)]
        given += [np.full(given[0].size, one) for one in others]
        prior = np.log(_density(given[0], models.declared[0]))
        prior = prior + np.log(_density(given[1], models.declared[1])) * stepped
        likely = _modeled(models.x, models.y, models.declared, prior, *given).evidence(runs)
        k = int(np.argmax(likely))
        best, width = float(likely[k]), 0.6 * width
        p, r, ratio = (float(one[k]) for one in given[:3])
    return best, [np.array([one]) for one in (p, r, ratio, *others)]


def bar_of(models: Models, evidence: FloatArray, weights: FloatArray, runs: FloatArray) -> float:
    """Return how far the limit, `weights` times the runs, may be off by all models.

    Functions are taken at the sample that is known worst.
    """
    kept = evidence > evidence.max() + math.log(_LIKELY)
    share = np.exp(evidence[kept] - evidence.max())
    share /= share.sum()
    freedom = min(len(runs) - 1, _MOST_FREEDOM)
    w, of_each = models.weights[kept], models.projections[kept]
    of_each = of_each / (freedom * models.precision[kept])[:, None, None]
    apart = w - weights
    spread = np.einsum("g,gi,gj", share, apart, apart) + np.einsum("g,gij", share, of_each)
    worst = runs[:, np.argmax(np.einsum("it,ij,jt->t", runs, spread, runs))]
    of_model = np.sqrt(np.maximum(np.einsum("gij,i,j->g", of_each, worst, worst), 0.0))
    student = special.stdtrit(freedom, _PROBABILITIES)
    few = len(runs) <= _FEW and models.x.max() < _NEAR
    probability = _COVERED_BY_FEW if few else _COVERED
    off = np.abs((apart @ worst)[:, None] + of_model[:, None] * student).ravel()
    order = np.argsort(off)
    covered = np.cumsum(np.repeat(share / _PROBABILITIES.size, _PROBABILITIES.size)[order])
    return float(off[order][np.searchsorted(covered, probability)])
