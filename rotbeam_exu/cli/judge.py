"""`rotbeam kit` and `rotbeam judge`: the benchmark, and judgments on codes."""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Iterable, Sequence
from json import dumps
from pathlib import Path

from ..report.document import Record, document
from ..report.page import report_page
from ..verification.cases import CASES, VERSION
from ..verification.convergence import Order
from ..verification.judgement import THRESHOLDS, Judgement, judged
from ..verification.kit import write_kit
from ..verification.mistakes import mistakes_in
from ..verification.mistakes.histories import Mistake
from ..verification.outcomes import Finding, Outcome
from ..verification.submission import Run, Submission
from ..verification.submission_files import digests, read_submission
from ..verification.submission_files.faults import Fault, MalformedSubmissionError
from .job import require_writable, write_text
from .output import bar, formatted, print_columns, print_note, print_text, print_written

_SHORT = {
    "linear frequency": "ω_n", "history": "q(t)", "nonlinear shift": "shift",
    "frequencies": "ω_k", "steady deflection": "tip", "backbone": "shift",
}  # fmt: skip

_WORDS = {Outcome.REFERENCE: "converges", Outcome.AGREES: "agrees"}


def kit(directory: Path, /) -> None:
    """Write the problem, its data and starters in five languages.

    Parameters
    ----------
    directory
        New, or empty.

    Examples
    --------
    $ rotbeam kit benchmark
    """
    folder = write_kit(directory)
    count = sum(path.is_file() for path in folder.rglob("*"))
    print_text(f"{count} files in {folder}; begin with README.md and PROBLEM.pdf")


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
    malformed, all their faults are printed, and the others are judged; 3: something is undecided;
    70: the judge itself fails.

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
    only, faults = cases_named(case), tuple[Fault, ...]()
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
    try:
        passed = _judge(folder, submission, faults, only, report, json)
    except (ArithmeticError, RuntimeError, TypeError, ValueError) as error:
        # The files were checked: what is raised now is no fault of theirs, nor a difference.
        raise JudgeError from error
    sys.exit(2 if faults else {True: 0, False: 1, None: 3}[passed])


def cases_named(names: Sequence[str] | None) -> tuple[str, ...]:
    """Return the names of cases of the benchmark; ValueError of one that there is not."""
    if unknown := [name for name in names or () if name not in CASES]:
        raise ValueError(f"there is no case {unknown[0]!r}: it must be {', '.join(CASES)}")
    return tuple(names or ())


class JudgeError(Exception):
    """An error of the judge itself, for whatever reason."""


def _judge(
    folder: Path, submission: Submission, faults: Sequence[Fault], only: Sequence[str],
    report: Path | None, json: Path | None,
) -> bool | None:  # fmt: skip
    """Judge, print and write; return whether all is right, None where something is undecided."""
    with bar("judging") as drawn:
        judgement = judged(
            submission, only=only, progress=lambda name, n, of: drawn(n, of, f"judging {name}")
        )
        mistakes = mistakes_in(
            submission, judgement, lambda name, n, of: drawn(n, of, f"usual mistakes in {name}")
        )
    _print_mistakes(mistakes)
    print_text(f"{judgement.declaration.code}: {judgement.outcome}; benchmark {VERSION}")
    _print_findings(judgement)
    _print_orders([judgement])
    for source in dict.fromkeys(judgement.sources.values()):
        print_note(f"reference: {source}")
    record = Record(
        submission=submission, judgement=judgement, mistakes=tuple(mistakes),
        digests=digests(folder, submission), faults=tuple(faults),
    )  # fmt: skip
    if report is not None:
        write_text(report_page(record), report)
        print_written([report])
    if json is not None:
        write_text(dumps(document(record), indent=1, ensure_ascii=False) + "\n", json)
        print_written([json])
    return judgement.passed


def _print_mistakes(mistakes: Sequence[Mistake]) -> None:
    """Print each mistake once, with the cases that it explains."""
    by_name: dict[str, list[Mistake]] = {}
    for one in mistakes:
        by_name.setdefault(one.name, []).append(one)
    for alike in by_name.values():
        print_note(f"{', '.join(one.case for one in alike)}: a usual mistake? {alike[0]}")


def _print_findings(judgement: Judgement) -> None:
    """Print what became of each quantity, and how far limit and finest run are off."""
    found = judgement.by_quantity
    print_columns(
        {
            "outcome": [_WORDS.get(one.outcome, str(one.outcome)) for one in found.values()],
            "case": [case for case, _ in found],
            "quantity": [_SHORT.get(name, name) for _, name in found],
            "limit off by": [_signed(one.model_difference) for one in found.values()],
            "at most": [_largest([one.within]) for one in found.values()],
            "allowed": [f"{THRESHOLDS[name]:g}" for _, name in found],
            "finest run off by": [_signed(one.difference) for one in found.values()],
        }
    )
    print_note(
        "the limit of your meshes and steps decides; at most: its uncertainty and the reference's "
        "included"
    )


def print_judgements(judgements: Sequence[Judgement], about: str) -> None:
    """Print the limits of codes less the reference, their discretization, and the outcomes."""
    for one in judgements:
        print_text(f"{one.declaration.code}: {one.outcome}")
    keys = list(dict.fromkeys(key for one in judgements for key in one.by_quantity))
    findings = {
        key: [one.by_quantity[key] for one in judgements if key in one.by_quantity] for key in keys
    }
    of_quantity = {
        "quantity": [f"{case} {_SHORT.get(quantity, quantity)}" for case, quantity in keys],
        "allowed": [f"{THRESHOLDS[quantity]:g}" for _, quantity in keys],
        "floor": [
            _largest(one.runs.noise[-1] for one in findings[key] if one.runs) for key in keys
        ],
        "ref ±": [_largest(one.bound for one in findings[key]) for key in keys],
    }

    def of_each(cell: Callable[[Finding], str]) -> dict[str, list[str]]:
        return {
            one.declaration.code: [
                cell(one.by_quantity[key]) if key in one.by_quantity else "-" for key in keys
            ]
            for one in judgements
        }

    print_columns(
        of_quantity | of_each(_limit), title=f"Limits of the codes less the reference; {about}"
    )
    print_note(
        "! fails, ? is undecided; floor: resolution of the measurement; ref ±: uncertainty of the "
        "reference, in the shift also that of the code's own ω_n"
    )
    bars = {"quantity": of_quantity["quantity"]} | of_each(_discretization)
    print_columns(
        bars, title="Discretization error: finest run less its own limit, ± uncertainty of that"
    )
    _print_orders(judgements)


def _print_orders(judgements: Sequence[Judgement]) -> None:
    """Print orders and the finest run of each code, and what is to be said of it."""
    print_columns(
        {
            "code": [one.declaration.code for one in judgements],
            "theory": [one.declaration.theory.name for one in judgements],
            "elements": [_finest(one, lambda run: str(run.elements)) for one in judgements],
            "step": [_finest(one, lambda run: run.step_in_words) for one in judgements],
            "order in mesh": [_order(one, "mesh") for one in judgements],
            "in step": [_order(one, "step") for one in judgements],
        }
        | _times(judgements),
        title="Orders of q(t), observed of declared, and the finest run of the first history",
    )
    for one in judgements:
        for sentence in _sentences(one):
            print_note(f"{one.declaration.code}: {sentence}")


def _limit(finding: Finding) -> str:
    """Return the model difference, marked where it decides against the code or decides nothing."""
    if finding.outcome is Outcome.NOT_SUBMITTED:
        return "-"
    if not math.isfinite(finding.model_difference):
        return "none!" if finding.outcome is Outcome.DIFFERS else "none?"
    mark = {True: "", False: "!", None: "?"}[finding.outcome.passed]
    return f"{_signed(finding.model_difference)}{mark}"


def _signed(value: float) -> str:
    return f"{value:+.0e}" if math.isfinite(value) else "-"


def _discretization(finding: Finding) -> str:
    if finding.runs is None or not math.isfinite(finding.runs.limit):
        return "-"
    return f"{finding.runs.errors[-1]:+.0e} ±{finding.runs.bar:.0e}"


def _largest(values: Iterable[float]) -> str:
    finite = [value for value in values if math.isfinite(value)]
    return f"{max(finite):.0e}" if finite else "-"


def _finest(one: Judgement, cell: Callable[[Run], str]) -> str:
    """Return what there is to say of the finest run of the first history."""
    return cell(next(iter(one.histories.values())).finest) if one.histories else "-"


def _times(judgements: Sequence[Judgement]) -> dict[str, list[str]]:
    """Return the column of times on the clock, or else of the processor; none if none is known."""
    runs = [
        next(iter(one.histories.values())).finest if one.histories else None for one in judgements
    ]
    for name in ("wall", "cpu"):
        times = [getattr(run, name, math.nan) for run in runs]
        if not all(map(math.isnan, times)):
            return {{"wall": "seconds", "cpu": "CPU s"}[name]: formatted(times, ".1f")}
    return {}


def _order(one: Judgement, name: str) -> str:
    """Return the observed order of the declared one, marked where it is low."""
    order: Order | None = next((of[name] for of in one.orders.values() if name in of), None)
    if order is None or (math.isnan(order.value) and not order.exponential):
        return "-"
    return f"{order}{'!' if order.low else ''}"


def _sentences(judgement: Judgement) -> list[str]:
    """Return what differs, what would decide, and runs left out; each sentence once."""
    said = [
        f"{finding.said}: {finding.note}" if finding.note else f"{case} {quantity} {finding.said}"
        for (case, quantity), finding in judgement.by_quantity.items()
        if finding.outcome is not Outcome.REFERENCE
    ]
    said += [f"{case}: {one}" for case, of in judgement.remarks.items() for one in of]
    remarks = [run.remark for one in judgement.histories.values() for run in one.runs if run.remark]
    return list(dict.fromkeys([*said, *remarks]))
