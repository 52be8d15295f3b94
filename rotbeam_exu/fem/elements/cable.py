"""Exudyn's ANCF cable, in the plane and in space: two nodes, cubic, Bernoulli-Euler."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from itertools import pairwise
from typing import Any, ClassVar

import numpy as np

from analytic import Blade
from analytic.arrays import FloatArray
from analytic.blade_checks import require_out_of_plane
from analytic.exact.continuum.unit import space_unit
from analytic.quadrature import gauss_points

from ..lazily import exudyn, items
from ..mesh import Mesh, shapes
from .energy_body import add_point_masses
from .formulation import Chain, Formulation, rate_of
from .node_kinds import SlopeNodes, SpaceSlopeNodes, require_light

_LOBATTO = ((0.0, 1.0 / 6.0), (0.5, 2.0 / 3.0), (1.0, 1.0 / 6.0))
_GAUSS = tuple(zip(*gauss_points(2), strict=True))
"""Points and weights where Exudyn integrates axial force and bending moment, as measured."""


class _Cables(Formulation, abstract=True):
    """Cables in a row, of the body that the class names."""

    body: ClassVar[str]
    order = 4.0
    takes_blades: ClassVar[bool] = True

    def lay(self, mbs: exudyn.MainSystem, blade: Blade, elements: int) -> Chain:
        """Add `elements` cables along the x axis, and the masses at their nodes."""
        mesh, damping = Mesh(blade=blade, elements=elements), blade.damping
        nodes, body = self.add_nodes(mbs, mesh.positions), getattr(items, self.body)
        EI, EA = mesh.sections.bending_stiffness, mesh.sections.axial_stiffness
        bodies = tuple(
            mbs.AddObject(
                body(
                    nodeNumbers=list(pair),
                    length=mesh.lengths[i],
                    massPerLength=mesh.sections.mass_per_length[i],
                    bendingStiffness=EI[i],
                    axialStiffness=EA[i],
                    bendingDamping=EI[i] * damping.bending,
                    axialDamping=EA[i] * damping.axial,
                    # Lobatto points for the axial strain: coarse meshes gain a digit.
                    useReducedOrderIntegration=2,
                )
            )
            for i, pair in enumerate(pairwise(nodes))
        )
        viscous = damping.bending or damping.axial
        return Chain(
            nodes=nodes,
            bodies=bodies,
            dissipation=partial(_dissipation, mesh) if viscous else None,
            turning=add_point_masses(mbs, nodes, mesh, self.dimensions),
        )

    def axial_strain(self, blade: Blade, coordinates: FloatArray) -> FloatArray:
        """|r'| - 1 at the nodes."""
        slopes = coordinates[..., coordinates.shape[-1] // 2 :]
        return np.asarray(np.linalg.norm(slopes, axis=-1) - 1.0)


@dataclass(frozen=True, kw_only=True)
class Cable(_Cables, SlopeNodes):
    """ObjectANCFCable2D: nodes carry r and r', cubic, Bernoulli-Euler.

    Its strain is |r'| - 1, its curvature (r'×r'')/|r'|².

    Examples
    --------
    >>> from analytic import Beam
    >>> from rotbeam_exu import natural_frequencies
    >>> from rotbeam_exu.fem.elements import Cable
    >>> print(natural_frequencies(Beam.reference(), 6.0, element=Cable(), elements=8).round(4))
    [ 3.7311 23.0152 56.6964]
    """

    name: ClassVar[str] = "cable"
    takes_viscosity: ClassVar[bool] = True
    body: ClassVar[str] = "ObjectANCFCable2D"


@dataclass(frozen=True, kw_only=True)
class SpaceCable(_Cables, SpaceSlopeNodes):
    """ObjectANCFCable: nodes carry r and r'; no torsion, and one EI for all directions.

    Examples
    --------
    >>> from analytic import Beam
    >>> from rotbeam_exu import natural_frequencies
    >>> blade = Beam.reference().with_section_out_of_plane(bending_ratio=1.0)
    >>> print(natural_frequencies(blade, 6.0, element="space_cable", elements=8).round(4))
    [ 3.7311  7.0656 23.0152]
    """

    name: ClassVar[str] = "space_cable"
    new_jacobians: ClassVar[bool] = True  # half the time
    body: ClassVar[str] = "ObjectANCFCable"

    def require_section(self, blade: Blade) -> None:
        """Refuse a section that bends otherwise out of the plane than in it."""
        require_light(self, blade)
        ratios = space_unit(require_out_of_plane(blade, torsion=False)).flap_ratios
        ratio = ratios[np.argmax(np.abs(ratios - 1.0))]
        if abs(ratio - 1.0) > 1e-9:
            raise ValueError(
                f"element 'space_cable' bends alike in all directions, and this blade {ratio:.4g} "
                "times as stiffly out of the plane as in it: take element='space_exact', or "
                "blade.with_section_out_of_plane(bending_ratio=1.0)"
            )


def _dissipation(mesh: Mesh, coordinates: FloatArray, velocities: FloatArray) -> FloatArray:
    """Return ∫(EA η_a ε̇² + EI η_b κ̇²) dx of cables in the plane, (samples,)."""
    damping, sections = mesh.blade.damping, mesh.sections

    def at(xi: float, order: int, row: Any) -> Any:
        """Return the derivatives (2, samples, elements) of the axis to x."""
        ends = np.concatenate((row[:, :-1], row[:, 1:]), axis=2)
        vectors = ends.reshape(*ends.shape[:2], 4, 2)
        return np.einsum("sekc,ek->cse", vectors, shapes(xi, mesh.lengths, order))

    def strain(xi: float, row: Any) -> Any:
        return np.sqrt(np.sum(at(xi, 1, row) ** 2, axis=0)) - 1.0

    def curvature(xi: float, row: Any) -> Any:
        (x, y), (x2, y2) = at(xi, 1, row), at(xi, 2, row)
        return (x * y2 - y * x2) / (x**2 + y**2)

    power = np.zeros(len(coordinates))
    for of, points, stiffness in (
        (strain, _LOBATTO, damping.axial * sections.axial_stiffness),
        (curvature, _GAUSS, damping.bending * sections.bending_stiffness),
    ):
        for xi, weight in points:
            rate = rate_of(partial(of, xi), coordinates, velocities)
            power += weight * rate**2 @ (mesh.lengths * stiffness)
    return power
