"""The beam formulations, behind one protocol, by the name a user gives them."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import Any

from analytic import AnyBlade
from analytic.input_checks import shown
from analytic.unit_blade import UNIFORM

from .ancf3 import Ancf3
from .cable import Cable
from .formulation import Chain, Formulation
from .linear_frames import Linear, Substructures
from .reissner import Exact

FORMULATIONS: dict[str, type[Any]] = {
    cls.name: cls for cls in (Cable, Exact, Ancf3, Linear, Substructures)
}
"""The class of each formulation, a frozen dataclass whose fields are its options."""


ALIASES = {"reissner": "exact"}
"""Other names of formulations: "exact" is Reissner's beam, not the exact continuum."""


def formulation(
    element: str | Formulation, options: Mapping[str, object] | None = None
) -> Formulation:
    """Return the formulation called `element`, with `options`; a Formulation is passed through.

    Raises
    ------
    ValueError
        If the name, or an option of it, is not known: the sentence says which are.
    """
    if not isinstance(element, str):
        require_formulation(element)
        return element
    element = ALIASES.get(element, element)
    if element not in FORMULATIONS:
        names = ", ".join(repr(name) for name in FORMULATIONS)
        raise ValueError(
            f"unknown element {element!r}; known are {names}; other codes are in "
            "rotbeam_exu.verification.peers"
        )
    cls = FORMULATIONS[element]
    known = [field.name for field in dataclasses.fields(cls)]
    for name in options or {}:
        if name not in known:
            has = f"its options are {', '.join(known)}" if known else "it has no options"
            raise ValueError(f"element {element!r} has no option {name!r}; {has}")
    model: Formulation = cls(**(options or {}))
    return model


def require_formulation(element: object) -> None:
    """Refuse what is neither the name of a formulation nor one."""
    if not hasattr(element, "lay"):
        raise TypeError(
            "element must be the name of a formulation, or one, which is an instance of a frozen "
            f"dataclass, as Exact(nodes=3), got {shown(element)}"
        )


def require_modeled(beam: AnyBlade, model: Formulation) -> None:
    """Refuse a blade that the formulation does not model.

    Raises
    ------
    ValueError
        Naming what it is that the blade has, and which formulations take it.
    """
    unit = beam.unit
    if unit == UNIFORM:
        return
    if not getattr(model, "takes_blades", False):
        raise ValueError(
            f"element {model.name!r} is for the uniform beam at the axis, and this blade has "
            f"{unit.differences}: take {_those_with('takes_blades')}"
        )
    bending, axial, _ = unit.damping
    if (bending or axial) and not getattr(model, "takes_viscosity", False):
        raise ValueError(
            f"element {model.name!r} has no viscosity, and this blade has bending or axial "
            f"damping: take {_those_with('takes_viscosity')}, or external damping"
        )


def _those_with(ability: str) -> str:
    names = [repr(name) for name, cls in FORMULATIONS.items() if getattr(cls, ability, False)]
    return f"{', '.join(names[:-1])} or {names[-1]}"


def options_of(element: Formulation) -> dict[str, Any]:
    """Return the options of a formulation by name, such that `formulation` makes it again."""
    return dataclasses.asdict(element)  # type: ignore[call-overload, no-any-return]


__all__ = [
    "ALIASES",
    "FORMULATIONS",
    "Ancf3",
    "Cable",
    "Chain",
    "Exact",
    "Formulation",
    "Linear",
    "Substructures",
    "formulation",
    "options_of",
    "require_formulation",
    "require_modeled",
]
