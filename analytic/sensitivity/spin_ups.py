"""Derivatives of a motion in time to the numbers of its blade, its rotation and its loads.

At every node of every step the residual is zero, whatever the numbers. So the changes of the
accelerations there obey the linear equations of the step with the motion's own tangent, driven by
the residual's change at states as they are: one step after the other, for many numbers at once.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, ClassVar, NamedTuple

import numpy as np

from ..arrays import FloatArray, few_at_once
from ..blade import Blade
from ..exact.continuum.state import Driven
from ..exact.driven.response import SpinUpResponse
from ..exact.driven.spin_up import spin_up_response
from ..exact.driven.start import started
from ..exact.driven.steps import Steps
from ..exact.driven.transient import drive
from ..lazily import linalg, optimize
from ..loads import Load, rippled
from .conditions import case_of, conditions_of
from .energies import difference
from .frozen import model_of
from .parameters import Parameter, parameters_of
from .steady import SteadyDerivatives, places_and_loads, units_of

_CHANGE = 1e-4  # of a parameter over its size
_AROUND = 1e-4  # of a state, where its numbers are compared
_AT_ONCE = 32  # parameters, whose changes at all nodes fit into memory
_LAG = SteadyDerivatives.outputs.index("tip y")


class _Case(NamedTuple):
    """A blade in a motion, its equations in units of the blade `unit`."""

    model: Any
    unit: Blade
    motion: Any
    loads: Sequence[Load]

    def driven(self) -> Callable[[FloatArray], Driven]:
        """Return what drives it at times [s]."""
        rotation = rippled(self.motion, self.loads)
        return drive(self.unit, rotation, self.loads, self.model)

    def of_states(self, what: Any, time: FloatArray, states: FloatArray) -> FloatArray:
        """Return a function of q, q̇, q̈ and their drive at times [s], in states in SI units."""
        driven_at = self.driven()
        powers = self.unit.frequency_scale ** np.arange(3.0)[:, None, None]
        return np.concatenate([
            what(*(states[:, few] / powers), driven_at(time[few])) for few in few_at_once(time.size)
        ])  # fmt: skip

    def residuals(self, time: FloatArray, states: FloatArray) -> FloatArray:
        """Return the residuals (times, n)."""
        return self.of_states(self.model.residual, time, states)

    def numbers(self, time: FloatArray, states: FloatArray) -> FloatArray:
        """Return the tip's place and twist, and force and moment at the root, (times, 10)."""
        return units_of(self.unit) * self.of_states(
            lambda *state: places_and_loads(self.model, *state), time, states
        )


class SpinUpDerivatives:
    """Derivatives of tip, twist, and force and moment at the root: largest, and over time."""

    each_station: ClassVar[bool] = False  # each number costs a sweep over all nodes

    def __init__(self, response: SpinUpResponse) -> None:
        self._response, self._steps = response, response.steps_taken
        self._nodes = self._steps.nodes
        self._case = _Case(response.model, response.blade, response.spin_up, response.loads)
        self.parameters = parameters_of(response.blade, response.theory)
        self.given: tuple[Any, Sequence[Load]] = response.spin_up, response.loads
        self.conditions = conditions_of(*self.given, response.blade.frequency_scale)
        names, units = SteadyDerivatives.outputs, SteadyDerivatives.units
        instants, parts = self._extremes()
        self._time = np.concatenate((instants, response.time))
        times = range(instants.size, self._time.size)
        self._parts = [*parts.values(), *([(t, k, 1.0)] for t in times for k in range(len(names)))]
        at = [f"{name} at {self._time[t]:.12g} s" for t in times for name in names]
        self.outputs = (*parts, *at)
        self.units = tuple(units[of[0][1]] for of in self._parts)
        self.values = self._picked(self._case.numbers(self._time, self._states(self._time)))

    def again(self, blade: Blade, motion: Any, loads: Sequence[Load]) -> dict[str, float]:
        """Return the numbers of another blade, in another rotation, under other loads, by name."""
        of = self._response
        other = SpinUpDerivatives(spin_up_response(
            blade, motion, of.time, loads=loads, start=of.start, kick=of.kick, bent=of.bent,
            theory=of.theory, tolerance=of.tolerance,
        ))  # fmt: skip
        return dict(zip(other.outputs, other.values.tolist(), strict=True))

    def _states(self, time: FloatArray) -> FloatArray:
        return self._in_seconds(self._steps.at(time))

    def _in_seconds(self, states: FloatArray) -> FloatArray:
        """Return coordinates, rates [1/s] and accelerations [1/s²] of those without units."""
        powers = np.arange(len(states)).reshape(-1, *(1,) * (states.ndim - 1))
        return np.asarray(states * self._steps.per_second**powers)

    def _extremes(self) -> tuple[FloatArray, dict[str, list[tuple[int, int, float]]]]:
        """Return instants, and by name the parts of an output: place of instant, number, share."""
        nodes = np.concatenate((self._steps.ends[:1], self._nodes.ravel()))
        numbers = self._case.numbers(nodes, self._states(nodes))
        instants, parts = list[float](), {}
        for k, name in enumerate(SteadyDerivatives.outputs):
            parts[f"largest {name}"] = [(len(instants), k, 1.0)]
            far = int(np.abs(numbers[:, k]).argmax())
            instants.append(self._instant(nodes, far, k, np.sign(numbers[far, k])))
        after = np.flatnonzero(nodes >= self._response.spin_up.ramp_time)
        if after.size > 1:
            both = [int(after[(sign * numbers[after, _LAG]).argmax()]) for sign in (1.0, -1.0)]
            if after[0] < min(both) and max(both) < after[-1]:
                at = len(instants)
                parts["swing after the ramp"] = [(at, _LAG, 0.5), (at + 1, _LAG, -0.5)]
                ways = zip(both, (1.0, -1.0), strict=True)
                instants += [self._instant(nodes, far, _LAG, sign) for far, sign in ways]
        return np.array(instants), parts

    def _instant(self, nodes: FloatArray, near: int, which: int, sign: float) -> float:
        """Return when a number is greatest, or least, near a node."""
        low, high = nodes[max(near - 1, 0)], nodes[min(near + 1, nodes.size - 1)]
        if not high > low or not sign:
            return float(nodes[near])

        def less(t: float) -> float:
            now = np.array([t])
            return float(-sign * self._case.numbers(now, self._states(now))[0, which])

        found = optimize.minimize_scalar(less, bounds=(low, high), method="bounded")
        return float(min((nodes[near], found.x), key=less))

    def _picked(self, numbers: FloatArray) -> FloatArray:
        """Return the outputs, of numbers (times, 10, ...)."""
        several = [sum(share * numbers[t, k] for t, k, share in part) for part in self._parts]
        return np.array(several)

    def columns(self, several: Sequence[Parameter]) -> FloatArray:
        """Return the derivatives of all outputs to parameters, (outputs, parameters)."""
        parts = [
            self._columns(several[first : first + _AT_ONCE])
            for first in range(0, len(several), _AT_ONCE)
        ]
        return np.concatenate((np.empty((len(self.outputs), 0)), *parts), axis=1)

    def _columns(self, several: Sequence[Parameter]) -> FloatArray:
        changes = [self._changes(one) for one in several]
        start, forces, fixed = (np.stack(kind, axis=-1) for kind in zip(*changes, strict=True))
        steps, at = self._marched(start, forces), self._states(self._time)
        moved = self._in_seconds(steps.at(self._time).reshape(*at.shape, -1))
        along = [self._along(at, moved[..., k]) for k in range(len(several))]
        return self._picked(fixed + np.stack(along, axis=-1))

    def _changes(self, parameter: Parameter) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return the derivatives of start, residuals at nodes, and numbers of the same states."""
        response, nodes = self._response, self._nodes.ravel()
        states, at = self._states(nodes), self._states(self._time)

        def values(other: Any) -> FloatArray:
            blade, motion, acting = case_of(other, response.blade, self.given)
            model, unit = response.model, response.blade
            if blade is not response.blade:
                model, unit = model_of(model, unit, response.theory, blade, response.loads)
            case = _Case(model, unit, motion, acting)
            several = self._start(case), case.residuals(nodes, states), case.numbers(self._time, at)
            return np.concatenate([one.ravel() for one in several])

        shapes = (2, response.model.size), (nodes.size, response.model.size), (self._time.size, -1)
        parts = np.split(
            difference(parameter, values, _CHANGE), np.cumsum([*map(np.prod, shapes[:2])])
        )
        start, forces, numbers = (part.reshape(of) for part, of in zip(parts, shapes, strict=True))
        return start, forces, numbers

    def _start(self, case: _Case) -> FloatArray:
        """Return coordinates and rates at the start, (2, n), in the units of the steps."""
        response = self._response
        start = started(
            case.unit, case.model, case.motion.start, response.start, case.loads,
            response.kick, response.bent,
        )  # fmt: skip
        unit = case.unit.frequency_scale / self._steps.per_second
        return np.stack((start[0], unit * start[1]))

    def _marched(self, start: FloatArray, forces: FloatArray) -> Steps:
        """Return the steps of the changes (n parameters) that start and residuals cause.

        `start` (2, n, parameters), `forces` (nodes, n, parameters).
        """
        steps, case, method = self._steps, self._case, self._steps.method
        driven_at = case.driven()
        forces = forces.reshape(*self._nodes.shape, *forces.shape[1:])
        passed, accelerations = [start.reshape(2, -1)], []
        none = np.zeros((method.nodes.size, start[0].size))
        for h, at, pushed in zip(steps.lengths.tolist(), self._nodes, forces, strict=True):
            tangent = case.model.tangent(*steps.at(at), driven_at(at))
            free = method.stages(h, passed[-1][0], passed[-1][1], none)
            q, q_dot, _ = (part.reshape(pushed.shape) for part in free)
            held = pushed + tangent.stiffness @ q + tangent.damping @ q_dot
            factors = linalg.lu_factor(method.matrix(h, tangent), overwrite_a=True)
            z = -linalg.lu_solve(factors, held.reshape(-1, start.shape[-1])).reshape(none.shape)
            q, q_dot, _ = method.stages(h, passed[-1][0], passed[-1][1], z)
            passed.append(np.stack((q[-1], q_dot[-1])))
            accelerations.append(z)
        several = np.reshape(accelerations, (-1, *none.shape))
        return Steps(steps.ends, np.stack(passed, axis=1), several, steps.per_second)

    def _along(self, states: FloatArray, way: FloatArray) -> FloatArray:
        """Return the derivatives of numbers along a change of the states, (times, 10)."""
        step = _AROUND / (float(np.abs(way[0]).max()) or 1.0)
        after, before = (self._case.numbers(self._time, states + s * way) for s in (step, -step))
        return (after - before) / (2.0 * step)
