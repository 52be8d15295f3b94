"""The uniform beam: the short way to a blade, by the numbers of its section and material."""

from __future__ import annotations

import warnings
from dataclasses import dataclass, field

from .blade import Blade
from .input_checks import positive, warn_if_giga
from .parts import STRAIGHT, UNDAMPED, Damping, Line, PointMass
from .section import Section
from .section_shape import Gyration
from .warning import RotbeamWarning

BETA_1 = 1.8751040687119611
"""First root of cos β cosh β = -1: the first mode of the cantilever, ω0 = β² √(EI/mL³)."""


@dataclass(frozen=True, kw_only=True)
class Beam(Blade):
    """A uniform blade on the axis of rotation, initially straight; SI units.

    Every `with_...` returns a `Blade`, which differs in one thing.

    Parameters
    ----------
    length : float
        Length L [m].
    area : float
        Cross-sectional area A [m²].
    second_moment : float
        Second moment of area I about the axis of rotation's direction [m⁴].
    youngs_modulus : float
        Young's modulus E [Pa].
    density : float
        Mass density ρ [kg/m³].

    Raises
    ------
    ValueError
        If a value is not finite and positive.
    TypeError
        If a value is not a number.

    Examples
    --------
    >>> from analytic import Beam
    >>> beam = Beam.reference()
    >>> round(beam.omega_0, 6)
    2.909236
    """

    length: float
    area: float
    second_moment: float
    youngs_modulus: float
    density: float

    section: Section = field(init=False, repr=False)
    hub_radius: float = field(default=0.0, init=False, repr=False)
    setting_angle: float = field(default=0.0, init=False, repr=False)
    point_masses: tuple[PointMass, ...] = field(default=(), init=False, repr=False)
    damping: Damping = field(default=UNDAMPED, init=False, repr=False)
    line: Line = field(default=STRAIGHT, init=False, repr=False)

    def __post_init__(self) -> None:
        self._keep(
            area=positive("area", self.area, "m^2"),
            second_moment=positive("second_moment", self.second_moment, "m^4"),
            youngs_modulus=positive("youngs_modulus", self.youngs_modulus, "Pa"),
            density=positive("density", self.density, "kg/m^3"),
        )
        warn_if_giga("youngs_modulus", self.youngs_modulus, "Pa", self.density)
        with warnings.catch_warnings():  # the section would warn of its EA again
            warnings.simplefilter("ignore", RotbeamWarning)
            section = Section(
                axial_stiffness=self.youngs_modulus * self.area,
                bending_stiffness=self.youngs_modulus * self.second_moment,
                mass_per_length=self.density * self.area,
            )
        self._keep(section=section)
        super().__post_init__()

    @classmethod
    def reference(cls) -> Beam:
        """Return the paper's beam (Sec. 2)."""
        return cls(
            length=8.0,
            area=7.299e-5,
            second_moment=8.214e-9,
            youngs_modulus=6.895e10,
            density=2767.0,
        )

    @classmethod
    def from_stiffness(
        cls,
        *,
        length: float,
        axial_stiffness: float,
        bending_stiffness: float,
        mass_per_length: float,
    ) -> Beam:
        """Return a beam given by EA [N], EI [N m²] and ρA [kg/m], as benchmarks often are.

        Only the products enter the thin beam; the area is set to 1 m² to split them.
        """
        axial_stiffness = positive("axial_stiffness", axial_stiffness, "N")
        return cls(
            length=length,
            area=1.0,
            second_moment=positive("bending_stiffness", bending_stiffness, "N m^2")
            / axial_stiffness,
            youngs_modulus=axial_stiffness,
            density=positive("mass_per_length", mass_per_length, "kg/m"),
        )

    @property
    def gyration(self) -> Gyration:
        """I/A and A."""
        return Gyration(squared=self.second_moment / self.area, area=self.area)

    def __str__(self) -> str:
        return (
            f"Beam of {self.length:g} m: EI {self.bending_stiffness:.4g} N m², "
            f"EA {self.axial_stiffness:.4g} N, ρA {self.mass_per_length:.4g} kg/m"
        )
