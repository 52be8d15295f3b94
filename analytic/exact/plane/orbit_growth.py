"""Growth out of the plane about planar orbits, by amplitude, and the sentence on it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ...arrays import FloatArray
from ...beam import AnyBlade, require_blade
from ...input_checks import rotation_speed
from ...methods.newton import NoOrbitError
from ...theory import BERNOULLI_EULER, Theory
from ...threads import one_thread
from ..beam.space import require_out_of_plane
from ..free.branch import AmplitudeNotReachedError
from ..free.path import ModePath
from ..linear.modes import resolved_model
from .growth import STEPS, Growth, grown, settled_functions

LEAST_GROWTH = 0.01
"""Growth per radian of the orbit that counts unless told."""
SMALLEST = 0.01
"""Peak |q|/L of the smallest orbits that are looked at."""
_SCANNED = (0.02, 0.035, 0.05, 0.08, *np.arange(0.1, 0.95, 0.05).round(2).tolist())
_FUNCTIONS = 16  # for the orbits' angle, as in `periodic_orbits`


@dataclass(frozen=True, kw_only=True, eq=False)
class PlanarOrbits:
    """Planar orbits of a blade, by their amplitude, and what grows out of their plane."""

    blade: AnyBlade
    of: ModePath

    @cached_property
    def functions(self) -> int:
        """How many settle the flap modes."""
        return settled_functions(self.blade, self.of.path.at(SMALLEST).system)

    def growth(self, amplitude: float, finer: int = 1) -> Growth:
        """Return what grows about an orbit, at a multiple of the resolution."""
        orbit = self.of.path.at(amplitude)
        return grown(self.blade, orbit, finer * self.functions, finer * STEPS)


def planar_orbits(
    blade: AnyBlade, omega: float, mode: int = 1, theory: Theory = BERNOULLI_EULER
) -> PlanarOrbits:
    """Return the planar orbits of a mode at ω [rad/s]."""
    model = resolved_model(blade, mode, theory, _FUNCTIONS)
    of = ModePath(beam=blade, omega=omega, mode=mode, theory=theory, model=model)
    return PlanarOrbits(blade=blade, of=of)


@one_thread
def growth_rates(blade: AnyBlade, omega: float, amplitudes: FloatArray) -> FloatArray:
    """Return the growth rates [1/s] about orbits of the first mode, zero where stable.

    On as many functions and steps as `planar_stability` begins with, for maps; NaN from the first
    amplitude on that no orbit was found for.
    """
    require_out_of_plane(blade)
    orbits = planar_orbits(blade, rotation_speed(omega))
    rates = np.full(amplitudes.size, np.nan)
    for k, a in enumerate(amplitudes.tolist()):
        try:
            frequency = orbits.of.path.at(a).frequency
        except NoOrbitError:
            break
        rates[k] = orbits.growth(a).rate(frequency * blade.frequency_scale)
    return rates


def planar_note(blade: AnyBlade, omega: float, amplitude: float, mode: int = 1) -> str:
    """Return one sentence if a planar motion of that amplitude leaves its plane, "" if not.

    It leaves where an orbit of that amplitude, or a smaller one of the few that are looked at,
    grows out of it by 0.01 per radian; `stability_limit` tells from where on, which takes several
    times as long. "" too of a blade of which nothing is known out of its plane, or that is damped.

    Parameters
    ----------
    blade : Beam or Blade
    omega : float
        Rotation speed ω [rad/s].
    amplitude : float
        Peak |q|/L of the motion, about that of an orbit of `mode`.
    mode : int
    """
    require_blade(blade)
    unit = blade.unit
    if blade.section.out_of_plane is None or unit.setting != 1.0 or any(unit.damping):
        return ""
    if not 0.0 < amplitude < 1.0:
        return ""
    omega, amplitude = rotation_speed(omega), float(amplitude)
    try:
        orbits = planar_orbits(blade, omega, mode)
        for a in [*(a for a in _SCANNED if a < amplitude), amplitude]:
            # What the first resolution finds, the finer one confirms.
            told = a == amplitude or orbits.growth(a).per_radian >= LEAST_GROWTH
            if told and (what := orbits.growth(a, 2)).per_radian >= LEAST_GROWTH:
                return (
                    f"this section does not stay in the plane: at {omega:g} rad/s the planar orbit "
                    f"of a = {a:.3g} leaves it by {what.per_radian:.2g} per radian ({what.kind} of "
                    f"{' and '.join(what.modes)}), and this one has a = {amplitude:.3g}"
                )
    except ValueError as unknown:
        return f"whether this motion stays in its plane is not known: {unknown}"
    except (AmplitudeNotReachedError, NoOrbitError):
        pass
    return ""
