"""A beam or blade on a mesh: where its nodes are, and the section and masses of each element."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from analytic import AnyBlade, Damping, PointMass
from analytic.arrays import FloatArray
from analytic.profiles import evaluated
from analytic.quadrature import gauss_points


@dataclass(frozen=True, kw_only=True)
class ElementSection:
    """What an element of constant section has: m [kg/m], EI [N m²], EA [N], ρI [kg m].

    ρI is for elements that model it; where the blade tells none, that of a homogeneous section.
    """

    mass_per_length: float
    bending_stiffness: float
    axial_stiffness: float
    rotary_inertia: float


@dataclass(frozen=True, kw_only=True)
class PointSections:
    """What the sections at points of the elements have, as `ElementSection`, (elements, points)."""

    mass_per_length: FloatArray
    bending_stiffness: FloatArray
    axial_stiffness: FloatArray
    rotary_inertia: FloatArray


@dataclass(frozen=True, kw_only=True)
class Mesh:
    """Elements of equal length on a beam or blade.

    Exudyn's elements have a constant section: the mean of its mass and EI, and of its compliance
    1/EA. Of a blade that tapers they converge to second order, whatever their own: with height
    and width tapered by a half and three tenths, 64 cables are off by 1.1e-4 in frequency. An
    element of our own takes the sections at its Gauss points.
    """

    blade: AnyBlade
    elements: int
    nodes_of_element: int = 2

    @property
    def length(self) -> float:
        """Length of an element."""
        return self.blade.length / self.elements

    @property
    def hub_radius(self) -> float:
        """Where the root is, from the axis."""
        return self.blade.hub_radius

    @property
    def damping(self) -> Damping:
        """That of the blade; a beam has none."""
        return self.blade.damping

    @cached_property
    def positions(self) -> FloatArray:
        """Where the nodes are along the undeformed blade, from the axis."""
        count = self.elements * (self.nodes_of_element - 1) + 1
        return self.hub_radius + np.linspace(0.0, self.blade.length, count)

    def sections(self) -> Iterator[ElementSection]:
        """Yield the section of each element, from the root."""
        inner, weights = gauss_points(8)
        at = self.sections_at(inner)
        for m, EI, compliance, turning in zip(
            at.mass_per_length @ weights,
            at.bending_stiffness @ weights,
            (1.0 / at.axial_stiffness) @ weights,
            at.rotary_inertia @ weights,
            strict=True,
        ):
            yield ElementSection(
                mass_per_length=float(m),
                bending_stiffness=float(EI),
                axial_stiffness=1.0 / float(compliance),
                rotary_inertia=float(turning),
            )

    def sections_at(self, inner: FloatArray) -> PointSections:
        """Return the sections at the points `inner`, from 0 to 1, of each element."""
        blade, unit = self.blade, self.blade.unit
        x = (np.arange(self.elements)[:, None] + inner) / self.elements
        m = blade.mass_per_length * evaluated(unit.mass, x)
        EI = blade.bending_stiffness * evaluated(unit.bending, x)
        EA = blade.axial_stiffness * evaluated(unit.axial, x)
        told = blade.section.rotary_inertia is not None
        own = blade.mass_per_length * blade.length**2 * evaluated(unit.rotary, x)
        return PointSections(
            mass_per_length=m,
            bending_stiffness=EI,
            axial_stiffness=EA,
            # A homogeneous section has ρI = m EI/EA.
            rotary_inertia=own if told else m * EI / EA,
        )

    def lumped(self) -> Iterator[tuple[int, PointMass]]:
        """Yield the nodes that carry a mass, and the masses.

        Raises
        ------
        ValueError
            If a mass is not at a node.
        """
        for one in self.blade.point_masses:
            node = round((self.positions.size - 1) * one.position / self.blade.length)
            off = abs(self.hub_radius + one.position - self.positions[node])
            if off > 1e-9 * self.blade.length:
                raise ValueError(
                    f"no node of {self.elements} elements is at the point mass at "
                    f"{one.position / self.blade.length:.6g} of the length, the nearest is "
                    f"{off / self.blade.length:.2g} of it away: take a number of elements that "
                    "puts one there"
                )
            yield node, one
