"""Writing a submission, so that it reads back the same to the last bit."""

from __future__ import annotations

import csv
import io
import math
import os
from collections.abc import Iterable, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from ...files.results import writable_folder
from ..cases import CASES, Asked
from ..submission import Run, Submission
from . import entry, histories, runs
from .points import columns_of, tables_of
from .tables import Column


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
    for table, case in tables_of(CASES).items():
        one = case.asked is Asked.FREQUENCIES
        points = submission.frequencies if one else submission.backbone
        _write(root / table, columns_of(case), points)
    named = [replace(run, file=file) for run, file in zip(submission.runs, files, strict=True)]
    _write(root / runs.FILE, runs.columns_of(CASES), named)
    for run in named:
        if not run.failure:
            _write_history(run, root / run.file)
    return root


def _write(path: Path, columns: Iterable[Column], rows: Sequence[object]) -> None:
    """Write a table unless it is empty; what is not known is an empty cell."""
    if not rows:
        return
    held = [column for column in columns if hasattr(rows[0], column.field)]
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(column.name for column in held)
    writer.writerows([_cell(getattr(row, column.field)) for column in held] for row in rows)
    path.write_text(text.getvalue(), encoding="utf-8", newline="\n")


def _cell(cell: object) -> str:
    if cell is None or (isinstance(cell, float) and math.isnan(cell)):
        return ""
    if isinstance(cell, str):  # a sentence has one line
        return " ".join(cell.split())
    return repr(cell.item() if isinstance(cell, np.generic) else cell)


def _write_history(run: Run, path: Path) -> None:
    told = {column.name: getattr(run, column.field) for column in histories.COLUMNS}
    columns = {name: values for name, values in told.items() if values is not None}
    path.parent.mkdir(exist_ok=True)
    with path.open("w", encoding="utf-8", newline="\n") as file:
        numbers = np.column_stack(list(columns.values()))
        np.savetxt(file, numbers, fmt="%.17g", delimiter=",", header=",".join(columns), comments="")
