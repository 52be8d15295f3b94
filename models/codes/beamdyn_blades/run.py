"""BeamDyn on real blades: members between the stations of a table, whose degree is raised."""

import os
import re
import runpy
import sys
import tempfile
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1]))
from common import output_of, root_axes, rows_of, take_part

from analytic import Theory
from analytic.exact.continuum.unit import space_unit
from rotbeam_exu.files.openfast import write_beamdyn
from rotbeam_exu.verification.case import Asked, Case
from rotbeam_exu.verification.cases import CASES, SHEAR
from rotbeam_exu.verification.submission import Declaration

beamdyn = runpy.run_path(str(Path(__file__).parents[1] / "beamdyn/run.py"))

DEGREES = 2, 3, 4
"""Degrees of the polynomials of a member."""

STEP = 1e-3  # of the driver, whose first line of results is read alone


def write(folder: Path, case: Case, degree: int, omega: float) -> None:
    """Write BeamDyn's three files; its z is along the blade, its x up and its y against lag."""
    blade, modes = case.blade, case.asked is Asked.FREQUENCIES
    stations = np.array([x for x, _ in blade.line.twist])
    # Three key points a member: its line is a parabola through them. Of a straight blade one
    # member between two stations is enough, and shorter ones lose digits.
    each = 2 if blade.line.prebend == 0.0 else 4
    places = np.arange(each * (stations.size - 1) + 1) / each
    x = np.interp(places, np.arange(stations.size), stations)
    line = blade.length * space_unit(blade).unloaded(x / blade.length)[0]
    twist = np.interp(x, *np.array(blade.line.twist).T)
    keys = np.column_stack((line[:, [2, 1, 0]] * [1.0, -1.0, 1.0], -np.degrees(twist)))
    # BeamDyn has up and radial in exchanged places, for which the matrix is the same.
    frame = root_axes(blade)
    weight = (0.0 if modes else -9.81, 0, 0)
    for name, lines in (
        ("driver.inp", beamdyn["driver_lines"](
            omega, STEP, 2.0 * STEP, weight, blade.hub_radius, frame
        )),
        ("primary.inp", beamdyn["primary_lines"](
            keys, (x.size - 1) // 2, degree, STEP, settled=not modes
        )),
    ):  # fmt: skip
        (folder / name).write_text("\n".join(lines) + "\n")
    _, sections = write_beamdyn(blade, folder / "b.dat")
    text = sections.read_text()
    if modes:  # it prints frequencies where it damps by modes
        for name, value in (
            ("damp_type", "2"), ("n_modes", f"{case.count}"), ("zeta", "0.01 " * case.count)
        ):  # fmt: skip
            text = re.sub(rf"^[\d. ]*(?={name} )", f"{value} ", text, flags=re.MULTILINE)
    (folder / "blade.inp").write_text(text)


def numbers(case: Case, degree: int, omega: float) -> list[float]:
    """Return frequencies [rad/s] at rest, or the steady tip, by its quasi-static start."""
    program = beamdyn["driver"]()
    plain = {key: value for key, value in os.environ.items() if key != "RAMP_T"}
    with tempfile.TemporaryDirectory() as made:
        folder = Path(made)
        write(folder, case, degree, omega)
        output_of([program, "driver.inp"], cwd=folder, env=plain)
        if case.asked is Asked.FREQUENCIES:
            (table,) = folder.glob("*modes.csv")
            lines = table.read_text().splitlines()[1 : 1 + case.count]
            return [2.0 * np.pi * float(line.split()[0]) for line in lines]
        lag, flap, twist = beamdyn["tip"](folder)[1][0].tolist()
    (unloaded,), _ = space_unit(case.blade).unloaded(np.ones(1))
    _, y, z = (case.blade.length * unloaded).tolist()
    return [y + lag, z + flap, twist]


if __name__ == "__main__":
    if not beamdyn["SOURCES"]:
        print("BeamDyn is left out: set OPENFAST to a folder with OpenFAST's sources")
    else:
        declaration = Declaration(
            code="BeamDyn, real blades", version="OpenFAST 4, commit 2895884d2",
            licence="Apache-2.0", url="https://github.com/OpenFAST/openfast",
            theory=Theory(shear=SHEAR, rotary_inertia=True),
            element="a member between two stations, two on a curved line; elements are its degree",
        )  # fmt: skip
        # At speed its frequencies lack Coriolis forces, so those at rest alone.
        speeds = {
            name: CASES[name].speeds if CASES[name].asked is Asked.STEADY else (0.0,)
            for name in ("F+N", "G+N", "F+I", "G+I")
        }
        take_part(__file__, declaration, rows=rows_of(numbers, DEGREES, speeds))
