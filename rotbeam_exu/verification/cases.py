"""The tasks of the benchmark, each a blade, how it is driven, and what is asked."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from functools import lru_cache

from analytic import (
    AnyBlade,
    Beam,
    Damping,
    Gravity,
    Orbits,
    SpinUp,
    SteadyRotation,
    periodic_orbits,
)
from analytic.loads import Load

VERSION = "1.0"
"""Of the benchmark: cases, references and thresholds."""


class Level(StrEnum):
    """How much a code must be able to do."""

    BASIC = "basic"
    MODERATE = "moderate"
    HARD = "hard"
    BLADE = "blade"


class Asked(StrEnum):
    """What is handed in."""

    FREQUENCIES = "first natural frequency at each speed"
    HISTORY = "deflection of the tip over time"
    BACKBONE = "nonlinear frequency at each speed and amplitude"


@dataclass(frozen=True, kw_only=True)
class Case:
    """One task.

    Attributes
    ----------
    name : str
        As files and folders are named: "L", "S1", "S1+h".
    level : Level
    title : str
        What it is, in a few words.
    asked : Asked
    blade : Beam or Blade
        Damping included.
    motion : SpinUp or SteadyRotation, optional
        How the clamp turns, of a history.
    duration : float
        Of the history [s].
    speeds : tuple of float
        Of frequencies and backbones [rad/s].
    amplitudes : tuple of float
        Peak |q|/L: of a history the orbit it starts on, of a backbone its points.
    loads : tuple
    oscillates : bool
        Whether the history ends in a steady oscillation, whose amplitude and frequency are judged.
    """

    name: str
    level: Level
    title: str
    asked: Asked
    blade: AnyBlade
    motion: SpinUp | SteadyRotation | None = None
    duration: float = 0.0
    speeds: tuple[float, ...] = ()
    amplitudes: tuple[float, ...] = ()
    loads: tuple[Load, ...] = ()
    oscillates: bool = False


def spin_up_case(beam: AnyBlade, spin_up: SpinUp, duration: float, name: str = "S") -> Case:
    """Return the case of a spin-up that nothing damps."""
    return Case(
        name=name,
        level=Level.MODERATE,
        title=f"spin-up to {spin_up.omega:g} rad/s in {spin_up.ramp_time:g} s",
        asked=Asked.HISTORY,
        blade=beam,
        motion=spin_up,
        duration=duration,
        oscillates=True,
    )


def frequency_case(beam: AnyBlade, speeds: tuple[float, ...]) -> Case:
    """Return the case of linear frequencies."""
    return Case(
        name="L",
        level=Level.BASIC,
        title="first natural frequency in steady rotation",
        asked=Asked.FREQUENCIES,
        blade=beam,
        speeds=speeds,
    )


@lru_cache(maxsize=8)
def starting_orbit(case: Case) -> Orbits:
    """Return the exact orbit that a case starts on, at phase 0; ValueError if it starts at rest."""
    if not isinstance(case.motion, SteadyRotation) or not case.amplitudes:
        raise ValueError(f"case {case.name} starts at rest, on no orbit")
    return periodic_orbits(case.blade, case.motion.omega, case.amplitudes)


SPEEDS = (0.0, 2.0, 4.0, 6.0, 8.0)
"""Speeds [rad/s] at which the paper's beam is looked at."""


def _cases() -> tuple[Case, ...]:
    beam = Beam.reference()
    length, mass = beam.length, beam.mass_per_length * beam.length
    s1 = SpinUp(omega=6.0, ramp_time=3.0)

    def history(name: str, level: Level, title: str, blade: AnyBlade, **rest: object) -> Case:
        return Case(name=name, level=level, title=title, asked=Asked.HISTORY, blade=blade, **rest)  # type: ignore[arg-type]

    def spun_up(name: str, level: Level, omega: float, ramp_time: float, duration: float) -> Case:
        title = f"spin-up to {omega:g} rad/s in {ramp_time:g} s"
        motion = SpinUp(omega=omega, ramp_time=ramp_time)
        return history(name, level, title, beam, motion=motion, duration=duration, oscillates=True)

    def varied(letter: str, title: str, blade: AnyBlade, **rest: object) -> Case:
        return history(
            f"S1+{letter}", Level.BLADE, f"S1 {title}", blade, motion=s1, duration=15.0, **rest
        )

    return (
        frequency_case(beam, SPEEDS),
        spun_up("S1", Level.BASIC, 6.0, 3.0, 15.0),
        history(
            "V", Level.BASIC, "spin-up of Simo and Vu-Quoc",
            Beam.from_stiffness(
                length=10.0, axial_stiffness=2.8e7, bending_stiffness=1.4e4, mass_per_length=1.2
            ),
            motion=SpinUp(omega=6.0, ramp_time=15.0), duration=20.0,
        ),
        spun_up("S2", Level.MODERATE, 2.0, 3.375, 20.0),
        spun_up("S3", Level.MODERATE, 4.0, 2.0, 15.0),
        history(
            "O", Level.MODERATE, "start on an exact orbit, no ramp", beam,
            motion=SteadyRotation(omega=2.0), duration=20.0, amplitudes=(0.4,), oscillates=True,
        ),
        spun_up("S4", Level.HARD, 8.0, 2.0, 15.0),
        Case(
            name="B", level=Level.HARD, title="backbones", asked=Asked.BACKBONE, blade=beam,
            speeds=(2.0, 6.0, 8.0), amplitudes=(0.1, 0.2, 0.3, 0.4, 0.5, 0.6),
        ),
        varied("h", "on a hub", beam.with_hub_radius(0.5 * length), oscillates=True),
        # Half the beam's mass would swing by 0.93 L, farther than orbits are known.
        varied("m", "with a tip mass", beam.with_tip_mass(0.1 * mass), oscillates=True),
        # A hundredth of the critical damping of the first mode at rest.
        varied("d", "with viscous bending", beam.with_damping(Damping(bending=0.007))),
        varied("g", "under gravity", beam, loads=(Gravity(9.81),)),
    )  # fmt: skip


CASES = {case.name: case for case in _cases()}
"""All cases by name, in the order in which a newcomer would take them."""
