"""Frequencies of random blades, to see whether the first order is enough."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from ..arrays import FloatArray
from ..blade import Blade
from ..exact.linear.families import LinearModes, modes_of
from ..input_checks import whole_number
from ..lazily import stats
from ..threads import one_thread
from .frequencies import in_space, require_modes
from .frozen import frozen_blade
from .parameters import parameters_of
from .scatter import checked_scatter, correlations

_FAR = 3.0
"""Deviations at most: farther, a stiffness may lose its sign."""


@one_thread
def sampled(
    modes: LinearModes,
    scatter: Mapping[str, float],
    length: float = math.inf,
    *,
    count: int = 200,
    seed: int = 0,
) -> FloatArray:
    """Return frequencies of sampled blades [rad/s], (count, modes), by name.

    Normal deviations, clipped at three, on a Latin hypercube. The strains of the modes' functions
    are kept, so that a sample costs a steady state and an eigenvalue problem: sections that turn
    by 0.05 rad then leave some 1e-5 of a frequency, by 0.2 rad 5e-4. A mode whose name a sample
    does not have is NaN.

    Parameters
    ----------
    modes : LinearModes
        Of a blade whose section out of the plane is known, or of a planar one.
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
    require_modes(modes)
    given = parameters_of(modes.blade, modes.theory)
    modes = in_space(modes)
    count, seed = whole_number("count", count), whole_number("seed", seed, least=0)
    known = parameters_of(modes.blade, modes.theory)
    deviations = checked_scatter(scatter, given)
    roots = [
        np.linalg.cholesky(correlations(modes.blade, known, name, length)) for name in deviations
    ]
    dims = sum(len(root) for root in roots)
    points = stats.norm.ppf(stats.qmc.LatinHypercube(dims, rng=seed).random(count))
    result = np.full((count, len(modes.names)), np.nan)
    for row, point in zip(result, np.clip(points, -_FAR, _FAR), strict=True):
        blade, begin = modes.blade, 0
        for (name, deviation), root in zip(deviations.items(), roots, strict=True):
            change = deviation * (root @ point[begin : begin + len(root)])
            begin += len(root)
            blade = _changed(blade, modes, name, change)
        row[:] = _frequencies(modes, blade)
    return result


def _changed(blade: Blade, modes: LinearModes, name: str, change: FloatArray) -> Blade:
    parameter = parameters_of(blade, modes.theory)[name]
    value = parameter.value + change
    other: Blade = parameter.changed(value if value.size > 1 else float(value[0]))
    return other


def _frequencies(modes: LinearModes, blade: Blade) -> list[float]:
    """Return the frequencies of the same modes of another blade [rad/s]."""
    other = frozen_blade(modes.steady, modes.blade, blade)
    found = modes_of(modes.blade, modes.omega, modes.theory, other)
    by_name = dict(zip(found.names, found.frequencies.tolist(), strict=True))
    return [by_name.get(name, math.nan) for name in modes.names]
