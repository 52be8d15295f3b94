"""The blade in space in steady rotation: its steady state, followed in the speed from rest."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...arrays import FloatArray
from ...beam import AnyBlade, require_blade, require_steady_state, warn_if_rpm
from ...input_checks import points_of_beam, rotation_speed
from ...methods.system import Tangent
from ...settled import refined, settled
from ...theory import BERNOULLI_EULER, Theory, require_theory
from ...threads import one_thread
from ..beam.steady import AtConstantRate
from .basis import StrainFunctions
from .continuum import SpaceContinuum
from .unit import space_unit

FUNCTIONS = 12
"""Functions for each curvature of bending, at least, on a blade without point masses."""
MOST_FUNCTIONS = 80
"""Functions for each curvature of bending, at most."""
_SETTLED = 1e-9  # change of the steady state, over the length
_LONGEST = 1.0  # step of w̄ from one state to the next: beyond, Newton's method may leave the branch
_SHORTEST = 1e-3
_STEPS, _EXACT = 12, 1e-12  # of Newton's method, and its last change over the size of the state


def space_continuum(beam: AnyBlade, theory: Theory, functions: int) -> SpaceContinuum:
    """Return the discretization by at least so many functions for each curvature.

    Raises
    ------
    ValueError
        If the stiffness out of the plane, or in torsion, is not known.
    """
    require_section(beam)
    require_theory(theory)
    unit = space_unit(beam)
    a_panel = max(4, math.ceil(functions / unit.panel_count))
    return SpaceContinuum(
        StrainFunctions(
            blade=unit,
            theory=theory,
            slenderness=beam.slenderness,
            bending=a_panel,
            torsion=a_panel,
            axial=max(4, 5 * a_panel // 8),
        )
    )


def lives_in_space(beam: AnyBlade) -> bool:
    """Whether flap, lag and torsion of a blade go together.

    A setting angle mixes them where the stiffness out of the plane and in torsion is known.
    """
    require_blade(beam)
    blade = beam.blade
    known = blade.section.out_of_plane
    turned = blade.setting_angle != 0.0 and known is not None and known.torsion_ratio is not None
    return turned or not blade.is_planar


def require_section(beam: AnyBlade) -> None:
    """Refuse a blade whose stiffness out of the plane or in torsion is not known."""
    known = beam.blade.section.out_of_plane
    if known is None or known.torsion_ratio is None:
        raise ValueError(
            "a blade with twist, precone, prebend, sweep, offsets or a setting angle bends out of "
            "its plane and twists: give its stiffness there by "
            "blade.with_section_out_of_plane(bending_ratio, torsion_ratio), math.inf for a section "
            "that does not twist"
        )


@dataclass(frozen=True, eq=False)
class SpaceBlade(AtConstantRate):
    """The blade in a frame that turns at a constant rate; a `methods.System`.

    Attributes
    ----------
    model : SpaceContinuum
    rate : float
        w̄ = ω/√(EI3/mL³).
    direction : tuple
        Direction of the gauge, the tip's place from the steady state, in the root frame.
    near : ndarray (n,), optional
        Coordinates from which the steady state is found; from rest by default.
    """

    model: SpaceContinuum
    rate: float
    direction: tuple[float, float, float] = (0.0, 1.0, 0.0)
    near: FloatArray | None = None

    @property
    def odd(self) -> NDArray[np.bool_] | None:
        """True for coordinates that time reversal turns around, (n,); None without a reversal.

        Nor where the gauge is not among them: of blades with precone the lag is, flap is not.
        """
        if self.direction[2] and not self.model.functions.blade.half_turn:
            return None
        return self.model.functions.odd

    @property
    def pinned(self) -> int:
        """The first coordinate of the gauge's curvature."""
        return 1 if self.direction[2] else 0

    @cached_property
    def equilibrium(self) -> FloatArray:
        """Coordinates (n,) of the steady state.

        Raises
        ------
        ValueError
            If it ends, or becomes unstable, at a lower speed.
        """
        found = None if self.near is None else _newton(self.model, self.near, self.rate)
        if found is not None:
            return found
        unit = self.model.functions.blade
        # A straight blade stays straight, and nothing is to be followed.
        rate = self.rate if unit.half_turn and unit.mirrored else 0.0
        q, reached, step = np.zeros(self.size), 0.0, min(_LONGEST, self.rate or _LONGEST)
        while True:
            found = _newton(self.model, q, rate)
            if found is not None:
                q = found
                if rate >= self.rate:
                    return q
                reached, step = rate, min(1.5 * step, _LONGEST)
            elif rate == 0.0 or step < _SHORTEST:
                raise ValueError(
                    f"the steady state ends or becomes unstable at w_bar = {rate:.4g}, before "
                    f"w_bar = {self.rate:.4g}: rotate slower"
                )
            else:
                step *= 0.5
            rate = min(reached + step, self.rate)

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
        finer = self.model.refined()
        near = self.model.padded(self.equilibrium, finer)
        return replace(self, model=finer, near=near)

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
    """Yield a blade on more and more functions, up to the most that are taken."""
    return refined(first, SpaceBlade.refined, lambda one: one.functions > MOST_FUNCTIONS)


def _newton(model: SpaceContinuum, q: FloatArray, rate: float) -> FloatArray | None:
    """Return the steady state near `q` (n,); None if it is not found, or unstable."""
    still = np.zeros((1, model.size))
    for _ in range(_STEPS):
        tangent = model.tangent(q[None], still, still, rate)
        change = np.linalg.solve(tangent.stiffness[0], tangent.residual[0])
        q = q - change
        if np.linalg.norm(change) <= _EXACT * max(float(np.linalg.norm(q)), _EXACT):
            stable = np.linalg.eigvalsh(tangent.stiffness[0])[0] > 0.0
            return q if stable else None
    return None


def space_rotation(beam: AnyBlade, omega: float, model: SpaceContinuum) -> SpaceBlade:
    """Return the blade in steady rotation at ω [rad/s], refusing a speed that tears it."""
    if model.functions.theory.extension:
        require_steady_state(beam, omega)
    return SpaceBlade(model, omega / beam.frequency_scale)


@dataclass(frozen=True, kw_only=True)
class SteadyState:
    """The steady state of a blade in rotation; made by `steady_state`.

    Attributes
    ----------
    blade : Beam or Blade
    omega : float
        Rotation speed ω [rad/s].
    theory : Theory
    tip : ndarray (3,)
        Place of the tip from the clamp [m]: along the clamp, in the direction of rotation, and
        normal to both, up; the precone tilts the first and the last.
    error : float
        Its change over the length by the last refinement.
    """

    blade: AnyBlade
    omega: float
    theory: Theory
    tip: FloatArray
    error: float
    _steady: SpaceBlade

    def axis(self, x: ArrayLike) -> FloatArray:
        """Return the places of the points `x` [m] of the line, as `tip`, (points, 3)."""
        at = points_of_beam("x", x, self.blade.length)
        return np.asarray(
            self.blade.length * self._steady.model.axis(self._steady.equilibrium[None], at)[0]
        )


@one_thread
def steady_state(blade: AnyBlade, omega: float, *, theory: Theory = BERNOULLI_EULER) -> SteadyState:
    """Return the steady state of a blade in rotation, straight, bent or twisted.

    Followed from rest in steps of the speed; functions are added until the tip settles.

    Parameters
    ----------
    blade : Blade
        With the stiffness of its section out of the plane.
    omega : float
        Rotation speed ω [rad/s].
    theory : Theory
        Extension, shear, rotary inertia, trapeze effect.

    Raises
    ------
    ValueError
        If the section out of the plane is not known, or the state ends or becomes unstable at a
        lower speed.

    Examples
    --------
    >>> from analytic import Beam, steady_state
    >>> blade = Beam.reference().with_section_out_of_plane(0.0625, 0.08).with_precone(0.1)
    >>> print(steady_state(blade, omega=6.0).tip[[0, 2]].round(4))
    [ 7.9632 -0.7596]
    """
    omega = rotation_speed(omega)
    warn_if_rpm(blade, omega)
    first = space_rotation(blade, omega, space_continuum(blade, theory, FUNCTIONS))
    _, steady, error = settled(lambda one: one, finer_blades(first), _SETTLED, lambda one: one.tip)
    if error > _SETTLED:
        raise ValueError(
            f"the steady state at omega = {omega:g} rad/s has not settled with "
            f"{steady.functions} functions: the last refinement moves the tip by {error:.1e} "
            "L; rotate slower"
        )
    return SteadyState(
        blade=blade, omega=omega, theory=theory, tip=blade.length * steady.tip, error=error,
        _steady=steady,
    )  # fmt: skip
