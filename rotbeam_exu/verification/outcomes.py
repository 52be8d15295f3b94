"""Outcomes of the judgement of a code: where it converges to, or why nothing can be said."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import StrEnum

from .convergence import Convergence

LEAST_SHARE = 0.7
"""Least share of the declared order; coarse meshes show 3.0 to 3.9 of an order of four."""


class Outcome(StrEnum):
    """Outcome of one quantity, the best first."""

    REFERENCE = "converges to the reference"
    NOT_SUBMITTED = "not submitted"
    NO_VERDICT = "no verdict"
    ANOTHER_LIMIT = "converges to another limit"
    NO_LIMIT = "does not converge"

    @property
    def passed(self) -> bool | None:
        """True if the code is right; None if it cannot be decided, which is not its fault."""
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
        Why it cannot be decided, or where the code failed.
    tolerance : float
        Largest difference of the limit that passes.
    difference : float
        Of the finest run from the reference: its discretization included.
    """

    outcome: Outcome
    runs: Convergence | None = None
    bound: float = math.nan
    note: str = ""
    tolerance: float = math.nan
    difference: float = math.nan

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


@dataclass(frozen=True, kw_only=True)
class Order:
    """The order of q(t) over the author's own meshes or steps, compared with the declared one.

    It decides nothing: a code is judged by its limit.

    Attributes
    ----------
    value : float
        NaN where it cannot be measured.
    declared : float or None
    why : str
        Why it is not measured.
    """

    value: float
    declared: float | None
    why: str = ""

    @property
    def low(self) -> bool:
        """True where it is less than LEAST_SHARE of the declared one."""
        return self.declared is not None and self.value < LEAST_SHARE * self.declared

    def __str__(self) -> str:
        if math.isnan(self.value):
            return f"not measured: {self.why}"
        return f"{self.value:.1f}" + (f" of {self.declared:g}" if self.declared else "")


def found_of(runs: Convergence, *, tolerance: float, bound: float, where: str) -> Finding:
    """Return the finding of relative differences to a reference that is known within `bound`.

    The uncertainty d is the bar of the limit plus the bound of the reference. A code converges to
    the reference if d is within the tolerance and the limit within tolerance + d: it cannot be told
    apart from a right code. Refining lessens d, so it never fails a code whose true limit is within
    the tolerance. The code converges to another limit if that is farther off; it does not converge
    if changes grow and exceed the tolerance. In between its meshes are too coarse to judge.
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
    return Finding(
        outcome=outcome, runs=runs, bound=bound, note=note, tolerance=tolerance,
        difference=float(runs.values[-1]),
    )  # fmt: skip


def worst_of(findings: list[Finding]) -> Finding:
    """Return the finding that decides: the worst outcome, there the largest model difference."""
    rank = list(Outcome)

    def weight(one: Finding) -> tuple[int, bool, float]:
        known = math.isfinite(one.model_difference)
        return rank.index(one.outcome), not known, abs(one.model_difference) if known else 0.0

    return max(findings, key=weight)
