"""The least amplitude that leaves the plane, and what to say of results that do."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from ..beam import AnyBlade, require_blade, require_undamped
from ..blade import Blade
from ..input_checks import flag, peak_deflection, rotation_speed, whole_number
from ..methods.harmonic_balance import NoOrbitError
from .branch import AmplitudeNotReachedError, branch_of
from .growth import STEPS, Growth, grown, settled_functions
from .modes import resolved_model
from .space import out_of_plane_of, require_out_of_plane
from .steady import BeamOrbit

_SCANNED = (0.02, 0.035, 0.05, 0.08, *np.arange(0.1, 0.95, 0.05).round(2).tolist())
LARGEST = 0.6
"""Peak |q|/L up to which is looked unless told."""
_FUNCTIONS = 16  # for the orbits' angle, as in `periodic_orbits`
_BISECTED = 1e-4  # of |q|/L
_CONVERGED = 0.01  # of the limit, as half as many functions and steps again tell it

_GrowthAt = Callable[[float, int], Growth]


@dataclass(frozen=True, kw_only=True)
class StabilityLimit:
    """The least amplitude at which the planar orbits leave their plane; see `stability_limit`.

    Attributes
    ----------
    blade : Blade
    omega : float
        Rotation speed ω [rad/s].
    mode : int
        Planar mode from which the orbits grow, from 1.
    amplitude : float
        Peak |q|/L; infinite where all orbits up to `searched` stay in the plane.
    searched : float
        Largest |q|/L that was looked at.
    kind : str
        How the motion grows there, as in `PlanarStability`.
    modes : tuple of str
        What grows there.
    converged : bool
        Whether half as many functions and steps again tell the limit within 1 %.
    """

    blade: AnyBlade
    omega: float
    mode: int
    amplitude: float
    searched: float
    kind: str
    modes: tuple[str, ...]
    converged: bool

    def __float__(self) -> float:
        return self.amplitude

    def __str__(self) -> str:
        if math.isinf(self.amplitude):
            return (
                f"At {self.omega:g} rad/s the planar orbits of this section stay in their plane, "
                f"up to a = {self.searched:g}"
            )
        doubt = "" if self.converged else ", not converged"
        return (
            f"At {self.omega:g} rad/s the planar orbits of this section leave their plane from "
            f"a = {self.amplitude:.4g} on{doubt}: {self.kind} of {' and '.join(self.modes)}"
        )


def stability_limit(
    blade: AnyBlade,
    omega: float,
    mode: int = 1,
    *,
    largest: float = LARGEST,
    inextensible: bool = False,
) -> StabilityLimit:
    """Return the least amplitude at which the planar orbits of a blade leave their plane.

    Amplitudes 0.02, 0.035, 0.05, 0.08, 0.1, 0.15 ... are looked at, and the step between the last
    stable and the first unstable one is bisected: a resonance that is narrower than a step may be
    passed over, and beyond the limit orbits may be stable again.

    Parameters
    ----------
    blade : Blade
        With a section out of the plane.
    omega : float
        Rotation speed ω [rad/s].
    mode : int
        In-plane mode from which the orbits grow, from 1.
    largest : float
        Largest |q|/L to look at.
    inextensible : bool
        Leave the extension of the orbits out.

    Raises
    ------
    ValueError
        If the section out of the plane is unknown, or its torsion where that decides.
    AmplitudeNotReachedError
        If no orbit grows out of the mode at all.

    Examples
    --------
    >>> from analytic import Beam, stability_limit
    >>> round(stability_limit(Beam.reference().rectangle(), omega=4.0).amplitude, 4)
    0.0545
    """
    require_out_of_plane(blade)
    require_undamped(blade, "a damped blade has no free periodic orbits")
    omega, mode = rotation_speed(omega), whole_number("mode", mode)
    largest = peak_deflection("largest", largest)
    return _limit(blade, omega, mode, largest, flag("inextensible", inextensible))


@lru_cache(maxsize=256)
def _limit(
    blade: AnyBlade, omega: float, mode: int, largest: float, inextensible: bool
) -> StabilityLimit:
    growth = _growths(blade, omega, mode, inextensible)
    stable, unstable = _bracket(growth, largest)
    amplitude, what, agreed = math.inf, None, True
    if math.isfinite(unstable):
        amplitude = _bisected(growth, stable, unstable) if stable else unstable
        what = growth(amplitude, 2)
        agreed = growth(min((1.0 + _CONVERGED) * amplitude, unstable), 3).unstable
        agreed = agreed and not growth((1.0 - _CONVERGED) * amplitude, 3).unstable
    return StabilityLimit(
        blade=blade, omega=omega, mode=mode, amplitude=amplitude,
        searched=unstable if what else stable, kind=what.kind if what else "",
        modes=what.modes if what else (), converged=agreed,
    )  # fmt: skip


def _bracket(growth: _GrowthAt, largest: float) -> tuple[float, float]:
    """Return the last stable and the first unstable one of the amplitudes that are looked at.

    Zero and the first where that is unstable; infinite where none is that exists.
    """
    stable = 0.0
    for a in [*(a for a in _SCANNED if a < largest), largest]:
        ends = a == largest or not stable
        try:
            # What the first resolution finds, the finer one confirms.
            if (ends or growth(a, 1).unstable) and growth(a, 2).unstable:
                return stable, a
        except NoOrbitError:
            if not stable:
                raise
            break
        stable = a
    return stable, math.inf


def _bisected(growth: _GrowthAt, low: float, high: float) -> float:
    while high - low > _BISECTED:
        middle = 0.5 * (low + high)
        low, high = (low, middle) if growth(middle, 2).unstable else (middle, high)
    return high


@lru_cache(maxsize=32)
def _growths(blade: AnyBlade, omega: float, mode: int, inextensible: bool) -> _GrowthAt:
    """Return what grows about an orbit, by its amplitude and the multiple of the resolution."""
    orbit = planar_orbits(blade, omega, mode, inextensible)

    @lru_cache(maxsize=256)
    def growth(amplitude: float, finer: int) -> Growth:
        at = orbit(amplitude)
        functions = settled_functions(blade, at.system)
        return grown(blade, at, finer * functions, finer * STEPS)

    return growth


def planar_orbits(
    blade: AnyBlade, omega: float, mode: int, inextensible: bool = False
) -> Callable[[float], BeamOrbit]:
    """Return what finds the planar orbits of a mode by their amplitude, each once.

    Sections that differ out of the plane share them.
    """
    if isinstance(blade, Blade):
        blade = replace(blade, section=replace(blade.section, out_of_plane=None))
    return _orbits(blade, omega, mode, inextensible)


@lru_cache(maxsize=32)
def _orbits(
    blade: AnyBlade, omega: float, mode: int, inextensible: bool
) -> Callable[[float], BeamOrbit]:
    model = resolved_model(blade, mode, inextensible, False, max(_FUNCTIONS, 2 * mode))
    return lru_cache(maxsize=128)(branch_of(blade, omega, mode, model).path.at)


def planar_note(blade: AnyBlade, omega: float, amplitude: float, mode: int = 1) -> str:
    """Return one sentence if a planar motion of that amplitude leaves its plane, "" if not.

    It leaves where an orbit of that amplitude does, or a smaller one of those that
    `stability_limit` looks at; that function tells from where on, which takes several times as
    long. "" too of a blade of which nothing is known out of its plane, or that is damped.

    Parameters
    ----------
    blade : Beam or Blade
    omega : float
        Rotation speed ω [rad/s].
    amplitude : float
        Peak |q|/L of the motion, about that of an orbit of `mode`.
    mode : int

    Examples
    --------
    >>> from analytic import Beam, planar_note
    >>> planar_note(Beam.reference().rectangle(), 4.0, amplitude=0.05)
    ''
    """
    require_blade(blade)
    unit = blade.unit
    if out_of_plane_of(blade) is None or unit.setting != 1.0 or any(unit.damping):
        return ""
    if not 0.0 < amplitude < 1.0:
        return ""
    omega, amplitude = rotation_speed(omega), float(amplitude)
    try:
        growth = _growths(blade, omega, mode, False)
        _, unstable = _bracket(growth, amplitude)
    except ValueError as unknown:
        return f"whether this motion stays in its plane is not known: {unknown}"
    except (AmplitudeNotReachedError, NoOrbitError):
        return ""
    if math.isinf(unstable):
        return ""
    what = growth(unstable, 2)
    return (
        f"this section does not stay in the plane: at {omega:g} rad/s the planar orbit of "
        f"a = {unstable:.3g} is unstable out of it ({what.kind} of {' and '.join(what.modes)}), "
        f"and this one has a = {amplitude:.3g}"
    )
