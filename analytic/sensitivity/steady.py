"""Derivatives of a steady state, its tip, twist and root loads, to the numbers of a blade.

Each of these numbers y is the change of a potential with something else: of the tip's place with a
force there, of the root loads with a motion of the clamp. So ∂y/∂p is the change, along that force
or motion and the strains that go with it, of ∂Π/∂p at strains as they are. Where loads have no
potential, as those that follow the sections or moments have none, and where the unloaded line
moves, it is of the residual: ∂y/∂p less λ·∂r/∂p, with λ of the tangent.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from functools import cached_property
from typing import Any

import numpy as np

from ..arrays import FloatArray
from ..blade import Blade
from ..exact.continuum.discretization import Model
from ..exact.continuum.loading import unit_load
from ..exact.continuum.rotation import SteadyBlade
from ..exact.continuum.space import SpaceContinuum
from ..exact.continuum.state import Driven
from ..exact.linear.steady_state import SteadyState, steady_state
from ..lazily import spatial
from ..load import Load
from ..motion import SteadyRotation
from .conditions import conditions_of
from .energies import AROUND, SWING, Energies, OneByOne, States, difference
from .frozen import frozen_blade
from .parameters import Parameter, parameters_of

_STEP = 1e-5  # of coordinates, which are of the size of one
_CHANGE = 1e-4  # of a parameter over its size, where residuals are compared
_ROUND_OFF = 1e-12  # without dimensions
_SEEN = 1e-6  # part of a strain that the functions lack
_CLAMP, _TIP = np.zeros(1), np.ones(1)


class SteadyDerivatives(OneByOne):
    """Derivatives of the tip's place, its twist, and force and moment at the root."""

    outputs: tuple[str, ...] = (
        *(f"tip {axis}" for axis in "xyz"), "twist",
        *(f"root {kind} {axis}" for kind in ("force", "moment") for axis in "xyz"),
    )  # fmt: skip
    units: tuple[str, ...] = ("m",) * 3 + ("rad",) + ("N",) * 3 + ("N m",) * 3

    def __init__(self, state: SteadyState) -> None:
        self._state, self._blade, self._steady = state, state.blade, state.steady
        self._unit = units_of(self._blade)
        self.values = _numbers(state)
        by = self._steady.by()
        self.potential = not by.follow and (by.push is None or not by.push[2].any())
        self._adjoint = self._adjoints()
        if self._steady.model.answers:
            self._steady = self._steady.onto(self._caused(), _SEEN)
            self._adjoint = self._adjoints()
        self._theory = state.theory
        self.parameters = parameters_of(self._blade, self._theory)
        self.given = SteadyRotation(omega=state.omega), state.acting
        self.conditions = conditions_of(*self.given, self._blade.frequency_scale)

    @cached_property
    def _sums(self) -> Energies:
        q = self._steady.equilibrium
        ways = [self._along(k, way) for k, way in enumerate(self._adjoint.T)]
        squares = np.stack([np.outer(way, q) + np.outer(q, way) for way in self._adjoint.T])
        return Energies(self._steady.model, self._blade, self._theory, ways, squares)

    def _adjoints(self) -> FloatArray:
        """Return strains that go with the force or motion of each output, (n, outputs)."""
        q = self._steady.equilibrium
        steps = _STEP * np.eye(q.size)
        gradient = _outputs(self._steady, q + steps) - _outputs(self._steady, q - steps)
        K = self._steady.linearized.stiffness[0]
        return np.asarray(np.linalg.solve(K.T, 0.5 / _STEP * gradient))

    def _caused(self) -> FloatArray:
        """Return the forces on strains that these cause, of which a table's functions have none."""
        model, parts = self._steady.model, []
        for k, way in enumerate(self._adjoint.T):
            states = self._along(k, way)
            size = math.sqrt(float(way @ model.functions.stiffness @ way))
            parts.append(model.forces_caused(*states[:4]) @ states.weights / (size or 1.0))
        return np.stack(parts, axis=2)

    def _along(self, k: int, way: FloatArray) -> States:
        """Return the states around the steady one along what has the output `k` for its force."""
        model, q, acting = self._steady.model, self._steady.equilibrium, self._steady.by()
        length = math.sqrt(float(way @ model.functions.stiffness @ way))
        along, weights = AROUND
        size = SWING / max(length, 1.0)
        by = moved(model, acting, k, size * along)
        none = np.zeros((along.size, q.size))
        return States(q + np.outer(size * along, way), none, none, by, weights / size)

    def again(self, blade: Blade, motion: Any, loads: Sequence[Load]) -> dict[str, float]:
        """Return the numbers of another blade, at another speed, under other loads, by name."""
        other = steady_state(blade, motion.omega, loads=loads, theory=self._state.theory)
        return dict(zip(self.outputs, _numbers(other).tolist(), strict=True))

    def to(self, parameter: Parameter) -> FloatArray:
        """Return the derivatives of all outputs to a parameter, in their units."""
        if parameter.name in self.conditions:
            slopes = difference(parameter, self._otherwise, _CHANGE)
        elif self.potential and not parameter.moves:
            slopes = -self._sums.slopes(parameter)
        else:
            slopes = difference(parameter, self._anew, _CHANGE)
        return self._unit * _without_noise(slopes, parameter.size)

    def _anew(self, blade: Blade) -> FloatArray:
        """Return outputs less the adjoint's virtual work, in another blade at the same strains."""
        return self._in(frozen_blade(self._steady, self._blade, blade))

    def _otherwise(self, other: Any) -> FloatArray:
        """Return the same at another speed, or under other loads."""
        motion, loads = other
        return self._in(replace(
            self._steady, rate=motion.omega / self._blade.frequency_scale,
            loads=tuple(unit_load(self._blade, load) for load in loads),
            near=self._steady.equilibrium, given=None,
        ))  # fmt: skip

    def _in(self, other: SteadyBlade) -> FloatArray:
        q = self._steady.equilibrium[None]
        still = np.zeros_like(q)
        work: FloatArray = other.residual(q, still, still) @ self._adjoint
        return np.asarray((_outputs(other, q) - work)[0])


def moved(model: SpaceContinuum, acting: Driven, output: int, sizes: FloatArray) -> Driven:
    """Return what drives the blade where a load on the tip or a motion of the clamp is added.

    That of which an output is the force, by `sizes` (samples,).
    """
    none = np.zeros((3, sizes.size))
    pull, twist, shift, turn = (none.copy() for _ in range(4))
    for kind, first in ((pull, 0), (twist, 3), (shift, 4), (turn, 7)):
        if first <= output < first + (1 if kind is twist else 3):
            kind[output - first] = sizes
    back = spatial.transform.Rotation.from_rotvec(-turn.T).as_matrix()
    W, W_dot, hub = model.clamp(acting)
    arms = tuple(
        np.einsum("sij,js->is", back, np.broadcast_to(one[..., 0], shift.shape) + more)[..., None]
        for one, more in ((W, none), (W_dot, none), (hub, shift))
    )
    push = np.zeros((3, 3, sizes.size, model.points.size))
    if acting.push is not None:
        push += np.einsum("sij,kjsp->kisp", back, np.broadcast_to(acting.push, push.shape))
    push[0] += np.multiply.outer(pull, model.outboard["tip"])
    push[2] += np.multiply.outer(twist, model.outboard["tip"])
    return acting._replace(push=push, clamp=arms)


def _without_noise(values: FloatArray, size: float = 1.0) -> FloatArray:
    """Return values, or derivatives to a number of a size, with zeros for round-off."""
    return np.where(np.abs(values) * size < _ROUND_OFF, 0.0, values)


def units_of(blade: Blade) -> FloatArray:
    """Return the units of place, twist, force and moment, (10,)."""
    force = blade.bending_stiffness / blade.length**2
    return np.repeat([blade.length, 1.0, force, force * blade.length], [3, 1, 3, 3])


def _numbers(state: SteadyState) -> FloatArray:
    """Return the outputs, in their units."""
    values = _outputs(state.steady, state.steady.equilibrium[None])[0]
    return units_of(state.blade) * _without_noise(values)


def _outputs(steady: SteadyBlade, q: FloatArray) -> FloatArray:
    """Return place and twist of the tip, and force and moment at the root, at rest."""
    still = np.zeros_like(q)
    return places_and_loads(steady.model, q, still, still, steady.by())


def places_and_loads(model: Model, *state: Any) -> FloatArray:
    """Return place and twist of the tip, and force and moment at the root, (samples, 10).

    In states q, q̇, q̈ and what drives them. All without dimensions, and in the frame of the clamp.
    """
    ((section,),) = model.standing(state[0][:1], _CLAMP)[1]  # which is held
    loads = (one[:, 0] @ section.T for one in model.section_loads(_CLAMP, *state))
    places = model.places(state[0], _TIP)[:, 0]
    return np.hstack((places, model.tip_turn(state[0])[:, None], *loads))
