"""Exudyn's ANCF cable: two nodes, cubic, Bernoulli-Euler."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import ClassVar

import exudyn
import numpy as np
from exudyn.itemInterface import NodePoint2DSlope1, ObjectANCFCable2D

from analytic import AnyBlade
from analytic.arrays import FloatArray

from ..mesh import Mesh
from .formulation import Chain, NoDivergence
from .node_kinds import SlopeNodes
from .point_masses import add_point_masses


@dataclass(frozen=True, kw_only=True)
class Cable(SlopeNodes, NoDivergence):
    """ObjectANCFCable2D: nodes carry r and r', strain |r'| - 1, curvature (r'×r'')/|r'|²."""

    name: ClassVar[str] = "cable"
    takes_blades: ClassVar[bool] = True
    summary: ClassVar[str] = "ANCF cable, two nodes, cubic, Bernoulli-Euler"

    def lay(self, mbs: exudyn.MainSystem, beam: AnyBlade, elements: int) -> Chain:
        """Add `elements` cables of equal length along the x axis, and the masses at their nodes."""
        mesh = Mesh(blade=beam, elements=elements)
        nodes = tuple(
            mbs.AddNode(NodePoint2DSlope1(referenceCoordinates=[x, 0.0, 1.0, 0.0]))
            for x in mesh.positions
        )
        bodies = tuple(
            mbs.AddObject(
                ObjectANCFCable2D(
                    nodeNumbers=list(pair),
                    length=mesh.length,
                    massPerLength=section.mass_per_length,
                    bendingStiffness=section.bending_stiffness,
                    axialStiffness=section.axial_stiffness,
                    # Lobatto points for the axial strain: coarse meshes gain a digit.
                    useReducedOrderIntegration=2,
                )
            )
            for pair, section in zip(pairwise(nodes), mesh.sections(), strict=True)
        )
        return Chain(nodes=nodes, bodies=bodies, turning=add_point_masses(mbs, nodes, mesh))

    def axial_strain(self, beam: AnyBlade, coordinates: FloatArray) -> FloatArray:
        """|r'| - 1 at the nodes."""
        return np.asarray(np.hypot(coordinates[..., 2], coordinates[..., 3]) - 1.0)
