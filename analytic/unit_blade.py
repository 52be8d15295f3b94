"""A blade without dimensions: all that the theory reads of it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from .arrays import FloatArray
from .profiles import Profile, degree_of, evaluated, stations
from .quadrature import gauss_points_on

_SAME = 1e-9  # stations and masses that are no farther apart
_MOST_PANELS = 64  # closer kinks are so small that functions may smooth them


@dataclass(frozen=True, kw_only=True)
class UnitBlade:
    """What of a blade is not the uniform beam, in units of L and the root's m, EI and EA.

    Attributes
    ----------
    hub : float
        δ = R/L.
    setting : float
        c = cos ψ.
    masses : tuple
        Position, mass and inertia of each point mass, over L, m0 L and m0 L³.
    mass : Profile
        Over the root's m; stations over L here and below.
    bending : Profile
        Over the root's EI.
    axial : Profile
        Over the root's EA.
    rotary : Profile
        Inertia against rotation over m0 L².
    damping : tuple
        η_b and η_a times f and d/(m0 f), with f = √(EI/(m0 L⁴)).
    """

    hub: float = 0.0
    setting: float = 1.0
    masses: tuple[tuple[float, float, float], ...] = ()
    mass: Profile = 1.0
    bending: Profile = 1.0
    axial: Profile = 1.0
    rotary: Profile = 0.0
    damping: tuple[float, float, float] = (0.0, 0.0, 0.0)

    @cached_property
    def kinks(self) -> FloatArray:
        """Where a profile has a station or a mass is, with both ends, 0 to 1."""
        profiles = (self.mass, self.bending, self.axial, self.rotary)
        inner = {x for profile in profiles for x in stations(profile)}
        inner |= {position for position, _, _ in self.masses}
        ends = sorted({0.0, 1.0} | {x for x in inner if _SAME < x < 1.0 - _SAME})
        return np.array([x for x, y in zip(ends, [-1.0, *ends], strict=False) if x - y > _SAME])

    @cached_property
    def panels(self) -> FloatArray:
        """Ends of the panels on which functions are smooth: the kinks, or some of very many."""
        count = self.kinks.size - 1
        kept = np.linspace(0, count, min(count, _MOST_PANELS) + 1).round().astype(int)
        return np.asarray(self.kinks[kept])

    @property
    def panel_count(self) -> int:
        """How many panels there are."""
        return self.panels.size - 1

    @property
    def degree(self) -> int:
        """Highest degree of a profile on a panel."""
        return max(map(degree_of, (self.mass, self.bending, self.axial, self.rotary)))

    @property
    def differences(self) -> str:
        """What makes it other than the uniform beam, in words."""
        sections = {self.mass, self.bending, self.axial}
        return " and ".join(
            name
            for name, there in (
                ("a hub", self.hub != 0.0),
                ("point masses", bool(self.masses)),
                ("a setting angle", self.setting != 1.0),
                ("a variable section", sections != {1.0}),
                ("rotary inertia", self.rotary != 0.0),
                ("damping", any(self.damping)),
            )
            if there
        )

    def quadrature(self, count: int) -> tuple[FloatArray, FloatArray]:
        """Return points and weights on [0, 1], `count` Gauss points between two kinks."""
        return gauss_points_on(count, self.kinks)

    def inertia(self, count: int) -> tuple[FloatArray, FloatArray]:
        """Return the measure dm: points and masses, the point masses' at the end."""
        x, weights = self.quadrature(count)
        at = np.array([position for position, _, _ in self.masses])
        lumped = np.array([mass for _, mass, _ in self.masses])
        return np.append(x, at), np.append(weights * evaluated(self.mass, x), lumped)


UNIFORM = UnitBlade()
"""The uniform beam without a hub, turning in its plane."""
