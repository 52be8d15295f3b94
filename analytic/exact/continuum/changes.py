"""Derivatives of the blade's fields to its coordinates, in closed form."""

from __future__ import annotations

from collections.abc import Callable
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
    turn: FloatArray  # Ω, of which masses have inertia: in space, or relative to b
    turn_rate: FloatArray
    acceleration: FloatArray  # A_c, in space
    twisting: FloatArray  # R K̈
    speeding: FloatArray  # R Γ̈


class Changes:
    """Derivatives of all fields to q, q̇ and q̈: (3, samples, n, points).

    Each line of the motion once more, with δφ = Φ_k and δr' = U_k' for a change of coordinate k.
    """

    def __init__(self, model: Any, at: State, motion: Rates, W: Any, W_dot: Any) -> None:
        strains = model.strains
        # The same for all coordinates.
        at = State(*(field[..., None, :] for field in at))
        motion = Rates(*(field[..., None, :] for field in motion))
        self._model, self._at, self._motion = model, at, motion
        self._whole = model.masses.whole
        self._W, self._W_dot = W[..., None], W_dot[..., None]
        self._integral: Callable[[FloatArray], FloatArray] = model.integrals.of
        self._K = strains.K.swapaxes(1, 2)
        gamma = np.repeat(strains.gamma.swapaxes(1, 2)[:, None], len(at.K[0]), axis=1)
        if strains.trapezes:
            gamma[0] -= strains.trapeze * (at.K[0] + strains.twist) * self._K[0]
        self.bend, self._stretch = turned(at.frame, self._K[:, None]), turned(at.frame, gamma)
        self.turn_m = self._integral(self.bend)
        self.turn = model.at_points(self.turn_m)
        self.slope = cross(self.turn, at.slope) + self._stretch
        self._place_m = self._integral(self.slope)
        self._offset = cross(self.turn_m, at.offset_m)
        self.center = self._place_m + self._offset

    def matrices(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return M, C and the part of K from accelerations, each (samples, n, n)."""
        masses = self._model.masses
        velocity, *of_places = self._of_places()
        parts = [(self.center, self.turn_m), self._of_rates(), of_places]
        heavy = masses.mass * self.center
        mass, damping, stiffness = (_contracted(heavy, pull) for pull, _ in parts)
        if masses.turns:
            mass += _contracted(self.turn_m, self._turning)
            damping += _contracted(self.turn_m, parts[1][1])
            stiffness += _contracted(self.turn_m, parts[2][1])
        if masses.drag is not None:
            dragged = masses.drag * self._place_m
            damping += _contracted(dragged, self._place_m)
            stiffness += _contracted(dragged, velocity)
        return mass, damping, stiffness

    def _in_space(self, *, carried: bool = False) -> FloatArray:
        """Return R A Rᵀ or R C Rᵀ, (3, 3, samples, 1, masses)."""
        parts = [
            self._model.inertia(self._at, unit, carried=carried)
            for unit in np.eye(3)[:, :, None, None, None]
        ]
        return np.stack(parts, axis=1)

    @cached_property
    def _inertia(self) -> FloatArray:
        return self._in_space()

    @cached_property
    def _turning(self) -> FloatArray:
        """R A Rᵀ Φ."""
        return turned(self._inertia, self.turn_m)

    def _shortening(self, turning: FloatArray) -> FloatArray | float:
        """Return the change -k² K̇1 Ψ1 R e1 of R Γ̇ with q."""
        strains = self._model.strains
        if not strains.trapezes:
            return 0.0
        rate = turned_back(self._at.frame, turning)[0]
        return np.asarray(self._at.frame[:, 0] * (-strains.trapeze * rate * self._K[0]))

    def _of_rates(self) -> tuple[FloatArray, FloatArray]:
        """Return the derivatives of A_c and of A α + Ω × A Ω to q̇."""
        at, motion, W = self._at, self._motion, self._W
        spin, turn = motion.spin, self.turn
        change = self._integral(cross(turn, motion.turning) + cross(spin, self.bend))
        slope = (
            cross(self._model.at_points(change), at.slope)
            + cross(turn, cross(spin, at.slope) + 2.0 * motion.stretching)
            + cross(spin, self.slope + self._stretch)
            + 2.0 * self._shortening(motion.turning)
        )
        total, offset = motion.total_spin, at.offset_m
        pull = self._integral(slope) + 2.0 * cross(W, self._place_m)
        if self._model.masses.whole_on_line:
            return pull, pull
        about = change + cross(W, self.turn_m)
        pull += cross(about, offset)
        pull += cross(self.turn_m, cross(total, offset)) + cross(total, self._offset)
        about = change + self._whole * cross(W, self.turn_m)
        couple = cross(self.turn_m, turned(self._inertia, motion.turn))
        return pull, couple + turned(self._inertia, about) + cross(motion.turn, self._turning)

    def _of_places(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return the derivatives of ṙ, A_c and A α + Ω × A Ω + W × C W to q."""
        at, motion, W, W_dot = self._at, self._motion, self._W, self._W_dot
        turn, spin, slope = self.turn, motion.spin, at.slope
        turning, stretching = motion.turning, motion.stretching
        # Changes of R K̇ and R Γ̇, as R turns and the axis shortens, of the spin and of ṙ'.
        bent = cross(turn, turning)
        stretched = cross(turn, stretching) + self._shortening(turning)
        spins_m = self._integral(bent)
        spins = self._model.at_points(spins_m)
        slope_rate = cross(spins, slope) + cross(spin, self.slope) + stretched
        velocity = self._integral(slope_rate)
        change = self._integral(
            cross(turn, motion.twisting) + cross(spins, turning) + cross(spin, bent)
        )
        pulled = (
            cross(self._model.at_points(change), slope)
            + cross(motion.spin_rate, self.slope)
            + cross(spins, cross(spin, slope) + 2.0 * stretching)
            + cross(spin, slope_rate + stretched)
            + cross(turn, motion.speeding)
            + self._shortening(motion.twisting)
        )
        total, offset = motion.total_spin, at.offset_m
        pull = self._integral(pulled) + cross(W, 2.0 * velocity + cross(W, self._place_m))
        pull += cross(W_dot, self._place_m)
        if self._model.masses.whole_on_line:
            return velocity, pull, pull
        about = change + cross(W, spins_m)
        pull += cross(about, offset) + cross(motion.total_spin_rate, self._offset)
        pull += cross(spins_m, cross(total, offset))
        pull += cross(total, cross(spins_m, offset) + cross(total, self._offset))
        about = change + self._whole * cross(W, spins_m)
        couple = self._turned(self._inertia, motion.turn_rate, about)
        couple += cross(spins_m, turned(self._inertia, motion.turn))
        couple += cross(motion.turn, self._turned(self._inertia, motion.turn, spins_m))
        if self._model.masses.carried.any():
            couple += cross(W, self._turned(self._in_space(carried=True), W, 0.0))
        return velocity, pull, couple

    def _turned(
        self, inertia: FloatArray, vector: FloatArray, change: FloatArray | float
    ) -> FloatArray:
        """Return the change to q of an inertia times y, where y changes by `change`."""
        turn = self.turn_m
        result = cross(turn, turned(inertia, vector))
        return np.asarray(result + turned(inertia, change - cross(turn, vector)))

    def geometric(self, pulled: FloatArray, force: FloatArray, moment: FloatArray) -> FloatArray:
        """Return the part of K from forces that the basis functions turn into, (samples, n, n)."""
        at, strains = self._at, self._model.strains
        F, M = force[..., None, :], moment[..., None, :]
        # -(Φ_l × a_k) · M = -(a_k × M) · Φ_l
        work = -np.swapaxes(
            _contracted(self.turn, cross(self.bend, M) + cross(self._stretch, F)), 1, 2
        )
        work -= _contracted(self.turn, cross(self.slope, F))
        work += _contracted(self.turn_m, cross(self._offset, pulled[..., None, :]))
        if strains.trapezes:
            along = strains.trapeze * turned_back(at.frame, F)[0]
            work += (along * self._K[0]) @ strains.K[0]
        return work

    def following(self, integral: Callable[[FloatArray], FloatArray], acting: FloatArray) -> Any:
        """Return the change to q of the work of a load that turns with the sections it acts on.

        As (samples, n, n), from force and moment (3, 2, samples, places), and the integral up to
        these places.
        """
        place, turn = integral(self.slope), integral(self.bend)
        force, moment = np.moveaxis(acting[..., None, :], 1, 0)
        work = _contracted(place, cross(turn, force))
        return work + _contracted(turn, cross(turn, moment))


def _contracted(left: FloatArray, right: FloatArray) -> FloatArray:
    """Return Σ left_k · right_l over points: (samples, n, n) of (3, samples, n, points)."""
    return np.asarray(np.sum(left @ np.swapaxes(right, 2, 3), axis=0))
