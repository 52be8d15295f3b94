"""The equations of motion of a mechanical system, as all that finds its motions sees them."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple, Protocol, Self

from numpy import bool_
from numpy.typing import NDArray

from ..arrays import FloatArray


class Tangent(NamedTuple):
    """Residual (samples, n) and its derivatives (samples, n, n) to q, q̇ and q̈."""

    residual: FloatArray
    stiffness: FloatArray
    damping: FloatArray
    mass: FloatArray


class System(Protocol):
    """Equations of motion r(q, q̇, q̈) = 0 in n coordinates, or r(q, q̇, q̈, φ, Ω) = 0 under a drive.

    Samples come first in every array. A drive has the phase φ (samples,) and its rate Ω.
    """

    @property
    def size(self) -> int:
        """Number of coordinates n."""

    @property
    def functions(self) -> int:
        """Number of functions that resolve the system; `refined` raises it."""

    @property
    def driven(self) -> bool:
        """Whether a drive acts; without one the system is autonomous and conservative."""

    @property
    def odd(self) -> NDArray[bool_] | None:
        """True for coordinates that time reversal turns around, (n,); None without a reversal.

        (q, t) → (Rq, -t), R diagonal with -1 for these and 1 for the others, maps motions onto
        motions. An orbit through a state that is its own image is then a series of sines in these
        and of cosines in the others. Without reversal the series is full.
        """

    @property
    def pinned(self) -> int | None:
        """Coordinate whose first cosine is zero in a free orbit without time reversal."""

    def gauge(self, q: FloatArray) -> FloatArray:
        """Return the quantity whose peak is called the amplitude, (samples,)."""

    def gauge_rate(self, q: FloatArray, q_dot: FloatArray) -> FloatArray:
        """Return its rate, (samples,)."""

    def gauge_gradient(self, q: FloatArray) -> FloatArray:
        """Return its derivatives to the coordinates, (samples, n)."""

    def refined(self) -> Self:
        """Return the same system on more coordinates."""

    def lifted(self, q: FloatArray, finer: Self) -> FloatArray:
        """Return the coordinates (samples, n') of the same states in the system `finer`."""

    @property
    def residual(self) -> Callable[..., FloatArray]:
        """The function r(q, q̇, q̈), or r(q, q̇, q̈, φ, Ω) under a drive: (samples, n), units of q."""

    @property
    def tangent(self) -> Callable[..., Tangent]:
        """The function that returns r and its derivatives, of the same."""

    def rest(self, frequency: float) -> FloatArray:
        """Return a state (n,) of a driven system, from which a small response is found."""

    def loaded(self, share: float) -> Self:
        """Return a driven system under a share of its load, by which a larger response is found."""

    @property
    def equilibrium(self) -> FloatArray:
        """The state about which a free system moves, (n,)."""

    def potential(self, q: FloatArray) -> FloatArray:
        """Return what with the kinetic energy stays constant along a free motion, (samples,)."""

    def kinetic_energy(self, q: FloatArray, q_dot: FloatArray) -> FloatArray:
        """Return the kinetic energy, (samples,); by it changes of their sum are judged."""
