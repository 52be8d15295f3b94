"""The judgement of a submission by stated thresholds, per case and quantity."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Mapping
from dataclasses import dataclass

from analytic import AnyBlade

from .cases import CASES, Asked, Case
from .convergence import Convergence, convergence
from .history import Histories
from .outcomes import Finding, Order, Outcome, found_of, worst_of
from .references import Reference, reference
from .submission import BackbonePoint, Declaration, Frequency, Submission

THRESHOLDS = {
    "linear frequency": 2e-4,
    "history": 1e-2,
    "amplitude": 1e-2,
    "nonlinear shift": 5e-2,
    "backbone": 5e-2,
}
"""Largest relative difference of the limit from the reference that passes.

ω_n: a larger error moves ω_NL by a tenth of the least nonlinear shift in the paper, 2e-3 at 2
rad/s. Theories of small strain and thin beams differ by less, shear by 8e-5 here. The history q(t),
over max|q|: a frequency that is off by 2e-4 drifts by 1e-2 in twelve seconds, 45 rad. The nonlinear
shift and backbones: the best third-order model is off by 6 % at a = 0.4.
"""

FLOOR = 1e-7
"""Relative round-off of a mesh's frequency: 1e-8 to 1e-7 of 64 to 128 elements, axial modes being
10⁸ times stiffer."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Judgement:
    """The result of `judged`.

    Attributes
    ----------
    declaration : Declaration
    findings : dict
        By name of the case, and in it by quantity, a key of THRESHOLDS.
    orders : dict
        By name of the case, and in it of "mesh" and "step": of q(t).
    histories : dict
        By name of the case, the judged runs, their differences from the reference, and the scale.
    sources : dict
        By name of the case, the reference that was used.
    """

    declaration: Declaration
    findings: dict[str, dict[str, Finding]]
    orders: dict[str, dict[str, Order]]
    histories: dict[str, Histories]
    sources: dict[str, str]

    @property
    def by_quantity(self) -> dict[tuple[str, str], Finding]:
        """Findings by case and quantity."""
        return {
            (case, quantity): finding
            for case, quantities in self.findings.items()
            for quantity, finding in quantities.items()
        }

    def outcome_of(self, case: str) -> Outcome:
        """Return the worst outcome of a case."""
        found = list(self.findings.get(case, {}).values())
        return worst_of(found).outcome if found else Outcome.NOT_SUBMITTED

    @property
    def passed(self) -> bool:
        """True where something was submitted, and all that can be decided is the reference."""
        outcomes = [found.outcome.passed for found in self.by_quantity.values()]
        decided = [passed for passed in outcomes if passed is not None]
        return bool(decided) and all(decided)

    @property
    def outcome(self) -> str:
        """One line: the worst outcome over all cases, and where it was found."""
        by_outcome: dict[Outcome, list[str]] = {}
        for case in self.findings:
            by_outcome.setdefault(self.outcome_of(case), []).append(case)
        order = [one for one in reversed(Outcome) if one is not Outcome.NOT_SUBMITTED]
        said = [f"{one} ({', '.join(by_outcome[one])})" for one in order if one in by_outcome]
        return "; ".join(said) or str(Outcome.NOT_SUBMITTED)

    def __str__(self) -> str:
        lines = [f"{self.declaration.code}: {self.outcome}"]
        for (case, quantity), found in self.by_quantity.items():
            allowed = f" (at most {THRESHOLDS[quantity]:g})"
            lines.append(f"  {case:<5}{quantity:<18}{found}{allowed}")
        for case, orders in self.orders.items():
            lines += [f"  {case:<5}order in {name:<9}{order}" for name, order in orders.items()]
        return "\n".join(lines)


def judged(
    submission: Submission,
    *,
    cases: dict[str, Case] | None = None,
) -> Judgement:
    """Judge a submission by the limits to which it converges.

    Parameters
    ----------
    submission : Submission
    cases : dict, optional
        By name; those of the benchmark by default. Cases that were not submitted are left out.

    Returns
    -------
    Judgement
        If the reference or the estimator fails, the outcome is "no verdict", and the note of the
        finding says why; a code that fails has its own sentence there.

    Examples
    --------
    >>> from rotbeam_exu.fem.elements import Cable
    >>> from rotbeam_exu.verification.cases import CASES
    >>> from rotbeam_exu.verification.entries import formulation_entry
    >>> from rotbeam_exu.verification.judgement import judged
    >>> from rotbeam_exu.verification.verify import handed_in
    >>> linear = {"L": CASES["L"]}
    >>> found = judged(handed_in(formulation_entry(Cable()), linear.values()), cases=linear)
    >>> print(found.outcome, found.passed)
    converges to the reference (L) True
    """
    known = CASES if cases is None else cases
    findings: dict[str, dict[str, Finding]] = {}
    orders: dict[str, dict[str, Order]] = {}
    histories: dict[str, Histories] = {}
    sources: dict[str, str] = {}
    linear: dict[float, Convergence] = {}
    blade: AnyBlade | None = None
    # Frequencies come first: what they tend to is taken from the nonlinear ones.
    for case in sorted(known.values(), key=lambda one: list(Asked).index(one.asked)):
        name = case.name
        if not submission.has(case):
            continue
        orders[name], sources[name] = {}, "none"
        try:
            truth = reference(case, submission.declaration.theory)
        except (RuntimeError, ValueError) as error:
            nothing = Finding(outcome=Outcome.NO_VERDICT, note=f"no reference: {error}")
            findings[name] = dict.fromkeys(case.quantities, nothing)
            continue
        sources[name] = truth.source
        own = linear if case.blade == blade else dict[float, Convergence]()
        if case.asked is Asked.FREQUENCIES:
            (quantity,), blade = case.quantities, case.blade
            found, linear = _linear_frequency(submission, truth, THRESHOLDS[quantity])
            findings[name] = {quantity: found}
        elif case.asked is Asked.BACKBONE:
            (quantity,) = case.quantities
            found = _backbone(submission, truth, THRESHOLDS[quantity], own)
            findings[name] = {quantity: found}
        else:
            seen = _histories(submission, truth)
            if isinstance(seen, Finding):
                findings[name] = dict.fromkeys(case.quantities, seen)
            else:
                histories[name] = seen
                findings[name], orders[name] = _of_histories(seen, own)
    names = [name for name in known if name in findings]
    return Judgement(
        declaration=submission.declaration,
        findings={name: findings[name] for name in names},
        orders={name: orders[name] for name in names},
        histories={name: histories[name] for name in names if name in histories},
        sources={name: sources[name] for name in names},
    )


def _histories(submission: Submission, truth: Reference) -> Histories | Finding:
    """Return the runs of a case; a code cannot do a case that it refuses on its finest mesh."""
    runs = [run for run in submission.runs if run.case == truth.case.name]
    finest = max(runs, key=lambda run: (run.elements, -run.step))
    if finest.failure:
        return Finding(outcome=Outcome.NO_LIMIT, note=finest.failure)
    return Histories(
        case=truth.case,
        runs=tuple(run for run in runs if not run.failure),
        reference=truth,
        declaration=submission.declaration,
    )


def _of_histories(
    seen: Histories, linear: Mapping[float, Convergence]
) -> tuple[dict[str, Finding], dict[str, Order]]:
    """Return the findings on the runs of a case, by quantity, and their orders."""
    history, orders = seen.deflection(THRESHOLDS["history"])
    findings = {"history": history}
    if seen.case.oscillates:
        findings["amplitude"] = seen.amplitude(THRESHOLDS["amplitude"])
        own = linear.get(seen.case.rotation.omega)
        shift = seen.shift(THRESHOLDS["nonlinear shift"], own)
        findings |= {} if shift is None else {"nonlinear shift": shift}
    return findings, orders


def _linear_frequency(
    submission: Submission, reference: Reference, tolerance: float
) -> tuple[Finding, dict[float, Convergence]]:
    """Return the worst finding of the first frequency over the speeds, and its limits by speed.

    They are of ω_n over the reference, less one. A coarse mesh that the code refuses is left out;
    the finest says that it does not converge. A speed that the theory refuses is no verdict.
    """
    rows: dict[float, list[Frequency]] = defaultdict(list)
    for one in sorted(submission.frequencies, key=lambda one: (one.speed, one.elements)):
        rows[one.speed].append(one)
    if not rows:
        return Finding(outcome=Outcome.NOT_SUBMITTED, note="no frequencies"), {}

    def finding(speed: float) -> Finding:
        try:
            true = reference.first_frequency(speed)
        except ValueError as error:
            return Finding(outcome=Outcome.NO_VERDICT, note=f"no reference: {error}")
        if rows[speed][-1].failure:
            return Finding(outcome=Outcome.NO_LIMIT, note=rows[speed][-1].failure)
        done = [one for one in rows[speed] if not one.failure]
        values = [one.frequency / true - 1.0 for one in done]
        sizes, declared = [1.0 / one.elements for one in done], submission.declaration.order
        runs = convergence(sizes, values, noise=FLOOR, declared=declared)
        where = f"at {speed:g} rad/s"
        return found_of(runs, tolerance=tolerance, bound=reference.bound, where=where)

    found = {speed: finding(speed) for speed in rows}
    runs = {speed: one.runs for speed, one in found.items() if one.runs is not None}
    limits = {speed: one for speed, one in runs.items() if math.isfinite(one.limit)}
    return worst_of(list(found.values())), limits


def _backbone(
    submission: Submission,
    reference: Reference,
    tolerance: float,
    linear: Mapping[float, Convergence],
) -> Finding:
    """Return the worst finding of ω_NL/ω_n - 1 over speeds and amplitudes.

    `linear` is, by speed, the limit of the code's ω_n/ω_n,exact - 1; without it ω_n is exact.
    """
    rows: dict[tuple[float, float], list[BackbonePoint]] = defaultdict(list)
    for point in submission.backbone:
        rows[point.speed, point.amplitude].append(point)
    found, declared = [], submission.declaration.order
    for (speed, amplitude), points in rows.items():
        where = f"at {speed:g} rad/s and a = {amplitude:g}"
        try:
            true = reference.frequency_at(amplitude, speed)
            shift = true / reference.first_frequency(speed) - 1.0
        except (RuntimeError, ValueError) as error:
            note = f"no reference {where}: {error}"
            found.append(Finding(outcome=Outcome.NO_VERDICT, note=note))
            continue
        off, doubt = (linear[speed].limit, linear[speed].bar) if speed in linear else (0.0, 0.0)
        values = [(point.frequency / true - 1.0 - off) / shift for point in points]
        runs = convergence([1.0 / one.elements for one in points], values, declared=declared)
        bound = (reference.bound + doubt) / abs(shift)
        found.append(found_of(runs, tolerance=tolerance, bound=bound, where=where))
    return worst_of(found)
