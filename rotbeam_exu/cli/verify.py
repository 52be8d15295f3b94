"""`rotbeam verify`: the verdict table of the formulations and codes at hand."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter
from rich import box
from rich.console import Console

from analytic import AnyBlade
from analytic.input_checks import positive

from .configuration import configured, motion_of
from .motion import Motion, slower_than_paper
from .options import Flag, element_names, spelled_as
from .output import new_console, print_columns, print_text
from .progress import counted

if TYPE_CHECKING:
    from ..verification.verify import Entry


def _names() -> tuple[str, ...]:
    from ..verification.peers import PEERS

    return *element_names(), *PEERS


Judged = Annotated[str, Parameter(converter=spelled_as(_names))]


def verify(
    *,
    element: list[Judged] | None = None,
    cost: Flag = False,
    error: float = 1e-2,
    config: Path | None = None,
) -> None:
    """Judge elements, and other codes at hand, by what they tend to.

    Frequencies, history, amplitude and nonlinear shift.

    Of the paper's beam the benchmark's cases L, S1, S2, O and S4; of another one its spin-up.

    Parameters
    ----------
    element
        A formulation: cable, exact or reissner, ancf3, linear, substructures; or another code:
        kratos. May be given again; without it all that are at hand.
    cost
        Print the cost at equal error instead.
    error
        That error, of q(t) over max|q|.
    config
        TOML file with the beam, and if it likes with [motion] and with step and duration in
        [numerics]; without it, the paper's beam. What is not given follows its ω_0.

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
    console = new_console()
    if cost:
        _print_costs(console, entries, error, beam, motion)
    else:
        _print_verdicts(console, entries, beam if config else None, motion)


def _entry(name: str) -> Entry:
    from ..fem.elements import FORMULATIONS, formulation
    from ..verification.entries import formulation_entry
    from ..verification.peers import PEERS, peer

    if name in element_names():
        return formulation_entry(formulation(name))
    if name not in PEERS:
        known = ", ".join(repr(known) for known in (*FORMULATIONS, *PEERS))
        raise ValueError(f"unknown element {name!r}; known are {known}")
    return peer(name)


def _print_verdicts(
    console: Console, entries: tuple[Entry, ...], beam: AnyBlade | None, motion: Motion
) -> None:
    from ..verification.verify import verify as verification_of
    from .verdicts import print_judgements

    spin_up = None if beam is None else motion.spin_up
    found = [
        verification_of(entry, beam=beam, spin_up=spin_up, duration=motion.duration)
        for entry in _tracked(console, entries)
    ]
    print_judgements(found, "the paper's beam" if beam is None else _named(motion))


def _print_costs(
    console: Console, entries: tuple[Entry, ...], error: float, beam: AnyBlade, motion: Motion
) -> None:
    from ..verification.verify import LADDER, cost_at_error

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
    print_text(
        console,
        "Each cell: error and wall time of one run, one after the other in this process; the last "
        "column interpolates time over error logarithmically.",
    )


def _named(motion: Motion) -> str:
    return f"ω = {motion.spin_up.omega:g} rad/s in T = {motion.spin_up.ramp_time:g} s"


def _print_rows(headers: list[str], rows: list[list[str]], title: str) -> None:
    columns = dict(zip(headers, map(list, zip(*rows, strict=True)), strict=True))
    print_columns(columns, "table", title=title, frame=box.SIMPLE)


def _tracked(console: Console, entries: tuple[Entry, ...]) -> Iterator[Entry]:
    return counted(console, "verifying", entries, len(entries))
