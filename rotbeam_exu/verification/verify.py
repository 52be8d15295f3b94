"""`verify`: a code that can be called runs the cases, and its results are judged.

Anyone can have a code of their own judged: write a function with the signature of `Code`, wrap it
in an `Entry`, and read the judgment::

    def mine(case, *, elements, step):
        ...                                   # spin the blade up; sample q [m] over time [s]
        return xarray.Dataset({"q": ("time", q)}, {"time": time})

    verify(Entry(name="mine", simulate=mine))
"""

from __future__ import annotations

import time as clock
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import product
from typing import Protocol

import numpy as np

from analytic import Beam, Blade, SpinUp
from analytic.arrays import FloatArray
from analytic.input_checks import whole_number
from analytic.theory import BERNOULLI_EULER, Theory

from ..lazily import xr
from .case import Asked, Case
from .cases import CASES, SPEEDS, frequency_case, spin_up_case
from .judgement import Judgement, judged
from .submission import Declaration, Row, Run, Submission

DEFAULT = ("L", "S1", "S2", "O", "S4")
"""Cases that `verify` takes: linear, the paper's main one, and the least and the largest speed. On
the orbit of O the beam hardens; S2 leaves too little for that."""

IN_SPACE = ("F", "F+p", "P", "W", "G", "K")
"""Cases that `verify` takes of a code in space."""

Numbers = Callable[[Case, float, int], Sequence[float] | FloatArray]
"""From a case, a speed [rad/s] and a number of elements to numbers; raises as `Code` does."""


class Code(Protocol):
    """A code that computes the history of a case."""

    def __call__(self, case: Case, *, elements: int, step: float) -> xr.Dataset:
        """Return q [m] of the tip over `time` [s], as Eq. 16 has it.

        In space `case.columns` in its place: lag and flap [m], twist [rad], and of real blades the
        moment of the blade on the clamp [N m].

        The blade, `case.blade`, starts straight and at rest and turns by `case.rotation` under
        `case.loads`; where not `case.is_spun_up` it starts on `case.orbit`, whose ``state(0, x)``
        is the `BladeState` at material points x [m]. Samples are even, at least 100 a period, and
        go from 0 to `case.duration` or a little beyond. With `case.kick` it starts in the state
        `case.start(x)`, straight, but in motion out of the plane; with `case.settled` in that of
        its equilibrium under the loads.

        Raises
        ------
        NotImplementedError
            Of a case that the code does not do, which is then not submitted.
        RuntimeError
            With one sentence, where it fails.
        """


@dataclass(frozen=True, kw_only=True)
class Entry:
    """A code to be judged, its name and the discretization it is judged at.

    Parameters
    ----------
    name : str
        Shown in the table.
    simulate : Code
    frequencies : callable, optional
        (case, omega, elements) -> the `case.count` lowest natural frequencies [rad/s] in steady
        rotation, where the code has them.
    in_space : bool
        Whether the code does cases in space, and those only.
    steady_tip : callable, optional
        (case, omega, elements) -> lag [m], flap [m] and twist [rad] of the tip at rest in the
        turning frame, under the loads of the case.
    elements, step
        Mesh and step [s] of the judged run.
    meshes : tuple of int, optional
        Meshes on which convergence is judged, three or more to have an order; half, the same and
        twice as many elements unless given.
    theory : Theory
        The beam theory whose linear frequencies the code should have; Bernoulli-Euler's by default.
    order, order_in_step : float, optional
        Orders that the author declares, in the mesh and in the step; the observed ones are judged
        against them.
    """

    name: str
    simulate: Code
    frequencies: Numbers | None = None
    in_space: bool = False
    steady_tip: Numbers | None = None
    elements: int = 16
    step: float = 1e-3
    meshes: tuple[int, ...] = ()
    theory: Theory = BERNOULLI_EULER
    order: float | None = None
    order_in_step: float | None = 2.0

    def __post_init__(self) -> None:
        for elements in (self.elements, *self.meshes):
            whole_number("meshes", elements)

    @property
    def own_meshes(self) -> tuple[int, ...]:
        """Meshes on which convergence is judged, coarse to fine."""
        around = (max(self.elements // 2, 1), self.elements, 2 * self.elements)
        return tuple(sorted(set(self.meshes or around)))


def verify(
    entry: Entry,
    *,
    blade: Blade | None = None,
    spin_up: SpinUp | None = None,
    duration: float = 15.0,
    cases: Sequence[str] = (),
) -> Judgement:
    """Judge a code against the exact beam.

    Parameters
    ----------
    entry : Entry
        The code, its meshes and its step.
    blade : Blade, optional
        The paper's by default, whose cases L, S1, S2, O and S4 are then judged.
    spin_up : SpinUp, optional
        A single one to be judged instead; of a beam that is given ω = 6 rad/s in T = 3 s.
    duration : float
        End of that one [s].
    cases : sequence of str
        Names of others of the benchmark, of the paper's beam or of others, as "F+N".

    Raises
    ------
    ValueError
        If `cases` are named for a blade or spin-up of one's own, or that the code does not do.

    Examples
    --------
    >>> from analytic import SpinUp
    >>> from rotbeam_exu.fem.elements import Cable
    >>> from rotbeam_exu.verification.entries import formulation_entry
    >>> from rotbeam_exu.verification.verify import verify
    >>> entry = formulation_entry(Cable(), elements=4, step=2e-3)
    >>> print(verify(entry, spin_up=SpinUp(omega=2.0, ramp_time=3.0), duration=8.0).outcome)
    1 of 2 agrees, 1 undecided (L)
    """
    if blade is None and spin_up is None:
        names = cases or (IN_SPACE if entry.in_space else DEFAULT)
        chosen = [CASES[name] for name in names]
        if other := [case.name for case in chosen if case.in_space != entry.in_space]:
            where = "in space" if entry.in_space else "in the plane"
            raise ValueError(
                f"{entry.name} is judged by cases {where}, and {', '.join(other)} is of the others"
            )
    elif cases:
        raise ValueError(
            "cases of the benchmark have their own blades: leave out --config, or blade and spin_up"
        )
    else:
        blade, motion = blade or Beam.reference(), spin_up or SpinUp(omega=6.0, ramp_time=3.0)
        faster = blade.omega_0 / Beam.reference().omega_0
        speeds = tuple(speed * faster for speed in SPEEDS)
        chosen = [frequency_case(blade, speeds), spin_up_case(blade, motion, duration)]
    return judged(submission_of(entry, chosen), cases={case.name: case for case in chosen})


def submission_of(entry: Entry, cases: Sequence[Case]) -> Submission:
    """Run a code over the cases that it does, and return its submission.

    Frequencies and steady tips on its own meshes; histories on these meshes at twice its step, and
    on its mesh at one, two and four of its steps. What fails is on record with its sentence.
    """
    cases = [case for case in cases if case.in_space == entry.in_space]
    return Submission(
        declaration=Declaration(
            code=entry.name, theory=entry.theory, order=entry.order,
            order_in_step=entry.order_in_step,
        ),
        rows=tuple(row for case in cases for row in _rows(entry, case)),
        runs=tuple(run for case in cases for run in _runs(entry, case)),
    )  # fmt: skip


def _rows(entry: Entry, case: Case) -> Iterator[Row]:
    """Yield the rows of a table that the code has, with its sentence where it fails."""
    computations = {Asked.FREQUENCIES: entry.frequencies, Asked.STEADY: entry.steady_tip}
    compute = computations.get(case.asked)
    if compute is None:
        return
    for speed, elements in product(case.speeds, entry.own_meshes):
        numbers: list[list[float]] = [[]] * case.count
        failure = ""
        try:
            numbers = np.reshape(compute(case, speed, elements), (case.count, -1)).tolist()
        except NotImplementedError:
            continue
        except RuntimeError as error:
            failure = str(error)
        for number, values in enumerate(numbers, 1):
            yield Row(
                case=case.name, elements=elements, speed=speed, number=number,
                values=tuple(values), failure=failure,
            )  # fmt: skip


def _runs(entry: Entry, case: Case) -> list[Run]:
    """Return the runs of a history, none if the code does not do it."""
    if case.asked is not Asked.HISTORY:
        return []
    resolutions = {(elements, 2.0 * entry.step) for elements in entry.own_meshes}
    resolutions |= {(entry.elements, factor * entry.step) for factor in (1.0, 2.0, 4.0)}
    try:
        return [_run(entry, case, elements, step) for elements, step in sorted(resolutions)]
    except NotImplementedError:
        return []


def _run(entry: Entry, case: Case, elements: int, step: float) -> Run:
    nothing, started = np.empty(0), clock.perf_counter()
    run = Run(case=case.name, elements=elements, step=step, time=nothing, q=nothing)
    try:
        data = entry.simulate(case, elements=elements, step=step)
    except NotImplementedError:
        raise
    except RuntimeError as error:
        return replace(run, failure=str(error))
    # A whole number of steps may end a little later than the case.
    data = data.isel(time=data["time"].to_numpy() <= case.duration)
    verdict = str(data.attrs.get("verdict", "passed"))
    time = data["time"].to_numpy()
    q = case.joined([data[name].to_numpy() for name in case.columns])
    wall, remark = clock.perf_counter() - started, "" if verdict == "passed" else verdict
    return replace(run, time=time, q=q, wall=wall, remark=remark)
