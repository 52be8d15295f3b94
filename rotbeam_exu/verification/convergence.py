"""Limits of numbers as meshes or steps are refined, with orders and errors.

With f(h) = f₀ + C hᵖ three runs give the order p by the ratio of their changes,

    (f₂ - f₁)/(f₃ - f₂) = (h₁ᵖ - h₂ᵖ)/(h₂ᵖ - h₃ᵖ),      f₀ = f₃ + (f₃ - f₂)/((h₂/h₃)ᵖ - 1).

That is Richardson's extrapolation; the bar of f₀ is in the spirit of Roache's grid convergence
index (1994), a factor of safety on the correction, smaller the better its order is known.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from analytic.arrays import FloatArray
from analytic.input_checks import finite_array

_CONFIRMED = 0.25
"""Share of the correction that its bar keeps where the order is measured: Roache's 1.25."""

_ASSUMED = 3.0
"""Roache's factor of safety where the order is assumed."""

_LEAST_ORDER = 1.0
"""Order of a consistent method, taken where none is declared and none can be measured."""

_HIGHEST_ORDER = 20.0


@dataclass(frozen=True, kw_only=True)
class Convergence:
    """The limit of several runs, and how they tend to it; made by `convergence`.

    Attributes
    ----------
    sizes, values, noise : ndarray (runs,)
        Mesh size or step, the number found, and the bar of what measured it; the finest last.
    errors : ndarray (runs,)
        Of discretization: value less limit, of functions the largest distance from the limit.
    limit : float
        The number at size zero; NaN of a single run.
    bar : float
        Of the limit.
    order : float
        As observed on the three finest runs whose changes stand out of the noise; NaN where not.
    why : str
        Why the order is not measured.
    settles : bool
        Whether the changes shrink, as far as one can tell.
    """

    sizes: FloatArray = field(repr=False)
    values: FloatArray
    noise: FloatArray = field(repr=False)
    errors: FloatArray = field(repr=False)
    limit: float
    bar: float
    order: float
    why: str = ""
    settles: bool = True

    @property
    def error_bars(self) -> FloatArray:
        """Bars of `errors`, (runs,)."""
        return self.bar + self.noise


def convergence(
    sizes: Sequence[float],
    values: Sequence[float],
    *,
    noise: float | Sequence[float] = 0.0,
    declared: float | None = None,
) -> Convergence:
    """Extrapolate the values of several runs to size zero.

    By the observed order if it can be measured, with a bar of twice the change by the declared
    order; else by the declared order, or the first, with a bar of twice the correction. Where the
    last change is no larger than the noise, the finest run is the limit. Where changes alternate or
    grow, it is the limit with a bar of three changes.

    Parameters
    ----------
    sizes : sequence (runs,)
        Mesh sizes or steps, in any unit and order; no two the same.
    values : sequence (runs,) The results. noise : float or sequence (runs,)
        Largest error of the measurement itself, in the unit of the values.
    declared : float, optional
        Order that the author expects.

    Raises
    ------
    ValueError
        If there is no run, sizes are not positive or not distinct, or something is not finite.
    """
    h, f = finite_array("sizes", sizes), finite_array("values", values)
    bars = np.broadcast_to(finite_array("noise", noise), f.shape)
    if h.ndim != 1 or h.shape != f.shape or not h.size:
        raise ValueError(f"each run has a size and a value, got {h.size} sizes, {f.size} values")
    if (h <= 0.0).any() or np.unique(h).size < h.size or (bars < 0.0).any():
        raise ValueError(
            f"sizes must be positive and distinct, noise not negative, got {list(h)}, {list(bars)}"
        )
    finest_last = np.argsort(-h)
    h, f, bars = h[finest_last], f[finest_last], bars[finest_last]
    if h.size == 1:
        limit, bar, settles = math.nan, math.inf, True
    else:
        limit, bar, settles = _limit(h, f, bars, declared)
    order, why = observed_order(h, np.diff(f), bars[:-1] + bars[1:])
    return Convergence(
        sizes=h, values=f, noise=bars, errors=f - limit,
        limit=limit, bar=bar, order=order, why=why, settles=settles,
    )  # fmt: skip


def convergence_of_functions(
    sizes: Sequence[float],
    functions: FloatArray,
    *,
    noise: float = 0.0,
    declared: float | None = None,
) -> tuple[Convergence, FloatArray]:
    """Extrapolate functions, such as histories, to size zero.

    The way from the coarsest to the limit, its length measured by the largest change from run to
    run, is a sequence of numbers, whose `convergence` tells how far the limit is. It lies ahead in
    the direction of the last change.

    Parameters
    ----------
    sizes : sequence (runs,)
        Mesh sizes or steps, in any order; no two the same.
    functions : ndarray (runs, samples)
        At the same samples.
    noise : float
        Largest error of the functions themselves, such as that of Newton's method.
    declared : float, optional
        Order that the author expects.

    Returns
    -------
    runs : Convergence
        Its values and limit are lengths of way.
    limit : ndarray (samples,)
    """
    finest_last = np.argsort(-np.asarray(sizes, dtype=np.float64))
    f = functions[finest_last]
    changes = np.abs(np.diff(f, axis=0)).max(axis=1)
    way = np.concatenate(([0.0], np.cumsum(changes)))
    runs = convergence(
        np.asarray(sizes, dtype=np.float64)[finest_last].tolist(),
        way.tolist(), noise=noise, declared=declared,
    )  # fmt: skip
    if f.shape[0] == 1 or not changes[-1]:
        return runs, f[-1]
    return runs, f[-1] + (runs.limit - way[-1]) / changes[-1] * (f[-1] - f[-2])


def observed_order(
    sizes: Sequence[float] | FloatArray,
    changes: Sequence[float] | FloatArray,
    noise: Sequence[float] | FloatArray,
) -> tuple[float, str]:
    """Return the order on the three finest runs that show one; else NaN and why it is not measured.

    Parameters
    ----------
    sizes : sequence (runs,)
        Mesh sizes or steps, the finest last.
    changes, noise : sequence (runs - 1,)
        From each run to the next finer one, and the bar of that; of functions their norms.
    """
    h, change, slack = (np.asarray(values, dtype=np.float64) for values in (sizes, changes, noise))
    if h.size < 3:
        return math.nan, f"{h.size} {'run' if h.size == 1 else 'runs'}, three are needed"
    for last in range(h.size, 2, -1):
        three, two = slice(last - 3, last), slice(last - 3, last - 1)
        if (np.abs(change[two]) > slack[two]).all():
            break
    else:
        return math.nan, "the changes are below the floor"
    before, after = change[two]
    if before * after < 0.0:
        return math.nan, "the values are not monotone"
    if abs(before) <= abs(after) * _ratio(h[three], 0.0):
        return math.nan, "the changes do not shrink"
    if abs(before) - slack[two][0] <= (abs(after) + slack[two][1]) * _ratio(h[three], 0.0):
        return math.nan, "the changes shrink by no more than the noise"
    return _order(h[three], before / after), ""


def _limit(
    h: FloatArray, f: FloatArray, bars: FloatArray, declared: float | None
) -> tuple[float, float, bool]:
    """Return the limit, its bar, and whether the changes shrink."""
    changes, slack = np.diff(f), bars[:-1] + bars[1:]
    last, finest, ratio = float(changes[-1]), float(f[-1]), h[-2] / h[-1]
    if abs(last) <= slack[-1]:
        # The true change is below two of the slack, what is left of the least order no larger.
        return finest, 2.0 * float(slack[-1]) / min(1.0, ratio - 1.0), True
    order, why = observed_order(h[-3:], changes[-2:], slack[-2:])
    if not why:
        correction = last / (ratio**order - 1.0)
        expected = 0.0 if declared is None else last / (ratio**declared - 1.0)
        # Off the declared order runs are too coarse for either: twice what it would change.
        off = (_ASSUMED - 1.0) * abs(correction - expected)
        doubt = max(_CONFIRMED * abs(correction), off)
        return finest + correction, doubt + _noise_of_correction(h, changes, slack) + bars[-1], True
    if why in ("the values are not monotone", "the changes do not shrink"):
        settles = abs(changes[-2]) > abs(last)
        return finest, _ASSUMED * abs(last) / (ratio**_LEAST_ORDER - 1.0) + bars[-1], settles
    power = ratio ** (declared or _LEAST_ORDER) - 1.0
    correction = last / power
    bar = (_ASSUMED - 1.0) * abs(correction) + slack[-1] / power + bars[-1]
    return finest + correction, bar, True


def _noise_of_correction(h: FloatArray, changes: FloatArray, slack: FloatArray) -> float:
    """Return how far the noise of both changes moves the correction at worst."""
    before, after = np.abs(changes[-2:])
    ratio, sizes = h[-2] / h[-1], h[-3:]

    def correction(before: float, after: float) -> float:
        return float(after / (ratio ** _order(sizes, before / after) - 1.0))

    largest = correction(before - slack[-2], after + slack[-1])
    smallest = correction(before + slack[-2], after - slack[-1])
    middle = correction(before, after)
    return max(largest - middle, middle - smallest)


def _ratio(h: FloatArray, order: float) -> float:
    """(h₁ᵖ - h₂ᵖ)/(h₂ᵖ - h₃ᵖ) of three sizes, by which changes of order p shrink."""
    x = np.log(h / h[-1])
    if order == 0.0:
        return float((x[0] - x[1]) / x[1])
    return float((np.exp(order * x[0]) - np.exp(order * x[1])) / np.expm1(order * x[1]))


def _order(h: FloatArray, ratio: float) -> float:
    """Order at which changes shrink by `ratio`, which grows with it; by bisection."""
    low, high = 0.0, _HIGHEST_ORDER
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if _ratio(h, middle) < ratio else (low, middle)
    return low
