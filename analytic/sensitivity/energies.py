"""Sums of energies of a solution's states, and their derivatives to the numbers of its blade."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, ClassVar, NamedTuple

import numpy as np

from ..arrays import FloatArray
from ..blade import Blade
from ..exact.continuum.space import SpaceContinuum
from ..exact.continuum.state import Driven
from ..exact.continuum.vectors import cross, turned_back
from ..load import Load
from ..theory import Theory
from .frozen import Kernels, frozen
from .parameters import Parameter, parameters_of

SWING = 5e-3
"""Size of strains of energy one: of sums of their squares the fourth power is left."""
AROUND = np.array([-2.0, -1.0, 1.0, 2.0]), np.array([1.0, -8.0, 8.0, -1.0]) / 12.0
"""Steps of a central difference, and weights, of which the fourth power is left."""
FEW = (
    (np.array([-1.0, 1.0]), np.array([-0.5, 0.5])),
    (np.array([0.0, 1.0, 2.0]), np.array([-1.5, 2.0, -0.5])),
)
FINE = AROUND, (np.arange(5.0), np.array([-25.0, 48.0, -36.0, 16.0, -3.0]) / 12.0)
"""Steps and weights of differences to both sides and ahead: the second power is left, the fourth.
"""
_CHANGE = 3e-4  # of a parameter over its size: 1e-7 of its square is left


class States(NamedTuple):
    """States q, q̇ and q̈, what drives them, and their weights in a sum of energies."""

    q: FloatArray
    q_dot: FloatArray
    q_ddot: FloatArray
    by: Driven
    weights: FloatArray


def difference(
    parameter: Parameter, values: Callable[[Any], FloatArray], size: float = _CHANGE,
    schemes: Any = FEW,
) -> FloatArray:  # fmt: skip
    """Return the derivative of values of a blade to a parameter, by a change over its size.

    Of a condition, of values of a motion and loads.
    """
    change = size * parameter.size
    steps, weights = schemes[parameter.value - 2.0 * change < parameter.least]
    several = [values(parameter.changed(parameter.value + change * step)) for step in steps]
    return np.asarray(np.tensordot(weights, several, 1) / change)


class OneByOne:
    """Derivatives to one parameter after the other.

    Attributes
    ----------
    given : tuple
        The motion and the loads of the answer.
    """

    given: tuple[Any, Sequence[Load]]
    each_station: ClassVar[bool] = True

    def to(self, parameter: Parameter) -> FloatArray:
        """Return the derivatives of all numbers to a parameter."""
        raise NotImplementedError

    def columns(self, several: Sequence[Parameter]) -> FloatArray:
        """Return the derivatives of all numbers to parameters, (numbers, parameters)."""
        return np.array([self.to(one) for one in several]).T


class Energies:
    """Sums of elastic less kinetic energy, and less the work of loads on masses.

    Of several `States`; `squares` (sums, n, n) are those of their coordinates with the weights.
    """

    def __init__(
        self, model: SpaceContinuum, blade: Blade, theory: Theory,
        states: list[States], squares: FloatArray,
    ) -> None:  # fmt: skip
        self.model, self.blade, self.states, self.squares = model, blade, states, squares
        self.parameters = parameters_of(blade, theory)
        self.kernels = self._kernels()
        self._known, self._at = dict[str, FloatArray](), dict[str, FloatArray]()

    def _kernels(self) -> Kernels:
        strains = self.model.strains
        fields = np.concatenate((strains.gamma, strains.K))
        sums: list[list[FloatArray]] = []
        for q, q_dot, q_ddot, by, weights in self.states:
            velocity, spin, turn, clamp = self.model.velocities(q, q_dot, by)
            moved = np.concatenate((velocity, spin))
            force = self.model.on_strains(q, q_dot, q_ddot, by)[:3]
            strained = np.einsum("ipn,sn->isp", fields, q)
            sums.append([
                *(
                    np.einsum("s,isp,jsp->pij", weights, one, one, optimize=True)
                    for one in (moved, turn, clamp)
                ),
                weights @ (force[0] * self.model.shortening(q)),
                weights @ (force[0] * strains.trapeze * strained[3]),
                np.einsum("s,isp,jsp->pij", weights, force, strained, optimize=True),
                self._pulled(q, by, weights),
            ])  # fmt: skip
        return Kernels(
            np.einsum("ipm,kmn,jpn->kpij", fields, self.squares, fields, optimize=True),
            *(np.stack(kind) for kind in zip(*sums, strict=True)),
        )

    def _pulled(self, q: FloatArray, by: Driven, weights: FloatArray) -> FloatArray:
        """Return the work of loads on the masses over mass, (masses, 4): on the line and offsets.

        The latter in the frame without twist.
        """
        if by.push is None:
            return np.zeros((self.model.masses.places.size, 4))
        places, frames = self.model.hung(q, by)
        body = np.broadcast_to(by.push[1][..., :1], places.shape)
        fields = np.concatenate((np.sum(body * places, axis=0)[None], turned_back(frames, body)))
        return np.asarray(np.einsum("s,isp->pi", weights, fields))

    def _with(self, blade: Blade) -> FloatArray:
        """Return the parts of all sums, (sums, points and masses), in another blade.

        Of one whose unloaded line is that of the solution's.
        """
        functions = frozen(self.model.functions, self.blade, blade)
        return np.concatenate(self.kernels.energies(functions), axis=1)

    def anew(self, blade: Blade, omega: float | None = None) -> FloatArray:
        """Return all sums in any blade, or at another speed [rad/s], without the work of loads."""
        model = SpaceContinuum(frozen(self.model.functions, self.blade, blade))
        masses, stiffness = model.masses, model.functions.stiffness
        sums = []
        for (q, q_dot, _, by, weights), squares in zip(self.states, self.squares, strict=True):
            rate = by.rate if omega is None else omega / self.blade.frequency_scale
            velocity, spin, turn, clamp = model.velocities(q, q_dot, by._replace(rate=rate))
            moved = velocity + cross(spin, masses.offset[:, None])
            twice = np.sum(moved**2, axis=0) @ masses.mass
            twice += np.einsum("isp,ijp,jsp->s", turn, masses.inertia, turn, optimize=True)
            twice += np.einsum("isp,ijp,jsp->s", clamp, masses.carried, clamp, optimize=True)
            sums.append(0.5 * np.sum(squares * stiffness) - 0.5 * weights @ twice)
        return np.array(sums)

    def _parts(self, parameter: Parameter) -> FloatArray:
        """Return the derivatives of all parts along the blade, (sums, parts), kept for stations."""
        if parameter.name not in self._known:
            self._known[parameter.name] = difference(parameter, self._with)
        return self._known[parameter.name]

    def _at_stations(self, family: str) -> FloatArray:
        """Return the derivatives to a family of numbers at all stations, (sums, stations).

        A section has those of the stations at the ends of its cell, and is linear between them.
        """
        table = self.blade.table
        assert table is not None
        x, grid = np.array(table.x) / self.blade.length, self.model.points
        places = np.concatenate((grid, self.model.masses.places))
        share = np.array([np.interp(places, x, one) for one in np.eye(x.size)])
        whole = self.parameters[family]
        if whole.value:  # a factor, of what is between stations
            at = [self.parameters[f"{family}[{k}]"].value for k in range(x.size)]
            share /= np.interp(places, x, at)
        slopes = self._parts(whole) @ share.T
        if family == "setting_angle" and self.model.trapeze != "elastic":
            steps = np.diff(np.eye(x.size), axis=1) / np.diff(x)
            cell = np.clip(np.searchsorted(x, grid, side="right") - 1, 0, x.size - 2)
            slopes += self.kernels.twisted @ steps[:, cell].T
        return np.asarray(slopes)

    def slopes(self, parameter: Parameter) -> FloatArray:
        """Return the derivatives of all sums, (sums,), to a parameter that does not move the line.

        Or, of a table, turns its sections.
        """
        table = self.blade.table
        if parameter.family and table and table.interpolation == "components":
            family = parameter.family
            if family not in self._at:
                self._at[family] = self._at_stations(family)
            return np.asarray(self._at[family][:, parameter.station])
        return np.asarray(self._parts(parameter).sum(axis=1))
