"""Kinds of nodes: how coordinates turn, which of them the clamp holds, and their values in a state.

The clamp turns about z, the normal of the plane of rotation.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import ClassVar

import numpy as np

from analytic import Blade
from analytic.arrays import FloatArray
from analytic.blade_checks import require_blade
from analytic.exact.continuum.planar_kinematics import in_plane_of_bending
from analytic.exact.continuum.state import BeamState
from analytic.lazily import spatial

from ..mesh import shapes
from .formulation import Formulation, cells

QUARTER_TURN = np.array([[0.0, -1.0], [1.0, 0.0]])
"""The generator of plane rotations: (x, y) becomes (-y, x)."""

ABOUT_Z = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 0.0]])
"""The generator of rotations about z; of (x, y, φ) too, to whose angle they add."""


_HALF_TURN = np.array(
    [[0.0, 0.0, 0.0, -1.0], [0.0, 0.0, -1.0, 0.0], [0.0, 1.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0]]
)
"""Product of the unit vector along z with Euler parameters, as a quaternion from the left."""


class SlopeNodes(Formulation, abstract=True):
    """Nodes carry r and the slope r' of the axis; the clamp holds its direction, not its length."""

    node: ClassVar[str] = "NodePoint2DSlope1"
    straight: ClassVar[tuple[float, ...]] = (0.0, 1.0, 0.0)
    quarter_turn: ClassVar[FloatArray] = np.kron(np.eye(2), QUARTER_TURN)
    angles: ClassVar[FloatArray] = np.zeros(4)
    clamped: ClassVar[tuple[int, ...]] = (3,)
    joint: ClassVar[tuple[int, ...]] = (1, 1, 0, 0, 0, 1)

    def coordinates(self, x: FloatArray, state: BeamState) -> tuple[FloatArray, FloatArray]:
        """Positions and slopes, (x + u, v, 1 + u', v') in the plane, and their rates."""
        axes = "uvw"[: self.dimensions]
        values = _columns(x, state, [*axes, *(f"{one}_slope" for one in axes)])
        values[:, 0] += x
        values[:, self.dimensions] += 1.0
        return values, _columns(x, state, [f"{a}{of}_dot" for of in ("", "_slope") for a in axes])

    def spread(self, nodes: int, elements: int, length: float, s: FloatArray) -> FloatArray:
        """Return the matrix to r and r' at `s`: cubic between two nodes, (places, n, nodes, n)."""
        count = nodes - 1
        cell, xi = cells(count, s)
        weights = np.zeros((s.size, 2, nodes, 2))
        of_both = np.stack([shapes(xi, length / count, order) for order in (0, 1)], axis=1)
        at, places = cell[:, None] + np.arange(2), np.arange(s.size)[:, None]
        weights[places, :, at] = np.moveaxis(of_both.reshape(-1, 2, 2, 2), 1, 2)
        both = np.einsum("sakb,ij->saikbj", weights, np.eye(self.dimensions))
        return np.asarray(both.reshape(s.size, self.angles.size, nodes, -1))


class SpaceSlopeNodes(SlopeNodes, abstract=True):
    """The same in space."""

    leaves_plane: ClassVar[bool] = True
    node: ClassVar[str] = "NodePointSlope1"
    straight: ClassVar[tuple[float, ...]] = (0.0, 0.0, 1.0, 0.0, 0.0)
    quarter_turn: ClassVar[FloatArray] = np.kron(np.eye(2), ABOUT_Z)
    angles: ClassVar[FloatArray] = np.zeros(6)
    clamped: ClassVar[tuple[int, ...]] = (4, 5)
    joint: ClassVar[tuple[int, ...]] = ()

    def root_moment(self, root: FloatArray, force: FloatArray) -> FloatArray:
        """Return the moment of a force on the slope."""
        return np.cross(root[:, 3:], force[:, 3:])

    def sections(self, coordinates: FloatArray) -> FloatArray:
        """Return sections whose second axis is in the plane of rotation: a cable has no twist."""
        slope = coordinates[..., 3:]
        across = np.cross([0.0, 0.0, 1.0], slope)
        normal, chord = (v / np.linalg.norm(v, axis=-1, keepdims=True) for v in (slope, across))
        return np.stack((normal, chord, np.cross(normal, chord)), axis=-1)


class SectionSlopeNodes(Formulation, abstract=True):
    """Nodes carry r and the slope r_y of the section; the clamp holds it, Eq. 14."""

    node: ClassVar[str] = "NodePoint2DSlope1"
    straight: ClassVar[tuple[float, ...]] = (0.0, 0.0, 1.0)
    quarter_turn: ClassVar[FloatArray] = np.kron(np.eye(2), QUARTER_TURN)
    angles: ClassVar[FloatArray] = np.zeros(4)
    clamped: ClassVar[tuple[int, ...]] = (2, 3)

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
    clamped: ClassVar[tuple[int, ...]] = (2,)
    joint: ClassVar[tuple[int, ...]] = (1, 1, 0, 0, 0, 1)

    def coordinates(self, x: FloatArray, state: BeamState) -> tuple[FloatArray, FloatArray]:
        """Positions and the angle of the section, and their rates."""
        angle, rate = _section_angle(state)
        values, rates = (x + state.u, state.v, angle), (state.u_dot, state.v_dot, rate)
        return np.stack(values, axis=1), np.stack(rates, axis=1)

    def sections(self, coordinates: FloatArray) -> FloatArray:
        """Return the sections, turned by φ."""
        return in_plane_of_bending(coordinates[..., 2], 0.0)


class FrameNodes(Formulation, abstract=True):
    """Nodes carry r and the Euler parameters p of the section, whose first axis is its normal."""

    leaves_plane: ClassVar[bool] = True
    twists: ClassVar[bool] = True
    constant_mass: ClassVar[bool] = False
    node: ClassVar[str] = "NodeRigidBodyEP"
    straight: ClassVar[tuple[float, ...]] = (0.0, 0.0, 1.0, 0.0, 0.0, 0.0)
    quarter_turn: ClassVar[FloatArray] = np.block(
        [[ABOUT_Z, np.zeros((3, 4))], [np.zeros((4, 3)), _HALF_TURN]]
    )
    pace: ClassVar[FloatArray] = np.array(3 * [1.0] + 4 * [0.5])
    angles: ClassVar[FloatArray] = np.zeros(7)
    joint: ClassVar[tuple[int, ...]] = (1, 1, 1, 1, 1, 1)

    def setting(self, blade: Blade) -> float:
        """All turns about z."""
        return 1.0

    def line_frame(self, blade: Blade) -> FloatArray:
        """Tilt the clamp out of the plane of rotation by the precone."""
        cone = blade.line.precone
        c, s = math.cos(cone), math.sin(cone)
        return np.array([[c, 0.0, -s], [0.0, 1.0, 0.0], [s, 0.0, c]])

    def held(self, root: FloatArray) -> FloatArray:
        """Return the three directions across p, p ∘ i and so on; |p| = 1 holds the fourth."""
        a, b, c, d = root[3:]
        across = np.array([[-b, a, d, -c], [-c, -d, a, b], [-d, c, -b, a]])
        return np.hstack((np.zeros((3, 3)), across))

    def root_moment(self, root: FloatArray, force: FloatArray) -> FloatArray:
        """Return the moment of a force on p, which a rotation δα changes by ½ δα ∘ p."""
        p, onto = root[:, 3:], force[:, 3:]
        scalar, vector = p[:, :1], p[:, 1:]
        about = scalar * onto[:, 1:] - onto[:, :1] * vector + np.cross(vector, onto[:, 1:])
        return np.asarray(0.5 * about)

    def coordinates(self, x: FloatArray, state: BeamState) -> tuple[FloatArray, FloatArray]:
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
        tilted = p[:, [2, 3, 0, 1]] * [1.0, 1.0, -1.0, -1.0]
        p_dot = 0.5 * (phi_dot[:, None] * (p @ _HALF_TURN.T) + beta_dot[:, None] * tilted)
        zero = np.zeros_like(x)
        r = np.stack((x + state.u, state.v, state.w + zero), axis=1)
        r_dot = np.stack((state.u_dot, state.v_dot, state.w_dot + zero), axis=1)
        return np.concatenate((r, p), axis=1), np.concatenate((r_dot, p_dot), axis=1)

    def sections(self, coordinates: FloatArray) -> FloatArray:
        """Return the axes of the sections."""
        return directors(coordinates[..., 3:])


def require_bare(element: Formulation, blade: Blade) -> None:
    """Refuse point masses, which Exudyn's elements in space do not have."""
    require_blade(blade)
    if blade.unit.masses:
        raise ValueError(
            f"element {element.name!r} carries no point masses, and this blade has "
            f"{blade.unit.differences}: take "
            f"{'an element of the plane, or ' if blade.is_planar else ''}analytic.spin_up_response"
        )


def _columns(x: FloatArray, state: BeamState, names: Sequence[str]) -> FloatArray:
    """Return parts of a state at the nodes `x`, (nodes, names)."""
    return np.stack([getattr(state, name) + np.zeros_like(x) for name in names], axis=1)


def _section_angle(state: BeamState) -> tuple[FloatArray, FloatArray]:
    """Return the angle [rad] of the section, (nodes,), and its rate [rad/s]."""
    along, across = 1.0 + state.u_slope, state.v_slope
    rate = (along * state.v_slope_dot - across * state.u_slope_dot) / (along**2 + across**2)
    return np.arctan2(across, along) - state.shear_angle, rate - state.shear_angle_dot


def directors(p: FloatArray) -> FloatArray:
    """Return the rotations (..., 3, 3) of Euler parameters (..., 4), whatever their norm."""
    flat = spatial.transform.Rotation.from_quat(p.reshape(-1, 4)[:, [1, 2, 3, 0]]).as_matrix()
    return np.asarray(flat.reshape(*p.shape[:-1], 3, 3))


def turning_rate(p: FloatArray, p_dot: FloatArray) -> FloatArray:
    """Return the angular velocity (..., 3) by the axes of the section, 2 p* ∘ ṗ."""
    scalar, vector = p[..., :1], p[..., 1:]
    rate, turning = p_dot[..., :1], p_dot[..., 1:]
    return np.asarray(2.0 * (scalar * turning - rate * vector - np.cross(vector, turning)))
