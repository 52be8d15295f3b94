"""CalculiX: a row of bricks C3D20R, twenty nodes, with Hilber, Hughes and Taylor's rule."""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1]))
from common import SPACING, across, output_of, take_part

from analytic import Theory
from rotbeam_exu.verification.cases import Case
from rotbeam_exu.verification.submission import Declaration

CORNERS, MIDDLES = ((0, -1), (2, -1), (2, 1), (0, 1)), ((1, -1), (2, 0), (1, 1), (0, 0))
BRICK = [(*at, k) for of in (CORNERS, MIDDLES) for k in (-1, 1) for at in of]
BRICK += [(*at, 0) for at in CORNERS]
FACE = [(j, k) for j in (-1, 0, 1) for k in (-1, 0, 1) if j or k]


def mesh(case: Case, n: int):
    """Return nodes, elements and material as text, the nodes by place, and the height."""
    beam = case.blade
    height = np.sqrt(12.0 * beam.bending_stiffness / beam.axial_stiffness)
    E, rho = beam.axial_stiffness / height**2, beam.mass_per_length / height**2
    places = [(i, j, k) for i in range(2 * n + 1) for j, k in FACE if i % 2 == 0 or j * k]
    node = {place: number for number, place in enumerate(places, start=1)}
    scale = np.array([beam.length / (2 * n), height / 2, height / 2])
    lines = ["*NODE,NSET=ALL"]
    lines += [",".join(f"{x:.12g}" for x in (node[at], *scale * at)) for at in places]
    lines.append("*ELEMENT,TYPE=C3D20R,ELSET=ALL")
    for e in range(n):
        own = [str(node[2 * e + i, j, k]) for i, j, k in BRICK]
        lines += [",".join([str(e + 1), *own[:10], ""]), ",".join(own[10:])]
    lines += ["*MATERIAL,NAME=M", "*ELASTIC", f"{E:.12g},0.", "*DENSITY", f"{rho:.12g}"]
    lines += ["*SOLID SECTION,ELSET=ALL,MATERIAL=M", "*BOUNDARY", "ALL,3,3"]
    return lines, node, height


def printed(lines: list[str]) -> str:
    """Run CalculiX, and return its table of results."""
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "beam.inp").write_text("\n".join(lines) + "\n")
        output_of(["ccx", "beam"], cwd=folder)
        return Path(folder, "beam.dat").read_text()


def history(case: Case, n: int, h: float):
    """Lead the nodes of the clamped face around its middle."""
    lines, node, height = mesh(case, n)
    angle = case.rotation.angle(h * np.arange(round(case.duration / h) + 2))
    for axis, values in ((1, -np.sin(angle)), (2, np.cos(angle) - 1.0)):
        lines.append(f"*AMPLITUDE,NAME=A{axis}")
        lines += [f"{k * h:.10g},{value:.14g}" for k, value in enumerate(values)]
    lines += ["*STEP,NLGEOM,INC=1000000", "*DYNAMIC,DIRECT", f"{h},{case.duration}"]
    for axis in (1, 2):
        lines.append(f"*BOUNDARY,AMPLITUDE=A{axis}")
        lines += [f"{node[0, j, k]},{axis},{axis},{j * height / 2:.12g}" for j, k in FACE]
    lines += ["*NSET,NSET=TIP", str(node[2 * n, 0, 1])]
    lines += [f"*NODE PRINT,NSET=TIP,FREQUENCY={round(SPACING / h)}", "U", "*END STEP"]
    moved = re.findall(r"^ +\d+ +(\S+) +(\S+) +\S+$", printed(lines), re.MULTILINE)
    moves = np.array([(0.0, 0.0), *moved], dtype=float) @ (1.0, 1.0j)
    return across(case, case.blade.length + moves)


def frequency(case: Case, n: int, speed: float) -> float:
    """Ask for the first mode at rest; the real modes in rotation are without Coriolis' force."""
    lines, node, _ = mesh(case, n)
    lines += [f"{node[0, j, k]},1,2" for j, k in FACE]
    lines += ["*STEP", "*FREQUENCY", "1", "*END STEP"]
    return float(re.search(r"^ +1 +\S+ +(\S+)", printed(lines), re.MULTILINE)[1])


if __name__ == "__main__":
    said = subprocess.run(["ccx", "-v"], capture_output=True, text=True, check=False).stdout
    told = Declaration(
        code="CalculiX", version=said.split()[-1], url="http://www.calculix.de", licence="GPL-2.0",
        element="bricks, twenty nodes, reduced integration", order=4.0, order_in_step=2.0,
        theory=Theory(shear=5 / 12, rotary_inertia=True),  # of a square without lateral strain
    )  # fmt: skip
    runs = [(16, 2e-3), (24, 2e-3), (32, 2e-3), (16, 4e-3), (16, 1e-3)]
    take_part(__file__, told, history, {"S1": runs}, frequency, (8, 16, 32, 64), (0.0,))
