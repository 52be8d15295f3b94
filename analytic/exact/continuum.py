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

-f is the internal force of the beam in its own axes. Drag of the air and loads are added to the
acceleration, the viscosity of the blade, η_b and η_a in its own stiffness, is a diagonal.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from ..arrays import ComplexArray, FloatArray
from ..methods.system import Tangent
from ..unit_blade import UNIFORM, UnitBlade
from .kinematics import Kinematics
from .own_basis import turning_inertia


class _Fields(NamedTuple):
    """Fields at the Gauss points, each (samples, points)."""

    turn: ComplexArray  # exp(iθ)
    stretch: FloatArray  # 1 + e
    stretch_rate: FloatArray  # ė
    spin: FloatArray  # θ̇ + w
    spin_rate: FloatArray  # θ̈ + ẇ
    acceleration: ComplexArray  # p
    force: ComplexArray  # f, times the quadrature weights; drag and loads included


class Continuum(Kinematics):
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
    blade : UnitBlade
        What is not the uniform beam: section, point masses, hub radius, setting angle.

    Attributes
    ----------
    points, weights : ndarray (points,)
        The Gauss points at which fields are evaluated, and their weights.
    outboard : dict
        What a load may act on beyond each Gauss point, times its weight (points,): "mass",
        "length", and the "tip".
    """

    def __init__(
        self,
        slenderness: float,
        bending: int,
        axial: int,
        *,
        rotary_inertia: float = 0.0,
        blade: UnitBlade = UNIFORM,
    ) -> None:
        super().__init__(slenderness, bending, axial, blade)
        self.rotary = rotary_inertia
        # One point more integrates the square of the integrated interpolant exactly.
        at, dm = blade.inertia(self._points_a_panel + 1 + (blade.degree + 1) // 2)
        integral = self._integral(at)
        self._green = integral.T @ (dm[:, None] * integral)
        outboard = integral.T @ dm
        x, dj = turning_inertia(blade, rotary_inertia, self.points, self.weights)
        phi = self._bases(x)[0]
        self._rotary_mass, self._rotary_force = (phi.T * dj) @ phi, phi.T @ dj
        self._turns = bool(dj.any())
        bend, stretch, air = blade.damping
        self._viscosity = np.repeat([bend, stretch], [bending, axial])
        along, dx = blade.quadrature(self._points_a_panel + 1)
        integral = self._integral(along)
        self._drag = air * integral.T @ (dx[:, None] * integral) if air else None
        self.outboard = {"mass": outboard, "length": integral.T @ dx, "tip": self.weights}

    def _fields(
        self,
        q: FloatArray,
        q_dot: FloatArray,
        q_ddot: FloatArray,
        rate: float | FloatArray,
        rate_dot: float | FloatArray,
        push: ComplexArray | None,
    ) -> _Fields:
        turn = np.exp(1j * self._angle(q))
        stretch = 1.0 + self._elongation(q)
        stretch_rate = self._elongation(q_dot)
        # Coriolis and Euler forces know only what of the rotation is normal to the plane, c w.
        turning = self.blade.setting * np.asarray(rate)
        turning_rate = self.blade.setting * np.asarray(rate_dot)
        spin = self._angle(q_dot) + turning[..., None]
        spin_rate = self._angle(q_ddot) + turning_rate[..., None]
        p = (self._elongation(q_ddot) - stretch * spin**2) + 1j * (
            stretch * spin_rate + 2.0 * stretch_rate * spin
        )
        acceleration = (turn * p) @ self._green
        hub, beyond = self.blade.hub, 1.0 - self.blade.setting**2
        if hub:
            clamp = (1j * turning_rate - np.asarray(rate) ** 2) * hub
            acceleration = acceleration + np.asarray(clamp)[..., None] * self.outboard["mass"]
        if beyond:
            # Along the blade the centrifugal force is w², not the c²w² that p has.
            along = np.asarray(beyond * np.asarray(rate) ** 2)[..., None] * (stretch * turn.real)
            acceleration = acceleration - along @ self._green
        if self._drag is not None:
            velocity = turn * (stretch_rate + 1j * stretch * self._angle(q_dot))
            acceleration = acceleration + velocity @ self._drag
        if push is not None:
            acceleration = acceleration - push
        force = turn.conj() * acceleration
        return _Fields(turn, stretch, stretch_rate, spin, spin_rate, p, force)

    def _residual(
        self,
        q: FloatArray,
        q_dot: FloatArray,
        q_ddot: FloatArray,
        rate_dot: float | FloatArray,
        at: _Fields,
    ) -> FloatArray:
        theta = (at.stretch * at.force.imag) @ self._phi
        if self._turns:
            theta = theta + q_ddot[..., : self.bending] @ self._rotary_mass
            euler = self.blade.setting * np.asarray(rate_dot)
            theta = theta + euler[..., None] * self._rotary_force
        epsilon = self._epsilon * (at.force.real @ self._psi)
        return q + self._viscosity * q_dot + np.concatenate((theta, epsilon), axis=-1)

    def residual(
        self,
        q: FloatArray,
        q_dot: FloatArray,
        q_ddot: FloatArray,
        rate: float | FloatArray,
        rate_dot: float | FloatArray = 0.0,
        push: ComplexArray | None = None,
    ) -> FloatArray:
        """Return the virtual work (samples, n) of all forces on the basis functions.

        The elastic part is q itself, so that a residual is measured in units of q. A `push`
        (samples, points) is the load beyond each Gauss point, times its weight: the sum of complex
        forces times what is `outboard`.
        """
        at = self._fields(q, q_dot, q_ddot, rate, rate_dot, push)
        return self._residual(q, q_dot, q_ddot, rate_dot, at)

    def tangent(
        self,
        q: FloatArray,
        q_dot: FloatArray,
        q_ddot: FloatArray,
        rate: float | FloatArray,
        rate_dot: float | FloatArray = 0.0,
        push: ComplexArray | None = None,
    ) -> Tangent:
        """Return the residual and its derivatives to q, q̇ and q̈ for (samples, n) coordinates."""
        at = self._fields(q, q_dot, q_ddot, rate, rate_dot, push)
        nb, n = self.bending, self.size
        # Re(-i f) = Im f: both equations are real parts of one complex product.
        left = np.concatenate(
            (
                (-1j * at.stretch * at.turn.conj())[..., None] * self._phi,
                (self._epsilon * at.turn.conj())[..., None] * self._psi,
            ),
            axis=-1,
        )
        left = np.swapaxes(left, -1, -2)
        psi = self._epsilon * self._psi
        one = np.ones_like(at.turn)
        right = self._derivatives(
            at.turn,
            (1j * at.acceleration, 1j * at.spin_rate - at.spin**2),
            (2j * at.stretch_rate - 2.0 * at.stretch * at.spin, 2j * at.spin),
            (1j * at.stretch, one),
        )
        beyond = 1.0 - self.blade.setting**2
        if beyond:
            along = np.asarray(beyond * np.asarray(rate) ** 2)[..., None]
            right[..., :nb] += (along * at.stretch * at.turn.imag)[..., None] * self._phi
            right[..., nb:n] -= (along * at.turn.real)[..., None] * psi
        onto = left @ self._green
        if self._drag is not None:
            turning = self._angle(q_dot)
            air = self._derivatives(
                at.turn,
                (1j * at.stretch_rate - at.stretch * turning, 1j * turning),
                (1j * at.stretch, one),
            )
            onto = np.concatenate((onto, left @ self._drag), axis=-1)
            right = np.concatenate((right, air), axis=-2)
        work = np.concatenate((onto.real, -onto.imag), axis=-1) @ np.concatenate(
            (right.real, right.imag), axis=-2
        )
        stiffness, damping, mass = (work[..., k * n : (k + 1) * n] for k in range(3))
        stiffness[..., range(n), range(n)] += 1.0
        damping[..., range(n), range(n)] += self._viscosity
        normal, axial = at.force.imag, at.force.real
        stiffness[..., :nb, :nb] -= self._phi.T @ ((at.stretch * axial)[..., None] * self._phi)
        stiffness[..., nb:, :nb] += psi.T @ (normal[..., None] * self._phi)
        stiffness[..., :nb, nb:] += self._phi.T @ (normal[..., None] * psi)
        mass[..., :nb, :nb] += self._rotary_mass
        return Tangent(self._residual(q, q_dot, q_ddot, rate_dot, at), stiffness, damping, mass)

    def tension(
        self, q: FloatArray, q_dot: FloatArray, q_ddot: FloatArray, rate: float
    ) -> FloatArray:
        """Return the axial force N at the Gauss points, (samples, points), of the motion.

        By d'Alembert, from all that moves outboard, so that it is there without extension too.
        """
        at = self._fields(q, q_dot, q_ddot, rate, 0.0, None)
        return -at.force.real / self.weights

    def _derivatives(self, turn: ComplexArray, *blocks: tuple[Any, Any]) -> ComplexArray:
        """Return the derivatives (samples, points, 3 n) of `turn` times a field.

        To q, q̇ and q̈, of what has these derivatives to θ and e, to their rates, and so on.
        """
        n, nb = self.size, self.bending
        right = np.zeros((*turn.shape, 3 * n), dtype=np.complex128)
        for start, (theta, epsilon) in zip(range(0, 3 * n, n), blocks, strict=False):
            right[..., start : start + nb] = (turn * theta)[..., None] * self._phi
            right[..., start + nb : start + n] = (self._epsilon * turn * epsilon)[
                ..., None
            ] * self._psi
        return right

    def jacobi_integral(self, q: FloatArray, q_dot: FloatArray, rate: float) -> FloatArray:
        """Return the integral that is constant at a constant rate w of the frame, (samples,).

        ½∫|ż|² dm - ½w²∫[(R + x)² + c²y²] dm + V, less what the hub adds at rest.
        """
        elastic: FloatArray = 0.5 * np.sum(q**2, axis=-1)
        z, blade = self.slope(q), self.blade
        squared = self._squared(z)
        if blade.hub:
            squared = squared + 2.0 * blade.hub * (z @ self.outboard["mass"]).real
        if blade.setting != 1.0:
            beyond = 1.0 - blade.setting**2
            squared = squared - beyond * np.sum(z.imag * (z.imag @ self._green), axis=-1)
        return self.kinetic_energy(q, q_dot) + elastic - 0.5 * rate**2 * squared

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
