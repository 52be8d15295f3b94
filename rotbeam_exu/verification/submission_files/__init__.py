"""The folder of a submission: entry.toml, L.csv, B.csv, runs.csv and the histories, both ways."""

from __future__ import annotations

import hashlib
import math
import os
import re
from collections.abc import Collection
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from ...files.results import whole_folder
from ..cases import CASES, Asked, Case
from ..history import FREE_FOR, free_frequency
from ..submission import BackbonePoint, Frequency, Run, SteadyTip, Submission
from . import entry, runs
from .content import OUTSIDE, below, content_of
from .faults import Faults, MalformedSubmissionError, near, printable
from .tables import (
    FAILURE,
    LEAST_DIGITS,
    TOO_FEW,
    Column,
    asked,
    bounded,
    digits,
    rounding,
    rows_of,
    sheet_of,
    whole,
    written,
)

_positive = bounded(lambda value: value > 0.0, "must be positive, got {}; it is in rad/s")
_not_negative = bounded(lambda value: value >= 0.0, "must not be negative, got {}")
_ROUNDING = Column("rounding", _not_negative, "rad/s", needed=False)
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
    ...     print(read_submission(folder).frequencies[0].frequency)
    3.731123456
    """
    root, faults = Path(folder), Faults()
    if not root.is_dir():
        raise FileNotFoundError(f"there is no folder {root}: name that of the submission")
    declaration = entry.declaration_of(root, faults)
    points: dict[Asked, list[dict[str, Any]]] = {asked: [] for asked in Asked}
    for file, case in _tables().items():
        if os.path.lexists(root / file):
            points[case.asked] += _points(root, file, case, faults)
    for file, case in _vibrations(root):
        points[case.asked] += _vibration(root, file, case, points[case.asked], faults)
    histories = runs.runs_of(root, faults, only)
    _strangers(root, faults)
    frequencies, steady = points[Asked.FREQUENCIES], points[Asked.STEADY]
    backbone = [row for row in points[Asked.BACKBONE] if "failure" not in row]
    some = bool(frequencies or steady or backbone or histories)
    if not (faults or some):
        said = "there is nothing to judge: hand in L.csv, B.csv, or histories with runs.csv"
        faults.add(entry.FILE, said)
    if declaration is None:
        raise MalformedSubmissionError(faults.told())
    made = Submission(
        declaration=declaration,
        frequencies=tuple(Frequency(**row) for row in frequencies),
        steady=tuple(SteadyTip(**row) for row in steady),
        backbone=tuple(BackbonePoint(**row) for row in backbone),
        runs=histories,
    )
    if faults:
        raise MalformedSubmissionError(faults.told(), made if some else None)
    return made


def write_submission(submission: Submission, folder: str | os.PathLike[str]) -> Path:
    """Write the files of a submission, as `read_submission` takes them, and return the folder.

    They read back the same to the last bit. All are written, or none.

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
    >>> from rotbeam_exu.verification.submission import Declaration, Frequency, Submission
    >>> from rotbeam_exu.verification.submission_files import write_submission
    >>> mine = Frequency(elements=8, speed=6.0, frequency=3.731123456)
    >>> submission = Submission(declaration=Declaration(code="mine"), frequencies=(mine,))
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
        points: list[Any] = [row for row in submission.rows if row.case == case.name]
        points += submission.backbone if case.asked is Asked.BACKBONE else ()
        columns = [
            one for one in _columns(case)
            if one is not _ROUNDING or any(point.rounding for point in points)
        ]  # fmt: skip
        texts |= {table: written(columns, points)} if points else {}
    texts |= {runs.FILE: written(runs.COLUMNS, named)} if named else {}
    for name in (*texts, *(run.case for run in named)):
        if (root / name).exists():
            raise FileExistsError(f"{root} holds {name} already: choose another folder")
    with whole_folder(root) as made:
        for file, text in texts.items():
            (made / file).write_text(text, encoding="utf-8", newline="\n")
        for run in named:
            if not run.failure:
                _write_history(run, made)
    return root


def _write_history(run: Run, folder: Path) -> None:
    """Write the history of a run into the folder of its case."""
    held = "time", *CASES[run.case].columns
    numbers = np.column_stack([run.time, run.q])
    (folder / run.case).mkdir(exist_ok=True)
    with (folder / run.file).open("w", encoding="utf-8", newline="\n") as out:
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
    return (*places, Column("frequency", _positive, "rad/s", measured=True), _ROUNDING, FAILURE)


def _points(folder: Path, file: str, case: Case, faults: Faults) -> list[dict[str, Any]]:
    """Return the rows of a case's table by field; rows with a failure have no frequency."""
    columns = _columns(case)
    sheet = sheet_of(folder, file, columns, faults)
    names = [column.name for column in columns if column.measured]
    of_case = {} if case.asked is Asked.BACKBONE else {"case": case.name}
    found: dict[tuple[float, ...], dict[str, Any]] = {}
    most = dict.fromkeys(names, 0)
    for line, cells, row in rows_of(sheet, faults) if sheet else ():
        place = row["elements"], row["speed"], row.get("amplitude", row.get("number", 0))
        if place in found:
            faults.add(file, "the same row stands above: keep one", line)
            continue
        found[place] = row | of_case
        most |= {name: max(most[name], digits(cells[name])) for name in names if name in row}
    measured = [row for row in found.values() if names[0] in row]
    short = [name for name, count in most.items() if measured and count < LEAST_DIGITS]
    if short:
        named = {"frequency": "frequencies are"}.get(short[0], f"column {short[0]!r} is")
        faults.add(file, f"{named} written to {most[short[0]]} {TOO_FEW}")
        return []
    for row in measured:
        errors = tuple(rounding(most[name], abs(row[name])) for name in names)
        told = row.get("rounding", 0.0)
        row["rounding"] = errors if len(errors) > 1 else max(errors[0], told)
    return list(found.values())


def _vibrations(root: Path) -> list[tuple[str, Case]]:
    """Return the files of free vibrations, each in place of a row of a table, and their cases."""
    return [
        (f"{name}/{printable(path.name)}", case)
        for name, case in CASES.items()
        if case.quantities == ("linear frequency",) and below(root, name)
        for path in sorted((root / name).glob("*.csv"))
    ]


def _vibration(
    root: Path, file: str, case: Case, rows: list[dict[str, Any]], faults: Faults
) -> list[dict[str, Any]]:
    """Return the row that a free vibration stands for, if it is right and is not in the table."""
    place = _VIBRATION.fullmatch(file.partition("/")[2])
    try:
        if place is None:
            remedy = f"write {case.name}/m032_w6.csv, of 32 elements at 6 rad/s"
            raise ValueError(f"is no name of a free vibration: {remedy}")
        elements, speed = whole("elements", place[1]), asked(case.speeds)("speed", place[2])
        mine = case.name, elements, speed
        if mine in [(one["case"], one["elements"], one["speed"]) for one in rows]:
            raise ValueError("the same mesh and speed are handed in twice: keep one")
        lasting = replace(case, duration=FREE_FOR)
        held = runs.history_of(root, file, lasting, math.nan, faults)
        if held is not None:
            return [vars(free_frequency(case, elements, speed, held["time"], held["q"]))]
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
