"""The blade in space in steady rotation: its steady state, followed in the speed from rest."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from ...arrays import FloatArray
from ...blade import Blade
from ...blade_checks import require_blade, require_steady_state
from ...input_checks import finite_number
from ...loads import Load
from ...methods.system import Tangent
from ...settled import refined
from ...theory import Theory, require_theory
from .basis import StrainFunctions
from .planar_rotation import AtConstantRate, require_shear, steady_rotation
from .space import SpaceContinuum
from .state import Driven
from .unit import space_unit

FUNCTIONS = 12
"""Functions for each curvature of bending, at least, on a blade without point masses."""
MOST_FUNCTIONS = 80
"""Functions for each curvature of bending, at most."""
_SHORTEST = 1e-4  # step of speed and load, over what of them is reached
_LARGEST_KICK = 0.1
_STEPS = 60  # of speed and load
_CHANGES, _EXACT = 12, 1e-12  # of Newton's method, and the last over the size of the state
_CONTRACTION = 0.25


def space_continuum(blade: Blade, theory: Theory, functions: int) -> SpaceContinuum:
    """Return the discretization by at least so many functions for each curvature."""
    require_section(blade)
    require_shear(blade, require_theory(theory))
    if theory.engesser:
        raise ValueError("Engesser's law of shear is known in the plane: leave engesser out")
    unit = space_unit(blade)
    a_panel = max(4, math.ceil(functions / unit.panel_count))
    return SpaceContinuum(
        StrainFunctions(
            blade=unit,
            theory=theory,
            slenderness=blade.slenderness,
            bending=a_panel,
            torsion=a_panel,
            axial=max(4, 5 * a_panel // 8),
        )
    )


def lives_in_space(blade: Blade, loads: Sequence[Load] = ()) -> bool:
    """Whether flap, lag and torsion of a blade under loads go together.

    A setting angle mixes them where the stiffness out of the plane and in torsion is known.
    """
    require_blade(blade)
    turned = blade.setting_angle != 0.0 and blade.section.knows_space
    return turned or not blade.is_planar or any(load.leaves_plane for load in loads)


def require_bent(name: str, bent: float) -> float:
    """Return a start out of the plane, over L; refuse one that is not small."""
    if not abs(finite_number(name, bent)) <= _LARGEST_KICK:
        raise ValueError(
            f"{name} must be at most {_LARGEST_KICK:g} of the length, got {bent:g}: it is to be "
            "small, 1e-6 say"
        )
    return float(bent)


def require_section(blade: Blade) -> None:
    """Refuse a blade whose stiffness out of the plane or in torsion is not known."""
    if not blade.section.knows_space:
        raise ValueError(
            "twist, precone, prebend, sweep, offsets, a setting angle, a kick or tilted gravity "
            "bend a blade out of its plane and twist it: give its stiffness there by "
            "blade.with_section_out_of_plane(bending_ratio, torsion_ratio), math.inf for a section "
            "that does not twist"
        )


@dataclass(frozen=True, eq=False)
class SpaceBlade(AtConstantRate):
    """The blade in a frame that turns at a constant rate; a system of `methods`.

    The gauge is the tip's place from the steady state along a direction in the root frame. With
    `mirror` orbits are sought that the mirror maps onto themselves in reversed time, where the half
    turn would as well.
    """

    model: SpaceContinuum
    rate: float  # w̄ = ω/√(EI3/mL³)
    direction: tuple[float, float, float] = (0.0, 1.0, 0.0)
    near: FloatArray | None = None  # from where the steady state is found; from rest by default
    load: tuple[tuple[float, ...], ...] = ()  # dead force and moment at the tip, over EI3/L², EI3/L
    lift: float = 0.0  # pull on all masses along the axis of rotation, over EI3/(m0 L³)
    mirror: bool = False
    stiff: ClassVar[bool] = True  # twist has hardly any inertia, or none

    @cached_property
    def push(self) -> FloatArray | None:
        """The load, as `model.residual` takes it."""
        if not (self.load or self.lift):
            return None
        result = self.model.push(np.zeros(1, dtype=complex), "mass", self.lift)
        if self.load:
            result[[0, 2]] = np.multiply.outer(self.load, self.model.weights)[:, :, None]
        return result

    @cached_property
    def odd(self) -> NDArray[np.bool_] | None:
        """True for coordinates that time reversal turns around, (n,); None without a reversal.

        Nor where the gauge is not among them: of blades with precone the lag is, flap is not.
        """
        if self.direction[2] and not self.model.functions.blade.half_turn:
            return None
        return self.model.functions.odd_by(mirror=True) if self.mirror else self.model.functions.odd

    @property
    def pinned(self) -> int:
        """The first coordinate of the gauge's curvature."""
        return 1 if self.direction[2] else 0

    @cached_property
    def equilibrium(self) -> FloatArray:
        """Coordinates (n,) of the steady state; refused if it ends, or gets unstable, before."""
        found = None if self.near is None else self._newton(self.near, 1.0)
        if found is not None:
            return found
        unit = self.model.functions.blade
        # A straight blade stays straight, and nothing is to be followed.
        still = self.push is None and (self.rate == 0.0 or (unit.half_turn and unit.mirrored))
        q, reached, step = np.zeros(self.size), float(still), 1.0
        for _ in range(_STEPS):
            share = min(reached + step, 1.0)
            found = self._newton(q, share)
            if found is not None:
                if share == 1.0:
                    return found
                q, reached, step = found, share, 2.0 * step
            else:
                step = 0.5 * (share - reached)
                if step <= _SHORTEST * reached:
                    raise ValueError(self._lost("ends or becomes unstable", reached))
        raise ValueError(self._lost(f"is followed in {_STEPS} steps and is still", reached))

    def _lost(self, how: str, reached: float) -> str:
        """Return a sentence on the steady state that is followed up to shares of speed and load."""
        at, remedies = [], []
        if self.rate:
            at.append(f"w_bar = {reached * self.rate:.4g} of {self.rate:.4g}")
            remedies.append("rotate slower")
        if self.push is not None:
            at.append(f"{reached:.4g} of the load")
            remedies.append("load it less, and check its unit")
        return f"the steady state {how} at {' and '.join(at)}: {', or '.join(remedies)}"

    def _newton(self, q: FloatArray, share: float) -> FloatArray | None:
        """Return the state that `q` (n,) goes over into at shares of speed and load.

        None where it may be one of another branch: the tangent must stay stable, and the second
        change be less than a quarter of the first, as it is where the theorem of Newton and
        Kantorovich holds (Deuflhard, Newton Methods for Nonlinear Problems, 2011).
        """
        still, rate = np.zeros((1, self.size)), share * self.rate
        push = None if self.push is None else share * self.push
        # A moment that keeps its direction has no potential.
        values = np.linalg.eigvals if push is not None and push[2].any() else np.linalg.eigvalsh
        sizes: list[float] = []
        for _ in range(_CHANGES):
            tangent = self.model.tangent(q[None], still, still, Driven(rate, push=push))
            if not values(tangent.stiffness[0]).real.min() > 0.0:
                return None
            change = np.linalg.solve(tangent.stiffness[0], tangent.residual[0])
            q = q - change
            sizes.append(float(np.linalg.norm(change)))
            if sizes[-1] <= _EXACT * max(float(np.linalg.norm(q)), _EXACT):
                return q
            if len(sizes) == 2 and not sizes[1] <= _CONTRACTION * sizes[0]:
                return None
        return None

    def gauge(self, q: FloatArray) -> FloatArray:
        """Return the tip's place along the direction, relative to the steady state, (samples,)."""
        return np.asarray((self.model.tip(q) - self.tip) @ np.array(self.direction))

    def gauge_rate(self, q: FloatArray, q_dot: FloatArray) -> FloatArray:
        """Return its rate, (samples,)."""
        return np.asarray(self.model.tip_rate(q, q_dot) @ np.array(self.direction))

    def gauge_gradient(self, q: FloatArray) -> FloatArray:
        """Return its derivatives to the coordinates, (samples, n)."""
        return np.asarray(np.array(self.direction) @ self.model.tip_gradient(q))

    def refined(self) -> SpaceBlade:
        """Return the blade on half as many functions again, the same each time."""
        return self._finer

    @cached_property
    def _finer(self) -> SpaceBlade:
        finer = replace(self, model=self.model.refined())
        return replace(finer, near=self.lifted(self.equilibrium, finer))

    @cached_property
    def tip(self) -> FloatArray:
        """Place of the tip from the clamp in the steady state, (3,)."""
        return np.asarray(self.model.tip(self.equilibrium[None])[0])

    @cached_property
    def linearized(self) -> Tangent:
        """The tangent at the steady state, (1, n, n)."""
        still = np.zeros((1, self.size))
        return self.tangent(self.equilibrium[None], still, still)


def finer_blades(first: SpaceBlade) -> Iterator[SpaceBlade]:
    """Yield a blade on more and more functions, up to the most that are taken, once at least.

    Many kinks or stations need more from the beginning: a panel lies between two of them.
    """
    most = max(MOST_FUNCTIONS, first.functions)
    return refined(first, SpaceBlade.refined, lambda one: one.functions > most)


def space_rotation(blade: Blade, omega: float, model: SpaceContinuum) -> SpaceBlade:
    """Return the blade in steady rotation at ω [rad/s], refusing a speed that tears it."""
    if model.functions.theory.extension:
        require_steady_state(blade, omega)
    return SpaceBlade(model, omega / blade.frequency_scale)


def rotating_blade(blade: Blade, omega: float, model: Any) -> Any:
    """Return the blade in steady rotation at ω [rad/s], in its plane or in space as the model."""
    return (space_rotation if model.in_space else steady_rotation)(blade, omega, model)
