"""Kinds of nodes: how coordinates turn, which of them the clamp holds, and their values in a state.

The clamp turns about z, the normal of the plane of rotation.
"""

from __future__ import annotations

import math
from typing import ClassVar

import numpy as np

from analytic import Blade
from analytic.arrays import FloatArray
from analytic.blade_checks import require_blade
from analytic.exact.continuum.planar_kinematics import in_plane_of_bending
from analytic.exact.continuum.state import BladeState
from analytic.exact.continuum.unit import space_unit
from analytic.lazily import spatial

from ..mesh import cells, shapes
from .formulation import Formulation

QUARTER_TURN = np.array([[0.0, -1.0], [1.0, 0.0]])
"""The generator of plane rotations: (x, y) becomes (-y, x)."""

ABOUT_Z = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 0.0]])
"""The generator of rotations about z; of (x, y, φ) too, to whose angle they add."""


_HALF_TURN = np.array(
    [[0.0, 0.0, 0.0, -1.0], [0.0, 0.0, -1.0, 0.0], [0.0, 1.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0]]
)
"""Product of the unit vector along z with Euler parameters, as a quaternion from the left."""


_ON_CENTER = 1e-9  # of the length


class SlopeNodes(Formulation, abstract=True):
    """Nodes carry r and the slope r' of the axis; the clamp holds its direction, not its length."""

    node: ClassVar[str] = "NodePoint2DSlope1"
    straight: ClassVar[tuple[float, ...]] = (0.0, 1.0, 0.0)
    quarter_turn: ClassVar[FloatArray] = np.kron(np.eye(2), QUARTER_TURN)
    angles: ClassVar[FloatArray] = np.zeros(4)
    clamped: ClassVar[tuple[int, ...]] = (3,)
    joint: ClassVar[tuple[int, ...]] = (1, 1, 0, 0, 0, 1)

    def coordinates(self, state: BladeState) -> tuple[FloatArray, FloatArray]:
        """Places and slopes, and their rates."""
        d = self.dimensions
        values = np.hstack((state.place[:, :d], state.slope[:, :d]))
        return values, np.hstack((state.velocity[:, :d], state.slope_rate[:, :d]))

    def spread(self, places: FloatArray, elements: int, s: FloatArray) -> FloatArray:
        """Return the matrix to r and r' at `s`: cubic between two nodes, (places, n, nodes, n)."""
        cell, xi = cells(places, s)
        weights = np.zeros((s.size, 2, places.size, 2))
        length = np.diff(places)[cell]
        of_both = np.stack([shapes(xi, length, order) for order in (0, 1)], axis=1)
        at, rows = cell[:, None] + np.arange(2), np.arange(s.size)[:, None]
        weights[rows, :, at] = np.moveaxis(of_both.reshape(-1, 2, 2, 2), 1, 2)
        both = np.einsum("sakb,ij->saikbj", weights, np.eye(self.dimensions))
        return np.asarray(both.reshape(s.size, self.angles.size, places.size, -1))


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

    def coordinates(self, state: BladeState) -> tuple[FloatArray, FloatArray]:
        """Places and r_y, the second axis of the section, and their rates."""
        across = state.section[:, :, 1]
        rate = np.cross(state.spin, across)
        values = np.hstack((state.place[:, :2], across[:, :2]))
        return values, np.hstack((state.velocity[:, :2], rate[:, :2]))


class AngleNodes(Formulation, abstract=True):
    """Nodes carry r and the angle φ of the section; the clamp holds it."""

    node: ClassVar[str] = "NodeRigidBody2D"
    straight: ClassVar[tuple[float, ...]] = (0.0, 0.0)
    quarter_turn: ClassVar[FloatArray] = ABOUT_Z
    angles: ClassVar[FloatArray] = np.array([0.0, 0.0, 1.0])
    clamped: ClassVar[tuple[int, ...]] = (2,)
    joint: ClassVar[tuple[int, ...]] = (1, 1, 0, 0, 0, 1)

    def coordinates(self, state: BladeState) -> tuple[FloatArray, FloatArray]:
        """Places and the angle of the section, and their rates."""
        angle = np.arctan2(state.section[:, 1, 0], state.section[:, 0, 0])
        values = np.column_stack((state.place[:, :2], angle))
        return values, np.column_stack((state.velocity[:, :2], state.spin[:, 2]))

    def sections(self, coordinates: FloatArray) -> FloatArray:
        """Return the sections, turned by φ."""
        return in_plane_of_bending(coordinates[..., 2], 0.0)


class FrameNodes(Formulation, abstract=True):
    """Nodes carry r and the Euler parameters p of the section, whose first axis is its normal."""

    leaves_plane: ClassVar[bool] = True
    takes_wrenches: ClassVar[bool] = True
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
        about = scalar * onto[:, 1:] - onto[:, :1] * vector + cross(vector, onto[:, 1:])
        return np.asarray(0.5 * about)

    def coordinates(self, state: BladeState) -> tuple[FloatArray, FloatArray]:
        """Places and p, and their rates, ṗ = ½ ω ∘ p."""
        p = spatial.transform.Rotation.from_matrix(state.section).as_quat()[:, [3, 0, 1, 2]]
        p *= np.where(p[:, :1] < 0.0, -1.0, 1.0)
        scalar, vector = p[:, :1], p[:, 1:]
        along = -np.sum(state.spin * vector, axis=1, keepdims=True)
        p_dot = 0.5 * np.hstack((along, scalar * state.spin + cross(state.spin, vector)))
        return np.hstack((state.place, p)), np.hstack((state.velocity, p_dot))

    def sections(self, coordinates: FloatArray) -> FloatArray:
        """Return the axes of the sections."""
        return directors(coordinates[..., 3:])

    def line(self, arms: FloatArray, *state: FloatArray) -> FloatArray:
        """Return coordinates, or also of rates these, less those of the arms."""
        p, result = state[0][..., 3:], state[-1].copy()
        if len(state) > 1:
            arms = cross(turning_rate(p, state[1][..., 3:]), arms)
        result[..., :3] -= (directors(p) @ arms[..., None])[..., 0]
        return result

    def onto_nodes(
        self, arms: FloatArray, coordinates: FloatArray, forces: FloatArray
    ) -> FloatArray:
        """Return forces and the torques of their arms."""
        p, result = coordinates[..., 3:], forces.copy()
        local = (np.swapaxes(directors(p), -1, -2) @ forces[..., :3, None])[..., 0]
        result[..., 3:] += onto_parameters(p, cross(local, arms))
        return result

    def torques(self, coordinates: FloatArray, moments: FloatArray) -> FloatArray:
        """Return forces on the Euler parameters."""
        p = coordinates[..., 3:]
        local = np.swapaxes(directors(p), -1, -2) @ moments[..., None]
        return onto_parameters(p, local[..., 0])


def require_light(element: Formulation, blade: Blade) -> None:
    """Refuse point masses that turn with their section: nodes in space have a mass alone.

    The nodes are at the centers of mass of the sections.
    """
    require_blade(blade)
    for one in blade.point_masses:
        center = space_unit(blade).inertia_about(
            np.array([one.position / blade.length]), blade.slenderness
        )[0]
        away = math.hypot(*(np.array(one.offset) - blade.length * center[1:, 0]))
        if one.inertia or away > _ON_CENTER * blade.length:
            what = f"has an inertia of {one.inertia:g} kg m²"
            if not one.inertia:
                what = f"is {away:.4g} m from there"
            raise ValueError(
                f"element {element.name!r} takes point masses at the centers of mass of its "
                f"sections, and that at {one.position:g} m {what}: take "
                f"{'an element of the plane, or ' if blade.is_planar else ''}"
                "analytic.spin_up_response"
            )


_NEXT, _LAST = [1, 2, 0], [2, 0, 1]


def cross(a: FloatArray, b: FloatArray) -> FloatArray:
    """Return a × b of vectors (..., 3), in a fifth of NumPy's time where they are few."""
    return a[..., _NEXT] * b[..., _LAST] - a[..., _LAST] * b[..., _NEXT]


def directors(p: FloatArray) -> FloatArray:
    """Return the rotations (..., 3, 3) of Euler parameters (..., 4), whatever their norm."""
    flat = spatial.transform.Rotation.from_quat(p.reshape(-1, 4)[:, [1, 2, 3, 0]]).as_matrix()
    return np.asarray(flat.reshape(*p.shape[:-1], 3, 3))


def turning_rate(p: FloatArray, p_dot: FloatArray) -> FloatArray:
    """Return the angular velocity (..., 3) by the axes of the section, 2 p* ∘ ṗ."""
    scalar, vector = p[..., :1], p[..., 1:]
    rate, turning = p_dot[..., :1], p_dot[..., 1:]
    return np.asarray(2.0 * (scalar * turning - rate * vector - cross(vector, turning)))


def onto_parameters(p: FloatArray, torque: FloatArray) -> FloatArray:
    """Return forces on Euler parameters (..., 4) of torques (..., 3) by the axes of the section."""
    scalar, vector = p[..., :1], p[..., 1:]
    along = -np.sum(vector * torque, axis=-1, keepdims=True)
    across = scalar * torque + cross(vector, torque)
    return 2.0 * np.concatenate((along, across), axis=-1)
