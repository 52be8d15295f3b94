"""Derivatives of frequencies to the numbers of a blade."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from ..arrays import FloatArray
from ..blade import Blade
from ..exact.continuum.space import SpaceContinuum
from ..exact.continuum.state import Driven
from ..exact.linear.families import LinearModes, modes_of
from ..exact.linear.modes import linear_modes
from ..input_checks import shown
from ..load import Load
from ..motion import SteadyRotation
from ..theory import Theory
from .conditions import conditions_of
from .energies import AROUND, SWING, Energies, OneByOne, States, difference
from .frozen import frozen_blade
from .parameters import Parameter

MOST = 24
"""Modes among which one is sought by its name."""
_FIRST = 6
_PHASES = 8  # in a period: averages are exact up to the seventh harmonic
_STIFF, _SAME = 1e4, 1e-4  # EI out of the plane over that in it, and what it may change


class FrequencyDerivatives(OneByOne):
    """Derivatives of frequencies, from energies in states around the steady one."""

    def __init__(self, modes: LinearModes) -> None:
        self.outputs, self.values = modes.names, modes.frequencies
        self.units = ("rad/s",) * len(modes.names)
        self._modes = modes = in_space(modes)
        steady = modes.steady
        self.model: SpaceContinuum = steady.model
        self.by, self.still = Driven(steady.rate), steady.equilibrium
        _, K, C, M = (part[0] for part in steady.linearized)
        size = np.sqrt(np.einsum("kn,kn->k", modes.coordinates.conj(), modes.coordinates @ K).real)
        self.shapes = modes.coordinates / size[:, None]
        self.frequencies = modes.frequencies / modes.blade.frequency_scale
        # Of φ'Dφ with D = K + iΩC - Ω²M, whose zero is the frequency.
        self.slopes = np.array([
            (shape.conj() @ (1j * C - 2.0 * w * M) @ shape).real
            for w, shape in zip(self.frequencies, self.shapes, strict=True)
        ])  # fmt: skip
        shifts = [np.linalg.solve(K, self._second_order(k)) for k in range(len(self.shapes))]
        squares = np.stack([
            2.0 * np.outer(shape, shape.conj()).real
            - np.outer(shift, self.still) - np.outer(self.still, shift)
            for shape, shift in zip(self.shapes, shifts, strict=True)
        ])  # fmt: skip
        states = [self._around(k, shift, K) for k, shift in enumerate(shifts)]
        self._sums = Energies(self.model, modes.blade, modes.theory, states, squares)
        self.parameters = self._sums.parameters
        self.given = SteadyRotation(omega=modes.omega), ()
        self.conditions = conditions_of(*self.given, modes.blade.frequency_scale)

    def _swings(self, k: int, size: float) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return a mode's q, q̇ and q̈ about the steady state over a period."""
        w, phases = self.frequencies[k], 2.0 * math.pi * np.arange(_PHASES) / _PHASES
        moved = size * np.exp(1j * phases)[:, None] * self.shapes[k]
        return self.still + moved.real, (1j * w * moved).real, (-(w**2) * moved).real

    def _second_order(self, k: int) -> FloatArray:
        """Return the mean force of a mode's swing, four times of its square: φ'(∂D/∂q)φ."""
        none = np.zeros((1, self.still.size))
        (at_rest,) = self.model.residual(self.still[None], none, none, self.by)
        once, twice = (
            4.0 * (self.model.residual(*self._swings(k, h), self.by).mean(axis=0) - at_rest) / h**2
            for h in (SWING, 2.0 * SWING)
        )
        return np.asarray((4.0 * once - twice) / 3.0)

    def _around(self, k: int, shift: FloatArray, K: FloatArray) -> States:
        """Return the states around one mode.

        Sums of energies are φ'Dφ, and what the change of the steady state adds to it.
        """
        swings = [self._swings(k, h) for h in (SWING, 2.0 * SWING)]
        length = math.sqrt(float(shift @ K @ shift)) or 1.0
        along, of_slope = AROUND
        rest = self.still + np.outer(np.append(0.0, SWING / length * along), shift)
        none = np.zeros_like(rest)
        each = 4.0 / (_PHASES * SWING**2)
        squares = np.repeat([4.0 / 3.0 * each, -each / 12.0], _PHASES)
        weights = (squares, [-squares.sum()], -of_slope * length / SWING)
        states = zip(*swings, (rest, none, none), strict=True)
        q, q_dot, q_ddot = map(np.concatenate, states)
        return States(q, q_dot, q_ddot, self.by, np.concatenate(weights))

    def again(self, blade: Blade, motion: Any, loads: Sequence[Load]) -> dict[str, float]:
        """Return the frequencies of another blade at another speed, by name.

        By the strains of the same functions, in a steady state and an eigenvalue problem.
        """
        del loads
        modes, rate = self._modes, motion.omega / self._modes.blade.frequency_scale
        other = replace(frozen_blade(modes.steady, modes.blade, _known(blade)), rate=rate)
        found = modes_of(modes.blade, motion.omega, modes.theory, other)
        return dict(zip(found.names, found.frequencies.tolist(), strict=True))

    def to(self, parameter: Parameter) -> FloatArray:
        """Return the derivatives of all frequencies [rad/s] to a parameter."""
        sums = self._sums
        if parameter.name in self.conditions:
            slope = difference(parameter, lambda other: sums.anew(sums.blade, other[0].omega))
        else:
            slope = difference(parameter, sums.anew) if parameter.moves else sums.slopes(parameter)
        return np.asarray(-sums.blade.frequency_scale * slope / self.slopes)


def require_modes(modes: object) -> None:
    """Refuse all but `LinearModes`."""
    if not isinstance(modes, LinearModes):
        raise TypeError(f"modes must be what linear_modes returns, got {shown(modes)}")


def in_space(modes: LinearModes) -> LinearModes:
    """Return modes in space; of a blade known in its plane, with a large stiffness out of it."""
    require_modes(modes)
    if isinstance(modes.model, SpaceContinuum):
        return modes
    blade, count = _known(modes.blade), len(modes.names)
    # Flap comes between them where there are many, or where shear alone bends it.
    several = linear_modes(blade, modes.omega, 2 * count, theory=modes.theory)
    off = np.abs(several.frequencies / modes.frequencies[:, None] - 1.0)
    of = off.argmin(axis=1)
    if (away := off.min(axis=1).max()) > _SAME or np.unique(of).size < count:
        raise ValueError(
            f"with a stiff section out of its plane the blade has other modes, by {away:.1g}: give "
            "the section by with_section_out_of_plane"
        )
    return several.among(of)


def _known(blade: Blade) -> Blade:
    """Return a blade whose section out of its plane is known; a stiff one unless it is."""
    known = blade.section.knows_space
    return blade if known else blade.with_section_out_of_plane(_STIFF, math.inf)


def modes_until(
    enough: Callable[[LinearModes], bool], blade: Blade, omega: float, theory: Theory,
    count: int = _FIRST,
) -> LinearModes:  # fmt: skip
    """Return as many of the lowest modes as are enough, or those to MOST and to twice `count`."""
    most = max(MOST, 2 * count)
    while True:
        modes = linear_modes(blade, omega, count, theory=theory, functions=max(20, 2 * count))
        if count == most or enough(modes):
            return modes
        count = min(2 * count, most)
