"""The section of a blade: stiffness and mass of its slices, in the plane of bending and out of it.

In the plane a thin blade knows its EA, EI and m. Whether its motion stays there depends on how it
bends out of the plane and twists.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any, Self

import numpy as np

from .arrays import FloatArray, Profile, evaluated, in_units, stations, times
from .description import Described
from .input_checks import checked_profile, finite_number, positive, require_along, warn_if_giga
from .theory import Theory


@dataclass(frozen=True, kw_only=True)
class OutOfPlane(Described):
    """Stiffness and inertia of a slice out of the plane, over stiffness and inertia in it.

    The ratios hold all along the blade. Inertia against rotation has the same ratio r: against
    twist it is 1 + r times the `rotary_inertia` of the section or, where none is given, of a
    homogeneous one.

    Parameters
    ----------
    bending_ratio : float
        r, the bending stiffness out of the plane over the EI in it.
    torsion_ratio : float, optional
        g = GJ/EI; infinite if the section does not twist, None if unknown.

    Examples
    --------
    >>> from analytic import Beam, Rectangle
    >>> strip = Beam.reference().with_shape(Rectangle())
    >>> print(f"GJ = {strip.section.out_of_plane.torsion_ratio:.5f} EI")
    GJ = 0.00434 EI
    """

    bending_ratio: float
    torsion_ratio: float | None = None

    def __post_init__(self) -> None:
        self._keep(bending_ratio=positive("bending_ratio", self.bending_ratio))
        rigid = isinstance(self.torsion_ratio, float) and self.torsion_ratio == math.inf
        if self.torsion_ratio is not None and not rigid:
            self._keep(torsion_ratio=positive("torsion_ratio", self.torsion_ratio))


_UNITS = {
    "axial_stiffness": "N", "bending_stiffness": "N m^2", "mass_per_length": "kg/m",
    "rotary_inertia": "kg m",
}  # fmt: skip


@dataclass(frozen=True, kw_only=True)
class Section(Described):
    """Stiffness and mass of the blade's slices, each a `Profile` along x.

    Parameters
    ----------
    axial_stiffness : Profile
        EA [N].
    bending_stiffness : Profile
        EI [N m²] in the plane of bending.
    mass_per_length : Profile
        m [kg/m].
    rotary_inertia : Profile, optional
        Inertia of the slices against rotation, ρI [kg m]; zero for slices without one. None means
        not given: the theory then has none, and an element that models it takes a homogeneous
        section, m EI/EA.
    out_of_plane : OutOfPlane, optional
        Their stiffness out of the plane of bending; None if unknown.

    Examples
    --------
    >>> from analytic import Section
    >>> given = {"axial_stiffness": 5e6, "mass_per_length": 0.2}
    >>> polynomial = Section(bending_stiffness=(566, -300), **given)  # 566 - 300 x/L
    >>> stations = Section(bending_stiffness=((0, 566), (8, 266)), **given)  # pairs of x [m] and EI
    >>> stations.bending_stiffness
    ((0.0, 566.0), (8.0, 266.0))
    """

    axial_stiffness: Profile
    bending_stiffness: Profile
    mass_per_length: Profile
    rotary_inertia: Profile | None = None
    out_of_plane: OutOfPlane | None = None

    @property
    def knows_space(self) -> bool:
        """Whether it is known how slices bend out of the plane, and twist."""
        out = self.out_of_plane
        return out is not None and out.torsion_ratio is not None

    @property
    def turns_with_inertia(self) -> bool:
        """Whether slices have inertia against torsion: a given one that is not zero, or a usual."""
        inertia = self.inertia_against_torsion
        return inertia is None or in_units(inertia, 1.0, 1.0) != 0.0

    @property
    def inertia_against_torsion(self) -> Profile | None:
        """Inertia that is there with that against torsion [kg m], None of a homogeneous section."""
        return self.rotary_inertia

    @property
    def shear_stiffness(self) -> Profile:
        """GA in the plane of bending [N], refused: a share of EA is asked of the theory."""
        raise TypeError("this section has no shear stiffness")

    def cuts(self, length: float) -> tuple[float, ...]:
        """Return where else than at stations of a profile slices change, over the length."""
        del length
        return ()

    @property
    def is_planar(self) -> bool:
        """Whether motion in the plane stays in it, and stretches the line without bending it."""
        return True

    def needs_space(self, theory: Theory) -> bool:
        """Whether the section has more than the plane and small motion out of it take."""
        del theory
        return False

    def with_out_of_plane(self, out_of_plane: OutOfPlane | None) -> Self:
        """Return the section with these ratios out of the plane."""
        return replace(self, out_of_plane=out_of_plane)

    def __post_init__(self) -> None:
        profiles = self.profiles().items()
        self._keep(**{name: checked_profile(name, p, _UNITS[name]) for name, p in profiles})
        root = np.zeros(1)
        stiffness, mass = (
            float(evaluated(profile, root)[0])
            for profile in (self.axial_stiffness, self.mass_per_length)
        )
        if stiffness > 0.0 and mass > 0.0:  # what else is refused where the length is known
            warn_if_giga("axial_stiffness", stiffness, "N", mass)

    def profiles(self) -> dict[str, Profile]:
        """Return the profiles by name, but of a rotary inertia that is not given."""
        profiles = {
            "axial_stiffness": self.axial_stiffness,
            "bending_stiffness": self.bending_stiffness,
            "mass_per_length": self.mass_per_length,
        }
        inertia = self.rotary_inertia
        return profiles if inertia is None else profiles | {"rotary_inertia": inertia}

    def of_unit_mass(self) -> Section:
        """Return the section with one unit of mass per length on its line, and no inertia."""
        return replace(self, mass_per_length=1.0, rotary_inertia=0.0)

    def in_units(self, length: float, mass: float, time: float) -> Section:
        """Return the section in units of length [m], mass [kg] and time [s]."""
        force = mass * (length / time) ** 2 / length
        per = {
            "axial_stiffness": force,
            "bending_stiffness": force * length**2,
            "mass_per_length": mass / length,
            "rotary_inertia": mass * length,
        }
        scaled: dict[str, Any] = {
            name: in_units(profile, length, per[name]) for name, profile in self.profiles().items()
        }
        return Section(**scaled, out_of_plane=self.out_of_plane)

    def require_along(self, length: float) -> None:
        """Refuse a section that vanishes on a blade of that length [m], or is given for another."""
        for name, profile in self.profiles().items():
            require_along(name, profile, length)
            at = np.minimum(stations(profile), length)
            x = np.union1d(np.linspace(0.0, 1.0, 257), at / length)
            _require_section(name, evaluated(in_units(profile, length, 1.0), x), x * length)

    def tapered(self, width: float, height: float) -> Section:
        """Return the section times (1 - width x/L)(1 - height x/L), and height cubed in bending."""
        width, height = finite_number("width", width), finite_number("height", height)
        if self.out_of_plane is not None and width != height:
            raise ValueError(
                f"a width that tapers by {width:g} and a height by {height:g} change the ratios "
                "out of the plane along the blade: taper both alike, or give "
                "with_section_out_of_plane after with_taper, with the ratios at the root"
            )
        b, h = (1.0, -width), (1.0, -height)
        slice_ = np.polynomial.polynomial.polymul(b, h)
        bent = np.polynomial.polynomial.polymul(slice_, np.polynomial.polynomial.polypow(h, 2))
        return Section(
            axial_stiffness=times(self.axial_stiffness, slice_),
            bending_stiffness=times(self.bending_stiffness, bent),
            mass_per_length=times(self.mass_per_length, slice_),
            rotary_inertia=None
            if self.rotary_inertia is None
            else times(self.rotary_inertia, bent),
            out_of_plane=self.out_of_plane,
        )


def _require_section(name: str, values: FloatArray, x: FloatArray) -> None:
    if name == "rotary_inertia":
        if values.min() < 0.0:
            raise ValueError(f"{name} must not be negative, got {values.min():g}")
    elif values[0] <= 0.0:
        raise ValueError(f"{name} must be positive at the clamp, got {values[0]:g}")
    elif not np.all(values > 1e-6 * values[0]):
        first = int(np.argmin(values > 1e-6 * values[0]))
        raise ValueError(
            f"{name} vanishes at x = {x[first]:.4g} m, where it is {values[first]:.3g}: end the "
            "blade before, or taper it less"
        )
