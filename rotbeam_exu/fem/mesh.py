"""A beam or blade on a mesh: nodes, sections and masses of its elements, and shape functions."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from analytic import Blade, PointMass
from analytic.arrays import FloatArray, evaluated, stations
from analytic.quadrature import gauss_points
from analytic.unit_blade import apart

_SAME = 1e-9  # of an element, by which a station may be off its end
_SHORT = 1e-3  # of the length: of stations that are closer one gets a node


@dataclass(frozen=True, kw_only=True)
class Sections:
    """Sections of elements, (elements,), or at points of them: m [kg/m], EI [N m²], EA [N], ρI.

    ρI [kg m] is for elements that model it; where the blade has none, that of a homogeneous
    section, m EI/EA.
    """

    mass_per_length: FloatArray
    bending_stiffness: FloatArray
    axial_stiffness: FloatArray
    rotary_inertia: FloatArray


@dataclass(frozen=True, kw_only=True)
class Mesh:
    """Elements on a beam or blade, with nodes where its section or line has a station.

    Between stations, point masses and kinks elements are of equal length, as many on each stretch
    as make the longest of all the shortest. Where they are fewer than the stretches only masses and
    kinks have nodes, and of stations closer than a thousandth of the length one.

    Exudyn's elements have a constant section: the mean of its mass and EI, of its compliance 1/EA
    and, across a station, of 1/EI. Of a blade that tapers they converge to second order, whatever
    their own: with height and width tapered by a half and three tenths, 64 cables are off by 1.1e-4
    in frequency. An element of our own takes the sections at its Gauss points, or their mean across
    stations.
    """

    blade: Blade
    elements: int
    nodes_of_element: int = 2

    @cached_property
    def stations(self) -> FloatArray:
        """Places from 0 to 1 where section or line bend or step, and of masses; with both ends."""
        return apart([*self._bends, *self._places])

    @property
    def _bends(self) -> list[float]:
        blade = self.blade
        line = blade.line.in_units(blade.length)
        profiles = (*blade.unit.profiles, line.twist, line.prebend, line.sweep)
        return [x for profile in profiles for x in stations(profile)]

    @property
    def _places(self) -> list[float]:
        """Places where a node must be: of masses, and of kinks of the line."""
        kinks = [place / self.blade.length for place, *_ in self.blade.line.kinks]
        return [*(position for position, _, _ in self.blade.unit.masses), *kinks]

    @cached_property
    def ends(self) -> FloatArray:
        """Ends of the elements over the length, (elements + 1,)."""
        # Much shorter elements would cost the solver its digits.
        stretches = apart([*apart(self._bends, _SHORT), *self._places])
        if self.elements < stretches.size - 1:
            stretches = apart(self._places)
        if (least := stretches.size - 1) > self.elements:
            raise ValueError(
                f"{self.elements} elements have no nodes at all point masses and kinks of this "
                f"blade: take {least} or more"
            )
        lengths, counts = np.diff(stretches), np.ones(stretches.size - 1, dtype=int)
        for _ in range(self.elements - counts.size):
            counts[np.argmax(lengths / counts)] += 1
        parts = zip(stretches[:-1], stretches[1:], counts, strict=True)
        return np.append(np.concatenate([np.linspace(a, b, n + 1)[:-1] for a, b, n in parts]), 1.0)

    @cached_property
    def lengths(self) -> FloatArray:
        """Lengths of the elements, (elements,)."""
        return self.blade.length * np.diff(self.ends)

    @cached_property
    def places(self) -> FloatArray:
        """Places of the nodes along the undeformed blade, from the clamp."""
        inner = self.nodes_of_element - 1
        count = np.arange(inner * self.elements + 1) / inner
        return self.blade.length * np.interp(count, np.arange(self.elements + 1), self.ends)

    @property
    def positions(self) -> FloatArray:
        """The same from the axis."""
        return self.blade.hub_radius + self.places

    def mean(self, values: Callable[[FloatArray], FloatArray]) -> FloatArray:
        """Return the mean of a function of x, from 0 to 1, over each element, (elements, ...)."""
        inner, weights = gauss_points(8)
        cells = np.union1d(self.ends, self.stations)
        width, first = np.diff(cells), np.searchsorted(cells, self.ends[:-1])
        samples = values((cells[:-1, None] + np.outer(width, inner)).ravel())
        samples = (samples.T * np.outer(width, weights).ravel()).T
        sums = np.add.reduceat(samples, weights.size * first)
        return np.asarray((sums.T / np.diff(self.ends)).T)

    @cached_property
    def across(self) -> NDArray[np.bool_]:
        """Whether an element has a station inside, (elements,)."""
        cell, xi = cells(self.ends, self.stations)
        return np.isin(np.arange(self.elements), cell[(xi > _SAME) & (xi < 1.0 - _SAME)])

    @cached_property
    def sections(self) -> Sections:
        """The section of each element, (elements,), from the root."""
        bends = 1.0 / self.mean(lambda x: 1.0 / self.along(x).bending_stiffness)
        smooth = self.mean(lambda x: self.along(x).bending_stiffness)
        return Sections(
            mass_per_length=self.mean(lambda x: self.along(x).mass_per_length),
            bending_stiffness=np.where(self.across, bends, smooth),
            axial_stiffness=1.0 / self.mean(lambda x: 1.0 / self.along(x).axial_stiffness),
            rotary_inertia=self.mean(lambda x: self.along(x).rotary_inertia),
        )

    def sections_at(self, inner: FloatArray) -> Sections:
        """Return the sections at the points `inner`, from 0 to 1, of each element.

        Arrays are (elements, points); of an element across a station they are its mean.
        """
        at = self.along(self.ends[:-1, None] + np.outer(np.diff(self.ends), inner))
        across, values = self.across[:, None], vars(self.sections).items()
        return Sections(**{n: np.where(across, one[:, None], getattr(at, n)) for n, one in values})

    def along(self, x: FloatArray) -> Sections:
        """Return the sections at places `x` from 0 to 1, in arrays of its shape."""
        blade, unit = self.blade, self.blade.unit
        m = blade.mass_per_length * evaluated(unit.mass, x)
        EI = blade.bending_stiffness * evaluated(unit.bending, x)
        EA = blade.axial_stiffness * evaluated(unit.axial, x)
        stated = blade.section.rotary_inertia is not None
        of_section = blade.mass_per_length * blade.length**2 * evaluated(unit.rotary, x)
        return Sections(
            mass_per_length=m,
            bending_stiffness=EI,
            axial_stiffness=EA,
            rotary_inertia=of_section if stated else m * EI / EA,
        )

    def lumped(self) -> Iterator[tuple[int, PointMass]]:
        """Yield the nodes that carry a mass, and the masses."""
        for one in self.blade.point_masses:
            yield int(np.argmin(np.abs(self.places - one.position))), one


def cells(ends: FloatArray, s: FloatArray) -> tuple[NDArray[np.intp], FloatArray]:
    """Return in which of the cells between `ends` places are, and where inside, from 0 to 1."""
    cell = np.clip(np.searchsorted(ends, s, side="right") - 1, 0, ends.size - 2)
    return cell, (s - ends[cell]) / np.diff(ends)[cell]


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


def scales(length: float | FloatArray) -> FloatArray:
    """Return the factors from a unit cell's shape functions to cells' of `length`, (..., 4)."""
    return np.stack(np.broadcast_arrays(1.0, length, 1.0, length), axis=-1)


def shapes(xi: float | FloatArray, length: float | FloatArray, order: int) -> FloatArray:
    """Return the derivatives to x, of `order`, at ξ = x/l, (..., 4)."""
    unit = [(function.deriv(order) if order else function)(xi) for function in HERMITE]
    per = np.asarray(length)[..., None] ** order
    return np.asarray(np.stack(unit, axis=-1) * scales(length) / per)
