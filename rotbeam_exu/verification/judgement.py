"""The judgment of a submission by stated thresholds, per case and quantity."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass

from analytic import Blade
from analytic.threads import one_thread

from .case import Asked, Case
from .cases import CASES
from .convergence import Convergence, Order, converged
from .history import Histories, judged_apart, mending
from .outcomes import Finding, Outcome, finding_of, worst_of
from .references import Reference, reference
from .space_cases import TIP
from .submission import Declaration, Row, Submission

THRESHOLDS = {
    "linear frequency": 2e-4,
    "frequencies": 2e-3,
    "steady deflection": 1e-3,
    "history": 1e-2,
    "amplitude": 1e-2,
    "nonlinear shift": 5e-2,
    "backbone": 5e-2,
}
"""Largest relative difference of the limit from the reference that passes.

ω_n: a larger error moves ω_NL by a tenth of the least nonlinear shift in the paper, 2e-3 at 2
rad/s. Theories of small strain and thin beams differ by less, shear by 8e-5 here. The history q(t),
over max|q|: a frequency that is off by 2e-4 drifts by 1e-2 in twelve seconds, 45 rad. The nonlinear
shift and backbones: the best third-order model is off by 6 % at a = 0.4. Frequencies of
a blade in space by number: shear is worth twice as much in the sixth. In a steady deflection
nothing drifts: a tenth of q(t)'s.
"""

HARDER = "nonlinear shift"
"""Quantity that is judged behind q(t): order two wants 128 elements for it where 32 do for q(t)."""

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
    histories : dict
        By name of the case, the judged runs, their differences from the reference, and the scale.
    sources : dict
        By name of the case, the reference that was used.
    remarks : dict
        By name of the case, a sentence on each run that failed or is a copy, which is not judged,
        on how much the integrator damps, and on each order that is lower than declared.
    asked : tuple of str
        All cases that might have been submitted.
    """

    declaration: Declaration
    findings: dict[str, dict[str, Finding]]
    histories: dict[str, Histories]
    sources: dict[str, str]
    remarks: dict[str, list[str]]
    asked: tuple[str, ...]

    @property
    def orders(self) -> dict[str, dict[str, Order]]:
        """By name of the case, and in it of "mesh" and "step", the orders of q(t)."""
        return {
            case: of["history"].runs.orders
            for case, of in self.findings.items()
            if "history" in of and of["history"].runs is not None
        }

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
        findings = list(self.findings.get(case, {}).values())
        return worst_of(findings).outcome if findings else Outcome.NOT_SUBMITTED

    @property
    def passed(self) -> bool | None:
        """True where all that was submitted is decided and right, False where something differs.

        None where something is undecided, or nothing submitted: a code that is too coarse to be
        judged does not pass.
        """
        passed = {self.outcome_of(case).passed for case in self.findings} or {None}
        return False if False in passed else None if None in passed else True

    @property
    def outcome(self) -> str:
        """One line: of all cases how many agree, and which are undecided or differ.

        An undecided nonlinear shift, the harder demand, is stated behind the cases.
        """
        by_outcome: dict[bool | None, list[str]] = {True: [], None: [], False: []}
        shifts = []
        for case, of in self.findings.items():
            passed = self.outcome_of(case).passed
            others = [one for name, one in of.items() if name != HARDER]
            if passed is None and worst_of(others).outcome.passed:
                passed = True
                shifts.append(case)
            by_outcome[passed].append(case)
        right, missing = len(by_outcome[True]), len(self.asked) - len(self.findings)
        said = [f"{right} of {len(self.asked)} {'agrees' if right == 1 else 'agree'}"]
        for passed, word in ((None, "undecided"), (False, "differ")):
            if cases := by_outcome[passed]:
                verb = "differs" if passed is False and len(cases) == 1 else word
                said.append(f"{len(cases)} {verb} ({', '.join(cases)})")
        said += [f"{missing} not submitted"] * bool(missing)
        behind = f"; the shift is undecided in {', '.join(shifts)}" if shifts else ""
        return ", ".join(said) + behind

    def __str__(self) -> str:
        lines = [f"{self.declaration.code}: {self.outcome}"]
        for (case, quantity), finding in self.by_quantity.items():
            allowed = f" (at most {THRESHOLDS[quantity]:g})"
            lines.append(f"  {case:<5}{quantity:<18}{finding}{allowed}")
        for case, orders in self.orders.items():
            lines += [f"  {case:<5}order in {name:<9}{order}" for name, order in orders.items()]
        lines += [f"  {case:<5}{said}" for case, of in self.remarks.items() for said in of]
        return "\n".join(lines)


Progress = Callable[[str, int, int], None]
"""Called with the name of a case, how many were done before it, and their number."""


@one_thread
def judged(
    submission: Submission,
    *,
    cases: dict[str, Case] | None = None,
    only: Collection[str] = (),
    progress: Progress | None = None,
) -> Judgement:
    """Judge a submission by the limits to which it converges.

    Parameters
    ----------
    submission : Submission
    cases : dict, optional
        By name; those of the benchmark by default. Cases that were not submitted are left out.
    only : collection of str, optional
        Names of the cases to judge, all by default. Frequencies serve the shifts of the others.
    progress : callable, optional
        See `Progress`.

    Returns
    -------
    Judgement
        If the reference or the estimator fails, the outcome is "undecided", and the note of the
        finding says why. A run that failed is reported and not judged.

    Examples
    --------
    >>> from rotbeam_exu.fem.elements import Cable
    >>> from rotbeam_exu.verification.cases import CASES
    >>> from rotbeam_exu.verification.entries import formulation_entry
    >>> from rotbeam_exu.verification.judgement import judged
    >>> from rotbeam_exu.verification.verify import submission_of
    >>> linear = {"L": CASES["L"]}
    >>> found = judged(submission_of(formulation_entry(Cable()), linear.values()), cases=linear)
    >>> print(found.outcome, found.passed)
    1 of 1 agrees True
    """
    all_cases = CASES if cases is None else cases
    findings: dict[str, dict[str, Finding]] = {}
    histories: dict[str, Histories] = {}
    sources: dict[str, str] = {}
    remarks: dict[str, list[str]] = {}
    linear: dict[Blade, dict[float, Convergence]] = defaultdict(dict)
    # Frequencies come first: what they tend to is taken from the nonlinear ones.
    chosen = [
        case
        for case in sorted(all_cases.values(), key=lambda one: list(Asked).index(one.asked))
        if submission.has(case)
        and (not only or case.name in only or case.asked is Asked.FREQUENCIES)
    ]
    for done, case in enumerate(chosen):
        name = case.name
        if progress is not None:
            progress(name, done, len(chosen))
        try:
            truth = reference(case, submission.declaration.theory)
        except (RuntimeError, ValueError) as error:
            sources[name], findings[name] = "none", _undecided(case, f"no reference: {error}")
            continue
        sources[name] = truth.source
        frequencies = linear[case.blade]
        if case.asked is not Asked.HISTORY:
            (quantity,) = case.quantities
            finding, limits = _of_table(submission, truth, THRESHOLDS[quantity], frequencies)
            findings[name] = {quantity: finding}
            remarks[name] = _missed_orders(finding, quantity)
            frequencies.update(limits if case.asked is Asked.FREQUENCIES else {})
            continue
        handed = [run for run in submission.runs if run.case == name]
        runs, remarks[name] = judged_apart(handed, truth)
        if not runs:
            findings[name] = _undecided(case, f"no run: {remarks[name][-1]}")
            continue
        histories[name] = Histories(
            case=case, runs=tuple(runs), reference=truth, declaration=submission.declaration
        )
        findings[name] = _of_histories(histories[name], frequencies)
        remarks[name] += histories[name].losses if case.oscillates else []
        remarks[name] += _missed_orders(findings[name]["history"], "q(t)")
    required = [name for name in all_cases if not only or name in only]
    names = [name for name in required if name in findings]
    return Judgement(
        declaration=submission.declaration,
        findings={name: findings[name] for name in names},
        histories={name: histories[name] for name in names if name in histories},
        sources={name: sources[name] for name in names},
        remarks={name: remarks[name] for name in names if remarks.get(name)},
        asked=tuple(required),
    )


def _missed_orders(finding: Finding, quantity: str) -> list[str]:
    """Return a sentence on each order that is lower than the declared one."""
    orders = finding.runs.orders if finding.runs is not None else {}
    return [
        f"{quantity} converges in the {name} by order {order.value:.1f}, "
        f"{order.declared:g} is declared: {_LOW[name]}"
        for name, order in orders.items()
        if order.surely_low
    ]


_LOW = {
    "mesh": "look for a mass, a load or a clamp that is of lower order than the element",
    "step": "look for a motion of the clamp or a load that is taken at the wrong end of the step",
}
"""The usual causes of a low order, by what is refined."""


def _undecided(case: Case, note: str) -> dict[str, Finding]:
    return dict.fromkeys(case.quantities, Finding(outcome=Outcome.UNDECIDED, note=note))


def _of_histories(histories: Histories, linear: Mapping[float, Convergence]) -> dict[str, Finding]:
    """Return the findings on the runs of a case, by quantity."""
    findings = {"history": histories.deflection(THRESHOLDS["history"])}
    if histories.case.oscillates:
        findings["amplitude"] = histories.amplitude(THRESHOLDS["amplitude"])
        frequencies = linear.get(histories.case.rotation.omega)
        shift = histories.shift(THRESHOLDS["nonlinear shift"], frequencies)
        findings |= {} if shift is None else {"nonlinear shift": shift}
    return findings


def _of_table(
    submission: Submission,
    reference: Reference,
    tolerance: float,
    linear: Mapping[float, Convergence],
) -> tuple[Finding, dict[float, Convergence]]:
    """Return the worst finding of a table's numbers, and the limits of the first by speed.

    They are of each number over the reference, less one; of a backbone of ω_NL/ω_n - 1, where
    `linear` is, by speed, the limit of the code's ω_n/ω_n,exact - 1, without which ω_n is exact.
    """
    rows: dict[tuple[float, float, int], list[Row]] = defaultdict(list)
    for one in sorted(submission.rows, key=lambda one: one.elements):
        if one.case == reference.case.name:
            rows[one.place].append(one)
    declared, places = submission.declaration.order, []
    limits: dict[float, Convergence] = {}
    for (speed, _, number), of_place in sorted(rows.items(), key=lambda one: one[0]):
        here = _of_place(of_place, reference, tolerance, declared, linear)
        places += here
        runs = here[0].runs
        if number == 1 and runs is not None and math.isfinite(runs.limit):
            limits[speed] = runs
    return worst_of(places), limits


def _of_place(
    rows: list[Row],
    reference: Reference,
    tolerance: float,
    declared: float | None,
    linear: Mapping[float, Convergence],
) -> list[Finding]:
    """Return the findings of the numbers at one place of a table, without meshes that failed.

    A place that the theory refuses is undecided.
    """
    quantity = reference.case.asked
    speed, amplitude, number = rows[0].place
    where, shift, floor, off, doubt = f"at {speed:g} rad/s", 1.0, FLOOR, 0.0, 0.0
    if quantity is Asked.BACKBONE:
        where, floor = f"{where} and a = {amplitude:g}", 0.0
        off, doubt = mending(linear.get(speed))
    try:
        true = reference.numbers(rows[0]).tolist()
        if quantity is Asked.BACKBONE:
            shift = true[0] / reference.first_frequency(speed) - 1.0
    except (RuntimeError, ValueError) as error:
        return [Finding(outcome=Outcome.UNDECIDED, note=f"no reference {where}: {error}")]
    done = [one for one in rows if not one.failure]
    if not done:
        return [Finding(outcome=Outcome.UNDECIDED, note=f"no mesh: {rows[-1].failure}")]
    findings = []
    for k, right in enumerate(true):
        rounding = [one.rounding[k] if one.rounding else 0.0 for one in done]
        runs = converged(
            [one.elements for one in done], None,
            [(one.values[k] / right - 1.0 - off) / shift for one in done],
            noise=[(floor + lost / abs(right)) / abs(shift) for lost in rounding],
            declared=(declared, None),
        )  # fmt: skip
        named = (
            f"in {TIP[k]} "
            if quantity is Asked.STEADY
            else f"in frequency {number} " * (number > 1)
        )
        bound = (reference.bound + doubt) / abs(shift)
        findings.append(finding_of(runs, tolerance=tolerance, bound=bound, where=named + where))
    return findings
