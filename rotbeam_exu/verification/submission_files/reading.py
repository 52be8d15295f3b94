"""Reading a submission: entry.toml, L.csv, B.csv, and the histories that runs.csv lists."""

from __future__ import annotations

import difflib
import hashlib
import os
from collections.abc import Iterator, Mapping
from pathlib import Path

import numpy as np

from ..cases import CASES, Asked, Case
from ..submission import BackbonePoint, Frequency, Run, Submission
from . import entry, runs
from .content import OUTSIDE, below, content_of
from .faults import Faults, MalformedSubmissionError
from .histories import history_of
from .points import backbone_of, frequencies_of


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
    for file, case in _tables(cases).items():
        if os.path.lexists(root / file):
            if case.asked is Asked.FREQUENCIES:
                frequencies = frequencies_of(root, file, case, faults)
            else:
                backbone = backbone_of(root, file, case, faults)
    histories = _histories(root, cases, faults)
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
    files = [entry.FILE, *_tables(CASES), runs.FILE, *(run.file for run in submission.runs)]
    return {
        file: hashlib.sha256(content_of(root, file)).hexdigest()
        for file in files
        if (root / file).is_file()
    }


def _tables(cases: Mapping[str, Case]) -> dict[str, Case]:
    """Return the cases that are handed in as one table, by its file."""
    return {f"{name}.csv": case for name, case in cases.items() if case.asked is not Asked.HISTORY}


def _histories(root: Path, cases: Mapping[str, Case], faults: Faults) -> tuple[Run, ...]:
    """Return the runs that runs.csv lists, those that failed without a history."""
    there = dict.fromkeys(_found_histories(root, cases))
    if not there and not os.path.lexists(root / runs.FILE):
        return ()
    found = []
    listed = runs.listed_runs(root, cases, faults)
    nothing = np.empty(0)
    for one in listed:
        samples = None
        if not one.failure:
            samples = history_of(root, one.file, cases[one.case], faults)
            if samples is None:
                continue
        found.append(
            Run(
                case=one.case, elements=one.elements, step=one.step,
                time=samples["time"] if samples else nothing,
                q=samples["q"] if samples else nothing,
                q_dot=samples.get("q_dot") if samples else None,
                failure=one.failure, file=one.file, dof=one.dof, wall=one.wall, cpu=one.cpu,
                remark=one.remark,
            )
        )  # fmt: skip
    if not faults.of(runs.FILE):
        known = {one.file for one in listed}
        for file in there:
            if file not in known:
                faults.add(file, f"stands in no row of {runs.FILE}: add file, elements, step")
    return tuple(found)


def _found_histories(root: Path, cases: Mapping[str, Case]) -> Iterator[str]:
    for name, case in cases.items():
        if case.asked is Asked.HISTORY and below(root, name) and (root / name).is_dir():
            for path in sorted((root / name).glob("*.csv")):
                yield f"{name}/{_printable(path.name)}"


def _strangers(root: Path, cases: Mapping[str, Case], faults: Faults) -> None:
    """Add tables and folders of histories that belong to no case: misspelled, most likely.

    A link out of the folder may have any name, and is looked into under none.
    """
    tables = (*_tables(cases), runs.FILE)
    for path in sorted(root.iterdir()):
        name = _printable(path.name)
        if below(root, path.name) is None:
            if path.name in cases:
                faults.add(name, OUTSIDE)
        elif path.is_dir() and path.name not in cases and any(path.glob("m*_h*.csv")):
            faults.add(name, f"is the folder of no case; {_near(name, tuple(cases))}")
        elif path.suffix.lower() == ".csv" and path.name not in tables:
            faults.add(name, f"is a table that nobody asked for; {_near(name, tables)}")


def _near(name: str, known: tuple[str, ...]) -> str:
    alike = {one.lower(): one for one in known}
    close = difflib.get_close_matches(name.lower(), list(alike), n=1)
    return f"did you mean {alike[close[0]]}?" if close else f"known are {', '.join(known)}"


def _printable(name: str) -> str:
    """Return the name of a file, bytes that are no letters and the like replaced."""
    text = name.encode("utf-8", "replace").decode()
    return text if text.isprintable() else ascii(text)[1:-1]
