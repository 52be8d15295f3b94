"""The verdict on a code that can be called: what it hands in, and the judgement of that."""

from __future__ import annotations

import math
import time as clock
from collections.abc import Sequence
from functools import partial

import numpy as np

from analytic import AnyBlade, Beam, SpinUp, spin_up_response

from ..lazily import xr
from .cases import CASES, SPEEDS, Asked, Case, frequency_case, spin_up_case
from .judgement import Judgement, judged
from .peers import Entry
from .submission import Declaration, Frequency, Run, Submission

DEFAULT = ("L", "S1", "S2", "O", "S4")
"""Cases that `verify` takes: linear, the paper's main one, and the least and the largest speed. On
the orbit of O the beam hardens; S2 leaves too little for that."""


def verify(
    entry: Entry,
    *,
    beam: AnyBlade | None = None,
    spin_up: SpinUp | None = None,
    duration: float = 15.0,
) -> Judgement:
    """Judge a code against the exact beam.

    Parameters
    ----------
    entry : Entry
        The code, its meshes and its step.
    beam : Beam, optional
        The paper's by default, whose cases L, S1, S2, O and S4 are then judged.
    spin_up : SpinUp, optional
        A single one to be judged instead; of a beam that is given ω = 6 rad/s in T = 3 s.
    duration : float
        End of that one [s].

    Examples
    --------
    >>> from analytic import SpinUp
    >>> from rotbeam_exu.fem.elements import Cable
    >>> from rotbeam_exu.verification.entries import formulation_entry
    >>> from rotbeam_exu.verification.measures import verify
    >>> entry = formulation_entry(Cable(), elements=4, step=2e-3)
    >>> print(verify(entry, spin_up=SpinUp(omega=2.0, ramp_time=3.0), duration=8.0).outcome)
    no verdict (L); converges to the reference (S)
    """
    if beam is None and spin_up is None:
        cases = [CASES[name] for name in DEFAULT]
    else:
        blade = Beam.reference() if beam is None else beam
        motion = SpinUp(omega=6.0, ramp_time=3.0) if spin_up is None else spin_up
        speeds = tuple(speed * faster_than_paper(blade) for speed in SPEEDS)
        cases = [frequency_case(blade, speeds), spin_up_case(blade, motion, duration)]
    return judged(handed_in(entry, cases), cases={case.name: case for case in cases})


def handed_in(entry: Entry, cases: Sequence[Case]) -> Submission:
    """Run a code over cases, and return what it would submit.

    Frequencies on its own meshes; spin-ups on these meshes at twice its step, and on its mesh at
    one, two and four of its steps. What fails is on record with its sentence.
    """
    frequencies = [
        _frequency(entry, case, speed, elements)
        for case in cases
        if case.asked is Asked.FREQUENCIES and entry.first_frequency is not None
        for speed in case.speeds
        for elements in entry.own_meshes
    ]
    resolutions = {(elements, 2.0 * entry.step) for elements in entry.own_meshes}
    resolutions |= {(entry.elements, factor * entry.step) for factor in (1.0, 2.0, 4.0)}
    runs = [
        _run(entry, case, elements, step)
        for case in cases
        if _can(entry, case)
        for elements, step in sorted(resolutions)
    ]
    return Submission(
        declaration=Declaration(
            code=entry.name,
            theory=entry.theory,
            order=entry.order,
            order_in_step=entry.order_in_step,
        ),
        frequencies=tuple(frequencies),
        runs=tuple(runs),
    )


def faster_than_paper(beam: AnyBlade) -> float:
    """How many times faster the beam is than the paper's."""
    return beam.omega_0 / Beam.reference().omega_0


def whole_duration(duration: float, step: float) -> float:
    """Return the duration, or what is a little longer and a whole number of steps."""
    return math.ceil(duration / step * (1.0 - 1e-12)) * step


def _frequency(entry: Entry, case: Case, speed: float, elements: int) -> Frequency:
    assert entry.first_frequency is not None
    try:
        found = entry.first_frequency(case.blade, speed, elements)
    except RuntimeError as error:
        return Frequency(elements=elements, speed=speed, failure=str(error))
    return Frequency(elements=elements, speed=speed, frequency=found)


def _can(entry: Entry, case: Case) -> bool:
    """Whether a code that is called takes part in a case."""
    if case.asked is not Asked.HISTORY or case.loads:
        return False
    return isinstance(case.motion, SpinUp) or entry.release is not None


def _run(entry: Entry, case: Case, elements: int, step: float) -> Run:
    started = clock.perf_counter()
    try:
        found = _simulated(entry, case, elements, step)
    except RuntimeError as error:
        nothing = np.empty(0)
        return Run(
            case=case.name, elements=elements, step=step, time=nothing, q=nothing,
            failure=str(error),
        )  # fmt: skip
    # A whole number of steps may end a little later than the case.
    found = found.isel(time=found["time"].to_numpy() <= case.duration)
    own = str(found.attrs.get("verdict", "passed"))
    return Run(
        case=case.name, elements=elements, step=step,
        time=found["time"].to_numpy(), q=found["q"].to_numpy(), q_dot=found["q_dot"].to_numpy(),
        wall=clock.perf_counter() - started, remark="" if own == "passed" else own,
    )  # fmt: skip


def _simulated(entry: Entry, case: Case, elements: int, step: float) -> xr.Dataset:
    how = {"elements": elements, "duration": whole_duration(case.duration, step), "step": step}
    if isinstance(case.motion, SpinUp):
        return entry.simulate(case.blade, case.motion, **how)  # type: ignore[arg-type]
    assert entry.release is not None
    assert case.motion is not None
    orbit = case.orbit
    return entry.release(case.blade, case.motion, partial(orbit.state, 0), **how)  # type: ignore[arg-type]


def history_error(run: xr.Dataset, beam: AnyBlade, spin_up: SpinUp) -> float:
    """Return the largest error of q(t) over max|q|, against the exact beam."""
    exact = spin_up_response(beam, spin_up, run["time"].to_numpy(), tolerance=1e-6).q
    return float(np.abs(run["q"] - exact).max() / np.abs(exact).max())
