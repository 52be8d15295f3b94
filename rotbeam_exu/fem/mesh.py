"""A beam or blade on a mesh: nodes, sections and masses of its elements, and shape functions."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from analytic import Blade, PointMass
from analytic.arrays import FloatArray, evaluated
from analytic.quadrature import gauss_points


@dataclass(frozen=True, kw_only=True)
class Sections:
    """Sections of elements, (elements,), or at points of them: m [kg/m], EI [N m²], EA [N], ρI.

    ρI [kg m] is for elements that model it; where the blade tells none, that of a homogeneous
    section, m EI/EA.
    """

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

    blade: Blade
    elements: int
    nodes_of_element: int = 2

    @property
    def length(self) -> float:
        """Length of an element."""
        return self.blade.length / self.elements

    @cached_property
    def positions(self) -> FloatArray:
        """Places of the nodes along the undeformed blade, from the axis."""
        count = self.elements * (self.nodes_of_element - 1) + 1
        return self.blade.hub_radius + np.linspace(0.0, self.blade.length, count)

    @cached_property
    def sections(self) -> Sections:
        """The section of each element, (elements,), from the root."""
        inner, weights = gauss_points(8)
        at = self.sections_at(inner)
        return Sections(
            mass_per_length=at.mass_per_length @ weights,
            bending_stiffness=at.bending_stiffness @ weights,
            axial_stiffness=1.0 / ((1.0 / at.axial_stiffness) @ weights),
            rotary_inertia=at.rotary_inertia @ weights,
        )

    def sections_at(self, inner: FloatArray) -> Sections:
        """Return the sections at the points `inner`, from 0 to 1, of each element.

        Arrays are (elements, points).
        """
        return self.along((np.arange(self.elements)[:, None] + inner) / self.elements)

    def along(self, x: FloatArray) -> Sections:
        """Return the sections at places `x` from 0 to 1, in arrays of its shape."""
        blade, unit = self.blade, self.blade.unit
        m = blade.mass_per_length * evaluated(unit.mass, x)
        EI = blade.bending_stiffness * evaluated(unit.bending, x)
        EA = blade.axial_stiffness * evaluated(unit.axial, x)
        told = blade.section.rotary_inertia is not None
        own = blade.mass_per_length * blade.length**2 * evaluated(unit.rotary, x)
        return Sections(
            mass_per_length=m,
            bending_stiffness=EI,
            axial_stiffness=EA,
            rotary_inertia=own if told else m * EI / EA,
        )

    def lumped(self) -> Iterator[tuple[int, PointMass]]:
        """Yield the nodes that carry a mass, and the masses; refuse one that is not at a node."""
        for one in self.blade.point_masses:
            node = round((self.positions.size - 1) * one.position / self.blade.length)
            off = abs(self.blade.hub_radius + one.position - self.positions[node])
            if off > 1e-9 * self.blade.length:
                raise ValueError(
                    f"no node of {self.elements} elements is at the point mass at "
                    f"{one.position / self.blade.length:.6g} of the length, the nearest is "
                    f"{off / self.blade.length:.2g} of it away: take a number of elements that "
                    "puts one there"
                )
            yield node, one


HERMITE = tuple(
    np.polynomial.Polynomial(c)
    for c in ([1, 0, -3, 2], [0, 1, -2, 1], [0, 0, 3, -2], [0, 0, -1, 1])
)
"""Functions of value and slope at one end and the other, over ξ from 0 to 1, on unit length."""

_LAGRANGE = {
    1: tuple(np.polynomial.Polynomial(c) for c in ([1, -1], [0, 1])),
    2: tuple(np.polynomial.Polynomial(c) for c in ([1, -3, 2], [0, 4, -4], [0, -1, 2])),
}


def lagrange(xi: FloatArray, degree: int, order: int = 0) -> FloatArray:
    """Return the derivatives to ξ from 0 to 1, of `order`, of Lagrange's with evenly spaced nodes.

    (points, nodes); degree 2 is Eqs. 3-5.
    """
    functions = (f.deriv(order) if order else f for f in _LAGRANGE[degree])
    return np.stack([function(xi) for function in functions], axis=1)


def scales(length: float) -> FloatArray:
    """Return the factors from a unit cell's shape functions to a cell's of `length`, (4,)."""
    return np.array([1.0, length, 1.0, length])


def shapes(xi: float | FloatArray, length: float, order: int) -> FloatArray:
    """Return the derivatives to x, of `order`, at ξ = x/l, (..., 4)."""
    unit = [(function.deriv(order) if order else function)(xi) for function in HERMITE]
    return np.asarray(np.stack(unit, axis=-1) * scales(length) / length**order)
