"""Exudyn in space: ObjectBeamGeometricallyExact, a tube, as this package sets it up."""

import sys
from dataclasses import replace
from importlib.metadata import version
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))
from common import called, take_part

from analytic import Tube
from rotbeam_exu.fem.elements import SpaceExact
from rotbeam_exu.verification.case import Case
from rotbeam_exu.verification.entries import formulation_entry
from rotbeam_exu.verification.submission import Declaration

ENTRY = formulation_entry(SpaceExact())


def of_tube(case: Case) -> Case:
    """Return the case of a tube, which bends alike in all directions."""
    return replace(case, blade=case.blade.with_shape(Tube()))


def history(case: Case, n: int, h: float):
    """Spin a tube up."""
    return called(ENTRY)(of_tube(case), n, h)


def frequency(case: Case, n: int, speed: float) -> float:
    """Return the first one in the plane about the steady state."""
    return ENTRY.frequencies(of_tube(case), speed, n)[0]


if __name__ == "__main__":
    told = Declaration(
        code="Exudyn, space", version=version("exudyn"), licence="BSD-3-Clause",
        url="https://github.com/jgerstmayr/EXUDYN", theory=ENTRY.theory, order=2.0,
        element="ObjectBeamGeometricallyExact, two nodes", order_in_step=2.0,
    )  # fmt: skip
    runs = [(32, 2e-3), (64, 2e-3), (128, 2e-3), (64, 4e-3), (64, 1e-3)]
    take_part(__file__, told, history, {"S1": runs}, frequency, (32, 64, 128))
