"""Lengths of the steps of a motion, by its tolerance."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ...arrays import FloatArray
from ...methods.collocation import Collocation
from ...methods.newton import Root
from ..continuum.state import Driven

_LONGER, _SHORTER, _SAFETY = 2.0, 0.3, 0.9
_RATES = 10.0  # of the tolerance of places, for rates over the largest
_MANY = 4  # of Newton's steps, after which the next step in time is not longer
INSTANTS, _SMALL = 65, 1e-6


class StepControl:
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
        still = np.zeros((INSTANTS, start.size))
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
