"""Stability of a periodic orbit: its Floquet multipliers."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy import linalg

from ..arrays import ComplexArray
from .collocation import radau
from .harmonic_balance import PeriodicOrbit
from .system import Tangent

_STAGES = 6
_REPORTED = 8  # two for each of the lowest four modes


def floquet_multipliers(orbit: PeriodicOrbit[Any], steps: int = 48) -> ComplexArray:
    """Return the eight Floquet multipliers (8,) of largest modulus.

    They are the eigenvalues of the equations of motion, linearized about the orbit and
    integrated over one period. The method damps what `steps` do not resolve, from about the
    fourth mode of a first-mode orbit upwards, so that unresolved modes shrink instead of
    growing by aliasing. Two multipliers are 1: along the orbit and along the backbone.
    """
    method = radau(_STAGES)
    nodes = (np.arange(steps)[:, None] + method.nodes) / steps
    state = orbit.coordinates(2.0 * np.pi * nodes.ravel())
    tangents = orbit.system.tangent(*state)
    h = 2.0 * np.pi / orbit.frequency / steps
    n = orbit.system.size
    position, velocity = np.eye(n, 2 * n), np.eye(n, 2 * n, k=n)
    for step in range(steps):
        at = Tangent(*(part[step * _STAGES : (step + 1) * _STAGES] for part in tangents))
        drifted = position + h * method.nodes[:, None, None] * velocity
        load = at.damping @ velocity + at.stiffness @ drifted
        acceleration = -linalg.solve(
            method.matrix(h, at), load.reshape(-1, 2 * n), check_finite=False
        ).reshape(_STAGES, n, 2 * n)
        position = drifted[-1] + h**2 * np.tensordot(method.position[-1], acceleration, 1)
        velocity = velocity + h * np.tensordot(method.velocity[-1], acceleration, 1)
    multipliers = np.linalg.eigvals(np.vstack((position, velocity))).astype(np.complex128)
    return multipliers[np.argsort(-np.abs(multipliers))][:_REPORTED]


def is_stable(multipliers: ComplexArray, tolerance: float = 1e-5) -> bool:
    """Return whether no multiplier but the two nearest 1 lies outside the unit circle.

    Those two are 1 in every conservative system, as a double root that round-off splits.
    """
    others = multipliers[np.argsort(np.abs(multipliers - 1.0))][2:]
    return bool(np.all(np.abs(others) < 1.0 + tolerance))
