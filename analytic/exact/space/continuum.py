"""The exact blade in space: geometrically exact, twisted, coned, bent in both planes, and in torsion.

Unit length, EI3 = 1 and m = 1 at the root, time τ = t √(EI3/mL⁴). The root frame b turns with the
clamp at w (sin β, 0, cos β): b1 along the blade, b2 in the direction of rotation (lag), b3 up
(flap), β the precone. R(x) carries b to a frame that bends and twists with the blade but has no
twist of its own; the section is turned in it by χ(x), setting and twist, about the axis. With the
material strains Γ and K in that frame

    r' = R Γ,      R' = R K̂,      Γ = (1 + ε, γ2, γ3) - ½k² e1 (κ1² - κ01²) + offsets,

and coordinates q of ε, γ, K that are orthonormal in the section's stiffness, the elastic energy is
½ q·q. k² = (EI2 + EI3)/EA is the trapeze effect: the mean fiber keeps its length, so that twist
shortens the axis. With the spin ω' = R K̇ relative to b, d'Alembert's principle reads

    q_k + ∫ (A_c · δr_c + [J α + ω × J ω] · δφ) dm = 0,    δφ' = R δK,   δr' = δφ × r' + R δΓ,

A_c, ω and α being those in space. All integrals from the clamp are one matrix, all beyond a point
its transpose with the weights: so mass and stiffness are symmetric, and the Jacobi integral is
kept. The plane is the subset κ3, ε, γ2. Derived in the literature on rotor blades with strains as
variables; see Su and Cesnik (2011) and Boyer and Renda (2017).
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from ...arrays import FloatArray
from ...methods.system import Tangent
from .basis import StrainFunctions
from .vectors import Frames, cross, turned, turned_back

_AXIS = np.array([1.0, 0.0, 0.0])[:, None, None]


class _State(NamedTuple):
    """Fields (3, samples, points) on the grid, and at the masses, marked _m."""

    frame: FloatArray
    frame_m: FloatArray
    K: FloatArray
    slope: FloatArray  # r'
    place_m: FloatArray  # r
    offset_m: FloatArray  # ρ, from the line to the center of mass


class _Motion(NamedTuple):
    """Rates and accelerations of the same."""

    turning: FloatArray  # R K̇
    stretching: FloatArray  # R Γ̇
    spin: FloatArray  # ω relative to b
    spin_m: FloatArray
    velocity_m: FloatArray
    spin_rate: FloatArray
    total_spin: FloatArray  # at the masses, in space
    total_spin_rate: FloatArray
    acceleration: FloatArray  # A_c, in space
    twisting: FloatArray  # R K̈
    speeding: FloatArray  # R Γ̈


class SpaceContinuum:
    """Galerkin discretization of the exact blade in polynomials of its moments and forces.

    Samples in time come first in the coordinates (samples, n); residual and tangent are as those
    of `Continuum`, of which it has the coordinates.

    Parameters
    ----------
    functions : StrainFunctions
        The strains, and what the sections weigh.
    """

    def __init__(self, functions: StrainFunctions) -> None:
        self.functions = functions
        self.size = functions.size
        self.blade = functions.blade
        grid, masses = functions.grid, functions.masses
        self.points, self.weights = grid.points, grid.weights
        self._inner = grid.integral(grid.points)
        self._outer = grid.integral(masses.places)
        self._frames = Frames(grid, masses.places)
        self._masses = masses
        self._own = functions.at(grid.points)
        # ∫ over the tip and the length, for loads that act there.
        self.outboard = {
            "mass": self._outer.T @ masses.mass,
            "length": self._inner.T @ self.weights,
            "tip": self.weights,
        }

    # What the coordinates make of the shape.

    def _strains(self, q: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return Γ and K, (3, samples, points)."""
        own = self._own
        K = own.initial[:, None] + np.einsum("ipk,sk->isp", own.K, q)
        Γ = np.einsum("ipk,sk->isp", own.Γ, q)
        Γ[0] += 1.0 - 0.5 * own.trapeze * (K[0] ** 2 + 2.0 * own.twist * K[0])
        return Γ, K

    def _rates(self, K: FloatArray, q_dot: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return Γ̇ and K̇ of coordinates that change by q̇; of any small change of q as well."""
        own = self._own
        change = np.einsum("ipk,sk->isp", own.K, q_dot)
        Γ = np.einsum("ipk,sk->isp", own.Γ, q_dot)
        Γ[0] -= own.trapeze * (K[0] + own.twist) * change[0]
        return Γ, change

    def _state(self, q: FloatArray) -> _State:
        Γ, K = self._strains(q)
        frame, frame_m = self._frames.of(K)
        slope = turned(frame, Γ)
        return _State(
            frame, frame_m, K, slope, slope @ self._outer.T,
            turned(frame_m, self._masses.offset[:, None]),
        )  # fmt: skip

    def _clamp(
        self, rate: float | FloatArray, rate_dot: float | FloatArray
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return W, Ẇ and the clamp's place h from the axis of rotation, (3, samples, 1)."""
        axis, hub = self.blade.axis[:, None, None], self.blade.clamp[:, None, None]
        w, w_dot = (np.atleast_1d(np.asarray(x, dtype=float))[:, None] for x in (rate, rate_dot))
        return axis * w, axis * w_dot, hub

    def _motion(
        self,
        at: _State,
        q_dot: FloatArray,
        q_ddot: FloatArray,
        rate: float | FloatArray,
        rate_dot: float | FloatArray,
    ) -> _Motion:
        inner, outer = self._inner.T, self._outer.T
        stretch, bend = self._rates(at.K, q_dot)
        stretch_rate, bend_rate = self._rates(at.K, q_ddot)
        stretch_rate[0] -= self._own.trapeze * bend[0] ** 2
        turning, stretching = turned(at.frame, bend), turned(at.frame, stretch)
        twisting, speeding = turned(at.frame, bend_rate), turned(at.frame, stretch_rate)
        spin, spin_m = turning @ inner, turning @ outer
        velocity_m = (cross(spin, at.slope) + stretching) @ outer
        spin_change = twisting + cross(spin, turning)
        spin_rate = spin_change @ inner
        acceleration = (
            cross(spin_rate, at.slope)
            + cross(spin, cross(spin, at.slope) + 2.0 * stretching)
            + speeding
        ) @ outer
        W, W_dot, hub = self._clamp(rate, rate_dot)
        place = hub + at.place_m
        total = spin_m + W
        total_rate = spin_change @ outer + cross(W, spin_m) + W_dot
        acceleration = (
            acceleration
            + cross(W, 2.0 * velocity_m + cross(W, place))
            + cross(W_dot, place)
            + cross(total_rate, at.offset_m)
            + cross(total, cross(total, at.offset_m))
        )
        return _Motion(
            turning, stretching, spin, spin_m, velocity_m, spin_rate, total, total_rate,
            acceleration, twisting, speeding,
        )  # fmt: skip

    def _inertia(self, at: _State, vector: FloatArray) -> FloatArray:
        """Return R J Rᵀ times vectors (3, samples, masses, ...)."""
        extra = vector.ndim - 3
        frame = at.frame_m.reshape(*at.frame_m.shape, *(1,) * extra)
        J = self._masses.inertia.reshape(3, 3, 1, -1, *(1,) * extra)
        return turned(frame, turned(J, turned_back(frame, vector)))

    def _forces(
        self, at: _State, motion: _Motion, push: FloatArray | None
    ) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """Return m A_c and J α + ω × J ω at the masses, and F and M on the grid, with weights."""
        pulled = self._masses.mass * motion.acceleration
        if not self._masses.turns:
            rotary = np.zeros_like(pulled)
        else:
            rotary = self._inertia(at, motion.total_spin_rate) + cross(
                motion.total_spin, self._inertia(at, motion.total_spin)
            )
        force = -pulled @ self._outer
        if self._masses.drag is not None:
            force = force - (self._masses.drag * motion.velocity_m) @ self._outer
        if push is not None:
            force = force + push
        couple = -(rotary + cross(at.offset_m, pulled)) @ self._outer
        moment = cross(at.slope, force) @ self._inner + couple
        return pulled, rotary, force, moment

    def residual(
        self,
        q: FloatArray,
        q_dot: FloatArray,
        q_ddot: FloatArray,
        rate: float | FloatArray,
        rate_dot: float | FloatArray = 0.0,
        push: FloatArray | None = None,
    ) -> FloatArray:
        """Return the virtual work (samples, n) of all forces on the basis functions.

        A `push` (3, samples, points) is the load beyond each Gauss point, times its weight.
        """
        at = self._state(q)
        motion = self._motion(at, q_dot, q_ddot, rate, rate_dot)
        _, _, force, moment = self._forces(at, motion, push)
        return self._work(at, q, q_dot, force, moment)

    def _work(
        self, at: _State, q: FloatArray, q_dot: FloatArray, force: FloatArray, moment: FloatArray
    ) -> FloatArray:
        own = self._own
        inner_force, inner_moment = turned_back(at.frame, force), turned_back(at.frame, moment)
        inner_moment[0] -= own.trapeze * (at.K[0] + own.twist) * inner_force[0]
        work = np.einsum("isp,ipk->sk", inner_moment, own.K)
        work += np.einsum("isp,ipk->sk", inner_force, own.Γ)
        return np.asarray(q + q_dot * self.functions.viscosity - work)

    def tangent(
        self,
        q: FloatArray,
        q_dot: FloatArray,
        q_ddot: FloatArray,
        rate: float | FloatArray,
        rate_dot: float | FloatArray = 0.0,
        push: FloatArray | None = None,
    ) -> Tangent:
        """Return the residual and its derivatives to q, q̇ and q̈ for (samples, n) coordinates."""
        at = self._state(q)
        motion = self._motion(at, q_dot, q_ddot, rate, rate_dot)
        pulled, rotary, force, moment = self._forces(at, motion, push)
        change = _Changes(self, at, motion, *self._clamp(rate, rate_dot))
        mass, damping, stiffness = change.matrices()
        stiffness += change.geometric(pulled, force, moment)
        n = self.size
        stiffness[:, range(n), range(n)] += 1.0
        damping[:, range(n), range(n)] += self.functions.viscosity
        residual = self._work(at, q, q_dot, force, moment)
        return Tangent(residual, stiffness, damping, mass)

    # What is read off the shape.

    def tip(self, q: FloatArray) -> FloatArray:
        """Return the tip's place r(1) in the root frame, (samples, 3)."""
        return np.asarray((self._state(q).slope @ self.weights).T)

    def places(self, q: FloatArray, x: FloatArray) -> FloatArray:
        """Return the places r of material points `x` of one state `q` (n,), (points, 3)."""
        slope = self._state(q[None]).slope[:, 0]
        return np.asarray(self.functions.grid.integral(x) @ slope.T)

    def changes(self, q: FloatArray, x: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return δr and δφ at material points `x` for changes of a state `q` (n,), (3, points, n)."""
        at, still = self._state(q[None]), np.zeros((1, self.size))
        change = _Changes(self, at, self._motion(at, still, still, 0.0, 0.0), *self._clamp(0.0, 0.0))
        onto = self.functions.grid.integral(x)
        return onto @ change.slope[:, 0], onto @ change.bend[:, 0]

    def refined(self) -> SpaceContinuum:
        """Return the discretization with half as many functions again, on every panel."""
        return SpaceContinuum(self.functions.refined())

    def kinetic_energy(self, q: FloatArray, q_dot: FloatArray) -> FloatArray:
        """Return the kinetic energy relative to the root frame, (samples,)."""
        at = self._state(q)
        none = np.zeros_like(q)
        motion = self._motion(at, q_dot, none, 0.0, 0.0)
        velocity = motion.velocity_m + cross(motion.spin_m, at.offset_m)
        return np.asarray(0.5 * self._energy(at, velocity, motion.spin_m))

    def amended_potential(self, q: FloatArray, rate: float) -> FloatArray:
        """Return V - T0, which with the kinetic energy is the Jacobi integral, (samples,)."""
        at = self._state(q)
        W, _, hub = self._clamp(rate, 0.0)
        carried = cross(W, hub + at.place_m + at.offset_m)
        spin = np.broadcast_to(W, carried.shape)
        return np.asarray(0.5 * np.sum(q**2, axis=-1) - 0.5 * self._energy(at, carried, spin))

    def _energy(self, at: _State, velocity: FloatArray, spin: FloatArray) -> FloatArray:
        energy = np.sum(velocity**2, axis=0) @ self._masses.mass
        return np.asarray(energy + np.sum(spin * self._inertia(at, spin), axis=(0, 2)))

    def displacements(self, q: FloatArray) -> tuple[FloatArray, FloatArray, Any]:
        """Return what coordinates move: δr_c and δφ at the masses (3, masses, n), and the masses.

        About one state `q` (n,).
        """
        at = self._state(q[None])
        none = np.zeros((1, self.size))
        change = _Changes(self, at, self._motion(at, none, none, 0.0, 0.0), *self._clamp(0.0, 0.0))
        return change.center[:, 0], change.turn_m[:, 0], self._masses


class _Changes:
    """Derivatives of all fields to q, q̇ and q̈: (3, samples, points, n).

    Each line of the motion once more, with δφ = Φ_k and δr' = U_k' for a change of coordinate k.
    """

    def __init__(
        self, model: SpaceContinuum, at: _State, motion: _Motion, W: Any, W_dot: Any, hub: Any
    ) -> None:
        own = model._own
        self._model, self._at, self._motion, self._W = model, at, motion, W[..., None]
        self._W_dot, self._place = W_dot[..., None], (hub + at.place_m)[..., None]
        frame = at.frame[..., None]
        Γ = np.broadcast_to(own.Γ[:, None], (3, len(at.K[0]), *own.Γ.shape[1:])).copy()
        if own.trapezes:
            Γ[0] -= (own.trapeze * (at.K[0] + own.twist))[..., None] * own.K[0]
        self.bend, self._stretch = turned(frame, own.K[:, None]), turned(frame, Γ)
        self.turn = self._inner(self.bend)
        self.turn_m = self._outer(self.bend)
        self.slope = cross(self.turn, at.slope[..., None]) + self._stretch
        self._place_m = self._outer(self.slope)
        self._offset = cross(self.turn_m, at.offset_m[..., None])
        self.center = self._place_m + self._offset

    def _inner(self, field: FloatArray) -> FloatArray:
        return np.asarray(self._model._inner @ field)

    def _outer(self, field: FloatArray) -> FloatArray:
        return np.asarray(self._model._outer @ field)

    def matrices(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return M, C and the part of K from accelerations, each (samples, n, n)."""
        masses = self._model._masses
        n = self._model.size
        parts = [(self.center, self.turn_m), self._of_rates(), self._of_places()]
        pulls = np.concatenate([pull for pull, _ in parts], axis=-1) * masses.mass[:, None]
        work = _contracted(self.center, pulls)
        if masses.turns:
            about = [self._model._inertia(self._at, self.turn_m), parts[1][1], parts[2][1]]
            work += _contracted(self.turn_m, np.concatenate(about, axis=-1))
        mass, damping, stiffness = (work[..., k * n : (k + 1) * n] for k in range(3))
        if masses.drag is not None:
            drag = masses.drag[:, None]
            damping = damping + _contracted(self._place_m, drag * self._place_m)
            stiffness = stiffness + _contracted(self._place_m, drag * self._of_velocity())
        return mass, damping.copy(), stiffness.copy()

    def _of_velocity(self) -> FloatArray:
        at, motion = self._at, self._motion
        spin = self._inner(cross(self.turn, motion.turning[..., None]))
        return self._outer(self._velocity_slope(spin, at, motion))

    def _velocity_slope(self, spin: FloatArray, at: _State, motion: _Motion) -> FloatArray:
        """Return δv' to q where the spin changes by `spin`."""
        slope = cross(spin, at.slope[..., None]) + cross(motion.spin[..., None], self.slope)
        slope += cross(self.turn, motion.stretching[..., None])
        return slope + self._shortening(motion.turning)

    def _shortening(self, turning: FloatArray) -> FloatArray | float:
        """Return the change -k² K̇1 Ψ1 R e1 of R Γ̇ with q."""
        own = self._model._own
        if not own.trapezes:
            return 0.0
        rate = turned_back(self._at.frame, turning)[0]
        shorter = -(own.trapeze * rate)[..., None] * own.K[0]
        return np.asarray(self._at.frame[:, 0, ..., None] * shorter)

    def _of_rates(self) -> tuple[FloatArray, FloatArray]:
        """Return the derivatives of A_c and of J α + ω × J ω to q̇."""
        at, motion, W = self._at, self._motion, self._W
        spin, turn = motion.spin[..., None], self.turn
        change = cross(turn, motion.turning[..., None]) + cross(spin, self.bend)
        slope = (
            cross(self._inner(change), at.slope[..., None])
            + cross(turn, cross(spin, at.slope[..., None]) + 2.0 * motion.stretching[..., None])
            + cross(spin, cross(turn, at.slope[..., None]) + 2.0 * self._stretch)
            + 2.0 * self._shortening(motion.turning)
        )
        total, offset = motion.total_spin[..., None], at.offset_m[..., None]
        about = self._outer(change) + cross(W, self.turn_m)
        pull = self._outer(slope) + 2.0 * cross(W, self._place_m) + cross(about, offset)
        pull += cross(self.turn_m, cross(total, offset)) + cross(total, self._offset)
        if not self._model._masses.turns:
            return pull, about
        inertia = self._model._inertia
        carried = inertia(at, motion.total_spin)[..., None]
        couple = inertia(at, about) + cross(self.turn_m, carried)
        return pull, couple + cross(total, inertia(at, self.turn_m))

    def _of_places(self) -> tuple[FloatArray, FloatArray]:
        """Return the derivatives of A_c and of J α + ω × J ω to q."""
        at, motion, W, W_dot = self._at, self._motion, self._W, self._W_dot
        turn, spin, slope = self.turn, motion.spin[..., None], at.slope[..., None]
        turning, stretching = motion.turning[..., None], motion.stretching[..., None]
        bent = cross(turn, turning)
        spins, spins_m = self._inner(bent), self._outer(bent)
        change = cross(turn, motion.twisting[..., None]) + cross(spins, turning) + cross(spin, bent)
        stretched = cross(turn, stretching) + self._shortening(motion.turning)
        pulled = (
            cross(self._inner(change), slope)
            + cross(motion.spin_rate[..., None], self.slope)
            + cross(spins, cross(spin, slope) + 2.0 * stretching)
            + cross(spin, cross(spins, slope) + cross(spin, self.slope) + 2.0 * stretched)
            + cross(turn, motion.speeding[..., None])
            + self._shortening(motion.twisting)
        )
        velocity = self._outer(cross(spins, slope) + cross(spin, self.slope) + stretched)
        about = self._outer(change) + cross(W, spins_m)
        total, offset = motion.total_spin[..., None], at.offset_m[..., None]
        pull = self._outer(pulled) + cross(W, 2.0 * velocity + cross(W, self._place_m))
        pull += cross(W_dot, self._place_m)
        pull += cross(about, offset) + cross(motion.total_spin_rate[..., None], self._offset)
        pull += cross(spins_m, cross(total, offset))
        pull += cross(total, cross(spins_m, offset) + cross(total, self._offset))
        if not self._model._masses.turns:
            return pull, about
        couple = self._turned_inertia(motion.total_spin_rate, about)
        couple += cross(spins_m, self._model._inertia(at, motion.total_spin)[..., None])
        return pull, couple + cross(total, self._turned_inertia(motion.total_spin, spins_m))

    def _turned_inertia(self, vector: FloatArray, change: FloatArray) -> FloatArray:
        """Return the change of R J Rᵀ y to q, where y changes by `change`."""
        inertia, turn = self._model._inertia, self.turn_m
        result = cross(turn, inertia(self._at, vector)[..., None])
        return np.asarray(result + inertia(self._at, change - cross(turn, vector[..., None])))

    def geometric(self, pulled: FloatArray, force: FloatArray, moment: FloatArray) -> FloatArray:
        """Return the part of K from forces that the basis functions turn into, (samples, n, n)."""
        at, own = self._at, self._model._own
        F, M = force[..., None], moment[..., None]
        # -(Φ_l × a_k) · M = -(a_k × M) · Φ_l
        work = -np.swapaxes(
            _contracted(self.turn, cross(self.bend, M) + cross(self._stretch, F)), 1, 2
        )
        work -= _contracted(self.turn, cross(self.slope, F))
        work += _contracted(self.turn_m, cross(self._offset, pulled[..., None]))
        if own.trapezes:
            along = own.trapeze * turned_back(at.frame, force)[0]
            work += np.einsum("pk,sp,pl->skl", own.K[0], along, own.K[0])
        return work


def _contracted(left: FloatArray, right: FloatArray) -> FloatArray:
    """Return Σ left_k · right_l over points: (samples, n, n') of (3, samples, points, n)."""
    one, other = (np.moveaxis(field, 0, 1) for field in (left, right))
    flat = [field.reshape(len(field), -1, field.shape[-1]) for field in (one, other)]
    return np.asarray(np.swapaxes(flat[0], 1, 2) @ flat[1])
