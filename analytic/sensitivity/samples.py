"""Answers of random blades, to see whether the first order is enough."""

from __future__ import annotations

import math
import pickle
from collections.abc import Mapping
from concurrent.futures import Executor
from functools import lru_cache, partial

import numpy as np

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
    executor: Executor | None = None,
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
    executor : concurrent.futures.Executor, optional
        Solves the samples, as processes or Dask's `client.get_executor()`; by default none.

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
    points = stats.norm.ppf(stats.qmc.LatinHypercube(sum(map(len, roots)), rng=seed).random(count))
    parts = np.split(
        np.clip(points, -_FAR, _FAR), np.cumsum([len(root) for root in roots])[:-1], axis=1
    )
    scattered = {
        name: deviation * part @ root.T
        for (name, deviation), part, root in zip(deviations.items(), parts, roots, strict=True)
    }
    samples = [{name: of[k] for name, of in scattered.items()} for k in range(count)]
    solved = (
        map(partial(_solved, answer, found), samples)
        if executor is None
        else executor.map(partial(_solved_there, pickle.dumps(answer)), samples)
    )
    numbers, reasons = zip(*solved, strict=True)
    if failed := [*filter(None, reasons)]:
        warn(f"{len(failed)} of {count} samples are without an answer, the first as {failed[0]}")
    return np.array(numbers)


@one_thread
def _solved_there(answer: bytes, changes: Mapping[str, FloatArray]) -> tuple[list[float], str]:
    """Return the same in a worker, which prepares the answer once."""
    return _solved(*_prepared(answer), changes)


@lru_cache(maxsize=1)
def _prepared(packed: bytes) -> tuple[Answer, Derivatives]:
    answer: Answer = pickle.loads(packed)
    return answer, kind_of(answer)


def _solved(
    answer: Answer, found: Derivatives, changes: Mapping[str, FloatArray]
) -> tuple[list[float], str]:
    """Return the numbers of a blade with changes by name, or NaN and why there is no answer."""
    blade, given = answer.blade, found.given
    try:
        for name, change in changes.items():
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
    except (ValueError, RuntimeError) as error:
        return [math.nan] * len(found.outputs), str(error)
    return [numbers.get(name, math.nan) for name in found.outputs], ""
