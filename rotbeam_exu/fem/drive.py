"""The clamp and its prescribed rotation, in the inertial and in the rotating frame.

In the inertial frame the root's direction follows θ(t) of Eq. 1 by a rheonomic constraint. In the
rotating frame the root stands still and the beam carries the inertial forces of the frame,

    f = -c² θ'² M J² e - c θ'' M (J e + a) - 2 c θ' M J e' + s² θ'² M P e,

with c = cos ψ and s = sin ψ of the setting angle: a rotation about the normal of the plane of
bending by cθ, and a centrifugal force along the clamp's line. The force is exact if mass matrix and
elastic forces commute with a rotation exp(θJ) e + θ a, as in all elements here. -J² projects on
positions and slopes, which turn, P on their share along the clamp's line; a is one for angles.

Sections with an inertia of their own are laminae in the plane of bending if slopes carry it, and
½ρI(φ' + cθ')² if angles do: the two differ by the order of μ.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from analytic.arrays import FloatArray
from analytic.lazily import sparse
from analytic.motion import Rotation

from .elements import Chain, Formulation
from .elements.energy_body import add_force, triplets
from .elements.point_masses import add_point_inertias
from .lazily import exudyn, items


def hold_root(
    mbs: exudyn.MainSystem, chain: Chain, element: Formulation, direction: bool = True
) -> None:
    """Hold the root at its reference values, with `direction` its direction as well."""
    coordinates = list(element.fixed_at_root)
    if direction:
        # At θ = 0 each constraint of the clamp holds one coordinate.
        coordinates += list(np.flatnonzero(element.clamp(0.0)[0].any(axis=0)))
    ground = mbs.AddNode(items.NodePointGround())
    at_rest = mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=ground, coordinate=0))
    for coordinate in coordinates:
        moving = mbs.AddMarker(
            items.MarkerNodeCoordinate(nodeNumber=chain.nodes[0], coordinate=int(coordinate))
        )
        mbs.AddObject(items.ObjectConnectorCoordinate(markerNumbers=[at_rest, moving]))


def prescribe_rotation(
    mbs: exudyn.MainSystem, chain: Chain, element: Formulation, rotation: Rotation, radius: float
) -> None:
    """Make the root, on a hub of `radius`, follow Eq. 1 (inertial frame)."""
    if not radius:
        hold_root(mbs, chain, element, direction=False)
    ground = mbs.AddNode(items.NodePointGround())
    at_rest = mbs.AddMarker(items.MarkerNodeCoordinates(nodeNumber=ground))
    root = mbs.AddMarker(items.MarkerNodeCoordinates(nodeNumber=chain.nodes[0]))
    size = element.quarter_turn.shape[0]
    # Each constraint holds a direction: two coordinates at most, the same at every angle.
    rows_at_1 = _clamp(element, radius, 1.0)[0]
    pairs = [tuple(np.resize(np.flatnonzero(row), 2).tolist()) for row in rows_at_1]
    held = len(pairs)
    # Called seven times a step: nothing is done twice for one t, and numbers are plain.
    time, gradient, rows = np.nan, np.zeros((held, size)), [(0.0, 0, 0.0, 0, 0.0)] * held

    def turn_to(t: float) -> None:
        nonlocal time, gradient, rows
        time = t
        gradient, target = _clamp(element, radius, rotation.angle(t))
        rows = [
            (row[i], i, row[j] if j != i else 0.0, j, d)
            for (i, j), row, d in zip(pairs, gradient.tolist(), target.tolist(), strict=True)
        ]

    def residual(
        mbs: Any, t: float, item: int, q: Any, q_t: Any, velocity_level: bool
    ) -> list[float]:
        if t != time:
            turn_to(t)
        return [a * q[i] + b * q[j] - d for a, i, b, j, d in rows]

    def jacobian(
        mbs: Any, t: float, item: int, q: Any, q_t: Any, velocity_level: bool
    ) -> FloatArray:
        if t != time:
            turn_to(t)
        return gradient

    mbs.AddObject(
        items.ObjectConnectorCoordinateVector(
            markerNumbers=[at_rest, root],
            scalingMarker0=np.zeros((held, 3)),
            scalingMarker1=np.zeros((held, size)),
            constraintUserFunction=residual,
            jacobianUserFunction=jacobian,
        )
    )
    add_point_inertias(mbs, chain.nodes, chain.turning, lambda t: 0.0)


def _clamp(element: Formulation, radius: float, angle: float) -> tuple[FloatArray, FloatArray]:
    """Return C and d of the constraints C e = d of the root at `angle`, on a hub of `radius`.

    On a hub the root's place goes around as well; at the axis it stands still and is fixed.
    """
    gradient, target = element.clamp(angle)
    if not radius:
        return gradient, target
    place = np.eye(gradient.shape[1])[list(element.fixed_at_root)]
    around = radius * np.array([math.cos(angle), math.sin(angle), 0.0])[: len(place)]
    return np.vstack([place, gradient]), np.concatenate([around, target])


def add_inertial_forces(
    mbs: exudyn.MainSystem,
    chain: Chain,
    element: Formulation,
    mass: sparse.csr_array,
    rotation: Rotation,
    setting: float,
) -> None:
    """Load the beam with centrifugal, Euler and Coriolis forces (rotating frame).

    The mass matrix is the chain's alone, over all its coordinates, root first; `setting` is
    the cosine c of the setting angle.
    """
    nodes = len(chain.nodes)
    turn = setting * sparse.kron(sparse.eye_array(nodes), element.quarter_turn)
    along = sparse.diags_array(np.tile(element.radial, nodes))
    gyroscopic = (mass @ turn).tocsr()
    centrifugal = (mass @ ((1.0 - setting**2) * along - turn @ turn)).tocsr()
    angular = setting * (mass @ np.tile(element.angles, nodes))
    stiff_triplets, gyro_triplets = triplets(centrifugal), triplets(gyroscopic)

    def force(t: float, e: FloatArray, rates: FloatArray) -> FloatArray:
        rate, acceleration = rotation.rate(t), rotation.acceleration(t)
        return np.asarray(
            rate**2 * (centrifugal @ e)
            - gyroscopic @ (acceleration * e + 2.0 * rate * rates)
            - acceleration * angular
        )

    def derivatives(t: float, e: FloatArray) -> list[tuple[FloatArray, float, float]]:
        rate, acceleration = rotation.rate(t), rotation.acceleration(t)
        return [(stiff_triplets, rate**2, 0.0), (gyro_triplets, -acceleration, -2.0 * rate)]

    add_force(mbs, chain.nodes, mass.shape[0], force=force, derivatives=derivatives)
    add_point_inertias(
        mbs, chain.nodes, chain.turning, lambda t: setting * rotation.acceleration(t)
    )
