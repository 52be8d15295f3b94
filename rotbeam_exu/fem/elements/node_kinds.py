"""Kinds of nodes: how coordinates turn, which of them the clamp holds, and their values in a state.

The clamp turns about z, the normal of the plane of rotation.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar

import numpy as np

from analytic import AnyBlade
from analytic.arrays import FloatArray
from analytic.exact.beam.state import BeamState

from .formulation import Formulation

QUARTER_TURN = np.array([[0.0, -1.0], [1.0, 0.0]])
"""The generator of plane rotations: (x, y) becomes (-y, x)."""

ABOUT_Z = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 0.0]])
"""The generator of rotations about z; of (x, y, φ) too, to whose angle they add."""


class SlopeNodes(Formulation, abstract=True):
    """Nodes carry r and the slope r' of the axis; the clamp holds its direction, not its length."""

    node: ClassVar[str] = "NodePoint2DSlope1"
    straight: ClassVar[tuple[float, ...]] = (0.0, 1.0, 0.0)
    quarter_turn: ClassVar[FloatArray] = np.kron(np.eye(2), QUARTER_TURN)
    angles: ClassVar[FloatArray] = np.zeros(4)
    clamped: ClassVar[tuple[int, ...]] = (3,)

    def coordinates(self, x: FloatArray, state: BeamState) -> tuple[FloatArray, FloatArray]:
        """Positions and slopes, (x + u, v, 1 + u', v') in the plane, and their rates."""
        axes = "uvw"[: self.dimensions]
        values = _columns(x, state, [*axes, *(f"{one}_slope" for one in axes)])
        values[:, 0] += x
        values[:, self.dimensions] += 1.0
        return values, _columns(x, state, [f"{a}{of}_dot" for of in ("", "_slope") for a in axes])


class SpaceSlopeNodes(SlopeNodes, abstract=True):
    """The same in space."""

    leaves_plane: ClassVar[bool] = True
    node: ClassVar[str] = "NodePointSlope1"
    straight: ClassVar[tuple[float, ...]] = (0.0, 0.0, 1.0, 0.0, 0.0)
    quarter_turn: ClassVar[FloatArray] = np.kron(np.eye(2), ABOUT_Z)
    angles: ClassVar[FloatArray] = np.zeros(6)
    clamped: ClassVar[tuple[int, ...]] = (4, 5)


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

    def coordinates(self, x: FloatArray, state: BeamState) -> tuple[FloatArray, FloatArray]:
        """Positions and the angle of the section, and their rates."""
        angle, rate = _section_angle(state)
        values, rates = (x + state.u, state.v, angle), (state.u_dot, state.v_dot, rate)
        return np.stack(values, axis=1), np.stack(rates, axis=1)


def require_bare(element: Formulation, blade: AnyBlade) -> None:
    """Refuse damping and point masses, which Exudyn's elements in space do not have."""
    if any(blade.unit.damping):
        raise ValueError(
            f"element {element.name!r} is undamped, as Exudyn's geometrically exact beam ignores "
            f"its damping, and this blade has {blade.unit.differences}: take "
            "blade.with_damping(Damping())"
        )
    if blade.unit.masses:
        raise ValueError(
            f"element {element.name!r} carries no point masses, and this blade has "
            f"{blade.unit.differences}: take an element of the plane"
        )


def _columns(x: FloatArray, state: BeamState, names: Sequence[str]) -> FloatArray:
    """Return parts of a state at the nodes `x`, (nodes, names)."""
    return np.stack([getattr(state, name) + np.zeros_like(x) for name in names], axis=1)


def _section_angle(state: BeamState) -> tuple[FloatArray, FloatArray]:
    """Return the angle [rad] of the section, (nodes,), and its rate [rad/s]."""
    along, across = 1.0 + state.u_slope, state.v_slope
    rate = (along * state.v_slope_dot - across * state.u_slope_dot) / (along**2 + across**2)
    return np.arctan2(across, along) - state.shear_angle, rate - state.shear_angle_dot
