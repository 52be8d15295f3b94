"""`rotbeam verify`: the verdict table of the formulations and codes at hand."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

from rich import box
from rich.console import Console
from rich.progress import track

from analytic import AnyBlade, Beam
from analytic.input_checks import positive

from ..fem.elements import ALIASES, FORMULATIONS, formulation
from ..files.beam_file import load_beam
from ..verification.cost import LADDER, cost_at_error
from ..verification.entries import entries_at_hand, formulation_entry
from ..verification.judgement import THRESHOLDS, Judgement
from ..verification.measures import verify as verification_of
from ..verification.outcomes import Finding, Order, Outcome
from ..verification.peers import PEERS, Entry, peer
from .motion import Motion, chosen_motion, slower_than_paper
from .output import new_console, print_columns


def verify(
    *,
    element: list[str] | None = None,
    cost: bool = False,
    error: float = 1e-2,
    config: Path | None = None,
) -> None:
    """Judge formulations by what they tend to: frequencies, history, amplitude, nonlinear shift.

    Of the paper's beam the benchmark's cases L, S1, S2 and S4; of another one its spin-up.

    Parameters
    ----------
    element
        A formulation, or another code; may be given again. All that are at hand without it.
    cost
        Print the cost at equal error instead.
    error
        That error, of q(t) over max|q|.
    config
        TOML file with the beam; without it, the paper's beam. Speeds and times follow its ω_0.
    """
    entries = entries_at_hand() if element is None else tuple(map(_entry, element))
    error = positive("error", error)
    beam = Beam.reference() if config is None else load_beam(config)
    motion = chosen_motion(beam)
    entries = tuple(replace(entry, step=motion.step) for entry in entries) if config else entries
    console = new_console()
    if cost:
        _print_costs(console, entries, error, beam, motion)
    else:
        _print_verdicts(console, entries, beam if config else None, motion)


def _entry(name: str) -> Entry:
    if name in FORMULATIONS or name in ALIASES:
        return formulation_entry(formulation(name))
    if name not in PEERS:
        known = ", ".join(repr(known) for known in (*FORMULATIONS, *PEERS))
        raise ValueError(f"unknown element {name!r}; known are {known}")
    return peer(name)


def _print_verdicts(
    console: Console, entries: tuple[Entry, ...], beam: AnyBlade | None, motion: Motion
) -> None:
    spin_up = None if beam is None else motion.spin_up
    found = [
        verification_of(entry, beam=beam, spin_up=spin_up, duration=motion.duration)
        for entry in _tracked(console, entries)
    ]
    keys = list(dict.fromkeys(key for one in found for key in _keys(one)))
    headers = [f"{case} {_SHORT[quantity]}" for case, quantity in keys]
    limits, runs = [], []
    for entry, one in zip(entries, found, strict=True):
        cells = [_findings(one).get(key) for key in keys]
        limits.append([entry.name, *(_limit_cell(cell) for cell in cells), one.outcome])
        history = next(iter(one.histories), None)
        orders = one.orders.get(history, {}) if history else {}
        shown = [_order_cell(orders.get(name)) for name in ("mesh", "step")]
        seconds = f"{one.histories[history].rows.finest.wall:.1f}" if history else "-"
        meshes = ", ".join(map(str, entry.own_meshes))
        errors = [_number(cell.difference) if cell else "-" for cell in cells]
        runs.append([entry.name, meshes, *errors, *shown, seconds])
    known = [[_findings(one)[key] for one in found if key in _findings(one)] for key in keys]
    limits.append(["threshold", *(f"{THRESHOLDS[quantity]:g}" for _, quantity in keys), ""])
    limits.append(["floor", *(_largest([_floor(one) for one in cells]) for cells in known), ""])
    limits.append(["reference ±", *(_largest([one.bound for one in cells]) for cells in known), ""])
    about = "the paper's beam" if beam is None else _named(motion)
    _print_rows(
        ["code", *headers, "outcome"], limits, f"What codes tend to, less the reference; {about}"
    )
    _print_rows(
        ["code", "meshes", *headers, "order l", "order h", "time [s]"],
        runs,
        "Difference of the finest mesh from the reference, orders, time of one run",
    )
    for one in found:
        for sentence in _sentences(one):
            console.print(f"{one.declaration.code}: {sentence}")


_SHORT = {
    "linear frequency": "ω_n", "history": "q(t)", "amplitude": "a", "nonlinear shift": "shift",
}  # fmt: skip


def _findings(found: Judgement) -> dict[tuple[str, str], Finding]:
    return {
        (case, quantity): finding
        for case, quantities in found.findings.items()
        for quantity, finding in quantities.items()
    }


def _keys(found: Judgement) -> list[tuple[str, str]]:
    return list(_findings(found))


def _limit_cell(found: Finding | None) -> str:
    """Return the model difference, marked where it decides against the code or decides nothing."""
    if found is None or found.outcome is Outcome.NOT_SUBMITTED:
        return "-"
    if not math.isfinite(found.model_difference):
        return "none!" if found.outcome is Outcome.NO_LIMIT else "none?"
    mark = {True: "", False: "!", None: "?"}[found.outcome.passed]
    return _number(found.model_difference) + mark


def _floor(found: Finding) -> float:
    return math.nan if found.runs is None else float(found.runs.noise[-1])


def _number(value: float) -> str:
    return f"{value:+.0e}" if math.isfinite(value) else "-"


def _largest(values: list[float]) -> str:
    finite = [value for value in values if math.isfinite(value)]
    return f"{max(finite):.0e}" if finite else "-"


def _order_cell(order: Order | None) -> str:
    if order is None or math.isnan(order.value):
        return "-"
    return f"{order}{'!' if order.low else ''}"


def _sentences(found: Judgement) -> list[str]:
    """Return why there is no verdict, or one against the code; each sentence once."""
    said = [
        f"{finding.outcome}: {finding.note}"
        for finding in _findings(found).values()
        if finding.outcome is not Outcome.REFERENCE and finding.note
    ]
    remarks = [run.remark for one in found.histories.values() for run in one.runs if run.remark]
    return list(dict.fromkeys([*said, *remarks]))


def _print_costs(
    console: Console, entries: tuple[Entry, ...], error: float, beam: AnyBlade, motion: Motion
) -> None:
    rows = []
    for entry in _tracked(console, entries):
        seconds, ladder = cost_at_error(entry, error, beam=beam, spin_up=motion.spin_up)
        cells = (f"{e:.1e} {s:.2f} s" if math.isfinite(e) else "failed" for e, s in ladder)
        reached = f"{seconds:.2f}" if math.isfinite(seconds) else "not reached"
        rows.append([entry.name, *cells, reached])
    _print_rows(
        [
            "code",
            *(f"{n} × {h * slower_than_paper(beam):g} s" for n, h in LADDER),
            f"s at {error:g}",
        ],
        rows,
        f"Wall time at an error of {error:g} of max|q|, {_named(motion)}, "
        f"{2.0 * motion.spin_up.ramp_time:g} s",
    )
    console.print(
        "Each cell: error and wall time of one run, one after the other in this process; the last "
        "column interpolates time over error logarithmically."
    )


def _named(motion: Motion) -> str:
    return f"ω = {motion.spin_up.omega:g} rad/s in T = {motion.spin_up.ramp_time:g} s"


def _print_rows(headers: list[str], rows: list[list[str]], title: str) -> None:
    columns = dict(zip(headers, map(list, zip(*rows, strict=True)), strict=True))
    print_columns(columns, "table", title=title, frame=box.SIMPLE)


def _tracked(console: Console, entries: tuple[Entry, ...]) -> Iterable[Entry]:
    return track(
        entries, "verifying", console=console, transient=True, disable=not console.is_terminal
    )
