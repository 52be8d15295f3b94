"""The section of a blade: what a slice resists and weighs."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .profiles import Profile, checked_profile, times


@dataclass(frozen=True, kw_only=True)
class Section:
    """What a slice of the blade resists and weighs, each a `Profile` along x.

    Parameters
    ----------
    axial_stiffness : Profile
        EA [N].
    bending_stiffness : Profile
        EI [N m²] in the plane of bending.
    mass_per_length : Profile
        m [kg/m].
    rotary_inertia : Profile
        Inertia of the slices against rotation, ρI [kg m].
    """

    axial_stiffness: Profile
    bending_stiffness: Profile
    mass_per_length: Profile
    rotary_inertia: Profile = 0.0

    def __post_init__(self) -> None:
        for name in ("axial_stiffness", "bending_stiffness", "mass_per_length", "rotary_inertia"):
            object.__setattr__(self, name, checked_profile(name, getattr(self, name)))

    def profiles(self) -> dict[str, Profile]:
        """Return the profiles by name."""
        return {
            "axial_stiffness": self.axial_stiffness,
            "bending_stiffness": self.bending_stiffness,
            "mass_per_length": self.mass_per_length,
            "rotary_inertia": self.rotary_inertia,
        }

    def tapered(self, width: float, height: float) -> Section:
        """Return the section times (1 - width x/L)(1 - height x/L), and height cubed in bending."""
        b, h = (1.0, -width), (1.0, -height)
        slice_ = np.polynomial.polynomial.polymul(b, h)
        bent = np.polynomial.polynomial.polymul(slice_, np.polynomial.polynomial.polypow(h, 2))
        return Section(
            axial_stiffness=times(self.axial_stiffness, slice_),
            bending_stiffness=times(self.bending_stiffness, bent),
            mass_per_length=times(self.mass_per_length, slice_),
            rotary_inertia=times(self.rotary_inertia, bent),
        )
