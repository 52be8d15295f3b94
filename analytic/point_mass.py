"""A mass on the blade's axis."""

from __future__ import annotations

from dataclasses import dataclass

from .description import Described
from .input_checks import not_negative
from .line import Offset, checked_offset, scaled


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
    >>> blade = Blade(length=beam.length, section=beam.blade.section, point_masses=(mass,))
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
