"""Kinds of nodes: how coordinates turn, which of them the clamp holds, and their values in a state.

The clamp turns about z, the normal of the plane, and in space holds what would leave the plane.
"""

from __future__ import annotations

import math
from typing import Any, ClassVar

import numpy as np

from analytic import BeamState
from analytic.arrays import FloatArray

from .formulation import Formulation

QUARTER_TURN = np.array([[0.0, -1.0], [1.0, 0.0]])
"""The generator of plane rotations: (x, y) becomes (-y, x)."""

ABOUT_Z = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 0.0]])
"""The generator of rotations about z; of (x, y, φ) too, to whose angle they add."""


class _PlaneNodes(Formulation, abstract=True):
    """Nodes carry r and a vector of two; the clamp holds r."""

    node: ClassVar[str] = "NodePoint2DSlope1"
    quarter_turn: ClassVar[FloatArray] = np.kron(np.eye(2), QUARTER_TURN)
    angles: ClassVar[FloatArray] = np.zeros(4)
    fixed_at_root: ClassVar[tuple[int, ...]] = (0, 1)


class SlopeNodes(_PlaneNodes, abstract=True):
    """Nodes carry r and the slope r' of the axis; the clamp holds its direction."""

    straight: ClassVar[tuple[float, ...]] = (0.0, 1.0, 0.0)

    def clamp(self, angle: float) -> tuple[FloatArray, FloatArray]:
        """-sin θ x' + cos θ y' = 0; no more, for the root may stretch."""
        return np.array([[0.0, 0.0, -math.sin(angle), math.cos(angle)]]), np.zeros(1)

    def coordinates(self, x: FloatArray, state: BeamState) -> tuple[FloatArray, FloatArray]:
        """Positions and slopes, (x + u, v, 1 + u', v'), and their rates."""
        values = (x + state.u, state.v, 1.0 + state.u_slope, state.v_slope)
        rates = (state.u_dot, state.v_dot, state.u_slope_dot, state.v_slope_dot)
        return np.stack(values, axis=1), np.stack(rates, axis=1)


class SectionSlopeNodes(_PlaneNodes, abstract=True):
    """Nodes carry r and the slope r_y of the section; the clamp holds its direction."""

    straight: ClassVar[tuple[float, ...]] = (0.0, 0.0, 1.0)

    def clamp(self, angle: float) -> tuple[FloatArray, FloatArray]:
        """r_y = (-sin θ, cos θ), Eq. 14: the section at the root neither turns nor stretches."""
        return np.eye(4)[2:], np.array([-math.sin(angle), math.cos(angle)])

    def coordinates(self, x: FloatArray, state: BeamState) -> tuple[FloatArray, FloatArray]:
        """Positions and r_y = (-sin φ, cos φ), and their rates."""
        angle, rate = _section_angle(state)
        sine, cosine = np.sin(angle), np.cos(angle)
        values = (x + state.u, state.v, -sine, cosine)
        rates = (state.u_dot, state.v_dot, -rate * cosine, -rate * sine)
        return np.stack(values, axis=1), np.stack(rates, axis=1)


class AngleNodes(Formulation, abstract=True):
    """Nodes carry r and the angle φ of the section; the clamp holds it."""

    node: ClassVar[str] = "NodeRigidBody2D"
    straight: ClassVar[tuple[float, ...]] = (0.0, 0.0)
    quarter_turn: ClassVar[FloatArray] = ABOUT_Z
    angles: ClassVar[FloatArray] = np.array([0.0, 0.0, 1.0])
    fixed_at_root: ClassVar[tuple[int, ...]] = (0, 1)

    def clamp(self, angle: float) -> tuple[FloatArray, FloatArray]:
        """φ = θ: the root's angle is a coordinate."""
        return np.array([[0.0, 0.0, 1.0]]), np.array([angle])

    def coordinates(self, x: FloatArray, state: BeamState) -> tuple[FloatArray, FloatArray]:
        """Positions and the angle of the section, and their rates."""
        angle, rate = _section_angle(state)
        values, rates = (x + state.u, state.v, angle), (state.u_dot, state.v_dot, rate)
        return np.stack(values, axis=1), np.stack(rates, axis=1)


class SpaceSlopeNodes(Formulation, abstract=True):
    """Nodes in space carry r and the slope r' of the axis; the clamp holds its direction."""

    leaves_plane: ClassVar[bool] = True
    node: ClassVar[str] = "NodePointSlope1"
    straight: ClassVar[tuple[float, ...]] = (0.0, 0.0, 1.0, 0.0, 0.0)
    quarter_turn: ClassVar[FloatArray] = np.kron(np.eye(2), ABOUT_Z)
    angles: ClassVar[FloatArray] = np.zeros(6)
    fixed_at_root: ClassVar[tuple[int, ...]] = (0, 1, 2)

    def clamp(self, angle: float) -> tuple[FloatArray, FloatArray]:
        """-sin θ x' + cos θ y' = 0 and z' = 0; the root may stretch."""
        gradient = np.zeros((2, 6))
        gradient[0, 3:5], gradient[1, 5] = (-math.sin(angle), math.cos(angle)), 1.0
        return gradient, np.zeros(2)

    def coordinates(self, x: FloatArray, state: Any) -> tuple[FloatArray, FloatArray]:
        """Positions and slopes, and their rates."""
        values = (x + state.u, state.v, state.w, 1.0 + state.u_slope, state.v_slope, state.w_slope)
        rates = (
            state.u_dot, state.v_dot, state.w_dot,
            state.u_slope_dot, state.v_slope_dot, state.w_slope_dot,
        )  # fmt: skip
        return np.stack(values, axis=1), np.stack(rates, axis=1)


def _section_angle(state: BeamState) -> tuple[FloatArray, FloatArray]:
    """Return the angle [rad] of the section, (nodes,), and its rate [rad/s]."""
    along, across = 1.0 + state.u_slope, state.v_slope
    rate = (along * state.v_slope_dot - across * state.u_slope_dot) / (along**2 + across**2)
    return np.arctan2(across, along) - state.shear_angle, rate - state.shear_angle_dot
