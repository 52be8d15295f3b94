"""CalculiX: a strip of plane elements CPS8, eight nodes, with Hilber, Hughes and Taylor's rule."""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1]))
from common import SPACING, across, take_part

from rotbeam_exu.verification.cases import Case
from rotbeam_exu.verification.submission import Declaration


def mesh(case: Case, n: int):
    """Return nodes, elements and material as text, the nodes by place, and the height."""
    beam = case.blade.uniform
    height = np.sqrt(12.0 * beam.bending_stiffness / beam.axial_stiffness)
    E, rho = beam.axial_stiffness / height**2, beam.mass_per_length / height**2
    places = [(i, j) for i in range(2 * n + 1) for j in (-1, 0, 1) if i % 2 == 0 or j]
    node = {place: k + 1 for k, place in enumerate(places)}
    around = ((0, -1), (2, -1), (2, 1), (0, 1), (1, -1), (2, 0), (1, 1), (0, 0))
    lines = ["*NODE,NSET=ALL"]
    lines += [
        f"{node[i, j]},{i * beam.length / (2 * n):.12g},{j * height / 2:.12g}" for i, j in places
    ]
    lines.append("*ELEMENT,TYPE=CPS8,ELSET=ALL")
    lines += [
        ",".join(map(str, [e + 1, *(node[2 * e + i, j] for i, j in around)])) for e in range(n)
    ]
    lines += ["*MATERIAL,NAME=M", "*ELASTIC", f"{E:.12g},0.", "*DENSITY", f"{rho:.12g}"]
    lines += ["*SOLID SECTION,ELSET=ALL,MATERIAL=M", f"{height:.12g}"]
    return lines, node, height


def printed(lines: list[str]) -> str:
    """Run CalculiX, and return its table of results."""
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "strip.inp").write_text("\n".join(lines) + "\n")
        subprocess.run(["ccx", "strip"], cwd=folder, capture_output=True, check=False)
        return Path(folder, "strip.dat").read_text()


def history(case: Case, n: int, h: float):
    """Lead the two outer nodes of the clamped face around the middle one."""
    lines, node, height = mesh(case, n)
    angle = case.rotation.angle(h * np.arange(round(case.duration / h) + 2))
    for name, values in (("X", -np.sin(angle)), ("Y", np.cos(angle) - 1.0)):
        lines.append(f"*AMPLITUDE,NAME={name}")
        lines += [f"{k * h:.10g},{value:.14g}" for k, value in enumerate(values)]
    lines += ["*STEP,NLGEOM,INC=1000000", "*DYNAMIC,DIRECT", f"{h},{case.duration}"]
    lines += ["*BOUNDARY", f"{node[0, 0]},1,2"]
    for j in (-1, 1):
        for axis, name in ((1, "X"), (2, "Y")):
            lines += [
                f"*BOUNDARY,AMPLITUDE={name}",
                f"{node[0, j]},{axis},{axis},{j * height / 2:.12g}",
            ]
    lines += ["*NSET,NSET=TIP", str(node[2 * n, 0])]
    lines += [f"*NODE PRINT,NSET=TIP,FREQUENCY={round(SPACING / h)}", "U", "*END STEP"]
    moved = re.findall(r"^ +\d+ +(\S+) +(\S+) +\S+$", printed(lines), re.MULTILINE)
    if len(moved) < round(case.duration / SPACING):
        raise RuntimeError(f"stops after {len(moved) * SPACING:.3g} s")
    moves = np.array([(0.0, 0.0), *moved], dtype=float) @ (1.0, 1.0j)
    return across(case, case.blade.length + moves)


def frequency(case: Case, n: int, speed: float) -> float:
    """Ask for the first mode at rest; the real modes in rotation are without Coriolis' force."""
    lines, node, _ = mesh(case, n)
    lines += ["*BOUNDARY", *(f"{node[0, j]},1,2" for j in (-1, 0, 1))]
    lines += ["*STEP", "*FREQUENCY", "1", "*END STEP"]
    return float(re.search(r"^ +1 +\S+ +(\S+)", printed(lines), re.MULTILINE)[1])


def release() -> str:
    """Return its version."""
    said = subprocess.run(["ccx", "-v"], capture_output=True, text=True, check=False).stdout
    return said.split()[-1]


if __name__ == "__main__":
    told = Declaration(
        code="CalculiX", version=release(), url="http://www.calculix.de", licence="GPL-2.0",
        element="plane stress, eight nodes", order=4.0, order_in_step=2.0,
    )  # fmt: skip
    runs = [(16, 4e-3), (32, 4e-3), (16, 1e-2), (64, 4e-3), (32, 1e-2), (16, 2e-3)]
    take_part(__file__, told, history, {"S1": runs}, frequency, (16, 32, 64, 128), (0.0,))
