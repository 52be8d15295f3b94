"""What the coordinates of a node in space are, as `elements.node_kinds` has it for the plane.

The clamp turns about z, the normal of the plane, and holds what would leave the plane as well.
"""

from __future__ import annotations

import math
from typing import ClassVar

import numpy as np
from scipy.spatial.transform import Rotation as Turn

from analytic.arrays import FloatArray
from analytic.description import Described

from .state import SpaceState

_QUARTER_TURN = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 0.0]])
"""The generator of rotations about z."""

_HALF_TURN = np.array(
    [[0.0, 0.0, 0.0, -1.0], [0.0, 0.0, -1.0, 0.0], [0.0, 1.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0]]
)
"""What the unit vector along z makes of Euler parameters, as a quaternion from the left."""


class SpaceSlopeNodes(Described, abstract=True):
    """Nodes carry r and the slope r' of the axis; the clamp holds its direction."""

    quarter_turn: ClassVar[FloatArray] = np.kron(np.eye(2), _QUARTER_TURN)
    angles: ClassVar[FloatArray] = np.zeros(6)
    fixed_at_root: ClassVar[tuple[int, ...]] = (0, 1, 2)

    def clamp(self, angle: float) -> tuple[FloatArray, FloatArray]:
        """-sin θ x' + cos θ y' = 0 and z' = 0; the root may stretch."""
        gradient = np.zeros((2, 6))
        gradient[0, 3:5], gradient[1, 5] = (-math.sin(angle), math.cos(angle)), 1.0
        return gradient, np.zeros(2)

    def turned(self, coordinates: FloatArray, angle: FloatArray) -> FloatArray:
        """Return vectors (samples, nodes, 6), rates too, turned about z by angles (samples,)."""
        pairs = coordinates.reshape(*coordinates.shape[:-1], 2, 3)
        return _about_z(pairs, angle[:, None, None]).reshape(coordinates.shape)

    def coordinates(self, x: FloatArray, state: SpaceState) -> tuple[FloatArray, FloatArray]:
        """Positions and slopes, and their rates."""
        values = (x + state.u, state.v, state.w, 1.0 + state.u_slope, state.v_slope, state.w_slope)
        rates = (
            state.u_dot, state.v_dot, state.w_dot,
            state.u_slope_dot, state.v_slope_dot, state.w_slope_dot,
        )  # fmt: skip
        return np.stack(values, axis=1), np.stack(rates, axis=1)


class FrameNodes(Described, abstract=True):
    """Nodes carry r and the Euler parameters p of the section, whose first axis is its normal."""

    quarter_turn: ClassVar[FloatArray] = np.block(
        [[_QUARTER_TURN, np.zeros((3, 4))], [np.zeros((4, 3)), 0.5 * _HALF_TURN]]
    )
    angles: ClassVar[FloatArray] = np.zeros(7)
    fixed_at_root: ClassVar[tuple[int, ...]] = (0, 1, 2)

    def clamp(self, angle: float) -> tuple[FloatArray, FloatArray]:
        """Give p = (cos θ/2, 0, 0, sin θ/2), of which |p| = 1 holds one."""
        gradient = np.zeros((3, 7))
        gradient[0, 4] = gradient[1, 5] = 1.0
        gradient[2, 3], gradient[2, 6] = -math.sin(0.5 * angle), math.cos(0.5 * angle)
        return gradient, np.zeros(3)

    def turned(self, coordinates: FloatArray, angle: FloatArray) -> FloatArray:
        """Return r and p (samples, nodes, 7), rates too, turned about z by angles (samples,)."""
        half, p = 0.5 * angle[:, None, None], coordinates[..., 3:]
        return np.concatenate(
            (
                _about_z(coordinates[..., :3], angle[:, None]),
                np.cos(half) * p + np.sin(half) * (p @ _HALF_TURN.T),
            ),
            axis=-1,
        )

    def coordinates(self, x: FloatArray, state: SpaceState) -> tuple[FloatArray, FloatArray]:
        """Positions and p of a section turned by φ in the plane and tilted out of it by β.

        tan β = w'/|r'| of the planar r'.
        """
        slope = (1.0 + state.u_slope) + 1j * state.v_slope
        rate = state.u_slope_dot + 1j * state.v_slope_dot
        phi = np.angle(slope) - state.shear_angle
        phi_dot = (rate / slope).imag - state.shear_angle_dot
        tan = state.w_slope / np.abs(slope)
        tan_dot = state.w_slope_dot / np.abs(slope) - tan * (rate / slope).real
        beta, beta_dot = np.arctan(tan), tan_dot / (1.0 + tan**2)
        c, s, C, S = (f(0.5 * a) for a in (phi, beta) for f in (np.cos, np.sin))
        p = np.stack((c * C, s * S, -c * S, s * C), axis=1)
        by_phi = np.stack((-s * C, c * S, s * S, c * C), axis=1)
        by_beta = np.stack((-c * S, s * C, -c * C, -s * S), axis=1)
        p_dot = 0.5 * (phi_dot[:, None] * by_phi + beta_dot[:, None] * by_beta)
        r = np.stack((x + state.u, state.v, state.w), axis=1)
        r_dot = np.stack((state.u_dot, state.v_dot, state.w_dot), axis=1)
        return np.concatenate((r, p), axis=1), np.concatenate((r_dot, p_dot), axis=1)


def directors(p: FloatArray) -> FloatArray:
    """Return the rotations (..., 3, 3) of Euler parameters (..., 4), whatever their norm."""
    flat = Turn.from_quat(p.reshape(-1, 4)[:, [1, 2, 3, 0]]).as_matrix()
    return np.asarray(flat.reshape(*p.shape[:-1], 3, 3))


def turning_rate(p: FloatArray, p_dot: FloatArray) -> FloatArray:
    """Return the angular velocity (..., 3) by the axes of the section, 2 p* ∘ ṗ."""
    scalar, vector = p[..., :1], p[..., 1:]
    rate, turning = p_dot[..., :1], p_dot[..., 1:]
    return np.asarray(2.0 * (scalar * turning - rate * vector - np.cross(vector, turning)))


def _about_z(vectors: FloatArray, angle: FloatArray) -> FloatArray:
    """Return vectors (..., 3) turned about z by `angle` (...)."""
    seen = (vectors[..., 0] + 1j * vectors[..., 1]) * np.exp(1j * angle)
    return np.stack((seen.real, seen.imag, vectors[..., 2]), axis=-1)
