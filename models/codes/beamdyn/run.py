"""BeamDyn: one Legendre spectral element, whose degree is raised; its driver led by Eq. 1.

Here with Gauss's quadrature; `beamdyn_as_used` has the rule and the damping of its users.
"""

import os
import shutil
import sys
import tempfile
from collections.abc import Mapping, Sequence
from functools import cache, partial
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

sys.path.insert(0, str(Path(__file__).parents[1]))
from common import bends_in_space, output_of, sampled, take_part, twist_of

from rotbeam_exu.verification.case import Case
from rotbeam_exu.verification.submission import Declaration

HERE, SOURCES = Path(__file__).parent, os.environ.get("OPENFAST", "")
MODULES = "cmake", "modules/nwtc-library", "modules/version", "modules/beamdyn"
SHEAR, TURNING = 100.0, 1e-3
"""GA over EA, and rotary inertia over m EI/EA: of a beam that hardly shears, as slender ones."""

AXES = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)

STATIONS = 49
"""Stations of the table as it is used, those of NREL's 5 MW blade."""


@cache
def driver() -> Path:
    """Build the driver from a copy of OpenFAST's sources, in a minute and a half."""
    folder = Path(tempfile.mkdtemp())
    for part in MODULES:
        shutil.copytree(Path(SOURCES, part), folder / part)
    source = folder / "modules/beamdyn/src"
    output_of(["patch", "-d", source, "-i", HERE / "driver.patch"])
    environment = {**os.environ, "OPENFAST": str(folder)}
    build = folder / "build"
    output_of(["cmake", "-S", HERE, "-B", build, "-DCMAKE_BUILD_TYPE=Release"], env=environment)
    output_of(["make", "-C", build, "beamdyn_driver"])
    return build / "bd/beamdyn_driver"


def row(values) -> str:
    """Return numbers as BeamDyn reads them."""
    return " ".join(f"{value:.15E}" for value in values)


def driver_lines(
    omega: float, h: float, end: float, weight: Sequence[float], hub: float, frame=AXES
) -> list[str]:
    """Return the driver's file: of a root at a hub, with a frame's rows as axes, about x."""
    zeros = ["0 zero"] * 6
    return [
        "-", "-", "-", "True DynamicSolve", "0 t_initial", f"{end} t_final", f"{h} dt", "-",
        *(f"{one} g" for one in weight), "-", *zeros[:2], f"{hub} GlbPos(3)", "-", "-",
        *map(row, frame), "True GlbRotBladeT0", "-", f"{omega} RootVel(4)", *zeros[:2], "-",
        *zeros, *zeros, "0 NumPointLoads", "-", "-", "-", '"primary.inp" InputFile', "-",
        "0 WrVTK", "15 VTK_fps",
    ]  # fmt: skip


def primary_lines(
    keys: Sequence[Sequence[float]], members: int, degree: int, h: float, *,
    rho: float = 0.9, quadrature: int = 1, settled: bool = False,
) -> list[str]:  # fmt: skip
    """Return the primary file: of key points x, y, z [m] and twist [deg], three a member."""
    return [
        "-", "-", "-", "False Echo", f"{settled} QuasiStaticInit", f"{rho} rhoinf",
        f"{quadrature} quadrature", "1 refine", "1 n_fact", f"{h} DTBeam",
        '"DEFAULT" load_retries', "20 NRMax",
        "1e-6 stop_tol", "False tngt_stf_fd", "False tngt_stf_comp",
        '"DEFAULT" tngt_stf_pert', '"DEFAULT" tngt_stf_difftol', "True RotStates", "-",
        f"{members} member_total", f"{len(keys)} kp_total",
        *(f"{k + 1} 3" for k in range(members)), "-", "-", *map(row, keys),
        "-", f"{degree} order_elem", "-", '"blade.inp" BldFile', "-", "False SumPrint",
        '"ES23.15E3" OutFmt', "1 NNodeOuts", "1 OutNd", "OutList",
        *(f'"Tip{kind}D{axis}r"' for kind in "TR" for axis in "xyz"), "END", "-",
    ]  # fmt: skip


def files(case: Case, degree: int, h: float, *, used: bool = False) -> dict[str, list[str]]:
    """Return the driver's file, the primary one and that of the sections.

    Its z is along the blade, its x the axis of rotation and its y against q.
    """
    beam = case.blade
    weight = sum(load.gravity for load in case.loads)
    damping = beam.damping.bending
    stations = np.linspace(0.0, 1.0, STATIONS if used else 2)
    EA, EI, m = beam.axial_stiffness, beam.bending_stiffness, beam.mass_per_length
    flap, GJ, twist = bends_in_space(beam)
    inertia = (TURNING if beam.section.out_of_plane is None else 1.0) * m / EA
    matrices = [
        row(line)
        for diagonal in (
            (SHEAR * EA, SHEAR * EA, EA, EI, flap, GJ),
            (m, m, m, inertia * EI, inertia * flap, inertia * (EI + flap)),
        )
        for line in (*np.diag(diagonal), ())
    ]
    keys = [(0.0, 0.0, x * beam.length, -x * np.degrees(twist)) for x in (0.0, 0.5, 1.0)]
    how = {"rho": 0.0, "quadrature": 2} if used else {}
    return {
        "driver.inp": driver_lines(
            case.rotation.omega, h, case.duration, (0, weight, 0), beam.hub_radius
        ),
        "primary.inp": primary_lines(keys, 1, degree, h, **how),
        "blade.inp": [
            "-", "-", "-", f"{stations.size} station_total", f"{int(damping > 0.0)} damp_type", "-",
            "-", "-", row((0.0, 0.0, 0.0, damping, damping, 0.0)), "-",
            "1 n_modes", "0.01 zeta", "-",
            *(line for eta in stations for line in (f"{eta:.15f}", *matrices)),
        ],
    }  # fmt: skip


def tip(folder: str | Path) -> tuple[np.ndarray, np.ndarray]:
    """Return times, and lag, flap and twist of the tip from its unloaded place, (samples, 3)."""
    lines = Path(folder, "driver.out").read_text().splitlines()
    first = next(k for k, line in enumerate(lines) if line.strip().startswith("Time"))
    time, up, against, _, *turned = np.loadtxt(lines[first + 2 :]).T
    # Wiener and Milenkovic's parameters are 4 tan(φ/4) times the axis.
    size = np.linalg.norm(turned, axis=0)
    vector = np.array(turned) * 4.0 * np.arctan(size / 4.0) / np.maximum(size, 1e-300)
    twist = twist_of(Rotation.from_rotvec((vector[::-1] * [[1.0], [-1.0], [1.0]]).T))
    return time, np.stack((-against, up, twist), axis=1)


def history(case: Case, degree: int, h: float, *, used: bool = False):
    """Return what the case asks of the tip's displacement and turn, in the frame of the root."""
    program = driver()
    with tempfile.TemporaryDirectory() as folder:
        for name, lines in files(case, degree, h, used=used).items():
            Path(folder, name).write_text("\n".join(lines) + "\n")
        ramp = {**os.environ, "RAMP_T": repr(case.rotation.ramp_time)}
        output_of([program, "driver.inp"], cwd=folder, env=ramp)
        time, found = tip(folder)
    return sampled(case, time, found[:, 0] if len(case.columns) == 1 else found)


def take_part_as(
    script: str, code: str, how: str, runs: Mapping[str, Sequence[tuple[int, float]]], **options
):
    """Run and record BeamDyn set up in one of the ways."""
    if not SOURCES:
        print("BeamDyn is left out: set OPENFAST to a folder with OpenFAST's sources")
        return
    declaration = Declaration(
        code=code, version="OpenFAST 4, commit 2895884d2", licence="Apache-2.0",
        url="https://github.com/OpenFAST/openfast", order_in_step=2.0,
        element=f"one Legendre spectral element, elements are its degree; {how}",
    )  # fmt: skip
    driver()
    take_part(script, declaration, partial(history, **options), runs)


if __name__ == "__main__":
    runs = [(8, 4e-3), (10, 4e-3), (12, 4e-3), (14, 4e-3), (10, 8e-3), (10, 2e-3), (10, 1e-3)]
    cases = "S1", "V", "S2", "S3", "S4", "S1+h", "S1+d", "S1+g", "W"
    take_part_as(__file__, "BeamDyn", "Gauss's quadrature", dict.fromkeys(cases, runs))
