"""Stability of a periodic orbit: its Floquet multipliers.

The equations of motion, linearized about the orbit, are integrated over one period: about a free
orbit by Gauss's method, which damps nothing. Modes too fast for its steps are left out by their
shape, for they come out on the unit circle at a wrong place, where they may meet others that they
never meet. About a driven orbit, and of a stiff system, Radau's method damps them away. All this
depends on the orbit's `frequency`, `tangent` and `constants` (see `Orbit`).
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from ..arrays import ComplexArray, FloatArray
from ..lazily import linalg
from ..threads import one_thread
from .collocation import Collocation, gauss, radau
from .system import Tangent

_REPORTED = 4  # modes
_COVERED = 6
_FEWEST_POINTS = 144  # of all steps
_MASSLESS = 1e-12  # energy of a shape of unit length, over the lowest frequency squared
_DAMPED_AWAY = 1e-6  # multiplier by Radau's method, below which its motion is not told apart
_LARGE = 1e60  # size of a monodromy that is kept apart, before it overflows
_RESOLVED = 4.5  # phase of a mode over a step [rad], which six stages meet to 1e-4


class Multipliers(NamedTuple):
    """Multipliers (2 modes,), the lowest modes first; the first two of a free orbit are 1.

    `largest` is the largest size, of these or, where the method damps the others, of all.
    """

    values: ComplexArray
    largest: float

    @property
    def lowest(self) -> ComplexArray:
        """Multipliers of the lowest four modes, (8,)."""
        return self.values[: 2 * _REPORTED]

    def stable(self, tolerance: float = 1e-6) -> bool:
        """Return whether none lies outside the unit circle."""
        return self.largest < 1.0 + tolerance


@one_thread
def floquet_multipliers(orbit: Any, modes: int = _COVERED) -> Multipliers:
    """Return the Floquet multipliers of the lowest `modes`, as far as there are so many."""
    at = orbit.tangent(2.0 * np.pi * np.arange(16) / 16)
    K, M = (0.5 * (part + part.T) for part in (at.stiffness.mean(axis=0), at.mass.mean(axis=0)))
    shapes, frequencies = normal_modes(K, M)
    covered = min(modes, frequencies.size)
    phase = frequencies[covered - 1] * 2.0 * np.pi / orbit.frequency
    constants, odd, n = orbit.constants(), orbit.system.odd, K.shape[0]
    stiff = constants is None or orbit.system.stiff
    method = radau(8) if stiff else gauss(6)
    steps = max(_FEWEST_POINTS // method.nodes.size, int(np.ceil(phase / _RESOLVED)))
    if stiff or odd is None:
        scaled, exponent = flow(orbit, steps, method=method)
        matrix = scaled * np.exp(exponent)
    else:
        # Reversed in time the other half undoes what the first does.
        half, _ = flow(orbit, -(-steps // 2), 0.5)
        mirror = np.where(np.concatenate((odd, ~odd)), -1.0, 1.0)[:, None]
        matrix = mirror * linalg.solve(half, mirror * half)
    basis = np.eye(2 * n)
    if constants is not None:
        # Without them the double multiplier 1 is gone, and what is near it can be told.
        basis = linalg.null_space(np.array(constants))
    values, vectors = np.linalg.eig(basis.T @ matrix @ basis)
    vectors = basis @ vectors

    def modal(states: ComplexArray | FloatArray) -> ComplexArray:
        parts = (frequencies[:, None] * (shapes @ states[:n]), shapes @ states[n:])
        return np.concatenate(parts).astype(np.complex128)

    motion = modal(vectors)
    if constants is not None:
        # They are known up to the flow, whose share is no motion of theirs.
        along = modal(constants[0][:, None])[:, 0]
        motion -= np.outer(along, along.conj() @ motion) / np.linalg.norm(along) ** 2
    energy = np.abs(motion[: frequencies.size]) ** 2 + np.abs(motion[frequencies.size :]) ** 2
    # Coordinates without mass, such as a constraint's, carry none: they come last.
    none = energy.sum(axis=0) < _MASSLESS * frequencies[0] ** 2
    if stiff:
        none |= np.abs(values) < _DAMPED_AWAY
    energy[:, none] = np.eye(1, len(energy), len(energy) - 1).T
    energy /= energy.sum(axis=0)
    kept = 2 * covered - (0 if constants is None else 2)
    # By where the energy is, the lowest modes first, and the resolved ones before all others.
    place = np.minimum(np.arange(frequencies.size), covered) @ energy
    order = np.argsort(place)[:kept]
    trivial = np.ones(0 if constants is None else 2)
    all_values = np.concatenate((trivial, values[order])).astype(np.complex128)
    return Multipliers(all_values, float(np.abs(values if stiff else all_values).max()))


def reversible_monodromy(orbit: Any, signs: FloatArray, steps: int) -> tuple[FloatArray, float]:
    """Return the monodromy of an undamped orbit that time reversal maps onto itself.

    From half of it, and over its size, where that is beyond 1e60; and the size's logarithm.
    With signs S (n,), M(-φ) = SM(φ)S and K(-φ) = SK(φ)S. What half a period makes of (q, Mq̇) is
    symplectic, which gives its inverse, and reversed that is the other half.
    """
    half, exponent = flow(orbit, -(-steps // 2), 0.5)
    n = signs.size
    start, end = orbit.tangent(np.array([0.0, np.pi])).mass
    momenta = half.copy()
    momenta[n:] = end @ momenta[n:]
    momenta[:, n:] = linalg.solve(start, momenta[:, n:].T, assume_a="pos").T
    # The inverse of [[A, B], [C, D]] is [[Dᵀ, -Bᵀ], [-Cᵀ, Aᵀ]]; reversing turns the signs of both.
    A, B, C, D = momenta[:n, :n], momenta[:n, n:], momenta[n:, :n], momenta[n:, n:]
    back = np.block([[D.T, B.T], [C.T, A.T]]) * np.outer(np.tile(signs, 2), np.tile(signs, 2))
    whole = back @ momenta
    whole[n:] = linalg.solve(start, whole[n:], assume_a="pos")
    whole[:, n:] = whole[:, n:] @ start
    return whole, 2.0 * exponent


def flow(
    orbit: Any, steps: int, share: float = 1.0, method: Collocation | None = None
) -> tuple[FloatArray, float]:
    """Return the map of a small change of (q, q̇) at φ = 0 over a share of a period, (2n, 2n).

    Over its size, where that is beyond 1e60, and with the size's logarithm.
    """
    method = method or gauss(6)
    stages = method.nodes.size
    nodes = (np.arange(steps)[:, None] + method.nodes) / steps
    tangents = orbit.tangent(2.0 * np.pi * share * nodes.ravel())
    n = tangents.residual.shape[-1]
    h = 2.0 * np.pi * share / orbit.frequency / steps
    position, velocity, exponent = np.eye(n, 2 * n), np.eye(n, 2 * n, k=n), 0.0
    for step in range(steps):
        at = Tangent(*(part[step * stages : (step + 1) * stages] for part in tangents))
        drifted = position + h * method.nodes[:, None, None] * velocity
        load = at.damping @ velocity + at.stiffness @ drifted
        acceleration = -linalg.solve(
            method.matrix(h, at), load.reshape(-1, 2 * n), check_finite=False
        ).reshape(stages, n, 2 * n)
        position = (
            position + h * velocity + h**2 * np.tensordot(method.last_position, acceleration, 1)
        )
        velocity = velocity + h * np.tensordot(method.last_velocity, acceleration, 1)
        size = np.abs(position).max()
        if size > _LARGE:
            position, velocity, exponent = position / size, velocity / size, exponent + np.log(size)
    return np.vstack((position, velocity)), float(exponent)


def normal_modes(K: FloatArray, M: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the normal coordinates (modes, n), the slowest first, and their frequencies."""
    inverse, vectors = linalg.eigh(M, K)
    kept = inverse > 1e-14 * inverse[-1]
    inverse, vectors = inverse[kept][::-1], vectors[:, kept][:, ::-1]
    # vectors.T K vectors = 1, so that vectors.T M q/inverse are coordinates of unit stiffness.
    return (vectors.T @ M) / np.sqrt(inverse)[:, None], 1.0 / np.sqrt(inverse)
