"""Planar orbits by their amplitude, and the motion that grows out of their plane."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ...arrays import FloatArray
from ...blade import Blade
from ...blade_checks import require_out_of_plane, undamped
from ...input_checks import not_negative, rotation_speed
from ...methods.newton import NoOrbitError
from ...theory import BERNOULLI_EULER, Theory
from ...threads import one_thread
from ..continuum.planar_rotation import resolved_model
from ..linear.modes import mode_name
from ..stability.growth import GROWTH, STEPS, Growth, grown, settled_functions
from .path import ModePath

LEAST_GROWTH = 0.01
"""Growth per radian of an undamped orbit that counts."""
SMALLEST = 0.01
"""Peak |q|/L of the smallest orbits of a search."""
_FUNCTIONS = 16  # for the orbits' angle, as in `periodic_orbits`


@dataclass(frozen=True, kw_only=True, eq=False)
class PlanarOrbits(ModePath):
    """Planar orbits of a mode, by their amplitude, and the motion that grows out of their plane.

    The planar orbits are undamped; what leaves the plane has the damping of the `blade`, and the
    damping ratio `damping` of its modes.
    """

    damping: float

    @property
    def damped(self) -> bool:
        """Whether anything resists what leaves the plane."""
        return bool(self.damping) or bool(self.blade.damping)

    @property
    def least(self) -> float:
        """Growth per radian that counts: any, if it is damped."""
        return GROWTH / (2.0 * np.pi) if self.damped else LEAST_GROWTH

    @cached_property
    def functions(self) -> int:
        """Number of functions that settles the flap modes."""
        return settled_functions(self.blade, self.path.at(SMALLEST).system, self.theory)

    def growth(self, amplitude: float, finer: int = 1) -> Growth:
        """Return what grows about an orbit, at a multiple of the resolution."""
        orbit = self.path.at(amplitude)
        return grown(
            self.blade, orbit, finer * self.functions, finer * STEPS, self.theory, self.damping
        )


def planar_orbits(
    blade: Blade,
    omega: float,
    mode: str | int = "lag 1",
    theory: Theory = BERNOULLI_EULER,
    damping: float = 0.0,
) -> PlanarOrbits:
    """Return the planar orbits of a mode at ω [rad/s]."""
    free = undamped(blade)
    name = mode_name(free, omega, mode, theory)
    if not name.startswith("lag"):
        raise ValueError(f"planar orbits grow out of modes of lag, and mode is {name!r}: 'lag 1'")
    model = resolved_model(free, int(name.split()[1]), theory, _FUNCTIONS)
    return PlanarOrbits(
        blade=blade, omega=omega, mode=name, theory=theory, model=model,
        damping=not_negative("damping", damping),
    )  # fmt: skip


@one_thread
def growth_rates(
    blade: Blade, omega: float, amplitudes: FloatArray, damping: float = 0.0
) -> FloatArray:
    """Return the growth rates [1/s] about orbits of the first mode, zero where stable.

    With a damping ratio of the modes out of the plane, the least decay rates, below zero. On as
    many functions and steps as `out_of_plane` of orbits begins with, for maps; NaN from the first
    amplitude on that no orbit was found for.
    """
    require_out_of_plane(blade)
    orbits = planar_orbits(blade, rotation_speed(omega), damping=damping)
    rates = np.full(amplitudes.size, np.nan)
    for k, a in enumerate(amplitudes.tolist()):
        try:
            frequency = orbits.path.at(a).frequency * blade.frequency_scale
        except NoOrbitError:
            break
        now = orbits.growth(a)
        decays = damping and not now.unstable
        rates[k] = now.exponent * frequency / (2.0 * np.pi) if decays else now.rate(frequency)
    return rates
