"""What a mechanical system must answer, so that its motions can be found without knowing it."""

from __future__ import annotations

from typing import Any, NamedTuple, Protocol, Self

import numpy as np
from numpy.typing import NDArray

from ..arrays import FloatArray

_MOVES = 1e-9  # of the coordinates; less is round-off of those that stand still


class Tangent(NamedTuple):
    """Residual (samples, n) and its derivatives (samples, n, n) to q, q̇ and q̈."""

    residual: FloatArray
    stiffness: FloatArray
    damping: FloatArray
    mass: FloatArray


class Coordinates(Protocol):
    """What describes the state of a mechanical system, n numbers, and what is read off them.

    Samples come first in every array.
    """

    @property
    def size(self) -> int:
        """Number of coordinates n."""
        ...

    @property
    def functions(self) -> int:
        """How finely the system is resolved: what `refined` makes larger."""
        ...

    def gauge(self, q: FloatArray) -> FloatArray:
        """Return the quantity whose peak is called the amplitude, (samples,)."""
        ...

    def gauge_rate(self, q: FloatArray, q_dot: FloatArray) -> FloatArray:
        """Return its rate, (samples,)."""
        ...

    def gauge_gradient(self, q: FloatArray) -> FloatArray:
        """Return its derivatives to the coordinates, (samples, n)."""
        ...

    def refined(self) -> Self:
        """Return the same system on more coordinates."""
        ...

    def lifted(self, q: FloatArray, finer: Self) -> FloatArray:
        """Return the coordinates (samples, n') of the same states in the system `finer`."""
        ...


class DrivenSystem(Coordinates, Protocol):
    """Equations of motion r(q, q̇, q̈, φ) = 0 under a drive of phase φ, damped or not.

    One parameter sets the drive's frequency, and may set more; along a response curve it varies.
    """

    def frequency(self, parameter: float) -> float:
        """Return the rate of the phase φ."""
        ...

    def rest(self, parameter: float) -> FloatArray:
        """Return a state (n,) from which a small response is found."""
        ...

    def residual(
        self,
        q: FloatArray,
        q_dot: FloatArray,
        q_ddot: FloatArray,
        phase: FloatArray,
        parameter: float,
    ) -> FloatArray:
        """Return r (samples, n), in units of q."""
        ...

    def tangent(
        self,
        q: FloatArray,
        q_dot: FloatArray,
        q_ddot: FloatArray,
        phase: FloatArray,
        parameter: float,
    ) -> Tangent:
        """Return r and its derivatives."""
        ...


class System(Coordinates, Protocol):
    """Autonomous, conservative equations of motion r(q, q̇, q̈) = 0 in n coordinates.

    Time reversal, (q, t) → (Rq, -t) with a diagonal R of ±1, must map motions onto motions: an
    orbit through a state that is its own mirror image is a series of sines in the coordinates that
    R turns around, and of cosines in the others.
    """

    @property
    def odd(self) -> NDArray[np.bool_]:
        """Which coordinates time reversal turns around, (n,): -1 on the diagonal of R."""
        ...

    @property
    def equilibrium(self) -> FloatArray:
        """The state about which it moves, (n,)."""
        ...

    def residual(self, q: FloatArray, q_dot: FloatArray, q_ddot: FloatArray) -> FloatArray:
        """Return r (samples, n), in units of q."""
        ...

    def tangent(self, q: FloatArray, q_dot: FloatArray, q_ddot: FloatArray) -> Tangent:
        """Return r and its derivatives."""
        ...

    def potential(self, q: FloatArray) -> FloatArray:
        """Return what with the kinetic energy stays constant along a motion, (samples,)."""
        ...

    def kinetic_energy(self, q: FloatArray, q_dot: FloatArray) -> FloatArray:
        """Return the kinetic energy, (samples,); by it changes of their sum are judged."""
        ...


def relative_defect(defect: FloatArray, q: FloatArray, moving: Any) -> float:
    """Return the largest residual (samples, n) along a motion q, without its unit.

    The mean and the motion are each measured by their own size, or the residual of a steady
    stretch would be told as that of a small motion about it.

    Parameters
    ----------
    defect, q : ndarray (samples, n)
    moving : index
        Coordinates by which the motion is measured.
    """
    mean, motion = defect.mean(axis=0), q - q.mean(axis=0)
    moved = max(np.linalg.norm(motion[:, moving], axis=-1).max(), _MOVES)
    of_mean = np.linalg.norm(mean) / max(np.linalg.norm(q, axis=-1).max(), _MOVES)
    of_motion = np.linalg.norm(defect - mean, axis=-1).max() / moved
    return float(of_mean + of_motion)
