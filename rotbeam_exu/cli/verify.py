"""`rotbeam verify`: the table of judgements on formulations and codes at hand."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from analytic import AnyBlade
from analytic.input_checks import positive

from ..verification.convergence import Order
from ..verification.judgement import THRESHOLDS, Judgement
from ..verification.outcomes import Finding, Outcome
from ..verification.submission import Run
from .motion import ChosenMotion, Config, configured, motion_of, slower_than_paper
from .options import Flag, element_names, element_of, spelled_as
from .output import counter, print_columns, print_note, print_text

if TYPE_CHECKING:
    from ..verification.verify import Entry

_SHORT = {
    "linear frequency": "ω_n", "history": "q(t)", "amplitude": "a", "nonlinear shift": "shift",
    "frequencies": "ω_k", "steady deflection": "tip",
    "backbone": "shift",
}  # fmt: skip


def _names() -> tuple[str, ...]:
    from ..verification.peers import PEERS

    return *element_names(), *PEERS


Judged = Annotated[str, Parameter(converter=spelled_as(_names))]


def verify(
    *,
    element: list[Judged] | None = None,
    cost: Flag = False,
    error: float = 1e-2,
    config: Config = None,
) -> None:
    """Judge elements and other codes by their limits.

    Frequencies, history, amplitude and nonlinear shift.

    The cases are L, S1, S2, O and S4 of the benchmark; of a beam of --config, its spin-up.

    Parameters
    ----------
    element
        A formulation: cable, exact or reissner, ancf3, linear, substructures; in space
        space_cable, space_exact; one's own, as module:Class; or another code: kratos. Repeat it
        for several; by default all that are installed.
    cost
        Print the cost at equal error instead.
    error
        That error, of q(t) over its largest value.

    Examples
    --------
    $ rotbeam verify --element cable
    $ rotbeam verify --element cable --element ancf3 --cost
    """
    from ..verification.entries import entries_at_hand

    entries = entries_at_hand() if element is None else tuple(map(_entry, element))
    error = positive("error", error)
    file = configured(config)
    beam = file.beam
    motion = motion_of(file, duration=file.numerics.get("duration"), step=file.numerics.get("step"))
    entries = tuple(replace(entry, step=motion.step) for entry in entries) if config else entries
    if cost:
        _print_costs(entries, error, beam, motion)
    else:
        _print_verdicts(entries, beam if config else None, motion)


def _entry(name: str) -> Entry:
    from ..fem.elements import FORMULATIONS
    from ..verification.entries import formulation_entry
    from ..verification.peers import PEERS, peer

    if name in element_names() or ":" in name:
        return formulation_entry(element_of(name))
    if name not in PEERS:
        known = ", ".join(repr(known) for known in (*FORMULATIONS, *PEERS))
        raise ValueError(f"unknown element {name!r}; known are {known}")
    return peer(name)


def _print_verdicts(
    entries: tuple[Entry, ...], beam: AnyBlade | None, motion: ChosenMotion
) -> None:
    from ..verification.verify import verify as verification_of

    spin_up = None if beam is None else motion.spin_up
    found = [
        verification_of(entry, beam=beam, spin_up=spin_up, duration=motion.duration)
        for entry in _tracked(entries)
    ]
    print_judgements(found, "the paper's beam" if beam is None else _named(motion))


def _print_costs(
    entries: tuple[Entry, ...], error: float, beam: AnyBlade, motion: ChosenMotion
) -> None:
    from ..verification.verify import LADDER, cost_at_error

    columns: dict[str, list[str]] = {"code": [entry.name for entry in entries]}
    titles = [f"{n} × {h * slower_than_paper(beam):g} s" for n, h in LADDER]
    columns |= {title: [] for title in (*titles, f"s at {error:g}")}
    for entry in _tracked(entries):
        seconds, ladder = cost_at_error(entry, error, beam=beam, spin_up=motion.spin_up)
        cells = [f"{e:.1e} {s:.2f} s" if math.isfinite(e) else "failed" for e, s in ladder]
        cells.append(f"{seconds:.2f}" if math.isfinite(seconds) else "not reached")
        for column, cell in zip(list(columns.values())[1:], cells, strict=True):
            column.append(cell)
    print_columns(
        columns,
        title=f"Wall time at an error of {error:g} of max|q|, {_named(motion)}, "
        f"{2.0 * motion.spin_up.ramp_time:g} s",
    )
    print_text(
        "Each cell: error and wall time of one run, one after the other in this process; the last "
        "column interpolates time over error logarithmically.",
    )


def _named(motion: ChosenMotion) -> str:
    return f"ω = {motion.spin_up.omega:g} rad/s in T = {motion.spin_up.ramp_time:g} s"


def _tracked(entries: tuple[Entry, ...]) -> Iterator[Entry]:
    """Yield each entry, and count it when the next one is asked for."""
    with counter("verifying") as progress:
        for done, entry in enumerate(entries, start=1):
            yield entry
            progress(done, len(entries))


def print_judgements(found: Sequence[Judgement], about: str) -> None:
    """Print the limits of codes less the reference, their discretization, and the outcomes."""
    keys = list(dict.fromkeys(key for one in found for key in one.by_quantity))
    known = {key: [one.by_quantity[key] for one in found if key in one.by_quantity] for key in keys}
    asked = {
        "quantity": [f"{case} {_SHORT[quantity]}" for case, quantity in keys],
        "at most": [f"{THRESHOLDS[quantity]:g}" for _, quantity in keys],
        "floor": [_largest(one.runs.noise[-1] for one in known[key] if one.runs) for key in keys],
        "ref ±": [_largest(one.bound for one in known[key]) for key in keys],
    }

    def of_each(cell: Callable[[Finding | None], str]) -> dict[str, list[str]]:
        return {
            one.declaration.code: [cell(one.by_quantity.get(key)) for key in keys] for one in found
        }

    print_columns(asked | of_each(_limit), title=f"Limits of the codes less the reference; {about}")
    print_note(
        "! fails, ? is undecided; floor: resolution of the measurement; ref ±: uncertainty of the "
        "reference, in the shift also that of the code's own ω_n"
    )
    bars = {"quantity": asked["quantity"]} | of_each(_discretization)
    print_columns(
        bars, title="Discretization error: finest run less its own limit, ± uncertainty of that"
    )
    print_columns(
        {
            "code": [one.declaration.code for one in found],
            "theory": [one.declaration.theory.name for one in found],
            "mesh": [_finest(one, lambda run: str(run.elements)) for one in found],
            "h": [_finest(one, lambda run: run.step_in_words) for one in found],
            "order l": [_order(one, "mesh") for one in found],
            "order h": [_order(one, "step") for one in found],
            "s": [_finest(one, lambda run: f"{run.wall:.1f}") for one in found],
            "outcome": [one.outcome for one in found],
        },
        title="Orders of q(t), observed of declared, and the finest run of the first history",
    )
    for one in found:
        for sentence in _sentences(one):
            print_note(f"{one.declaration.code}: {sentence}")


def _limit(found: Finding | None) -> str:
    """Return the model difference, marked where it decides against the code or decides nothing."""
    if found is None or found.outcome is Outcome.NOT_SUBMITTED:
        return "-"
    if not math.isfinite(found.model_difference):
        return "none!" if found.outcome is Outcome.DIFFERS else "none?"
    mark = {True: "", False: "!", None: "?"}[found.outcome.passed]
    return _signed(found.model_difference) + mark


def _discretization(found: Finding | None) -> str:
    if found is None or found.runs is None or not math.isfinite(found.runs.limit):
        return "-"
    return f"{_signed(float(found.runs.errors[-1]))} ±{found.runs.bar:.0e}"


def _signed(value: float) -> str:
    return f"{value:+.0e}"


def _largest(values: Iterable[float]) -> str:
    finite = [value for value in values if math.isfinite(value)]
    return f"{max(finite):.0e}" if finite else "-"


def _finest(one: Judgement, cell: Callable[[Run], str]) -> str:
    """Return what there is to say of the finest run of the first history."""
    return cell(next(iter(one.histories.values())).finest) if one.histories else "-"


def _order(one: Judgement, name: str) -> str:
    """Return the observed order of the declared one, marked where it is low."""
    order: Order | None = next((of[name] for of in one.orders.values() if name in of), None)
    if order is None or math.isnan(order.value):
        return "-"
    return f"{order}{'!' if order.low else ''}"


def _sentences(found: Judgement) -> list[str]:
    """Return what differs, what would decide, and runs left out; each sentence once."""
    said = [
        f"{finding.said}: {finding.note}" if finding.note else f"{case} {quantity} {finding.said}"
        for (case, quantity), finding in found.by_quantity.items()
        if finding.outcome is not Outcome.REFERENCE
    ]
    said += [f"{case}: {one}" for case, of in found.remarks.items() for one in of]
    remarks = [run.remark for one in found.histories.values() for run in one.runs if run.remark]
    return list(dict.fromkeys([*said, *remarks]))
