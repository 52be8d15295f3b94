"""Project Chrono: beams of three kinds, whose root a motor leads by Eq. 1.

Here ANCF cables; `chrono_timoshenko` and `chrono_iga` have the others.
"""

import math
import os
import sys
import tempfile
from collections.abc import Mapping, Sequence
from functools import cache, partial
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1]))
from common import SPACING, across, output_of, take_part

from rotbeam_exu.verification.case import Case
from rotbeam_exu.verification.submission import Declaration

HERE, SOURCES = Path(__file__).parent, os.environ.get("CHRONO", "")
EIGEN = os.environ.get("EIGEN", "/usr/include/eigen3")


@cache
def driver() -> Path:
    """Compile the driver with Chrono's sources and the library in their folder `build`."""
    program, build = Path(tempfile.mkdtemp(), "driver"), Path(SOURCES, "build")
    third = Path(SOURCES, "src/chrono_thirdparty")
    include = (
        Path(SOURCES, "src"), build, third / "yaml-cpp/include",
        Path(SOURCES, "src/chrono/collision/bullet"), EIGEN,
    )  # fmt: skip
    # As Chrono was compiled: with other alignment it crashes.
    like = ("-DNDEBUG", "-DEIGEN_DONT_PARALLELIZE", "-DBP_USE_FIXEDPOINT_INT_32",
            "-DBT_THREADSAFE", "-DCH_IGNORE_DEPRECATED", "-march=native")  # fmt: skip
    output_of([
        "g++", "-O2", "-std=c++17", "-w", *like, *(f"-I{path}" for path in include), "-o", program,
        HERE / "driver.cpp", f"-L{build / 'lib'}", "-lChrono_core", f"-Wl,-rpath,{build / 'lib'}",
    ])  # fmt: skip
    return program


def history(kind: str, case: Case, elements: int, h: float):
    """Return q of a case."""
    blade = case.blade
    sums = (
        blade.length, blade.axial_stiffness, blade.bending_stiffness, blade.mass_per_length,
        blade.hub_radius, case.rotation.omega, case.rotation.ramp_time, case.duration,
        sum(one.mass for one in blade.point_masses), sum(load.gravity for load in case.loads),
    )  # fmt: skip
    every = round(SPACING / h)
    if not math.isclose(every * h, SPACING, rel_tol=1e-9):
        raise RuntimeError(f"a step of {h:g} s is no part of {SPACING:g} s")
    printed = output_of([driver(), kind, elements, repr(h), every, *map(repr, sums)])
    _, x, y = np.loadtxt(printed.splitlines()).T
    return across(case, x + 1j * y)


def take_part_as(
    script: str, kind: str, name: str, order: float | None,
    runs: Mapping[str, Sequence[tuple[int, float]]],
):  # fmt: skip
    """Run and record one of the kinds."""
    if not SOURCES:
        print("Chrono is left out: set CHRONO to a folder with its sources, built in build")
        return
    declaration = Declaration(
        code=f"Project Chrono, {kind}", version="commit 7689fbc02, August 2026",
        licence="BSD-3-Clause", url="https://projectchrono.org", order=order, order_in_step=2.0,
        element=f"{name}; HHT with α = -0.05",
    )  # fmt: skip
    driver()
    take_part(script, declaration, partial(history, kind), runs)


if __name__ == "__main__":
    runs = [(16, 4e-3), (32, 4e-3), (64, 4e-3), (32, 2e-3), (32, 1e-3)]
    cases = "S1", "V", "S2", "S3", "S4", "S1+h", "S1+m", "S1+g"
    take_part_as(__file__, "cable", "ChElementCableANCF", 4.0, dict.fromkeys(cases, runs))
