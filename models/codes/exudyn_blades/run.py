"""Exudyn on real blades: ObjectBeamGeometricallyExact, a table as this package gives it."""

import sys
from dataclasses import replace
from importlib.metadata import version
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))
from common import take_part

from rotbeam_exu.fem.elements import SpaceExact
from rotbeam_exu.verification.cases import CASES
from rotbeam_exu.verification.entries import formulation_entry
from rotbeam_exu.verification.submission import Declaration
from rotbeam_exu.verification.verify import submission_of

ENTRY = replace(formulation_entry(SpaceExact()), meshes=(64, 128, 256))

if __name__ == "__main__":
    declaration = Declaration(
        code="Exudyn, real blades", version=version("exudyn"), licence="BSD-3-Clause",
        url="https://github.com/jgerstmayr/EXUDYN", theory=ENTRY.theory, order=2.0,
        element="ObjectBeamGeometricallyExact, two nodes",
    )  # fmt: skip
    cases = [CASES[name] for name in ("F+N", "G+N", "F+I", "G+I")]
    take_part(__file__, declaration, rows=submission_of(ENTRY, cases).rows)
