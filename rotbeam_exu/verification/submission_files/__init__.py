"""The folder of a submission: entry.toml, L.csv, B.csv, runs.csv and the histories, both ways."""

from __future__ import annotations

import hashlib
import io
import math
import os
import re
from collections.abc import Collection, Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

import numpy as np

from ...files.results import whole_file
from ..case import Asked, Case
from ..cases import CASES
from ..history import FREE_FOR, free_frequency
from ..submission import Row, Submission
from . import entry, runs, tables
from .faults import OUTSIDE, Folder, MalformedSubmissionError, near, printable

_TABLES = {f"{name}.csv": case for name, case in CASES.items() if case.asked is not Asked.HISTORY}
_VIBRATION = re.compile(r"m([0-9]{1,9})_w([0-9.]{1,9})\.csv")
"""Name of a free vibration's file: elements, and speed [rad/s]."""


def read_submission(folder: str | os.PathLike[str], *, only: Collection[str] = ()) -> Submission:
    r"""Read what an author hands in.

    Parameters
    ----------
    folder : path
        With entry.toml and a table as L.csv, a free vibration as L/m032_w6.csv, or runs.csv, which
        lists the histories.
    only : collection of str, optional
        Names of the cases whose histories are read, all by default. Histories are most of the work.

    Returns
    -------
    Submission
        Histories end with their case; later samples are left out.

    Raises
    ------
    MalformedSubmissionError
        With all faults of all files, and what is right besides.
    FileNotFoundError
        If there is no such folder.

    Examples
    --------
    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> from rotbeam_exu.verification.submission_files import read_submission
    >>> with TemporaryDirectory() as folder:
    ...     _ = Path(folder, "entry.toml").write_text('benchmark = "1.1"\ncode = "mine"')
    ...     _ = Path(folder, "L.csv").write_text("elements,speed,frequency\n8,6.0,3.731123456")
    ...     print(read_submission(folder).rows[0].values)
    (3.731123456,)
    """
    files = Folder(folder)
    if not files.root.is_dir():
        raise FileNotFoundError(f"there is no folder {files.root}: name that of the submission")
    declaration = entry.declaration_of(files)
    rows: list[Row] = []
    for file, case in _TABLES.items():
        if os.path.lexists(files.root / file):
            rows += rows_in(files, file, case)
    for file, case in _vibrations(files):
        rows += _vibration(files, file, case, rows)
    histories = runs.runs_of(files, only)
    _find_strangers(files)
    if not (files.faults or rows or histories):
        said = "there is nothing to judge: hand in L.csv, B.csv, or histories with runs.csv"
        files.add(entry.FILE, said)
    if declaration is None:
        raise MalformedSubmissionError(files.faults)
    made = Submission(declaration=declaration, rows=tuple(rows), runs=histories)
    if files.faults:
        raise MalformedSubmissionError(files.faults, made if rows or histories else None)
    return made


def rows_in(folder: Folder, file: str, case: Case) -> list[Row]:
    """Return the rows of a case's table; its faults are kept in the folder."""
    columns = tables.columns_of(case)
    measured: dict[str, list[str]] = {column.name: [] for column in columns if column.measured}
    rows: dict[tuple[object, ...], Row] = {}
    for line, cells, stated in tables.rows_of(folder, tables.sheet_of(folder, file, columns)):
        values = tuple(stated.pop(name) for name in measured if name in stated)
        rounding = stated.pop("rounding", None)
        made = Row(
            case=case.name, **stated, values=values, rounding=(rounding,) if rounding else ()
        )
        if rows.setdefault((made.elements, made.place), made) is not made:
            folder.add(file, "the same row stands above: keep one", line)
        elif values:
            for name, written in measured.items():
                written.append(cells[name])
    most = {name: tables.digits(written) for name, written in measured.items() if written}
    if folder.add_all(file, tables.too_short(most)):
        return []
    for place, row in rows.items():
        lost = [
            max(tables.rounding(count, abs(value)), *row.rounding, 0.0)
            for count, value in zip(most.values(), row.values, strict=False)
        ]
        rows[place] = replace(row, rounding=tuple(lost) if any(lost) else ())
    return list(rows.values())


def _vibrations(folder: Folder) -> list[tuple[str, Case]]:
    """Return the files of free vibrations, each in place of a row of a table, and their cases."""
    cases = [case for case in CASES.values() if case.quantities == ("linear frequency",)]
    return [(file, case) for case in cases for file in folder.histories(case.name)]


def _vibration(folder: Folder, file: str, case: Case, rows: Sequence[Row]) -> list[Row]:
    """Return the row that a free vibration stands for, if it is right and is not in the table."""
    place = _VIBRATION.fullmatch(file.partition("/")[2])
    try:
        if place is None:
            remedy = f"write {case.name}/m032_w6.csv, of 32 elements at 6 rad/s"
            raise ValueError(f"is no name of a free vibration: {remedy}")
        elements, speed = map(tables.Column.value, tables.columns_of(case)[:2], place.groups())
        if (case.name, elements, speed) in [(one.case, one.elements, one.speed) for one in rows]:
            raise ValueError("the same mesh and speed are handed in twice: keep one")
        held = runs.history_of(folder, file, replace(case, duration=FREE_FOR), math.nan)
        if held is not None:
            return [free_frequency(case, elements, speed, held["time"], held["q"])]
    except ValueError as error:
        folder.add(file, str(error))
    return []


def _find_strangers(folder: Folder) -> None:
    """Add tables and folders of histories that belong to no case: misspelled, most likely.

    A link out of the folder may have any name, and is looked into under none.
    """
    expected = (*_TABLES, runs.FILE)
    for path in sorted(folder.root.iterdir()):
        name = printable(path.name)
        if folder.real(path.name) is None:
            if path.name in CASES:
                folder.add(name, OUTSIDE)
        elif path.is_dir() and path.name not in CASES and any(path.glob("m*_h*.csv")):
            folder.add(name, f"is the folder of no case; {near(name, CASES, str)}")
        elif path.suffix.lower() == ".csv" and path.name not in expected:
            folder.add(name, f"is a table that nobody asked for; {near(name, expected, str)}")


def write_submission(submission: Submission, folder: str | os.PathLike[str]) -> Path:
    """Write the files of a submission, as `read_submission` takes them, and return the folder.

    They read back the same to the last bit.

    Parameters
    ----------
    submission : Submission
        From files, or of a code that was called, as `submission_of` returns it.
    folder : path
        New, or without a submission.

    Raises
    ------
    FileExistsError
        If there is a submission, or a file of one.
    OSError
        If it cannot be written.
    ValueError
        If two runs have the same case, mesh and step.

    Examples
    --------
    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> from rotbeam_exu.verification.submission import Declaration, Row, Submission
    >>> from rotbeam_exu.verification.submission_files import write_submission
    >>> mine = Row(case="L", elements=8, speed=6.0, values=(3.731123456,))
    >>> submission = Submission(declaration=Declaration(code="mine"), rows=(mine,))
    >>> with TemporaryDirectory() as folder:
    ...     written = write_submission(submission, Path(folder, "mine"))
    ...     print(sorted(path.name for path in written.iterdir()))
    ['L.csv', 'entry.toml']
    """
    root = Path(folder)
    histories = [replace(run, file=runs.file_of(run)) for run in submission.runs]
    names = [run.file for run in histories]
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        raise ValueError(f"two runs would be {twice[0]}: keep one of each case, mesh and step")
    texts = {entry.FILE: entry.entry_text(submission.declaration)}
    for file, case in _TABLES.items():
        if rows := [row for row in submission.rows if row.case == case.name]:
            texts[file] = table_of(case, rows)
    if histories:
        texts[runs.FILE] = runs.list_of(histories)
    for name in (*texts, *(run.case for run in histories)):
        if (root / name).exists():
            raise FileExistsError(f"{root} holds {name} already: choose another folder")
    for run in histories:
        if not run.failure:
            out, numbers = io.StringIO(), np.column_stack([run.time, run.q])
            header = ",".join(["time", *CASES[run.case].columns])
            # NumPy's words of a number are its shortest ones that read back the same.
            np.savetxt(out, numbers, "%s", ",", header=header, comments="")
            texts[run.file] = out.getvalue()
    for file, text in texts.items():
        (root / file).parent.mkdir(parents=True, exist_ok=True)
        with whole_file(root / file) as partial:
            partial.write_text(text, encoding="utf-8", newline="\n")
    return root


def table_of(case: Case, rows: Sequence[Row]) -> str:
    """Return the text of a case's table, as L.csv."""
    columns = tables.columns_of(case)
    measured = [column.name for column in columns if column.measured]
    stated = [
        vars(row) | dict(zip(measured, row.values, strict=False))
        | {"rounding": row.rounding[0] if row.rounding else None}
        for row in rows
    ]  # fmt: skip
    return tables.written(columns, stated)


def digests(folder: str | os.PathLike[str], submission: Submission) -> dict[str, str]:
    """Return the SHA-256 of each file that was judged, by its name below the folder."""
    files = Folder(folder)
    free = (file for file, _ in _vibrations(files))
    by_file = {}
    for file in (entry.FILE, *_TABLES, *free, runs.FILE, *(run.file for run in submission.runs)):
        with suppress(OSError, ValueError):  # not there, or told as a fault
            by_file[file] = hashlib.sha256(files.content(file)).hexdigest()
    return by_file
