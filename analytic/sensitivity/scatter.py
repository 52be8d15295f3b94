"""Answers of a blade whose numbers are uncertain: by derivatives."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from ..arrays import FloatArray
from ..blade import Blade
from ..exact.linear.campbell import Campbell
from ..exact.linear.families import LinearModes
from ..input_checks import not_negative, positive, shown
from ..plotting import axes_or_new, tornado
from ..threads import one_thread
from .derivatives import Answer, Sensitivity, place_of, rows_over_time, sensitivity
from .frequencies import modes_until
from .parameters import Parameter, parameters_of

if TYPE_CHECKING:
    from ..plotting import Axes

_SAME = 1e-5  # between frequencies of a diagram and modes at its speeds


@dataclass(frozen=True)
class Spread:
    """Standard deviations of the numbers of an answer, and what they come from.

    Attributes
    ----------
    answer : as of `Sensitivity`
    outputs, units : tuple of str
        Its numbers, as of `Sensitivity`.
    values : ndarray (outputs,)
    parameters : tuple of str
        Those with a scatter, independent of each other.
    deviations : ndarray (outputs,)
        Standard deviations, in the units of the outputs.
    shares : ndarray (outputs, parameters)
        Of each parameter in the variance.

    Examples
    --------
    >>> from analytic import Beam, linear_modes
    >>> from analytic.sensitivity import sensitivity, spread
    >>> found = sensitivity(linear_modes(Beam.reference(), omega=0.0, count=1))
    >>> axes = spread(found, {"EI3": 0.06, "m": 0.02}).plot()
    """

    answer: Answer
    outputs: tuple[str, ...]
    units: tuple[str, ...]
    values: FloatArray
    parameters: tuple[str, ...]
    deviations: FloatArray
    shares: FloatArray = field(repr=False)

    @property
    def relative(self) -> FloatArray:
        """Deviations over the values, not a number where a value is zero, (outputs,)."""
        values = np.where(self.values == 0.0, np.nan, self.values)
        return np.asarray(self.deviations / np.abs(values))

    def plot(self, output: str | None = None, ax: Axes | None = None) -> Axes:
        """Draw what each parameter adds to the deviation of an output, the largest first.

        Parameters
        ----------
        output : str, optional
            Its name; the first, unless given.
        ax : Axes, optional
            Drawn on these; otherwise on a new figure.
        """
        row = place_of(output, self.outputs)
        parts = self.deviations[row] * np.sqrt(self.shares[row])
        return tornado(self.parameters, parts, f"± of {self.outputs[row]} [{self.units[row]}]", ax)

    def plot_over_time(self, number: str = "tip y", ax: Axes | None = None) -> Axes:
        """Draw a number of a spin-up over time, with a band of two standard deviations.

        Parameters
        ----------
        number : str
            "tip y", "root moment z" and so on.
        ax : Axes, optional
            Drawn on these; otherwise on a new figure.
        """
        rows = rows_over_time(self.answer, self.outputs, number)
        value, half, axes = self.values[rows], 2.0 * self.deviations[rows], axes_or_new(ax)
        time = self.answer.time  # type: ignore[union-attr]
        (line,) = axes.plot(time, value)
        axes.fill_between(time, value - half, value + half, color=line.get_color(), alpha=0.2, lw=0)
        axes.set(xlabel="time [s]", ylabel=f"{number} [{self.units[rows[0]]}]")
        return axes


def spread(found: Sensitivity, scatter: Mapping[str, float], length: float = math.inf) -> Spread:
    """Return the scatter of an answer's numbers to the first order.

    Parameters
    ----------
    found : Sensitivity
        Of all parameters with a scatter; with a length, of their stations, too.
    scatter : mapping
        Standard deviations by names of parameters of the whole blade: of "EI3", "m" and other
        factors relative, as 0.05; else in their units, as {"setting_angle": 0.01}.
    length : float
        Correlation length [m] along the blade, of exp(-|Δx|/length) between stations; infinite
        where a parameter is off by the same at all stations.

    Raises
    ------
    ValueError
        If a name is unknown, a deviation is negative, or a length is given for what has no
        stations.

    Examples
    --------
    >>> from analytic import Beam, linear_modes
    >>> from analytic.sensitivity import sensitivity, spread
    >>> modes = linear_modes(Beam.reference(), omega=0.0, count=1)
    >>> found = spread(sensitivity(modes), {"EI3": 0.06, "m": 0.02})
    >>> print(found.parameters, found.relative.round(4), found.shares.round(2))
    ('EI3', 'm') [0.0316] [[0.9 0.1]]
    """
    if not isinstance(found, Sensitivity):
        raise TypeError(f"found must be what sensitivity returns, got {shown(found)}")
    variances = []
    known = {one.name: one for one in found.parameters}
    deviations = checked_scatter(scatter, known)
    for name, deviation in deviations.items():
        together = correlations(found.blade, known, name, length)
        gradient = _gradient(found, name, len(together))
        variances.append(deviation**2 * np.einsum("mi,ij,mj->m", gradient, together, gradient))
    each = np.array(variances)
    whole = each.sum(axis=0)
    return Spread(
        answer=found.answer,
        outputs=found.outputs,
        units=found.units,
        values=found.values,
        parameters=tuple(deviations),
        deviations=np.sqrt(whole),
        shares=(each / np.where(whole > 0.0, whole, 1.0)).T,
    )


def checked_scatter(scatter: object, known: Mapping[str, Parameter]) -> dict[str, float]:
    """Return deviations by name, or refuse them."""
    if not isinstance(scatter, Mapping) or not scatter:
        raise ValueError(
            f"scatter must be deviations by name, as {{'EI3': 0.05}}, got {shown(scatter)}"
        )
    for name in scatter:
        if name not in known or known[name].family:
            whole = ", ".join(name for name, one in known.items() if not one.family)
            raise ValueError(f"scatter has no parameter {shown(name)}; there are {whole}")
    return {name: not_negative(f"the scatter of {name}", value) for name, value in scatter.items()}


def _gradient(found: Sensitivity, name: str, count: int) -> FloatArray:
    """Return derivatives to a number of the whole blade, or to its relative ones at stations."""
    whole = found.names.index(name)
    if count == 1:
        return found.derivatives[:, [whole]]
    places = [k for k, one in enumerate(found.parameters) if one.family == name]
    factor = found.parameters[whole].value
    size = [found.parameters[k].value if factor else 1.0 for k in places]
    return found.derivatives[:, places] * size


def correlations(
    blade: Blade, known: Mapping[str, Parameter], name: str, length: float
) -> FloatArray:
    """Return exp(-|Δx|/length) between stations, (stations, stations), or one of a whole blade."""
    if length == math.inf:
        return np.ones((1, 1))
    positive("length", length, "m")
    x = np.array(blade.table.x if blade.table else [])
    if not x.size or sum(one.family == name for one in known.values()) != x.size:
        raise ValueError(
            f"a correlation length is for numbers of stations, and {name} has none among them: "
            "leave length out"
        )
    return np.asarray(np.exp(-np.abs(x[:, None] - x) / length))


@one_thread
def campbell_spread(
    diagram: Campbell, scatter: Mapping[str, float], length: float = math.inf
) -> FloatArray:
    """Return standard deviations of the frequencies of a Campbell diagram [rad/s].

    To the first order, (speeds, modes); where modes veer, they are of the curves as followed.

    Parameters
    ----------
    diagram : Campbell
    scatter, length
        As for `spread`.

    Examples
    --------
    >>> from analytic import Beam, campbell
    >>> from analytic.sensitivity import campbell_spread
    >>> diagram = campbell(Beam.reference(), omegas=[0.0, 6.0], count=1)
    >>> found = campbell_spread(diagram, {"EI3": 0.06, "m": 0.02})
    >>> print((found / diagram.frequencies).round(4).ravel())  # tension stiffens for sure
    [0.0316 0.0216]
    """
    if not isinstance(diagram, Campbell):
        raise TypeError(f"diagram must be what campbell returns, got {shown(diagram)}")
    blade, theory = diagram.blade, diagram.theory
    known = parameters_of(blade, theory)
    names = [*checked_scatter(scatter, known)]
    if length != math.inf:
        names += [one.name for one in known.values() if one.family in names]
    rows = []
    for omega, frequencies in zip(diagram.omegas.tolist(), diagram.frequencies, strict=True):
        reached = partial(_reached, (1.0 - _SAME) * frequencies.max())
        modes = modes_until(reached, blade, omega, theory, frequencies.size)
        away = np.abs(modes.frequencies / frequencies[:, None] - 1.0)
        found = spread(sensitivity(modes, names), scatter, length)
        rows.append(found.deviations[away.argmin(axis=1)])
    return np.array(rows)


def _reached(frequency: float, modes: LinearModes) -> bool:
    return bool(modes.frequencies[-1] > frequency)
