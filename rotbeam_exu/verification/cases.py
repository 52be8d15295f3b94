"""The cases of the benchmark: each a blade, its motion and loads, and the quantity asked for."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np

from analytic import Beam, Blade, Damping, Ellipse, Gravity, SpinUp, SteadyRotation, Tube
from analytic.theory import BERNOULLI_EULER, Theory

from .case import Asked, Case, Level
from .space_cases import SpaceCase, TableCase

VERSION = "1.2"
"""Version of the benchmark: the first number of its thresholds, the second of its list of cases."""


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
        *_of_tables(),
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
    speeds = (0.0, 1.0, 2.0, 3.0)
    case = partial(SpaceCase, level=Level.SPACE, theories=theories)
    modes = partial(case, asked=Asked.FREQUENCIES, speeds=speeds, count=7)
    steady = partial(case, asked=Asked.STEADY, speeds=speeds[1:])
    spun_up = partial(case, asked=Asked.HISTORY, duration=15.0)
    return (
        modes(name="F", title="flap, lag and torsion", blade=straight),
        modes(name="F+p", title="twist and precone, frequencies", blade=coned),
        steady(name="P", title="twist and precone, steady state", blade=coned),
        spun_up(
            name="W", title="spin-up of a twisted blade", blade=twisted,
            motion=SpinUp(omega=3.0, ramp_time=4.0),
        ),
        steady(
            name="G", title="gravity normal to the plane, steady state", blade=twisted,
            loads=(Gravity(9.81, tilt=0.5 * math.pi),),
        ),
        spun_up(
            name="K", title="S1, kicked out of the plane", kick=2.0,
            blade=Beam.reference().with_shape(Tube()), motion=SpinUp(omega=6.0, ramp_time=3.0),
        ),
    )  # fmt: skip


BLADES = Path(__file__).parent / "data" / "kit" / "blades"
"""Tables of the real blades, as the kit has them."""


def blade_of_table(name: str) -> Blade:
    """Return the blade of a table: x, twist, curvatures, and 6x6 matrices linear in between."""
    x, twist, prebend, sweep, *upper = np.loadtxt(
        BLADES / f"{name}.csv", delimiter=",", skiprows=2
    ).T
    at, (row, column) = np.array(upper).T, np.triu_indices(6)
    stiffness, mass = matrices = np.zeros((2, x.size, 6, 6))
    for of, values in zip(matrices, np.split(at, 2, axis=1), strict=True):
        of[:, row, column] = of[:, column, row] = values
    blade = Blade.from_stations(x, stiffness, mass, twist=twist, interpolation="matrix")
    if prebend.any():
        blade = blade.with_prebend(tuple(zip(x, prebend, strict=True)))
    return blade.with_sweep(tuple(zip(x, sweep, strict=True))) if sweep.any() else blade


def _of_tables() -> tuple[Case, ...]:
    """Return the cases of NREL's 5 MW and IEA Wind's 15 MW blades, to their rated speeds."""

    def of(table: str, hub: float, precone: float, rated: float) -> tuple[Case, ...]:
        blade = blade_of_table(table).with_hub_radius(hub).with_precone(precone)
        case = partial(
            TableCase, level=Level.REAL, blade=blade, table=table,
            theories=(BERNOULLI_EULER, Theory(shear=SHEAR)),
        )  # fmt: skip
        speeds = (0.0, 0.5 * rated, rated)
        return (
            case(
                name=f"F+{table}", title="six modes of a real blade", asked=Asked.FREQUENCIES,
                speeds=speeds, count=6,
            ),
            case(
                name=f"G+{table}", title="its sag under weight, turning", asked=Asked.STEADY,
                speeds=speeds, loads=(Gravity(9.81, tilt=0.5 * math.pi),),
            ),
            case(
                name=f"W+{table}", title="its run-up under weight, with the root's moment",
                asked=Asked.HISTORY, motion=SpinUp(omega=rated, ramp_time=10.0), duration=20.0,
                loads=(Gravity(9.81),), settled=True,
            ),
        )  # fmt: skip

    return *of("N", 1.5, -0.0436332, 1.267), *of("I", 3.960329, -0.0625963, 0.7917)


CASES = {case.name: case for case in _cases()}
"""All cases by name, in the order in which a newcomer would take them."""
