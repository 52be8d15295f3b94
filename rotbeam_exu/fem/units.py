"""The units in which Exudyn solves: the beam's own, so that no tolerance knows SI.

Length L and mass m of the beam are one, and time is counted in steps of a power of two near
√(mL³/EI), the time of Eq. 40. Any beam, from a reed to a blade, then gives the same numbers, and
sums of steps are exact.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace
from types import SimpleNamespace
from typing import cast

from analytic import Blade
from analytic.exact.continuum.state import BladeState
from analytic.loads import Load
from analytic.motion import Rotation


@dataclass(frozen=True, kw_only=True)
class Units:
    """Units of length [m], mass [kg] and time [s]; those derived from them follow."""

    length: float
    mass: float
    time: float

    @classmethod
    def of(cls, blade: Blade, step: float | None = None) -> Units:
        """Return L, m and √(mL³/EI), or the nearest 2^k times a `step` [s]."""
        time = 1.0 / blade.frequency_scale
        if step is not None:
            time = math.ldexp(step, round(math.log2(time / step)))
        return cls(length=blade.length, mass=blade.mass, time=time)

    @property
    def velocity(self) -> float:
        """Unit of velocity [m/s]."""
        return self.length / self.time

    @property
    def energy(self) -> float:
        """Unit of energy [J]."""
        return self.mass * self.velocity**2

    def blade(self, blade: Blade) -> Blade:
        """Return the beam or blade in these units."""
        return blade.in_units(self.length, self.mass, self.time)

    def loads(self, loads: Iterable[Load]) -> tuple[Load, ...]:
        """Return the loads of a motion in time in these units."""
        return tuple(load.in_units(self.length, self.mass, self.time) for load in loads)

    def rotation(self, rotation: Rotation) -> Rotation:
        """Return the rotation over time in these units."""
        return restated(rotation, unit=self.time)

    def state(self, state: BladeState) -> BladeState:
        """Return the state in these units; slopes and sections have none."""
        return replace(
            state, place=state.place / self.length, velocity=state.velocity / self.velocity,
            slope_rate=self.time * state.slope_rate, spin=self.time * state.spin,
        )  # fmt: skip


def restated(rotation: Rotation, unit: float = 1.0, azimuth: float = 0.0) -> Rotation:
    """Return a rotation whose time is counted in units of `unit` [s], from another angle on."""
    motion = SimpleNamespace(
        angle=lambda t: azimuth + rotation.angle(unit * t),
        rate=lambda t: unit * rotation.rate(unit * t),
        acceleration=lambda t: unit**2 * rotation.acceleration(unit * t),
    )
    return cast(Rotation, motion)
