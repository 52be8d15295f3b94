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
        From files, or of a code that was called, as `handed_in` returns it.
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


def _write(path: Path, columns: Iterable[Column], things: Sequence[object]) -> None:
    """Write a table of the attributes of things, if there are any."""
    if not things:
        return
    held = [column for column in columns if hasattr(things[0], column.field)]
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(column.name for column in held)
    writer.writerows([_cell(getattr(one, column.field)) for column in held] for one in things)
    path.write_text(text.getvalue(), encoding="utf-8", newline="\n")


def _write_history(run: Run, path: Path) -> None:
    """Write 17 digits of each number, which are enough in any spacing of the samples."""
    held = [column for column in histories.COLUMNS if getattr(run, column.field) is not None]
    numbers = np.column_stack([getattr(run, column.field) for column in held])
    path.parent.mkdir(exist_ok=True)
    with path.open("w", encoding="utf-8", newline="\n") as file:
        header = ",".join(column.name for column in held)
        np.savetxt(file, numbers, fmt="%.17g", delimiter=",", header=header, comments="")


def _cell(cell: object) -> str:
    """Return a cell, empty of what is not known; a sentence has one line."""
    if cell is None or (isinstance(cell, float) and math.isnan(cell)):
        return ""
    if isinstance(cell, str):
        return " ".join(cell.split())
    return repr(cell.item() if isinstance(cell, np.generic) else cell)
