"""The first linear frequency of a code, judged by its limit on the author's own meshes."""

from __future__ import annotations

from collections.abc import Sequence

from analytic import AnyBlade

from .convergence import convergence
from .outcomes import Finding, Outcome, found_of, worst_of
from .peers import Entry, FrequenciesOf

FLOOR = 1e-7
"""Relative round-off of a mesh's frequency: 1e-8 to 1e-7 of 64 to 128 elements, axial modes being
10⁸ times stiffer."""

BOUND = 1e-9
"""Relative error of the theories, to which they settle."""


def linear_frequency(
    entry: Entry, beam: AnyBlade, speeds: Sequence[float], tolerance: float
) -> Finding:
    """Return what decides of the first frequency over the speeds [rad/s]: the worst finding.

    The number on each of the entry's meshes is relative to that of its theory. What the code
    refuses on a coarse mesh is left out; on the finest it is that it does not converge. What the
    theory refuses is no verdict.
    """
    first = entry.first_frequency
    if first is None:
        return Finding(outcome=Outcome.NOT_SUBMITTED, note="not offered")
    return worst_of([_at_speed(first, entry, beam, omega, tolerance) for omega in speeds])


def _at_speed(
    first: FrequenciesOf, entry: Entry, beam: AnyBlade, omega: float, tolerance: float
) -> Finding:
    where = f"at {omega:g} rad/s"
    try:
        reference = entry.theory.first_frequency(beam, omega)
    except ValueError as error:
        return Finding(outcome=Outcome.NO_VERDICT, note=f"no reference: {error}")
    differences: dict[int, float] = {}
    failure = ""
    for elements in entry.own_meshes:
        try:
            found = first(beam, omega, elements)
        except RuntimeError as error:
            failure = str(error)
        else:
            differences[elements], failure = found / reference - 1.0, ""
    if failure:
        return Finding(outcome=Outcome.NO_LIMIT, note=failure)
    runs = convergence(
        [1.0 / elements for elements in differences],
        list(differences.values()),
        noise=FLOOR,
        declared=entry.order,
    )
    return found_of(runs, tolerance=tolerance, bound=BOUND, where=where)
