"""Tables of judgements: what codes tend to, what their meshes add, what they are."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence

from rich import box

from ..verification.judgement import THRESHOLDS, Judgement
from ..verification.outcomes import Finding, Order, Outcome
from ..verification.submission import Run
from .output import print_columns, print_note

_SHORT = {
    "linear frequency": "ω_n", "history": "q(t)", "amplitude": "a", "nonlinear shift": "shift",
    "backbone": "shift",
}  # fmt: skip


def print_judgements(found: Sequence[Judgement], about: str) -> None:
    """Print the limits of codes less the reference, their discretization, and the outcomes."""
    keys = list(dict.fromkeys(key for one in found for key in one.by_quantity))
    known = {key: [one.by_quantity[key] for one in found if key in one.by_quantity] for key in keys}
    asked = {
        "quantity": [f"{case} {_SHORT[quantity]}" for case, quantity in keys],
        "at most": [f"{THRESHOLDS[quantity]:g}" for _, quantity in keys],
        "floor": [_largest(_floor(one) for one in known[key]) for key in keys],
        "ref ±": [_largest(one.bound for one in known[key]) for key in keys],
    }

    def of_each(cell: Callable[[Finding | None], str]) -> dict[str, list[str]]:
        return {
            one.declaration.code: [cell(one.by_quantity.get(key)) for key in keys] for one in found
        }

    _print(asked | of_each(_limit), f"What codes tend to, less the reference; {about}")
    print_note(
        "! decides against the code, ? decides nothing; floor: of what measures it, ref ±: of the "
        "reference, in the shift also of the limit of the code's own ω_n"
    )
    bars = {"quantity": asked["quantity"]} | of_each(_discretization)
    _print(bars, "Discretization of the finest run: less its own limit ± the bar of that")
    _print(
        {
            "code": [one.declaration.code for one in found],
            "theory": [one.declaration.theory.name for one in found],
            "mesh": [_finest(one, lambda run: str(run.elements)) for one in found],
            "h [ms]": [_finest(one, lambda run: f"{1e3 * run.step:g}") for one in found],
            "order l": [_order(one, "mesh") for one in found],
            "order h": [_order(one, "step") for one in found],
            "s": [_finest(one, lambda run: f"{run.wall:.1f}") for one in found],
            "outcome": [one.outcome for one in found],
        },
        "Orders of q(t) observed of declared, and time, of the finest run of the first history",
    )
    for one in found:
        for sentence in _sentences(one):
            print_note(f"{one.declaration.code}: {sentence}")


def _print(columns: dict[str, list[str]], title: str) -> None:
    print_columns(columns, "table", title=title, frame=box.SIMPLE)


def _limit(found: Finding | None) -> str:
    """Return the model difference, marked where it decides against the code or decides nothing."""
    if found is None or found.outcome is Outcome.NOT_SUBMITTED:
        return "-"
    if not math.isfinite(found.model_difference):
        return "none!" if found.outcome is Outcome.NO_LIMIT else "none?"
    mark = {True: "", False: "!", None: "?"}[found.outcome.passed]
    return _signed(found.model_difference) + mark


def _discretization(found: Finding | None) -> str:
    if found is None or found.runs is None or not math.isfinite(found.runs.limit):
        return "-"
    return f"{_signed(float(found.runs.errors[-1]))} ±{found.runs.bar:.0e}"


def _floor(found: Finding) -> float:
    return math.nan if found.runs is None else float(found.runs.noise[-1])


def _signed(value: float) -> str:
    return f"{value:+.0e}"


def _largest(values: Iterable[float]) -> str:
    finite = [value for value in values if math.isfinite(value)]
    return f"{max(finite):.0e}" if finite else "-"


def _finest(one: Judgement, cell: Callable[[Run], str]) -> str:
    """Return what there is to say of the finest run of the first history."""
    return cell(next(iter(one.histories.values())).rows.finest) if one.histories else "-"


def _order(one: Judgement, name: str) -> str:
    """Return the observed order of the declared one, marked where it is low."""
    order: Order | None = next((of[name] for of in one.orders.values() if name in of), None)
    if order is None or math.isnan(order.value):
        return "-"
    return f"{order}{'!' if order.low else ''}"


def _sentences(found: Judgement) -> list[str]:
    """Return why there is no verdict, or one against the code; each sentence once."""
    said = [
        f"{finding.outcome}: {finding.note}"
        for finding in found.by_quantity.values()
        if finding.outcome is not Outcome.REFERENCE and finding.note
    ]
    remarks = [run.remark for one in found.histories.values() for run in one.runs if run.remark]
    return list(dict.fromkeys([*said, *remarks]))
