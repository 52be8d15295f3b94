"""Exudyn's geometrically exact beam: shear-deformable, two or three nodes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from analytic import Blade
from analytic.arrays import FloatArray
from analytic.quadrature import gauss_points

from ..lazily import exudyn, items
from ..mesh import Mesh, lagrange
from .formulation import POISSON_RATIO, SHEAR_CORRECTION, Chain, Sheared, rate_of
from .node_kinds import AngleNodes


@dataclass(frozen=True, kw_only=True)
class Exact(Sheared, AngleNodes):
    """ObjectBeamGeometricallyExact2D: nodes carry r and the angle φ of the section.

    With d = (cos φ, sin φ) along the section's normal, strains are r'·d - 1, r'×d and φ',
    integrated at one Gauss point fewer than there are nodes, which keeps shear from locking. The
    section has its rotary inertia ρI; at a setting angle ψ it turns by φ' + θ' cos ψ. Damping of
    a blade is that of bending and stretch; shear is not damped.

    Parameters
    ----------
    nodes : int
        Nodes of an element, 2 (linear) or 3 (quadratic).
    poisson_ratio, shear_correction : float
        ν and k_s of the shear stiffness k_s A E/(2 (1 + ν)); the paper gives neither.

    Examples
    --------
    >>> from analytic import Beam
    >>> from rotbeam_exu import natural_frequencies
    >>> from rotbeam_exu.fem.elements import Exact
    >>> element = Exact(nodes=3)
    >>> print(natural_frequencies(Beam.reference(), 6.0, element=element, elements=8).round(4))
    [ 3.7302 23.0113 56.721 ]
    """

    nodes: int = 2
    poisson_ratio: float = POISSON_RATIO
    shear_correction: float = SHEAR_CORRECTION

    name: ClassVar[str] = "exact"
    takes_blades: ClassVar[bool] = True
    takes_viscosity: ClassVar[bool] = True

    def __post_init__(self) -> None:
        if self.nodes not in (2, 3):
            raise ValueError(f"nodes must be 2 or 3, got {self.nodes!r}")
        super().__post_init__()

    @property
    def order(self) -> float:
        """Order in the mesh: of quadratic functions and two points twice that of linear and one."""
        return 2.0 * (self.nodes - 1)

    def lay(self, mbs: exudyn.MainSystem, blade: Blade, elements: int) -> Chain:
        """Add `elements` beams along the x axis."""
        mesh = Mesh(blade=blade, elements=elements, nodes_of_element=self.nodes)
        nodes = self.add_nodes(mbs, mesh.positions)
        inner, at, damping = self.nodes - 1, mesh.sections, blade.damping
        EI, EA = at.bending_stiffness, at.axial_stiffness
        bodies = tuple(
            mbs.AddObject(
                items.ObjectBeamGeometricallyExact2D(
                    nodeNumbers=list(nodes[inner * i : inner * (i + 1) + 1]),
                    length=mesh.lengths[i],
                    massPerLength=at.mass_per_length[i],
                    crossSectionInertia=at.rotary_inertia[i],
                    bendingStiffness=EI[i],
                    axialStiffness=EA[i],
                    shearStiffness=self.shear_share * EA[i],
                    bendingDamping=EI[i] * damping.bending,
                    axialDamping=EA[i] * damping.axial,
                )
            )
            for i in range(elements)
        )
        for node, one in mesh.lumped():
            mbs.AddObject(
                items.ObjectRigidBody2D(nodeNumber=nodes[node], mass=one.mass, inertia=one.inertia)
            )
        viscous = damping.bending or damping.axial
        taken = _Row(self, blade, elements).dissipation if viscous else None
        return Chain(nodes=nodes, bodies=bodies, dissipation=taken)

    def axial_strain(self, blade: Blade, coordinates: FloatArray) -> FloatArray:
        """r'·d - 1 at the Gauss points."""
        elements = (coordinates.shape[-2] - 1) // (self.nodes - 1)
        return np.asarray(_Row(self, blade, elements).strains(coordinates)[0])


class _Row:
    """Strains and dissipation of a row of elements at all Gauss points, (..., points)."""

    def __init__(self, element: Exact, blade: Blade, elements: int) -> None:
        self._inner = inner = element.nodes - 1
        self._mesh = Mesh(blade=blade, elements=elements)
        points = gauss_points(inner)[0]
        self._values = lagrange(points, inner)
        self._slopes = lagrange(points, inner, 1)

    def strains(self, coordinates: FloatArray) -> FloatArray:
        """Return axial and bending strain, (2, ..., points)."""
        inner, lengths = self._inner, self._mesh.lengths
        count = lengths.size
        per_element = coordinates[..., inner * np.arange(count)[:, None] + np.arange(inner + 1), :]
        flat = (*coordinates.shape[:-2], inner * count, 3)
        e, e_x = (
            np.einsum("pn,...jnc->...jpc", s, one).reshape(flat)
            for s, one in (
                (self._values, per_element),
                (self._slopes, per_element / lengths[:, None, None]),
            )
        )
        sine, cosine = np.sin(e[..., 2]), np.cos(e[..., 2])
        return np.stack((cosine * e_x[..., 0] + sine * e_x[..., 1] - 1.0, e_x[..., 2]))

    def dissipation(self, coordinates: FloatArray, velocities: FloatArray) -> FloatArray:
        """Return the power (samples,) that bending and axial damping take."""
        axial, bending = rate_of(self.strains, coordinates, velocities)
        damping, at = self._mesh.blade.damping, self._mesh.sections
        # The points of an element, one or two, weigh the same.
        weights = self._mesh.lengths / self._inner
        power = axial**2 @ np.repeat(weights * damping.axial * at.axial_stiffness, self._inner)
        power += bending**2 @ np.repeat(
            weights * damping.bending * at.bending_stiffness, self._inner
        )
        return np.asarray(power)
