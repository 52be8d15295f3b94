"""Exudyn's ANCF cable: two nodes, cubic, Bernoulli-Euler."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import ClassVar

import exudyn
import numpy as np
from exudyn.itemInterface import NodePoint2DSlope1, ObjectANCFCable2D

from analytic import Beam
from analytic.arrays import FloatArray

from .formulation import Chain, NoDivergence
from .node_kinds import SlopeNodes


@dataclass(frozen=True, kw_only=True)
class Cable(SlopeNodes, NoDivergence):
    """ObjectANCFCable2D: nodes carry r and r', strain |r'| - 1, curvature (r'×r'')/|r'|²."""

    name: ClassVar[str] = "cable"
    summary: ClassVar[str] = "ANCF cable, two nodes, cubic, Bernoulli-Euler"

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

    def axial_strain(self, beam: Beam, coordinates: FloatArray) -> FloatArray:
        """|r'| - 1 at the nodes."""
        return np.asarray(np.hypot(coordinates[..., 2], coordinates[..., 3]) - 1.0)
