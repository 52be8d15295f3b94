"""Equations of motion of a mechanical system, as all that finds its motions sees them; its modes.

They are r(q, q̇, q̈) = 0 in n coordinates, or r(q, q̇, q̈, φ, Ω) = 0 under a drive of phase φ
(samples,) and rate Ω. Samples come first in every array. A system has

    size, functions                 n, and the number of functions that resolve it
    driven                          whether a drive acts; else it is autonomous and conservative
    residual, tangent               r (samples, n) in units of q, and a `Tangent`
    odd                             coordinates that time reversal turns around, (n,), or None
    refined(*state), lifted(q, of)  itself on more coordinates, which may be chosen by states q, q̇,
                                    q̈ and their drive, and the same states there
    gauge(q), gauge_rate(q, q̇),     the quantity whose peak is the amplitude (samples,), its rate,
    gauge_gradient(q)               and its derivatives (samples, n)

A driven one also has rest(Ω), a state (n,) near a small response, and loaded(share), itself under a
share of its load. A free one has the state `equilibrium` (n,) about which it moves, potential(q)
and kinetic_energy(q, q̇), whose sum is constant; and without reversal `pinned`, the coordinate whose
first cosine is zero.

Reversal (q, t) → (Rq, -t), R diagonal with -1 for odd coordinates and 1 for others, maps motions
onto motions. An orbit through a state that is its own image is then a series of sines in these and
of cosines in the others. Without reversal the series is full.

Modes are sought in 1/λ: the lowest become the largest eigenvalues, which the stiffest, of axial
motion and 10⁴ times faster, do not round off.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from ..arrays import ComplexArray, FloatArray
from ..lazily import linalg


class Tangent(NamedTuple):
    """Residual (samples, n) and its derivatives (samples, n, n) to q, q̇ and q̈."""

    residual: FloatArray
    stiffness: FloatArray
    damping: FloatArray
    mass: FloatArray


def reciprocal_modes(
    stiffness: FloatArray, coupling: FloatArray | ComplexArray, mass: FloatArray
) -> tuple[FloatArray, Any]:
    """Return 1/Ω, descending (n,), and the shapes (n, n) in columns of K - ΩC - Ω²M.

    All three are symmetric, as they are where coordinates in the sine and in the cosine of Ωτ are
    coupled by the rates; C may be Hermitian, -iD of a skew D. With M = FFᵀ and ν = 1/Ω that is the
    symmetric eigenproblem [[C, F], [Fᵀ, 0]] y = ν [[K, 0], [0, 1]] y.
    """
    n = len(stiffness)
    squares, vectors = np.linalg.eigh(mass)
    factor = vectors * np.sqrt(np.maximum(squares, 0.0))
    inverse, vectors = linalg.eigh(
        np.block([[coupling, factor], [factor.T, np.zeros((n, n))]]),
        linalg.block_diag(stiffness, np.eye(n)),
        subset_by_index=(n, 2 * n - 1),
    )
    return inverse[::-1], vectors[:n, ::-1]


def inverse_eigenvalues(
    mass: FloatArray, damping: FloatArray, stiffness: FloatArray
) -> ComplexArray:
    """Return 1/λ, (2n,), of λ²M + λD + K = 0, whatever D is."""
    n = len(mass)
    companion = np.zeros((2 * n, 2 * n))
    companion[:n] = -linalg.solve(stiffness, np.hstack([damping, mass]))
    companion[n:, :n] = np.eye(n)
    inverse = linalg.eigvals(companion, overwrite_a=True, check_finite=False)
    return np.asarray(inverse, dtype=np.complex128)
