"""Modes tracked over the speed by their shape, and where their frequencies are multiples of it."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import pairwise, product
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

    frequencies = np.array([m.frequencies[c] for m, c in zip(found, columns, strict=True)])
    crossings = [
        crossing
        for pair, places in zip(pairwise(found), pairwise(columns), strict=True)
        for crossing in _met(pair, places, orders, modes_at)
    ]
    return Family(frequencies, np.array(assurances).reshape(-1, count), crossings)


def _met(
    ends: tuple[LinearModes, LinearModes],
    columns: tuple[NDArray[np.intp], NDArray[np.intp]],
    orders: int,
    modes_at: Callable[..., LinearModes],
) -> Iterator[Crossing]:
    """Yield where frequencies cross kω between two speeds, of the modes that hold these places.

    In ascending order frequencies are continuous. A mode followed by its shape changes its place
    at once where two of them veer, and passes a line in between without being there.
    """
    known = {modes.omega: modes for modes in ends}

    def at(square: float) -> LinearModes:
        omega = math.sqrt(square)
        if omega not in known:
            known[omega] = modes_at(omega, min(ends, key=lambda modes: abs(modes.omega - omega)))
        return known[omega]

    def detuning(square: float, place: int, order: int) -> float:
        # Squares of frequencies are nearly straight over that of the speed.
        return float(at(square).frequencies[place] ** 2 - order**2 * square)

    for place, order in product(np.union1d(*columns).tolist(), range(1, orders + 1)):
        before, after = (modes.frequencies[place] - order * modes.omega for modes in ends)
        if before > 0.0 >= after or before < 0.0 <= after:
            low, high = (modes.omega**2 for modes in ends)
            square = optimize.toms748(
                detuning, low, high, args=(place, order), xtol=1e-13 * high, rtol=1e-13
            )
            held = _followed(_assurance(ends[0], at(square))[columns[0]])
            for column in np.flatnonzero(held == place).tolist():
                omega = math.sqrt(square)
                yield Crossing(mode=column + 1, order=order, omega=omega, frequency=order * omega)


def _followed(assurance: FloatArray) -> NDArray[np.intp]:
    """Return the mode that continues each tracked one, all of them different."""
    return np.asarray(optimize.linear_sum_assignment(-assurance)[1])


def _assurance(one: LinearModes, other: LinearModes) -> FloatArray:
    """Modal assurance criterion of all pairs, in the energy norm of the beam at rest."""
    a, b = one.coordinates, other.coordinates
    a = a / np.linalg.norm(a, axis=1, keepdims=True)
    b = b / np.linalg.norm(b, axis=1, keepdims=True)
    return np.asarray(np.abs(a.conj() @ b.T) ** 2)
