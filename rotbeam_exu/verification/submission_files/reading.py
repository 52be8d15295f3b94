"""Reading a submission: entry.toml, L.csv, B.csv, and the histories that runs.csv lists."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Mapping
from pathlib import Path

from ..cases import CASES, Asked, Case
from ..submission import BackbonePoint, Frequency, Submission
from . import entry, runs
from .content import OUTSIDE, below, content_of
from .faults import Faults, MalformedSubmissionError, near, printable
from .points import points_of, tables_of


def read_submission(
    folder: str | os.PathLike[str], *, cases: Mapping[str, Case] = CASES
) -> Submission:
    r"""Read what an author hands in.

    Parameters
    ----------
    folder : path
        With entry.toml and at least one of L.csv, B.csv, and runs.csv, which lists the histories.
    cases : mapping
        Those of the benchmark, by name.

    Returns
    -------
    Submission
        Histories end with their case; later samples are left out.

    Raises
    ------
    MalformedSubmissionError
        With all faults of all files.
    FileNotFoundError
        If there is no such folder.

    Examples
    --------
    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> from rotbeam_exu.verification.submission_files.reading import read_submission
    >>> with TemporaryDirectory() as folder:
    ...     _ = Path(folder, "entry.toml").write_text('benchmark = "1.0"\ncode = "mine"')
    ...     _ = Path(folder, "L.csv").write_text("elements,speed,frequency\n8,6.0,3.731123456")
    ...     print(read_submission(folder).frequencies)
    (Frequency(elements=8, speed=6.0, frequency=3.731123456, failure=''),)
    """
    root = Path(folder)
    if not root.is_dir():
        raise FileNotFoundError(f"there is no folder {root}: name that of the submission")
    faults = Faults()
    declaration = entry.declaration_of(root, faults)
    frequencies: tuple[Frequency, ...] = ()
    backbone: tuple[BackbonePoint, ...] = ()
    for file, case in tables_of(cases).items():
        if os.path.lexists(root / file):
            rows = points_of(root, file, case, faults)
            if case.asked is Asked.FREQUENCIES:
                frequencies = tuple(Frequency(**row) for row in rows)
            else:
                backbone = tuple(BackbonePoint(**row) for row in rows if "failure" not in row)
    histories = runs.runs_of(root, cases, faults)
    _strangers(root, cases, faults)
    if not faults and not (frequencies or backbone or histories):
        said = "there is nothing to judge: hand in L.csv, B.csv, or histories with runs.csv"
        faults.add(entry.FILE, said)
    if faults or declaration is None:
        raise MalformedSubmissionError(faults.told())
    return Submission(
        declaration=declaration, frequencies=frequencies, backbone=backbone, runs=histories
    )


def digests(folder: str | os.PathLike[str], submission: Submission) -> dict[str, str]:
    """Return the SHA-256 of each file that was judged, by its name below the folder."""
    root = Path(folder)
    files = [entry.FILE, *tables_of(CASES), runs.FILE, *(run.file for run in submission.runs)]
    return {
        file: hashlib.sha256(content_of(root, file)).hexdigest()
        for file in files
        if (root / file).is_file()
    }


def _strangers(root: Path, cases: Mapping[str, Case], faults: Faults) -> None:
    """Add tables and folders of histories that belong to no case: misspelled, most likely.

    A link out of the folder may have any name, and is looked into under none.
    """
    tables = (*tables_of(cases), runs.FILE)
    for path in sorted(root.iterdir()):
        name = printable(path.name)
        if below(root, path.name) is None:
            if path.name in cases:
                faults.add(name, OUTSIDE)
        elif path.is_dir() and path.name not in cases and any(path.glob("m*_h*.csv")):
            faults.add(name, f"is the folder of no case; {near(name, cases, str)}")
        elif path.suffix.lower() == ".csv" and path.name not in tables:
            faults.add(name, f"is a table that nobody asked for; {near(name, tables, str)}")
