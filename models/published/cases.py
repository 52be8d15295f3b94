"""Static and rotating blades that others have published: their numbers, and the exact blade's.

Numbers and sections are facts from the sources named; the test and the page of published cases
call what is here.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from analytic import Blade, LoadTable, Theory, linear_modes, steady_state
from analytic.arrays import FloatArray

SHEARED = Theory(shear=True, trapeze=False)
"""The theory of all these codes but BeamDyn, which has the trapeze effect of the elastic twist."""


def uniform(
    length: float, stiffness: FloatArray, mass: FloatArray | None = None, twist: float = 0.0
) -> Blade:
    """Return a blade of one 6×6 stiffness, twisted linearly to its tip [rad]."""
    inertia = np.eye(6) if mass is None else mass
    return Blade.from_stations(
        [0.0, length], [stiffness, stiffness], [inertia, inertia], twist=[0.0, twist]
    )


@dataclass(frozen=True)
class Static:
    """A blade at rest that a load bends: `printed` and `moved` are displacements of its tip."""

    name: str
    source: str
    printed: tuple[float, ...]
    digits: float  # half of the last one printed
    moved: Callable[[], FloatArray]


def composite() -> FloatArray:
    """Return the tip's displacement of a composite box beam under 150 lb: bending with torsion."""
    stiffness = 1e3 * np.diag([1368.17, 88.56, 38.78, 16.96, 59.12, 141.47])
    for (i, j), coupled in {(3, 4): 17.61e3, (3, 5): -0.351e3, (4, 5): -0.37e3}.items():
        stiffness[i, j] = stiffness[j, i] = coupled
    return _moved(uniform(10.0, stiffness), force=(0.0, 0.0, 150.0))


def twisted() -> FloatArray:
    """Return that of a strip twisted by 90 degrees under 4000 kN."""
    stiffness = np.diag([2.5e10, *2 * [8.2604167e9], 1.41872656e8, 5.20833e8, 1.30208333e8])
    return _moved(uniform(10.0, stiffness, twist=0.5 * math.pi), force=(0.0, 0.0, -4e6))


def rolled_up() -> FloatArray:
    """Return that of a beam that the moment on its tip rolls up to a full circle."""
    stiffness = 1e3 * np.diag([1770.0, 1770.0, 1770.0, 8.16, 86.9, 215.0])
    moment = -2.0 * math.pi * 86.9e3 / 10.0
    return _moved(uniform(10.0, stiffness), moment=(0.0, moment, 0.0))


def arc() -> FloatArray:
    """Return that of an eighth of a circle of 100 in radius under 600 lb normal to its plane."""
    stiffness = 1e7 * np.array([1.0, 0.5, 0.5, 1.0 / 12.0, 1.0 / 12.0, 1.0 / 12.0])
    blade = uniform(25.0 * math.pi, np.diag(stiffness)).with_sweep(-0.01)
    return _moved(blade, force=(0.0, 0.0, 600.0))


def partly_loaded() -> FloatArray:
    """Return the deflection of a beam of EI = 1e9 with 1000 per length from 0.3 to 0.7 of it."""
    stiffness = 1e9 * np.diag([1e3, 1e3, 1e3, 1.0, 1.0, 1.0])
    table = LoadTable(x=[0.3, 0.7], force=[[0.0, 0.0, 1e3]] * 2)
    bent = steady_state(uniform(1.0, stiffness), 0.0, loads=[table], tolerance=1e-12)
    return bent.tip[2:]


def _moved(blade: Blade, **loads: tuple[float, ...]) -> FloatArray:
    loaded, free = (
        steady_state(blade, 0.0, theory=SHEARED, tolerance=1e-10, **more) for more in (loads, {})
    )
    return loaded.tip - free.tip


WANG = "{cite:t}`wang2017`, digits of {cite:t}`kynema`"
STATIC = (
    Static(
        "composite box beam under 150 lb, bending coupled with torsion", WANG,
        (-9.02726627566299e-2, -6.47488486259036e-2, 1.22973648292371), 1e-12, composite,
    ),
    Static(
        "strip twisted by 90° under 4000 kN", WANG,
        (-1.14152599953942, -1.71805334646388, -3.59321324026952), 1e-11, twisted,
    ),
    Static(
        "beam rolled up to a full circle by a moment", WANG, (-10.0, 0.0, 0.0), 1e-9, rolled_up
    ),
    Static(
        "arc of 45° under 600 lb, 16 elements", "{cite:t}`gxbeam`",
        (-23.545303336988038, 13.577383726758564, 53.45800757548929), 0.03, arc,
    ),
    Static("the same", "{cite:t}`bathe1979`", (-23.5, 13.4, 53.4), 0.21, arc),
    Static(
        "uniform load on the middle of a beam, linear", "{cite:t}`gxbeam`, its closed form",
        (1e3 / 24e9 * (0.7**3 * 3.3 - 0.3**3 * 3.7),), 1e-12, partly_loaded,
    ),
)  # fmt: skip

SWEEPS = 0, 15, 30, 45
MEASURED: dict[int, tuple[tuple[float, ...], ...]] = {
    0: ((1.4, 1.8, 1.7, 1.6), (10.3, 10.2, 10.4, 10.4), (27.7, 27.2, 26.6, 24.8)),
    500: ((10.2, 10.1, 10.2, 10.2), (25.2, 25.2, 23.7, 21.6), (47.0, 44.4, 39.3, 35.1)),
    750: (
        (14.8, 14.4, 14.9, 14.7), (36.1, 34.8, 30.7, 26.1), (62.9, 55.9, 48.6, 44.8),
        (95.4, 87.5, 83.7, 78.8), (106.6, 120.1, 122.6, 117.7), (132.7, 147.3, 166.2, 162.0),
    ),
}  # fmt: skip
"""Frequencies [Hz] by rotation [rpm] of strips with swept tips, at each sweep of SWEEPS [deg].

Epps and Chandra (1996), as in the tests of GXBeam.
"""


def swept_tip(sweep: float) -> Blade:
    """Return the measured strip of aluminum: 37.5 in, on a hub of 2.5 in, swept from 31.5 in on."""
    width, height, modulus, density, poisson = 1.0, 0.063, 1.06e7, 2.51e-4, 0.325
    area, flap, lag = width * height, width * height**3 / 12.0, width**3 * height / 12.0
    shear = 0.5 * modulus / (1.0 + poisson)
    stiffness = [
        modulus * area, shear * area / 1.2000001839588001, shear * area / 14.625127919304001,
        shear * (flap + lag) / 65.85255016982444, modulus * flap, modulus * lag,
    ]  # fmt: skip
    mass = density * np.array([area, area, area, flap + lag, flap, lag])
    blade = uniform(37.5, np.diag(stiffness), np.diag(mass)).with_hub_radius(2.5)
    return blade.with_kink(31.5, sweep=-math.radians(sweep)) if sweep else blade


def deviations() -> FloatArray:
    """Return computed over measured frequencies less one, (48,), by the nearest computed one."""
    found = []
    for k, sweep in enumerate(SWEEPS):
        for rpm, rows in MEASURED.items():
            modes = linear_modes(
                swept_tip(sweep), rpm * math.pi / 30.0, 3 * len(rows) // 2 + 1, theory=SHEARED,
                tolerance=1e-6,
            )  # fmt: skip
            hertz = modes.frequencies / (2.0 * math.pi)
            ratios = [hertz / row[k] for row in rows]
            found += [ratio[np.argmin(np.abs(np.log(ratio)))] - 1.0 for ratio in ratios]
    return np.array(found)
