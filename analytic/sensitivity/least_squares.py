"""Least squares with the derivatives of exact answers, and what the data leave open."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import groupby

import numpy as np

from ..arrays import FloatArray
from ..blade import Blade
from ..lazily import optimize
from ..theory import Theory
from ..warning import warn
from .measured import Measured
from .parameters import Parameter, parameters_of

_UNKNOWN = 1.0  # standard deviation over a parameter's size, of a direction that data do not tell
_ASSUMED, _LEAST_SCATTER = 1e-3, 1e-7  # of the values, where no deviations are given
_ROUNDS = 3  # in which their scatter settles
_INSIDE = 0.01  # of a parameter's size, from its bounds, where a fit begins
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


class Problem:
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

        # From a bound the method would not come away.
        inside = np.minimum(_INSIDE, 0.25 * (high - low))
        z: FloatArray = np.clip(0.0, low + inside, high - inside)
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
