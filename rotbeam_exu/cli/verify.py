"""`rotbeam verify`: the verdict table of the formulations and codes at hand."""

from __future__ import annotations

import math
from collections.abc import Iterable

from rich import box
from rich.console import Console
from rich.progress import track
from rich.table import Table

from ..elements import FORMULATIONS, formulation
from ..peers import PEERS, Entry, peer
from ..verification import (
    LADDER,
    THRESHOLDS,
    Measure,
    cost_at_error,
    entries_at_hand,
    formulation_entry,
)
from ..verification import verify as judge


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
    console = Console(highlight=False, soft_wrap=True)
    # A table that is cut off says nothing; where there is no terminal there is no width.
    console.width = max(console.width, 110)
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
    table = Table(box=box.SIMPLE, title="Errors against the exact beam, ω = 6 rad/s in T = 3 s")
    for header in ("", "mesh", *headers.values(), "verdict"):
        table.add_column(header, justify="left" if header in {"", "verdict"} else "right")
    notes = []
    for entry in _tracked(console, entries):
        found = judge(entry)
        table.add_row(
            found.name,
            f"{found.elements}",
            *(_cell(found.measures[name]) for name in headers),
            "passed" if found.passed else "falls short",
        )
        sentences = dict.fromkeys(m.note for m in found.measures.values() if m.passed is False)
        notes += [f"{found.name}: {note}" for note in (*sentences, found.remark) if note]
    table.add_row(
        "threshold", "", *(f"{THRESHOLDS[n]:g}" if n in THRESHOLDS else "" for n in headers), ""
    )
    console.print(table)
    for note in notes:
        console.print(note, markup=False)


def _print_costs(console: Console, entries: tuple[Entry, ...], error: float) -> None:
    table = Table(
        box=box.SIMPLE,
        title=f"Wall time at an error of {error:g} of max|q|, ω = 6 rad/s in T = 3 s, 6 s",
    )
    for header in ("", *(f"{n} × {h:g} s" for n, h in LADDER), f"s at {error:g}"):
        table.add_column(header, justify="right" if header else "left")
    for entry in _tracked(console, entries):
        seconds, ladder = cost_at_error(entry, error)
        cells = (f"{e:.1e} {s:.2f} s" if math.isfinite(e) else "failed" for e, s in ladder)
        table.add_row(
            entry.name, *cells, f"{seconds:.2f}" if math.isfinite(seconds) else "not reached"
        )
    console.print(table)
    console.print(
        "Each cell: error and wall time of one run, one after the other in this process; the last "
        "column interpolates time over error logarithmically."
    )


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
