"""A blade in space without dimensions: its line and its section out of the plane."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from ...arrays import FloatArray, Profile, evaluated, in_units, profile_at
from ...parts import STRAIGHT, Line, Offset, scaled
from ...quadrature import Grid, Running
from ...shape_functions import shape_functions
from ...station_section import StationSection, about_centers
from ...theory import Theory
from ...unit_blade import UnitBlade
from .vectors import Frames, about_axis, turned

if TYPE_CHECKING:
    from ...blade import Blade

_POINTS, _MORE = 40, 4  # on each panel and each cell, for the unloaded line
_ALIKE = 1e-12  # of EI2 and EI3, as round-off leaves them


@dataclass(frozen=True, kw_only=True)
class SpaceUnit(UnitBlade):
    """A blade without dimensions, with its line and its section out of the plane."""

    line: Line = STRAIGHT  # over L
    flap: float = 1.0  # r = EI2/EI3
    torsion: float = math.inf  # g = GJ/EI3
    turns: bool = False  # whether the section tells its rotary inertia
    body_offsets: tuple[Offset, ...] = ()  # (c2, c3) over L of each point mass

    @cached_property
    def panels(self) -> FloatArray:
        """Ends of the panels between point masses and kinks, 0 to 1."""
        return np.union1d(super().panels, [x for x, *_ in self.line.kinks])

    @property
    def tolerance(self) -> float:
        """Change by a refinement at which frequencies, and places over the length, have settled."""
        return 1e-9

    @property
    def answers(self) -> bool:
        """Whether forces have kinks, so that answers make functions."""
        return False

    @property
    def profiles(self) -> tuple[Profile, ...]:
        """Profiles along the blade."""
        line = self.line
        return (*super().profiles, line.twist, line.prebend, line.sweep)

    @property
    def tail(self) -> float:
        """How many times the residual of an orbit may be that of smooth sections."""
        return 1.0

    def torques(self, count: int, x: FloatArray) -> FloatArray:
        """Return the torques at `x` from which functions for κ1 are made, (places, count)."""
        return shape_functions(self, count).forces(x)

    def flexibility(self, x: FloatArray, theory: Theory, slenderness: float) -> FloatArray:
        """Return the inverse of the stiffness in axes of the section, (places, 6, 6).

        Strains over forces in the order ε, γ2, γ3, κ1, κ2, κ3; what a theory keeps rigid is zero.
        """
        EI3, EA = evaluated(self.bending, x), evaluated(self.axial, x) / slenderness
        soft = np.zeros((x.size, 6))
        soft[:, 0] = 1.0 / EA
        if theory.shear is not None:
            soft[:, 1] = soft[:, 2] = 1.0 / (theory.shear * EA)
        soft[:, 3:] = 1.0 / np.outer(EI3, [self.torsion, self.flap, 1.0])
        # The mean strain is that at the center of tension.
        onto = np.eye(6)
        onto[0, 5], onto[0, 4] = self.line.tension_offset[0], -self.line.tension_offset[1]
        return np.asarray(onto * soft[:, None] @ onto.T)

    def elastic(self, x: FloatArray, theory: Theory) -> FloatArray:
        """Return the part of forces that strains answer over all of them, (places, 6, 6): all."""
        del theory
        return np.tile(np.eye(6), (x.size, 1, 1))

    def inertia_about(self, x: FloatArray, slenderness: float) -> tuple[FloatArray, FloatArray]:
        """Return the centers of mass (3, places) from the line, and J about them (3, 3, places).

        J is that of the section or, where it has none, of a homogeneous one.
        """
        j3 = evaluated(self.rotary, x)
        if not self.turns:
            mass, bending = evaluated(self.mass, x), evaluated(self.bending, x)
            j3 = slenderness * mass * bending / evaluated(self.axial, x)
        j2 = self.flap * j3
        center = np.outer((0.0, *self.line.mass_offset), np.ones_like(x))
        return center, np.stack((j2 + j3, j2, j3)) * np.eye(3)[:, :, None]

    @property
    def twists(self) -> bool:
        """Whether slices twist against each other."""
        return self.torsion < math.inf

    @property
    def bends_alike(self) -> bool:
        """Whether slices bend out of the plane as in it."""
        return bool(np.abs(self.flap_ratios - 1.0).max() <= _ALIKE)

    @property
    def flap_ratios(self) -> FloatArray:
        """EI2/EI3 where they may differ."""
        return np.array([self.flap])

    @property
    def flapping(self) -> Profile:
        """Stiffness against flap over that at the root."""
        return self.bending

    @property
    def twisting(self) -> Profile:
        """Stiffness against torsion over that at the root."""
        return self.bending

    @property
    def axis(self) -> FloatArray:
        """The axis of rotation in the root frame, (3,)."""
        return np.array([math.sin(self.line.precone), 0.0, math.cos(self.line.precone)])

    @property
    def clamp(self) -> FloatArray:
        """The clamp's place from the axis of rotation in the root frame, (3,)."""
        cone = self.line.precone
        return self.hub * np.array([math.cos(cone), 0.0, -math.sin(cone)])

    def section_frames(self, x: FloatArray) -> FloatArray:
        """Return the section's frame in that without twist, (3, 3, places)."""
        return about_axis(self.angle + evaluated(self.line.twist, x))

    def bent(self, x: FloatArray) -> FloatArray:
        """Return the curvatures of the unloaded line in the frame without twist, (3, places)."""
        line = self.line
        bows = np.stack([evaluated(one, x) for one in (0.0, line.prebend, line.sweep)])
        return turned(self.section_frames(x), bows)

    @property
    def kinks(self) -> list[tuple[float, FloatArray]]:
        """Places and rotation vectors (3,) of the line's kinks, in the frame without twist."""
        return [
            (x, self.section_frames(np.array([x]))[:, 1:, 0] @ angles)
            for x, *angles in self.line.kinks
        ]

    def unloaded(self, x: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the unloaded line at `x`, (places, 3), and its sections' axes (places, 3, 3).

        From the clamp and over L, in the root frame; axes in columns.
        """
        grid = self.grid(_POINTS, _MORE)
        running = self.running(grid, x)
        frame = Frames(running, self.kinks).of(self.bent(grid.points)[:, None])[:, :, 0]
        count = grid.points.size
        place = running.of(frame[:, 0, :count])[:, count:].T
        sections = np.einsum("ijp,jkp->pik", frame[:, :, count:], self.section_frames(x))
        return place, sections

    def running(self, grid: Grid, x: FloatArray) -> Running:
        """Return integrals up to the grid's points and then up to `x`, for `Frames`."""
        return Running(grid, np.concatenate((grid.points, x)), [at for at, *_ in self.line.kinks])

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
        return straight and not line.kinks and not any(any(one) for one in self._offsets)

    @property
    def mirrored(self) -> bool:
        """Whether the mirror through the blade and the axis of rotation does so.

        Of sections whose own planes lie in that mirror and across it.
        """
        line = self.line
        straight = line.twist == 0.0 and line.sweep == 0.0 and self.angle == 0.0
        across = (*(kink[2] for kink in line.kinks), *(one[0] for one in self._offsets))
        return straight and not any(across)


@dataclass(frozen=True, kw_only=True)
class StationUnit(SpaceUnit):
    """A blade in space without dimensions, by 6x6 matrices in units of L and the root's m0, EI3."""

    section: StationSection

    @property
    def tolerance(self) -> float:
        """As that of other blades; tables have few digits."""
        return 1e-6

    @property
    def answers(self) -> bool:
        """True: centers and stiffness have kinks at the stations."""
        return True

    def stiffnesses(self, x: FloatArray) -> list[FloatArray]:
        """Return all six about their centers at `x`."""
        return list(about_centers(self.section.matrices(x)[0])[1].diagonal(axis1=1, axis2=2).T)

    @property
    def tail(self) -> float:
        """More where forces in the frame of a section, which bends by kinks, have kinks too."""
        return 20.0 if len(self.section.x) > 2 else 1.0

    def torques(self, count: int, x: FloatArray) -> FloatArray:
        """Return integrals of polynomials times the inertia against torsion, if there is one."""
        inertia = self.section.inertia_against_torsion
        if evaluated(inertia, x).min() <= 0.0:
            return super().torques(count, x)
        return shape_functions(replace(self, mass=inertia), count, "axial").forces(x)

    def flexibility(self, x: FloatArray, theory: Theory, slenderness: float) -> FloatArray:
        """Return the inverse of the stiffness, (places, 6, 6); a theory leaves forces out."""
        del theory, slenderness
        return np.asarray(np.linalg.inv(self.section.matrices(x)[0]))

    def elastic(self, x: FloatArray, theory: Theory) -> FloatArray:
        """Return the part of forces that strains answer over all of them, (places, 6, 6).

        At the centers of tension and shear those that the theory leaves out are reactions.
        """
        onto, _ = about_centers(self.section.matrices(x)[0])
        sheared = theory.shear is not None
        there = np.array([theory.extension, sheared, sheared, True, True, True])
        back = 2.0 * np.eye(6) - onto
        return np.asarray(np.swapaxes(onto, 1, 2) * there @ np.swapaxes(back, 1, 2))

    def inertia_about(self, x: FloatArray, slenderness: float) -> tuple[FloatArray, FloatArray]:
        """Return the centers of mass (3, places), and the inertia about them (3, 3, places)."""
        del slenderness
        mass = self.section.matrices(x)[1]
        carried = mass[:, 3:, :3] / mass[:, :1, :1]  # c ×
        center = np.stack((carried[:, 2, 1], carried[:, 0, 2], carried[:, 1, 0]))
        about = mass[:, 3:, 3:] + mass[:, :1, :1] * carried @ carried
        return center, np.moveaxis(about, 0, -1)

    @property
    def twists(self) -> bool:
        """True: the matrices contain GJ."""
        return True

    @property
    def flap_ratios(self) -> FloatArray:
        """EI2/EI3 at the stations."""
        bends = self.section.stiffnesses[:, 4:]
        return np.asarray(bends[:, 0] / bends[:, 1])

    @property
    def flapping(self) -> Profile:
        """EI2 over that at the root."""
        return self._over_root(4)

    @property
    def twisting(self) -> Profile:
        """GJ over that at the root."""
        return self._over_root(3)

    def _over_root(self, axis: int) -> Profile:
        values = self.section.stiffnesses[:, axis]
        return in_units(profile_at(self.section.x, values), 1.0, float(values[0]))

    @property
    def half_turn(self) -> bool:
        """Whether a half turn about the blade maps its motions onto motions in reversed time."""
        return super().half_turn and not self.section.couples((0, 3), (1, 2, 4, 5))

    @property
    def mirrored(self) -> bool:
        """Whether the mirror through the blade and the axis of rotation does so."""
        return super().mirrored and not self.section.couples((1, 3, 5), (0, 2, 4))


def trapeze_of(soft: FloatArray) -> FloatArray:
    """Return k² = (EI2 + EI3)/EA of the trapeze effect, (places,), from strains over forces.

    Bending stiffness about the center of tension, and compliance to axial force there.
    """
    bends, beside = np.linalg.inv(soft[:, 4:, 4:]), soft[:, 0, 4:]
    along = soft[:, 0, 0] - np.einsum("pi,pij,pj->p", beside, bends, beside)
    return np.asarray(np.trace(bends, axis1=1, axis2=2) * along)


def space_unit(blade: Blade) -> SpaceUnit:
    """Return a blade in space without dimensions; its section out of the plane is known."""
    unit, out, length = blade.unit, blade.section.out_of_plane, blade.length
    common: dict[str, Any] = {field.name: getattr(unit, field.name) for field in fields(unit)}
    line = blade.line.in_units(length)
    common |= {
        "cuts": blade.section.cuts(length),
        # A twist that is the same all along is in the angle.
        "line": line if isinstance(line.twist, tuple) else replace(line, twist=0.0),
        "body_offsets": tuple(scaled(one.offset, length) for one in blade.point_masses),
    }
    if out is None:
        mass, time = blade.mass_per_length * length, 1.0 / blade.frequency_scale
        section: Any = blade.section.in_units(length, mass, time)
        return StationUnit(**common, section=section, turns=True)
    assert out.torsion_ratio is not None
    return SpaceUnit(
        **common,
        flap=out.bending_ratio,
        torsion=out.torsion_ratio,
        turns=blade.section.rotary_inertia is not None,
    )
