"""Motion of the exact blade in time, step by step in the rotating frame, and what drives it."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partial
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from ...arrays import FloatArray, few_at_once
from ...blade import Blade
from ...loads import Load
from ...methods.collocation import OWN_TANGENT, Collocation, Linearization, Residual, radau
from ...methods.newton import Newton, Root
from ...methods.system import Tangent
from ...motion import Rotation
from ..continuum.discretization import Model
from ..continuum.loading import pushes, unit_load
from ..continuum.state import Driven
from .steps import STAGES, Steps

_MOST_PIECES = 100_000  # of the motion, where Newton's method fails on longer ones

_FEW = [0, 3, 5, 7]  # nodes of a step, at which dear tangents are taken
_CREDIT, _MOST_CREDIT = 3, 10  # failures, before a tangent of the steps before is no longer tried
_EXACT, _NEWTON = 1e-13, 1e-3  # of Newton's method: at the least, and of a step's tolerance
_MANY = 4  # of its steps, after which the next step in time is not longer

_FAR = 1.5  # of a step to the one before, from which on its series cannot be taken whole
_FIRST = 0.02  # step [√(mL⁴/EI)] after every corner
_LONGER, _SHORTER, _SAFETY = 2.0, 0.3, 0.9
_RATES = 10.0  # of the tolerance of places, for rates over the largest
_INSTANTS, _SMALL = 65, 1e-6


def grid_of(corners: list[float], counts: list[int]) -> FloatArray:
    """Return the ends of the steps [s]."""
    parts = zip(pairwise(corners), counts, strict=True)
    return np.concatenate(([0.0], *(np.linspace(a, b, n + 1)[1:] for (a, b), n in parts)))


class BladeMotion(NamedTuple):
    """Deflection and rate, twist, places of the tip (times, 3) and points (times, points, 3).

    Without units, in the frame of the clamp.
    """

    q: FloatArray
    q_dot: FloatArray
    twist: FloatArray
    tip: FloatArray
    axis: FloatArray
    steps: Steps


def drive(
    blade: Blade, rotation: Rotation, loads: Sequence[Load], model: Model
) -> Callable[[FloatArray], Driven]:
    """Return what gives w, ẇ and the push of the loads at times (stages,) [s]."""
    per_second = blade.frequency_scale
    acting = [unit_load(blade, load) for load in loads]

    def at(times: FloatArray) -> Driven:
        phases = [(load, load.phase_at(per_second * times)) for load in acting]
        return Driven(
            rotation.rate(times) / per_second,
            rotation.acceleration(times) / per_second**2,
            *pushes(model, phases, rotation.angle(times)),
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
    tolerance: float | None = None,
) -> BladeMotion | None:
    """Return the motion on the grid of steps, None if Newton's method fails.

    A step on which it does is halved first, as often as it takes. With a tolerance, of q over the
    largest q, the grid is cut into steps that follow it. It starts in the state `q` (n,) at the
    `rates`.
    """
    method, per_second = radau(STAGES), blade.frequency_scale
    driven_at = drive(blade, rotation, loads, model)
    q_dot, acceleration = rates + np.zeros(model.size), np.zeros((STAGES, model.size))
    solver, previous = _Solver(model, method), 0.0
    ends, passed, accelerations = [float(grid[0])], [(q, q_dot)], list[FloatArray]()
    control = None
    if tolerance is not None:
        forces = driven_at(np.linspace(grid[0], grid[-1], _INSTANTS))
        control = _Control(tolerance, _FIRST / per_second, model, q, forces)
    ahead = list(pairwise(grid.tolist()))[::-1]
    while ahead:
        begin, end = ahead.pop()
        if control is not None:
            middle = control.end(begin, end, corner=begin in grid)
            ahead += [(middle, end)] * (middle < end)
            end = middle
        h = (end - begin) * per_second
        guess = acceleration
        if previous:
            on, far = 1.0 + method.nodes * h / previous, control or h > _FAR * previous
            guess = method.ahead(acceleration, on) if far else method.values(on) @ acceleration
        within = 0.0 if control is None else control.within
        nodes = begin + (end - begin) * method.nodes
        found = solver.step(h, q, q_dot, guess, driven_at, nodes, _NEWTON * within)
        if found is None:
            if end - begin < (grid[-1] - grid[0]) / _MOST_PIECES:
                return None
            middle = 0.5 * (begin + end)
            ahead += [(middle, end), (begin, middle)]
            if control is not None:
                control.most = 1.0
            continue
        positions, velocities, _ = at_nodes = method.stages(h, q, q_dot, found.z)
        if control is not None and not control.passes(end - begin, h, at_nodes, found, method):
            ahead.append((begin, end))
            continue
        acceleration, previous = found.z, h
        q, q_dot = positions[-1], velocities[-1]
        ends.append(end)
        passed.append((q, q_dot))
        accelerations.append(acceleration)
    steps = Steps(
        np.array(ends), np.swapaxes(passed, 0, 1),
        np.reshape(accelerations, (-1, STAGES, q.size)), per_second,
    )  # fmt: skip
    state, at = steps.at(time), np.append(points, 1.0)
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
    return BladeMotion(deflection, rate, twist, places[:, -1], places[:, :-1], steps)


class _Solver:
    """Solution of one step after the other by the tangents of those before.

    Where a tangent is dear they are tried, until they have failed more often than they served.
    """

    def __init__(self, model: Any, method: Collocation) -> None:
        self.model, self.method = model, method
        self.near: Tangent | None = None
        self.credit = _CREDIT if model.has_dear_tangent else 0

    def step(
        self,
        h: float,
        q: FloatArray,
        q_dot: FloatArray,
        guess: FloatArray,
        driven_at: Callable[[FloatArray], Driven],
        times: FloatArray,
        within: float,
    ) -> Root | None:
        """Return the accelerations at the nodes, at `times` [s], None if they are not found."""
        by, newton = driven_at(times), OWN_TANGENT
        residual = partial(self.model.residual, by=by)
        tangent: Linearization = partial(self.model.tangent, by=by)
        if self.model.has_dear_tangent:
            tangent = partial(self._between, driven_at(times[_FEW]), residual)
            newton = Newton(
                converged=max(_EXACT, within), stagnates=_EXACT, slow=0.6, steps=20,
                tangents=4 if within else 100,
                broyden=True,
            )  # fmt: skip
        near = self.near if self.credit > 0 else None
        found = self.method.step(
            h, q, q_dot, guess, residual=residual, tangent=tangent, newton=newton, near=near
        )
        if found is None:
            return None
        used = found.factors[1]
        if near is not None:
            self.credit = min(self.credit + 1, _MOST_CREDIT) if used is near else self.credit - 1
        if used is not near:
            self.near = Tangent(*(part.mean(axis=0) for part in used))
        return found

    def _between(self, few: Driven, residual: Residual, *state: FloatArray) -> Tangent:
        """Return the residual, and tangents at some of the nodes and what they are between them."""
        known = self.model.tangent(*(part[_FEW] for part in state), few)
        onto = self.method.among(_FEW)
        return Tangent(residual(*state), *(np.tensordot(onto, one, 1) for one in known[1:]))


class _Control:
    """Lengths of steps by which lag, flap, place along and twist of the tip are within a tolerance.

    The error of a step's polynomial is taken to be its last term, and the tip to move with the
    coordinates as it does at the start.
    """

    def __init__(
        self, tolerance: float, first: float, model: Any, start: FloatArray, by: Driven
    ) -> None:
        self.tolerance, self.first, self.longest, self.most = tolerance, first, first, _LONGER
        change = _SMALL * np.eye(start.size)
        places, turn = (of(start + change) - of(start[None]) for of in (model.tip, model.tip_turn))
        self.seen = np.column_stack((places[:, [1, 2, 0]], turn)) / _SMALL
        # The elastic energy is ½ q·q: forces on the blade at its start are what bends it.
        still = np.zeros((_INSTANTS, start.size))
        self.start, self.size = start, 0.0
        moved = model.residual(start + still, still, still, by)
        self.size = max(self._moved(moved), self._moved(start))
        self.speed = self.size

    def _moved(self, change: FloatArray) -> float:
        return float(np.abs(change @ self.seen[:, :2]).max())

    @property
    def within(self) -> float:
        """The tolerance times the largest lag or flap so far, or to be expected."""
        return self.tolerance * self.size

    def end(self, begin: float, end: float, *, corner: bool) -> float:
        """Return the end [s] of the next step of a stretch."""
        if corner:
            self.longest = min(self.longest, self.first)
        return begin + (end - begin) / max(1, math.ceil((end - begin) / self.longest))

    def passes(
        self,
        length: float,
        h: float,
        state: tuple[FloatArray, FloatArray, FloatArray],
        found: Root,
        method: Collocation,
    ) -> bool:
        """Return whether a step passes, to a state at its nodes; set the length of the next."""
        q, q_dot, q_ddot = state
        self.size = max(self.size, self._moved(q - self.start))
        self.speed = max(self.speed, self._moved(q_dot))
        count, last = method.nodes.size, float(np.abs(method.last_term @ q_ddot @ self.seen).max())
        # Once integrated it is less by 2(2s - 1), twice by the square of this at the ends.
        times = h / (2.0 * (2 * count - 1))
        parts = times * last, times**2 * math.sqrt(2 * count - 1) * last
        sizes = _RATES * self.tolerance * self.speed, self.tolerance * self.size
        over = max(part / size if part else 0.0 for part, size in zip(parts, sizes, strict=True))
        longer = _LONGER
        if over > 0.0:
            longer = _SAFETY * over ** (-1.0 / (count + 1))
        most = self.most if found.steps <= _MANY else 1.0
        self.longest, self.most = length * min(max(longer, _SHORTER), most), _LONGER
        return longer >= _SAFETY**2
