"""The usual mistakes: before a large error is judged, what explains it is searched.

A mistake explains an error if the reference with this mistake leaves at most a fifth of it, and a
third of what passes beyond the finest run's own error. A new one is a line or a function in
`histories` or `tables`.
"""

from __future__ import annotations

import warnings
from collections.abc import Collection
from dataclasses import replace

import numpy as np

from analytic.input_checks import RotbeamWarning
from analytic.theory import Theory
from analytic.threads import one_thread

from ..case import Asked, Case
from ..cases import CASES
from ..judgement import THRESHOLDS, Judgement, Progress, judged
from ..outcomes import Finding, Outcome
from ..references import reference
from ..submission import Submission
from .histories import RAMPS, SMALL, Mistake, largest, mistake_in_history
from .tables import mistake_in_table


@one_thread
def mistakes_in(
    submission: Submission, judgement: Judgement, progress: Progress | None = None
) -> list[Mistake]:
    """Return the mistakes that explain large errors of a submission, one a case at most."""
    mistakes: list[Mistake] = []
    ramps: Collection[str] = RAMPS
    with warnings.catch_warnings():
        # Of a speed that looks like rpm, which is what is tried.
        warnings.simplefilter("ignore", RotbeamWarning)
        for done, name in enumerate(judgement.findings):
            if progress is not None:
                progress(name, done, len(judgement.findings))
            case, histories = CASES[name], judgement.histories.get(name)
            quantity, finding = next(iter(judgement.findings[name].items()))
            if finding.outcome is Outcome.REFERENCE:
                continue
            most = most_left(THRESHOLDS[quantity], finding)
            try:
                mistake = _in_tags(case, submission, judgement)
                if mistake is None and histories is not None:
                    run = histories.finest
                    true = histories.reference.history(run.time)
                    mistake = mistake_in_history(case, run.time, run.q, true, ramps, most, run.step)
                elif mistake is None and case.asked is not Asked.HISTORY:
                    truth = reference(case, submission.declaration.theory)
                    mistake = mistake_in_table(case, submission.rows, truth, most)
            except (RuntimeError, ValueError):
                continue  # no reference, which the judgement says
            if mistake is not None:
                mistakes.append(mistake)
                if mistake.name in RAMPS:
                    ramps = (mistake.name,)  # a code has one ramp in all cases
            elif histories and case.is_spun_up and case.is_quick:
                off = largest(histories.differences[histories.finest]) > SMALL
                ramps = () if off else ramps  # tried in vain
    return mistakes


def most_left(tolerance: float, finding: Finding) -> float:
    """Return what a mistake may leave: a third of what passes, and the finest run's own error.

    That error is known where meshes and steps have a limit; more than passes is not excused.
    """
    runs = finding.runs
    error = abs(float(runs.errors[-1])) if runs is not None and np.isfinite(runs.limit) else 0.0
    return tolerance / 3.0 + min(error, tolerance)


def _in_tags(case: Case, submission: Submission, judgement: Judgement) -> Mistake | None:
    """Return that tags do not fit, where the results are better those of another theory.

    Of the theories whose references are shipped; slender beams are alike by all of them.
    """
    mine, ranks = submission.declaration, list(Outcome)
    if judgement.outcome_of(case.name) not in (Outcome.AGREES, Outcome.DIFFERS):
        return None
    findings = {}
    for theory in case.theories:
        if case.theory_of(theory) != case.theory_of(mine.theory):
            other = replace(submission, declaration=replace(mine, theory=theory))
            (quantities,) = judged(other, cases={case.name: case}).findings.values()
            findings[theory] = next(iter(quantities.values()))

    def rank(theory: Theory) -> int:
        return ranks.index(findings[theory].outcome)

    best = min(findings, key=rank, default=None)
    if best is None or rank(best) >= ranks.index(judgement.outcome_of(case.name)):
        return None
    before = next(iter(judgement.findings[case.name].values()))
    said = f"the results are those of {_tagged(best)}, the tags say {_tagged(mine.theory)}"
    return Mistake(
        case=case.name, name="tags",
        said=f"{said}: correct the tags of entry.toml, or the element",
        before=abs(before.model_difference), after=abs(findings[best].model_difference),
    )  # fmt: skip


def _tagged(theory: Theory) -> str:
    """Return a theory by its name and its rotary inertia."""
    turns = theory.shear is not None and theory.rotary_inertia
    return f"{theory.name} with rotary inertia" if turns else theory.name
