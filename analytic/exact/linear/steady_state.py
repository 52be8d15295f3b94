"""The steady state of a blade, in rotation or under a load at its tip, and states near it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import ArrayLike

from ...arrays import FloatArray
from ...blade import Blade
from ...blade_checks import warn_if_rpm
from ...input_checks import finite_number, points_of_beam, rotation_speed
from ...loads import Gravity, Load, PointLoad, loads_at_once
from ...settled import require_tolerance, settled
from ...theory import BERNOULLI_EULER, Theory
from ...threads import one_thread
from ..continuum.discretization import FUNCTIONS, continuum_of, space_continuum
from ..continuum.loading import unit_load
from ..continuum.rotation import SteadyBlade, finer_blades, rotating_blade
from ..continuum.state import BladeState, SectionLoads, flap_of_kick, in_newtons, state_of


@dataclass(frozen=True, kw_only=True)
class SteadyState:
    """The steady state of a blade in rotation; made by `steady_state`.

    Attributes
    ----------
    blade, omega, theory, force, moment, gravity, loads : as given
    tip : ndarray (3,)
        Place of the tip from the clamp [m]: along the clamp, in the direction of rotation, and
        normal to both, up; the precone tilts the first and the last.
    twist : float
        How far the load turns the tip's section out of its upright [rad], as of `SpinUpResponse`.
    error : float
        Its change over the length by the last refinement.
    steady : SteadyBlade
        Its discretization.
    """

    blade: Blade
    omega: float
    theory: Theory
    force: tuple[float, ...]
    moment: tuple[float, ...]
    gravity: float
    loads: tuple[Load, ...]
    tip: FloatArray
    twist: float
    error: float
    steady: SteadyBlade = field(repr=False)

    @property
    def acting(self) -> tuple[Load, ...]:
        """All loads: those given, then force and moment, then gravity."""
        return _acting(self.loads, PointLoad(force=self.force, moment=self.moment), self.gravity)

    def axis(self, x: ArrayLike) -> FloatArray:
        """Return the places of the points `x` [m] of the line, as `tip`, (points, 3)."""
        at = points_of_beam("x", x, self.blade.length)
        return np.asarray(
            self.blade.length * self.steady.model.places(self.steady.equilibrium[None], at)[0]
        )

    def state(self, x: ArrayLike) -> BladeState:
        """Return the state at the material points `x` [m], to start a motion from."""
        q = self.steady.equilibrium
        return state_of(self.blade, self.steady.model, q, 0.0 * q, x)

    def section_loads(self, x: ArrayLike) -> SectionLoads:
        """Return the sections at `x` [m], and force and moment in them, each (points, 3)."""
        at = points_of_beam("x", x, self.blade.length)
        state = self.steady.equilibrium[None]
        still = np.zeros_like(state)
        (place,), (section,) = self.steady.model.standing(state, at)
        (force,), (moment,) = self.steady.section_loads(at, state, still, still)
        standing, loads = (place, section), (force, moment)
        return in_newtons(self.blade, at, standing, loads, self.theory.trapeze)


@one_thread
def steady_state(
    blade: Blade,
    omega: float,
    *,
    force: ArrayLike = (0.0, 0.0, 0.0),
    moment: ArrayLike = (0.0, 0.0, 0.0),
    gravity: float = 0.0,
    loads: Sequence[Load] = (),
    theory: Theory = BERNOULLI_EULER,
    tolerance: float | None = None,
) -> SteadyState:
    """Return the steady state of a blade in rotation, under loads.

    Speed and load are raised from zero together, at once where Newton's method is sure to stay on
    the branch, otherwise in steps; functions are added until the tip settles.

    Parameters
    ----------
    blade : Blade
        With the stiffness of its section out of the plane.
    omega : float
        Rotation speed ω [rad/s].
    force, moment : array_like (3,)
        On the tip [N], [N m]; in the root frame, as `tip`, they keep their directions.
    gravity : float
        g [m/s²], where the axis of rotation points up, as ``Gravity(g, tilt=math.pi / 2)`` has it.
    loads : sequence of loads
        More of them, each as it is at t = 0 and stays in the turning frame.
    theory : Theory
        Extension, shear, rotary inertia, trapeze effect.
    tolerance : float, optional
        Largest change of the tip's place over the length by the last refinement; by default 1e-9,
        of a blade from stations 1e-6. Short of it a warning comes with the answer.

    Raises
    ------
    ValueError
        If the section out of the plane is not known, or the state ends or becomes unstable at a
        lower speed or load, or is not reached in 60 steps, or the tip is not known to 1e-3.

    Examples
    --------
    >>> from analytic import Beam, steady_state
    >>> blade = Beam.reference().with_section_out_of_plane(0.0625, 0.08).with_precone(0.1)
    >>> print(steady_state(blade, omega=6.0).tip[[0, 2]].round(4))
    [ 7.9632 -0.7596]
    """
    omega = rotation_speed(omega)
    warn_if_rpm(blade, omega)
    pull = PointLoad(force=force, moment=moment)
    gravity, loads = finite_number("gravity", gravity, "m/s^2"), loads_at_once(loads)
    acting = _acting(loads, pull, gravity)
    first = rotating_blade(
        blade, omega, space_continuum(blade, theory, FUNCTIONS, acting),
        loads=tuple(unit_load(blade, load) for load in acting),
    )  # fmt: skip
    _, steady, error = settled(
        lambda one: one,
        finer_blades(first),
        require_tolerance(tolerance, first.model.tolerance),
        lambda one: one.tip,
        f"the tip's place over the length at omega = {omega:g} rad/s",
        "rotate slower, or load it less",
    )
    return SteadyState(
        blade=blade, omega=omega, theory=theory, force=pull.force, moment=pull.moment,
        gravity=gravity, loads=loads, tip=blade.length * steady.tip, error=error, steady=steady,
        twist=float(steady.model.tip_turn(steady.equilibrium[None])[0]),
    )  # fmt: skip


def _acting(loads: Sequence[Load], pull: PointLoad, gravity: float) -> tuple[Load, ...]:
    weight = [Gravity(gravity, tilt=0.5 * math.pi)] * bool(gravity)
    return (*loads, *[pull] * bool(pull.size), *weight)


def stretched_state(blade: Blade, omega: float, x: ArrayLike) -> BladeState:
    """Return the state at `x` [m] of a blade that turns at `omega` [rad/s] and does not swing."""
    model = continuum_of(blade, BERNOULLI_EULER, 20, FUNCTIONS, axial=10)
    steady = rotating_blade(blade, omega, model)
    return state_of(blade, model, steady.equilibrium, np.zeros(steady.size), x)


def kicked_state(blade: Blade, speed: float, x: ArrayLike) -> BladeState:
    """Return the state at `x` [m] of a straight blade whose tip is kicked out of the plane."""
    start = stretched_state(blade, 0.0, x)
    along, up = np.asarray(x) / blade.length, np.eye(3)[2]
    tilting = np.multiply.outer(speed / blade.length * flap_of_kick(along, 1), up)
    return replace(
        start, velocity=np.multiply.outer(speed * flap_of_kick(along), up), slope_rate=tilting,
        spin=np.cross(start.slope, tilting),
    )  # fmt: skip
