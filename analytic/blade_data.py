"""The data of a blade, its checks, and the scales that follow from them; SI units."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from .arrays import FloatArray, evaluated, in_units
from .description import Described
from .input_checks import checked_angle, not_negative, positive, require_offset, shown
from .parts import STRAIGHT, UNDAMPED, Damping, Line, PointMass
from .section import Section
from .section_shape import Gyration
from .shape_functions import shape_functions
from .station_section import StationSection
from .unit_blade import UnitBlade

_FUNCTIONS, _POINTS = 24, 32  # for scales: ω0 and the burst speed
_HEAVY = 1000.0  # masses above this many times the blade's are taken for a slip in units


def _several(masses: object) -> tuple[PointMass, ...]:
    if isinstance(masses, (list, tuple)) and all(isinstance(one, PointMass) for one in masses):
        return tuple(masses)
    raise TypeError(f"point_masses must be several, as (PointMass(...),), got {shown(masses)}")


@dataclass(frozen=True, kw_only=True)
class BladeData(Described, abstract=True):
    """Lengths, sections, masses and damping of a `Blade`, with its frequencies at rest."""

    length: float
    section: Section
    hub_radius: float = 0.0
    setting_angle: float = 0.0
    point_masses: tuple[PointMass, ...] = ()
    damping: Damping = UNDAMPED
    line: Line = STRAIGHT

    def __post_init__(self) -> None:
        self._keep(
            length=positive("length", self.length, "m"),
            hub_radius=not_negative("hub_radius", self.hub_radius, "m"),
            setting_angle=checked_angle("setting_angle", self.setting_angle),
            point_masses=_several(self.point_masses),
        )
        for name, kind in (("section", Section), ("damping", Damping), ("line", Line)):
            if not isinstance(getattr(self, name), kind):
                raise TypeError(
                    f"{name} must be a {kind.__name__}, got {shown(getattr(self, name))}"
                )
        self.section.require_along(self.length)
        self.line.require_along(self.length)
        offsets = (*self.line.mass_offset, *self.line.tension_offset)
        if self.table and any(offsets):
            raise ValueError(
                "the stations define where the centers are: leave with_offsets out, or give "
                "from_stations the offsets tension, shear and center"
            )
        self._require_masses()

    @property
    def table(self) -> StationSection | None:
        """The section if it is a table of stations, else None."""
        return self.section if isinstance(self.section, StationSection) else None

    def _require_masses(self) -> None:
        m = self.mass - sum(one.mass for one in self.point_masses)
        for one in self.point_masses:
            require_offset("the offset of a point mass", one.offset, self.length)
            if one.position > self.length * (1.0 + 1e-12):
                raise ValueError(
                    f"a point mass at {one.position:g} m is beyond the tip at {self.length:g} m: "
                    "take a position from the clamp, not from the axis"
                )
            if one.mass > _HEAVY * m:
                raise ValueError(
                    f"a point mass of {one.mass:g} kg is {one.mass / m:.3g} times the blade's "
                    f"{m:.4g} kg: give it in kg, or clamp the blade there"
                )

    @property
    def gyration(self) -> Gyration:
        """I/A at the root, and A where it is known."""
        return Gyration(squared=self.slenderness * self.length**2)

    @property
    def is_planar(self) -> bool:
        """Whether motion in the plane of bending stays there, as that of no other keeps it.

        Of a straight blade, twisted at most by the same angle all along, without offsets.
        """
        offset = any(any(one.offset) for one in self.point_masses)
        return self.line.is_straight and not offset and self.section.is_planar

    @property
    def mass(self) -> float:
        """Total mass [kg], point masses included."""
        return float(self.unit.inertia(_FUNCTIONS)[1].sum()) * self.mass_per_length * self.length

    @property
    def axial_stiffness(self) -> float:
        """EA at the root [N]."""
        return self._root("axial_stiffness")

    @property
    def bending_stiffness(self) -> float:
        """EI at the root [N m²]."""
        return self._root("bending_stiffness")

    @property
    def mass_per_length(self) -> float:
        """Mass per length at the root [kg/m]."""
        return self._root("mass_per_length")

    @property
    def slenderness(self) -> float:
        """μ = EI/(EA L²) at the root [-]."""
        return self.bending_stiffness / (self.axial_stiffness * self.length**2)

    @property
    def frequency_scale(self) -> float:
        """√(EI/(ρAL⁴)) at the root, by which w̄ = ω over it [rad/s]."""
        return math.sqrt(self.bending_stiffness / (self.mass_per_length * self.length**4))

    @cached_property
    def omega_0(self) -> float:
        """First frequency of bending at rest [rad/s]."""
        return float(self.frequencies_at_rest[0])

    @cached_property
    def frequencies_at_rest(self) -> FloatArray:
        """Frequencies of bending at rest [rad/s], at least 24; the first half are resolved."""
        across = shape_functions(self.unit, _FUNCTIONS)
        (at, dm), (x, dj) = self.unit.inertia(_POINTS), self.unit.turning(_POINTS)
        moved, turned = across.twice(at), across.once(x)
        M = moved.T @ (dm[:, None] * moved) + turned.T @ (dj[:, None] * turned)
        return np.asarray(self.frequency_scale / np.sqrt(np.linalg.eigvalsh(M)[::-1]))

    @cached_property
    def burst_speed(self) -> float:
        """Speed [rad/s] at which the rotation stretches the blade without bound.

        That is its first axial frequency at rest: at it no stretched state exists any more.
        """
        at, dm = self.unit.inertia(_POINTS)
        moved = shape_functions(self.unit, _FUNCTIONS, "axial").once(at)
        slowest = float(np.linalg.eigvalsh(moved.T @ (dm[:, None] * moved))[-1])
        return self.frequency_scale / math.sqrt(slowest * self.slenderness)

    @cached_property
    def unit(self) -> UnitBlade:
        """The blade without dimensions."""
        m0, length, section = self._root("mass_per_length"), self.length, self.section
        twist = self.line.in_units(length).twist
        return UnitBlade(
            hub=self.hub_radius / length,
            angle=self.setting_angle + (0.0 if isinstance(twist, tuple) else twist),
            masses=tuple(
                (one.position / length, one.mass / (m0 * length), one.inertia / (m0 * length**3))
                for one in self.point_masses
            ),
            mass=in_units(section.mass_per_length, length, m0),
            bending=in_units(section.bending_stiffness, length, self.bending_stiffness),
            axial=in_units(section.axial_stiffness, length, self.axial_stiffness),
            rotary=in_units(section.rotary_inertia or 0.0, length, m0 * length**2),
            damping=self.damping.in_units(length, m0 * length, 1.0 / self.frequency_scale),
        )

    def _root(self, name: str) -> float:
        return float(evaluated(self.section.profiles()[name], np.zeros(1))[0])

    def __str__(self) -> str:
        tip = {
            name: float(evaluated(in_units(profile, self.length, 1.0), np.ones(1))[0])
            for name, profile in self.section.profiles().items()
        }
        masses = ", ".join(f"{one.mass:g} kg at {one.position:g} m" for one in self.point_masses)
        damped = f"\n  {self.damping}" if self.damping else ""
        return (
            f"Blade of {self.length:g} m on a hub of {self.hub_radius:g} m, "
            f"set at {self.setting_angle:.4g} rad\n"
            f"  EI {self.bending_stiffness:.4g} to {tip['bending_stiffness']:.4g} N m², "
            f"EA {self.axial_stiffness:.4g} to {tip['axial_stiffness']:.4g} N, "
            f"ρA {self.mass_per_length:.4g} to {tip['mass_per_length']:.4g} kg/m\n"
            f"  point masses: {masses or 'none'}{damped}"
        )
