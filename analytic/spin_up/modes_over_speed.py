"""The modes of a blade over its speed, as a change of the speed excites and keeps them.

About the steady state x_s(w) small motion obeys M ü + C u̇ + K u = -(f + C x_s') ẇ - M ẍ_s, where
f is the Euler force and x_s' the derivative of the steady state by the speed. A mode φ exp(iψ),
ψ' = ω_n, has the action φᴴ(2ω_n M - iG)φ/2 with the skew part G of C. Modes of unit action keep it
while the speed changes slowly: u = Im(Z φ exp(iψ)), and by parts Z' = -φᴴg exp(-iψ) ẇ with
g = f + (C + iω_n M) x_s'. Their phase follows from the next order of the equations, with K, C and M
at the state that ẇ bends, of which it is the part in proportion to ẇ; in the plane it is zero.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray

from ..arrays import ComplexArray, FloatArray
from ..blade import Blade
from ..exact.continuum.rotation import GAUGES, SteadyBlade
from ..exact.continuum.state import Driven
from ..exact.linear.families import LinearModes
from ..exact.linear.modes import driven_modes, mode_name
from ..exact.linear.speeds import followed
from ..theory import Theory

_SETTLED = 1e-8
"""Share of the last coefficients of an interpolation that has settled."""
_FEWEST, _MOST = 9, 257
_FIRST, _MOST_MODES = 6, 48  # modes among which one is sought
_STEP = 1e-4  # of the state that ẇ bends


class ModesAt(NamedTuple):
    """Modes of unit action at speeds w̄, each (modes, speeds), nondimensional.

    The natural frequency, the rate of decay by damping, the force φᴴg, and the motion of the tip
    along the mode's own direction: of flap normal to the plane of rotation, of others in it.
    """

    frequency: FloatArray
    decay: FloatArray
    force: ComplexArray
    tip: ComplexArray


@dataclass(frozen=True)
class ModesOverSpeed:
    """Chebyshev series of the modes from standstill to the speed w̄ = `top`."""

    top: float
    coefficients: ComplexArray = field(repr=False)

    def at(self, w: FloatArray) -> ModesAt:
        """Return the modes at speeds `w`, (speeds,), whose sign does not matter.

        Beyond the top they are those at the top.
        """
        inside = np.minimum(2.0 * np.abs(w) / self.top - 1.0, 1.0)
        frequency, decay, force, tip = chebyshev.chebval(inside, self.coefficients)
        return ModesAt(frequency.real, decay.real, force, tip)


class SolvedModes(NamedTuple):
    """Modes at one speed, as in `ModesAt`, in the phase of the tip's motion."""

    frequency: FloatArray
    decay: FloatArray
    force: ComplexArray
    tip: FloatArray
    tips: ComplexArray  # (modes, components): along the clamp, lag, flap
    shapes: ComplexArray  # (modes, n)
    momenta: ComplexArray  # φᴴ(2ω_n M - iG), (modes, n)
    turning: ComplexArray  # φᴴMφ, and φᴴ(δK + iω_n δC - ω_n²δM)φ by ẇ, (2, modes)


def top_of(blade: Blade, fastest: float) -> float:
    """Return the speed w̄ up to which modes serve a motion whose fastest is `fastest` [rad/s]."""
    # Rounded up, so that nearly equal speeds share one series.
    return max(1.0, math.ceil(10.0 * fastest / blade.frequency_scale) / 10.0)


def excited_modes(blade: Blade, fastest: float, count: int, theory: Theory) -> tuple[str, ...]:
    """Return the names of the lowest modes that a change of the speed excites, but axial ones."""
    omega = top_of(blade, fastest) * blade.frequency_scale
    modes = _found(blade, omega, theory, lambda names: len(_across(names)) >= count)
    return _across(modes.names)[:count]


def excited_mode(blade: Blade, fastest: float, mode: str | int, theory: Theory) -> str:
    """Return the name of a mode that a change of the speed excites, given by name or number."""
    name = mode_name(blade, fastest, mode, theory)
    omega = top_of(blade, fastest) * blade.frequency_scale
    names = _found(blade, omega, theory, lambda names: name in names).names
    if name not in names:
        raise ValueError(
            f"no change of the speed excites {name} of this blade, or it is none of the lowest "
            f"{len(names)} modes: at {omega:.4g} rad/s ask for {', '.join(_across(names)[:_FIRST])}"
        )
    return name


def _across(names: Sequence[str]) -> tuple[str, ...]:
    return tuple(name for name in names if not name.startswith("axial"))


@lru_cache(maxsize=8)
def _lowest(blade: Blade, omega: float, theory: Theory, count: int) -> LinearModes:
    return driven_modes(blade, omega, count, theory=theory, functions=max(20, 2 * count))


def _found(
    blade: Blade, omega: float, theory: Theory, enough: Callable[[Sequence[str]], bool]
) -> LinearModes:
    """Return as many of the lowest modes as are enough, or the most that are sought."""
    count = _FIRST
    while not enough((modes := _lowest(blade, omega, theory, count)).names) and count < _MOST_MODES:
        count *= 2
    return modes


def _places(
    blade: Blade, omega: float, theory: Theory, names: Sequence[str]
) -> tuple[LinearModes, list[int]]:
    modes = _found(blade, omega, theory, lambda found: set(names) <= set(found))
    return modes, [modes.names.index(name) for name in names]


def with_neighbors(
    blade: Blade, omega: float, theory: Theory, names: tuple[str, ...]
) -> tuple[str, ...]:
    """Return names of modes, then of all others up to the next of the family of the highest."""
    modes, places = _places(blade, omega, theory, names)
    family, number = modes.names[max(places)].split()
    following = f"{family} {int(number) + 1}"
    modes = _found(blade, omega, theory, lambda found: following in found)
    last = modes.names.index(following) if following in modes.names else max(places)
    others = _across(modes.names[: last + 1])
    return names + tuple(name for name in others if name not in names)


def modes_at(
    blade: Blade, omega: float, theory: Theory, names: Sequence[str]
) -> tuple[FloatArray, SolvedModes]:
    """Return the steady tip across the clamp over L, lag and flap, and modes at one speed [rad/s].

    Modes of torsion need not move the tip; `tip` of theirs may be zero.
    """
    modes, places = _places(blade, omega, theory, names)
    return modes.steady.tip[1:], _modes(modes.steady, places, _along(names))


def period_of(blade: Blade, omega: float, theory: Theory, name: str) -> float:
    """Return the period of a mode [s]."""
    modes, (place,) = _places(blade, omega, theory, (name,))
    return 2.0 * math.pi / float(modes.frequencies[place])


def _along(names: Sequence[str]) -> list[int]:
    return [GAUGES.get(name.split()[0], GAUGES["lag"]) for name in names]


@lru_cache(maxsize=64)
def modes_over_speed(
    blade: Blade, top: float, theory: Theory, names: tuple[str, ...]
) -> ModesOverSpeed:
    """Return the modes, named as at the speed `top`, for speeds w̄ from 0 to `top`."""
    modes, places = _places(blade, top * blade.frequency_scale, theory, names)
    at_top, along = modes.steady, _along(names)
    found = {1.0: (at_top, np.array(places))}
    solved = {1.0: _modes(*found[1.0], along)}
    points = _FEWEST
    while True:
        x = np.cos(np.pi * np.arange(points) / (points - 1))
        x[points // 2] = 0.0
        for faster, at in itertools.pairwise(x.tolist()):
            if at not in solved:
                before, of = found[faster]
                w = 0.5 * top * (1.0 + at)
                steady = replace(at_top, rate=w, near=before.equilibrium, given=None)
                found[at] = steady, followed(before, steady, of)[0]
                solved[at] = _modes(*found[at], along)
        coefficients = _turned(top, x, [solved[at] for at in x.tolist()])
        # Decay counts relative to the frequency, and each force to the largest.
        frequency, _, force, tip = np.abs(coefficients).max(axis=0)
        size = np.stack((frequency, frequency, np.full_like(force, force.max()), tip))
        rest = float((np.abs(coefficients[-2:]).max(axis=0) / size).max())
        if rest < _SETTLED:
            return ModesOverSpeed(top, coefficients)
        if points >= _MOST:
            raise ValueError(
                f"the modes up to w̄ = {top:.4g} do not settle over the speed with {points} "
                f"speeds ({rest:.1e}): take fewer modes, or a lower speed"
            )
        points = 2 * points - 1


def _modes(
    steady: SteadyBlade, places: Sequence[int] | NDArray[np.intp], along: Sequence[int]
) -> SolvedModes:
    """Return modes at one speed."""
    model, q, rate = steady.model, steady.equilibrium[None], steady.rate
    still, none = np.zeros_like(q), Driven(rate)
    K, C, M = (part[0] for part in steady.linearized[1:])
    skew, viscous = 0.5 * (C - C.T), 0.5 * (C + C.T)

    def at_rest(by: Driven) -> FloatArray:
        return np.asarray(model.residual(q, still, still, by)[0])

    # Forces are of second degree in w, and of first in ẇ: differences are exact.
    moved = -np.linalg.solve(K, 0.5 * (at_rest(Driven(rate + 1.0)) - at_rest(Driven(rate - 1.0))))
    pulled = at_rest(Driven(rate, 1.0)) - at_rest(none) + C @ moved
    bent = -np.linalg.solve(K, pulled)
    step = _STEP / max(np.abs(bent).max(), np.abs(moved).max(), 1.0)
    ahead, behind = (
        model.tangent(q + h * bent, still + h * moved, still, Driven(rate, h))
        for h in (step, -step)
    )
    more = [(a[0] - b[0]) / (2.0 * step) for a, b in zip(ahead[1:], behind[1:], strict=True)]

    frequency = steady.vibration[0][places]
    shapes = steady.vibration[1][:, places].T
    gradient = model.tip_gradient(q)[0]
    momenta = 2.0 * frequency[:, None] * (shapes.conj() @ M) - 1j * (shapes.conj() @ skew)
    action = 0.5 * np.sum(momenta * shapes, axis=1).real
    tip = np.array([gradient[k] @ shape for k, shape in zip(along, shapes, strict=True)])
    phase = np.where(tip == 0.0, 1.0, tip)  # of torsion that does not move the line
    scale = phase.conj() / (np.abs(phase) * np.sqrt(action))
    shapes, momenta = scale[:, None] * shapes, scale.conj()[:, None] * momenta
    i_w = 1j * frequency

    def of(matrix: FloatArray) -> ComplexArray:
        return np.asarray(np.sum(shapes.conj() * (shapes @ matrix.T), axis=1))

    by_rate = of(more[0]) + i_w * of(more[1]) + i_w**2 * of(more[2])
    return SolvedModes(
        frequency=frequency, decay=0.5 * frequency * of(viscous).real,
        force=shapes.conj() @ pulled + i_w * (shapes.conj() @ M @ moved),
        tip=np.abs(tip) / np.sqrt(action), tips=shapes @ gradient.T, shapes=shapes, momenta=momenta,
        turning=np.stack((of(M), by_rate)),
    )  # fmt: skip


def _turned(top: float, x: FloatArray, at: Sequence[SolvedModes]) -> ComplexArray:
    """Return the series (degrees, 4, modes), in the phase in which action is kept."""
    frequency, decay, force, tip, _, shapes, momenta, turning = map(np.stack, zip(*at, strict=True))
    series = np.linalg.inv(chebyshev.chebvander(x, x.size - 1))
    to_slope = chebyshev.chebval(x, chebyshev.chebder(series)).T * 2.0 / top
    from_rest = chebyshev.chebint(series, lbnd=-1.0)
    to_integral = chebyshev.chebval(x, from_rest).T * 0.5 * top
    # iN Z' + turn Z ẇ = 0, N = 2.
    turn = 1j * np.sum(momenta * np.tensordot(to_slope, shapes, 1), axis=2)
    turn = turn + 1j * (to_slope @ frequency) * turning[:, 0] + turning[:, 1]
    turned = np.exp(0.5j * (to_integral @ turn.real))
    parts = (frequency, decay, turned.conj() * force, turned * tip)
    return np.tensordot(series, np.stack(parts, axis=1), 1)
