"""A mistake that explains an error, and how it is chosen among others."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

LEFT = 0.2
"""Share of the error that may be left by what explains it; meshes and steps have a share in it."""


@dataclass(frozen=True, kw_only=True)
class Mistake:
    """What explains the error of a case.

    Attributes
    ----------
    case : str
    name : str
        Of the mistake, the same in all cases: "sign of q".
    said : str
        What seems to have happened, and what to do.
    before, after : float
        Error with it, and what is left without it, both over the same scale.
    """

    case: str
    name: str
    said: str
    before: float
    after: float

    def __str__(self) -> str:
        return f"{self.said} (error {self.before:.1e}, without it {self.after:.1e})"


def explaining(candidates: Iterable[Mistake]) -> Mistake | None:
    """Return the mistake that leaves least, if it explains the error."""
    best = min(candidates, key=lambda one: one.after / one.before, default=None)
    return best if best is not None and best.after <= LEFT * best.before else None
