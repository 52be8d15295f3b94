"""Common part of the scripts of other codes: run, write, judge and record a submission.

``python models/codes/common.py NAME`` records a folder whose files came from elsewhere, or what the
judge says anew; it keeps the `calibration` of a record that is there.
"""

from __future__ import annotations

import datetime as dt
import hashlib
import os
import shutil
import subprocess
import sys
import tempfile
import tomllib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.spatial.transform import Rotation

from analytic import Blade
from analytic.arrays import ComplexArray, FloatArray
from rotbeam_exu.verification.case import Asked, Case
from rotbeam_exu.verification.cases import CASES
from rotbeam_exu.verification.judgement import Judgement, judged
from rotbeam_exu.verification.kit import STATIC, cases_csv
from rotbeam_exu.verification.submission import Declaration, Row, Run, Submission
from rotbeam_exu.verification.submission_files import (
    digests,
    read_submission,
    write_submission,
)
from rotbeam_exu.verification.verify import Entry

HERE = Path(__file__).parent
SPACING = 0.02
"""Time between the samples of a history [s], the largest that the judge takes."""

REMARK = "Run by the authors of the benchmark, not by the authors of the code."


def times(case: Case) -> FloatArray:
    """Return the times at which histories are written [s]."""
    return np.arange(round(case.duration / SPACING) + 1) / round(1.0 / SPACING)


def across(case: Case, tip: Sequence[complex] | ComplexArray) -> FloatArray:
    """Return q of Eq. 16 from places X + iY of the tip, (samples,), that do not turn [m]."""
    return np.asarray((np.array(tip) * np.exp(-1j * case.rotation.angle(times(case)))).imag)


def called(entry: Entry) -> Callable[[Case, int, float], FloatArray]:
    """Return the history of a code that this package can call, as `take_part` wants it."""

    def history(case: Case, elements: int, step: float) -> FloatArray:
        run = entry.simulate(case, elements=elements, step=step)
        return sampled(case, run["time"].to_numpy(), run["q"].to_numpy())

    return history


def sampled(case: Case, time: FloatArray, q: FloatArray) -> FloatArray:
    """Return q at `times` from a code's own samples, (samples, ...), a hundred a period or more."""
    return np.asarray(CubicSpline(time, q)(times(case)))


def bends_in_space(blade: Blade) -> tuple[float, float, float]:
    """Return EI of flap and GJ [N m²], and the tip's twist [rad]; a beam of the plane is round."""
    out, EI = blade.section.out_of_plane, blade.bending_stiffness
    if out is None:
        return EI, EI, 0.0
    return out.bending_ratio * EI, out.torsion_ratio * EI, float(np.ravel(blade.line.twist)[-1])


def root_axes(blade: Blade) -> FloatArray:
    """Return the axes of the root, in columns, where z is the axis of rotation and x radial."""
    cosine, sine = np.cos(blade.line.precone), np.sin(blade.line.precone)
    return np.array([[cosine, 0.0, -sine], [0.0, 1.0, 0.0], [sine, 0.0, cosine]])


def rows_of(
    numbers: Callable[[Case, int, float], Sequence[float]],
    meshes: Sequence[int],
    speeds: Mapping[str, Sequence[float]],
) -> list[Row]:
    """Return the rows of tables in space: (case, elements, speed [rad/s]) -> their values."""
    made = []
    for name, several in speeds.items():
        case = CASES[name]
        for speed in several:
            for elements in meshes:
                found = numbers(case, elements, speed)
                print(name, speed, elements, found, flush=True)
                row = Row(case=name, elements=elements, speed=speed, values=tuple(found))
                if case.asked is Asked.STEADY or case.count == 1:
                    made.append(row)
                else:
                    made += [
                        replace(row, number=k, values=(one,)) for k, one in enumerate(found, 1)
                    ]
    return made


def twist_of(turns: Rotation) -> FloatArray:
    """Return the turn of a section about its normal, x, of rotations (samples,) [rad]."""
    matrices = turns.as_matrix()
    return np.asarray(np.arctan2(matrices[:, 2, 1], matrices[:, 2, 2]))


def cpu() -> float:
    """Return the CPU time of this process and of those that it waited for [s]."""
    return sum(os.times()[:4])


def output_of(call: Sequence[object], **options: Any) -> str:
    """Run a program, and return what it prints; RuntimeError with its own sentence if it fails."""
    words = [str(word) for word in call]
    done = subprocess.run(words, capture_output=True, text=True, check=False, **options)
    if done.returncode:
        said = done.stderr.strip() or " ".join(done.stdout[-200:].split())
        raise RuntimeError(said or f"{words[0]} fails")
    return done.stdout


def take_part(
    script: str,
    declaration: Declaration,
    history: Callable[[Case, int, float], FloatArray] | None = None,
    runs: Mapping[str, Sequence[tuple[int, float]]] | None = None,
    frequency: Callable[[Case, int, float], float] | None = None,
    meshes: Sequence[int] = (),
    speeds: Sequence[float] = CASES["L"].speeds,
    rows: Sequence[Row] = (),
) -> None:
    """Run a code, write its submission in place of the one beside a script, and record it.

    Nothing is written before all has been computed.

    Parameters
    ----------
    script : str
        Its path.
    declaration : Declaration
    history : callable, optional
        (case, elements, step [s]) -> q [m] at `times`, or the columns of a case in space;
        RuntimeError with one sentence where it fails.
    runs : dict, optional
        Meshes and steps [s] by name of the case.
    frequency : callable, optional
        (case, elements, speed [rad/s]) -> first natural frequency [rad/s].
    meshes, speeds : sequence
        Of the frequencies.
    rows : sequence of Row
        Of other tables, as they are.
    """
    before = calibration()
    made = Submission(
        declaration=replace(
            declaration, machine=_machine(), remarks=declaration.remarks or REMARK
        ),
        rows=tuple(
            Row(elements=n, speed=speed, values=(float(frequency(CASES["L"], n, speed)),))
            for n in meshes
            for speed in speeds
        ) if frequency else tuple(rows),
        runs=tuple(
            _run(history, CASES[name], elements, step)
            for name, resolutions in (runs or {}).items()
            if history
            for elements, step in resolutions
        ),
    )  # fmt: skip
    unit = 0.5 * (before + calibration())
    folder = Path(script).parent / "submission"
    new = write_submission(made, folder.with_name("new"))
    shutil.rmtree(folder, ignore_errors=True)
    record(new.rename(folder), unit)


def _run(
    history: Callable[[Case, int, float], FloatArray], case: Case, elements: int, step: float
) -> Run:
    """Compute a history and its CPU time; a failure keeps its sentence."""
    q, failure, started = np.empty(0), "", cpu()
    try:
        q = history(case, elements, step)
    except RuntimeError as error:
        failure = str(error)
    run = Run(
        case=case.name, elements=elements, step=step, time=times(case) if q.size else q,
        q=np.vectorize(_short, otypes=[float])(q) if q.size else q, failure=failure,
        cpu=float(f"{cpu() - started:.4g}"),
    )  # fmt: skip
    print(run, flush=True)
    return run


def _short(value: float) -> float:
    """Return a number of nine digits, which are enough and keep files small."""
    return float(f"{value:.9g}")


def record(folder: Path, seconds: float) -> None:
    """Write record.toml beside a submission: its outcomes, their files, and `calibration` [s]."""
    found, today = judged(read_submission(folder)), dt.date.today()
    lines = [
        f"date = {today}", f"calibration_s = {seconds:.3g}", f'digest = "{digest(folder)}"', "",
        "[outcomes]",
        *(f'"{name}" = "{outcome}"' for name, outcome in outcomes(found).items()),
    ]  # fmt: skip
    (folder.parent / "record.toml").write_text("\n".join(lines) + "\n")
    print(found)


def outcomes(found: Judgement) -> dict[str, str]:
    """Return the outcome of each quantity, by case and quantity."""
    return {" ".join(of): str(one.outcome) for of, one in found.by_quantity.items()}


def digest(folder: Path) -> str:
    """Return the SHA-256 of the files of a submission that are judged."""
    files = digests(folder, read_submission(folder))
    return hashlib.sha256(repr(sorted(files.items())).encode()).hexdigest()


def calibration() -> float:
    """Return the CPU time of the kit's starter in C++ [s]: S1, 128 elements at 4 ms, best of 3."""
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "cases.csv").write_text(cases_csv())
        starter = compiled(STATIC / "starters/cpp/starter.cpp", Path(folder))
        taken = []
        for _ in range(3):
            started = cpu()
            output_of([starter, "S1", 128, "4e-3", "."], cwd=folder)
            taken.append(cpu() - started)
    return min(taken)


def compiled(source: Path, folder: Path) -> Path:
    """Compile a source in C++, and return the program."""
    program = folder / source.stem
    output_of(["g++", "-O2", "-std=c++17", "-o", program, source])
    return program


def _machine() -> str:
    """Return the name of the processor."""
    told = Path("/proc/cpuinfo")
    lines = told.read_text().splitlines() if told.exists() else []
    names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return f"one core of {names[0] if names else 'this machine'}"


if __name__ == "__main__":
    for name in sys.argv[1:]:
        made = HERE / name / "record.toml"
        unit = tomllib.loads(made.read_text())["calibration_s"] if made.exists() else calibration()
        record(HERE / name / "submission", unit)
