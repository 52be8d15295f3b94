"""The units in which Exudyn solves: the beam's own, so that no tolerance knows SI.

Length L and mass m of the beam are one, and time is counted in steps of a power of two near
√(mL³/EI), the time of Eq. 40. Any beam, from a reed to a blade, then gives the same numbers, and
sums of steps are exact.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, fields, replace
from types import SimpleNamespace
from typing import cast

from analytic import Blade
from analytic.exact.continuum.state import BeamState
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

    def state(self, state: BeamState) -> BeamState:
        """Return the state in these units; slopes and angles have none."""
        units = dict.fromkeys("uvw", self.length)
        for field in fields(state):
            if field.name.endswith("_dot"):
                units[field.name] = units.get(field.name.removesuffix("_dot"), 1.0) / self.time
        return replace(
            state, **{name: value / units.get(name, 1.0) for name, value in vars(state).items()}
        )


def restated(rotation: Rotation, unit: float = 1.0, azimuth: float = 0.0) -> Rotation:
    """Return a rotation whose time is counted in units of `unit` [s], from another angle on."""
    found = SimpleNamespace(
        angle=lambda t: azimuth + rotation.angle(unit * t),
        rate=lambda t: unit * rotation.rate(unit * t),
        acceleration=lambda t: unit**2 * rotation.acceleration(unit * t),
    )
    return cast(Rotation, found)
