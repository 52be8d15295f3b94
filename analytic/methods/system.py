"""The equations of motion of a mechanical system, as all that finds its motions sees them.

They are r(q, q̇, q̈) = 0 in n coordinates, or r(q, q̇, q̈, φ, Ω) = 0 under a drive of phase φ
(samples,) and rate Ω. Samples come first in every array. A system has

    size, functions                 n, and the number of functions that resolve it
    driven                          whether a drive acts; else it is autonomous and conservative
    residual, tangent               r (samples, n) in units of q, and a `Tangent`
    odd                             coordinates that time reversal turns around, (n,), or None
    refined(), lifted(q, finer)     itself on more coordinates, and the same states there
    gauge(q), gauge_rate(q, q̇),     the quantity whose peak is the amplitude (samples,), its rate,
    gauge_gradient(q)               and its derivatives (samples, n)

A driven one also has rest(Ω), a state (n,) near a small response, and loaded(share), itself under a
share of its load. A free one has the state `equilibrium` (n,) about which it moves, potential(q)
and kinetic_energy(q, q̇), whose sum is constant; and without reversal `pinned`, the coordinate whose
first cosine is zero.

Reversal (q, t) → (Rq, -t), R diagonal with -1 for odd coordinates and 1 for others, maps motions
onto motions. An orbit through a state that is its own image is then a series of sines in these and
of cosines in the others. Without reversal the series is full.
"""

from __future__ import annotations

from typing import NamedTuple

from ..arrays import FloatArray


class Tangent(NamedTuple):
    """Residual (samples, n) and its derivatives (samples, n, n) to q, q̇ and q̈."""

    residual: FloatArray
    stiffness: FloatArray
    damping: FloatArray
    mass: FloatArray
