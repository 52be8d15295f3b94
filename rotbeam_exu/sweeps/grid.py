"""Many spin-ups: a grid of cases, in parallel, resumable, on any executor."""

from __future__ import annotations

import json
import math
import os
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import CancelledError, Executor, Future, as_completed
from concurrent.futures.process import BrokenProcessPool
from functools import lru_cache
from itertools import product
from typing import Literal

import numpy as np

from analytic import Blade, SpinUp
from analytic.arrays import FloatArray
from analytic.input_checks import finite_values, whole_number
from analytic.loads import Load

from ..fem.case import RunCase
from ..fem.elements import Formulation
from ..fem.linearization import Linearization
from ..fem.simulation import run_case
from ..labels import OMEGA, dataset
from ..lazily import xr
from ..runs import Frame
from ..runs.attributes import versions
from ..runs.check import SimulationError
from ..runs.oscillation import OSCILLATION, NoOscillationError, steady_oscillation
from .cases import Cache, cache_of, worker_pool

OnError = Literal["raise", "record"]

MEASURED = {**OSCILLATION, "omega_n": "natural frequency ω_n of the mesh [rad/s]"}
"""Quantities measured of a case, with their labels."""


def sweep(
    blade: Blade,
    *,
    omegas: Sequence[float],
    ramp_times: Sequence[float],
    element: str | Formulation = "cable",
    elements: int = 16,
    duration: float = 15.0,
    step: float = 1e-3,
    frame: Frame = "inertial",
    loads: Sequence[Load] = (),
    executor: Executor | None = None,
    jobs: int | None = None,
    cache: str | os.PathLike[str] | None = None,
    progress: Callable[[int, int], None] | None = None,
    on_error: OnError = "raise",
) -> xr.Dataset:
    """Spin a beam up over a grid of speeds and ramp times, and measure each steady oscillation.

    Parameters
    ----------
    blade : Beam
        The beam.
    omegas, ramp_times : sequences of float
        The grid: steady angular velocities [rad/s] and ramp times [s], without duplicates.
    element, elements, duration, step, frame, loads
        As in `simulate`.
    executor : concurrent.futures.Executor, optional
        Where the cases run; by default as many spawned processes as `jobs`. A script that uses
        the default needs the usual ``if __name__ == "__main__":``.
    jobs : int, optional
        Number of processes of the default executor, by default the cores; 1 runs in this process.
    cache : path, optional
        Folder with one file per finished case. A sweep that was stopped, however, resumes from it.
        Results found there were made by the same code: this project's and the element's, which is
        its package, or its module and those next to it.
    progress : callable, optional
        Called with the cases done and their number.
    on_error : {"raise", "record"}
        Whether a failed case ends the sweep, or stays in the result with its sentence.

    Returns
    -------
    Dataset
        Over `omega` and `ramp_time`: amplitude, first_harmonic, offset and residual [-],
        frequency, frequency_error and omega_n [rad/s], verdict ("passed" or "failed") and failure,
        the sentence.

    Raises
    ------
    ValueError
        If the grid is empty or has duplicates, or an input is refused, mostly before any work.
    SimulationError
        If a case fails and `on_error` is "raise"; if a worker dies. Finished cases are cached.

    Examples
    --------
    >>> from analytic import Beam
    >>> from rotbeam_exu import sweep
    >>> settings = {"elements": 4, "duration": 10.0, "step": 4e-3}
    >>> data = sweep(Beam.reference(), omegas=[2.0], ramp_times=[2.5, 3.0], jobs=1, **settings)
    >>> print(data.amplitude.values.round(4), data.frequency.values.round(4))
    [[0.2758 0.1654]] [[3.0377 3.0361]]
    """
    speeds = finite_values("omegas", omegas, "rad/s").tolist()
    times = finite_values("ramp_times", ramp_times, "s").tolist()
    for name, values in (("omegas", speeds), ("ramp_times", times)):
        if twice := [f"{value:g}" for value, count in Counter(values).items() if count > 1]:
            raise ValueError(f"{name} holds {', '.join(twice)} more than once")
    cases = {
        (omega, ramp_time): RunCase(
            blade=blade, spin_up=SpinUp(omega=omega, ramp_time=ramp_time), element=element,
            elements=elements, duration=duration, step=step, frame=frame, loads=loads,
        )
        for omega, ramp_time in product(speeds, times)
    }  # fmt: skip
    if on_error not in ("raise", "record"):
        raise ValueError(f"unknown on_error {on_error!r}; known are 'raise' and 'record'")
    if jobs is not None:
        jobs = whole_number("jobs", jobs)
    store = None if cache is None else cache_of(cache, element)
    results: dict[tuple[float, float], xr.Dataset] = {}
    for done, (point, result) in enumerate(solved(cases, store, executor, jobs), start=1):
        results[point] = result
        if progress is not None:
            progress(done, len(cases))
        if result.attrs["failure"] and on_error == "raise":
            raise SimulationError(
                f"omega = {point[0]:g} rad/s, ramp_time = {point[1]:g} s: "
                f"{result.attrs['failure']}; on_error='record' keeps going"
            )
    return _table(cases, results)


def _table(
    cases: dict[tuple[float, float], RunCase],
    results: dict[tuple[float, float], xr.Dataset],
) -> xr.Dataset:
    """Return the table of a sweep, as `sweep` describes it, with all results."""
    omegas, ramp_times = (list(dict.fromkeys(values)) for values in zip(*cases, strict=True))
    dims = ("omega", "ramp_time")

    def column(name: str) -> FloatArray:
        values = np.array([results[point].attrs.get(name, math.nan) for point in cases])
        return values.reshape(len(omegas), len(ramp_times))

    first = next(iter(cases.values())).describe()
    return dataset(
        {
            **{name: (dims, column(name), label) for name, label in MEASURED.items()},
            "verdict": (dims, column("verdict"), "verdict"),
            "failure": (dims, column("failure"), "why a case failed"),
        },
        {"omega": (omegas, OMEGA), "ramp_time": (ramp_times, "ramp time T [s]")},
        {
            **{k: v for k, v in first.items() if k not in dims},
            "versions": json.dumps(versions()),
        },
    )


def failures(result: xr.Dataset) -> dict[str, list[tuple[float, float]]]:
    """Return (omega, ramp_time) [rad/s, s] of the failed cases of a sweep, by their sentence.

    Examples
    --------
    >>> from analytic import Beam
    >>> from rotbeam_exu import sweep
    >>> from rotbeam_exu.sweeps.grid import failures
    >>> coarse = {"elements": 2, "duration": 8.0, "step": 0.1, "jobs": 1}
    >>> data = sweep(Beam.reference(), omegas=[2.0], ramp_times=[3.0], on_error="record", **coarse)
    >>> for sentence, cases in failures(data).items():
    ...     print(cases, sentence.split(" over ")[0])
    [(2.0, 3.0)] the drift of the steady Jacobi energy E - ω L_z
    """
    points: dict[str, list[tuple[float, float]]] = {}
    omegas, times = (result[name].to_numpy().tolist() for name in ("omega", "ramp_time"))
    for (i, j), sentence in np.ndenumerate(result["failure"].to_numpy()):
        if sentence:
            points.setdefault(str(sentence), []).append((omegas[i], times[j]))
    return points


def solved(
    cases: dict[tuple[float, float], RunCase],
    store: Cache | None,
    executor: Executor | None,
    jobs: int | None,
) -> Iterator[tuple[tuple[float, float], xr.Dataset]]:
    """Each case with its result: from the cache first, then as the executor finishes them."""
    waiting = []
    for point, case in cases.items():
        stored = store.get(case.describe()) if store else None
        if stored is None:
            waiting.append(point)
        else:
            yield point, stored
    if not waiting:
        return
    if executor is None and jobs == 1:
        for point in waiting:
            yield point, _kept(store, cases[point], solve(cases[point]))
        return
    with worker_pool(executor, jobs, len(waiting)) as pool:
        futures: dict[Future[xr.Dataset], tuple[float, float]] = {
            pool.submit(solve, cases[point]): point for point in waiting
        }
        try:
            for finished, future in enumerate(as_completed(futures)):
                point = futures[future]
                try:
                    result = future.result()
                except (BrokenProcessPool, CancelledError) as error:
                    raise SimulationError(
                        "a worker process died, or its executor ended, with "
                        f"{len(waiting) - finished} of {len(waiting)} cases to do; run again to "
                        "resume from the cache"
                    ) from error
                yield point, _kept(store, cases[point], result)
        finally:
            # Reached early on an error, on Ctrl-C, or when the caller stops listening.
            for future in futures:
                future.cancel()


def _kept(store: Cache | None, case: RunCase, result: xr.Dataset) -> xr.Dataset:
    if store:
        store.put(case.describe(), result)
    return result


def solve(case: RunCase) -> xr.Dataset:
    """Run one case and measure it: the unit of work, a pure function of the case.

    Return q over `time`, with the measured numbers and the verdict as attributes. Of a case that
    fails, the attributes alone: `failure` says why.
    """
    try:
        run = run_case(case)
        measured = _steady(run)
        mesh = _mesh(case.blade, case.omega, case.model, case.elements)
        measured["omega_n"] = mesh.frequency_near(measured["frequency"])
    except SimulationError as error:
        return xr.Dataset(attrs={"verdict": "failed", "failure": str(error)})
    result = run[["q"]]
    result.attrs = {**measured, "verdict": run.attrs["verdict"], "failure": ""}
    return result


def _steady(run: xr.Dataset) -> dict[str, float]:
    """Measure the steady oscillation; what cannot be measured fails the case, not the sweep."""
    try:
        steady = steady_oscillation(run)
    except NoOscillationError as error:
        raise SimulationError(str(error)) from error
    measured = {name: float(getattr(steady, name)) for name in MEASURED if name != "omega_n"}
    for name, value in measured.items():
        if not math.isfinite(value):
            raise SimulationError(f"the {MEASURED[name]} was measured as {value}")
    return measured


@lru_cache(maxsize=64)
def _mesh(blade: Blade, omega: float, element: Formulation, elements: int) -> Linearization:
    return Linearization.of(blade, omega, element, elements)
