"""Frequencies of a code, linear and of backbones, judged by their limits on the author's meshes."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Mapping

from .convergence import Convergence, convergence
from .outcomes import Finding, Outcome, found_of, worst_of
from .references import Reference
from .submission import BackbonePoint, Frequency, Submission

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
    rows: dict[float, list[Frequency]] = defaultdict(list)
    for one in sorted(submission.frequencies, key=lambda one: (one.speed, one.elements)):
        rows[one.speed].append(one)
    if not rows:
        return Finding(outcome=Outcome.NOT_SUBMITTED, note="no frequencies"), {}

    def finding(speed: float) -> Finding:
        try:
            true = reference.first_frequency(speed)
        except ValueError as error:
            return Finding(outcome=Outcome.NO_VERDICT, note=f"no reference: {error}")
        if rows[speed][-1].failure:
            return Finding(outcome=Outcome.NO_LIMIT, note=rows[speed][-1].failure)
        done = [one for one in rows[speed] if not one.failure]
        values = [one.frequency / true - 1.0 for one in done]
        sizes, declared = [1.0 / one.elements for one in done], submission.declaration.order
        runs = convergence(sizes, values, noise=FLOOR, declared=declared)
        where = f"at {speed:g} rad/s"
        return found_of(runs, tolerance=tolerance, bound=reference.bound, where=where)

    found = {speed: finding(speed) for speed in rows}
    runs = {speed: one.runs for speed, one in found.items() if one.runs is not None}
    limits = {speed: one for speed, one in runs.items() if math.isfinite(one.limit)}
    return worst_of(list(found.values())), limits


def backbone(
    submission: Submission,
    reference: Reference,
    tolerance: float,
    linear: Mapping[float, Convergence],
) -> Finding:
    """Return what decides of ω_NL/ω_n - 1 over speeds and amplitudes: the worst finding.

    `linear` is, by speed, what the code's ω_n/ω_n,exact - 1 tends to; without it ω_n is the
    reference's.
    """
    rows: dict[tuple[float, float], list[BackbonePoint]] = defaultdict(list)
    for point in submission.backbone:
        rows[point.speed, point.amplitude].append(point)
    found, declared = [], submission.declaration.order
    for (speed, amplitude), points in rows.items():
        where = f"at {speed:g} rad/s and a = {amplitude:g}"
        try:
            true = reference.frequency_at(amplitude, speed)
            shift = true / reference.first_frequency(speed) - 1.0
        except (RuntimeError, ValueError) as error:
            note = f"no reference {where}: {error}"
            found.append(Finding(outcome=Outcome.NO_VERDICT, note=note))
            continue
        off, doubt = (linear[speed].limit, linear[speed].bar) if speed in linear else (0.0, 0.0)
        values = [(point.frequency / true - 1.0 - off) / shift for point in points]
        runs = convergence([1.0 / one.elements for one in points], values, declared=declared)
        bound = (reference.bound + doubt) / abs(shift)
        found.append(found_of(runs, tolerance=tolerance, bound=bound, where=where))
    return worst_of(found)
