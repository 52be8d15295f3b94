"""Exudyn's ANCF cable: two nodes, cubic, Bernoulli-Euler."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import exudyn
import numpy as np
from exudyn.itemInterface import NodePoint2DSlope1, ObjectANCFCable2D

from analytic import Beam, BeamState

from .formulation import Chain, FloatArray


@dataclass(frozen=True)
class Cable:
    """ObjectANCFCable2D: nodes carry r and r', strain |r'| - 1, curvature (r'×r'')/|r'|²."""

    summary: str = "ANCF cable, two nodes, cubic, Bernoulli-Euler"
    fixed_at_root: tuple[int, ...] = (0, 1)
    # The root may stretch, so its slope is held in direction only.
    fixed_in_rotating_frame: tuple[int, ...] = (0, 1, 3)

    @property
    def quarter_turn(self) -> FloatArray:
        """Generator J: both vectors (x, y) and (x', y') become (-y, x)."""
        return np.kron(np.eye(2), np.array([[0.0, -1.0], [1.0, 0.0]]))

    def lay(self, mbs: exudyn.MainSystem, beam: Beam, elements: int) -> Chain:
        """Add `elements` cables of equal length along the x axis."""
        length = beam.length / elements
        nodes = tuple(
            mbs.AddNode(NodePoint2DSlope1(referenceCoordinates=[i * length, 0.0, 1.0, 0.0]))
            for i in range(elements + 1)
        )
        bodies = tuple(
            mbs.AddObject(
                ObjectANCFCable2D(
                    nodeNumbers=list(pair),
                    length=length,
                    massPerLength=beam.mass_per_length,
                    bendingStiffness=beam.bending_stiffness,
                    axialStiffness=beam.axial_stiffness,
                    # Lobatto points for the axial strain: coarse meshes gain a digit.
                    useReducedOrderIntegration=2,
                )
            )
            for pair in pairwise(nodes)
        )
        return Chain(nodes=nodes, bodies=bodies)

    def coordinates(self, x: FloatArray, state: BeamState) -> tuple[FloatArray, FloatArray]:
        """Positions (x + u, v) and slopes (1 + u', v'), and their rates."""
        values = (x + state.u, state.v, 1.0 + state.u_slope, state.v_slope)
        rates = (state.u_dot, state.v_dot, state.u_slope_dot, state.v_slope_dot)
        return np.stack(values, axis=1), np.stack(rates, axis=1)

    def turn(self, coordinates: FloatArray, angle: FloatArray) -> FloatArray:
        """Turn positions and slopes alike."""
        vectors = coordinates.reshape(*coordinates.shape[:-1], 2, 2)
        x, y = vectors[..., 0], vectors[..., 1]
        sine, cosine = (f(angle)[:, None, None] for f in (np.sin, np.cos))
        turned = np.stack([cosine * x - sine * y, sine * x + cosine * y], axis=-1)
        return turned.reshape(coordinates.shape)

    def direction(self, root: FloatArray, sine: float, cosine: float) -> float:
        """-sin θ x' + cos θ y', zero where the root's slope points along θ."""
        return float(cosine * root[3] - sine * root[2])

    def direction_gradient(self, sine: float, cosine: float) -> FloatArray:
        """Return (0, 0, -sin θ, cos θ)."""
        return np.array([[0.0, 0.0, -sine, cosine]])

    def axial_strain(self, coordinates: FloatArray) -> FloatArray:
        """|r'| - 1 at the nodes."""
        return np.asarray(np.hypot(coordinates[..., 2], coordinates[..., 3]) - 1.0)
