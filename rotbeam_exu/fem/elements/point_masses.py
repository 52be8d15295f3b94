"""Point masses on nodes that carry slopes, and their inertia against rotation.

The angle ϑ of a node is that of its slope p, and T = ½Jϑ̇² with ϑ̇ = g·ṗ, g = (-p_y, p_x)/|p|². A
constant mass J of the slope, T = ½J|ṗ|², is no substitute: its centrifugal force stretches the
blade at a point, the more so the finer the mesh, and frequencies drift off it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Any

import numpy as np

from analytic.arrays import FloatArray

from ..lazily import exudyn, items
from ..mesh import Mesh

TurningNode = tuple[int, float]
"""A node, by its place in the chain, and the inertia [kg m²] against rotation of its slope."""

_SLOPE = slice(2, 4)
"""The coordinates of a node that are its slope."""


def add_point_masses(
    mbs: exudyn.MainSystem, nodes: tuple[exudyn.NodeIndex, ...], mesh: Mesh
) -> tuple[TurningNode, ...]:
    """Add the masses, and return the nodes whose slopes are to be given an inertia."""
    for node, one in mesh.lumped():
        if one.mass:
            mbs.AddObject(items.ObjectMassPoint2D(nodeNumber=nodes[node], mass=one.mass))
    return tuple((node, one.inertia) for node, one in mesh.lumped() if one.inertia)


def add_point_inertias(
    mbs: exudyn.MainSystem,
    nodes: Sequence[exudyn.NodeIndex],
    turning: Iterable[TurningNode],
    acceleration: Callable[[float], float],
) -> None:
    """Add J (ϑ̈ + α) to the angles of the turning nodes of a chain.

    α(t) is the angular acceleration of the frame about the normal of the plane of bending.
    """
    for node, inertia in turning:
        _add_inertia(mbs, nodes[node], inertia, acceleration)


def _add_inertia(
    mbs: exudyn.MainSystem,
    node: exudyn.NodeIndex,
    inertia: float,
    acceleration: Callable[[float], float],
) -> None:
    reference = np.array(mbs.GetNodeParameter(node, "referenceCoordinates"))[_SLOPE]

    def angle_gradient(q: Any) -> tuple[FloatArray, FloatArray]:
        p = reference + np.asarray(q)[_SLOPE]
        return p, np.array([-p[1], p[0]]) / (p @ p)

    def mass(mbs: Any, t: float, item: int, q: Any, q_t: Any) -> FloatArray:
        matrix = np.zeros((4, 4))
        gradient = angle_gradient(q)[1]
        matrix[_SLOPE, _SLOPE] = inertia * np.outer(gradient, gradient)
        return matrix

    def force(mbs: Any, t: float, item: int, q: Any, q_t: Any) -> FloatArray:
        p, gradient = angle_gradient(q)
        rate = np.asarray(q_t)[_SLOPE]
        # ϑ̈ = g·p̈ + ġ·ṗ
        turning = acceleration(t) - 2.0 * (p @ rate) * (gradient @ rate) / (p @ p)
        result = np.zeros(4)
        result[_SLOPE] = -inertia * turning * gradient
        return result

    mbs.AddObject(
        items.ObjectGenericODE2(
            nodeNumbers=[node], massMatrixUserFunction=mass, forceUserFunction=force
        )
    )


def spins(
    turning: Iterable[TurningNode], coordinates: FloatArray, velocities: FloatArray
) -> list[tuple[float, FloatArray]]:
    """Return J and ϑ̇ (samples,) of each turning node, from arrays (samples, nodes, 4)."""
    result = []
    for node, inertia in turning:
        p, rate = coordinates[:, node, _SLOPE], velocities[:, node, _SLOPE]
        across = p[:, 0] * rate[:, 1] - p[:, 1] * rate[:, 0]
        result.append((inertia, across / np.sum(p**2, axis=1)))
    return result
