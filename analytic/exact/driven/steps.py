"""The steps of a motion, and its states between them."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...arrays import FloatArray
from ...methods.collocation import Collocation, radau

STAGES = 8


class Steps(NamedTuple):
    """The steps of a motion: their ends from the start on [s], and polynomials of accelerations.

    Coordinates and rates (2, ends, n) without units are those at the ends, and `accelerations`
    (steps, stages, n) at the nodes of Radau's method.
    """

    ends: FloatArray
    passed: FloatArray
    accelerations: FloatArray
    per_second: float

    @property
    def method(self) -> Collocation:
        """The collocation of the steps."""
        return radau(self.accelerations.shape[1])

    @property
    def lengths(self) -> FloatArray:
        """Lengths without units, (steps,)."""
        return np.asarray(self.per_second * np.diff(self.ends))

    @property
    def nodes(self) -> FloatArray:
        """Times of the nodes [s], (steps, stages)."""
        return self.ends[:-1, None] + np.outer(np.diff(self.ends), self.method.nodes)

    def at(self, time: FloatArray) -> FloatArray:
        """Return coordinates, rates and accelerations at times [s], (3, times, n)."""
        method, lengths = self.method, self.lengths
        q, q_dot = self.passed[:, 0]
        state = np.repeat(np.stack((q, q_dot, 0.0 * q))[:, None], time.size, axis=1)
        # The first step has its start as well, the last what round-off puts beyond its end.
        of = np.minimum(np.searchsorted(self.ends[1:], time), lengths.size - 1)
        for k in np.unique(of[of >= 0]):
            h, inside, acceleration = lengths[k], of == k, self.accelerations[k]
            at = (time[inside] - self.ends[k]) / (self.ends[k + 1] - self.ends[k])
            onto, (q, q_dot) = h * method.integral(at), self.passed[:, k]
            state[:, inside] = (
                q + h * (at[:, None] * q_dot + onto @ method.velocity @ acceleration),
                q_dot + onto @ acceleration,
                method.values(at) @ acceleration,
            )
        return state
