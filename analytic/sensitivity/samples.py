"""Answers of random blades, to see whether the first order is enough."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..arrays import FloatArray
from ..input_checks import whole_number
from ..lazily import stats
from ..threads import one_thread
from ..warning import warn
from .conditions import conditions_of
from .derivatives import Answer, Derivatives, kind_of
from .parameters import parameters_of
from .scatter import checked_scatter, correlations

_FAR = 3.0
"""Deviations at most: farther, a stiffness may lose its sign."""


@one_thread
def sampled(
    answer: Answer,
    scatter: Mapping[str, float],
    length: float = math.inf,
    *,
    count: int = 200,
    seed: int = 0,
) -> FloatArray:
    """Return an answer's numbers for sampled blades, (count, outputs), as `sensitivity` names them.

    Normal deviations, clipped at three, on a Latin hypercube. Every sample is solved anew, modes
    alone with the strains of the same functions, in a fraction of a second: sections that turn by
    0.05 rad then leave some 1e-5 of a frequency, by 0.2 rad 5e-4. A number that a sample does not
    have, as a mode of another name, is NaN, and so are all of a sample without an answer, of which
    a warning says why.

    Parameters
    ----------
    answer : as of `sensitivity`
    scatter, length
        As for `spread`.
    count, seed : int
        Number of samples, and of the generator.

    Examples
    --------
    >>> from analytic import Beam, linear_modes
    >>> from analytic.sensitivity import sampled
    >>> modes = linear_modes(Beam.reference(), omega=0.0, count=1)
    >>> found = sampled(modes, {"EI3": 0.06, "m": 0.02}, count=50)
    >>> print((found.std() / found.mean()).round(3))
    0.031
    """
    found = kind_of(answer)
    count, seed = whole_number("count", count), whole_number("seed", seed, least=0)
    known = {**parameters_of(answer.blade, answer.theory), **found.conditions}
    deviations = checked_scatter(scatter, known)
    roots = [
        np.linalg.cholesky(correlations(answer.blade, known, name, length)) for name in deviations
    ]
    dims = sum(len(root) for root in roots)
    points = stats.norm.ppf(stats.qmc.LatinHypercube(dims, rng=seed).random(count))
    failed = list[str]()
    result = np.full((count, len(found.outputs)), np.nan)
    for row, point in zip(result, np.clip(points, -_FAR, _FAR), strict=True):
        try:
            row[:] = _solved(answer, found, deviations, roots, point)
        except (ValueError, RuntimeError) as error:
            failed.append(str(error))
    if failed:
        warn(f"{len(failed)} of {count} samples are without an answer, the first as {failed[0]}")
    return result


def _solved(
    answer: Answer, found: Derivatives, deviations: Mapping[str, float],
    roots: Sequence[NDArray[Any]], point: FloatArray,
) -> list[float]:  # fmt: skip
    """Return the numbers of a sample, whose deviations over the standard ones are `point`."""
    blade, given, begin = answer.blade, found.given, 0
    for (name, deviation), root in zip(deviations.items(), roots, strict=True):
        change = deviation * (root @ point[begin : begin + len(root)])
        begin += len(root)
        condition = name in found.conditions
        now = (
            conditions_of(*given, answer.blade.frequency_scale)
            if condition
            else parameters_of(blade, answer.theory)
        )[name]
        value = np.maximum(now.value + change, now.least)
        other = now.changed(value if value.size > 1 else float(value[0]))
        blade, given = (blade, other) if condition else (other, given)
    numbers = found.again(blade, *given)
    return [numbers.get(name, math.nan) for name in found.outputs]
