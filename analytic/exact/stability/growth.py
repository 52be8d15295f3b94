"""Growth out of the plane over one period of a planar orbit, at a resolution and its double."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...arrays import ComplexArray, FloatArray
from ...blade import Blade
from ...methods.floquet import flow, normal_modes, reversible_monodromy
from ...methods.orbit import Orbit
from ...settled import settled
from ...theory import BERNOULLI_EULER, Theory
from ..continuum.rotation import SteadyBlade
from .out_of_plane import FlapTorsion, OutOfPlaneMotion, with_points_for

GROWTH = 1e-5
"""Growth over a period above which a motion is unstable, above the round-off of double ones."""
STEPS = 24
_SIZES = (12, 18, 27)  # functions
_SETTLED = 1e-3  # of the first four flap frequencies, with half as many functions again
_RESOLVED = 4.5  # phase of a mode over a step [rad], which six stages meet to 1e-4
_FASTEST = 20.0  # growth over a period that is not looked at more closely
_FAST = 1.0  # growth over a period beyond which it is no matter of resolution
_SAME = 0.01  # of the growth, from half the functions and steps
_REPORTED = 4  # modes
_SHARE = 0.15  # of the energy, from which a mode is named


class Growth(NamedTuple):
    """Growth out of the plane over one period: the fastest motion."""

    exponent: float  # logarithm of the largest multiplier's size
    multipliers: ComplexArray  # (8,)
    kind: str = ""
    modes: tuple[str, ...] = ()

    @property
    def unstable(self) -> bool:
        """Whether it grows."""
        return self.exponent > GROWTH

    @property
    def per_radian(self) -> float:
        """Growth exponent over the orbit's frequency [1/rad], zero if it is stable."""
        return self.exponent / (2.0 * np.pi) if self.unstable else 0.0

    def rate(self, frequency: float) -> float:
        """Return the growth rate [1/s] at the orbit's frequency [rad/s], zero if it is stable."""
        return self.per_radian * frequency


def grown_and_checked(
    blade: Blade, orbit: Orbit[Any], theory: Theory, ratio: float = 0.0, confirm: bool = True
) -> tuple[Growth, bool]:
    """Return what grows, and whether half as many functions and steps show the same.

    Or two thirds as many, where half as many do not; unless it need not be confirmed.
    """
    steady, steps = orbit.system.unloaded(orbit.frequency), STEPS
    functions = settled_functions(blade, steady, theory)
    if orbit.system.driven:
        # A drive may be slower than the blade, whose modes are resolved as about its own orbits.
        slowest = _steady_modes(_flap_torsion(blade, functions, theory), steady)[1][0]
        steps *= max(1, int(np.ceil(slowest / orbit.frequency)))
    rough = grown(blade, orbit, functions, steps, theory, ratio)
    if not confirm:
        return rough, False
    for finer in (2, 3):
        fine = grown(blade, orbit, finer * functions, finer * steps, theory, ratio)
        if not (rough.unstable or fine.unstable):
            return fine, True
        close = abs(rough.exponent - fine.exponent) <= _SAME * fine.exponent
        if (close and rough.kind == fine.kind) or fine.exponent > _FASTEST:
            break
        rough = fine
    return fine, close


def grown(
    blade: Blade,
    orbit: Orbit[Any],
    functions: int,
    steps: int,
    theory: Theory = BERNOULLI_EULER,
    ratio: float = 0.0,
) -> Growth:
    """Return what grows out of the plane over one period of an orbit.

    The blade's own damping and the damping `ratio` of its modes resist it.
    """
    across = _flap_torsion(blade, functions, theory)
    orbit = orbit.on(with_points_for(orbit.system, across.functions))
    steady = orbit.system.unloaded(orbit.frequency)
    motion = OutOfPlaneMotion(orbit, across, _modal(across, steady, ratio) if ratio else None)
    if motion.reversible:
        matrix, exponent = reversible_monodromy(motion, motion.signs, steps)
    else:
        matrix, exponent = flow(motion, steps)
    values, vectors = np.linalg.eig(matrix)
    frequencies, names, shares = _shares(across, steady, vectors)
    place = np.arange(len(shares)) @ shares
    sizes = np.log(np.maximum(np.abs(values), 1e-300)) + exponent
    # What oscillates too fast for the steps comes out at a wrong place and may meet others there.
    slow = frequencies < _RESOLVED * steps * orbit.frequency / (2.0 * np.pi)
    countable = (slow @ shares > 0.5) | (sizes > _FAST)
    largest = int(np.argmax(np.where(countable, sizes, -np.inf)))
    with np.errstate(over="ignore", invalid="ignore"):
        lowest = (values * np.exp(exponent))[np.argsort(place)[: 2 * _REPORTED]]
    growth = Growth(float(sizes[largest]), lowest.astype(complex))
    if not growth.unstable:
        return growth
    value, share = values[largest], shares[:, largest]
    kind = "sum resonance" if value.imag else "divergence" if value.real > 0 else "period doubling"
    modes = tuple(names[k] for k in np.argsort(-share)[:2] if share[k] >= min(_SHARE, share.max()))
    return growth._replace(kind=kind, modes=modes)


_flap_torsion = lru_cache(maxsize=32)(FlapTorsion)


def settled_functions(blade: Blade, planar: SteadyBlade, theory: Theory) -> int:
    """Return how many functions settle the flap modes, which rotation bends in a layer."""

    def flap(across: FlapTorsion) -> FloatArray:
        return np.log(_steady_modes(across, with_points_for(planar, across.functions))[1][:4])

    across, *_ = settled(
        lambda count: _flap_torsion(blade, count, theory), iter(_SIZES), _SETTLED, flap,
        f"the flap frequencies at w_bar = {planar.rate:.4g}", "rotate slower",
    )  # fmt: skip
    return across.functions


def _steady_modes(
    across: FlapTorsion, planar: SteadyBlade
) -> tuple[FloatArray, FloatArray, list[str]]:
    """Return normal coordinates (modes, n), frequencies and names, the slowest first."""
    at_rest = np.zeros((1, planar.size))
    K = across.stiffness(planar, planar.equilibrium[None], at_rest, at_rest)
    rows, frequencies = normal_modes(K[0], across.mass)
    flap = np.abs(rows[:, : across.functions]).max(axis=1)
    twists = np.abs(rows[:, across.functions :]).max(axis=1, initial=0.0) > flap
    names = [
        f"torsion {before}" if torsion else f"flap {k - before}"
        for k, (torsion, before) in enumerate(zip(twists, np.cumsum(twists), strict=True), start=1)
    ]
    return rows, frequencies, names


def _modal(across: FlapTorsion, planar: SteadyBlade, ratio: float) -> FloatArray:
    """Return the damping 2ζν of all modes ν of the straight blade in rotation, (n, n)."""
    rows, frequencies, _ = _steady_modes(across, planar)
    return np.asarray(rows.T @ (2.0 * ratio * frequencies[:, None] * rows))


def _shares(
    across: FlapTorsion, planar: SteadyBlade, states: ComplexArray
) -> tuple[FloatArray, list[str], FloatArray]:
    """Return the modes' frequencies and names, the slowest first, and their shares of the energy.

    The shares are (modes, states).
    """
    rows, frequencies, names = _steady_modes(across, planar)
    n = across.size
    energy = np.abs(frequencies[:, None] * (rows @ states[:n])) ** 2
    energy += np.abs(rows @ states[n:]) ** 2
    return frequencies, names, energy / energy.sum(axis=0)


@dataclass(frozen=True, kw_only=True)
class GrowthOutOfPlane:
    """Growth out of their plane about planar orbits, free or of a response to a load.

    Made by `out_of_plane` of the orbits. Small motion out of the plane about an orbit obeys a Hill
    equation, which is integrated over a period by Gauss's method. Modes up to 48 times the
    frequency of the orbit are resolved; those beyond follow, or oscillate too fast to be excited.

    Attributes
    ----------
    blade : Blade
        With the damping that resists what leaves the plane.
    omega : float or ndarray (orbits,)
        Rotation speed ω [rad/s].
    mode : str
        Mode from which free orbits grow, "" of a response.
    theory : Theory
        Of the orbits.
    amplitude : ndarray (orbits,)
        Peak |q|/L of the planar orbits.
    frequency : ndarray (orbits,)
        Their frequency [rad/s].
    multipliers : ndarray (orbits, 8)
        Floquet multipliers over a period of the orbit, with the motion in the lowest modes.
    growth_rate : ndarray (orbits,)
        Of the fastest growth [1/s], zero where nothing grows.
    kind : tuple of str
        How it grows: "period doubling", multiplier below -1; "divergence", above 1; "sum
        resonance", a complex pair; "" where nothing grows.
    modes : tuple of tuple of str
        The modes that hold its energy as the blade passes its straight shape, as "flap 1".
    converged : ndarray (orbits,)
        Whether on half, or two thirds, as many functions and steps it is stable as well, or grows
        within 1 % as fast.

    Examples
    --------
    >>> from analytic import Beam, Rectangle, periodic_orbits
    >>> strip = Beam.reference().with_shape(Rectangle())
    >>> growth = periodic_orbits(strip, 4.0, [0.01, 0.2]).out_of_plane()
    >>> print(growth.stable, growth.kind, growth.growth_rate.round())
    [ True False] ('', 'divergence') [  0. 121.]
    """

    blade: Blade
    omega: Any
    mode: str
    theory: Theory
    amplitude: FloatArray
    frequency: FloatArray
    multipliers: ComplexArray = field(repr=False)
    growth_rate: FloatArray
    kind: tuple[str, ...]
    modes: tuple[tuple[str, ...], ...]
    converged: NDArray[np.bool_]

    @property
    def stable(self) -> NDArray[np.bool_]:
        """Whether nothing grows out of the plane, (orbits,)."""
        return np.asarray(self.growth_rate == 0.0)

    def __str__(self) -> str:
        if self.stable.all():
            return f"All planar orbits up to a = {self.amplitude.max():.4g} stay in their plane"
        i = int(np.argmin(np.where(self.stable, np.inf, self.amplitude)))
        return (
            f"{np.sum(~self.stable)} of {self.stable.size} planar orbits leave their plane; the "
            f"smallest, a = {self.amplitude[i]:.4g} at {self.frequency[i]:.6g} rad/s, by "
            f"{self.kind[i]} of {' and '.join(self.modes[i])}, growing at "
            f"{self.growth_rate[i]:.3g} 1/s"
        )


def growth_about(
    orbits: Sequence[Orbit[Any]], blade: Blade, theory: Theory, ratio: float, confirm: bool
) -> dict[str, Any]:
    """Return the numbers of `GrowthOutOfPlane` about planar orbits of a blade."""
    growths = [grown_and_checked(blade, orbit, theory, ratio, confirm) for orbit in orbits]
    scale = blade.frequency_scale
    rates = [
        one.rate(scale * orbit.frequency) for (one, _), orbit in zip(growths, orbits, strict=True)
    ]
    return {
        "multipliers": np.array([one.multipliers for one, _ in growths]),
        "growth_rate": np.array(rates),
        "kind": tuple(one.kind for one, _ in growths),
        "modes": tuple(one.modes for one, _ in growths),
        "converged": np.array([converged for _, converged in growths]),
    }
