"""The response of the exact beam to a spin-up, or another change of its speed."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ...arrays import FloatArray, few_at_once
from ...blade import Blade
from ...input_checks import points_of_beam
from ...loads import Load, rippled
from ...motion import SpeedChange, SteadyRotation
from ...theory import Theory
from ..continuum.state import BladeState, SectionLoads, in_newtons, state_of
from .start import Start
from .steps import Steps
from .transient import drive


@dataclass(frozen=True, kw_only=True)
class SpinUpResponse:
    """Response of the exact beam to a spin-up; made by `spin_up_response`.

    Attributes
    ----------
    blade, spin_up, loads, start, kick, bent, theory, tolerance : as given
    time : ndarray (times,)
        Times [s].
    q : ndarray (times,)
        Deflection of the tip across the turning line of the clamp, Eq. 16 [m]; it lags behind
        (q < 0) while the rotation speeds up. Of a blade in space its lag.
    q_dot : ndarray (times,)
        Its rate in the rotating frame, Eq. 16 [m/s].
    tip : ndarray (times, 3)
        Place of the tip from the clamp [m] in the frame that turns with it: along the clamp, in the
        direction of rotation (lag) and normal to both (flap).
    points : ndarray (points,)
        Material points asked for [m].
    axis : ndarray (times, points, 3)
        Their places, as that of the tip [m].
    twist : ndarray (times,)
        How far the load turns the tip's section out of its upright [rad]: arctan2(T32, T33) of the
        rotation T from the unloaded section to the loaded one, in the axes of `tip`.
    error : float
        Estimated error of the tip's position over the largest |q|, and of the twist: the difference
        from the next coarser solution in step and functions, hence an upper estimate.
    model, steps_taken : Continuum or SpaceContinuum, and Steps
        The discretization, and the accelerations at the nodes of all steps.
    steps, functions : int
        Steps of order 15 and functions for θ, or each curvature, of the solution returned.
    """

    blade: Blade
    spin_up: SpeedChange | SteadyRotation
    loads: tuple[Load, ...]
    start: Start
    kick: float
    bent: float
    theory: Theory
    tolerance: float
    time: FloatArray
    q: FloatArray = field(repr=False)
    q_dot: FloatArray = field(repr=False)
    tip: FloatArray = field(repr=False)
    points: FloatArray = field(repr=False)
    axis: FloatArray = field(repr=False)
    twist: FloatArray = field(repr=False)
    error: float
    steps: int
    functions: int
    model: Any = field(repr=False)
    steps_taken: Steps = field(repr=False)

    @cached_property
    def _state(self) -> FloatArray:
        """Coordinates, rates and accelerations at the times, (3, times, n)."""
        return self.steps_taken.at(self.time)

    @property
    def omega(self) -> float:
        """Speed after the ramp [rad/s]."""
        return self.spin_up.omega

    def section_loads(self, x: ArrayLike) -> SectionLoads:
        """Return the sections at `x` [m], and force and moment in them, over time."""
        at = points_of_beam("x", x, self.blade.length)
        driven_at = drive(self.blade, rippled(self.spin_up, self.loads), self.loads, self.model)
        model = self.model
        parts = [
            model.standing(self._state[0, few], at)
            + model.section_loads(at, *self._state[:, few], driven_at(self.time[few]))
            for few in few_at_once(self.time.size)
        ]
        place, section, force, moment = map(np.concatenate, zip(*parts, strict=True))
        standing, loads = (place, section), (force, moment)
        return in_newtons(self.blade, at, standing, loads, model.trapeze)

    def state(self, i: int, x: ArrayLike) -> BladeState:
        """Return the state at time `i` at the material points `x` [m], to start a motion from."""
        q, q_dot, _ = self._state[:, i]
        return state_of(self.blade, self.model, q, q_dot, x)

    @property
    def lag(self) -> FloatArray:
        """Place of the tip in the direction of rotation [m], (times,)."""
        return self.tip[:, 1]

    @property
    def flap(self) -> FloatArray:
        """Place of the tip normal to it and to the clamp [m], (times,)."""
        return self.tip[:, 2]

    @property
    def from_axis(self) -> FloatArray:
        """Places of the tip from the axis of rotation in the inertial frame [m], (times, 3)."""
        blade = self.blade
        c, s = math.cos(blade.line.precone), math.sin(blade.line.precone)
        along = c * (self.tip[:, 0] + blade.hub_radius) - s * self.tip[:, 2]
        up = s * self.tip[:, 0] + c * self.tip[:, 2]
        angle = rippled(self.spin_up, self.loads).angle(self.time)
        z = (along + 1j * self.tip[:, 1]) * np.exp(1j * angle)
        return np.stack((z.real, z.imag, up), axis=-1)
