"""A mistake that explains an error, and how it is chosen among others."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from analytic.arrays import FloatArray

from ..outcomes import Finding

LEFT = 0.2
"""Share of the error that may be left by what explains it; meshes and steps have a share in it."""


def most_left(tolerance: float, history: Finding | None) -> float:
    """Return what a mistake may leave: a third of what passes, and the finest run's own error.

    That error is known where meshes and steps have a limit; more than passes is not excused.
    """
    runs = history.runs if history else None
    own = abs(float(runs.errors[-1])) if runs is not None and np.isfinite(runs.limit) else 0.0
    return tolerance / 3.0 + min(own, tolerance)


@dataclass(frozen=True, kw_only=True)
class Mistake:
    """An explanation of the error of a case.

    Attributes
    ----------
    case : str
    name : str
        Of the mistake, the same in all cases: "sign of q".
    said : str
        What seems to have happened, and what to do.
    before, after : float
        Errors with it and without it, both over the same scale.
    """

    case: str
    name: str
    said: str
    before: float
    after: float

    def __str__(self) -> str:
        return f"{self.said} (error {self.before:.1e}, without it {self.after:.1e})"


def explaining(
    case: str, before: float, most: float, suspects: Iterable[tuple[str, str, float]]
) -> Mistake | None:
    """Return the mistake that leaves least, if it leaves `most` at most and explains the error.

    Suspects are names, sentences and what each leaves.
    """
    name, said, after = min(suspects, key=lambda one: one[2], default=("", "", np.inf))
    if not after <= min(most, LEFT * before):
        return None
    return Mistake(case=case, name=name, said=said, before=before, after=after)


def largest(values: FloatArray) -> float:
    """Return the largest absolute value."""
    return float(np.abs(values).max())
