"""Growth out of the plane over one period of a planar orbit, at a resolution and its double."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any, NamedTuple

import numpy as np

from ...arrays import ComplexArray, FloatArray
from ...beam import AnyBlade, require_planar, undamped
from ...input_checks import not_negative, rotation_speed
from ...methods.floquet import flow, normal_modes, reversible_monodromy
from ...methods.newton import NoOrbitError
from ...methods.orbit import Orbit
from ...settled import settled
from ...theory import BERNOULLI_EULER, Theory
from ..beam.steady import SteadyBeam, resolved_model
from ..free.path import AmplitudeNotReachedError, ModePath
from ..linear.modes import mode_name
from .out_of_plane import OutOfPlaneMotion, Space, with_points_for

GROWTH = 1e-5
"""Growth over a period above which a motion is unstable, above the round-off of double ones."""
LEAST_GROWTH = 0.01
"""Growth per radian of an undamped orbit that counts."""
SMALLEST = 0.01
"""Peak |q|/L of the smallest orbits that are looked at."""
STEPS = 24
_FUNCTIONS = 16  # for the orbits' angle, as in `periodic_orbits`
_SIZES = (12, 18, 27)  # functions
_SETTLED = 1e-3  # of the first four flap frequencies, with half as many functions again
_RESOLVED = 4.5  # phase of a mode over a step [rad], which six stages meet to 1e-4
_FASTEST = 20.0  # growth over a period that is not looked at more closely
_FAST = 1.0  # growth over a period beyond which it is no matter of resolution
_SAME = 0.01  # of the growth, from half the functions and steps
_REPORTED = 4  # modes
_SCANNED = (0.02, 0.035, 0.05, 0.08, *np.arange(0.1, 0.95, 0.05).round(2).tolist())
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
    blade: AnyBlade, orbit: Orbit[Any], theory: Theory, ratio: float = 0.0, confirm: bool = True
) -> tuple[Growth, bool]:
    """Return what grows, and whether half as many functions and steps tell the same.

    Or two thirds as many, where half as many do not; unless it need not be confirmed.
    """
    steady, steps = orbit.system.unloaded(orbit.frequency), STEPS
    functions = settled_functions(blade, steady, theory)
    if orbit.system.driven:
        # A drive may be slower than the blade, whose modes are resolved as about its own orbits.
        slowest = _steady_modes(_space(blade, functions, theory), steady)[1][0]
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
    blade: AnyBlade,
    orbit: Orbit[Any],
    functions: int,
    steps: int,
    theory: Theory = BERNOULLI_EULER,
    ratio: float = 0.0,
) -> Growth:
    """Return what grows out of the plane over one period of an orbit.

    The blade's own damping and the damping `ratio` of its modes resist it.
    """
    space = _space(blade, functions, theory)
    orbit = orbit.on(with_points_for(orbit.system, space.functions))
    steady = orbit.system.unloaded(orbit.frequency)
    motion = OutOfPlaneMotion(orbit, space, _modal(space, steady, ratio) if ratio else None)
    if motion.reversible:
        matrix, exponent = reversible_monodromy(motion, motion.signs, steps)
    else:
        matrix, exponent = flow(motion, steps)
    values, vectors = np.linalg.eig(matrix)
    frequencies, names, shares = _shares(space, steady, vectors)
    place = np.arange(len(shares)) @ shares
    sizes = np.log(np.maximum(np.abs(values), 1e-300)) + exponent
    # What oscillates too fast for the steps comes out at a wrong place and may meet others there.
    slow = frequencies < _RESOLVED * steps * orbit.frequency / (2.0 * np.pi)
    told = (slow @ shares > 0.5) | (sizes > _FAST)
    largest = int(np.argmax(np.where(told, sizes, -np.inf)))
    with np.errstate(over="ignore", invalid="ignore"):
        lowest = (values * np.exp(exponent))[np.argsort(place)[: 2 * _REPORTED]]
    growth = Growth(float(sizes[largest]), lowest.astype(complex))
    if not growth.unstable:
        return growth
    value, share = values[largest], shares[:, largest]
    kind = "sum resonance" if value.imag else "divergence" if value.real > 0 else "period doubling"
    modes = tuple(names[k] for k in np.argsort(-share)[:2] if share[k] >= min(_SHARE, share.max()))
    return growth._replace(kind=kind, modes=modes)


_space = lru_cache(maxsize=32)(Space)


def settled_functions(blade: AnyBlade, planar: SteadyBeam, theory: Theory) -> int:
    """Return how many functions settle the flap modes, which rotation bends in a layer."""

    def flap(space: Space) -> FloatArray:
        return np.log(_steady_modes(space, with_points_for(planar, space.functions))[1][:4])

    space, *_ = settled(
        lambda count: _space(blade, count, theory), iter(_SIZES), _SETTLED, flap,
        f"the flap frequencies at w_bar = {planar.rate:.4g}", "rotate slower",
    )  # fmt: skip
    return space.functions


def _steady_modes(space: Space, planar: SteadyBeam) -> tuple[FloatArray, FloatArray, list[str]]:
    """Return normal coordinates (modes, n), frequencies and names, the slowest first."""
    at_rest = np.zeros((1, planar.size))
    K = space.stiffness(planar, planar.equilibrium[None], at_rest, at_rest)
    rows, frequencies = normal_modes(K[0], space.mass)
    flap = np.abs(rows[:, : space.functions]).max(axis=1)
    twists = np.abs(rows[:, space.functions :]).max(axis=1, initial=0.0) > flap
    names = [
        f"torsion {before}" if torsion else f"flap {k - before}"
        for k, (torsion, before) in enumerate(zip(twists, np.cumsum(twists), strict=True), start=1)
    ]
    return rows, frequencies, names


def _modal(space: Space, planar: SteadyBeam, ratio: float) -> FloatArray:
    """Return the damping 2ζν of all modes ν of the straight blade in rotation, (n, n)."""
    rows, frequencies, _ = _steady_modes(space, planar)
    return np.asarray(rows.T @ (2.0 * ratio * frequencies[:, None] * rows))


def _shares(
    space: Space, planar: SteadyBeam, states: ComplexArray
) -> tuple[FloatArray, list[str], FloatArray]:
    """Return the modes' frequencies and names, the slowest first, and their shares of the energy.

    The shares are (modes, states).
    """
    rows, frequencies, names = _steady_modes(space, planar)
    n = space.size
    energy = np.abs(frequencies[:, None] * (rows @ states[:n])) ** 2
    energy += np.abs(rows @ states[n:]) ** 2
    return frequencies, names, energy / energy.sum(axis=0)


@dataclass(frozen=True, kw_only=True, eq=False)
class PlanarOrbits(ModePath):
    """Planar orbits of a mode, by their amplitude, and the motion that grows out of their plane.

    The planar orbits are undamped; what leaves the plane has the damping of the `blade`, and the
    damping ratio `damping` of its modes.
    """

    blade: AnyBlade
    damping: float

    @property
    def damped(self) -> bool:
        """Whether anything resists what leaves the plane."""
        return bool(self.damping) or any(self.blade.unit.damping)

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
    blade: AnyBlade,
    omega: float,
    mode: str | int = "lag 1",
    theory: Theory = BERNOULLI_EULER,
    damping: float = 0.0,
) -> PlanarOrbits:
    """Return the planar orbits of a mode at ω [rad/s]."""
    free = undamped(blade)
    name = lag_mode(free, omega, mode, theory)
    model = resolved_model(free, int(name.split()[1]), theory, _FUNCTIONS)
    return PlanarOrbits(
        beam=free, omega=omega, mode=name, theory=theory, model=model,
        blade=blade, damping=not_negative("damping", damping),
    )  # fmt: skip


def lag_mode(blade: AnyBlade, omega: float, mode: object, theory: Theory) -> str:
    """Return the name of a mode, which is of lag: other orbits are not in the plane."""
    name = mode_name(blade, omega, mode, theory)
    if not name.startswith("lag"):
        raise ValueError(f"planar orbits grow out of modes of lag, and mode is {name!r}: 'lag 1'")
    return name


def planar_note(blade: AnyBlade, omega: float, amplitude: float) -> str:
    """Return one sentence if a planar motion of that amplitude leaves its plane, "" if not.

    It leaves if an orbit of that amplitude, or one of a few smaller ones, grows out of the plane by
    0.01 per radian. `stability_limit` gives the limit, which takes several times as long. A damped
    blade, or one without a known section out of the plane, gives "" too.
    """
    require_planar(blade)
    unit = blade.unit
    if blade.section.out_of_plane is None or unit.setting != 1.0 or any(unit.damping):
        return ""
    if not 0.0 < amplitude < 1.0:
        return ""
    omega, amplitude = rotation_speed(omega), float(amplitude)
    try:
        orbits = planar_orbits(blade, omega)
        for a in [*(a for a in _SCANNED if a < amplitude), amplitude]:
            # The finer resolution confirms the first.
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
