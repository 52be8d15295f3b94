"""Motion of the exact blade in time, step by step in the rotating frame, and what drives it.

A load is a complex force in the frame of the clamp, per mass (gravity), per length, or at the tip.
A ripple of the speed is no force but changes w and ẇ.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partial
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from ...arrays import FloatArray, few_at_once
from ...blade import Blade
from ...blade_checks import require_blade
from ...loads import Load, require_load
from ...methods.collocation import OWN_TANGENT, TANGENT_BEFORE, radau
from ...motion import Rotation
from ..continuum.rotation import Model
from ..continuum.state import Driven

_STAGES = 8
_CREDIT, _MOST_CREDIT = 3, 10  # failures, before a tangent of the steps before is no longer tried

_MOST_PIECES = 100_000  # of the motion, where Newton's method fails on longer ones


def grid_of(corners: list[float], counts: list[int]) -> FloatArray:
    """Return the ends of the steps [s]."""
    parts = zip(pairwise(corners), counts, strict=True)
    return np.concatenate(([0.0], *(np.linspace(a, b, n + 1)[1:] for (a, b), n in parts)))


class BladeMotion(NamedTuple):
    """Deflection and rate, twist, places of the tip (times, 3) and points (times, points, 3).

    Without units, in the frame of the clamp. `state` has coordinates and rates, (3, times, n).
    """

    q: FloatArray
    q_dot: FloatArray
    twist: FloatArray
    tip: FloatArray
    axis: FloatArray
    state: FloatArray


def unit_load(blade: Blade, load: Load) -> Load:
    """Return a load without dimensions, in units of L, m0 L and √(m0 L⁴/EI0)."""
    require_blade(blade)
    require_load(load)
    return load.in_units(
        blade.length, blade.mass_per_length * blade.length, 1.0 / blade.frequency_scale
    )


def pushes(model: Model, loads: Sequence[tuple[Load, FloatArray]], angle: FloatArray) -> Any:
    """Return the force of all loads, with their phases (samples,), as a model takes it, or None."""
    total: Any = None
    for load, phase in loads:
        if load.acts_on is not None:
            force, lift = load.force(phase, angle, model.setting), load.lift(phase)
            push = model.push(force, load.acts_on, lift)
            total = push if total is None else total + push
    return total


def drive(
    blade: Blade, rotation: Rotation, loads: Sequence[Load], model: Model
) -> Callable[[FloatArray], Driven]:
    """Return what gives w, ẇ and the push of the loads at times (stages,) [s]."""
    per_second = blade.frequency_scale
    acting = [(unit_load(blade, load), load.frequency or 0.0) for load in loads]

    def at(times: FloatArray) -> Driven:
        phases = [(load, frequency * times) for load, frequency in acting]
        return Driven(
            rotation.rate(times) / per_second,
            rotation.acceleration(times) / per_second**2,
            pushes(model, phases, rotation.angle(times)),
        )

    return at


def integrated(
    blade: Blade,
    rotation: Rotation,
    loads: Sequence[Load],
    model: Model,
    grid: FloatArray,
    time: FloatArray,
    points: FloatArray,
    q: FloatArray,
    rates: FloatArray | float = 0.0,
) -> BladeMotion | None:
    """Return the motion on the grid of steps, None if Newton's method fails.

    A step on which it does is halved first, as often as it takes. It starts in the state `q` (n,)
    at the `rates`.
    """
    method, per_second = radau(_STAGES), blade.frequency_scale
    driven_at = drive(blade, rotation, loads, model)
    q_dot = rates + np.zeros(model.size)
    acceleration = np.zeros((_STAGES, model.size))
    state = np.repeat(np.stack((q, q_dot, 0.0 * q))[:, None], time.size, axis=1)
    previous, factors = 0.0, None
    # Tangents of the steps before are tried until they have failed more often than they served.
    newton, credit = (TANGENT_BEFORE, _CREDIT) if model.has_dear_tangent else (OWN_TANGENT, 0)
    ahead = list(pairwise(grid))[::-1]
    while ahead:
        begin, end = ahead.pop()
        h = (end - begin) * per_second
        stages = begin + (end - begin) * method.nodes
        guesses = [np.broadcast_to(acceleration[-1], acceleration.shape)]
        if previous:
            guesses.insert(0, method.values(1.0 + method.nodes * h / previous) @ acceleration)
        found, driven = None, driven_at(stages)
        if not math.isclose(h, previous):
            factors = None
        residual = partial(model.residual, by=driven)
        tangent = partial(model.tangent, by=driven)
        for guess in guesses:
            found = method.step(
                h, q, q_dot, guess, residual=residual, tangent=tangent, newton=newton,
                factors=factors,
            )  # fmt: skip
            if found is not None:
                break
        if found is None:
            if end - begin < (grid[-1] - grid[0]) / _MOST_PIECES:
                return None
            middle = 0.5 * (begin + end)
            ahead += [(middle, end), (begin, middle)]
            continue
        acceleration, previous = found.z, h
        if factors is not None:
            credit = min(credit + 1, _MOST_CREDIT) if found.factors is factors else credit - 1
        factors = found.factors if credit > 0 else None
        before = -np.inf if begin == grid[0] else begin  # the first step has its start as well
        inside = slice(*np.searchsorted(time, (before, end), side="right"))
        at = (time[inside] - begin) / (end - begin)
        if at.size:
            onto = h * method.integral(at)
            velocities = q_dot + onto @ acceleration
            positions = q + h * (at[:, None] * q_dot + onto @ method.velocity @ acceleration)
            state[:, inside] = positions, velocities, method.values(at) @ acceleration
        positions, velocities, _ = method.stages(h, q, q_dot, acceleration)
        q, q_dot = positions[-1], velocities[-1]
    at = np.append(points, 1.0)
    parts = [
        (
            model.tip(q)[:, 1],
            model.tip_rate(q, q_dot)[:, 1],
            model.tip_turn(q),
            model.places(q, at),
        )
        for q, q_dot, _ in (state[:, few] for few in few_at_once(time.size))
    ]
    deflection, rate, twist, places = map(np.concatenate, zip(*parts, strict=True))
    return BladeMotion(deflection, rate, twist, places[:, -1], places[:, :-1], state)
