"""What can be said of a code: where it converges to, or why nothing can be said."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import StrEnum

from .convergence import Convergence


class Outcome(StrEnum):
    """What is found of one quantity, the best first."""

    REFERENCE = "converges to the reference"
    NOT_SUBMITTED = "not submitted"
    NO_VERDICT = "no verdict"
    ANOTHER_LIMIT = "converges to another limit"
    NO_LIMIT = "does not converge"

    @property
    def passed(self) -> bool | None:
        """Whether the code is right; None where it cannot be said, which is not its fault."""
        if self in (Outcome.NOT_SUBMITTED, Outcome.NO_VERDICT):
            return None
        return self is Outcome.REFERENCE


@dataclass(frozen=True, kw_only=True)
class Finding:
    """The outcome of one quantity, and the figures that it rests on.

    Attributes
    ----------
    outcome : Outcome
    runs : Convergence or None
        Of the relative differences to the reference, value/reference - 1.
    bound : float
        Relative error of the reference itself.
    note : str
        Why there is no verdict, or where the code failed.
    """

    outcome: Outcome
    runs: Convergence | None = None
    bound: float = math.nan
    note: str = ""

    @property
    def model_difference(self) -> float:
        """Limit over reference, less one; NaN where there is no limit."""
        return math.nan if self.runs is None else self.runs.limit

    def __str__(self) -> str:
        if self.runs is None or math.isnan(self.runs.limit):
            return f"{self.outcome}: {self.note}" if self.note else str(self.outcome)
        runs = self.runs
        order = f"order {runs.order:.1f}" if math.isfinite(runs.order) else f"no order: {runs.why}"
        text = (
            f"{self.outcome}: model difference {runs.limit:+.1e} ± {runs.bar:.0e}, discretization "
            f"{runs.errors[-1]:+.1e} on the finest mesh, {order}; floor {runs.noise[-1]:.0e}, "
            f"reference ± {self.bound:.0e}"
        )
        return f"{text}; {self.note}" if self.note else text


def found_of(runs: Convergence, *, tolerance: float, bound: float, where: str) -> Finding:
    """Return the finding of relative differences to a reference that is known within `bound`.

    With the doubt d, the bar of the limit and the bound of the reference, a code converges to the
    reference where d is within the tolerance and the limit within tolerance + d: it cannot be told
    apart from one that is right. So refining, which lessens d, never takes that away from a code
    whose true limit is within the tolerance. It converges to another limit where that is farther
    off; where changes grow and exceed the tolerance it does not converge. In between meshes are
    too coarse for a verdict.
    """
    doubt, difference, note = runs.bar + bound, abs(runs.limit), ""
    if math.isnan(difference):
        outcome, note = Outcome.NO_VERDICT, f"one run has no limit, {where}"
    elif not runs.settles and doubt > tolerance:
        outcome, note = Outcome.NO_LIMIT, f"{runs.why}, {where}"
    elif difference > tolerance + doubt:
        outcome = Outcome.ANOTHER_LIMIT
        note = f"the limit differs from the reference by {runs.limit:+.1e} {where}"
    elif doubt <= tolerance:
        outcome = Outcome.REFERENCE
    else:
        outcome = Outcome.NO_VERDICT
        note = f"the limit is known to {doubt:.0e} only {where}: refine"
    return Finding(outcome=outcome, runs=runs, bound=bound, note=note)


def worst_of(findings: list[Finding]) -> Finding:
    """Return the finding that decides: the worst outcome, there the largest model difference."""
    rank = list(Outcome)

    def weight(one: Finding) -> tuple[int, bool, float]:
        known = math.isfinite(one.model_difference)
        return rank.index(one.outcome), not known, abs(one.model_difference) if known else 0.0

    return max(findings, key=weight)
