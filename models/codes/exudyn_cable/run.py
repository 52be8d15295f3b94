"""Exudyn in the plane: ObjectANCFCable2D, as this package sets it up."""

import sys
from importlib.metadata import version
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))
from common import called, take_part

from rotbeam_exu.fem.elements import Cable
from rotbeam_exu.verification.case import Case
from rotbeam_exu.verification.entries import formulation_entry
from rotbeam_exu.verification.submission import Declaration

ENTRY = formulation_entry(Cable())
history = called(ENTRY)


def frequency(case: Case, n: int, speed: float) -> float:
    """Return the first one about the steady state."""
    return ENTRY.frequencies(case, speed, n)[0]


if __name__ == "__main__":
    told = Declaration(
        code="Exudyn, plane", version=version("exudyn"), licence="BSD-3-Clause",
        url="https://github.com/jgerstmayr/EXUDYN", element="ObjectANCFCable2D, cubic",
        order=4.0, order_in_step=2.0,
    )  # fmt: skip
    plain = [(8, 2e-3), (16, 2e-3), (32, 2e-3), (16, 4e-3), (16, 1e-3)]
    finer = [(16, 1e-3), (32, 1e-3), (64, 1e-3), (32, 2e-3), (32, 5e-4)]
    runs = {"S1": [*plain, (8, 4e-3)], "S2": plain, "O": plain, "S4": finer}
    take_part(__file__, told, history, runs, frequency, (8, 16, 32))
