"""A judgment as a JSON document; docs/howto/judge.md says what each key means."""

from __future__ import annotations

import dataclasses
import math
import platform
from collections.abc import Mapping
from datetime import UTC, datetime
from importlib.metadata import version
from typing import Any

import numpy as np

from ..verification.cases import CASES, VERSION
from ..verification.convergence import Order
from ..verification.judgement import Judgement
from ..verification.mistakes.histories import Mistake
from ..verification.outcomes import Finding
from ..verification.submission import Run, Submission
from ..verification.submission_files.faults import Fault

SCHEMA = "rotbeam judgement 2"
"""Its number grows where a key goes, or means something else."""


def versions() -> dict[str, str]:
    """Return the versions of what judges, by name."""
    ours = {"rotbeam_exu": version("rotbeam-exu"), "python": platform.python_version()}
    return ours | {name: version(name) for name in ("numpy", "scipy")}


@dataclasses.dataclass(frozen=True, kw_only=True, eq=False)
class Record:
    """A judgment with all that a reader needs to repeat it.

    Attributes
    ----------
    submission : Submission
    judgement : Judgement
        Of it, or of some of its cases.
    mistakes : tuple of Mistake
    digests : mapping
        SHA-256 by file.
    faults : tuple of Fault
        Of files that are not judged.
    date : datetime
        Of the judgment.
    """

    submission: Submission
    judgement: Judgement
    mistakes: tuple[Mistake, ...] = ()
    digests: Mapping[str, str] = dataclasses.field(default_factory=dict)
    faults: tuple[Fault, ...] = ()
    date: datetime = dataclasses.field(default_factory=lambda: datetime.now(UTC))

    @property
    def name(self) -> str:
        """Code and version."""
        return f"{self.judgement.declaration.code} {self.judgement.declaration.version}".strip()


def document(record: Record) -> dict[str, object]:
    """Return the submission, the findings and the versions; unknown numbers are None."""
    judgement = record.judgement
    made: dict[str, object] = _plain(
        {
            "schema": SCHEMA,
            "benchmark": VERSION,
            "self_judged": True,
            "date": record.date.isoformat(timespec="seconds"),
            "versions": versions(),
            "declaration": dataclasses.asdict(judgement.declaration),
            "outcome": judgement.outcome,
            "passed": judgement.passed,
            "mistakes": [dataclasses.asdict(one) for one in record.mistakes],
            "faults": [dataclasses.asdict(one) for one in record.faults],
            "cases": {name: _case(name, record) for name in judgement.findings},
            "files": dict(record.digests),
        }
    )
    return made


def _case(name: str, record: Record) -> dict[str, object]:
    judgement = record.judgement
    return {
        "title": CASES[name].title if name in CASES else name,
        "outcome": str(judgement.outcome_of(name)),
        "reference": judgement.sources.get(name, ""),
        "quantities": {key: _finding(one) for key, one in judgement.findings[name].items()},
        "remarks": judgement.remarks.get(name, []),
        "runs": [_run(run, judgement) for run in record.submission.runs if run.case == name],
    }


def _finding(finding: Finding) -> dict[str, object]:
    runs = finding.runs
    return {
        "outcome": str(finding.outcome),
        "passed": finding.outcome.passed,
        "within": finding.within,
        "note": finding.note,
        "at_most": finding.tolerance,
        "model_difference": finding.model_difference,
        "bar": runs.bar if runs else None,
        "difference_of_finest": finding.difference,
        "discretization": runs.errors[-1] if runs else None,
        "floor": runs.noise[-1] if runs else None,
        "reference_bound": finding.bound,
        "orders": {key: _order(one) for key, one in runs.orders.items()} if runs else {},
        "elements": runs.elements if runs else [],
        "steps": runs.steps if runs else [],
        "values": runs.values if runs else [],
        "errors": runs.errors if runs else [],
    }


def _order(order: Order) -> dict[str, object]:
    return {
        "observed": order.value,
        "bar": order.bar,
        "declared": order.declared,
        "low": order.low,
        "why": order.why,
    }


def _run(run: Run, judgement: Judgement) -> dict[str, object]:
    histories = judgement.histories.get(run.case)
    differences = histories.differences.get(run) if histories else None
    return {
        "file": run.file,
        "elements": run.elements,
        "step": run.step,
        "tolerance": run.tolerance,
        "dof": run.dof,
        "wall_s": run.wall,
        "cpu_s": run.cpu,
        "difference": None if differences is None else np.abs(differences).max(),
        "failure": run.failure,
        "remark": run.remark,
    }


def _plain(value: object) -> Any:
    """Return what JSON has: no arrays, no NaN, no infinity."""
    if isinstance(value, dict):
        return {str(key): _plain(one) for key, one in value.items()}
    if isinstance(value, (list, tuple, np.ndarray)):
        return [_plain(one) for one in value]
    if isinstance(value, np.generic):
        return _plain(value.item())
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value
