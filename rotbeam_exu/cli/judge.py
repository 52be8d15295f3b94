"""`rotbeam judge`: the judgement of a submission of files, from any code in any language."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from json import dumps
from pathlib import Path

from ..files.results import whole_file
from ..report.document import Record, document
from ..report.page import report_page
from ..verification.cases import CASES, VERSION
from ..verification.judgement import judged
from ..verification.mistakes import mistakes_in
from ..verification.mistakes.histories import Mistake
from ..verification.submission_files import digests, read_submission
from ..verification.submission_files.faults import Fault, MalformedSubmissionError
from .job import require_writable
from .output import bar, print_note, print_text, print_written
from .verify import print_judgements


def judge(
    folder: Path,
    /,
    *,
    case: list[str] | None = None,
    report: Path | None = None,
    json: Path | None = None,
) -> None:
    """Judge the result files of any code by their limits.

    Exit code 0: all that was handed in is decided and right; 1: something differs; 2: files are
    malformed, all their faults are printed, and the others are judged; 3: something is undecided.

    Parameters
    ----------
    folder
        With entry.toml and L.csv, B.csv, or histories and runs.csv.
    case
        Judge this case alone, as S1; repeat it for several.
    report
        Write the report, one HTML page; an old one is replaced.
    json
        Write all findings as JSON; an old file is replaced.

    Examples
    --------
    $ rotbeam judge mine --report mine.html --json mine.json
    $ rotbeam judge mine --case S1
    """
    for target, ending in ((report, ".html"), (json, ".json")):
        if target is not None:
            require_writable(target, force=True, ending=ending)
    only, faults = tuple(case or ()), tuple[Fault, ...]()
    if unknown := [name for name in only if name not in CASES]:
        raise ValueError(f"there is no case {unknown[0]!r}: it must be {', '.join(CASES)}")
    try:
        submission = read_submission(folder, only=only)
    except MalformedSubmissionError as error:
        faults = error.faults
        for fault in faults:
            print_text(str(fault), stderr=True)
        judged_is = "nothing is" if error.rest is None else "only the rest is"
        many = f"{len(faults)} fault{'s' * (len(faults) > 1)}"
        print_text(f"{many}: {judged_is} judged", stderr=True)
        if error.rest is None:
            sys.exit(2)
        submission = error.rest
    with bar("judging") as drawn:
        found = judged(
            submission, only=only, progress=lambda name, n, of: drawn(n, of, f"judging {name}")
        )
        mistakes = mistakes_in(
            submission, found, lambda name, n, of: drawn(n, of, f"usual mistakes in {name}")
        )
    _print_mistakes(mistakes)
    print_judgements([found], f"benchmark {VERSION}")
    for source in dict.fromkeys(found.sources.values()):
        print_note(f"reference: {source}")
    record = Record(
        submission=submission, judgement=found, mistakes=tuple(mistakes),
        digests=digests(folder, submission), faults=faults,
    )  # fmt: skip
    if report is not None:
        _write(report_page(record), report)
    if json is not None:
        _write(dumps(document(record), indent=1, ensure_ascii=False) + "\n", json)
    sys.exit(2 if faults else {True: 0, False: 1, None: 3}[found.passed])


def _write(text: str, target: Path) -> None:
    with whole_file(target) as partial:
        partial.write_text(text, encoding="utf-8")
    print_written([target])


def _print_mistakes(mistakes: Sequence[Mistake]) -> None:
    """Print each mistake once, with the cases that it explains."""
    by_name: dict[str, list[Mistake]] = {}
    for one in mistakes:
        by_name.setdefault(one.name, []).append(one)
    for alike in by_name.values():
        print_note(f"{', '.join(one.case for one in alike)}: a usual mistake? {alike[0]}")
