"""The folder of a submission: entry.toml, L.csv, B.csv, runs.csv and the histories, both ways."""

from __future__ import annotations

import hashlib
import math
import os
import re
from collections.abc import Collection, Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from ...files.results import whole_file
from ..cases import CASES, Asked, Case
from ..history import FREE_FOR, free_frequency
from ..submission import Row, Run, Submission
from . import entry, runs
from .faults import (
    OUTSIDE,
    Faults,
    MalformedSubmissionError,
    below,
    content_of,
    files_in,
    near,
    printable,
)
from .tables import (
    FAILURE,
    LEAST_DIGITS,
    TOO_FEW,
    Column,
    asked,
    digits,
    not_negative,
    positive,
    rounding,
    rows_of,
    sheet_of,
    whole,
    written,
)

_ROUNDING = Column("rounding", not_negative, "rad/s", needed=False)
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
    root, faults = Path(folder), Faults()
    if not root.is_dir():
        raise FileNotFoundError(f"there is no folder {root}: name that of the submission")
    declaration = entry.declaration_of(root, faults)
    rows: list[Row] = []
    for file, case in _tables().items():
        if os.path.lexists(root / file):
            rows += _rows(root, file, case, faults)
    for file, case in _vibrations(root):
        rows += _vibration(root, file, case, rows, faults)
    histories = runs.runs_of(root, faults, only)
    _strangers(root, faults)
    if not (faults or rows or histories):
        said = "there is nothing to judge: hand in L.csv, B.csv, or histories with runs.csv"
        faults.add(entry.FILE, said)
    if declaration is None:
        raise MalformedSubmissionError(faults.told())
    made = Submission(declaration=declaration, rows=tuple(rows), runs=histories)
    if faults:
        raise MalformedSubmissionError(faults.told(), made if rows or histories else None)
    return made


def write_submission(submission: Submission, folder: str | os.PathLike[str]) -> Path:
    """Write the files of a submission, as `read_submission` takes them, and return the folder.

    They read back the same to the last bit.

    Parameters
    ----------
    submission : Submission
        From files, or of a code that was called, as `handed_in` returns it.
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
    named = [replace(run, file=runs.file_of(run)) for run in submission.runs]
    files = [run.file for run in named]
    twice = sorted({file for file in files if files.count(file) > 1})
    if twice:
        raise ValueError(f"two runs would be {twice[0]}: keep one of each case, mesh and step")
    texts = {entry.FILE: entry.entry_text(submission.declaration)}
    for table, case in _tables().items():
        columns = _columns(case)
        names = [column.name for column in columns if column.measured]
        rows = [
            vars(row) | dict(zip(names, row.values, strict=False))
            | {"rounding": row.rounding[0] if row.rounding else None}
            for row in submission.rows if row.case == case.name
        ]  # fmt: skip
        texts |= {table: written(columns, rows)} if rows else {}
    texts |= {runs.FILE: written(runs.COLUMNS, list(map(vars, named)))} if named else {}
    for name in (*texts, *(run.case for run in named)):
        if (root / name).exists():
            raise FileExistsError(f"{root} holds {name} already: choose another folder")
    root.mkdir(parents=True, exist_ok=True)
    for file, text in texts.items():
        with whole_file(root / file) as partial:
            partial.write_text(text, encoding="utf-8", newline="\n")
    for run in named:
        if not run.failure:
            _write_history(run, root)
    return root


def _write_history(run: Run, folder: Path) -> None:
    """Write the history of a run into the folder of its case."""
    held = "time", *CASES[run.case].columns
    numbers = np.column_stack([run.time, run.q])
    (folder / run.case).mkdir(exist_ok=True)
    with (
        whole_file(folder / run.file) as partial,
        partial.open("w", encoding="utf-8", newline="\n") as out,
    ):
        # NumPy's words of a number are its shortest ones that read back the same.
        np.savetxt(out, numbers, "%s", ",", header=",".join(held), comments="")


def digests(folder: str | os.PathLike[str], submission: Submission) -> dict[str, str]:
    """Return the SHA-256 of each file that was judged, by its name below the folder."""
    root = Path(folder)
    free = (file for file, _ in _vibrations(root))
    files = [entry.FILE, *_tables(), *free, runs.FILE, *(run.file for run in submission.runs)]
    found = {}
    for file in files:
        with suppress(OSError, ValueError):  # not there, or told as a fault
            found[file] = hashlib.sha256(content_of(root, file)).hexdigest()
    return found


def _tables() -> dict[str, Case]:
    """Return the cases that are handed in as one table, by its file."""
    return {f"{name}.csv": case for name, case in CASES.items() if case.asked is not Asked.HISTORY}


def _columns(case: Case) -> tuple[Column, ...]:
    """Return the columns of a case's table."""
    places = [Column("elements", whole), Column("speed", asked(case.speeds), "rad/s")]
    if case.amplitudes:
        places.append(Column("amplitude", asked(case.amplitudes)))
    if case.count > 1:
        places.append(Column("number", asked(range(1, case.count + 1))))
    if case.asked is Asked.STEADY:
        return (*places, *(replace(one, measured=True) for one in runs.TIP_COLUMNS), FAILURE)
    return (*places, Column("frequency", positive, "rad/s", measured=True), _ROUNDING, FAILURE)


def _rows(folder: Path, file: str, case: Case, faults: Faults) -> list[Row]:
    """Return the rows of a case's table."""
    columns = _columns(case)
    sheet = sheet_of(folder, file, columns, faults)
    names = [column.name for column in columns if column.measured]
    found: dict[tuple[Any, ...], Row] = {}
    most = dict.fromkeys(names, 0)
    for line, cells, stated in rows_of(sheet, faults) if sheet else ():
        values = tuple(stated.pop(name) for name in names if name in stated)
        told = stated.pop("rounding", None)
        row = Row(case=case.name, **stated, values=values, rounding=(told,) if told else ())
        if (row.elements, row.place) in found:
            faults.add(file, "the same row stands above: keep one", line)
            continue
        found[row.elements, row.place] = row
        if values:
            most = {name: max(most[name], digits(cells[name])) for name in names}
    measured = any(row.values for row in found.values())
    short = [name for name, count in most.items() if measured and count < LEAST_DIGITS]
    if short:
        named = {"frequency": "frequencies are"}.get(short[0], f"column {short[0]!r} is")
        faults.add(file, f"{named} written to {most[short[0]]} {TOO_FEW}")
        return []
    return [_rounded(row, list(most.values())) for row in found.values()]


def _rounded(row: Row, most: Sequence[int]) -> Row:
    """Return a row with the errors of its last digits, or what is told of them."""
    lost = [rounding(count, abs(value)) for count, value in zip(most, row.values, strict=False)]
    told = row.rounding or [0.0] * len(lost)
    errors = tuple(map(max, lost, told))
    return replace(row, rounding=errors if any(errors) else ())


def _vibrations(root: Path) -> list[tuple[str, Case]]:
    """Return the files of free vibrations, each in place of a row of a table, and their cases."""
    known = [case for case in CASES.values() if case.quantities == ("linear frequency",)]
    return [(file, case) for case in known for file in files_in(root, case.name)]


def _vibration(root: Path, file: str, case: Case, rows: Sequence[Row], faults: Faults) -> list[Row]:
    """Return the row that a free vibration stands for, if it is right and is not in the table."""
    place = _VIBRATION.fullmatch(file.partition("/")[2])
    try:
        if place is None:
            remedy = f"write {case.name}/m032_w6.csv, of 32 elements at 6 rad/s"
            raise ValueError(f"is no name of a free vibration: {remedy}")
        elements, speed = whole("elements", place[1]), asked(case.speeds)("speed", place[2])
        mine = case.name, elements, speed
        if mine in [(one.case, one.elements, one.speed) for one in rows]:
            raise ValueError("the same mesh and speed are handed in twice: keep one")
        lasting = replace(case, duration=FREE_FOR)
        held = runs.history_of(root, file, lasting, math.nan, faults)
        if held is not None:
            return [free_frequency(case, elements, speed, held["time"], held["q"])]
    except ValueError as error:
        faults.add(file, str(error))
    return []


def _strangers(root: Path, faults: Faults) -> None:
    """Add tables and folders of histories that belong to no case: misspelled, most likely.

    A link out of the folder may have any name, and is looked into under none.
    """
    tables = (*_tables(), runs.FILE)
    for path in sorted(root.iterdir()):
        name = printable(path.name)
        if below(root, path.name) is None:
            if path.name in CASES:
                faults.add(name, OUTSIDE)
        elif path.is_dir() and path.name not in CASES and any(path.glob("m*_h*.csv")):
            faults.add(name, f"is the folder of no case; {near(name, CASES, str)}")
        elif path.suffix.lower() == ".csv" and path.name not in tables:
            faults.add(name, f"is a table that nobody asked for; {near(name, tables, str)}")
