"""Options of a formulation on the command line, as name=value."""

from __future__ import annotations

from collections.abc import Sequence

from ..elements import Formulation, formulation


def chosen_formulation(element: str, options: Sequence[str] | None) -> Formulation:
    """Return the formulation with its options, each given as name=value."""
    return formulation(element, dict(map(_name_and_value, options or [])))


def _name_and_value(text: str) -> tuple[str, object]:
    """Split name=value; what reads as a number is one."""
    name, equals, value = text.partition("=")
    if not (name and equals and value):
        raise ValueError(f"an option is given as name=value, got {text!r}")
    for number in (int, float):
        try:
            return name, number(value)
        except ValueError:
            continue
    return name, value
