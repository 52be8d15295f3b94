"""The line of a blade in space: twist, precone, prebend, sweep, and where its centers lie."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from .description import Described
from .input_checks import finite_number, positive
from .profiles import Profile, checked_profile, in_units

Offset = tuple[float, float]
"""(c2, c3): along the chord, to the leading edge, and along the thickness, of the section."""


def checked_offset(name: str, offset: Any) -> Offset:
    """Return an offset as two plain numbers [m]."""
    try:
        c2, c3 = offset
    except (TypeError, ValueError):
        raise TypeError(
            f"{name} must be a pair (c2, c3) [m], along chord and thickness, got {offset!r}"
        ) from None
    return finite_number(f"{name}[0]", c2, "m"), finite_number(f"{name}[1]", c3, "m")


def scaled(offset: Offset, length: float) -> Offset:
    """Return an offset over a length."""
    return offset[0] / length, offset[1] / length


def _checked_kink(kink: Any) -> tuple[float, float, float]:
    try:
        x, about_chord, about_thickness = kink
    except (TypeError, ValueError):
        raise TypeError(
            f"a kink must be its place [m] and two angles [rad], got {kink!r}: as (5.0, 0.0, 0.3)"
        ) from None
    return (
        positive("place of a kink", x, "m"),
        finite_number("angle of a kink", about_chord, "rad"),
        finite_number("angle of a kink", about_thickness, "rad"),
    )


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
            twist=checked_profile("twist", self.twist, "rad"),
            prebend=checked_profile("prebend", self.prebend, "1/m"),
            sweep=checked_profile("sweep", self.sweep, "1/m"),
            precone=finite_number("precone", self.precone, "rad"),
            mass_offset=checked_offset("mass_offset", self.mass_offset),
            tension_offset=checked_offset("tension_offset", self.tension_offset),
            kinks=tuple(map(_checked_kink, self.kinks)),
        )

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
