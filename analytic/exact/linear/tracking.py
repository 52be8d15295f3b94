"""Modes tracked over the speed by their shape, and where their frequencies are multiples of it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from itertools import pairwise
from typing import Any, NamedTuple, cast

import numpy as np
from numpy.typing import NDArray
from scipy import optimize

from ...arrays import FloatArray
from ...beam import AnyBlade
from ...theory import Theory
from ..space.modes import space_modes_on
from ..space.steady import lives_in_space
from .modes import LinearModes, Plane, flap_blade, linear_modes, modes_on

_SPARE_MODES = 3  # beyond those asked for, so that a mode that sinks is still found


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

    def modes_at(omega: float) -> LinearModes:
        functions = max(20, 2 * wanted)
        return linear_modes(beam, omega, wanted, plane=plane, theory=theory, functions=functions)

    bent, solved = flap_blade(beam) if plane == "flap" else beam, cast(Any, modes_on)
    if plane == "torsion" or lives_in_space(beam):
        solved = partial(space_modes_on, torsion=plane == "torsion")
    found = [modes_at(omega) for omega in speeds.tolist()]
    columns = [np.arange(count)]
    assurances = []
    for here, there in pairwise(found):
        assurance = _assurance(here, there)[columns[-1]]
        columns.append(_followed(assurance))
        assurances.append(assurance[np.arange(count), columns[-1]])

    def detuning_from(row: int) -> Callable[[float, int, int], float]:
        here, there = found[row : row + 2]
        # A model that resolves the modes at both ends does so between them.
        finer = max(here.model, there.model, key=lambda model: model.bending)

        def detuning(omega: float, mode: int, order: int) -> float:
            modes = solved(finer, bent, omega, wanted)
            same = _followed(_assurance(here, modes)[columns[row]])[mode]
            return float(modes.frequencies[same] - order * omega)

        return detuning

    frequencies = np.array([m.frequencies[c] for m, c in zip(found, columns, strict=True)])
    crossings = _met(speeds, frequencies, orders, detuning_from)
    return Family(frequencies, np.array(assurances).reshape(-1, count), crossings)


def _met(
    speeds: FloatArray,
    frequencies: FloatArray,
    orders: int,
    detuning_from: Callable[[int], Callable[[float, int, int], float]],
) -> list[Crossing]:
    """Return where the columns cross kω; what finds it depends on the speed before."""
    crossings = []
    for row, (low, high) in enumerate(pairwise(speeds.tolist())):
        for column in range(frequencies.shape[1]):
            for order in range(1, orders + 1):
                before = frequencies[row, column] - order * low
                after = frequencies[row + 1, column] - order * high
                if before > 0.0 >= after or before < 0.0 <= after:
                    omega = optimize.brentq(
                        detuning_from(row), low, high, args=(column, order),
                        xtol=1e-13 * high, rtol=1e-13,
                    )  # fmt: skip
                    crossings.append(
                        Crossing(mode=column + 1, order=order, omega=omega, frequency=order * omega)
                    )
    return crossings


def _followed(assurance: FloatArray) -> NDArray[np.intp]:
    """Return the mode that continues each tracked one, all of them different."""
    return np.asarray(optimize.linear_sum_assignment(-assurance)[1])


def _assurance(one: LinearModes, other: LinearModes) -> FloatArray:
    """Modal assurance criterion of all pairs, in the energy norm of the beam at rest."""
    larger = max(one.model, other.model, key=lambda model: model.bending)
    a, b = (modes.model.padded(modes.coordinates, larger) for modes in (one, other))
    a = a / np.linalg.norm(a, axis=1, keepdims=True)
    b = b / np.linalg.norm(b, axis=1, keepdims=True)
    return np.asarray(np.abs(a.conj() @ b.T) ** 2)
