"""The judgement of what a code handed in, by stated thresholds: per case and quantity."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from analytic import AnyBlade, Theory

from .backbone import backbone
from .cases import CASES, Asked, Case
from .convergence import Convergence
from .history import Histories
from .linear_frequency import linear_frequency
from .outcomes import Finding, Order, Outcome, worst_of
from .references import Reference
from .references import reference as shipped_or_computed
from .submission import Declaration, Submission

THRESHOLDS = {
    "linear frequency": 2e-4,
    "history": 1e-2,
    "amplitude": 1e-2,
    "nonlinear shift": 5e-2,
    "backbone": 5e-2,
}
"""Largest relative difference of the limit from the reference that passes.

Of ω_n, what is off by more moves ω_NL by a tenth of the least nonlinear shift that the paper shows,
2e-3 at 2 rad/s; theories of small strain and thin beams differ by less, shear by 8e-5 here. Of
q(t), over max|q|: a frequency that is off by 2e-4 drifts by 1e-2 in twelve seconds, 45 rad. Of
ω_NL/ω_n - 1 and of backbones: the best third-order model is off by 6 % at a = 0.4.
"""

ReferenceOf = Callable[[Case, Theory], Reference]


@dataclass(frozen=True, kw_only=True, eq=False)
class Judgement:
    """What `judged` found.

    Attributes
    ----------
    declaration : Declaration
    findings : dict
        By name of the case, and in it by quantity, a key of THRESHOLDS.
    orders : dict
        By name of the case, and in it of "mesh" and "step": of q(t).
    histories : dict
        By name of the case, what was judged: runs, differences from the reference, scale.
    sources : dict
        By name of the case, which reference was used.
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
        """Whether something was submitted, and all that can be decided is the reference."""
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
    reference_of: ReferenceOf = shipped_or_computed,
) -> Judgement:
    """Judge what a code handed in by where it converges to.

    Parameters
    ----------
    submission : Submission
    cases : dict, optional
        By name; those of the benchmark by default. What was not submitted of them is left out.
    reference_of : callable
        (case, theory) -> Reference.

    Returns
    -------
    Judgement
        Where the reference, or what measures it, fails, there is no verdict, and the note of the
        finding says why; a code that fails has its own sentence there.

    Examples
    --------
    >>> from rotbeam_exu.fem.elements import Cable
    >>> from rotbeam_exu.verification.cases import CASES
    >>> from rotbeam_exu.verification.entries import formulation_entry
    >>> from rotbeam_exu.verification.judgement import judged
    >>> from rotbeam_exu.verification.measures import handed_in
    >>> linear = {"L": CASES["L"]}
    >>> found = judged(handed_in(formulation_entry(Cable()), linear.values()), cases=linear)
    >>> print(found.outcome, found.passed)
    converges to the reference (L) True
    """
    known = CASES if cases is None else cases
    found: dict[str, _Judged] = {}
    linear: dict[float, Convergence] = {}
    blade: AnyBlade | None = None
    # Frequencies come first: what they tend to is taken from the nonlinear ones.
    for case in sorted(known.values(), key=lambda one: list(Asked).index(one.asked)):
        if not _handed_in(submission, case):
            continue
        try:
            reference = reference_of(case, submission.declaration.theory)
        except (RuntimeError, ValueError) as error:
            note = f"no reference: {error}"
            nothing = Finding(outcome=Outcome.NO_VERDICT, note=note)
            found[case.name] = _Judged(findings=dict.fromkeys(_quantities(case), nothing))
            continue
        own = linear if case.blade == blade else dict[float, Convergence]()
        if case.asked is Asked.FREQUENCIES:
            finding, linear = linear_frequency(
                submission, reference, THRESHOLDS["linear frequency"]
            )
            found[case.name], blade = _Judged(findings={"linear frequency": finding}), case.blade
        elif case.asked is Asked.BACKBONE:
            finding = backbone(submission, reference, THRESHOLDS["backbone"], own)
            found[case.name] = _Judged(findings={"backbone": finding})
        else:
            found[case.name] = _of_history(submission, reference, own)
        found[case.name].source = reference.source
    in_order = {name: found[name] for name in known if name in found}
    return Judgement(
        declaration=submission.declaration,
        findings={name: one.findings for name, one in in_order.items()},
        orders={name: one.orders for name, one in in_order.items()},
        histories={name: one.histories for name, one in in_order.items() if one.histories},
        sources={name: one.source for name, one in in_order.items()},
    )


@dataclass(kw_only=True)
class _Judged:
    findings: dict[str, Finding]
    orders: dict[str, Order] = field(default_factory=dict)
    histories: Histories | None = None
    source: str = "none"


def _handed_in(submission: Submission, case: Case) -> bool:
    if case.asked is Asked.FREQUENCIES:
        return bool(submission.frequencies)
    if case.asked is Asked.BACKBONE:
        return bool(submission.backbone)
    return any(run.case == case.name for run in submission.runs)


def _quantities(case: Case) -> tuple[str, ...]:
    if case.asked is Asked.FREQUENCIES:
        return ("linear frequency",)
    if case.asked is Asked.BACKBONE:
        return ("backbone",)
    return ("history", "amplitude", "nonlinear shift") if case.oscillates else ("history",)


def _of_history(
    submission: Submission, reference: Reference, linear: Mapping[float, Convergence]
) -> _Judged:
    """Judge the runs of a case; what the code refuses on its finest mesh, it cannot do."""
    case = reference.case
    runs = [run for run in submission.runs if run.case == case.name]
    finest = max(runs, key=lambda run: (run.elements, -run.step))
    if finest.failure:
        nothing = Finding(outcome=Outcome.NO_LIMIT, note=finest.failure)
        return _Judged(findings=dict.fromkeys(_quantities(case), nothing))
    histories = Histories(
        case=case,
        runs=tuple(run for run in runs if not run.failure),
        reference=reference,
        declaration=submission.declaration,
    )
    history, orders = histories.deflection(THRESHOLDS["history"])
    findings = {"history": history}
    if case.oscillates and case.motion is not None:
        own = linear.get(case.motion.omega)
        findings["amplitude"] = histories.amplitude(THRESHOLDS["amplitude"])
        shift = histories.shift(THRESHOLDS["nonlinear shift"], own)
        findings |= {} if shift is None else {"nonlinear shift": shift}
    return _Judged(findings=findings, orders=orders, histories=histories)
