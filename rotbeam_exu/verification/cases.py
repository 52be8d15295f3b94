"""The cases of the benchmark: each a blade, its motion and loads, and the quantity asked for."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import cached_property, partial
from typing import TYPE_CHECKING, Any

import numpy as np

from analytic import (
    Beam,
    Blade,
    Damping,
    Ellipse,
    Gravity,
    SpinUp,
    SteadyRotation,
    Tube,
    periodic_orbits,
)
from analytic.arrays import FloatArray
from analytic.exact.continuum.state import BeamState, kicked_state
from analytic.loads import Load
from analytic.theory import BERNOULLI_EULER, Theory

if TYPE_CHECKING:
    from analytic.exact.free.orbits import Orbits

VERSION = "1.1"
"""Version of the benchmark: the first number of its thresholds, the second of its list of cases."""


class Level(StrEnum):
    """Demand that a case makes on a code."""

    BASIC = "basic"
    MODERATE = "moderate"
    HARD = "hard"
    BLADE = "blade"
    SPACE = "space"


class Asked(StrEnum):
    """Result that is handed in."""

    FREQUENCIES = "natural frequencies at each speed"
    STEADY = "steady deflection of the tip at each speed"
    HISTORY = "deflection of the tip over time"
    BACKBONE = "nonlinear frequency at each speed and amplitude"


TIP = ("lag", "flap", "twist")
"""The tip in space, as `SpinUpResponse` has it: two places [m], and the section's turn [rad]."""


@dataclass(frozen=True, kw_only=True)
class Case:
    """One task.

    Attributes
    ----------
    name : str
        As files and folders are named: "L", "S1", "S1+h".
    level : Level
    title : str
        In a few words.
    asked : Asked
    blade : Blade
        Damping included.
    motion : SpinUp or SteadyRotation, optional
        How the clamp turns, of a history.
    duration : float
        Of the history [s].
    speeds : tuple of float
        Of frequencies, steady deflections and backbones [rad/s].
    count : int
        Number of frequencies at each speed, by their number.
    amplitudes : tuple of float
        Peak |q|/L: of a history the orbit it starts on, of a backbone its points.
    loads : tuple
    kick : float
        Speed of the tip out of the plane at t = 0 [m/s], as `spin_up_response` has it.
    oscillates : bool
        Whether the history ends in a steady oscillation, whose amplitude and frequency are judged.
    in_space : bool
        Whether the blade flaps and twists as well: its histories are those of `TIP`.
    theories : tuple of Theory
        Those whose references come with the package, as codes declare them.
    """

    name: str
    level: Level
    title: str
    asked: Asked
    blade: Blade
    motion: SpinUp | SteadyRotation | None = None
    duration: float = 0.0
    speeds: tuple[float, ...] = ()
    amplitudes: tuple[float, ...] = ()
    loads: tuple[Load, ...] = ()
    kick: float = 0.0
    oscillates: bool = False
    count: int = 1
    in_space: bool = False
    theories: tuple[Theory, ...] = (BERNOULLI_EULER,)

    def __post_init__(self) -> None:
        """Refuse a load that the reference would leave out."""
        steady = self.asked is Asked.STEADY
        for load in () if self.is_spun_up else self.loads:
            if not (steady and _is_weight(load)):
                raise ValueError(
                    f"the reference of case {self.name}, {self.asked}, knows no {load!r}: "
                    + ("weight along the axis of rotation alone" if steady else "take a spin-up")
                )

    @property
    def columns(self) -> tuple[str, ...]:
        """Columns of its histories besides the time."""
        return TIP if self.in_space else ("q",)

    def theory_of(self, declared: Theory) -> Theory:
        """Return the theory by which a code is judged that declares one.

        In space slices have their inertia about all axes, and twist does not shorten the axis: the
        beam of Reissner and Simo, or of Kirchhoff without shear.
        """
        if not self.in_space:
            return replace(declared, trapeze=True)  # which the plane does not know
        return replace(declared, rotary_inertia=True, trapeze=False, engesser=False)

    @property
    def quantities(self) -> tuple[str, ...]:
        """Quantities that are judged of it."""
        if self.asked is Asked.HISTORY:
            return ("history", "amplitude", "nonlinear shift")[: 3 if self.oscillates else 1]
        return ("frequencies",) if self.count > 1 else (_QUANTITIES[self.asked],)

    @property
    def is_spun_up(self) -> bool:
        """True where its history starts straight; else it starts on an orbit."""
        return self.motion is not None and not self.amplitudes

    @property
    def rotation(self) -> SpinUp | SteadyRotation:
        """Rotation of the clamp of a history; ValueError if the case asks for none."""
        if self.motion is None:
            raise ValueError(f"case {self.name} has several speeds: say which")
        return self.motion

    @property
    def ramp_time(self) -> float:
        """Time in which it is spun up [s]; 0 of a steady rotation."""
        return self.rotation.ramp_time

    @cached_property
    def orbit(self) -> Orbits:
        """Exact orbit that its history starts on, at phase 0; ValueError if it starts at rest."""
        if self.motion is None or not self.amplitudes:
            raise ValueError(f"case {self.name} starts at rest, on no orbit")
        return periodic_orbits(self.blade, self.motion.omega, self.amplitudes)

    @property
    def start(self) -> Callable[[FloatArray], BeamState] | None:
        """State at material points x [m] at t = 0; None of a beam that starts straight, at rest."""
        if self.kick:
            return partial(kicked_state, self.blade.length, self.kick)
        return None if self.is_spun_up else partial(self.orbit.state, 0)

    def whole_duration(self, step: float) -> float:
        """Return the duration, or a little more that is a whole number of steps [s]."""
        return math.ceil(self.duration / step * (1.0 - 1e-12)) * step


def _is_weight(load: Load) -> bool:
    """Whether a load is a steady weight along the axis of rotation."""
    in_plane = load.force(np.zeros(1), np.ones(1), 1.0)
    small = float(np.abs(in_plane).max()) < 1e-12 * abs(load.size)
    return small and load.acts_on == "mass" and not load.frequency


_QUANTITIES = {
    Asked.FREQUENCIES: "linear frequency",
    Asked.STEADY: "steady deflection",
    Asked.BACKBONE: "backbone",
}


def spin_up_case(
    blade: Blade,
    spin_up: SpinUp,
    duration: float,
    name: str = "S",
    level: Level = Level.MODERATE,
) -> Case:
    """Return the case of a spin-up that nothing damps."""
    title = f"spin-up to {spin_up.omega:g} rad/s in {spin_up.ramp_time:g} s"
    return Case(
        name=name, level=level, title=title, asked=Asked.HISTORY, blade=blade, motion=spin_up,
        duration=duration, oscillates=True,
    )  # fmt: skip


def frequency_case(blade: Blade, speeds: tuple[float, ...]) -> Case:
    """Return the case of linear frequencies."""
    title = "first natural frequency in steady rotation"
    return Case(
        name="L",
        level=Level.BASIC,
        title=title,
        asked=Asked.FREQUENCIES,
        blade=blade,
        speeds=speeds,
    )


SHEAR = (5.0 / 6.0) / (2.0 * 1.3)
"""k_s/(2 (1 + ν)) with k_s = 5/6 and ν = 0.3, of which references come with the package."""

SPEEDS = (0.0, 2.0, 4.0, 6.0, 8.0)
"""Speeds [rad/s] at which the paper's beam is looked at."""


def _cases() -> tuple[Case, ...]:
    blade = Beam.reference()
    length, mass = blade.length, blade.mass_per_length * blade.length

    def spun_up(name: str, level: Level, omega: float, ramp_time: float, duration: float) -> Case:
        return spin_up_case(blade, SpinUp(omega=omega, ramp_time=ramp_time), duration, name, level)

    s1 = spun_up("S1", Level.BASIC, 6.0, 3.0, 15.0)
    as_s1 = replace(s1, level=Level.BLADE)
    return (
        frequency_case(blade, SPEEDS),
        s1,
        Case(
            name="V", level=Level.BASIC, title="spin-up of Simo and Vu-Quoc", asked=Asked.HISTORY,
            blade=Beam.from_stiffness(
                length=10.0, axial_stiffness=2.8e7, bending_stiffness=1.4e4, mass_per_length=1.2
            ),
            motion=SpinUp(omega=6.0, ramp_time=15.0), duration=20.0,
        ),
        spun_up("S2", Level.MODERATE, 2.0, 3.375, 20.0),
        spun_up("S3", Level.MODERATE, 4.0, 2.0, 15.0),
        Case(
            name="O", level=Level.MODERATE, title="start on an exact orbit, no ramp",
            asked=Asked.HISTORY, blade=blade, motion=SteadyRotation(omega=2.0), duration=20.0,
            amplitudes=(0.4,), oscillates=True,
        ),
        spun_up("S4", Level.HARD, 8.0, 2.0, 15.0),
        Case(
            name="B", level=Level.HARD, title="backbones", asked=Asked.BACKBONE, blade=blade,
            speeds=(2.0, 6.0, 8.0), amplitudes=(0.1, 0.2, 0.3, 0.4, 0.5, 0.6),
        ),
        replace(as_s1, name="S1+h", title="S1 on a hub", blade=blade.with_hub_radius(0.5 * length)),
        # Half the beam's mass would swing by 0.93 L, farther than orbits are known.
        replace(
            as_s1, name="S1+m", title="S1 with a tip mass", blade=blade.with_tip_mass(0.1 * mass)
        ),
        # A hundredth of the critical damping of the first mode at rest.
        replace(
            as_s1, name="S1+d", title="S1 with viscous bending", oscillates=False,
            blade=blade.with_damping(Damping(bending=0.007)),
        ),
        replace(
            as_s1, name="S1+g", title="S1 under gravity", oscillates=False, loads=(Gravity(9.81),)
        ),
        *_stout(blade),
        *_in_space(),
    )  # fmt: skip


def _stout(blade: Beam) -> tuple[Case, ...]:
    """Return the cases of S3's beam with so small an EA that shear and rotary inertia count."""
    EI, length, slenderness = blade.bending_stiffness, blade.length, 30.0
    stout = Beam.from_stiffness(
        length=length, axial_stiffness=EI * (slenderness / length) ** 2,
        bending_stiffness=EI, mass_per_length=blade.mass_per_length,
    )  # fmt: skip
    laws = Theory(), Theory(shear=SHEAR), Theory(shear=SHEAR, engesser=True)
    theories = tuple(replace(law, rotary_inertia=turns) for law in laws for turns in (False, True))
    spun_up = spin_up_case(stout, SpinUp(omega=4.0, ramp_time=2.0), 15.0, "T", Level.BLADE)
    linear = replace(frequency_case(stout, (0.0, 2.0, 4.0, 6.0)), name="TL", level=Level.BLADE)
    return (
        replace(linear, title="stout beam, frequencies", theories=theories),
        replace(spun_up, title="S3, stout", oscillates=False, theories=theories),
    )


def _in_space() -> tuple[Case, ...]:
    """Return the cases of a plastic blade, a full ellipse of 320 mm by 80 mm, and of a tube."""
    height, width = 0.32, 0.08
    blade = Beam(
        length=8.0, area=0.25 * math.pi * height * width,
        second_moment=math.pi / 64.0 * height**3 * width, youngs_modulus=1e9, density=1200.0,
    )  # fmt: skip
    straight = blade.with_shape(Ellipse(ratio=height / width))
    twisted = straight.with_twist(math.pi / 6.0)
    coned, theories = twisted.with_precone(0.05), (BERNOULLI_EULER, Theory(shear=SHEAR))

    def case(name: str, title: str, asked: Asked, blade: Blade, **more: Any) -> Case:
        return Case(
            name=name, level=Level.SPACE, title=title, asked=asked, blade=blade, in_space=True,
            theories=theories, **more,
        )  # fmt: skip

    speeds = (0.0, 1.0, 2.0, 3.0)
    return (
        case("F", "flap, lag and torsion", Asked.FREQUENCIES, straight, speeds=speeds, count=7),
        case(
            "F+p", "twist and precone, frequencies", Asked.FREQUENCIES, coned, speeds=speeds,
            count=7,
        ),
        case("P", "twist and precone, steady state", Asked.STEADY, coned, speeds=speeds[1:]),
        case(
            "W", "spin-up of a twisted blade", Asked.HISTORY, twisted, duration=15.0,
            motion=SpinUp(omega=3.0, ramp_time=4.0),
        ),
        case(
            "G", "gravity normal to the plane, steady state", Asked.STEADY, twisted,
            speeds=speeds[1:], loads=(Gravity(9.81, tilt=0.5 * math.pi),),
        ),
        case(
            "K", "S1, kicked out of the plane", Asked.HISTORY,
            Beam.reference().with_shape(Tube()), motion=SpinUp(omega=6.0, ramp_time=3.0),
            duration=15.0, kick=2.0,
        ),
    )  # fmt: skip


CASES = {case.name: case for case in _cases()}
"""All cases by name, in the order in which a newcomer would take them."""
