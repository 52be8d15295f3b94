"""PROBLEM.pdf, typeset anew by `python -m rotbeam_exu.verification.problem_statement`.

Needs the package typst: the group `kit`, which `make references` installs.
"""

from __future__ import annotations

import hashlib
import json
from typing import Any

import numpy as np

from .cases import CASES, VERSION
from .judgement import THRESHOLDS
from .kit import STATIC, row_of
from .references import reference
from .submission_files.histories import FARTHEST
from .submission_files.tables import DIGITS

SOURCE = STATIC / "problem.typ"
PDF = STATIC / "PROBLEM.pdf"
DIGEST = STATIC / "PROBLEM.sha256"
"""Of what the PDF was made from: the source, and the numbers in it."""


def numbers() -> str:
    """Return what the source takes from the package, as JSON: cases, thresholds, the format, S1."""
    case = CASES["S1"]
    times = np.linspace(0.0, case.duration, 601)
    document = {
        "version": VERSION,
        "cases": [row_of(case) for case in CASES.values()],
        "thresholds": {name: f"{value:g}" for name, value in THRESHOLDS.items()},
        "farthest": FARTHEST,
        "digits": DIGITS,
        "history": np.round(reference(case).history(times) / case.blade.length, 4).tolist(),
    }
    return json.dumps(document)


def digest() -> str:
    """Return the SHA-256 of the present source and numbers."""
    return hashlib.sha256(SOURCE.read_bytes() + numbers().encode()).hexdigest()


def typeset(**options: Any) -> Any:
    """Return the document as the bytes of a PDF, or what `options` of typst.compile ask for."""
    import typst  # noqa: PLC0415

    return typst.compile(str(SOURCE), sys_inputs={"data": numbers()}, **options)


def main() -> None:
    """Write the PDF and the digest of what it was made from."""
    PDF.write_bytes(typeset())
    DIGEST.write_text(digest() + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
