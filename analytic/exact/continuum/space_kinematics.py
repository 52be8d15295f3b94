"""Shapes of the blade in space and their motion: from strains to frames, places and rates."""

from __future__ import annotations

from functools import cached_property
from typing import Any

import numpy as np

from ...arrays import FloatArray
from .basis import StrainFunctions
from .changes import Rates, State
from .span import Span
from .state import Driven
from .vectors import Frames, cross, turned, turned_back


class SpaceKinematics:
    """Strains, frames and places of coordinates q, with the symbols of `space`.

    Samples in time come first in the coordinates (samples, n).
    """

    def __init__(self, functions: StrainFunctions) -> None:
        self.functions = functions
        self.families, self.size = functions.families, functions.size
        self.blade = functions.blade
        grid, masses = functions.grid, functions.masses
        self.points, self.weights = grid.points, grid.weights
        self.integrals = self.blade.running(grid, masses.places[grid.points.size :])
        self._frames = Frames(self.integrals, self.blade.kinks)
        self.masses = masses
        self.strains = functions.on_grid
        self._spans = dict[tuple[float, ...], Span]()
        self.outboard = {"length": self.weights * (1.0 - self.points), "tip": self.weights}

    def at_points(self, field: FloatArray) -> FloatArray:
        """Return the part at the grid's points of a field at the masses, (..., points)."""
        return field[..., : self.points.size]

    def _strains(self, q: FloatArray, at: Any = None) -> tuple[FloatArray, FloatArray]:
        """Return Γ and K, (3, samples, points)."""
        strains = at or self.strains
        K = strains.initial[:, None] + q @ strains.K.swapaxes(1, 2)
        gamma = q @ strains.gamma.swapaxes(1, 2)
        gamma[0] += 1.0 - 0.5 * strains.trapeze * (K[0] ** 2 + 2.0 * strains.twist * K[0])
        return gamma, K

    def _rates(
        self, K: FloatArray, q_dot: FloatArray, at: Any = None
    ) -> tuple[FloatArray, FloatArray]:
        """Return Γ̇ and K̇ of coordinates that change by q̇; of any small change of q as well."""
        strains = at or self.strains
        change = q_dot @ strains.K.swapaxes(1, 2)
        gamma = q_dot @ strains.gamma.swapaxes(1, 2)
        gamma[0] -= strains.trapeze * (K[0] + strains.twist) * change[0]
        return gamma, change

    def _state(self, q: FloatArray) -> State:
        gamma, K = self._strains(q)
        frame_m = self._frames.of(K)
        frame = self.at_points(frame_m)
        slope = turned(frame, gamma)
        return State(
            frame, frame_m, K, slope, self.integrals.of(slope),
            turned(frame_m, self.masses.offset[:, None]),
        )  # fmt: skip

    def clamp(self, by: Driven) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return W, Ẇ and the clamp's place h from the axis of rotation, (3, samples, 1)."""
        if by.clamp is not None:
            moved: tuple[FloatArray, FloatArray, FloatArray] = by.clamp
            return moved
        axis, hub = self.blade.axis[:, None, None], self.blade.clamp[:, None, None]
        w, w_dot = (np.atleast_1d(np.asarray(x, dtype=float))[:, None] for x in by[:2])
        return axis * w, axis * w_dot, hub

    def _motion(self, at: State, q_dot: FloatArray, q_ddot: FloatArray, by: Driven) -> Rates:
        integral = self.integrals.of
        stretch, bend = self._rates(at.K, q_dot)
        stretch_rate, bend_rate = self._rates(at.K, q_ddot)
        stretch_rate[0] -= self.strains.trapeze * bend[0] ** 2
        turning, stretching = turned(at.frame, bend), turned(at.frame, stretch)
        twisting, speeding = turned(at.frame, bend_rate), turned(at.frame, stretch_rate)
        spin_m = integral(turning)
        spin = self.at_points(spin_m)
        velocity_m = integral(cross(spin, at.slope) + stretching)
        spin_rate_m = integral(twisting + cross(spin, turning))
        spin_rate = self.at_points(spin_rate_m)
        acceleration = integral(
            cross(spin_rate, at.slope)
            + cross(spin, cross(spin, at.slope) + 2.0 * stretching)
            + speeding
        )
        W, W_dot, hub = self.clamp(by)
        place = hub + at.place_m
        total = spin_m + W
        total_rate = spin_rate_m + cross(W, spin_m) + W_dot
        acceleration = (
            acceleration
            + cross(W, 2.0 * velocity_m + cross(W, place))
            + cross(W_dot, place)
            + cross(total_rate, at.offset_m)
            + cross(total, cross(total, at.offset_m))
        )
        whole = self.masses.whole
        turn = spin_m + whole * W
        turn_rate = spin_rate_m + whole * (total_rate - spin_rate_m)
        return Rates(
            turning, stretching, spin, spin_m, velocity_m, spin_rate, total, total_rate,
            turn, turn_rate, acceleration, twisting, speeding,
        )  # fmt: skip

    def velocities(self, q: FloatArray, q_dot: FloatArray, by: Driven) -> list[FloatArray]:
        """Return velocities and spins at the masses, (3, samples, masses) in the frame's axes.

        Of the line and of its sections in space, of what has inertia against rotation, and of the
        clamp.
        """
        at = self._state(q)
        motion = self._motion(at, q_dot, np.zeros_like(q), by)
        W, _, hub = self.clamp(by)
        velocity = motion.velocity_m + cross(W, hub + at.place_m)
        kinds = (velocity, motion.total_spin, motion.turn, W)
        return [turned_back(at.frame_m, one) for one in kinds]

    def hung(self, q: FloatArray, by: Driven) -> tuple[FloatArray, FloatArray]:
        """Return where masses are on the line, from the axis, and frames, (3, ..., masses)."""
        at = self._state(q)
        return self.clamp(by)[2] + at.place_m, at.frame_m

    def tip(self, q: FloatArray) -> FloatArray:
        """Return the tip's place r(1) in the root frame, (samples, 3)."""
        return np.asarray((self._state(q).slope @ self.weights).T)

    @cached_property
    def _to_tip(self) -> Frames:
        return Frames(self.blade.running(self.functions.grid, np.ones(1)), self.blade.kinks)

    def _tip_frame(self, q: FloatArray) -> FloatArray:
        return self._to_tip.of(self._strains(q)[1])[..., -1]

    @cached_property
    def _unloaded_tip(self) -> FloatArray:
        return self._tip_frame(np.zeros((1, self.size)))[..., 0]

    def tip_turn(self, q: FloatArray) -> FloatArray:
        """Return how far the load turns the tip's section out of its upright, (samples,)."""
        turn = np.einsum("iks,jk->sij", self._tip_frame(q), self._unloaded_tip)
        return np.asarray(np.arctan2(turn[:, 2, 1], turn[:, 2, 2]))

    def tip_rate(self, q: FloatArray, q_dot: FloatArray) -> FloatArray:
        """Return the tip's velocity in the root frame, (samples, 3)."""
        at = self._state(q)
        stretch, bend = self._rates(at.K, q_dot)
        spin = self.at_points(self.integrals.of(turned(at.frame, bend)))
        return np.asarray(((cross(spin, at.slope) + turned(at.frame, stretch)) @ self.weights).T)

    def places(self, q: FloatArray, x: FloatArray) -> FloatArray:
        """Return the places r of material points `x` in the root frame, (samples, points, 3)."""
        return np.moveaxis(self._state(q).slope @ self.functions.grid.integral(x).T, 0, -1)

    def standing(self, q: FloatArray, x: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return places (samples, points, 3) and sections (samples, points, 3, 3) of points `x`.

        In the root frame; axes of sections in columns.
        """
        sections = np.einsum("ijsp,jkp->spik", self._frame_at(q, x), self.blade.section_frames(x))
        return self.places(q, x), sections

    def _frame_at(self, q: FloatArray, x: FloatArray) -> FloatArray:
        to_x = Frames(self.blade.running(self.functions.grid, x), self.blade.kinks)
        return to_x.of(self._strains(q)[1])[..., self.points.size :]

    def slopes(
        self, q: FloatArray, q_dot: FloatArray, x: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Return the derivatives of places to `x`, (samples, points, 3), and their rates."""
        strains, frame, K = self.functions.at(x), self._frame_at(q, x), self._strains(q)[1]
        gamma, bend = self._strains(q, strains)
        turning = turned(self._state(q).frame, self._rates(K, q_dot)[1])
        spin = turning @ self.functions.grid.integral(x).T
        slope = turned(frame, gamma)
        rate = cross(spin, slope) + turned(frame, self._rates(bend, q_dot, strains)[0])
        return np.moveaxis(slope, 0, -1), np.moveaxis(rate, 0, -1)
