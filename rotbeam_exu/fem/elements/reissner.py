"""Exudyn's geometrically exact beam: shear-deformable, two or three nodes."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import ClassVar

import numpy as np

from analytic import AnyBlade
from analytic.arrays import FloatArray

from ..lazily import exudyn, items
from ..mesh import Mesh
from .formulation import Chain, NoDivergence
from .node_kinds import AngleNodes
from .section import POISSON_RATIO, SHEAR_CORRECTION, checked_shear, shear_share


@dataclass(frozen=True, kw_only=True)
class Exact(AngleNodes, NoDivergence):
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
    summary: ClassVar[str] = "geometrically exact beam, two or three nodes, shear-deformable"

    def __post_init__(self) -> None:
        if self.nodes not in (2, 3):
            raise ValueError(f"nodes must be 2 or 3, got {self.nodes!r}")
        checked_shear(self.poisson_ratio, self.shear_correction)

    def lay(self, mbs: exudyn.MainSystem, beam: AnyBlade, elements: int) -> Chain:
        """Add `elements` beams of equal length along the x axis."""
        mesh = Mesh(blade=beam, elements=elements, nodes_of_element=self.nodes)
        nodes = tuple(
            mbs.AddNode(items.NodeRigidBody2D(referenceCoordinates=[x, 0, 0]))
            for x in mesh.positions
        )
        inner = self.nodes - 1
        for i, section in zip(range(0, inner * elements, inner), mesh.sections(), strict=True):
            mbs.AddObject(
                items.ObjectBeamGeometricallyExact2D(
                    nodeNumbers=list(nodes[i : i + self.nodes]),
                    length=mesh.length,
                    massPerLength=section.mass_per_length,
                    crossSectionInertia=section.rotary_inertia,
                    bendingStiffness=section.bending_stiffness,
                    axialStiffness=section.axial_stiffness,
                    shearStiffness=self.shear_share * section.axial_stiffness,
                    bendingDamping=section.bending_stiffness * mesh.damping.bending,
                    axialDamping=section.axial_stiffness * mesh.damping.axial,
                )
            )
        for node, one in mesh.lumped():
            mbs.AddObject(
                items.ObjectRigidBody2D(nodeNumber=nodes[node], mass=one.mass, inertia=one.inertia)
            )
        viscous = mesh.damping.bending or mesh.damping.axial
        return Chain(
            nodes=nodes,
            elastic_energy=lambda e: self.elastic_energy(beam, e),
            dissipation=partial(self._dissipation, mesh) if viscous else None,
        )

    def axial_strain(self, beam: AnyBlade, coordinates: FloatArray) -> FloatArray:
        """r'·d - 1 at the Gauss points."""
        return self._strains(beam, coordinates)[0]

    def elastic_energy(self, beam: AnyBlade, coordinates: FloatArray) -> FloatArray:
        """Return the elastic energy [J] of coordinates (samples, nodes, 3), which Exudyn keeps."""
        axial, shear, curvature = self._strains(beam, coordinates)
        EA, EI = self._stiffness(beam, coordinates)
        density = EA * (axial**2 + self.shear_share * shear**2) + EI * curvature**2
        # The points of an element, one or two, weigh the same.
        return np.asarray(0.5 * beam.length * density.mean(axis=-1))

    def _dissipation(
        self, mesh: Mesh, coordinates: FloatArray, velocities: FloatArray
    ) -> FloatArray:
        """Return the power (samples,) that bending and axial damping take."""
        e, e_x = self._at_gauss_points(mesh.blade, coordinates)
        rate, rate_x = self._at_gauss_points(mesh.blade, velocities)
        sine, cosine = np.sin(e[..., 2]), np.cos(e[..., 2])
        shear = cosine * e_x[..., 1] - sine * e_x[..., 0]
        axial = cosine * rate_x[..., 0] + sine * rate_x[..., 1] + rate[..., 2] * shear
        EA, EI = self._stiffness(mesh.blade, coordinates)
        damping = mesh.damping
        density = damping.axial * EA * axial**2 + damping.bending * EI * rate_x[..., 2] ** 2
        return np.asarray(mesh.blade.length * density.mean(axis=-1))

    def _stiffness(self, beam: AnyBlade, coordinates: FloatArray) -> tuple[FloatArray, FloatArray]:
        """EA and EI at the Gauss points, each (points,)."""
        inner = self.nodes - 1
        mesh = Mesh(blade=beam, elements=(coordinates.shape[-2] - 1) // inner)
        sections = list(mesh.sections())
        EA, EI = (
            np.repeat([getattr(section, name) for section in sections], inner)
            for name in ("axial_stiffness", "bending_stiffness")
        )
        return EA, EI

    @property
    def order(self) -> float:  # type: ignore[override]
        """Twice that of quadratic functions and two points, against linear ones and one."""
        return 2.0 * (self.nodes - 1)

    @property
    def shear_share(self) -> float:  # type: ignore[override]
        """k_s G A over EA."""
        return shear_share(self.poisson_ratio, self.shear_correction)

    def _strains(
        self, beam: AnyBlade, coordinates: FloatArray
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Axial, shear and bending strain at the Gauss points, each (..., points)."""
        e, e_x = self._at_gauss_points(beam, coordinates)
        sine, cosine = np.sin(e[..., 2]), np.cos(e[..., 2])
        return (
            cosine * e_x[..., 0] + sine * e_x[..., 1] - 1.0,
            cosine * e_x[..., 1] - sine * e_x[..., 0],
            e_x[..., 2],
        )

    def _at_gauss_points(
        self, beam: AnyBlade, coordinates: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Return the coordinates and their slopes at the Gauss points, each (..., points, 3)."""
        inner = self.nodes - 1
        count = (coordinates.shape[-2] - 1) // inner
        length = beam.length / count
        per_element = coordinates[..., inner * np.arange(count)[:, None] + np.arange(inner + 1), :]
        # Shape functions and their slopes to x at the Gauss points, (points, nodes).
        points = np.polynomial.legendre.leggauss(inner)[0]
        if inner == 1:
            values = np.array([[0.5, 0.5]])
            slopes = np.array([[-1.0, 1.0]]) / length
        else:
            values = np.stack(
                [0.5 * points * (points - 1), 1 - points**2, 0.5 * points * (points + 1)], axis=1
            )
            slopes = np.stack([points - 0.5, -2 * points, points + 0.5], axis=1) * 2.0 / length
        flat = (*coordinates.shape[:-2], inner * count, 3)
        e, e_x = (
            np.einsum("pn,...jnc->...jpc", s, per_element).reshape(flat) for s in (values, slopes)
        )
        return e, e_x
