"""Exudyn's ANCF cable, in the plane and in space: two nodes, cubic, Bernoulli-Euler."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any, ClassVar

import numpy as np

from analytic import AnyBlade
from analytic.arrays import ComplexArray, FloatArray
from analytic.beam import require_out_of_plane
from analytic.quadrature import gauss_points

from ..lazily import exudyn, items
from ..mesh import Mesh, shapes
from .energy_body import add_point_masses
from .formulation import Chain, Formulation
from .node_kinds import SlopeNodes, SpaceSlopeNodes, require_bare

_LOBATTO = ((0.0, 1.0 / 6.0), (0.5, 2.0 / 3.0), (1.0, 1.0 / 6.0))
_GAUSS = tuple(zip(*gauss_points(2), strict=True))
"""Points and weights where Exudyn integrates axial force and bending moment, as measured."""


class _Cables(Formulation, abstract=True):
    """Cables in a row, of the body that the class names."""

    body: ClassVar[str]
    order = 4.0
    takes_blades: ClassVar[bool] = True

    def lay(self, mbs: exudyn.MainSystem, beam: AnyBlade, elements: int) -> Chain:
        """Add `elements` cables of equal length along the x axis, and the masses at their nodes."""
        mesh, damping = Mesh(blade=beam, elements=elements), beam.damping
        nodes, body = self.add_nodes(mbs, mesh.positions), getattr(items, self.body)
        EI, EA = mesh.sections.bending_stiffness, mesh.sections.axial_stiffness
        bodies = tuple(
            mbs.AddObject(
                body(
                    nodeNumbers=list(pair),
                    length=mesh.length,
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
        chain = self.chain(mesh, nodes, bodies)
        return replace(chain, turning=add_point_masses(mbs, nodes, mesh))

    def chain(self, mesh: Mesh, nodes: Any, bodies: Any) -> Chain:
        """Return the chain with the energy or the dissipation that Exudyn does not report."""
        raise NotImplementedError

    def axial_strain(self, beam: AnyBlade, coordinates: FloatArray) -> FloatArray:
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

    def chain(self, mesh: Mesh, nodes: Any, bodies: Any) -> Chain:
        """Return the chain with what viscosity takes: ∫(EI η_b κ̇² + EA η_a ε̇²) dx.

        With z = r_x + i r_y: ε̇ = |z'| Re(ż'/z') and κ = Im(z''/z').
        """
        damping = mesh.blade.damping

        def stretching(slope: ComplexArray, rate: ComplexArray) -> FloatArray:
            return np.asarray(damping.axial * (np.abs(slope) * (rate / slope).real) ** 2)

        def bending(
            slope: ComplexArray, second: ComplexArray, rate: ComplexArray, turning: ComplexArray
        ) -> FloatArray:
            change = (turning - second * rate / slope) / slope
            return np.asarray(damping.bending * change.imag**2)

        def dissipation(coordinates: FloatArray, velocities: FloatArray) -> FloatArray:
            rows = (e[..., ::2] + 1j * e[..., 1::2] for e in (coordinates, velocities))
            return _integrated(mesh, stretching, bending, *rows)

        viscous = damping.bending or damping.axial
        return Chain(nodes=nodes, bodies=bodies, dissipation=dissipation if viscous else None)


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

    def require_section(self, blade: AnyBlade) -> None:
        """Refuse a section that bends otherwise out of the plane than in it."""
        require_bare(self, blade)
        ratio = require_out_of_plane(blade, torsion=False).bending_ratio
        if abs(ratio - 1.0) > 1e-9:
            raise ValueError(
                f"element 'space_cable' bends alike in all directions, and this blade {ratio:.4g} "
                "times as stiffly out of the plane as in it: take element='space_exact', or "
                "blade.with_section_out_of_plane(bending_ratio=1.0)"
            )

    def chain(self, mesh: Mesh, nodes: Any, bodies: Any) -> Chain:
        """Return the chain with its elastic energy, with κ = |r'×r''|/|r'|²."""

        def stretching(slope: FloatArray) -> FloatArray:
            return np.asarray(0.5 * (np.linalg.norm(slope, axis=-1) - 1.0) ** 2)

        def bending(slope: FloatArray, second: FloatArray) -> FloatArray:
            across = np.sum(np.cross(slope, second) ** 2, axis=-1)
            return np.asarray(0.5 * across / np.sum(slope**2, axis=-1) ** 2)

        def energy(coordinates: FloatArray) -> FloatArray:
            vectors = coordinates.reshape(*coordinates.shape[:2], 2, 3)
            return _integrated(mesh, stretching, bending, vectors)

        return Chain(nodes=nodes, elastic_energy=energy)


def _integrated(
    mesh: Mesh,
    stretching: Callable[..., FloatArray],
    bending: Callable[..., FloatArray],
    *rows: Any,
) -> FloatArray:
    """Return ∫(EA stretching + EI bending) dx, (samples,), as Exudyn integrates.

    Of rows of positions and slopes (samples, nodes, 2, ...), by their first and second derivatives.
    """
    ends = [np.concatenate((row[:, :-1], row[:, 1:]), axis=2) for row in rows]

    def at(xi: float, orders: Sequence[int]) -> list[Any]:
        weights = [shapes(xi, mesh.length, order) for order in orders]
        return [np.einsum("k,sek...->se...", w, row) for row in ends for w in weights]

    EA, EI = mesh.sections.axial_stiffness, mesh.sections.bending_stiffness
    axial = sum(weight * stretching(*at(xi, [1])) @ EA for xi, weight in _LOBATTO)
    bent = sum(weight * bending(*at(xi, [1, 2])) @ EI for xi, weight in _GAUSS)
    return np.asarray(mesh.length * (axial + bent))
