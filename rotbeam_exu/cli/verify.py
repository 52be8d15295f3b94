"""`rotbeam verify`: the verdict table of the formulations and codes at hand."""

from __future__ import annotations

import math
from collections.abc import Iterable

from rich import box
from rich.console import Console
from rich.progress import track

from analytic.input_checks import positive

from ..fem.elements import FORMULATIONS, formulation
from ..verification.entries import entries_at_hand, formulation_entry
from ..verification.measures import (
    LADDER,
    THRESHOLDS,
    Measure,
    cost_at_error,
)
from ..verification.measures import verify as verification_of
from ..verification.peers import PEERS, Entry, peer
from .output import new_console, print_columns


def verify(*, element: list[str] | None = None, cost: bool = False, error: float = 1e-2) -> None:
    """Judge formulations against the exact beam: frequencies, amplitude, history, orders, cost.

    Parameters
    ----------
    element
        A formulation, or another code; may be given again. All that are at hand without it.
    cost
        Print the cost at equal error instead.
    error
        That error, of q(t) over max|q|.
    """
    entries = entries_at_hand() if element is None else tuple(map(_entry, element))
    error = positive("error", error)
    console = new_console()
    if cost:
        _print_costs(console, entries, error)
    else:
        _print_verdicts(console, entries)


def _entry(name: str) -> Entry:
    if name in FORMULATIONS:
        return formulation_entry(formulation(name))
    if name not in PEERS:
        known = ", ".join(repr(known) for known in (*FORMULATIONS, *PEERS))
        raise ValueError(f"unknown element {name!r}; known are {known}")
    return peer(name)


def _print_verdicts(console: Console, entries: tuple[Entry, ...]) -> None:
    headers = {
        "linear frequency": "ω_n", "amplitude": "a", "nonlinear frequency": "ω_NL",
        "history": "q(t)", "order in step": "order h", "order in mesh": "order l",
        "cost": "time [s]",
    }  # fmt: skip
    rows, notes = [], []
    for entry in _tracked(console, entries):
        found = verification_of(entry)
        cells = (_cell(found.measures[name]) for name in headers)
        verdict = "passed" if found.passed else "falls short"
        rows.append([found.name, f"{found.elements}", *cells, verdict])
        sentences = dict.fromkeys(m.note for m in found.measures.values() if m.passed is False)
        notes += [f"{found.name}: {note}" for note in (*sentences, found.remark) if note]
    limits = (f"{THRESHOLDS[n]:g}" if n in THRESHOLDS else "" for n in headers)
    rows.append(["threshold", "", *limits, ""])
    _print_rows(
        ["code", "mesh", *headers.values(), "verdict"],
        rows,
        "Errors against the exact beam, ω = 6 rad/s in T = 3 s",
    )
    for note in notes:
        console.print(note)


def _print_costs(console: Console, entries: tuple[Entry, ...], error: float) -> None:
    rows = []
    for entry in _tracked(console, entries):
        seconds, ladder = cost_at_error(entry, error)
        cells = (f"{e:.1e} {s:.2f} s" if math.isfinite(e) else "failed" for e, s in ladder)
        reached = f"{seconds:.2f}" if math.isfinite(seconds) else "not reached"
        rows.append([entry.name, *cells, reached])
    _print_rows(
        ["code", *(f"{n} × {h:g} s" for n, h in LADDER), f"s at {error:g}"],
        rows,
        f"Wall time at an error of {error:g} of max|q|, ω = 6 rad/s in T = 3 s, 6 s",
    )
    console.print(
        "Each cell: error and wall time of one run, one after the other in this process; the last "
        "column interpolates time over error logarithmically."
    )


def _print_rows(headers: list[str], rows: list[list[str]], title: str) -> None:
    columns = dict(zip(headers, map(list, zip(*rows, strict=True)), strict=True))
    print_columns(columns, "table", title=title, frame=box.SIMPLE)


def _cell(measure: Measure) -> str:
    if not math.isfinite(measure.value):
        return "-" if measure.passed is None else "failed"
    plain = measure.name == "cost" or measure.name.startswith("order")
    number = f"{measure.value:.1f}" if plain else f"{measure.value:.1e}"
    return number + ("!" if measure.passed is False else " ")


def _tracked(console: Console, entries: tuple[Entry, ...]) -> Iterable[Entry]:
    return track(
        entries, "verifying", console=console, transient=True, disable=not console.is_terminal
    )
