"""Outcomes of the judgment of a code: where its runs tend to, or what would decide it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from .convergence import Convergence

FAR = 100.0
"""Tolerances by which a finest run is far off: of q(t) as much as it swings."""


class Outcome(StrEnum):
    """Outcome of one quantity, the best first."""

    REFERENCE = "converges to the reference"
    AGREES = "agrees"
    NOT_SUBMITTED = "not submitted"
    UNDECIDED = "undecided"
    DIFFERS = "differs"

    @property
    def passed(self) -> bool | None:
        """True if the code is right; None if it cannot be decided, which is not its fault."""
        if self in (Outcome.NOT_SUBMITTED, Outcome.UNDECIDED):
            return None
        return self is not Outcome.DIFFERS


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
        What would decide, or where and how the code differs.
    tolerance : float
        Largest difference of the limit that passes, its uncertainty included.
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

    @property
    def within(self) -> float:
        """How far the limit is from the reference at most; NaN where there is no limit."""
        return math.nan if self.runs is None else abs(self.runs.limit) + self.runs.bar + self.bound

    @property
    def finer(self) -> tuple[int | None, float | None]:
        """Elements and step that would decide; None of what need not be finer, or would not."""
        runs = self.runs
        if self.outcome is not Outcome.UNDECIDED or runs is None or math.isnan(runs.limit):
            return None, None
        return _finer(runs, self.tolerance, self.bound)

    @property
    def said(self) -> str:
        """The outcome in words, with the distance that a code agrees within."""
        within = f" within {self.within:.0e}" if self.outcome is Outcome.AGREES else ""
        return f"{self.outcome}{within}"

    def __str__(self) -> str:
        if self.runs is None or math.isnan(self.runs.limit):
            return f"{self.said}: {self.note}" if self.note else self.said
        runs, order = self.runs, self.runs.orders["mesh"]
        text = (
            f"{self.said}: model difference {runs.limit:+.1e} ± {runs.bar:.0e}, discretization "
            f"{runs.errors[-1]:+.1e} on the finest mesh, order {order}; floor "
            f"{runs.noise[-1]:.0e}, reference ± {self.bound:.0e}"
        )
        return f"{text}; {self.note}" if self.note else text


def finding_of(
    runs: Convergence, *, tolerance: float, bound: float, where: str, of_what: str = "the reference"
) -> Finding:
    """Return the finding of relative differences to a reference that is known within `bound`.

    The uncertainty d is that of the limit plus the bound. A code is right if its limit is within
    tolerance - d: it converges to the reference if the limit is zero within d, else it agrees. It
    differs if the limit is beyond tolerance + d, and does not converge if changes grow twice, or
    once where the finest run is FAR off. In between it is undecided, and the note says which mesh
    or step would decide. Refining lessens d, so it never fails a code whose true limit is within
    the tolerance. With one step only nothing is decided: it may make or hide a difference.
    """
    doubt, difference = runs.bar + bound, abs(runs.limit)
    finest, note = abs(float(runs.values[-1])), ""
    if math.isnan(difference):
        # The second tier, for codes whose mesh is fixed: nothing is extrapolated.
        as_run = f"as run within {finest + bound:.0e} of the reference"
        outcome = Outcome.UNDECIDED
        note = f"{as_run}, but one mesh has no limit {where}: hand in three"
    elif runs.steps.any() and np.unique(runs.steps).size == 1:
        outcome = Outcome.UNDECIDED
        one = f"with one {runs.refined}"
        note = f"{one} its error is in the difference of {runs.limit:+.1e}: refine it"
    elif difference + doubt <= tolerance:
        outcome = Outcome.REFERENCE if difference <= doubt else Outcome.AGREES
    elif runs.growths > 1 or (runs.growths and finest > FAR * tolerance):
        outcome, note = Outcome.DIFFERS, f"does not converge {where}: the changes grow"
    elif difference <= tolerance + doubt:
        outcome = Outcome.UNDECIDED
        note = f"known to {doubt:.0e} only {where}: {_remedy(runs, tolerance, bound, of_what)}"
    else:
        outcome = Outcome.DIFFERS
        note = f"the limit differs from the reference by {runs.limit:+.1e} {where}"
    return Finding(
        outcome=outcome, runs=runs, bound=bound, note=note, tolerance=tolerance,
        difference=float(runs.values[-1]),
    )  # fmt: skip


def _remedy(runs: Convergence, tolerance: float, bound: float, of_what: str) -> str:
    """Return which mesh or step would decide."""
    elements, step = _finer(runs, tolerance, bound)
    if elements is None and step is None:
        return f"{of_what} is known to {bound:.0e} only"
    said = []
    if elements is not None:
        few = np.unique(runs.elements).size < 3
        said.append("a third mesh" if few else f"about {elements} elements")
    if step is not None:
        of = f"{step:.1g}" if runs.refined == "tolerance" else f"{1e3 * step:.1g} ms"
        said.append(f"a {runs.refined} of about {of}")
    return f"{' and '.join(said)} would decide"


def _finer(runs: Convergence, tolerance: float, bound: float) -> tuple[int | None, float | None]:
    """Return the elements and the step that would decide; None of what need not be finer.

    The uncertainty shrinks as the finest run's error does. Both are None where the reference is
    the cause.
    """
    if bound > max(runs.bar, 0.5 * tolerance):
        return None, None
    off = abs(runs.limit)
    room = 0.5 * tolerance if off < tolerance else max(off - tolerance, 0.5 * tolerance)
    factor = max(runs.bar / room, 1.5)
    mesh, step = abs(float(runs.in_mesh[-1])), abs(float(runs.in_step[-1]))
    elements = smallest = None
    # Where errors of a mesh change sign little may be left by chance; what the step cannot account
    # for is still the mesh's.
    if mesh >= 0.3 * step or step < 0.1 * room:
        elements = _rounded(runs.elements[-1] * factor ** (1.0 / runs.powers[0]))
    if step >= max(0.3 * mesh, 0.1 * room) and np.unique(runs.steps).size > 1:
        smallest = float(runs.steps.min()) * factor ** (-1.0 / runs.powers[1])
    return elements, smallest


def _rounded(elements: float) -> int:
    """Return a number of elements of two digits, even."""
    digit = 10.0 ** max(math.floor(math.log10(elements)) - 1, 0)
    return 2 * math.ceil(0.5 * elements / digit) * int(digit)


def worst_of(findings: list[Finding]) -> Finding:
    """Return the finding that decides: the worst outcome, there the largest model difference."""
    rank = list(Outcome)

    def weight(one: Finding) -> tuple[int, bool, float]:
        finite = math.isfinite(one.model_difference)
        return rank.index(one.outcome), not finite, abs(one.model_difference) if finite else 0.0

    return max(findings, key=weight)
