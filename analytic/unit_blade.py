"""A blade without dimensions: all that the theory reads of it."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np

from .arrays import FloatArray, Profile, evaluated, stations
from .parts import UNDAMPED, Damping
from .quadrature import Grid

_SAME = 1e-9  # stations and masses that are no farther apart
_MOST_PANELS = 64  # masses that are closer are so small that functions may smooth their jumps
_MOST_CELLS = 1000  # closer kinks are so small that Gauss points may smooth them
_MOST_CELLS_OF_FIELDS = 400  # and these so small that fields may
_STEEPEST = 2.0  # ratio of a stiffness within a cell: by 14 points more its inverse is smooth


@dataclass(frozen=True, kw_only=True)
class UnitBlade:
    """Data of a blade in units of L and the root's m, EI and EA; by default the uniform beam."""

    hub: float = 0.0  # δ = R/L
    angle: float = 0.0  # ψ [rad], with a twist that is the same all along
    # Position, mass and inertia of each point mass, over L, m0 L and m0 L³.
    masses: tuple[tuple[float, float, float], ...] = ()
    mass: Profile = 1.0  # over the root's m; stations over L here and below
    bending: Profile = 1.0  # over the root's EI
    axial: Profile = 1.0  # over the root's EA
    rotary: Profile = 0.0  # inertia against rotation over m0 L²
    shear: Profile | None = None  # over the root's GA; as the axial stiffness if None
    cuts: tuple[float, ...] = ()  # where slices change besides, out of the plane or in shear
    loaded: tuple[float, ...] = ()  # where loads on the span begin, end or act on a point
    damping: Damping = UNDAMPED  # each η times f and d/(m0 f), with f = √(EI/(m0 L⁴))

    @cached_property
    def setting(self) -> float:
        """Cos ψ, by which rotation acts in the plane of bending."""
        return math.cos(self.angle)

    @cached_property
    def panels(self) -> FloatArray:
        """Ends of the panels between point masses and loads, at which forces jump, 0 to 1."""
        jumps = (*(position for position, _, _ in self.masses), *self.loaded)
        return _some(apart(jumps), _MOST_PANELS)

    @property
    def profiles(self) -> tuple[Profile, ...]:
        """Profiles along the blade."""
        return self.mass, self.bending, self.axial, self.rotary

    def stiffnesses(self, x: FloatArray) -> list[FloatArray]:
        """Return the stiffnesses at `x`, whose inverse is integrated."""
        return [evaluated(profile, x) for profile in (self.bending, self.axial)]

    @cached_property
    def cells(self) -> FloatArray:
        """Ends of the cells on which the section is smooth and nowhere steep, 0 to 1."""
        kinks = [x for profile in self.profiles for x in stations(profile)]
        ends = apart([*kinks, *self.cuts, *(position for position, _, _ in self.masses)])
        ends = np.union1d(_some(ends, _MOST_CELLS), self.panels)
        return np.array([0.0, *(x for a, b in pairwise(ends) for x in self._gentle(a, b))])

    def _gentle(self, start: float, end: float) -> list[float]:
        """Return the ends of the cells, after `start`, into which a smooth stretch is halved."""
        at = np.linspace(start, end, 9)
        values = self.stiffnesses(at)
        if end - start < _SAME or all(v.max() <= _STEEPEST * v.min() for v in values):
            return [end]
        middle = 0.5 * (start + end)
        return [*self._gentle(start, middle), *self._gentle(middle, end)]

    @property
    def panel_count(self) -> int:
        """Number of panels."""
        return self.panels.size - 1

    @property
    def differences(self) -> str:
        """The differences from the uniform beam, in words."""
        sections = {self.mass, self.bending, self.axial}
        return " and ".join(
            name
            for name, there in (
                ("a hub", self.hub != 0.0),
                ("point masses", bool(self.masses)),
                ("a setting angle", self.setting != 1.0),
                ("a variable section", sections != {1.0}),
                ("rotary inertia", self.rotary != 0.0),
                ("damping", bool(self.damping)),
            )
            if there
        )

    def grid(self, count: int, more: int, *, of_fields: bool = False) -> Grid:
        """Return Gauss points: `count` for each panel, dense at its ends, and `more` on each cell.

        Those for fields are on fewer cells: where there are many, their kinks are small.
        """
        ends = self.cells
        if of_fields:
            ends = np.union1d(_some(ends, _MOST_CELLS_OF_FIELDS), self.panels)
        panel = np.searchsorted(self.panels, 0.5 * (ends[:-1] + ends[1:])) - 1
        start, width = self.panels[panel], np.diff(self.panels)[panel]
        # Polynomials vary the faster the nearer the ends of their panel.
        left, right = (
            np.arccos(np.clip(1.0 - 2.0 * (at - start) / width, -1.0, 1.0)) / np.pi
            for at in (ends[:-1], ends[1:])
        )
        return Grid(ends, np.ceil(count * (right - left) - _SAME).astype(np.intp) + more)

    def quadrature(self, count: int) -> tuple[FloatArray, FloatArray]:
        """Return points and weights on [0, 1] for polynomials of a degree up to 2 `count`."""
        grid = self.grid(count, 4)
        return grid.points, grid.weights

    def inertia(self, count: int) -> tuple[FloatArray, FloatArray]:
        """Return points and their masses dm, the point masses' at the end."""
        return self._measure(count, self.mass, 1)

    def turning(self, count: int) -> tuple[FloatArray, FloatArray]:
        """Return the measure dj against rotation, as `inertia`."""
        return self._measure(count, self.rotary, 2)

    def _measure(self, count: int, along: Profile, kind: int) -> tuple[FloatArray, FloatArray]:
        x, weights = self.quadrature(count)
        lumped = np.array(self.masses).reshape(-1, 3)
        return np.append(x, lumped[:, 0]), np.append(weights * evaluated(along, x), lumped[:, kind])


def apart(inner: Iterable[float], least: float = _SAME) -> FloatArray:
    """Return 0, 1 and the values between them, ascending; neighbors less apart become one."""
    ends = sorted({0.0, 1.0} | {x for x in inner if least < x < 1.0 - least})
    return np.array([x for x, y in zip(ends, [-1.0, *ends], strict=False) if x - y > least])


def _some(ends: FloatArray, most: int) -> FloatArray:
    """Return the ends of at most so many stretches, both outer ends among them."""
    count = ends.size - 1
    return np.asarray(ends[np.linspace(0, count, min(count, most) + 1).round().astype(int)])


UNIFORM = UnitBlade()
"""The uniform beam without a hub, turning in its plane."""
