"""`verify --command`: a program is run until the judge decides, and its files are kept.

The folder is a submission at any time: a run is on record when it ends, a failed one with its
sentence. What is there is not run again.
"""

from __future__ import annotations

import math
import os
import tempfile
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

import numpy as np

from analytic.input_checks import positive, whole_number

from ..files.results import whole_file
from .case import Asked, Case
from .cases import VERSION
from .judgement import judged
from .program import STOPPED, Program
from .submission import Declaration, Row, Run, Submission
from .submission_files import entry, read_submission, rows_in, runs, table_of
from .submission_files.faults import Folder

_HALVINGS = 8
"""How often the step is halved for a program that fails, as explicit ones do at large steps."""

_FARTHEST = 4.0
"""How many times finer a mesh or a step is at most than the finest before."""

_ROUNDS = 12
"""How often a case is refined: 4¹² times the elements are no mesh."""


class Record:
    """The folder of a submission that grows by a run at a time.

    Parameters
    ----------
    folder : path
        New, or with a submission, whose runs are not made again.
    program : Program
    code : str
        Name of the code, of a folder without entry.toml.

    Attributes
    ----------
    submission : Submission
        What is there.
    spent : float
        CPU time of the runs made [s], or time on the clock where it is not known.

    Raises
    ------
    MalformedSubmissionError
        If something in the folder is to be mended first.
    OSError
        If it cannot be written.
    """

    def __init__(self, folder: str | os.PathLike[str], program: Program, code: str) -> None:
        self.root, self.program = Path(folder), program
        self.spent = 0.0
        declaration: Declaration | None = Declaration(code=code, benchmark=VERSION)
        if (self.root / entry.FILE).exists():
            declaration = entry.declaration_of(Folder(self.root))
        if declaration is not None and not any(self.root.glob("**/*.csv")):
            self.submission = Submission(declaration=declaration, rows=(), runs=())
        else:
            self.submission = read_submission(self.root)

    @contextmanager
    def _scratch(self) -> Iterator[Path]:
        """Give a folder for the files of a run, in that of the submission, which is made."""
        self.root.mkdir(parents=True, exist_ok=True)
        if not (self.root / entry.FILE).exists():
            _write(self.root / entry.FILE, entry.entry_text(self.submission.declaration))
        with tempfile.TemporaryDirectory(dir=self.root, prefix=".") as scratch:
            yield Path(scratch)

    def run_of(self, case: Case, elements: int, size: float) -> Run:
        """Return the run of a mesh and a step or tolerance, made unless it is on record."""
        step, tolerance = (math.nan, size) if self.program.is_adaptive else (size, math.nan)
        made = Run(
            case=case.name, elements=elements, step=step, tolerance=tolerance, time=np.empty(0),
            q=np.empty(0),
        )  # fmt: skip
        made = replace(made, file=runs.file_of(made))
        for one in self.submission.runs:
            if one.file == made.file:
                return one
        with self._scratch() as scratch:
            out = scratch / made.file
            out.parent.mkdir()
            failure, wall, cpu = self._made(case, elements, size, out)
            if not failure:
                alone = Folder(scratch)
                held = runs.history_of(alone, made.file, case, made.step)
                if held is None:
                    failure = f"writes what cannot be judged: {alone.faults[0].said}"
                else:
                    made = replace(made, time=held["time"], q=held["q"], rounding=held["rounding"])
                    (self.root / case.name).mkdir(exist_ok=True)
                    out.replace(self.root / made.file)
        made = replace(made, failure=failure, wall=round(wall, 4), cpu=round(cpu, 4))
        several = (*self.submission.runs, made)
        _write(self.root / runs.FILE, runs.list_of(several))
        self.submission = replace(self.submission, runs=several)
        return made

    def rows_of(self, case: Case, elements: int) -> list[Row]:
        """Return the rows of a mesh in the case's table, made unless they are on record."""
        held = [one for one in self.submission.rows if one.case == case.name]
        if there := [one for one in held if one.elements == elements]:
            return there
        file = f"{case.name}.csv"
        with self._scratch() as scratch:
            failure, _, _ = self._made(case, elements, 0.0, scratch / file)
            made, alone = [], Folder(scratch)
            if not failure:
                made = [one for one in rows_in(alone, file, case) if one.elements == elements]
                if alone.faults:
                    failure = f"writes what cannot be judged: {alone.faults[0].said}"
                elif not made:
                    failure = f"writes no row of {elements} elements into {file}"
        if failure:
            amplitude = case.amplitudes[0] if case.amplitudes else 0.0
            made = [
                Row(
                    case=case.name, elements=elements, speed=speed, amplitude=amplitude,
                    failure=failure,
                )
                for speed in case.speeds
            ]  # fmt: skip
        _write(self.root / file, table_of(case, [*held, *made]))
        self.submission = replace(self.submission, rows=(*self.submission.rows, *made))
        return made

    def _made(self, case: Case, elements: int, size: float, out: Path) -> tuple[str, float, float]:
        failure, wall, cpu = self.program.run(case, elements, size, out)
        self.spent += cpu or wall
        return failure, wall, cpu


def _write(path: Path, text: str) -> None:
    with whole_file(path) as partial:
        partial.write_text(text, encoding="utf-8", newline="\n")


Announce = Callable[[str], None]
"""Called with what is run next, in a few words."""


def until_decided(
    record: Record,
    cases: Iterable[Case],
    *,
    elements: int = 16,
    step: float = 1e-3,
    budget: float = 3600.0,
    announce: Announce = lambda _: None,
) -> dict[str, str]:
    """Run a program on finer and finer meshes and steps until each case is decided.

    Parameters
    ----------
    record : Record
    cases : iterable of Case
    elements : int
        Of the middle one of the first three meshes; the others have half and twice as many.
    step : float
        The smallest of the first three steps [s], or tolerances, on the middle mesh. The steps are
        halved where the program fails.
    budget : float
        CPU time of the runs [s] after which no other begins.
    announce : callable, optional
        See `Announce`.

    Returns
    -------
    dict
        By name of the case, why no other run was made.

    Raises
    ------
    TypeError or ValueError
        If a number is not positive.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> from rotbeam_exu.verification.cases import CASES
    >>> from rotbeam_exu.verification.program import Program
    >>> from rotbeam_exu.verification.refining import Record, until_decided
    >>> program = Program(command="false {case} {elements} {step} {out}")
    >>> with TemporaryDirectory() as folder:
    ...     record = Record(folder, program, "mine")
    ...     print(until_decided(record, [CASES["L"]])["L"])
    exit code 1
    """
    whole_number("elements", elements)
    positive("step", step)
    positive("budget", budget)
    ends = {}
    for case in cases:
        ends[case.name] = _Meshes(record, case, elements, step, budget, announce).end()
    return ends


class _Meshes:
    """The meshes and steps of a case."""

    def __init__(
        self, record: Record, case: Case, elements: int, size: float, budget: float,
        announce: Announce,
    ) -> None:  # fmt: skip
        self.record, self.case, self.budget, self.announce = record, case, budget, announce
        self.elements, self.size = max(elements, 2), size
        self.around = self.elements // 2, self.elements, 2 * self.elements
        self.in_time = case.asked is Asked.HISTORY

    def end(self) -> str:
        """Make runs until the case is decided, and return why no other is made."""
        failure = self._first()
        for _ in range(_ROUNDS):
            if failure:
                return failure
            findings = judged(self.record.submission, only=(self.case.name,)).findings
            found = findings.get(self.case.name, {}).values()
            undecided = [one for one in found if one.outcome.passed is None]
            if not undecided:
                return "decided"
            meshes = [n for n, _ in (one.finer for one in undecided) if n is not None]
            sizes = [h for _, h in (one.finer for one in undecided) if h is not None]
            if not meshes and not sizes:
                return "no finer run would decide: see the note of the judge"
            failure = self._finer(max(meshes, default=None), min(sizes, default=None))
        return failure or f"{_ROUNDS} refinements do not decide"

    def _first(self) -> str:
        """Run three meshes, and three steps on the middle one."""
        if not self.in_time:
            return _first_of([self._at(n, 0.0) for n in self.around])
        for _ in range(_HALVINGS + 1):
            h = self.size
            first = [(n, 2.0 * h) for n in self.around]
            failures = []
            for n, size in [*first, (self.elements, h), (self.elements, 4.0 * h)]:
                failures.append(self._at(n, size))
                if failures[-1]:
                    break
            if not failures[-1] or STOPPED in failures[-1] or self._is_spent:
                return _first_of(failures)
            self.size = 0.5 * h
        return f"fails at {runs.size_in_words(2.0 * self.size)}, too: {failures[-1]}"

    def _finer(self, elements: int | None, size: float | None) -> str:
        """Run a finer mesh and a smaller step, as far as they are wanted."""
        held, mine = self.record.submission, self.case.name
        made = [one for one in held.runs if one.case == mine and not one.failure]
        rows = [one for one in held.rows if one.case == mine and not one.failure]
        finest = max([one.elements for one in made] + [one.elements for one in rows])
        failures = []
        if elements is not None:
            n = round(min(max(elements, 1.5 * finest), _FARTHEST * finest))
            h = min((one.refinement for one in made if one.elements == finest), default=0.0)
            failures.append(self._at(n, h))
            for _ in range(_HALVINGS * self.in_time):
                if not failures[-1] or STOPPED in failures[-1]:
                    break
                h *= 0.5
                failures[-1] = self._at(n, h)
        if size is not None:
            smallest = min(one.refinement for one in made)
            h = max(min(size, smallest / 1.5), smallest / _FARTHEST)
            failures.append(self._at(self.elements, float(f"{h:.1e}")))
        return _first_of(failures)

    def _at(self, elements: int, size: float) -> str:
        """Make a run, and return its failure."""
        if self._is_spent:
            return "the budget is spent"
        if not self.in_time:
            self.announce(f"{self.case.name}, {elements} elements")
            return self.record.rows_of(self.case, elements)[0].failure
        self.announce(f"{self.case.name}, {elements} elements, {runs.size_in_words(size)}")
        return self.record.run_of(self.case, elements, size).failure

    @property
    def _is_spent(self) -> bool:
        return self.record.spent >= self.budget


def _first_of(failures: Sequence[str]) -> str:
    return next(filter(None, failures), "")
