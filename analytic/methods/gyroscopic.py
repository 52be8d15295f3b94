"""Eigenproblems of gyroscopic systems, in 1/λ: the lowest modes become the largest eigenvalues.

The stiffest modes, of axial motion, are 10⁴ times faster than the lowest and would round them off.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..arrays import ComplexArray, FloatArray
from ..lazily import linalg


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
