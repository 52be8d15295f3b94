"""The blade in steady rotation: its steady state, followed from rest, and its modes."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, ClassVar, Self

import numpy as np
from numpy.typing import NDArray

from ...arrays import ComplexArray, FloatArray
from ...blade import Blade
from ...blade_checks import require_steady_state
from ...loads import Load
from ...methods.orbit import Orbit
from ...methods.system import Tangent, reciprocal_modes
from ...settled import refined
from .answers import forces_caused
from .discretization import Model
from .equilibrium import Equilibrium
from .loading import pushes
from .planar_rotation import on_more
from .state import Driven

GAUGES = {"lag": 1, "flap": 2}
"""Components of the tip's place whose peak may be called the amplitude."""
_MODES = 6  # whose answers a refinement adds
_INSTANTS = 64  # of a motion, by whose forces functions are made
_MASSLESS = 1e-12  # 1/Ω of what has no inertia


@dataclass(frozen=True, eq=False)
class SteadyBlade:
    """The blade in a frame that turns at a constant rate; a system of `methods`.

    The gauge is a component of the tip's place, from the steady state on: lag, or flap in space; in
    the plane of bending across the blade. The invariant is the Jacobi integral. With `mirror`
    orbits are sought that the mirror maps onto themselves in reversed time, where the half turn
    would as well.
    """

    model: Any  # a `Model`
    rate: float  # w̄ = ω/√(EI3/mL³)
    component: int = GAUGES["lag"]
    near: FloatArray | None = None  # from where the steady state is found; from rest by default
    loads: tuple[Load, ...] = ()  # without dimensions, as they are at t = 0
    mirror: bool = False
    given: tuple[FloatArray, Tangent] | None = None  # steady state and its tangent, if known
    driven: ClassVar[bool] = False

    @property
    def size(self) -> int:
        """Number of coordinates."""
        return int(self.model.size)

    @property
    def functions(self) -> int:
        """Number of functions for each curvature of bending."""
        return int(self.model.bending)

    @property
    def stiff(self) -> bool:
        """Whether some motion has hardly any inertia, or none, as twist."""
        return bool(self.model.stiff)

    def lifted(self, q: FloatArray, finer: SteadyBlade) -> FloatArray:
        """Return the coordinates of the same shape on more functions, along the last axis."""
        return on_more(q, self.model.families, finer.model.families)

    def unloaded(self, frequency: float) -> SteadyBlade:
        """Return it without load, at the speed that belongs to a drive's frequency."""
        del frequency
        return self

    def by(self, *drive: Any) -> Driven:
        """Return what drives it, where a drive acts at phases (samples,) and a frequency."""
        del drive
        return self._acting

    def residual(self, *state: Any) -> FloatArray:
        """Return the virtual work (samples, n) of all forces in states q, q̇, q̈ and their drive."""
        return np.asarray(self.model.residual(*state[:3], self.by(*state[3:])))

    def tangent(self, *state: Any) -> Tangent:
        """Return the residual of the same states and its derivatives to q, q̇ and q̈."""
        tangent: Tangent = self.model.tangent(*state[:3], self.by(*state[3:]))
        return tangent

    def section_loads(self, x: FloatArray, *state: Any) -> tuple[FloatArray, FloatArray]:
        """Return force and moment at `x` in the same states, as the model has them."""
        loads: tuple[FloatArray, FloatArray]
        loads = self.model.section_loads(x, *state[:3], self.by(*state[3:]))
        return loads

    def potential(self, q: FloatArray) -> FloatArray:
        """Return the amended potential, of the elastic and the centrifugal forces, (samples,)."""
        return np.asarray(self.model.amended_potential(q, self.rate))

    def kinetic_energy(self, q: FloatArray, q_dot: FloatArray) -> FloatArray:
        """Return the kinetic energy relative to the rotating frame, (samples,)."""
        return np.asarray(self.model.kinetic_energy(q, q_dot))

    @cached_property
    def _acting(self) -> Driven:
        now = np.zeros(1)
        loads = [(load, load.phase_at(now)) for load in self.loads]
        return Driven(self.rate, 0.0, *pushes(self.model, loads, now))

    @cached_property
    def odd(self) -> NDArray[np.bool_] | None:
        """True for coordinates that time reversal turns around, (n,); None without a reversal."""
        odd: NDArray[np.bool_] | None = self.model.reversal(self.component, self.mirror)
        return odd

    @property
    def pinned(self) -> int:
        """The first coordinate of the gauge's curvature."""
        return self.component - 1

    @property
    def equilibrium(self) -> FloatArray:
        """Coordinates (n,) of the steady state; refused if it ends, or gets unstable, before."""
        return self._steady[0]

    @property
    def linearized(self) -> Tangent:
        """The tangent at the steady state, (1, n, n)."""
        return self._steady[1]

    @cached_property
    def _steady(self) -> tuple[FloatArray, Tangent]:
        if self.given is not None:
            return self.given
        return Equilibrium(self.model, self._acting).followed(self.near)

    def gauge(self, q: FloatArray) -> FloatArray:
        """Return the tip's place along the component, from the steady state, (samples,)."""
        return np.asarray(self.model.tip(q)[:, self.component] - self._still)

    @cached_property
    def _still(self) -> float:
        """The component in the steady state: zero of a blade that stays straight."""
        straight = not self.loads and self.model.uncoupled
        return 0.0 if straight else float(self.tip[self.component])

    def gauge_rate(self, q: FloatArray, q_dot: FloatArray) -> FloatArray:
        """Return its rate, (samples,)."""
        return np.asarray(self.model.tip_rate(q, q_dot)[:, self.component])

    def gauge_gradient(self, q: FloatArray) -> FloatArray:
        """Return its derivatives to the coordinates, (samples, n)."""
        return np.asarray(self.model.tip_gradient(q)[:, self.component])

    def refined(self, *state: Any) -> Self:
        """Return the blade on more functions, the same each time, or by the states of a table."""
        if not (state and self.model.answers):
            return self._finer
        few = slice(None, None, -(-len(state[0]) // _INSTANTS))
        q, q_dot, q_ddot, *drive = (one[few] if np.ndim(one) else one for one in state)
        caused = self.model.forces_caused(q, q_dot, q_ddot, self.by(*drive))
        moved, mean = q - q.mean(axis=0), caused.mean(axis=2, keepdims=True)
        energy = float(np.sum(moved * (moved @ self.model.functions.stiffness), axis=1).max())
        # Apart from the mean: in a sum with it the forces of a small motion are round-off.
        motion = (caused - mean) / math.sqrt(energy or 1.0)
        return self.onto(np.concatenate((mean, motion), axis=2))

    @cached_property
    def _finer(self) -> Self:
        return self.resolving(_MODES)

    def resolving(self, modes: int) -> Self:
        """Return the blade on more functions, on a table with the answers of the lowest modes."""
        if not self.model.answers:
            return self.onto(None)
        free = self.unloaded(self.rate)
        try:
            return self.onto(forces_caused(free, modes))
        except np.linalg.LinAlgError:  # no modes where a moment that keeps its direction bends far
            return self.onto(forces_caused(free, 0))

    def onto(self, caused: FloatArray | None, seen: float | None = None) -> Self:
        """Return the blade on more functions, on a table with the forces `caused` by answers."""
        finer = replace(self, model=self.model.refined(caused, seen))
        return replace(finer, near=self.lifted(self.equilibrium, finer))

    @cached_property
    def vibration(self) -> tuple[FloatArray, ComplexArray]:
        """Frequencies, ascending, and shapes (n, modes) in columns.

        Each block is solved alone: equal frequencies of both would mix them.
        """
        parts = list(map(self.vibration_of, self.blocks))
        frequencies, shapes = (np.concatenate(part, axis=-1) for part in zip(*parts, strict=True))
        order = np.argsort(frequencies, kind="stable")
        return frequencies[order], shapes[:, order]

    @cached_property
    def shares(self) -> FloatArray:
        """Shares of flap, lag, torsion and axial motion in the modes' kinetic energy."""
        shares: FloatArray = self.model.shares(self.equilibrium, self.vibration[1].T)
        return shares

    @property
    def blocks(self) -> list[NDArray[np.intp]]:
        """Places of coordinates that move without the others: of lag, of flap and torsion."""
        if not self.model.uncoupled or self.loads:
            return [np.arange(self.size)]
        return list(map(np.flatnonzero, self.model.blocks))

    def vibration_of(self, moving: NDArray[np.intp]) -> tuple[FloatArray, ComplexArray]:
        """Return the same where only some coordinates move.

        x exp(iΩτ) obeys K + iΩC - Ω²M, with a skew C. Under time reversal odd coordinates go with
        the sine, the others with the cosine: K - ΩS - Ω²M is real. Their shapes are real there,
        the others' imaginary.
        """
        K, C, M = (part[0][np.ix_(moving, moving)] for part in self.linearized[1:])
        skew, turn = 0.5 * (C - C.T), np.ones(moving.size, dtype=np.complex128)
        coupling: FloatArray | ComplexArray = -1j * skew
        if self.odd is not None and not self.loads:
            odd = self.odd[moving]
            coupling = np.where(np.outer(odd, ~odd), skew, 0.0)
            coupling, turn = coupling + coupling.T, np.where(odd, 1.0, 1.0j)
        inverse, modes = reciprocal_modes(0.5 * (K + K.T), coupling, 0.5 * (M + M.T))
        # Some motion has no inertia; the inextensible beam has no axial modes.
        kept = inverse > _MASSLESS
        shapes = np.zeros((self.size, np.count_nonzero(kept)), dtype=np.complex128)
        shapes[moving] = turn[:, None] * modes[:, kept]
        return 1.0 / inverse[kept], shapes

    def dynamic_stiffness(self, frequency: float) -> ComplexArray:
        """Return K + iΩC - Ω²M of small vibration, with a skew C, (n, n)."""
        _, K, C, M = (part[0] for part in self.linearized)
        whole = K - frequency**2 * M + 0.5j * frequency * (C - C.T)
        return np.asarray(0.5 * (whole + whole.conj().T))

    @cached_property
    def tip(self) -> FloatArray:
        """Place of the tip from the clamp in the steady state."""
        return np.asarray(self.model.tip(self.equilibrium[None])[0])


BladeOrbit = Orbit[SteadyBlade]
"""A free periodic orbit of a blade."""


def finer_blades(
    first: SteadyBlade, finer: Callable[[SteadyBlade], SteadyBlade] = SteadyBlade.refined
) -> Iterator[SteadyBlade]:
    """Yield a blade on more and more functions, up to the most that are taken, once at least.

    Many kinks or stations need more from the beginning: a panel lies between two of them.
    """
    most = max(first.model.most_functions, first.functions)
    return refined(first, finer, lambda one: one.functions > most)


def rotating_blade(
    blade: Blade, omega: float, model: Model, gauge: object = "lag", **more: Any
) -> SteadyBlade:
    """Return the blade in steady rotation at ω [rad/s].

    Refuses a speed that tears it, and a gauge that it does not have.
    """
    if gauge not in GAUGES:
        raise ValueError(f"gauge must be 'lag' or 'flap', got {gauge!r}")
    if gauge not in model.gauges:
        raise ValueError(
            f"this blade stays in its plane under the load, and gauge is {gauge!r}: leave it out"
        )
    if model.extends:
        require_steady_state(blade, omega)
    return SteadyBlade(model, omega / blade.frequency_scale, GAUGES[str(gauge)], **more)
