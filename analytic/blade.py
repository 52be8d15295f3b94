"""Any straight blade: variable section, hub radius, setting angle, point masses; SI units.

The blade is clamped at the hub radius R from the axis of rotation and bends in one plane. That
plane makes the setting angle ψ with the plane of rotation: lag at ψ = 0, flap at ψ = π/2. Values
hash, compare and can be written to files; with_* return new ones.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from typing import Any

from numpy.typing import ArrayLike

from .arrays import Profile
from .blade_data import BladeData
from .input_checks import along, checked_profile, finite_values, shown
from .parts import Damping, Line, Offset, PointMass
from .section import OutOfPlane, Section
from .section_shape import SectionShape, require_shape
from .station_section import Interpolation, section_of_table


@dataclass(frozen=True, kw_only=True)
class Blade(BladeData):
    """A straight blade of variable section on a hub; SI units.

    Parameters
    ----------
    length : float
        L [m], from the clamp to the tip.
    section : Section
    hub_radius : float
        R [m], from the axis to the clamp.
    setting_angle : float
        ψ [rad], of the plane of bending against the plane of rotation.
    point_masses : tuple of PointMass
    damping : Damping
    line : Line
        Twist, precone, prebend, sweep and offsets.

    Raises
    ------
    ValueError
        If a value is out of range, a mass or station off the blade, or the section vanishes.

    Examples
    --------
    >>> from analytic import Blade, Section
    >>> section = Section(axial_stiffness=5e6, bending_stiffness=(566, -300), mass_per_length=0.2)
    >>> blade = Blade(length=8.0, section=section, hub_radius=0.5).with_tip_mass(0.1)
    >>> print(f"{blade.mass:.2f} kg, {blade.frequencies_at_rest[0]:.4f} rad/s at rest")
    1.70 kg, 2.4539 rad/s at rest
    """

    @classmethod
    def from_stations(
        cls,
        x: ArrayLike,
        stiffness: ArrayLike,
        mass: ArrayLike,
        *,
        twist: ArrayLike = 0.0,
        tension: ArrayLike = 0.0,
        shear: ArrayLike = 0.0,
        center: ArrayLike = 0.0,
        axis: ArrayLike = 0.0,
        interpolation: Interpolation = "components",
    ) -> Blade:
        """Return a blade in space from a table of its sections, linear between its stations.

        Axis 1 of a section is normal to it, 2 along the chord, 3 along the thickness. Rows of
        a matrix are force and moment, or velocity and spin, each along axis 1, 2 and 3.

        Parameters
        ----------
        x : array_like (stations,)
            From the clamp, 0, to the tip [m]. Two at one place are a step.
        stiffness : array_like (stations, 6) or (stations, 6, 6)
            EA [N], GA2, GA3 [N], GJ, EI2 (flap) and EI3 (lag) [N m²], or matrices. A theory without
            shear does not use GA2 and GA3: give EA where they are not known.
        mass : array_like (stations, 4) or (stations, 6, 6)
            m [kg/m], and j1 (torsion), j2 and j3 [kg m] about the center of mass, or matrices.
        twist : array_like (stations,)
            [rad], from the chord towards the thickness; or one number for all.
        tension, shear, center : array_like (stations, 2)
            (c2, c3) [m] of the centers of tension, shear and mass, about which columns are given,
            from the axis of the table; matrices have theirs in them.
        axis : array_like (stations, 2)
            (c2, c3) [m] of the table's axis from the blade's line, by which matrices are moved.
        interpolation : {"components", "matrix"}
            Linear between stations are the places of the centers and what is given about them, of
            matrices as of columns; or, as in BeamDyn, the matrices about the line, which makes
            sections between two stations stiffer, by up to EA Δc²/4 in bending.

        Raises
        ------
        ValueError
            If a matrix is not symmetric or not positive, the stations do not ascend from 0, or
            centers come with matrices.
        TypeError
            If a value is no number. Quantities of a units library are converted in `x`, `twist`
            and the offsets, and refused in `stiffness` and `mass`, whose columns differ in unit.

        Examples
        --------
        >>> from analytic import Blade, linear_modes
        >>> stiffness = [[1e7, 3e6, 3e6, 8e3, 5e3, 8e4], [4e6, 1e6, 1e6, 1e3, 9e2, 2e4]]
        >>> mass = [[8.0, 0.3, 0.02, 0.28], [4.0, 0.1, 0.01, 0.09]]
        >>> blade = Blade.from_stations([0.0, 10.0], stiffness, mass, twist=[0.2, 0.0])
        >>> linear_modes(blade.with_hub_radius(1.0), omega=6.0, count=2).frequencies.round(3)
        array([5.356, 6.891])
        """
        section = section_of_table(
            x, stiffness, mass, interpolation,
            tension=tension, shear=shear, center=center, axis=axis,
        )  # fmt: skip
        angles = along("twist", twist, len(section.x), "rad").tolist()
        line = Line(twist=tuple(zip(section.x, angles, strict=True)))
        return cls(length=section.x[-1], section=section, line=line)

    @classmethod
    def from_shapes(
        cls,
        x: ArrayLike,
        shapes: Sequence[SectionShape],
        youngs_modulus: ArrayLike,
        density: ArrayLike,
        *,
        twist: ArrayLike = 0.0,
    ) -> Blade:
        """Return a blade in space from shapes and materials, linear in stiffness between stations.

        Parameters
        ----------
        x : array_like (stations,)
            From the clamp, 0, to the tip [m].
        shapes : sequence of SectionShape
            At each station, with all its lengths; its height is along the chord, which moves in
            the plane of rotation.
        youngs_modulus, density : array_like (stations,)
            E [N/m²] and ρ [kg/m³], or one number for all.
        twist : array_like (stations,)
            [rad], from the chord towards the thickness.

        Examples
        --------
        >>> from analytic import Blade, Rectangle
        >>> shapes = Rectangle(height=0.08, width=0.01), Rectangle(height=0.04, width=0.008)
        >>> blade = Blade.from_shapes([0.0, 2.0], shapes, youngs_modulus=7e10, density=2700.0)
        >>> print(f"{blade.mass:.3f} kg")
        3.024 kg
        """
        stations = finite_values("x", x, "m").size
        if not isinstance(shapes, (list, tuple)) or len(shapes) != stations:
            raise TypeError(
                f"shapes must be one at each of the {stations} stations, got {shown(shapes)}: as "
                f"[Ellipse(height=0.2, width=0.1)] * {stations}"
            )
        E = along("youngs_modulus", youngs_modulus, stations, "Pa").tolist()
        rho = along("density", density, stations, "kg/m^3").tolist()
        for shape in shapes:
            require_shape(shape)
        stiffness, mass = zip(
            *(shape.of_material(*own) for shape, *own in zip(shapes, E, rho, strict=True)),
            strict=True,
        )
        return cls.from_stations(x, stiffness, mass, twist=twist)

    def with_section(self, section: Section) -> Blade:
        """Return the blade with `section` in place of its own."""
        return self._changed(section=section)

    def with_hub_radius(self, radius: float) -> Blade:
        """Return the blade clamped at `radius` [m] from the axis."""
        return self._changed(hub_radius=radius)

    def with_setting_angle(self, angle: float) -> Blade:
        """Return the blade set at `angle` [rad]: 0 is lag, π/2 flap."""
        return self._changed(setting_angle=angle)

    def with_point_mass(
        self, mass: float, position: float, inertia: float = 0.0, offset: Offset = (0.0, 0.0)
    ) -> Blade:
        """Return the blade with one mass [kg] more at `position` [m] from the clamp.

        Its center is `offset` [m] from the line.
        """
        more = (PointMass(position=position, mass=mass, inertia=inertia, offset=offset),)
        return self._changed(point_masses=self.point_masses + more)

    def with_tip_mass(
        self, mass: float, inertia: float = 0.0, offset: Offset = (0.0, 0.0)
    ) -> Blade:
        """Return the blade with one mass [kg] more at its tip, `offset` [m] from the line."""
        return self.with_point_mass(mass, self.length, inertia, offset)

    def with_twist(self, angle: Profile) -> Blade:
        """Return the blade whose sections twist, from the chord towards the thickness.

        By `angle` [rad] at the tip and in proportion before, if it is one number; else by
        coefficients of 1, x/L, ... or by stations (x [m], angle).
        """
        twist = checked_profile("twist", angle, "rad")
        return self._with_line(twist=twist if isinstance(twist, tuple) else (0.0, twist))

    def with_precone(self, angle: float) -> Blade:
        """Return the blade whose clamp points out of the plane of rotation by `angle` [rad]."""
        return self._with_line(precone=angle)

    def with_prebend(self, curvature: Profile) -> Blade:
        """Return the blade whose unloaded line is curved about the chord [1/m], flapwise.

        Positive bends it down, away from the axis 3 along the thickness.
        """
        return self._with_line(prebend=curvature)

    def with_sweep(self, curvature: Profile) -> Blade:
        """Return the blade whose unloaded line is curved about the thickness [1/m], chordwise.

        Positive bends it forward, towards the axis 2 along the chord.
        """
        return self._with_line(sweep=curvature)

    def with_kink(self, position: float, prebend: float = 0.0, sweep: float = 0.0) -> Blade:
        """Return the blade with one kink more of its line at `position` [m] from the clamp.

        By angles [rad] about the chord and about the thickness.
        """
        return self._with_line(kinks=(*self.line.kinks, (position, prebend, sweep)))

    def with_offsets(self, mass: Offset = (0.0, 0.0), tension: Offset = (0.0, 0.0)) -> Blade:
        """Return the blade whose centers of mass and of tension are so far [m] from the line.

        Each (c2, c3), along chord and thickness, from the shear centers.
        """
        return self._with_line(mass_offset=mass, tension_offset=tension)

    def _with_line(self, **change: Any) -> Blade:
        return self._changed(line=replace(self.line, **change))

    def with_taper(self, width: float = 0.0, height: float = 0.0) -> Blade:
        """Return the blade whose width and height fall to (1 - taper) of the root's at the tip.

        Mass and EA go with width times height, EI with width times height cubed; the height is
        the dimension in the plane of bending.
        """
        return self.with_section(self.section.tapered(width, height))

    def with_damping(self, damping: Damping) -> Blade:
        """Return the blade with `damping` in place of its own."""
        return self._changed(damping=damping)

    def with_section_out_of_plane(
        self, bending_ratio: float, torsion_ratio: float | None = None
    ) -> Blade:
        """Return the blade with these of `OutOfPlane`: EI out of the plane and GJ over its EI."""
        return self._with_out_of_plane(
            OutOfPlane(bending_ratio=bending_ratio, torsion_ratio=torsion_ratio)
        )

    def with_shape(self, shape: SectionShape) -> Blade:
        """Return the blade with a shape as its section, refusing one with another I/A or A.

        A `Beam` has A and I; a `Blade` has EA and EI, so that the material of its shape, and A,
        are free. The ratios out of the plane hold all along the blade.
        """
        require_shape(shape)
        return self._with_out_of_plane(shape.out_of_plane(self.gyration))

    def _with_out_of_plane(self, out_of_plane: OutOfPlane | None) -> Blade:
        return self.with_section(self.section.with_out_of_plane(out_of_plane))

    def _changed(self, **change: Any) -> Blade:
        """Return the blade that differs in these fields; of a `Beam` a `Blade`."""
        same = {one.name: getattr(self, one.name) for one in fields(Blade)}
        return Blade(**same | change)

    def in_units(self, length: float, mass: float, time: float) -> Blade:
        """Return the blade in units of length [m], mass [kg] and time [s]."""
        return self._changed(
            length=self.length / length,
            section=self.section.in_units(length, mass, time),
            hub_radius=self.hub_radius / length,
            point_masses=tuple(one.in_units(length, mass) for one in self.point_masses),
            damping=self.damping.in_units(length, mass, time),
            line=self.line.in_units(length),
        )
