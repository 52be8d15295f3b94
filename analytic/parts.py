"""Parts of a blade, as values in SI units: its line in space, point masses on it, and damping."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from .arrays import Profile, evaluated, in_units, slope_of, stations
from .description import Described
from .input_checks import (
    checked_angle,
    checked_profile,
    finite_array,
    not_negative,
    positive,
    require_along,
    require_offset,
    shown,
    whole_number,
)
from .warning import warn

_STEEP = 0.5 * math.pi  # of a precone or a kink: beyond it the line comes back
_MUCH = 1.0  # [rad], by which few blades twist

Offset = tuple[float, float]
"""(c2, c3): along the chord, to the leading edge, and along the thickness, of the section."""


def checked_offset(name: str, offset: Any) -> Offset:
    """Return an offset as two plain numbers [m]."""
    pair = finite_array(name, offset, "m")
    if pair.shape != (2,):
        raise TypeError(
            f"{name} must be a pair (c2, c3) [m], along chord and thickness, got {shown(offset)}"
        )
    return float(pair[0]), float(pair[1])


def scaled(offset: Offset, length: float) -> Offset:
    """Return an offset over a length."""
    return offset[0] / length, offset[1] / length


def _checked_kinks(kinks: Any) -> tuple[tuple[float, float, float], ...]:
    if not isinstance(kinks, tuple | list | np.ndarray):
        raise TypeError(f"kinks must be several, as [(5.0, 0.0, 0.3)], got {shown(kinks)}")
    return tuple(map(_checked_kink, kinks))


def _checked_kink(kink: Any) -> tuple[float, float, float]:
    if not isinstance(kink, tuple | list | np.ndarray) or len(kink) != 3:
        raise TypeError(
            "each of kinks must be its place [m] and two angles [rad], as (5.0, 0.0, 0.3), got "
            f"{shown(kink)}"
        )
    x, *angles = kink
    about_chord, about_thickness = (checked_angle("angle of a kink", one, _STEEP) for one in angles)
    return positive("place of a kink", x, "m"), about_chord, about_thickness


def _checked_twist(twist: Any) -> Profile:
    """Return a profile of angles [rad], asking about values, or a slope, that seem degrees."""
    profile = checked_profile("twist", twist, "rad")
    at = stations(profile) or [1.0]
    x = np.union1d(np.linspace(0.0, at[-1], 65), at)
    values, slopes = evaluated(profile, x).tolist(), (at[-1] * slope_of(profile, x)).tolist()
    largest = checked_angle("twist", max(values, key=abs))
    steepest = max(slopes, key=abs)
    # Tables in radians may be as steep over a short cell. One question is enough.
    much = max(values) - min(values) > _MUCH and abs(largest) <= math.pi
    if abs(steepest) > 2.0 * math.pi and much:
        warn(
            f"twist has a slope of {steepest:.4g} rad over the length, more than a turn: in "
            f"degrees? {steepest:.4g} degrees are {math.radians(steepest):.4g} rad"
        )
    return profile


@dataclass(frozen=True, kw_only=True)
class Line(Described):
    """The unloaded line of a blade, through its shear centers, and the sections along it.

    Parameters
    ----------
    twist : Profile
        θ [rad], over the setting angle, from the chord towards the thickness.
    precone : float
        β [rad], by which the clamp points out of the plane of rotation.
    prebend, sweep : Profile
        Curvatures of the unloaded line [1/m], about the chord and about the thickness.
    mass_offset, tension_offset : tuple
        (c2, c3) of the centers of mass and of tension [m].
    kinks : tuple
        Of each kink of the line its place [m], and its angles about the chord and the thickness
        [rad], as prebend and sweep.

    Examples
    --------
    >>> from analytic import Beam
    >>> blade = Beam.reference().with_section_out_of_plane(0.0625, 0.08).with_twist(0.5)
    >>> blade.with_precone(0.04).line.precone
    0.04
    """

    twist: Profile = 0.0
    precone: float = 0.0
    prebend: Profile = 0.0
    sweep: Profile = 0.0
    mass_offset: Offset = (0.0, 0.0)
    tension_offset: Offset = (0.0, 0.0)
    kinks: tuple[tuple[float, float, float], ...] = ()

    def __post_init__(self) -> None:
        self._keep(
            twist=_checked_twist(self.twist),
            prebend=checked_profile("prebend", self.prebend, "1/m"),
            sweep=checked_profile("sweep", self.sweep, "1/m"),
            precone=checked_angle("precone", self.precone, _STEEP),
            mass_offset=checked_offset("mass_offset", self.mass_offset),
            tension_offset=checked_offset("tension_offset", self.tension_offset),
            kinks=_checked_kinks(self.kinks),
        )

    def require_along(self, length: float) -> None:
        """Refuse a line that is not one of a blade of that length [m]."""
        for name in ("twist", "prebend", "sweep"):
            require_along(name, getattr(self, name), length)
        for name in ("prebend", "sweep"):
            profile = in_units(getattr(self, name), length, 1.0)
            points = np.union1d(np.linspace(0.0, 1.0, 65), stations(profile))
            turn = length * float(np.trapezoid(np.abs(evaluated(profile, points)), points))
            if turn > 2.0 * math.pi:
                raise ValueError(
                    f"{name} turns the line by {turn:.4g} rad, more than once around: it is a "
                    "curvature [1/m], 2 d/L² for a tip that is d off the straight line"
                )
        for x, *_ in self.kinks:
            if not x < length:
                raise ValueError(
                    f"a kink at {x:g} m is not between clamp and tip, at {length:g} m: take its "
                    "place from the clamp, not from the axis"
                )
        for name in ("mass_offset", "tension_offset"):
            require_offset(name, getattr(self, name), length)

    @cached_property
    def is_straight(self) -> bool:
        """Whether it is straight and flat, twisted at most by the same angle all along."""
        line = self.in_units(1.0)
        return not isinstance(line.twist, tuple) and replace(line, twist=0.0) == STRAIGHT

    def in_units(self, length: float) -> Line:
        """Return the same in units of length [m]."""
        return Line(
            twist=in_units(self.twist, length, 1.0),
            precone=self.precone,
            prebend=in_units(self.prebend, length, 1.0 / length),
            sweep=in_units(self.sweep, length, 1.0 / length),
            mass_offset=scaled(self.mass_offset, length),
            tension_offset=scaled(self.tension_offset, length),
            kinks=tuple((x / length, a, b) for x, a, b in self.kinks),
        )


STRAIGHT = Line()
"""The line of a straight blade without twist or precone, through all its centers."""


@dataclass(frozen=True, kw_only=True)
class PointMass(Described):
    """A mass on the blade's axis.

    Parameters
    ----------
    position : float
        x from the clamp [m].
    mass : float
        [kg].
    inertia : float
        Against rotation in the plane of bending [kg m²].
    offset : tuple
        (c2, c3) [m] from the blade's line, along chord and thickness of the section.

    Examples
    --------
    >>> from analytic import Beam, Blade, PointMass
    >>> beam = Beam.reference()
    >>> mass = PointMass(position=4.0, mass=0.5)
    >>> blade = Blade(length=beam.length, section=beam.section, point_masses=(mass,))
    >>> print(f"{beam.omega_0:.4f} rad/s, with the mass {blade.frequencies_at_rest[0]:.4f} rad/s")
    2.9092 rad/s, with the mass 2.7190 rad/s
    """

    position: float
    mass: float
    inertia: float = 0.0
    offset: Offset = (0.0, 0.0)

    def __post_init__(self) -> None:
        at = not_negative(
            "position", self.position, "m", "it is measured from the clamp to the tip"
        )
        if at == 0.0:
            raise ValueError(
                "a point mass at the clamp, position 0 m, does not move with the blade: leave it "
                "out, it belongs to the hub"
            )
        self._keep(
            position=at,
            mass=not_negative("mass", self.mass, "kg"),
            inertia=not_negative("inertia", self.inertia, "kg m^2"),
            offset=checked_offset("offset", self.offset),
        )

    def in_units(self, length: float, mass: float) -> PointMass:
        """Return the same in units of length [m] and mass [kg]."""
        return PointMass(
            position=self.position / length,
            mass=self.mass / mass,
            inertia=self.inertia / (mass * length**2),
            offset=scaled(self.offset, length),
        )


@dataclass(frozen=True, kw_only=True)
class Damping(Described):
    """Viscous damping of a blade.

    The bending moment about the center of tension is EI(κ + η_b κ̇), the axial force
    EA(e + η_a ė). External damping takes d ṙ per length, with the velocity relative to the turning
    frame: it does not brake steady rotation as drag would, and point masses have none.

    In space each component of curvature has its own η, by the section's axes: strains κ̇_i √η_i
    meet the stiffness of the section, so that all damping takes energy where it couples. All η
    equal make the damping proportional to the stiffness.

    Parameters
    ----------
    bending : float
        η_b [s], of bending in the plane of bending, by EI or EI3.
    axial : float
        η_a [s].
    external : float
        d [kg/(m s)]; c times the mass per length damps a uniform blade by its mass.
    out_of_plane, torsion : float, optional
        The same of bending by EI2 and of torsion by GJ [s]; as `bending`, unless given.
    shear : float
        The same of both shear forces [s], in a theory with shear.

    Examples
    --------
    >>> from analytic import Beam, Damping, damping_ratios
    >>> blade = Beam.reference().with_damping(Damping(bending=1e-3))
    >>> print(damping_ratios(blade, omega=6.0).round(5))
    [0.00127 0.00723 0.02303]
    """

    bending: float = 0.0
    axial: float = 0.0
    external: float = 0.0
    out_of_plane: float | None = None
    torsion: float | None = None
    shear: float = 0.0

    def __post_init__(self) -> None:
        for name, value in vars(self).items():
            if value is None and name in ("out_of_plane", "torsion"):
                continue
            unit = "kg/(m s)" if name == "external" else "s"
            remedy = "damping takes energy, it gives none"
            self._keep(**{name: not_negative(name, value, unit, remedy)})

    @property
    def of_strains(self) -> tuple[float, ...]:
        """The six η [s]: of tension, shear forces, torsion, bending out of plane and in it."""
        twisting, across = (
            self.bending if given is None else given for given in (self.torsion, self.out_of_plane)
        )
        return self.axial, self.shear, self.shear, twisting, across, self.bending

    @classmethod
    def from_ratio(cls, blade: Any, mode: int = 1, ratio: float = 0.01) -> Damping:
        """Return the bending damping that gives one mode at rest a damping ratio.

        η_b = 2ζ/ω_j; for rotation, where the centrifugal stiffness takes no part, see
        `damping_ratios`.

        Parameters
        ----------
        blade : Blade
        mode : int
            j, from 1 to 12.
        ratio : float
            ζ, of the critical damping.
        """
        mode = whole_number("mode", mode)
        frequencies = blade.frequencies_at_rest
        if mode > frequencies.size // 2:
            raise ValueError(f"mode must be at most {frequencies.size // 2}, got {mode}")
        return cls(bending=2.0 * not_negative("ratio", ratio) / float(frequencies[mode - 1]))

    def in_units(self, length: float, mass: float, time: float) -> Damping:
        """Return the same in units of length [m], mass [kg] and time [s]."""
        rates = {k: None if v is None else v / time for k, v in vars(self).items()}
        return Damping(**rates | {"external": self.external * length * time / mass})  # type: ignore[arg-type]

    def __bool__(self) -> bool:
        return any(vars(self).values())


UNDAMPED = Damping()
