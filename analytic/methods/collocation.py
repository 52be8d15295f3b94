"""Collocation of any order for M(t, q) q̈ = ..., in position, velocity, acceleration.

Radau IIA is stiffly accurate and L-stable. Axial and high bending waves far faster than the step,
which carry almost no energy, are damped away; slower motion is integrated to the order 2s - 1.
Gauss's points, of order 2s, damp nothing: they show whether a motion grows.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property, lru_cache, partial
from typing import Any

import numpy as np
from numpy.polynomial import legendre

from ..arrays import ComplexArray, FloatArray
from ..lazily import special
from .newton import Newton, Root, Vector, factored, solved
from .system import Tangent

Residual = Callable[[FloatArray, FloatArray, FloatArray], FloatArray]
Linearization = Callable[[FloatArray, FloatArray, FloatArray], Tangent]

OWN_TANGENT = Newton(converged=1e-13, slow=0.2, steps=12)
"""Bound for coordinates of order 1."""


class Collocation:
    """Acceleration over one step of unit length, a polynomial by values at nodes (s,) in 0 to 1."""

    def __init__(self, nodes: FloatArray) -> None:
        self.nodes, stages = nodes, nodes.size
        self._to_legendre = np.linalg.inv(legendre.legvander(2.0 * self.nodes - 1.0, stages - 1))
        self.velocity = self.integral(self.nodes)
        # The velocity is interpolated too: integrating the acceleration twice is not A-stable.
        self.position = self.velocity @ self.velocity
        # The same at the end of the step.
        self.last_velocity = self.integral(np.ones(1))[0]
        self.last_position = self.last_velocity @ self.velocity

    @property
    def last_term(self) -> FloatArray:
        """Matrix (stages,) from values at the nodes to the last term of their Legendre series."""
        return np.asarray(self._to_legendre[-1])

    def values(self, at: FloatArray) -> FloatArray:
        """Matrix (at, stages) from values at the nodes to values of their interpolant."""
        waves = legendre.legvander(2.0 * at - 1.0, self.nodes.size - 1)
        return np.asarray(waves @ self._to_legendre, dtype=np.float64)

    def ahead(self, values: FloatArray, at: FloatArray) -> FloatArray:
        """Return the values (at, n) to which those at the nodes (stages, n) go on after the step.

        Of their Legendre series up to the term that is least there: the next ones grow beyond.
        """
        series = self._to_legendre @ values
        waves = legendre.legvander(2.0 * at - 1.0, self.nodes.size - 1)
        sizes = np.abs(series).max(axis=1) * np.abs(waves[-1])
        few = int(np.argmin(sizes)) + 1
        return np.asarray(waves[:, :few] @ series[:few])

    def among(self, few: list[int]) -> FloatArray:
        """Matrix (stages, few) from values at a few of the nodes to their interpolant at all."""
        waves = legendre.legvander(2.0 * self.nodes - 1.0, len(few) - 1)
        return np.asarray(waves @ np.linalg.inv(waves[few]))

    def integral(self, at: FloatArray) -> FloatArray:
        """Matrix (at, stages) from values at the nodes to the integral of their interpolant."""
        coefficients = legendre.legint(np.eye(self.nodes.size), lbnd=-1.0, scl=0.5, axis=0)
        waves = legendre.legvander(2.0 * at - 1.0, self.nodes.size)
        return np.asarray(waves @ coefficients @ self._to_legendre, dtype=np.float64)

    def stages(
        self, h: float, q: FloatArray, q_dot: FloatArray, acceleration: FloatArray
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return q, q̇ and q̈ (stages, n) at the nodes of a step of length `h`."""
        return (
            q + h * self.nodes[:, None] * q_dot + h**2 * self.position @ acceleration,
            q_dot + h * self.velocity @ acceleration,
            acceleration,
        )

    def matrix(self, h: float, tangent: Tangent) -> FloatArray:
        """Return the derivative (s n, s n) of the residuals at the nodes to the accelerations."""
        s, n = tangent.residual.shape
        blocks = (
            h**2 * self.position[:, None, :, None] * tangent.stiffness[:, :, None, :]
            + h * self.velocity[:, None, :, None] * tangent.damping[:, :, None, :]
        )
        blocks[range(s), :, range(s), :] += tangent.mass
        return np.asarray(blocks.reshape(s * n, s * n), dtype=np.float64)

    @cached_property
    def _apart(self) -> tuple[ComplexArray, ComplexArray, ComplexArray]:
        """Eigenvalues of the velocities' matrix, one of each pair, and what goes to and fro."""
        values, vectors = np.linalg.eig(self.velocity)
        one = values.imag >= 0.0
        back = vectors[:, one] * np.where(values.imag[one] > 0.0, 2.0, 1.0)
        return values[one], back, np.linalg.inv(vectors)[one]

    def solver(self, h: float, tangent: Tangent) -> Vector:
        """Return the solution of a step's linear equations with the same tangent at all nodes.

        In the eigenvectors of the velocities' matrix, A = TΛT⁻¹, they fall apart into
        h²λ²K + hλD + M for every pair of eigenvalues λ (Hairer and Wanner 1996, Sec. IV.8).
        """
        values, back, onto = self._apart
        p = h * values[:, None, None]
        inverse = np.linalg.inv(p**2 * tangent.stiffness + p * tangent.damping + tangent.mass)

        def solve(defect: FloatArray) -> FloatArray:
            parts = onto @ defect.reshape(self.nodes.size, -1)
            return np.asarray((back @ (inverse @ parts[..., None])[..., 0]).real.ravel())

        return solve

    def step(
        self,
        h: float,
        q: FloatArray,
        q_dot: FloatArray,
        guess: FloatArray,
        *,
        residual: Residual,
        tangent: Linearization,
        newton: Newton = OWN_TANGENT,
        near: Tangent | None = None,
    ) -> Root | None:
        """Return the accelerations (stages, n) that make the residuals zero, None if not found.

        A tangent `near` by (n, n) is tried first, the same at all nodes; that of the root returned,
        among its `factors`, may serve in steps of any length after it.
        """

        def state(z: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
            return self.stages(h, q, q_dot, z.reshape(guess.shape))

        def linearized(z: FloatArray) -> tuple[Any, FloatArray]:
            at = tangent(*state(z))
            # Single precision leaves nothing of thin strips, which are a thousand times stiffer
            # one way than the other.
            solve = partial(solved, factored(self.matrix(h, at), single=False))
            return (solve, at), at.residual.ravel()

        root = newton.root(
            guess.ravel(),
            lambda z: residual(*state(z)).ravel(),
            linearized,
            size=lambda _, z: float(np.abs(h**2 * self.position @ z.reshape(guess.shape)).max()),
            factors=None if near is None else (self.solver(h, near), near),
            solve=lambda factors, defect: factors[0](defect),
        )
        return None if root is None else root._replace(z=root.z.reshape(guess.shape))


@lru_cache(maxsize=8)
def radau(stages: int) -> Collocation:
    """Return Radau's method with so many stages, built once."""
    inner, _ = special.roots_jacobi(stages - 1, 1.0, 0.0)
    return Collocation(0.5 * (np.append(inner, 1.0) + 1.0))


@lru_cache(maxsize=8)
def gauss(stages: int) -> Collocation:
    """Return Gauss's method with so many stages, built once."""
    return Collocation(0.5 * (special.roots_legendre(stages)[0] + 1.0))
