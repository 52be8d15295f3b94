"""The least amplitude that leaves the plane, over speed and shape, and what to say of results."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import FloatArray
from ..beam import AnyBlade, require_undamped
from ..blade import Blade
from ..input_checks import finite_values, positive, rotation_speed, whole_number
from ..methods.harmonic_balance import NoOrbitError
from ..out_of_plane import OutOfPlane
from .branch import AmplitudeNotReachedError, branch_of
from .growth import STEPS, grown, settled_functions
from .modes import resolved_model
from .space import out_of_plane_of, require_out_of_plane
from .steady import BeamOrbit

_SCANNED = (0.02, 0.035, 0.05, 0.08, *np.arange(0.1, 0.95, 0.05).round(2).tolist())
_LARGEST = 0.6
_FUNCTIONS = 16  # for the orbits' angle, as in `periodic_orbits`
_BISECTED = 1e-4  # of |q|/L
_CONVERGED = 0.01  # of the limit, as half as many functions and steps again tell it


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
    largest: float = _LARGEST,
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
    largest = positive("largest", largest)
    if largest >= 1.0:
        raise ValueError(f"largest must be below 1, a share of the length, got {largest:g}")
    return _limit(blade, omega, mode, largest, inextensible)


@lru_cache(maxsize=256)
def _limit(
    blade: AnyBlade, omega: float, mode: int, largest: float, inextensible: bool
) -> StabilityLimit:
    orbit = _orbits(_in_plane(blade), omega, mode, inextensible)
    seen = [a for a in _SCANNED if a < largest] + [largest]
    functions = settled_functions(blade, orbit(seen[0]).system)

    def unstable(a: float, finer: int = 2) -> bool:
        return grown(blade, orbit(a), finer * functions, finer * STEPS).unstable

    def found(amplitude: float, searched: float) -> StabilityLimit:
        what, agreed = None, True
        if math.isfinite(amplitude):
            what = grown(blade, orbit(amplitude), 2 * functions, 2 * STEPS)
            agreed = unstable(min((1.0 + _CONVERGED) * amplitude, searched), finer=3)
            agreed = agreed and not unstable((1.0 - _CONVERGED) * amplitude, finer=3)
        return StabilityLimit(
            blade=blade, omega=omega, mode=mode, amplitude=amplitude, searched=searched,
            kind=what.kind if what else "", modes=what.modes if what else (), converged=agreed,
        )  # fmt: skip

    if unstable(seen[0]):
        return found(seen[0], seen[0])
    for low, high in pairwise(seen):
        try:
            growing = unstable(high, finer=1) or (high == largest and unstable(high))
        except NoOrbitError:
            return found(math.inf, low)
        if growing and unstable(high):  # the first that the finer resolution confirms
            return found(_bisected(unstable, low, high), high)
    return found(math.inf, largest)


def _bisected(unstable: Callable[[float], bool], low: float, high: float) -> float:
    while high - low > _BISECTED:
        middle = 0.5 * (low + high)
        low, high = (low, middle) if unstable(middle) else (middle, high)
    return high


def _in_plane(blade: AnyBlade) -> AnyBlade:
    """Return what of the blade its planar orbits depend on, so that sections share them."""
    if isinstance(blade, Blade):
        return replace(blade, section=replace(blade.section, out_of_plane=None))
    return blade


@lru_cache(maxsize=32)
def _orbits(
    blade: AnyBlade, omega: float, mode: int, inextensible: bool
) -> Callable[[float], BeamOrbit]:
    """Return what finds the planar orbits of a mode, each once."""
    model = resolved_model(blade, mode, inextensible, False, _FUNCTIONS)
    return lru_cache(maxsize=128)(branch_of(blade, omega, mode, model).path.at)


def growth_map(
    blade: AnyBlade, omegas: ArrayLike, amplitudes: ArrayLike, mode: int = 1
) -> FloatArray:
    """Return the growth rates [1/s] out of the plane, (speeds, amplitudes), zero where stable.

    On as many functions and steps as `planar_stability` begins with; NaN where no orbit was found.

    Parameters
    ----------
    blade : Blade
        With a section out of the plane.
    omegas, amplitudes : array_like
        Rotation speeds [rad/s] and peak tip deflections |q|/L.
    mode : int
        In-plane mode from which the orbits grow, from 1.

    Examples
    --------
    >>> from analytic import Beam, growth_map
    >>> print(growth_map(Beam.reference().rectangle(), [4.0], [0.02, 0.1]).round(2))
    [[ 0.   33.67]]
    """
    require_out_of_plane(blade)
    speeds = finite_values("omegas", omegas, "rad/s")
    peaks = finite_values("amplitudes", amplitudes)
    rates = np.full((speeds.size, peaks.size), np.nan)
    for row, omega in zip(rates, speeds.tolist(), strict=True):
        orbit = _orbits(_in_plane(blade), rotation_speed(omega, "omegas"), mode, False)
        for k, a in enumerate(peaks.tolist()):
            try:
                at = orbit(a)
            except NoOrbitError:
                break
            functions = settled_functions(blade, at.system)
            rate = at.frequency * blade.frequency_scale
            row[k] = grown(blade, at, functions, STEPS).rate(rate)
    return rates


def limit_map(
    blade: AnyBlade, ratios: ArrayLike, omegas: ArrayLike, mode: int = 1, largest: float = _LARGEST
) -> FloatArray:
    """Return the least unstable amplitudes of rectangles, (ratios, speeds); infinite: none.

    The blade keeps its EA, EI and m: material and size follow the ratio.

    Parameters
    ----------
    blade : Beam or Blade
    ratios : array_like
        Height in the plane over width.
    omegas : array_like
        Rotation speeds [rad/s].
    mode, largest
        As for `stability_limit`.

    Examples
    --------
    >>> from analytic import Beam, limit_map
    >>> print(limit_map(Beam.reference(), ratios=[1.0], omegas=[4.0], largest=0.03))
    [[inf]]
    """
    shapes = [OutOfPlane.rectangle(ratio) for ratio in finite_values("ratios", ratios).tolist()]
    speeds = finite_values("omegas", omegas, "rad/s").tolist()
    return np.array(
        [
            [
                stability_limit(blade.with_out_of_plane(shape), w, mode, largest=largest).amplitude
                for w in speeds
            ]
            for shape in shapes
        ]
    )


def planar_note(blade: AnyBlade, omega: float, amplitude: float, mode: int = 1) -> str:
    """Return one sentence if a planar motion of that amplitude leaves its plane, "" if not.

    "" too of a blade of which nothing is known out of its plane, or that is damped.

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
    unit = blade.unit
    if out_of_plane_of(blade) is None or unit.setting != 1.0 or any(unit.damping):
        return ""
    if not 0.0 < amplitude < 1.0:
        return ""
    try:
        largest = max(_LARGEST, math.ceil(20.0 * amplitude) / 20.0 - 0.01)  # few, to be kept
        limit = stability_limit(blade, omega, mode, largest=largest)
    except ValueError as unknown:
        return f"whether this motion stays in its plane is not known: {unknown}"
    except (AmplitudeNotReachedError, NoOrbitError):
        return ""
    if amplitude < limit.amplitude:
        return ""
    return (
        f"this section does not stay in the plane: at {omega:g} rad/s planar orbits are unstable "
        f"out of it from a = {limit.amplitude:.3g} on ({limit.kind} of "
        f"{' and '.join(limit.modes)}), and this one has a = {amplitude:.3g}"
    )
