"""Options that several commands share: whole numbers, and a formulation's own as name=value."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Annotated, Any

from cyclopts import Parameter, Token

from ..fem.elements import Formulation, formulation


def _whole(_: Any, tokens: Sequence[Token]) -> int:
    """Read a whole number in decimal digits: 2.5 is none, and neither are 1e3 and 0x10."""
    text = tokens[0].value
    if not re.fullmatch(r"[+-]?[0-9]+", text):
        raise ValueError(f"it must be a whole number in decimal digits, got {text!r}")
    if len(text) > 300:
        raise ValueError(f"it must be a number, got {len(text)} digits")
    return int(text)


Whole = Annotated[int, Parameter(converter=_whole)]
"""A whole number."""

Jobs = Annotated[int | None, Parameter(converter=_whole)]
"""A number of processes, or as many as there are cores."""


def label(element: str, options: Sequence[str] | None) -> str:
    """Return the formulation with its options as part of a file's name."""
    return "-".join([element, *(text.replace("=", "-") for text in options or [])])


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
