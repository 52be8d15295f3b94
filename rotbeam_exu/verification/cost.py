"""What a code costs at equal error."""

from __future__ import annotations

import contextlib
import math
import time as clock

import numpy as np

from analytic import AnyBlade, Beam, SpinUp
from analytic.arrays import FloatArray

from .measures import faster_than_paper, history_error, whole_duration
from .peers import Entry

LADDER = ((4, 4e-3), (8, 2e-3), (16, 1e-3), (32, 5e-4))
"""Meshes and steps [s] by which the cost at equal error is found; steps scaled as speeds are."""


def cost_at_error(
    entry: Entry,
    error: float = 1e-2,
    *,
    beam: AnyBlade | None = None,
    spin_up: SpinUp | None = None,
) -> tuple[float, FloatArray]:
    """Return the wall time [s] at which a code reaches an error, and the ladder it is read from.

    LADDER's runs of twice the ramp time are timed one after the other, on one core if the caller
    sees to it; the error is the largest of q(t) over max|q|; time over error is interpolated
    between runs, logarithmically. NaN where the ladder does not reach the error; where even its
    first run is better, the time of that, an upper bound.

    Returns
    -------
    seconds : float
    ladder : ndarray (runs, 2)
        Error and seconds of each run.
    """
    beam = Beam.reference() if beam is None else beam
    spin_up = SpinUp(omega=6.0, ramp_time=3.0) if spin_up is None else spin_up
    ladder = np.full((len(LADDER), 2), math.nan)
    coarsest = LADDER[0][1] / faster_than_paper(beam)
    with contextlib.suppress(RuntimeError):  # the first run loads the code; it does not count
        entry.simulate(
            beam,
            spin_up,
            elements=LADDER[0][0],
            duration=whole_duration(2.0 * spin_up.ramp_time, coarsest),
            step=coarsest,
        )
    for rung, (elements, step_of_paper) in zip(ladder, LADDER, strict=True):
        step = step_of_paper / faster_than_paper(beam)
        duration = whole_duration(2.0 * spin_up.ramp_time, step)
        started = clock.perf_counter()
        try:
            run = entry.simulate(
                beam,
                spin_up,
                elements=elements,
                duration=duration,
                step=step,
            )
        except RuntimeError:
            continue
        rung[1] = clock.perf_counter() - started
        rung[0] = history_error(run, beam, spin_up)
    finished = ladder[np.isfinite(ladder[:, 0])]
    if not finished.size:
        return math.nan, ladder
    errors, seconds = np.log(finished[np.argsort(finished[:, 0])]).T
    at_error = np.interp(math.log(error), errors, seconds, left=math.nan)
    return math.exp(float(at_error)), ladder
