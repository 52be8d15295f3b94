"""The clamp: a body, or a prescribed rotation in the inertial and in the rotating frame.

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
from collections.abc import Callable, Sequence
from functools import lru_cache
from typing import Any

import numpy as np

from analytic.arrays import FloatArray
from analytic.lazily import sparse
from analytic.motion import Rotation

from .elements.energy_body import add_force, add_point_inertias, triplets
from .elements.formulation import Chain, Formulation
from .lazily import exudyn, items

Torque = Callable[[Any, float], float]
"""Torque of a clamp on its blade, of a solved system at a time, as user functions have them."""


def set_state(
    mbs: exudyn.MainSystem,
    chain: Chain,
    element: Formulation,
    coordinates: FloatArray,
    velocities: FloatArray,
    *,
    angle: float,
    rate: float,
    place: FloatArray | float = 0.0,
    velocity: FloatArray | float = 0.0,
) -> None:
    """Start the nodes from what they have, (nodes, n), in a clamp at an angle and in motion."""
    coordinates, velocities = element.turned(np.stack((coordinates, velocities)), np.full(2, angle))
    coordinates = coordinates + angle * element.angles
    velocities = velocities + rate * element.spun(coordinates)
    coordinates[:, : element.dimensions] += place
    velocities[:, : element.dimensions] += velocity
    moved = coordinates - chain.reference(mbs)
    for node, at, moving in zip(chain.nodes, moved, velocities, strict=True):
        mbs.SetNodeParameter(node, "initialCoordinates", at)
        mbs.SetNodeParameter(node, "initialVelocities", moving)


def clamp_to_body(
    mbs: exudyn.MainSystem,
    chain: Chain,
    element: Formulation,
    marker: exudyn.MarkerIndex,
    azimuth: float,
) -> tuple[list[exudyn.ObjectIndex], Torque]:
    """Join the root to the body of `marker`, at the axis; return the joint and its torque.

    The blade starts with the body's place and velocity, as a part of it.
    """
    body = mbs.GetMarker(marker)
    if body["markerType"] != "BodyRigid":
        raise ValueError(
            f"the marker of a clamp must be a MarkerBodyRigid, got a Marker{body['markerType']}: "
            "add one to your hub, at its axis"
        )
    reference = chain.reference(mbs)
    c, s = math.cos(azimuth), math.sin(azimuth)
    about, seat = np.eye(4), np.eye(4)
    about[:2, :2] = [[c, -s], [s, c]]
    seat[: element.dimensions, 3] = reference[0, : element.dimensions]
    seat[:3, :3] = element.sections(reference[0])
    ends = (
        items.MarkerBodyRigid(
            bodyNumber=body["bodyNumber"], localHT=np.asarray(body["localHT"]) @ about @ seat
        ),
        items.MarkerNodeRigid(nodeNumber=chain.nodes[0]),
    )
    joint = mbs.AddObject(
        items.ObjectJointGeneric(
            markerNumbers=[mbs.AddMarker(end) for end in ends], constrainedAxes=element.joint
        )
    )
    add_point_inertias(mbs, chain.nodes, chain.turning, lambda t: 0.0)
    mbs.Assemble()  # so that it knows where the marker is
    kind = exudyn.OutputVariableType
    turn, place, spin, velocity = (
        np.array(mbs.GetMarkerOutput(marker, variable, exudyn.ConfigurationType.Initial))
        for variable in (kind.RotationMatrix, kind.Position, kind.AngularVelocity, kind.Velocity)
    )
    if turn[8] < 1.0 - 1e-9:
        raise ValueError(
            "the blade begins in the global x-y plane, and the z axis of its marker is "
            f"{turn[2::3].round(6)}: turn the marker by its localHT"
        )
    set_state(
        mbs, chain, element, reference, np.zeros_like(reference),
        angle=azimuth + math.atan2(turn[3], turn[0]), rate=float(spin[2]),
        place=place[: element.dimensions], velocity=velocity[: element.dimensions],
    )  # fmt: skip

    def torque(mbs: Any, t: float) -> float:
        # Exudyn reports multipliers: the moment on the blade but for a sign, the force on the body.
        moment = seat[:3, :3] @ (
            [-1.0, 1.0, 1.0] * np.array(mbs.GetObjectOutput(joint, kind.TorqueLocal))
        )
        force = seat[:3, :3] @ mbs.GetObjectOutput(joint, kind.ForceLocal)
        return float((moment - np.cross(seat[:3, 3], force))[2])

    return [joint], torque


def torque_of(
    mbs: exudyn.MainSystem,
    chain: Chain,
    element: Formulation,
    constraints: Sequence[exudyn.ObjectIndex],
    angle: Callable[[float], float],
) -> Torque:
    """Return the torque by which the constraints of the root, at `angle`, turn it."""
    root, kind = chain.reference(mbs)[0], exudyn.OutputVariableType
    place, direction = np.eye(element.dimensions, root.size), element.clamp(root)

    def torque(mbs: Any, t: float) -> float:
        along = mbs.GetNodeOutput(chain.nodes[0], kind.Coordinates) + root
        rows = np.vstack((place, direction(angle(t))[0]))
        multipliers = [np.atleast_1d(mbs.GetObjectOutput(one, kind.Force)) for one in constraints]
        return -float(np.concatenate(multipliers) @ rows @ element.spun(along))

    return torque


def hold_root(
    mbs: exudyn.MainSystem, chain: Chain, element: Formulation, *, turning: bool = False
) -> exudyn.ObjectIndex:
    """Hold the root's place and, unless it is turning, its direction; return the constraint."""
    root = chain.reference(mbs)[0]
    rows = np.eye(element.dimensions, root.size)
    if not turning:
        rows = np.vstack((rows, element.held(root)))
    return mbs.AddObject(
        items.ObjectConnectorCoordinateVector(
            markerNumbers=_markers(mbs, chain),
            scalingMarker0=np.zeros((len(rows), 0)),
            scalingMarker1=rows,
            offset=rows @ root,
        )
    )


def _markers(mbs: exudyn.MainSystem, chain: Chain) -> list[exudyn.MarkerIndex]:
    """Return markers of the ground and of the root's coordinates."""
    nodes = mbs.AddNode(items.NodePointGround()), chain.nodes[0]
    return [mbs.AddMarker(items.MarkerNodeCoordinates(nodeNumber=node)) for node in nodes]


def prescribe_rotation(
    mbs: exudyn.MainSystem, chain: Chain, element: Formulation, rotation: Rotation
) -> list[exudyn.ObjectIndex]:
    """Make the root follow Eq. 1 (inertial frame); return the constraints.

    Their rows are those of the place, and then those of the direction.
    """
    root = chain.reference(mbs)[0]
    moving = bool(root[:2].any())  # at the axis its place stands still
    constraints = [] if moving else [hold_root(mbs, chain, element, turning=True)]
    # Each constraint holds a few coordinates, the same at every angle.
    clamp = _clamp(element, root) if moving else element.clamp(root)
    held = [np.flatnonzero(row).tolist() for row in clamp(1.0)[0]]

    @lru_cache(maxsize=1)  # called seven times a step, with plain numbers
    def turned_to(t: float) -> tuple[FloatArray, list[tuple[list[tuple[float, int]], float]]]:
        gradient, target = clamp(rotation.angle(t))
        rows = zip(held, gradient.tolist(), target.tolist(), strict=True)
        return gradient, [([(row[i], i) for i in at], d) for at, row, d in rows]

    def residual(
        mbs: Any, t: float, item: int, q: Any, q_t: Any, velocity_level: bool
    ) -> list[float]:
        return [sum([a * q[i] for a, i in row]) - d for row, d in turned_to(t)[1]]

    def jacobian(
        mbs: Any, t: float, item: int, q: Any, q_t: Any, velocity_level: bool
    ) -> FloatArray:
        return turned_to(t)[0]

    turning = items.ObjectConnectorCoordinateVector(
        markerNumbers=_markers(mbs, chain),
        scalingMarker0=np.zeros((len(held), 3)),
        scalingMarker1=np.zeros((len(held), root.size)),
        constraintUserFunction=residual,
        jacobianUserFunction=jacobian,
    )
    constraints.append(mbs.AddObject(turning))
    reference = chain.reference(mbs)
    set_state(
        mbs, chain, element, reference, np.zeros_like(reference),
        angle=rotation.angle(0.0), rate=rotation.rate(0.0),
    )  # fmt: skip
    add_point_inertias(mbs, chain.nodes, chain.turning, lambda t: 0.0)
    return constraints


def _clamp(
    element: Formulation, root: FloatArray
) -> Callable[[float], tuple[FloatArray, FloatArray]]:
    """Return the function of θ that gives C and d of C e = d, of the root's place and direction."""
    direction = element.clamp(root)
    x, y, *up = root[: element.dimensions]
    place = np.eye(element.dimensions, root.size)

    def at(angle: float) -> tuple[FloatArray, FloatArray]:
        gradient, target = direction(angle)
        cosine, sine = math.cos(angle), math.sin(angle)
        around = [x * cosine - y * sine, x * sine + y * cosine, *up]
        return np.vstack([place, gradient]), np.concatenate([around, target])

    return at


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

    add_force(mbs, chain.nodes, force=force, derivatives=derivatives)
    add_point_inertias(
        mbs, chain.nodes, chain.turning, lambda t: setting * rotation.acceleration(t)
    )
