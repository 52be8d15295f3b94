"""Derivatives of the blade's fields to its coordinates, in closed form."""

from __future__ import annotations

from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from ...arrays import FloatArray
from .vectors import cross, turned, turned_back


class State(NamedTuple):
    """Fields (3, samples, points) on the grid, and at the masses, marked _m."""

    frame: FloatArray
    frame_m: FloatArray
    K: FloatArray
    slope: FloatArray  # r'
    place_m: FloatArray  # r
    offset_m: FloatArray  # ρ, from the line to the center of mass


class Rates(NamedTuple):
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


class Changes:
    """Derivatives of all fields to q, q̇ and q̈: (3, samples, points, n).

    Each line of the motion once more, with δφ = Φ_k and δr' = U_k' for a change of coordinate k.
    """

    def __init__(self, model: Any, at: State, motion: Rates, W: Any, W_dot: Any) -> None:
        own = model.strains
        self._model, self._at, self._motion, self._W = model, at, motion, W[..., None]
        self._W_dot = W_dot[..., None]
        frame = at.frame[..., None]
        gamma = np.broadcast_to(own.gamma[:, None], (3, len(at.K[0]), *own.gamma.shape[1:])).copy()
        if own.trapezes:
            gamma[0] -= (own.trapeze * (at.K[0] + own.twist))[..., None] * own.K[0]
        self.bend, self._stretch = turned(frame, own.K[:, None]), turned(frame, gamma)
        self.turn = self._inner(self.bend)
        self.turn_m = self._outer(self.bend)
        self.slope = cross(self.turn, at.slope[..., None]) + self._stretch
        self._place_m = self._outer(self.slope)
        self._offset = cross(self.turn_m, at.offset_m[..., None])
        self.center = self._place_m + self._offset

    def _inner(self, field: FloatArray) -> FloatArray:
        return np.asarray(self._model.inner @ field)

    def _outer(self, field: FloatArray) -> FloatArray:
        return np.asarray(self._model.outer @ field)

    def matrices(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return M, C and the part of K from accelerations, each (samples, n, n)."""
        masses = self._model.masses
        n = self._model.size
        parts = [(self.center, self.turn_m), self._of_rates(), self._of_places()]
        pulls = np.concatenate([pull for pull, _ in parts], axis=-1) * masses.mass[:, None]
        work = _contracted(self.center, pulls)
        if masses.turns:
            about = [self._model.inertia(self._at, self.turn_m), parts[1][1], parts[2][1]]
            work += _contracted(self.turn_m, np.concatenate(about, axis=-1))
        mass, damping, stiffness = (work[..., k * n : (k + 1) * n] for k in range(3))
        if masses.drag is not None:
            drag = masses.drag[:, None]
            damping = damping + _contracted(self._place_m, drag * self._place_m)
            stiffness = stiffness + _contracted(self._place_m, drag * self._velocity)
        return mass, damping.copy(), stiffness.copy()

    @cached_property
    def _bent(self) -> FloatArray:
        """The change of R K̇ with q, as R turns."""
        return cross(self.turn, self._motion.turning[..., None])

    @cached_property
    def _spins(self) -> FloatArray:
        """The change of the spin with q."""
        return self._inner(self._bent)

    @cached_property
    def _stretched(self) -> FloatArray:
        """The change of R Γ̇ with q."""
        motion = self._motion
        return cross(self.turn, motion.stretching[..., None]) + self._shortening(motion.turning)

    @cached_property
    def _velocity(self) -> FloatArray:
        """The change of the masses' velocity with q."""
        slope = cross(self._spins, self._at.slope[..., None]) + self._stretched
        return self._outer(slope + cross(self._motion.spin[..., None], self.slope))

    def _shortening(self, turning: FloatArray) -> FloatArray | float:
        """Return the change -k² K̇1 Ψ1 R e1 of R Γ̇ with q."""
        own = self._model.strains
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
        pull = self._outer(slope) + 2.0 * cross(W, self._place_m)
        if self._model.masses.whole_on_line:
            return pull, pull
        about = self._outer(change) + cross(W, self.turn_m)
        pull += cross(about, offset)
        pull += cross(self.turn_m, cross(total, offset)) + cross(total, self._offset)
        if not self._model.masses.turns:
            return pull, about
        inertia = self._model.inertia
        carried = inertia(at, motion.total_spin)[..., None]
        couple = inertia(at, about) + cross(self.turn_m, carried)
        return pull, couple + cross(total, inertia(at, self.turn_m))

    def _of_places(self) -> tuple[FloatArray, FloatArray]:
        """Return the derivatives of A_c and of J α + ω × J ω to q."""
        at, motion, W, W_dot = self._at, self._motion, self._W, self._W_dot
        turn, spin, slope = self.turn, motion.spin[..., None], at.slope[..., None]
        turning, stretching = motion.turning[..., None], motion.stretching[..., None]
        bent, spins, stretched = self._bent, self._spins, self._stretched
        change = cross(turn, motion.twisting[..., None]) + cross(spins, turning) + cross(spin, bent)
        pulled = (
            cross(self._inner(change), slope)
            + cross(motion.spin_rate[..., None], self.slope)
            + cross(spins, cross(spin, slope) + 2.0 * stretching)
            + cross(spin, cross(spins, slope) + cross(spin, self.slope) + 2.0 * stretched)
            + cross(turn, motion.speeding[..., None])
            + self._shortening(motion.twisting)
        )
        total, offset = motion.total_spin[..., None], at.offset_m[..., None]
        pull = self._outer(pulled) + cross(W, 2.0 * self._velocity + cross(W, self._place_m))
        pull += cross(W_dot, self._place_m)
        if self._model.masses.whole_on_line:
            return pull, pull
        spins_m = self._outer(bent)
        about = self._outer(change) + cross(W, spins_m)
        pull += cross(about, offset) + cross(motion.total_spin_rate[..., None], self._offset)
        pull += cross(spins_m, cross(total, offset))
        pull += cross(total, cross(spins_m, offset) + cross(total, self._offset))
        if not self._model.masses.turns:
            return pull, about
        couple = self._turned_inertia(motion.total_spin_rate, about)
        couple += cross(spins_m, self._model.inertia(at, motion.total_spin)[..., None])
        return pull, couple + cross(total, self._turned_inertia(motion.total_spin, spins_m))

    def _turned_inertia(self, vector: FloatArray, change: FloatArray) -> FloatArray:
        """Return the change of R J Rᵀ y to q, where y changes by `change`."""
        inertia, turn = self._model.inertia, self.turn_m
        result = cross(turn, inertia(self._at, vector)[..., None])
        return np.asarray(result + inertia(self._at, change - cross(turn, vector[..., None])))

    def geometric(self, pulled: FloatArray, force: FloatArray, moment: FloatArray) -> FloatArray:
        """Return the part of K from forces that the basis functions turn into, (samples, n, n)."""
        at, own = self._at, self._model.strains
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
