"""The amplitude from which on planar orbits leave their plane, and the tongues below it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import groupby

from ...blade import Blade
from ...blade_checks import require_out_of_plane
from ...input_checks import peak_deflection, rotation_speed
from ...methods.newton import NoOrbitError
from ...theory import BERNOULLI_EULER, Theory
from ...threads import one_thread
from ..stability.growth import GROWTH, Growth
from .planar_orbits import LEAST_GROWTH, SMALLEST, PlanarOrbits, planar_orbits

LARGEST = 0.6
"""Peak |q|/L up to which is searched by default."""
_NOTHING = 1e-3  # |q|/L from which is looked, if the smallest grows
_STEP, _FINE, _LONG = 0.02, 0.0025, 0.05  # of the amplitude, from one to the next
_STRONG = 10.0  # times the growth that counts, from which steps are long
_NEAR = 0.85  # of the limit, from where on steps are fine
_BISECTED = 1e-4  # of the limit
_CONVERGED = 0.01  # of the limit, as half as many functions and steps again tell it


@dataclass(frozen=True, kw_only=True)
class Tongue:
    """An interval of amplitudes below the limit whose orbits leave the plane in one way.

    Neighbors that grow in another way are another tongue: between them orbits may stay.

    Attributes
    ----------
    low, high : float
        Least and largest |q|/L that were seen to grow.
    growth : float
        Largest growth exponent over the orbit's frequency [1/rad].
    kind : str
    modes : tuple of str
        How the motion grows there and what, as in `GrowthOutOfPlane`.
    """

    low: float
    high: float
    growth: float
    kind: str
    modes: tuple[str, ...]


@dataclass(frozen=True, kw_only=True)
class StabilityLimit:
    """The amplitude from which on planar orbits leave their plane; see `stability_limit`.

    Attributes
    ----------
    blade, omega, mode, damping, theory : as given
    growth : float
        Growth exponent over the orbit's frequency [1/rad] that counts.
    amplitude : float
        Peak |q|/L above which all orbits, up to `searched`, leave the plane by at least `growth`;
        infinite where the largest orbit does not.
    searched : float
        Largest |q|/L that was looked at.
    kind : str
        How the motion grows at the limit, as in `GrowthOutOfPlane`.
    modes : tuple of str
        What grows there.
    tongues : tuple of Tongue
        Where smaller orbits leave the plane, however slowly, between others that stay.
    converged : bool
        Whether half as many functions and steps again give the limit within 1 %.
    """

    blade: Blade
    omega: float
    mode: str
    damping: float
    theory: Theory
    growth: float
    amplitude: float
    searched: float
    kind: str
    modes: tuple[str, ...]
    tongues: tuple[Tongue, ...]
    converged: bool

    def __str__(self) -> str:
        at = f"At {self.omega:g} rad/s the planar orbits of this section"
        if self.damping:
            at = f"{at}, damped out of the plane by {self.damping:g} of the critical,"
        grow = f"; growth at least {self.growth:g} per radian" if self.growth > GROWTH else ""
        limited = math.isfinite(self.amplitude)
        tongues = ""
        if self.tongues:
            count = "one tongue" if len(self.tongues) == 1 else f"{len(self.tongues)} tongues"
            most = max(self.tongues, key=lambda tongue: tongue.growth)
            tongues = (
                f"{count}{' below' if limited else ''} from a = {self.tongues[0].low:.4g} on, at "
                f"most {most.growth:.2g} per radian"
            )
        if not limited:
            return f"{at} stay in their plane, up to a = {self.searched:.4g}" + (
                f", but for {tongues}" if tongues else ""
            )
        doubt = "" if self.converged else ", not converged"
        return (
            f"{at} are unstable out of the plane for a between {self.amplitude:.4g} and "
            f"{self.searched:.4g} (the largest searched){grow}{doubt}: "
            f"{self.kind} of {' and '.join(self.modes)}" + (f"; {tongues}" if tongues else "")
        )


@one_thread
def stability_limit(
    blade: Blade,
    omega: float,
    mode: str | int = "lag 1",
    *,
    damping: float = 0.0,
    largest: float = LARGEST,
    theory: Theory = BERNOULLI_EULER,
) -> StabilityLimit:
    """Return the amplitude from which on the planar orbits of a blade leave their plane.

    From there up to `largest` all of them grow by at least 0.01 per radian of the orbit. A least
    unstable amplitude is no property of the blade: without damping, sum resonances of ever
    higher modes lie everywhere, ever narrower and slower. `tongues` are the resonances found below
    the limit. Amplitudes from 0.01 on are tried in steps of 2 %, or 5 % if the orbit grows ten
    times as fast, and of 0.25 % from 0.85 of the limit on. Narrower tongues may be missed.

    With damping of flap and torsion, the blade's own or a ratio, few tongues are left, and limits
    are properties of the blade: any growth counts, and the tongues' ends are bisected too. The
    planar orbits stay undamped, for free damped motion is not periodic.

    Parameters
    ----------
    blade : Blade
        With a section out of the plane, of setting angle zero.
    omega : float
        Rotation speed ω [rad/s].
    mode : str or int
        Mode of lag from which the orbits grow, as of `backbone`.
    damping : float
        Damping ratio ζ of every mode of flap and torsion of the straight blade in rotation.
    theory : Theory
        Of the orbits, without shear: slices do not shear out of the plane.
    largest : float
        Largest |q|/L to look at.

    Raises
    ------
    ValueError
        If the section out of the plane is unknown, or its torsion where that decides.
    AmplitudeNotReachedError
        If no orbit grows out of the mode at all.

    Examples
    --------
    >>> from analytic import Beam, Rectangle, stability_limit
    >>> strip = Beam.reference().with_shape(Rectangle())
    >>> limit = stability_limit(strip, omega=4.0, largest=0.1)
    >>> round(limit.amplitude, 3), round(limit.tongues[0].low, 3)
    (0.059, 0.052)
    """
    require_out_of_plane(blade, theory)
    orbits = planar_orbits(blade, rotation_speed(omega), mode, theory, damping)
    return _limit(orbits, orbits.least, peak_deflection("largest", largest))


def _limit(orbits: PlanarOrbits, least: float, largest: float) -> StabilityLimit:
    growths = _scanned(orbits, least, largest)
    searched = max(growths)
    amplitude, what, agreed = math.inf, None, True
    if (last := orbits.growth(searched, 2)).per_radian >= least:
        growths = _refined_near_limit(orbits, {**growths, searched: last}, least)
        low, high = _last_step(growths, least)
        amplitude = _bisected(orbits, low, high, least) if low else high
        what = orbits.growth(amplitude, 2)
        growths = {a: one for a, one in growths.items() if a < amplitude}
        beyond = min((1.0 + _CONVERGED) * amplitude, searched)
        below = [a for a in growths if growths[a].per_radian < least and a > _NEAR * amplitude]
        agreed = orbits.growth(beyond, 3).per_radian >= least
        agreed = agreed and orbits.growth(below[-1], 3).per_radian < least if below else False
    return StabilityLimit(
        blade=orbits.blade, omega=orbits.omega, mode=orbits.mode, damping=orbits.damping,
        theory=orbits.theory, growth=least, amplitude=amplitude, searched=searched,
        kind=what.kind if what else "", modes=what.modes if what else (),
        tongues=_tongues(orbits, growths, amplitude), converged=agreed,
    )  # fmt: skip


def _scanned(orbits: PlanarOrbits, least: float, largest: float) -> dict[float, Growth]:
    """Return what grows at amplitudes up to the largest that exists, at the first resolution."""
    growths: dict[float, Growth] = {}
    a = min(SMALLEST, largest)
    while a >= _NOTHING and (now := orbits.growth(a)).unstable:
        growths[a] = now
        a /= 1.0 + _LONG
    a = min(SMALLEST, largest)
    while True:
        try:
            growths[a] = orbits.growth(a)
        except NoOrbitError:
            if not growths:
                raise
            break
        if a == largest:
            break
        strong = growths[a].per_radian > _STRONG * max(least, LEAST_GROWTH)
        a = min(a * (1.0 + (_LONG if strong else _STEP)), largest)
    return dict(sorted(growths.items()))


def _refined_near_limit(
    orbits: PlanarOrbits, growths: dict[float, Growth], least: float
) -> dict[float, Growth]:
    """Return the same with finer steps at twice the resolution near where growth begins to stay.

    The first resolution finds the limit to a per cent or so.
    """
    rough, largest = _last_step(growths, least)[1], max(growths)
    fine: dict[float, Growth] = {}
    a = _NEAR * rough
    while a < largest and (a < (1.0 + _STEP) * rough or fine[max(fine)].per_radian < least):
        fine[a] = orbits.growth(a, 2)
        a *= 1.0 + _FINE
    others = {b: one for b, one in growths.items() if not min(fine) <= b <= max(fine)}
    return dict(sorted({**others, **fine}.items()))


def _last_step(growths: dict[float, Growth], least: float) -> tuple[float, float]:
    """Return the largest amplitude that does not grow so fast, and the next; zero if all do.

    The very largest does.
    """
    amplitudes = list(growths)
    last = max((k for k, a in enumerate(amplitudes) if growths[a].per_radian < least), default=-1)
    return (amplitudes[last] if last >= 0 else 0.0), amplitudes[last + 1]


def _bisected(orbits: PlanarOrbits, low: float, high: float, least: float) -> float:
    while abs(high - low) > _BISECTED * low:
        middle = 0.5 * (low + high)
        grows = orbits.growth(middle, 2).per_radian >= max(least, GROWTH / (2.0 * math.pi))
        low, high = (low, middle) if grows else (middle, high)
    return high


def _tongues(
    orbits: PlanarOrbits, growths: dict[float, Growth], limit: float
) -> tuple[Tongue, ...]:
    """Return the intervals that grow in one way; with damping their ends are bisected."""
    tongues, around = [], [0.0, *growths, limit]
    for kind, run in groupby(growths.items(), key=lambda item: item[1].unstable and item[1].kind):
        if kind:
            amplitudes, grown = zip(*run, strict=True)
            most = max(grown, key=lambda one: one.exponent)
            low, high = amplitudes[0], amplitudes[-1]
            if orbits.damped:
                before, after = around[around.index(low) - 1], around[around.index(high) + 1]
                low = _bisected(orbits, before, low, 0.0) if before else low
                high = _bisected(orbits, after, high, 0.0) if math.isfinite(after) else high
            tongues.append(
                Tongue(low=low, high=high, growth=most.per_radian, kind=kind, modes=most.modes)
            )
    return tuple(tongues)
