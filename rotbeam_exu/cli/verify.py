"""`rotbeam verify`: our elements, or an author's own program, run and judged."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Parameter

from analytic.blade_checks import require_planar

from ..verification.cases import CASES
from .job import telling_what_is_kept
from .judge import cases_named, judge, print_judgements
from .options import Number, Whole
from .output import counter, print_columns, print_text
from .request import Request, element_of, uses

if TYPE_CHECKING:
    from ..verification.program import Program

_FIRST_STEP, _FIRST_TOLERANCE = 1e-3, 1e-6


@uses("motion", "numerics.duration", "numerics.step")
def verify(
    request: Request,
    *,
    element: list[str] | None = None,
    command: str | None = None,
    out: Annotated[Path | None, Parameter(alias="-o")] = None,
    case: list[str] | None = None,
    elements: Whole = 16,
    step: Number | None = None,
    budget: Number = 3600.0,
    seconds: Number = 600.0,
    memory: Number | None = None,
) -> None:
    """Judge elements, or your own program, by their limits.

    Frequencies, history, amplitude and nonlinear shift.

    The cases are L, S1, S2, O and S4 of the benchmark, in space F, F+p, P, W, G and K, or those
    that are named; of a beam of --config, its spin-up. With --command your program is run on finer
    meshes and steps until they are decided, and its files are kept as a submission. What is there
    is not run again; a failed run stays on record.

    Parameters
    ----------
    element
        A formulation: cable, exact, ancf3, linear, substructures; in space
        space_cable, space_exact; or one's own, as module:Class. Repeat it for several; by default
        those in the plane.
    command
        Your program with {case}, {elements}, {step} or {tolerance}, and {out}, the file to write;
        without {out} it writes the kit's names into the folder in which it runs.
    out
        Folder of the submission that --command makes or goes on with.
    case
        Judge this case of the benchmark, as S1 or F+N; repeat it for several.
    elements
        Of the middle one of the first three meshes of --command.
    step
        The smallest of the first three steps [s] of --command, 1 ms unless given; or of the
        tolerances, 1e-6.
    budget
        CPU time [s] of the runs of --command after which no other begins.
    seconds
        Time [s] after which a run of --command is stopped.
    memory
        Address space [GiB] that a run of --command has; not limited unless given.

    Examples
    --------
    $ rotbeam verify --element cable
    $ rotbeam verify --element cable --element ancf3
    $ rotbeam verify --command "./mine {case} {elements} {step} {out}" -o runs
    """
    from ..verification.entries import entries_at_hand, formulation_entry
    from ..verification.program import Program
    from ..verification.verify import DEFAULT
    from ..verification.verify import verify as verification_of

    if command is not None:
        if out is None:
            raise ValueError("give the folder of your submission with --out")
        if element or request.config:
            raise ValueError(
                "--command runs cases of the benchmark: leave out --element and --config"
            )
        names = cases_named(case) or DEFAULT
        program = Program(command=command, seconds=seconds, memory=memory)
        _until_decided(program, out, names, elements=elements, step=step, budget=budget)
        judge(out, case=list(names))
        return
    entries_of_user = [formulation_entry(element_of(name)) for name in element or ()]
    motion = request.motion
    entries, mine = entries_of_user or entries_at_hand(), dict[str, Any]()
    if request.config:
        remedy = "rotbeam reference, which is exact in space"
        require_planar(request.blade, "verify has references of", remedy)
        entries = [replace(entry, step=motion.step) for entry in entries]
        mine = {"blade": request.blade, "spin_up": motion.spin_up}
    judgements = []
    with counter("verifying") as progress:
        for entry in entries:
            judgements.append(
                verification_of(entry, duration=motion.duration, cases=cases_named(case), **mine)
            )
            progress(len(judgements), len(entries))
    about = f"ω = {motion.spin_up.omega:g} rad/s in T = {motion.spin_up.ramp_time:g} s"
    paper = "the benchmark" if case else "the paper's beam"
    print_judgements(judgements, about if request.config else paper)


def _until_decided(
    program: Program, folder: Path, names: Sequence[str], *, elements: int, step: float | None,
    budget: float,
) -> None:  # fmt: skip
    """Run a program until the cases are decided, and print why it ended."""
    from ..verification.refining import Record, until_decided

    record = Record(folder, program, code=folder.resolve().name)
    first = (_FIRST_TOLERANCE if program.is_adaptive else _FIRST_STEP) if step is None else step
    with telling_what_is_kept(lambda: f"{folder} keeps all runs that ended"):
        ends = until_decided(
            record, [CASES[name] for name in names], elements=elements, step=first, budget=budget,
            announce=lambda what: print_text(f"runs {what}", stderr=True),
        )  # fmt: skip
    held = record.submission
    made = {(one.case, one.elements, one.refinement) for one in held.runs}
    made |= {(one.case, one.elements, 0.0) for one in held.rows}
    counts = [sum(case == name for case, *_ in made) for name in ends]
    print_columns(
        {"case": list(ends), "runs": list(map(str, counts)), "ended": list(ends.values())},
        title=f"Runs in {folder}, {record.spent:.0f} s of CPU",
    )
