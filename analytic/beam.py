"""The beam: its data, and the scales that make the paper's variables nondimensional."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

from .arrays import FloatArray
from .blade import Blade, Variations
from .input_checks import positive, shown, warn_if_giga
from .parts import UNDAMPED, Damping, PointMass
from .section import OutOfPlane, Section
from .section_shape import Gyration
from .theory import BERNOULLI_EULER, Theory, require_theory
from .unit_blade import UNIFORM, UnitBlade
from .warning import warn

BETA_1 = 1.8751040687119611
"""First root of cos β cosh β = -1: the first mode of the cantilever, ω0 = β² √(EI/mL³)."""

_RPM_SUSPECT = 10.0
"""Rotation speeds above this many ω0 are taken for a slip in units; the benchmark ends near 4."""


@dataclass(frozen=True, kw_only=True)
class Beam(Variations):
    """A uniform, initially straight beam; SI units.

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

    hub_radius: ClassVar[float] = 0.0
    setting_angle: ClassVar[float] = 0.0
    point_masses: ClassVar[tuple[PointMass, ...]] = ()
    damping: ClassVar[Damping] = UNDAMPED

    def __post_init__(self) -> None:
        self._keep(
            length=positive("length", self.length, "m"),
            area=positive("area", self.area, "m^2"),
            second_moment=positive("second_moment", self.second_moment, "m^4"),
            youngs_modulus=positive("youngs_modulus", self.youngs_modulus, "Pa"),
            density=positive("density", self.density, "kg/m^3"),
        )
        warn_if_giga("youngs_modulus", self.youngs_modulus, "Pa", self.density)

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
    def mass(self) -> float:
        """Total mass m = ρAL [kg]."""
        return self.density * self.area * self.length

    @property
    def mass_per_length(self) -> float:
        """Mass per length ρA [kg/m]."""
        return self.density * self.area

    @property
    def bending_stiffness(self) -> float:
        """Bending stiffness EI [N m²]."""
        return self.youngs_modulus * self.second_moment

    @property
    def axial_stiffness(self) -> float:
        """Axial stiffness EA [N]."""
        return self.youngs_modulus * self.area

    @property
    def slenderness(self) -> float:
        """Slenderness μ = I/(AL²), Eq. 78 [-]."""
        return self.second_moment / (self.area * self.length**2)

    @property
    def frequency_scale(self) -> float:
        """√(EI/(mL³)), the frequency scale of τ in Eq. 40 [rad/s]."""
        return math.sqrt(self.bending_stiffness / (self.mass * self.length**3))

    @property
    def omega_0(self) -> float:
        """First natural frequency of the beam at rest, Eq. 40 (3.516 in full) [rad/s]."""
        return BETA_1**2 * self.frequency_scale

    @property
    def burst_speed(self) -> float:
        """Speed at which the rotation stretches the beam without bound, (π/2) √(E/ρ)/L [rad/s].

        The stretched state x + u = sin(kx)/(k cos(kL)), k = ω √(ρ/E), exists below it only.
        """
        return 0.5 * math.pi * math.sqrt(self.youngs_modulus / self.density) / self.length

    @property
    def unit(self) -> UnitBlade:
        """The beam without dimensions: the uniform blade."""
        return UNIFORM

    @property
    def uniform(self) -> Beam:
        """The beam itself; a `Blade` has None here."""
        return self

    def in_units(self, length: float, mass: float, time: float) -> Beam:
        """Return the beam in units of length [m], mass [kg] and time [s]."""
        return Beam(
            length=self.length / length,
            area=self.area / length**2,
            second_moment=self.second_moment / length**4,
            youngs_modulus=self.youngs_modulus * length * time**2 / mass,
            density=self.density * length**3 / mass,
        )

    @cached_property
    def blade(self) -> Blade:
        """The same as a `Blade`, without a hub."""
        return Blade(length=self.length, section=self.section)

    @cached_property
    def section(self) -> Section:
        """Its section, all along."""
        return Section(
            axial_stiffness=self.axial_stiffness,
            bending_stiffness=self.bending_stiffness,
            mass_per_length=self.mass_per_length,
        )

    @property
    def frequencies_at_rest(self) -> FloatArray:
        """Frequencies of bending at rest [rad/s], as of a `Blade`."""
        return self.blade.frequencies_at_rest

    def __str__(self) -> str:
        return (
            f"Beam of {self.length:g} m: EI {self.bending_stiffness:.4g} N m², "
            f"EA {self.axial_stiffness:.4g} N, ρA {self.mass_per_length:.4g} kg/m"
        )

    @property
    def gyration(self) -> Gyration:
        """I/A and A."""
        return Gyration(squared=self.second_moment / self.area, area=self.area)


Blade = Beam | Blade
"""Type of the blades that theory and simulation take."""


def require_blade(blade: object) -> None:
    """Refuse a value that is neither a Beam nor a Blade."""
    if not isinstance(blade, Blade):
        raise TypeError(f"a Beam or a Blade is needed, got {shown(blade)}: as Beam.reference()")


def require_planar(
    blade: Blade,
    what: str = "this answer is of",
    remedy: str = "linear_modes, steady_state, periodic_orbits, forced_response or "
    "spin_up_response, which have it in space",
) -> None:
    """Refuse a blade whose motion leaves the plane of bending at once."""
    require_blade(blade)
    if not blade.is_planar:
        raise ValueError(
            f"{what} a straight blade in its plane, and this one is from stations or has a twist, "
            f"precone, prebend, sweep, kink or offset: take {remedy}"
        )


def require_out_of_plane(
    blade: Blade, theory: Theory = BERNOULLI_EULER, *, torsion: bool = True
) -> OutOfPlane:
    """Return the section's data, refusing a blade whose own do not tell how it leaves its plane."""
    require_planar(blade)
    if require_theory(theory).shear is not None:
        raise ValueError(
            "how slices shear out of the plane is unknown: take a theory without shear"
        )
    known = blade.section.out_of_plane
    if known is None:
        raise ValueError(
            "how this blade bends and twists out of its plane is unknown: give its section by "
            "blade.with_shape(Rectangle(height=..., width=...)) or "
            "blade.with_section_out_of_plane(bending_ratio, torsion_ratio)"
        )
    if blade.unit.setting != 1.0:
        raise ValueError(
            f"motion out of the plane is known for a blade that bends in the plane of rotation, "
            f"and this one is set at {blade.setting_angle:g} rad: take "
            "blade.with_setting_angle(0.0)"
        )
    if torsion and known.torsion_ratio is None and known.bending_ratio != 1.0:
        raise ValueError(
            f"with a bending_ratio of {known.bending_ratio:g} the torsional stiffness decides "
            "whether the plane is stable, and it is unknown: give torsion_ratio, math.inf for a "
            "section that does not twist"
        )
    twists = torsion and known.torsion_ratio != math.inf and known.bending_ratio != 1.0
    if twists and blade.section.rotary_inertia == 0.0:
        raise ValueError(
            "motion out of the plane is not known for a twist without inertia: give the "
            "section a rotary_inertia above zero, or leave it out for a homogeneous one"
        )
    return known


def undamped(blade: Blade) -> Blade:
    """Return the same without damping."""
    return blade.with_damping(UNDAMPED) if any(blade.unit.damping) else blade


def require_undamped(blade: Blade, what: str, *, planar: bool = True) -> None:
    """Refuse a damped blade where `what` has no damping."""
    (require_planar if planar else require_blade)(blade)
    if any(blade.unit.damping):
        raise ValueError(
            f"{what}: take forced_response for the damped blade, or beam.with_damping(Damping()), "
            "which has none"
        )


def require_steady_state(blade: Blade, omega: float) -> None:
    """Refuse a rotation speed `omega` [rad/s] at which no stretched state exists."""
    if omega >= blade.burst_speed:
        raise ValueError(
            f"omega = {omega:g} rad/s leaves no steady state: this beam is stretched without "
            f"bound at {blade.burst_speed:.6g} rad/s; rotate slower or raise the axial stiffness "
            f"(EA = {blade.axial_stiffness:g} N)"
        )


def warn_if_rpm(blade: Blade, omega: float) -> None:
    """Warn where a rotation speed `omega` [rad/s] is so high that it may be meant in rpm."""
    require_blade(blade)
    ratio = omega / blade.omega_0
    if ratio > _RPM_SUSPECT:
        warn(
            f"omega = {omega:g} rad/s is {ratio:.0f} times the first natural frequency "
            f"({blade.omega_0:.3f} rad/s): rpm? {omega:g} rpm are {omega * math.pi / 30:.4g} rad/s"
        )
