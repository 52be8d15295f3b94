"""The usual mistakes, looked for in all that was handed in."""

from __future__ import annotations

import warnings
from collections.abc import Collection

import numpy as np

from analytic import SpinUp
from analytic.input_checks import RotbeamWarning

from ..cases import CASES, Asked
from ..history import Histories
from ..judgement import Judgement, ReferenceOf
from ..references import reference as shipped_or_computed
from ..submission import Submission
from .histories import SMALL, mistake_in_history
from .mistake import Mistake
from .ramps import RAMPS
from .tables import mistake_in_backbone, mistake_in_frequencies


def mistakes_in(
    submission: Submission,
    judgement: Judgement,
    *,
    reference_of: ReferenceOf = shipped_or_computed,
) -> list[Mistake]:
    """Return the mistakes that explain large errors, one a case at most.

    Parameters
    ----------
    submission : Submission
    judgement : Judgement
        Of it.
    reference_of : callable
        (case, theory) -> Reference.
    """
    found: list[Mistake] = []
    ramps: Collection[str] = RAMPS
    with warnings.catch_warnings():
        # Of a speed that looks like rpm, which is what is tried.
        warnings.simplefilter("ignore", RotbeamWarning)
        for name in judgement.findings:
            histories = judgement.histories.get(name)
            try:
                if histories is None:
                    one = _in_table(name, submission, reference_of)
                else:
                    one = _in_histories(histories, ramps)
            except (RuntimeError, ValueError):
                continue  # no reference, which the judgement says
            if one is not None:
                found.append(one)
            if one is not None and one.name in RAMPS:
                ramps = (one.name,)  # a code has one ramp in all cases
            elif one is None and histories is not None and _is_off(histories):
                ramps = ()  # tried in vain
    return found


def _in_table(name: str, submission: Submission, reference_of: ReferenceOf) -> Mistake | None:
    case = CASES.get(name)
    if case is None or case.asked is Asked.HISTORY:
        return None
    reference = reference_of(case, submission.declaration.theory)
    if case.asked is Asked.FREQUENCIES:
        return mistake_in_frequencies(case, submission.frequencies, reference)
    return mistake_in_backbone(case, submission.backbone, reference)


def _in_histories(histories: Histories, ramps: Collection[str]) -> Mistake | None:
    finest, true = histories.rows.finest, histories.reference.history
    return mistake_in_history(histories.case, finest.time, finest.q, true, ramps)


def _is_off(histories: Histories) -> bool:
    off = np.abs(histories.differences[histories.rows.finest]).max() > SMALL
    return bool(off) and isinstance(histories.case.motion, SpinUp)
