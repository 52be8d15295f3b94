"""Typeset the kit's problem statement, PROBLEM.pdf, by typst: part of `make references`."""

from __future__ import annotations

import hashlib
import json
from pathlib import Path
from typing import Any

import numpy as np

from analytic import Beam
from rotbeam_exu.verification.case import Case, Level
from rotbeam_exu.verification.cases import CASES, VERSION
from rotbeam_exu.verification.judgement import THRESHOLDS
from rotbeam_exu.verification.kit import STATIC, row_of
from rotbeam_exu.verification.references import reference
from rotbeam_exu.verification.submission_files.runs import FARTHEST
from rotbeam_exu.verification.submission_files.tables import DIGITS

SOURCE, PDF = Path(__file__).with_name("problem.typ"), STATIC / "PROBLEM.pdf"
DRAWING = SOURCE.parents[1] / "docs" / "images" / "section.svg"
DIGEST = Path(__file__).with_name("PROBLEM.sha256")
"""SHA-256 of the source and the numbers that the PDF was made from."""

BESIDES = {
    "twist": "twist $theta = {}$",
    "precone": "precone $beta = {}$",
    "tip_mass": "mass at the tip {} kg",
    "bending_damping": "moment $E I (phi' + eta dot(phi)')$,\\ $eta = {}$ s",
    "gravity": "gravity $g = {}$ m/s²",
    "gravity_tilt": "along $-bold(b)_3$",
    "kick": "kick $v = {}$ m/s",
}
"""Words in the problem's table, in Typst's markup, on numbers of cases.csv that few cases have."""


def problem_numbers() -> str:
    """Return the numbers for the problem's source as JSON: cases, thresholds, S1."""
    case, beam = CASES["S1"], Beam.reference()
    material = beam.youngs_modulus, beam.density, beam.area, beam.second_moment
    times = np.linspace(0.0, case.duration, 601)
    document = {
        "version": VERSION,
        "cases": [row_of(case) | {"besides": _besides(case)} for case in CASES.values()],
        "material": dict(zip(("E", "rho", "A", "I"), material, strict=True)),
        "thresholds": {name: f"{value:g}" for name, value in THRESHOLDS.items()},
        "farthest": FARTHEST,
        "digits": DIGITS,
        "history": np.round(reference(case).history(times) / case.blade.length, 4).tolist(),
        "space": _looked_at(),
    }
    return json.dumps(document)


def _looked_at() -> list[dict[str, Any]]:
    """Return numbers of the cases in space, to look at before the first judgement."""
    found: list[dict[str, Any]] = []
    for case in CASES.values():
        if not case.in_space:
            continue
        truth = reference(case)
        at = case.speeds[-1:] or (5.0, case.duration)
        at_text = "{:g} rad/s" if case.speeds else "$t$ = {:g} s"
        rows = [truth.row(x) if case.speeds else truth.history(x) for x in at]
        found += [
            {
                "id": case.name,
                "at": at_text.format(x),
                "real": case.level is Level.REAL,
                "row": [f"{v:.4g}" for v in row.tolist()],
            }
            for x, row in zip(at, rows, strict=True)
        ]
    return found


def _besides(case: Case) -> list[str]:
    """Return the problem's text on a case beside its beam and motion, in Typst's markup."""
    row = row_of(case)
    listed = {"$omega$: {} rad/s": case.speeds, "$a$: {}": case.amplitudes}
    said = [text.format(", ".join(f"{x:g}" for x in of)) for text, of in listed.items() if of]
    said += [text.format(f"{row[name]:.8g}") for name, text in BESIDES.items() if row[name]]
    return [*said, "starts on an orbit"] if case.motion and not case.is_spun_up else said


def problem_digest() -> str:
    """Return the SHA-256 of the present source, drawing and numbers of the problem."""
    made_of = SOURCE.read_bytes() + DRAWING.read_bytes() + problem_numbers().encode()
    return hashlib.sha256(made_of).hexdigest()


def typeset(**options: Any) -> Any:
    """Return the problem as the bytes of a PDF, or what `options` of typst.compile ask for."""
    import typst

    root, numbers = str(SOURCE.parents[1]), {"data": problem_numbers()}
    return typst.compile(str(SOURCE), root=root, sys_inputs=numbers, **options)


if __name__ == "__main__":
    PDF.write_bytes(typeset())
    DIGEST.write_text(problem_digest() + "\n", encoding="utf-8")
