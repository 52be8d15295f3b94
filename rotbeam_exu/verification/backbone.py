"""Backbones of a code, judged by the limit of their nonlinear shift on the author's own meshes."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping

from .convergence import Convergence, convergence
from .outcomes import Finding, Outcome, found_of, worst_of
from .references import Reference
from .submission import BackbonePoint, Submission


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
    return worst_of(
        [
            _at(speed, a, points, submission, reference, tolerance, linear.get(speed))
            for (speed, a), points in rows.items()
        ]
    )


def _at(
    speed: float,
    amplitude: float,
    points: list[BackbonePoint],
    submission: Submission,
    reference: Reference,
    tolerance: float,
    linear: Convergence | None,
) -> Finding:
    where = f"at {speed:g} rad/s and a = {amplitude:g}"
    try:
        true = reference.frequency_at(amplitude, speed)
        shift = true / reference.first_frequency(speed) - 1.0
    except (RuntimeError, ValueError) as error:
        return Finding(outcome=Outcome.NO_VERDICT, note=f"no reference {where}: {error}")
    off, doubt = (0.0, 0.0) if linear is None else (linear.limit, linear.bar)
    runs = convergence(
        [1.0 / point.elements for point in points],
        [(point.frequency / true - 1.0 - off) / shift for point in points],
        declared=submission.declaration.order,
    )
    bound = (reference.bound + doubt) / abs(shift)
    return found_of(runs, tolerance=tolerance, bound=bound, where=where)
