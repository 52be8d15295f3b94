"""Which blade fits what was measured: the checks of what is given, and the fit."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from ..arrays import FloatArray
from ..blade import Blade
from ..blade_checks import require_blade
from ..input_checks import finite_number, positive, shown
from ..theory import BERNOULLI_EULER, Theory
from ..threads import one_thread
from .least_squares import Fit, Problem
from .measured import Measured
from .parameters import Parameter, parameters_by, parameters_of

_LEAST = 0.02  # of a stiffness or a mass, to which a fit may go


@one_thread
def fit(
    blade: Blade,
    measured: Iterable[Measured],
    free: Iterable[str],
    *,
    prior: Mapping[str, float] | None = None,
    bounds: Mapping[str, tuple[float, float]] | None = None,
    theory: Theory = BERNOULLI_EULER,
) -> Fit:
    """Return the blade near another that fits what was measured, by weighted least squares.

    What neither data nor priors determine stays near the blade before.

    Parameters
    ----------
    blade : Blade
        Where the fit begins, and which the priors are about.
    measured : iterable of Measured
        `MeasuredFrequency` and `MeasuredState`, with a deviation each, or none at all: then all are
        taken to be off by the same part, which is the misfit.
    free : iterable of str
        Names of parameters, out of `parameters_of`.
    prior : mapping, optional
        Standard deviations of parameters about their values before, in their units: 0.05 is 5 % of
        a factor such as "EI3".
    bounds : mapping, optional
        Least and largest values, in the same units; a stiffness or a mass is at least 0.02 of what
        it was.
    theory : Theory

    Raises
    ------
    ValueError
        If the blade has no parameter of a name, data and priors are fewer than parameters, a bound
        does not hold the value before, or the blade has no mode of a name.

    Warns
    -----
    RotbeamWarning
        If the fit did not settle.

    Examples
    --------
    >>> import numpy as np
    >>> from analytic import Beam, linear_modes
    >>> from analytic.sensitivity import MeasuredFrequency, fit
    >>> beam = Beam.reference()
    >>> measured = [
    ...     MeasuredFrequency(mode="lag 1", omega=omega, value=value, deviation=0.01)
    ...     for omega, value in ((0.0, 3.0), (6.0, 3.8))
    ... ]
    >>> found = fit(beam, measured, ["EI3", "m"])
    >>> print(found.unknown[0])
    EI3 +1 % with m +1 %: the data do not determine; they determine their ratio alone
    """
    require_blade(blade)
    several = _measured(measured)
    before = _free(blade, theory, free)
    priors = {
        name: positive(f"the prior of {name}", one)
        for name, one in _of_free("prior", prior, before).items()
    }
    if (count := len(several) + len(priors)) < len(before):
        raise ValueError(
            f"{len(before)} numbers are free, and {count} are measured or have a prior: measure "
            "more, give priors, or free fewer"
        )
    problem = Problem(blade, theory, before, several, priors)
    low, high = _bounds(_of_free("bounds", bounds, before), before)
    return problem.fitted(problem.solved(low, high), low, high)


def _measured(measured: Iterable[Measured]) -> tuple[Measured, ...]:
    several = tuple(measured)
    if not several:
        raise ValueError("nothing is measured: give frequencies or numbers of steady states")
    for one in several:
        if not isinstance(one, Measured):
            raise TypeError(
                "measured must be MeasuredFrequency or MeasuredState, got " + shown(one)
            )
    without = [one.label for one in several if one.deviation is None]
    if without and len(without) < len(several):
        raise ValueError(
            f"give a deviation to each of the measured or to none: {without[0]} has none"
        )
    zero = [one.label for one in several if one.value == 0.0]
    if without and zero:
        raise ValueError(f"{zero[0]} is zero: give deviations, as parts of it have no size")
    return several


def _free(blade: Blade, theory: Theory, free: Iterable[str]) -> list[Parameter]:
    parameters = parameters_by("free", free, parameters_of(blade, theory))
    if not parameters:
        raise ValueError("nothing is free: name numbers of the blade, as in ['EI2', 'EI3']")
    names = [one.name for one in parameters]
    for k, one in enumerate(parameters):
        if one.name in names[:k]:
            raise ValueError(f"free has {one.name} twice")
        if one.family in names:
            raise ValueError(f"{one.family} changes {one.name}, too: free one of them")
    return parameters


def _of_free(what: str, given: object, free: list[Parameter]) -> Mapping[str, Any]:
    """Return values by name, refusing numbers that are not free."""
    if given is not None and not isinstance(given, Mapping):
        raise TypeError(f"{what} must be by name, as {{'EI3': ...}}, got {shown(given)}")
    names = [one.name for one in free]
    for name in given or {}:
        if name not in names:
            raise ValueError(f"{what} has {shown(name)}, which is not free: {', '.join(names)}")
    return given or {}


def _bounds(bounds: Mapping[str, Any], free: list[Parameter]) -> tuple[FloatArray, FloatArray]:
    """Return the least and largest changes over the sizes."""
    result = np.empty((2, len(free)))
    for k, one in enumerate(free):
        scaled = one.value > 0.0 and one.unit not in ("m", "rad")
        least = max(one.least, _LEAST * one.value if scaled else -math.inf)
        pair: Any = bounds.get(one.name, (least, math.inf))
        if np.shape(pair) != (2,):
            raise ValueError(f"bounds of {one.name} must be two numbers, got {shown(pair)}")
        low, high = (
            edge if math.isinf(edge) else finite_number(f"a bound of {one.name}", edge)
            for edge in pair
        )
        if not max(low, one.least) <= one.value <= high or low == high:
            raise ValueError(
                f"bounds of {one.name}, {low:g} and {high:g}, do not hold its value {one.value:g}"
            )
        result[:, k] = (max(low, least) - one.value) / one.size, (high - one.value) / one.size
    return result[0], result[1]
