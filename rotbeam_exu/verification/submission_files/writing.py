"""Writing a submission, so that it reads back the same to the last bit."""

from __future__ import annotations

import csv
import io
import math
import os
from collections.abc import Iterable, Sequence
from pathlib import Path

import numpy as np

from ...files.results import writable_folder
from ..submission import Run, Submission
from . import entry, runs


def write_submission(submission: Submission, folder: str | os.PathLike[str]) -> Path:
    """Write the files of a submission, as `read_submission` takes them, and return the folder.

    Parameters
    ----------
    submission : Submission
        From files, or of a code that was called, as `measures.handed_in` returns it.
    folder : path
        New, or without a submission.

    Raises
    ------
    FileExistsError
        If there is a submission.
    ValueError
        If two runs have the same case, mesh and step.

    Examples
    --------
    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> from rotbeam_exu.verification.submission import Declaration, Frequency, Submission
    >>> from rotbeam_exu.verification.submission_files.writing import write_submission
    >>> mine = Frequency(elements=8, speed=6.0, frequency=3.731123456)
    >>> submission = Submission(declaration=Declaration(code="mine"), frequencies=(mine,))
    >>> with TemporaryDirectory() as folder:
    ...     written = write_submission(submission, Path(folder, "mine"))
    ...     print(sorted(path.name for path in written.iterdir()))
    ['L.csv', 'entry.toml']
    """
    root = writable_folder(folder)
    if (root / entry.FILE).exists():
        raise FileExistsError(f"{root} holds a submission already: choose another folder")
    files = [runs.file_of(run.case, run.elements, run.step) for run in submission.runs]
    twice = sorted({file for file in files if files.count(file) > 1})
    if twice:
        raise ValueError(f"two runs would be {twice[0]}: keep one of each case, mesh and step")
    text = entry.entry_text(submission.declaration)
    (root / entry.FILE).write_text(text, encoding="utf-8", newline="\n")
    if submission.frequencies:
        header = ("elements", "speed", "frequency", "failure")
        rows = [(f.elements, f.speed, f.frequency, f.failure) for f in submission.frequencies]
        _write(root / "L.csv", header, rows)
    if submission.backbone:
        header = ("elements", "speed", "amplitude", "frequency")
        points = [(p.elements, p.speed, p.amplitude, p.frequency) for p in submission.backbone]
        _write(root / "B.csv", header, points)
    if submission.runs:
        listed = list(map(_row, submission.runs, files))
        _write(root / runs.FILE, (*runs.REQUIRED, *runs.OPTIONAL), listed)
    for run, file in zip(submission.runs, files, strict=True):
        if not run.failure:
            _write_history(run, root / file)
    return root


def _row(run: Run, file: str) -> tuple[object, ...]:
    cost = (run.dof, run.wall, run.cpu)
    return (file, run.elements, run.step, *cost, run.failure, run.remark)


def _write(path: Path, header: Sequence[str], rows: Iterable[Sequence[object]]) -> None:
    """Write a table; what is not known is an empty cell, a sentence has one line."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(header)
    writer.writerows([_cell(cell) for cell in row] for row in rows)
    path.write_text(text.getvalue(), encoding="utf-8", newline="\n")


def _cell(cell: object) -> str:
    if cell is None or (isinstance(cell, float) and math.isnan(cell)):
        return ""
    if isinstance(cell, str):
        return " ".join(cell.split())
    return repr(cell.item() if isinstance(cell, np.generic) else cell)


def _write_history(run: Run, path: Path) -> None:
    columns = {"time": run.time, "q": run.q}
    if run.q_dot is not None:
        columns["q_dot"] = run.q_dot
    path.parent.mkdir(exist_ok=True)
    with path.open("w", encoding="utf-8", newline="\n") as file:
        numbers = np.column_stack(list(columns.values()))
        np.savetxt(file, numbers, fmt="%.17g", delimiter=",", header=",".join(columns), comments="")
