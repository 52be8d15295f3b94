"""A rod of ours in C++, written from the kit's PROBLEM.pdf: rod.cpp tells how it is called."""

import sys
import tempfile
from functools import cache
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1]))
from common import SPACING, compiled, output_of, take_part

from rotbeam_exu.verification.case import Case
from rotbeam_exu.verification.kit import row_of
from rotbeam_exu.verification.submission import Declaration

NUMBERS = (
    "L", "EA", "EI", "rhoA", "hub_radius", "tip_mass", "bending_damping", "gravity", "omega", "T",
)  # fmt: skip


@cache
def program() -> Path:
    """Compile it once."""
    return compiled(Path(__file__).with_name("rod.cpp"), Path(tempfile.mkdtemp()))


def rod(case: Case, n: int, *words: object, speed: float | None = None, start: str = ""):
    """Call it, and return the numbers that it prints."""
    row = row_of(case) | ({} if speed is None else {"omega": speed})
    numbers = [row[name] or 0.0 for name in NUMBERS]
    return np.array(output_of([program(), *numbers, n, *words], input=start).split(), dtype=float)


def history(case: Case, n: int, h: float):
    """Start at rest, or on the orbit of the case."""
    start = ""
    if not case.is_spun_up:
        x = np.linspace(0.0, case.blade.length, n + 1)
        s = case.orbit.state(0, x)
        parts = [of[:, :2] for of in (s.place, s.slope, s.velocity, s.slope_rate)]
        start = "\n".join(map(str, np.hstack(parts).ravel().tolist()))
    of = "orbit" if start else "history"
    return rod(case, n, of, h, round(SPACING / h), round(case.duration / h), start=start)


def frequency(case: Case, n: int, speed: float) -> float:
    """Return the first one at a speed."""
    return rod(case, n, "frequency", speed=speed)[0]


if __name__ == "__main__":
    told = Declaration(
        code="Hermite rod in C++", version="1.0", licence="MIT", remarks="A code of the authors.",
        element="cubic, r and r' at two nodes; implicit midpoint rule",
        order=4.0, order_in_step=2.0,
    )  # fmt: skip
    plain = [(8, 2e-3), (16, 2e-3), (32, 2e-3), (16, 4e-3), (16, 1e-3)]
    finer = [(16, 1e-3), (32, 1e-3), (64, 1e-3), (32, 2e-3), (32, 5e-4)]
    runs = {"S1": plain, "S2": plain, "O": plain, "S4": finer}
    take_part(__file__, told, history, runs, frequency, (8, 16, 32))
