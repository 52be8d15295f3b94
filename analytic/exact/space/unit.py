"""A blade in space without dimensions: its line and its section out of the plane."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields

import numpy as np

from ...arrays import FloatArray
from ...beam import AnyBlade
from ...line import STRAIGHT, Line, Offset, scaled
from ...profiles import Profile, evaluated
from ...unit_blade import UnitBlade
from .vectors import Frames, about_axis, turned

_POINTS = 40  # on each panel, for the unloaded line


@dataclass(frozen=True, kw_only=True)
class SpaceUnit(UnitBlade):
    """A blade without dimensions, with its line and its section out of the plane.

    Attributes
    ----------
    angle : float
        ψ [rad].
    line : Line
        Over L.
    flap, torsion : float
        r = EI2/EI3 and g = GJ/EI3.
    polar : float or None
        ρI_p over m0 L² at the root, None of a homogeneous section.
    told_rotary : bool
        Whether the section tells `rotary`.
    body_offsets : tuple
        (c2, c3) over L of each point mass.
    """

    angle: float = 0.0
    line: Line = STRAIGHT
    flap: float = 1.0
    torsion: float = math.inf
    polar: float | None = None
    told_rotary: bool = False
    body_offsets: tuple[Offset, ...] = ()

    @property
    def profiles(self) -> tuple[Profile, ...]:
        """Profiles along the blade."""
        line = self.line
        return (*super().profiles, line.twist, line.prebend, line.sweep)

    @property
    def twists(self) -> bool:
        """Whether slices twist against each other."""
        return self.torsion < math.inf

    @property
    def axis(self) -> FloatArray:
        """The axis of rotation in the root frame, (3,)."""
        return np.array([math.sin(self.line.precone), 0.0, math.cos(self.line.precone)])

    @property
    def clamp(self) -> FloatArray:
        """The clamp's place from the axis of rotation in the root frame, (3,)."""
        cone = self.line.precone
        return self.hub * np.array([math.cos(cone), 0.0, -math.sin(cone)])

    def unloaded(self, x: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the unloaded line at `x`, (places, 3), and its sections' axes (places, 3, 3).

        From the clamp and over L, in the root frame; axes in columns.
        """
        line, grid = self.line, self.grid(_POINTS, 0)
        angle, angle_x = (self.angle + evaluated(line.twist, at) for at in (grid.points, x))
        bows = np.stack([evaluated(one, grid.points) for one in (0.0, line.prebend, line.sweep)])
        frame, frame_x = Frames(grid, x).of(turned(about_axis(angle), bows)[:, None])
        place = grid.integral(x) @ frame[:, 0, 0].T
        sections = np.einsum("ijp,jkp->pik", frame_x[:, :, 0], about_axis(angle_x))
        return place, sections

    @property
    def bodies(self) -> list[tuple[float, float, float, Offset]]:
        """Position, mass, inertia and offset of each point mass."""
        return [(*one, offset) for one, offset in zip(self.masses, self.body_offsets, strict=True)]

    @property
    def _offsets(self) -> tuple[Offset, ...]:
        return self.line.mass_offset, self.line.tension_offset, *self.body_offsets

    @property
    def half_turn(self) -> bool:
        """Whether a half turn about the blade maps its motions onto motions in reversed time."""
        line = self.line
        straight = line.precone == 0.0 and line.prebend == 0.0 and line.sweep == 0.0
        return straight and not any(any(one) for one in self._offsets)

    @property
    def mirrored(self) -> bool:
        """Whether the mirror through the blade and the axis of rotation does so.

        Of sections whose own planes lie in that mirror and across it.
        """
        line = self.line
        straight = line.twist == 0.0 and line.sweep == 0.0 and self.angle == 0.0
        return straight and not any(one[0] for one in self._offsets)


def space_unit(beam: AnyBlade) -> SpaceUnit:
    """Return a blade in space without dimensions; its section out of the plane is known."""
    blade = beam.blade
    unit, out, length = blade.unit, blade.section.out_of_plane, blade.length
    assert out is not None
    assert out.torsion_ratio is not None
    polar = out.polar_inertia
    return SpaceUnit(
        **{field.name: getattr(unit, field.name) for field in fields(unit)},
        angle=blade.setting_angle,
        line=blade.line.in_units(length),
        flap=out.bending_ratio,
        torsion=out.torsion_ratio,
        polar=None if polar is None else polar / (blade.mass_per_length * length**2),
        told_rotary=blade.section.rotary_inertia is not None,
        body_offsets=tuple(scaled(one.offset, length) for one in blade.point_masses),
    )
