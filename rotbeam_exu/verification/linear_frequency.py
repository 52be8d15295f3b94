"""The first linear frequency of a code, judged by its limit on the author's own meshes."""

from __future__ import annotations

import math

from .convergence import Convergence, convergence
from .outcomes import Finding, Outcome, found_of, worst_of
from .references import Reference
from .submission import Frequency, Submission

FLOOR = 1e-7
"""Relative round-off of a mesh's frequency: 1e-8 to 1e-7 of 64 to 128 elements, axial modes being
10⁸ times stiffer."""


def linear_frequency(
    submission: Submission, reference: Reference, tolerance: float
) -> tuple[Finding, dict[float, Convergence]]:
    """Return what decides of the first frequency over the speeds: the worst finding.

    The number on each mesh is relative to the reference's. What the code refuses on a coarse mesh
    is left out; on the finest it is that it does not converge. What the theory refuses is no
    verdict.

    Returns
    -------
    finding : Finding
    limits : dict
        By speed [rad/s], ω_n over the reference less one.
    """
    speeds = sorted({one.speed for one in submission.frequencies})
    if not speeds:
        return Finding(outcome=Outcome.NOT_SUBMITTED, note="no frequencies"), {}
    found = {speed: _at_speed(speed, submission, reference, tolerance) for speed in speeds}
    limits = {
        speed: one.runs
        for speed, one in found.items()
        if one.runs is not None and math.isfinite(one.runs.limit)
    }
    return worst_of(list(found.values())), limits


def _at_speed(
    speed: float, submission: Submission, reference: Reference, tolerance: float
) -> Finding:
    where = f"at {speed:g} rad/s"
    try:
        true = reference.first_frequency(speed)
    except ValueError as error:
        return Finding(outcome=Outcome.NO_VERDICT, note=f"no reference: {error}")
    on_meshes = sorted((one for one in submission.frequencies if one.speed == speed), key=_elements)
    if on_meshes[-1].failure:
        return Finding(outcome=Outcome.NO_LIMIT, note=on_meshes[-1].failure)
    done = [one for one in on_meshes if not one.failure]
    runs = convergence(
        [1.0 / one.elements for one in done],
        [one.frequency / true - 1.0 for one in done],
        noise=FLOOR,
        declared=submission.declaration.order,
    )
    return found_of(runs, tolerance=tolerance, bound=reference.bound, where=where)


def _elements(one: Frequency) -> int:
    return one.elements
