"""The beam formulations, behind one protocol, by the name a user gives them."""

from __future__ import annotations

from .cable import Cable
from .formulation import Chain, Formulation

FORMULATIONS: dict[str, Formulation] = {"cable": Cable()}


def formulation(element: str) -> Formulation:
    """Return the formulation called `element`; an unknown name is refused with the known ones."""
    if element not in FORMULATIONS:
        known = ", ".join(repr(name) for name in FORMULATIONS)
        raise ValueError(f"unknown element {element!r}; known are {known}")
    return FORMULATIONS[element]


__all__ = ["FORMULATIONS", "Chain", "Formulation", "formulation"]
