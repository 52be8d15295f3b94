"""Which blade fits what was measured: least squares with the derivatives of exact answers."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import groupby
from typing import Any

import numpy as np

from ..arrays import FloatArray
from ..blade import Blade
from ..blade_checks import require_blade
from ..input_checks import finite_number, positive, shown
from ..lazily import optimize
from ..theory import BERNOULLI_EULER, Theory
from ..threads import one_thread
from ..warning import warn
from .measured import Measured
from .parameters import Parameter, parameters_by, parameters_of

_LEAST = 0.02  # of a stiffness or a mass, to which a fit may go
_UNKNOWN = 1.0  # standard deviation over a parameter's size, of a direction that data do not tell
_ASSUMED, _LEAST_SCATTER = 1e-3, 1e-7  # of the values, where no deviations are given
_ROUNDS = 3  # in which their scatter settles
_HELD = 0.1  # 1/standard deviation over the size, by which what is unknown stays near
_SMALL = 0.1  # part of a direction over the largest, below which it is not named
_SETTLED = 0.05  # standard deviations by which one more step would change the fit


@dataclass(frozen=True, kw_only=True)
class Fit:
    """The blade that fits what was measured.

    Attributes
    ----------
    blade : Blade
    theory : Theory
    parameters : tuple of Parameter
        Those that were free, of the blade before.
    values : ndarray (parameters,)
        After; of a factor for all the blade over the blade before.
    covariance : ndarray (parameters, parameters)
        Of the values, infinite where neither data nor priors determine them.
    measured : tuple of Measured
    computed : ndarray (measured,)
        What the blade has for them.
    residuals : ndarray (measured,)
        Computed less measured, over the standard deviations.
    misfit : float
        Root of the mean square of residuals and of changes over the priors, per degree of freedom:
        about 1 where the deviations are right, more where the blade cannot do what was measured. Of
        data without deviations it is relative, as 0.01; not a number without a degree of freedom.
    unknown : tuple of str
        Sentences on what the data do not determine.
    """

    blade: Blade
    theory: Theory
    parameters: tuple[Parameter, ...] = field(repr=False)
    values: FloatArray
    covariance: FloatArray = field(repr=False)
    measured: tuple[Measured, ...] = field(repr=False)
    computed: FloatArray = field(repr=False)
    residuals: FloatArray = field(repr=False)
    misfit: float
    unknown: tuple[str, ...]

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the parameters."""
        return tuple(one.name for one in self.parameters)

    @property
    def before(self) -> FloatArray:
        """Values of the parameters before, (parameters,)."""
        return np.array([one.value for one in self.parameters])

    @property
    def deviations(self) -> FloatArray:
        """Standard deviations of the values, (parameters,)."""
        return np.sqrt(np.diag(self.covariance))

    @property
    def labels(self) -> tuple[str, ...]:
        """Names of the measured numbers, with their speeds."""
        return tuple(one.label for one in self.measured)


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
    problem = _Problem(blade, theory, before, several, priors)
    low, high = _bounds(_of_free("bounds", bounds, before), before)
    return problem.fitted(problem.solved(low, high), low, high)


class _Problem:
    """Residuals over deviations, and changes over priors, of parameters over their sizes."""

    def __init__(
        self, blade: Blade, theory: Theory, before: list[Parameter],
        measured: tuple[Measured, ...], priors: dict[str, float],
    ) -> None:  # fmt: skip
        self._blade, self._theory, self._before, self._measured = blade, theory, before, measured
        self._sizes = np.array([one.size for one in before])
        self._start = np.array([one.value for one in before])
        self._targets = np.array([one.value for one in measured])
        self._stated = measured[0].deviation is not None
        self._deviations = np.array([
            one.deviation or _ASSUMED * abs(one.value) for one in measured
        ])  # fmt: skip
        rows = np.eye(len(before)) * self._sizes[:, None]
        self._prior = np.array([
            row / priors[one.name] for row, one in zip(rows, before, strict=True)
            if one.name in priors
        ]).reshape(-1, len(before))  # fmt: skip
        self._known = dict[bytes, tuple[FloatArray, FloatArray]]()

    def _values(self, z: FloatArray) -> FloatArray:
        return np.asarray(self._start + self._sizes * z)

    def _changed(self, values: FloatArray) -> Blade:
        """Return the blade with other values, of which each is of a number of its own."""
        blade = self._blade
        for one, value in zip(self._before, values.tolist(), strict=True):
            blade = parameters_of(blade, self._theory)[one.name].changed(value)
        return blade

    def _answers(self, z: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return what the blade has for the measured, and derivatives to z."""
        if z.tobytes() not in self._known:
            values = self._values(z)
            blade, names = self._changed(values), [one.name for one in self._before]
            computed = np.empty(self._targets.size)
            slopes = np.empty((computed.size, len(names)))
            order = sorted(range(computed.size), key=lambda k: repr(self._measured[k].together))
            for _, rows in groupby(order, key=lambda k: self._measured[k].together):
                at = list(rows)
                some = [self._measured[k] for k in at]
                computed[at], slopes[at] = some[0].computed(some, blade, self._theory, names)
            # A factor of the blade as it is now is one over that of the blade before.
            factors = [one.unit == "1" for one in self._before]
            slopes *= self._sizes / np.where(factors, values, 1.0)
            self._known[z.tobytes()] = computed, slopes
        return self._known[z.tobytes()]

    def solved(self, low: FloatArray, high: FloatArray) -> FloatArray:
        """Return the changes of least squares; what the data leave open stays near the start."""
        held = _HELD * np.eye(low.size)

        def residuals(z: FloatArray) -> FloatArray:
            return np.concatenate((self._residuals(z), held @ z))

        def slopes(z: FloatArray) -> FloatArray:
            return np.concatenate((self._slopes(z), held))

        z: FloatArray = np.zeros(low.size)
        for _ in range(_ROUNDS):
            z = optimize.least_squares(residuals, z, jac=slopes, bounds=(low, high), max_nfev=60).x
            misfit = self._misfit(z)
            if self._stated or math.isnan(misfit):
                break
            # The scatter of the data; priors stay as given.
            least = _LEAST_SCATTER * np.abs(self._targets)
            self._deviations = np.maximum(misfit * self._deviations, least)
        return z

    def _misfit(self, z: FloatArray) -> float:
        residuals = self._residuals(z)
        beyond = residuals.size - z.size
        return math.sqrt(residuals @ residuals / beyond) if beyond else math.nan

    def _residuals(self, z: FloatArray) -> FloatArray:
        """Return all that is squared."""
        off = (self._answers(z)[0] - self._targets) / self._deviations
        return np.concatenate((off, self._prior @ z))

    def _slopes(self, z: FloatArray) -> FloatArray:
        """Return the derivatives of the same."""
        return np.concatenate((self._answers(z)[1] / self._deviations[:, None], self._prior))

    def fitted(self, z: FloatArray, low: FloatArray, high: FloatArray) -> Fit:
        """Return the fit, with what the data determine of it."""
        computed, _ = self._answers(z)
        residuals, slopes = self._residuals(z), self._slopes(z)
        misfit = self._misfit(z)
        unit = math.nan if math.isnan(misfit) and not self._stated else 1.0
        covariance, directions = _covariance(slopes, unit)
        inside = (z > low + 1e-6) & (z < high - 1e-6)
        step = np.linalg.lstsq(slopes[:, inside], -residuals)[0]
        least = np.sqrt(np.diag(covariance))[inside]
        moved = np.abs(step) > _SETTLED * least
        if np.any(moved & np.isfinite(least)) and np.linalg.norm(residuals) > 1e-9:
            warn(
                "the fit did not settle: one more step would change "
                f"{', '.join(np.array([p.name for p in self._before])[inside][moved])}; begin "
                "nearer, give priors, or free fewer numbers"
            )
        if self._prior.size:
            directions = _covariance(slopes[: computed.size], unit)[1]
        values, first = self._values(z), abs(self._targets[0])
        return Fit(
            blade=self._changed(values),
            theory=self._theory,
            parameters=tuple(self._before),
            values=values,
            covariance=covariance * np.outer(self._sizes, self._sizes),
            measured=self._measured,
            computed=computed,
            residuals=residuals[: computed.size] * unit,
            misfit=misfit if self._stated else misfit * float(self._deviations[0] / first),
            unknown=tuple(_sentence(way, self._before, values) for way in directions),
        )


def _covariance(slopes: FloatArray, unit: float) -> tuple[FloatArray, FloatArray]:
    """Return the covariance, and the directions (count, n) that stay unknown."""
    _, sizes, ways = np.linalg.svd(slopes, full_matrices=True)
    sizes = np.pad(sizes, (0, len(ways) - sizes.size))
    unknown = sizes * _UNKNOWN < (unit if math.isfinite(unit) else 0.0) + 1e-9 * sizes[0]
    known = ways[~unknown] / sizes[~unknown, None]
    covariance = unit**2 * known.T @ known
    lost = np.abs(ways[unknown]).max(axis=0, initial=0.0) > 1e-3
    covariance[lost] = covariance[:, lost] = np.inf
    return covariance, ways[unknown]


def _sentence(way: FloatArray, parameters: Sequence[Parameter], values: FloatArray) -> str:
    """Return a direction that data do not determine, in words; in percent of the values after."""
    scaled = [one.unit not in ("m", "rad") for one in parameters]
    sizes = np.array([one.size for one in parameters])
    way = way * np.where(scaled, sizes / np.where(scaled, values, 1.0), 1.0)
    way = way / way[np.argmax(np.abs(way))]
    named = [k for k in np.argsort(-np.abs(way)) if abs(way[k]) > _SMALL]
    changes = [
        f"{parameters[k].name} {parameters[k].changed_by(float(way[k]))}" for k in sorted(named)
    ]
    sentence = f"{' with '.join(changes)}: the data do not determine"
    both = [way[k] for k in named]
    alike = len(both) == 2 and all(parameters[k].unit == "1" for k in named)
    if alike and abs(abs(both[1]) - 1.0) < 0.05:
        kind = "ratio" if both[1] > 0.0 else "product"
        sentence += f"; they determine their {kind} alone"
    return sentence


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
