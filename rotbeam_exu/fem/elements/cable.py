"""Exudyn's ANCF cable: two nodes, cubic, Bernoulli-Euler."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from itertools import pairwise
from typing import ClassVar

import numpy as np

from analytic import AnyBlade
from analytic.arrays import FloatArray
from analytic.quadrature import gauss_points

from ..lazily import exudyn, items
from ..mesh import Mesh
from .formulation import Chain, NoDivergence
from .hermite import shapes
from .node_kinds import SlopeNodes
from .point_masses import add_point_masses

_LOBATTO = ((0.0, 1.0 / 6.0), (0.5, 2.0 / 3.0), (1.0, 1.0 / 6.0))
_GAUSS = tuple(zip(*gauss_points(2), strict=True))
"""Where Exudyn integrates axial force and bending moment, and the weights, as measured."""


@dataclass(frozen=True, kw_only=True)
class Cable(SlopeNodes, NoDivergence):
    """ObjectANCFCable2D: nodes carry r and r', strain |r'| - 1, curvature (r'×r'')/|r'|².

    Examples
    --------
    >>> from analytic import Beam
    >>> from rotbeam_exu import natural_frequencies
    >>> from rotbeam_exu.fem.elements import Cable
    >>> print(natural_frequencies(Beam.reference(), 6.0, element=Cable(), elements=8).round(4))
    [ 3.7311 23.0152 56.6964]
    """

    name: ClassVar[str] = "cable"
    order = 4.0
    takes_blades: ClassVar[bool] = True
    takes_viscosity: ClassVar[bool] = True
    summary: ClassVar[str] = "ANCF cable, two nodes, cubic, Bernoulli-Euler"

    def lay(self, mbs: exudyn.MainSystem, beam: AnyBlade, elements: int) -> Chain:
        """Add `elements` cables of equal length along the x axis, and the masses at their nodes."""
        mesh = Mesh(blade=beam, elements=elements)
        nodes = tuple(
            mbs.AddNode(items.NodePoint2DSlope1(referenceCoordinates=[x, 0.0, 1.0, 0.0]))
            for x in mesh.positions
        )
        bodies = tuple(
            mbs.AddObject(
                items.ObjectANCFCable2D(
                    nodeNumbers=list(pair),
                    length=mesh.length,
                    massPerLength=section.mass_per_length,
                    bendingStiffness=section.bending_stiffness,
                    axialStiffness=section.axial_stiffness,
                    bendingDamping=section.bending_stiffness * mesh.damping.bending,
                    axialDamping=section.axial_stiffness * mesh.damping.axial,
                    # Lobatto points for the axial strain: coarse meshes gain a digit.
                    useReducedOrderIntegration=2,
                )
            )
            for pair, section in zip(pairwise(nodes), mesh.sections(), strict=True)
        )
        viscous = mesh.damping.bending or mesh.damping.axial
        return Chain(
            nodes=nodes,
            bodies=bodies,
            turning=add_point_masses(mbs, nodes, mesh),
            dissipation=partial(_dissipation, mesh) if viscous else None,
        )

    def axial_strain(self, beam: AnyBlade, coordinates: FloatArray) -> FloatArray:
        """|r'| - 1 at the nodes."""
        return np.asarray(np.hypot(coordinates[..., 2], coordinates[..., 3]) - 1.0)


def _dissipation(mesh: Mesh, coordinates: FloatArray, velocities: FloatArray) -> FloatArray:
    """Return the power (samples,) that bending and axial damping take: ∫(EI η_b κ̇² + EA η_a ε̇²) dx.

    With z = r_x + i r_y: ε̇ = |z'| Re(ż'/z') and κ = Im(z''/z').
    """
    e, e_dot = (
        np.concatenate([z[:, :-1], z[:, 1:]], axis=2)
        for z in (values[..., ::2] + 1j * values[..., 1::2] for values in (coordinates, velocities))
    )
    sections, damping = list(mesh.sections()), mesh.damping
    EI, EA = (
        np.array([getattr(section, name) for section in sections])
        for name in ("bending_stiffness", "axial_stiffness")
    )
    power = np.zeros(len(coordinates))
    for xi, weight in _LOBATTO:
        first = shapes(xi, mesh.length, 1)
        slope, rate = e @ first, e_dot @ first
        power += damping.axial * weight * (np.abs(slope) * (rate / slope).real) ** 2 @ EA
    for xi, weight in _GAUSS:
        first, second = (shapes(xi, mesh.length, order) for order in (1, 2))
        slope, rate = e @ first, e_dot @ first
        turning = (e_dot @ second - (e @ second) * rate / slope) / slope
        power += damping.bending * weight * turning.imag**2 @ EI
    return mesh.length * power
