"""What scripts of other codes share: a submission is run, written, judged and recorded.

``python models/codes/common.py NAME`` records a folder whose files came from elsewhere, or what the
judge says anew; it keeps the `calibration` of a record that is there.
"""

from __future__ import annotations

import datetime as dt
import hashlib
import os
import subprocess
import sys
import tempfile
import tomllib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from scipy.interpolate import CubicSpline

from analytic.arrays import ComplexArray, FloatArray
from rotbeam_exu.verification.case_rows import cases_csv
from rotbeam_exu.verification.cases import CASES, Case
from rotbeam_exu.verification.judgement import Judgement, judged
from rotbeam_exu.verification.kit import STATIC
from rotbeam_exu.verification.submission import Declaration
from rotbeam_exu.verification.submission_files import digests, read_submission
from rotbeam_exu.verification.submission_files.entry import entry_text
from rotbeam_exu.verification.verify import Entry

HERE = Path(__file__).parent
SPACING = 0.02
"""Time between the samples of a history [s], the largest that the judge takes."""

REMARK = "Run by the authors of the benchmark, not by the authors of the code."


def times(case: Case) -> FloatArray:
    """Return the times at which histories are written [s]."""
    return SPACING * np.arange(round(case.duration / SPACING) + 1)


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
    """Return q at `times` from a code's own samples, (samples,), a hundred a period or more."""
    return np.asarray(CubicSpline(time, q)(times(case)))


def cpu() -> float:
    """Return the CPU time of this process and of those that it waited for [s]."""
    return sum(os.times()[:4])


def take_part(
    script: str,
    declaration: Declaration,
    history: Callable[[Case, int, float], FloatArray],
    runs: Mapping[str, Sequence[tuple[int, str]]],
    frequency: Callable[[Case, int, float], float] | None = None,
    meshes: Sequence[int] = (),
    speeds: Sequence[float] = CASES["L"].speeds,
) -> None:
    """Write a submission beside a script, and record it. Runs that it has already are kept.

    Parameters
    ----------
    script : str
        Its path.
    declaration : Declaration
    history : callable
        (case, elements, step [s]) -> q [m] at `times`; RuntimeError with one sentence where it
        fails.
    runs : dict
        By name of the case, meshes and steps as their files are named.
    frequency : callable, optional
        (case, elements, speed [rad/s]) -> first natural frequency [rad/s].
    meshes, speeds : sequence
        Of the frequencies.
    """
    folder = Path(script).parent / "submission"
    folder.mkdir(exist_ok=True)
    told = replace(declaration, machine=_machine(), remarks=declaration.remarks or REMARK)
    (folder / "entry.toml").write_text(entry_text(told), encoding="utf-8")
    before = calibration()
    if frequency is not None:
        rows = [
            f"{elements},{speed:g},{frequency(CASES['L'], elements, speed):.12g}\n"
            for elements in meshes
            for speed in speeds
        ]
        (folder / "L.csv").write_text("elements,speed,frequency\n" + "".join(rows))
    table = folder / "runs.csv"
    if not table.exists():
        table.write_text("file,elements,step,cpu_s,failure\n")
    for name, resolutions in runs.items():
        for elements, step in resolutions:
            file = f"{name}/m{elements:03d}_h{step}.csv"
            if f"{file}," not in table.read_text():
                row = _run(folder / file, CASES[name], history, elements, step)
                with table.open("a") as out:
                    out.write(f"{file},{elements},{step},{row}\n")
                print(file, row, flush=True)
    record(folder, 0.5 * (before + calibration()))


def _run(
    path: Path,
    case: Case,
    history: Callable[[Case, int, float], FloatArray],
    elements: int,
    step: str,
) -> str:
    """Write a history, and return CPU time and failure as cells."""
    started = cpu()
    try:
        q = history(case, elements, float(step))
    except RuntimeError as error:
        return f"{cpu() - started:.4g},{error}"
    rows = [f"{t:.6g},{x:.9g}\n" for t, x in zip(times(case), q, strict=True)]
    path.parent.mkdir(exist_ok=True)
    path.write_text("time,q\n" + "".join(rows))
    return f"{cpu() - started:.4g},"


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
            subprocess.run([starter, "S1", "128", "4e-3", "."], cwd=folder, check=True)
            taken.append(cpu() - started)
    return min(taken)


def compiled(source: Path, folder: Path) -> Path:
    """Compile a source in C++, and return the program."""
    program = folder / source.stem
    subprocess.run(["g++", "-O2", "-std=c++17", "-o", program, source], check=True)
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
