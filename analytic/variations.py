"""Ways to make of a beam or a blade another one that differs in one thing."""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from .damping import Damping
from .description import Described
from .input_checks import shown
from .line import STRAIGHT, Offset
from .point_mass import PointMass
from .profiles import Profile
from .section import OutOfPlane
from .section_shapes import Gyration, SectionShape

if TYPE_CHECKING:
    from .blade import Blade


class Variations(Described, abstract=True):
    """Base of Beam and Blade, which makes of either a blade that differs in one thing."""

    @property
    @abstractmethod
    def blade(self) -> Blade:
        """The same as a `Blade`."""

    @property
    def gyration(self) -> Gyration:
        """I/A at the root, and A where it is known."""
        blade = self.blade
        return Gyration(squared=blade.slenderness * blade.length**2)

    def with_hub_radius(self, radius: float) -> Blade:
        """Return the blade clamped at `radius` [m] from the axis."""
        return replace(self.blade, hub_radius=radius)

    def with_setting_angle(self, angle: float) -> Blade:
        """Return the blade set at `angle` [rad]: 0 is lag, π/2 flap."""
        return replace(self.blade, setting_angle=angle)

    def with_point_mass(
        self, mass: float, position: float, inertia: float = 0.0, offset: Offset = (0.0, 0.0)
    ) -> Blade:
        """Return the blade with one mass [kg] more at `position` [m] from the clamp.

        Its center is `offset` [m] from the line.
        """
        more = (PointMass(position=position, mass=mass, inertia=inertia, offset=offset),)
        return replace(self.blade, point_masses=self.blade.point_masses + more)

    def with_tip_mass(
        self, mass: float, inertia: float = 0.0, offset: Offset = (0.0, 0.0)
    ) -> Blade:
        """Return the blade with one mass [kg] more at its tip, `offset` [m] from the line."""
        return self.with_point_mass(mass, self.blade.length, inertia, offset)

    def with_twist(self, angle: Profile) -> Blade:
        """Return the blade whose sections twist, from the chord towards the thickness.

        By `angle` [rad] at the tip and in proportion before, if it is one number; else by
        coefficients of 1, x/L, ... or by stations (x [m], angle).
        """
        return self._with_line(twist=(0.0, angle) if np.ndim(angle) == 0 else angle)

    def with_precone(self, angle: float) -> Blade:
        """Return the blade whose clamp points out of the plane of rotation by `angle` [rad]."""
        return self._with_line(precone=angle)

    def with_prebend(self, curvature: Profile) -> Blade:
        """Return the blade whose unloaded line is curved about the chord [1/m], flapwise."""
        return self._with_line(prebend=curvature)

    def with_sweep(self, curvature: Profile) -> Blade:
        """Return the blade whose unloaded line is curved about the thickness [1/m], chordwise."""
        return self._with_line(sweep=curvature)

    def with_kink(self, position: float, prebend: float = 0.0, sweep: float = 0.0) -> Blade:
        """Return the blade with one kink more of its line at `position` [m] from the clamp.

        By angles [rad] about the chord and about the thickness.
        """
        return self._with_line(kinks=(*self.blade.line.kinks, (position, prebend, sweep)))

    def with_offsets(self, mass: Offset = (0.0, 0.0), tension: Offset = (0.0, 0.0)) -> Blade:
        """Return the blade whose centers of mass and of tension are so far [m] from the line.

        Each (c2, c3), along chord and thickness, from the shear centers.
        """
        return self._with_line(mass_offset=mass, tension_offset=tension)

    def _with_line(self, **change: Any) -> Blade:
        return replace(self.blade, line=replace(self.blade.line, **change))

    @property
    def is_planar(self) -> bool:
        """Whether the blade is straight and flat, and not from stations, which may couple all."""
        blade = self.blade
        offset = any(any(one.offset) for one in blade.point_masses)
        return blade.line == STRAIGHT and not offset and not blade.section.at_stations

    def with_taper(self, width: float = 0.0, height: float = 0.0) -> Blade:
        """Return the blade whose width and height fall to (1 - taper) of the root's at the tip.

        Mass and EA go with width times height, EI with width times height cubed; the height is
        the dimension in the plane of bending.
        """
        return replace(self.blade, section=self.blade.section.tapered(width, height))

    def with_damping(self, damping: Damping) -> Blade:
        """Return the blade with `damping` in place of its own."""
        return replace(self.blade, damping=damping)

    def with_section_out_of_plane(
        self,
        bending_ratio: float,
        torsion_ratio: float | None = None,
        polar_inertia: float | None = None,
    ) -> Blade:
        """Return the blade with these of `OutOfPlane`: EI out of the plane and GJ over its EI."""
        given = OutOfPlane(
            bending_ratio=bending_ratio, torsion_ratio=torsion_ratio, polar_inertia=polar_inertia
        )
        return self._with_out_of_plane(given)

    def with_shape(self, shape: SectionShape) -> Blade:
        """Return the blade with a shape as its section, refusing one with another I/A or A.

        A `Beam` has A and I; a `Blade` has EA and EI, so that the material of its shape, and A,
        are free. The ratios out of the plane hold all along the blade.
        """
        if not isinstance(shape, SectionShape):
            raise TypeError(f"a SectionShape is needed, got {shown(shape)}: as Rectangle()")
        return self._with_out_of_plane(shape.out_of_plane(self.gyration))

    def _with_out_of_plane(self, out_of_plane: OutOfPlane | None) -> Blade:
        blade = self.blade
        return replace(blade, section=blade.section.with_out_of_plane(out_of_plane))
