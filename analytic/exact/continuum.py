"""The exact beam: geometrically exact, extensible, Bernoulli-Euler, in the rotating frame.

Unit length, EI = 1, ρA = 1 and time τ = t √(EI/mL³), so that the slenderness μ = I/(AL²) is the
only parameter. Written as a complex number the slope of the beam's axis is

    z' = r_x' + i r_y' = (1 + e) exp(iθ),      z(0) = 0,

with the elongation e = |r'| - 1 and the angle θ of the tangent, and θ' = (r' × r'')/|r'|² is the
curvature: the elastic energy V = ½∫ (e²/μ + θ'²) dx is quadratic. Discretizing (θ, e) rather than
displacements makes the stiffness the identity and leaves nothing to lock: the inextensible beam
is simply e = 0, and μ = 0 is an ordinary value. In a frame that turns at the rate w(τ) the
acceleration of the slope is p exp(iθ),

    p = ë - (1 + e)(θ̇ + w)² + i [(1 + e)(θ̈ + ẇ) + 2ė(θ̇ + w)],

and d'Alembert's principle with f = exp(-iθ) ∫ G(x, y) p exp(iθ) dy, G = 1 - max(x, y), reads

    ∫ δe (e/μ + Re f) dx = 0,      ∫ (δθ' θ' + (1 + e) δθ Im f) dx = 0:

-f is the internal force of the beam in its own axes.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from ..arrays import ComplexArray, FloatArray
from ..methods.system import Tangent
from ..quadrature import axial_basis, gauss_points


class _Fields(NamedTuple):
    """Fields at the Gauss points, each (samples, points)."""

    turn: ComplexArray  # exp(iθ)
    stretch: FloatArray  # 1 + e
    stretch_rate: FloatArray  # ė
    spin: FloatArray  # θ̇ + w
    spin_rate: FloatArray  # θ̈ + ẇ
    acceleration: ComplexArray  # p
    force: ComplexArray  # f, times the quadrature weights


class Continuum:
    """Galerkin discretization of the exact beam in Legendre polynomials of θ and e.

    The generalized coordinates are q = (c, d): θ = Σ c_k φ_k with φ_k' orthonormal and
    φ_k(0) = 0, and e = √μ Σ d_k P_k with P_k orthonormal. Samples in time come first in every
    array.

    Parameters
    ----------
    slenderness : float
        μ = I/(AL²); zero for the inextensible beam.
    bending, axial : int
        Number of functions for θ and for e.
    rotary_inertia : float
        Inertia of the cross-sections against rotation per length: μ, or 0 to leave it out.

    Attributes
    ----------
    points, weights : ndarray (2 bending,)
        The Gauss points at which fields are evaluated, and their weights.
    """

    def __init__(
        self, slenderness: float, bending: int, axial: int, *, rotary_inertia: float = 0.0
    ) -> None:
        self.slenderness = slenderness
        self.bending = bending
        self.axial = axial
        self.size = bending + axial
        self.rotary = rotary_inertia
        self._epsilon = math.sqrt(slenderness)  # e = √μ ε makes the axial stiffness 1 as well
        self.points, self.weights = gauss_points(2 * bending)
        self._phi = axial_basis(bending, self.points).value
        self._psi = axial_basis(axial, self.points).slope
        legendre = axial_basis(self.points.size, self.points).slope
        self._to_legendre = (legendre * self.weights[:, None]).T
        # One point more integrates the square of the integrated interpolant exactly.
        finer, weights = gauss_points(self.points.size + 1)
        integral = self._integral(finer)
        self._green = integral.T @ (weights[:, None] * integral)
        self._rotary_mass = self.rotary * (self._phi.T * self.weights) @ self._phi

    def _integral(self, x: FloatArray) -> FloatArray:
        """Matrix from values at the Gauss points to the integral from the clamp to `x`."""
        return axial_basis(self.points.size, x).value @ self._to_legendre

    def split(self, q: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the coordinates of θ and those of e, along the last axis."""
        return q[..., : self.bending], q[..., self.bending :]

    def padded(self, q: FloatArray, other: Continuum) -> FloatArray:
        """Return the coordinates of the same shape in the larger basis of `other`."""
        result = np.zeros((*q.shape[:-1], other.size))
        theta, epsilon = self.split(q)
        result[..., : self.bending] = theta
        result[..., other.bending : other.bending + self.axial] = epsilon
        return result

    def _angle(self, q: FloatArray) -> FloatArray:
        return q[..., : self.bending] @ self._phi.T

    def _elongation(self, q: FloatArray) -> FloatArray:
        return self._epsilon * (q[..., self.bending :] @ self._psi.T)

    def _fields(
        self,
        q: FloatArray,
        q_dot: FloatArray,
        q_ddot: FloatArray,
        rate: float | FloatArray,
        rate_dot: float | FloatArray,
    ) -> _Fields:
        turn = np.exp(1j * self._angle(q))
        stretch = 1.0 + self._elongation(q)
        stretch_rate = self._elongation(q_dot)
        spin = self._angle(q_dot) + np.asarray(rate)[..., None]
        spin_rate = self._angle(q_ddot) + np.asarray(rate_dot)[..., None]
        p = (self._elongation(q_ddot) - stretch * spin**2) + 1j * (
            stretch * spin_rate + 2.0 * stretch_rate * spin
        )
        force = turn.conj() * ((turn * p) @ self._green)
        return _Fields(turn, stretch, stretch_rate, spin, spin_rate, p, force)

    def _residual(self, q: FloatArray, at: _Fields) -> FloatArray:
        theta = (at.stretch * at.force.imag) @ self._phi
        if self.rotary:
            theta = theta + self.rotary * (at.spin_rate * self.weights) @ self._phi
        epsilon = self._epsilon * (at.force.real @ self._psi)
        return q + np.concatenate((theta, epsilon), axis=-1)

    def residual(
        self,
        q: FloatArray,
        q_dot: FloatArray,
        q_ddot: FloatArray,
        rate: float | FloatArray,
        rate_dot: float | FloatArray = 0.0,
    ) -> FloatArray:
        """Return the virtual work (samples, n) of all forces on the basis functions.

        The elastic part is q itself, so that a residual is measured in units of q.
        """
        return self._residual(q, self._fields(q, q_dot, q_ddot, rate, rate_dot))

    def tangent(
        self,
        q: FloatArray,
        q_dot: FloatArray,
        q_ddot: FloatArray,
        rate: float | FloatArray,
        rate_dot: float | FloatArray = 0.0,
    ) -> Tangent:
        """Return the residual and its derivatives to q, q̇ and q̈ for (samples, n) coordinates."""
        at = self._fields(q, q_dot, q_ddot, rate, rate_dot)
        nb, n = self.bending, self.size
        # Re(-i f) = Im f: both equations are real parts of one complex product.
        left = np.concatenate(
            (
                (-1j * at.stretch * at.turn.conj())[..., None] * self._phi,
                (self._epsilon * at.turn.conj())[..., None] * self._psi,
            ),
            axis=-1,
        )
        left = np.swapaxes(left, -1, -2) @ self._green
        right = np.empty((*at.turn.shape, 3 * n), dtype=np.complex128)
        psi = self._epsilon * self._psi
        for block, (theta, epsilon) in enumerate(
            (
                (1j * at.acceleration, 1j * at.spin_rate - at.spin**2),
                (2j * at.stretch_rate - 2.0 * at.stretch * at.spin, 2j * at.spin),
                (1j * at.stretch, np.ones_like(at.turn)),
            )
        ):
            start = block * n
            right[..., start : start + nb] = (at.turn * theta)[..., None] * self._phi
            right[..., start + nb : start + n] = (at.turn * epsilon)[..., None] * psi
        work = np.concatenate((left.real, -left.imag), axis=-1) @ np.concatenate(
            (right.real, right.imag), axis=-2
        )
        stiffness, damping, mass = (work[..., k * n : (k + 1) * n] for k in range(3))
        stiffness[..., range(n), range(n)] += 1.0
        normal, axial = at.force.imag, at.force.real
        stiffness[..., :nb, :nb] -= self._phi.T @ ((at.stretch * axial)[..., None] * self._phi)
        stiffness[..., nb:, :nb] += psi.T @ (normal[..., None] * self._phi)
        stiffness[..., :nb, nb:] += self._phi.T @ (normal[..., None] * psi)
        mass[..., :nb, :nb] += self._rotary_mass
        return Tangent(self._residual(q, at), stiffness, damping, mass)

    def slope(self, q: FloatArray, x: FloatArray | None = None) -> ComplexArray:
        """Return z' = (1 + e) exp(iθ) at `x`, the Gauss points if None: (samples, points)."""
        phi, psi = self._bases(x)
        theta, epsilon = self.split(q)
        turn: ComplexArray = np.exp(1j * (theta @ phi.T))
        return (1.0 + self._epsilon * (epsilon @ psi.T)) * turn

    def slope_rate(
        self, q: FloatArray, q_dot: FloatArray, x: FloatArray | None = None
    ) -> ComplexArray:
        """Return ż' at `x`, the Gauss points if None: (samples, points)."""
        phi, psi = self._bases(x)
        theta_dot, epsilon_dot = self.split(q_dot)
        z = self.slope(q, x)
        # ż' = z' (iθ̇ + ė/(1 + e)), which also serves for any small change of q.
        return z * (1j * (theta_dot @ phi.T) + self._epsilon * (epsilon_dot @ psi.T) / np.abs(z))

    def _bases(self, x: FloatArray | None) -> tuple[FloatArray, FloatArray]:
        if x is None:
            return self._phi, self._psi
        return axial_basis(self.bending, x).value, axial_basis(self.axial, x).slope

    def integrated(self, slope: ComplexArray, x: FloatArray) -> ComplexArray:
        """Return the integral from the clamp to `x` of a slope given at the Gauss points."""
        return slope @ self._integral(x).T

    def tip(self, q: FloatArray) -> ComplexArray:
        """Return the tip's position z(1), (samples,)."""
        return self.slope(q) @ self.weights

    def tip_rate(self, q: FloatArray, q_dot: FloatArray) -> ComplexArray:
        """Return the tip's velocity ż(1) in the rotating frame, (samples,)."""
        return self.slope_rate(q, q_dot) @ self.weights

    def tip_gradient(self, q: FloatArray) -> ComplexArray:
        """Return the derivatives of the tip's position to the coordinates, (samples, n)."""
        turn = np.exp(1j * self._angle(q))
        slope = 1j * (1.0 + self._elongation(q)) * turn * self.weights
        return np.concatenate(
            (slope @ self._phi, (self._epsilon * self.weights * turn) @ self._psi), axis=-1
        )

    def jacobi_integral(self, q: FloatArray, q_dot: FloatArray, rate: float) -> FloatArray:
        """Return ½∫|ż|² - ½w²∫|z|² + V, constant at a constant rate w of the frame, (samples,)."""
        elastic: FloatArray = 0.5 * np.sum(q**2, axis=-1)
        centrifugal = 0.5 * rate**2 * self._squared(self.slope(q))
        return self.kinetic_energy(q, q_dot) + elastic - centrifugal

    def kinetic_energy(self, q: FloatArray, q_dot: FloatArray) -> FloatArray:
        """Return the kinetic energy relative to the rotating frame, (samples,)."""
        spin = q_dot[..., : self.bending]
        rotary: FloatArray = 0.5 * np.sum(spin * (spin @ self._rotary_mass), axis=-1)
        return 0.5 * self._squared(self.slope_rate(q, q_dot)) + rotary

    def _squared(self, slope: ComplexArray) -> FloatArray:
        squared: FloatArray = np.sum((slope.conj() * (slope @ self._green)).real, axis=-1)
        return squared

    def steady_state(self, rate: float) -> FloatArray:
        """Return the coordinates (n,) of the straight beam stretched by the rotation.

        Exactly, 1 + e = cos(kx)/cos(k) with k = w√μ, as long as k < π/2.
        """
        at_rest = np.zeros((1, self.size))
        tangent = self.tangent(at_rest, at_rest, at_rest, rate)
        q = np.zeros(self.size)
        # Without bending the equations are linear in e.
        q[self.bending :] = -np.linalg.solve(
            tangent.stiffness[0, self.bending :, self.bending :],
            tangent.residual[0, self.bending :],
        )
        return q


@lru_cache(maxsize=32)
def continuum(
    slenderness: float, bending: int, axial: int, rotary_inertia: float = 0.0
) -> Continuum:
    """Return the discretization, built once for each set of arguments."""
    return Continuum(slenderness, bending, axial, rotary_inertia=rotary_inertia)


def finer_model(model: Continuum) -> Continuum:
    """Return the discretization with half as many functions again."""
    bending = model.bending + model.bending // 2
    axial = model.axial + model.axial // 2
    return continuum(model.slenderness, bending, axial, model.rotary)
