"""The kit's starter in C++ as it stands: a chain of point masses and springs."""

import sys
import tempfile
from functools import cache
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1]))
from common import compiled, output_of, sampled, take_part

from rotbeam_exu.verification.case import Case
from rotbeam_exu.verification.kit import STATIC, write_kit
from rotbeam_exu.verification.submission import Declaration


@cache
def workshop() -> Path:
    """Return a folder with the kit and the program."""
    folder = write_kit(Path(tempfile.mkdtemp(), "kit"))
    compiled(STATIC / "starters/cpp/starter.cpp", folder)
    return folder


def table(case: Case, n: int, step: float, name: str):
    """Run the starter, and return the table that it wrote."""
    output_of(["./starter", case.name, n, step, "."], cwd=workshop())
    return np.loadtxt(workshop() / name, delimiter=",", skiprows=1)


def history(case: Case, n: int, h: float):
    """Start at rest, or on the orbit of the case."""
    time, q, _ = table(case, n, h, f"{case.name}/m{n:03d}_h{h}.csv").T
    return sampled(case, time, q)


@cache
def frequencies(case: Case, n: int) -> dict[float, float]:
    """Return the frequencies of a mesh by speed."""
    rows = table(case, n, 1.0, "L.csv")
    return {speed: found for elements, speed, found in rows if elements == n}


if __name__ == "__main__":
    told = Declaration(
        code="starter in C++", version="1.0", licence="MIT", remarks="A code of the authors.",
        element="point masses, axial and rotational springs; implicit midpoint rule",
        order=2.0, order_in_step=2.0,
    )  # fmt: skip
    plain = [(32, 4e-3), (64, 4e-3), (128, 4e-3), (64, 1e-2), (64, 2e-3)]
    finer = [(64, 2e-3), (128, 2e-3), (256, 2e-3), (128, 4e-3), (128, 1e-3)]
    runs = {"S1": [*plain, (256, 2e-3), (512, 2e-3)], "S2": plain, "O": plain, "S4": finer}
    meshes = (64, 128, 256)
    take_part(__file__, told, history, runs, lambda *of: frequencies(*of[:2])[of[2]], meshes)
