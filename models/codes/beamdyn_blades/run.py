"""BeamDyn on real blades: members between the stations of a table, whose degree is raised."""

import os
import re
import runpy
import sys
import tempfile
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

sys.path.insert(0, str(Path(__file__).parents[1]))
from common import output_of, take_part, twist_of

from analytic import Theory, steady_state
from rotbeam_exu.files.openfast import blade_file_of, write_beamdyn
from rotbeam_exu.verification.case import Asked, Case
from rotbeam_exu.verification.cases import CASES, SHEAR
from rotbeam_exu.verification.submission import Declaration, Row

beamdyn = runpy.run_path(str(Path(__file__).parents[1] / "beamdyn/run.py"))
row = beamdyn["row"]

DEGREES = 2, 3, 4
"""Degrees of the polynomials of a member."""

STEP = 1e-3  # of the two that the driver makes; the first line of its table is what is asked


def write(folder: Path, case: Case, degree: int, omega: float) -> None:
    """Write BeamDyn's three files; its z is along the blade, its x up and its y against lag."""
    blade, modes = case.blade, case.asked is Asked.FREQUENCIES
    stations = np.array([x for x, _ in blade.line.twist])
    # Three key points a member: its line is a parabola through them. Of a straight blade one
    # member between two stations is enough, and shorter ones lose digits.
    each = 2 if blade.line.prebend == 0.0 else 4
    places = np.arange(each * (stations.size - 1) + 1) / each
    x = np.interp(places, np.arange(stations.size), stations)
    line = steady_state(blade, 0.0).section_loads(x).place[:, [2, 1, 0]] * [1.0, -1.0, 1.0]
    twist = np.interp(x, *np.array(blade.line.twist).T)
    count = (x.size - 1) // 2
    cosine, sine = np.cos(blade.line.precone), np.sin(blade.line.precone)
    frame = [[cosine, 0.0, -sine], [0.0, 1.0, 0.0], [sine, 0.0, cosine]]
    zeros, weight = ["0 zero"] * 6, 0.0 if modes else -9.81
    driver = [
        "-", "-", "-", "True DynamicSolve", "0 t_initial", f"{2.0 * STEP} t_final", f"{STEP} dt",
        "-", f"{weight} g", "0 g", "0 g", "-", *zeros[:2], f"{blade.hub_radius} GlbPos(3)", "-",
        "-", *map(row, frame), "True GlbRotBladeT0", "-", f"{omega} RootVel(4)", *zeros[:2], "-",
        *zeros, *zeros, "0 NumPointLoads", "-", "-", "-", '"primary.inp" InputFile', "-",
        "0 WrVTK", "15 VTK_fps",
    ]  # fmt: skip
    primary = [
        "-", "-", "-", "False Echo", f"{not modes} QuasiStaticInit", "0.9 rhoinf",
        "1 quadrature", "1 refine", "1 n_fact", f"{STEP} DTBeam", '"DEFAULT" load_retries',
        "50 NRMax", "1e-6 stop_tol", "False tngt_stf_fd", "False tngt_stf_comp",
        '"DEFAULT" tngt_stf_pert', '"DEFAULT" tngt_stf_difftol', "True RotStates", "-",
        f"{count} member_total", f"{x.size} kp_total", *(f"{k + 1} 3" for k in range(count)),
        "-", "-", *(row((*at, -np.degrees(t))) for at, t in zip(line, twist, strict=True)), "-",
        f"{degree} order_elem", "-", f'"{blade_file_of(folder / "b.dat").name}" BldFile', "-",
        "False SumPrint", '"ES23.15E3" OutFmt', "1 NNodeOuts", "1 OutNd", "OutList",
        *(f'"Tip{kind}D{axis}r"' for kind in "TR" for axis in "xyz"), "END", "-",
    ]  # fmt: skip
    write_beamdyn(blade, folder / "b.dat")
    for name, lines in (("driver.inp", driver), ("primary.inp", primary)):
        (folder / name).write_text("\n".join(lines) + "\n")
    if modes:  # it prints frequencies where it damps by modes
        sections = blade_file_of(folder / "b.dat")
        text = sections.read_text()
        for name, value in (
            ("damp_type", "2"), ("n_modes", f"{case.count}"), ("zeta", "0.01 " * case.count)
        ):  # fmt: skip
            text = re.sub(rf"^[\d. ]*(?={name} )", f"{value} ", text, flags=re.MULTILINE)
        sections.write_text(text)


def numbers(case: Case, degree: int, omega: float):
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
        lines = (folder / "driver.out").read_text().splitlines()
    first = next(k for k, line in enumerate(lines) if line.strip().startswith("Time"))
    _, up, against, _, *turned = np.loadtxt(lines[first + 2 :])[0]
    # Wiener and Milenkovic's parameters are 4 tan(φ/4) times the axis.
    size = np.linalg.norm(turned)
    x, y, z = np.array(turned) * 4.0 * np.arctan(size / 4.0) / size
    (twist,) = twist_of(Rotation.from_rotvec([[z, -y, x]]))
    _, lag, flap = steady_state(case.blade, 0.0).tip
    return [lag - against, flap + up, twist]


def rows() -> list[Row]:
    """Return all rows; at speed its frequencies lack Coriolis forces, so those at rest alone."""
    made = []
    for name in ("F+N", "G+N", "F+I", "G+I"):
        case = CASES[name]
        steady = case.asked is Asked.STEADY
        for omega in case.speeds if steady else (0.0,):
            for degree in DEGREES:
                found = numbers(case, degree, omega)
                print(name, omega, degree, found, flush=True)
                place = {"case": name, "elements": degree, "speed": omega}
                if steady:
                    made.append(Row(**place, values=tuple(found)))
                else:
                    made += [Row(**place, number=k, values=(f,)) for k, f in enumerate(found, 1)]
    return made


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
        take_part(__file__, declaration, rows=rows())
