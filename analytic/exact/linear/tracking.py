"""Modes tracked over the speed by their shape, and where their frequencies are multiples of it."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from itertools import count as count_from
from itertools import pairwise
from typing import Any, NamedTuple, cast

import numpy as np
from numpy.typing import NDArray
from scipy import optimize
from scipy.interpolate import barycentric_interpolate

from ...arrays import FloatArray
from ...beam import AnyBlade
from ...theory import Theory
from ..space.modes import space_modes_on
from ..space.steady import lives_in_space
from .modes import LinearModes, Plane, flap_blade, linear_modes, modes_on

_SPARE_MODES = 3  # beyond those asked for, so that a mode that sinks is still found
_THROUGH = 4  # solved speeds that a crossing is interpolated through
_HALVED = 4  # th step halves the interval, for frequencies that jump
_NEAR = 1e-9  # of the speed: so near to a solved one an interpolated crossing is exact to rounding


@dataclass(frozen=True, kw_only=True)
class Crossing:
    """A crossing of a Campbell diagram: the frequency of `mode` is k times the speed.

    Attributes
    ----------
    mode : int
        Mode, from 1, in the order of its family's frequencies at the lowest speed.
    order : int
        Engine order k.
    omega : float
        Speed [rad/s].
    frequency : float
        Frequency kω [rad/s].
    plane : str
        Its family: "lag", the blade's own plane of bending, "flap" or "torsion".
    """

    mode: int
    order: int
    omega: float
    frequency: float
    plane: Plane = "lag"


class Family(NamedTuple):
    """Frequencies (speeds, count), the assurance of tracking (speeds - 1, count), crossings."""

    frequencies: FloatArray
    mac: FloatArray
    crossings: list[Crossing]


def family_of(
    beam: AnyBlade, speeds: FloatArray, count: int, orders: int, plane: Plane, theory: Theory
) -> Family:
    """Return the first modes of a family over the speeds, and where they meet the lines kω."""
    wanted = count + _SPARE_MODES * (plane != "torsion")  # whose modes keep their order
    ends = [
        linear_modes(
            beam, omega, wanted, plane=plane, theory=theory, functions=max(20, 2 * wanted)
        ).model
        for omega in {float(speeds[0]), float(speeds[-1])}
    ]
    # A model that resolves the modes at both ends does so between them.
    model: Any = max(ends, key=lambda one: one.bending)
    bent = flap_blade(beam) if plane == "flap" else beam
    in_space = plane == "torsion" or lives_in_space(beam)

    def modes_at(omega: float, near: Any = None) -> LinearModes:
        if not in_space:
            return modes_on(model, bent, omega, wanted)
        torsion = plane == "torsion"
        modes = space_modes_on(model, beam, omega, wanted, torsion=torsion, near=near)
        return cast(LinearModes, modes)

    found: list[LinearModes] = []
    for omega in speeds.tolist():
        found.append(modes_at(omega, *found[-1:]))
    columns = [np.arange(count)]
    assurances = []
    for here, there in pairwise(found):
        assurance = _assurance(here, there)[columns[-1]]
        columns.append(_followed(assurance))
        assurances.append(assurance[np.arange(count), columns[-1]])

    def tracked(omega: float, row: int) -> FloatArray:
        near = min(found[row : row + 2], key=lambda modes: abs(modes.omega - omega))
        modes = modes_at(omega, near)
        return modes.frequencies[_followed(_assurance(found[row], modes)[columns[row]])]

    frequencies = np.array([m.frequencies[c] for m, c in zip(found, columns, strict=True)])
    crossings = _met(speeds, frequencies, orders, tracked)
    return Family(frequencies, np.array(assurances).reshape(-1, count), crossings)


def _met(
    speeds: FloatArray,
    frequencies: FloatArray,
    orders: int,
    tracked: Callable[[float, int], FloatArray],
) -> list[Crossing]:
    """Return where the columns cross kω; what finds it depends on the speed before."""
    crossings = []
    known = dict(zip(speeds.tolist(), frequencies, strict=True))
    for row, ends in enumerate(pairwise(speeds.tolist())):
        for column in range(frequencies.shape[1]):
            for order in range(1, orders + 1):
                before, after = (known[end][column] - order * end for end in ends)
                if before > 0.0 >= after or before < 0.0 <= after:
                    omega = _crossed(known, row, ends, column, order, tracked)
                    crossings.append(
                        Crossing(mode=column + 1, order=order, omega=omega, frequency=order * omega)
                    )
    return crossings


def _crossed(
    known: dict[float, FloatArray],
    row: int,
    ends: tuple[float, float],
    column: int,
    order: int,
    tracked: Callable[[float, int], FloatArray],
) -> float:
    """Return where a column crosses kω between the ends; all that is solved becomes known."""
    low, high = ends
    falls = known[low][column] > order * low
    for step in count_from(1):
        # Squares of frequencies are nearly straight over those of the speed.
        squares = np.array(list(known)) ** 2
        detuning = np.array([found[column] for found in known.values()]) ** 2 - order**2 * squares
        nearest = np.argsort(np.abs(detuning))[:_THROUGH]
        square = float(barycentric_interpolate(detuning[nearest], squares[nearest], 0.0))
        middle = 0.5 * (low + high)
        omega = math.sqrt(square) if low**2 < square <= high**2 else middle
        if min(omega - low, high - omega) <= _NEAR * high:
            break
        if step % _HALVED == 0:
            omega = middle
        known[omega] = tracked(omega, row)
        if (known[omega][column] > order * omega) == falls:
            low = omega
        else:
            high = omega
    return omega


def _followed(assurance: FloatArray) -> NDArray[np.intp]:
    """Return the mode that continues each tracked one, all of them different."""
    return np.asarray(optimize.linear_sum_assignment(-assurance)[1])


def _assurance(one: LinearModes, other: LinearModes) -> FloatArray:
    """Modal assurance criterion of all pairs, in the energy norm of the beam at rest."""
    a, b = one.coordinates, other.coordinates
    a = a / np.linalg.norm(a, axis=1, keepdims=True)
    b = b / np.linalg.norm(b, axis=1, keepdims=True)
    return np.asarray(np.abs(a.conj() @ b.T) ** 2)
