"""The kit: all that an author of a code needs to take part, in any language, as plain files.

Its problem statement, PROBLEM.pdf, is typeset anew by `python -m rotbeam_exu.verification.kit`,
which needs the package typst: the group `kit`, which `make references` installs.
"""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from analytic import Beam
from analytic.arrays import FloatArray
from analytic.input_checks import finite_array

from ..files.results import whole_folder
from .case_rows import COLUMNS, cases_csv, row_of
from .cases import CASES, VERSION, Asked, Case
from .judgement import THRESHOLDS
from .references import reference
from .submission_files.runs import FARTHEST
from .submission_files.tables import DIGITS

STATIC = Path(__file__).parent / "data" / "kit"
"""Files that every kit has as they stand: the problem, starters, a sample submission."""

SOURCE, PDF = STATIC / "problem.typ", STATIC / "PROBLEM.pdf"
DIGEST = STATIC / "PROBLEM.sha256"
"""SHA-256 of the source and the numbers that the PDF was made from."""


MESHES = (8, 16, 32, 64, 128)
"""Numbers of elements at whose nodes an orbit is written; codes of order two need the last ones."""

_SOURCES = {SOURCE.name, DIGEST.name}  # of the PDF, which is what an author wants

SPACING = 0.01
"""Time between the samples of drives and of the history for self-check [s]."""


def write_kit(folder: str | os.PathLike[str]) -> Path:
    """Write the kit, whole or not at all, and return the folder.

    Parameters
    ----------
    folder : path
        New, or empty.

    Raises
    ------
    FileExistsError
        If something is in the folder, or it is a file.
    OSError
        If it cannot be written.
    """
    target = Path(folder)
    if target.exists() and not (target.is_dir() and not any(target.iterdir())):
        what = "is not empty" if target.is_dir() else "is a file"
        raise FileExistsError(f"{target} {what}: name a folder that is new, or empty")
    contents = kit_files()
    with whole_folder(target) as made:
        for name, content in contents.items():
            path = made / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)
    return target


def kit_files() -> dict[str, bytes]:
    """Return the contents of all files by their names below the folder."""
    files = {
        path.relative_to(STATIC).as_posix(): path.read_bytes()
        for path in sorted(STATIC.rglob("*"))
        if path.is_file() and path.suffix != ".pyc" and path.name not in _SOURCES
    }
    histories = [case for case in CASES.values() if case.asked is Asked.HISTORY]
    texts = {"VERSION": f"{VERSION}\n", "cases.csv": cases_csv(), "cases.json": _cases_json()}
    texts |= {f"drive_{case.name}.csv": _drive(case) for case in histories}
    texts |= {
        f"start_{case.name}_{elements}.csv": start_table(
            case, np.linspace(0.0, case.blade.length, elements + 1)
        )
        for case in histories
        if case.amplitudes
        for elements in MESHES
    }
    texts["reference_S1.csv"] = _self_check(CASES["S1"])
    files |= {name: text.encode() for name, text in texts.items()}
    sums = [f"{hashlib.sha256(files[name]).hexdigest()}  {name}\n" for name in sorted(files)]
    return files | {"SHA256SUMS": "".join(sums).encode()}


def _cases_json() -> str:
    units = {one.name: one.unit for one in COLUMNS.values()}
    document = {
        "benchmark": VERSION,
        "units": units | {"duration": "s", "speeds": "rad/s", "amplitudes": "1"},
        "cases": [row_of(case) | {"title": case.title} for case in CASES.values()],
        "thresholds": THRESHOLDS,
        "samples": {"largest distance [s]": FARTHEST, "significant digits": DIGITS},
    }
    return json.dumps(document, indent=1, ensure_ascii=False) + "\n"


def _drive(case: Case) -> str:
    """Return angle, rate and acceleration of the clamp."""
    time, motion = _times(case), case.rotation
    columns = {
        "t": time,
        "theta": motion.angle(time),
        "theta_dot": motion.rate(time),
        "theta_ddot": motion.acceleration(time),
    }
    said = f"case {case.name}: motion of the clamp, Eq. 1 of PROBLEM.pdf; s, rad, rad/s, rad/s^2"
    return _table(said, columns)


def start_table(case: Case, places: ArrayLike) -> str:
    """Return the orbit that a case starts on, at phase 0, as a table in SI units and radians.

    Its rows are at places (rows,) along the undeformed beam [m], seen from the turning frame;
    ValueError for places beyond the beam, and for cases that start at rest.
    """
    orbit, x = case.orbit, finite_array("places", places)
    state = orbit.state(0, x)
    slope = 1.0 + state.u_slope + 1j * state.v_slope
    slope_dot = state.u_slope_dot + 1j * state.v_slope_dot
    positions = {"x": x, "X": x + state.u, "Y": state.v, "angle": np.angle(slope)}
    rates = {"X_dot": state.u_dot, "Y_dot": state.v_dot, "angle_dot": (slope_dot / slope).imag}
    slopes = {"X_slope": slope.real, "Y_slope": slope.imag}
    slope_rates = {"X_slope_dot": slope_dot.real, "Y_slope_dot": slope_dot.imag}
    said = (
        f"case {case.name}: {x.size} places at t = 0, in the frame that turns with the clamp, as "
        f"are all rates; m, rad, m/s, rad/s; slopes are derivatives to x"
    )
    return _table(said, positions | slopes | rates | slope_rates)


def _self_check(case: Case) -> str:
    time, truth = _times(case), reference(case)
    said = f"case {case.name}: the reference, within {truth.bound:.0e} of max|q|; s, m, m/s"
    return _table(said, {"time": time, "q": truth.history(time), "q_dot": truth.rate(time)})


def _times(case: Case) -> FloatArray:
    return np.linspace(0.0, case.duration, round(case.duration / SPACING) + 1)


def _table(said: str, columns: dict[str, FloatArray]) -> str:
    """Return comma-separated values with 17 digits."""
    rows: Sequence[Sequence[float]] = np.column_stack(list(columns.values())).tolist()
    lines = [",".join(f"{value:.17g}" for value in row) for row in rows]
    return "\n".join([f"# {said}", ",".join(columns), *lines, ""])


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
        at = case.speeds[-1:] or (5.0, 15.0)
        at_text = "{:g} rad/s" if case.speeds else "$t$ = {:g} s"
        rows = [truth.row(x) if case.speeds else truth.history(x) for x in at]
        found += [
            {"id": case.name, "at": at_text.format(x), "row": [f"{v:.4g}" for v in row.tolist()]}
            for x, row in zip(at, rows, strict=True)
        ]
    return found


def _besides(case: Case) -> list[str]:
    """Return the problem's text on a case beside its beam and motion, in Typst's markup."""
    row = row_of(case)
    listed = {"$omega$: {} rad/s": case.speeds, "$a$: {}": case.amplitudes}
    said = [text.format(", ".join(f"{x:g}" for x in of)) for text, of in listed.items() if of]
    told = {one.name: one for one in COLUMNS.values() if one.besides and row[one.name]}
    said += [one.besides.format(f"{row[name]:.8g}") for name, one in told.items()]
    return [*said, "starts on an orbit"] if case.motion and not case.is_spun_up else said


def problem_digest() -> str:
    """Return the SHA-256 of the present source and numbers of the problem."""
    return hashlib.sha256(SOURCE.read_bytes() + problem_numbers().encode()).hexdigest()


def typeset(**options: Any) -> Any:
    """Return the problem as the bytes of a PDF, or what `options` of typst.compile ask for."""
    import typst  # noqa: PLC0415

    return typst.compile(str(SOURCE), sys_inputs={"data": problem_numbers()}, **options)


if __name__ == "__main__":
    PDF.write_bytes(typeset())
    DIGEST.write_text(problem_digest() + "\n", encoding="utf-8")
