"""The beam formulations by the names a user gives them, in the plane and in space."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping
from typing import Any

from analytic import AnyBlade
from analytic.description import describe
from analytic.input_checks import shown
from analytic.unit_blade import UNIFORM

from ..frame import Frame, require_frame
from .ancf3 import Ancf3
from .cable import Cable, SpaceCable
from .formulation import Chain, Formulation
from .linear_frames import Linear, Substructures
from .reissner import Exact
from .reissner_in_space import SpaceExact

_ELEMENTS: tuple[type[Formulation], ...] = (
    Cable, Exact, Ancf3, Linear, Substructures, SpaceCable, SpaceExact,
)  # fmt: skip

FORMULATIONS, SPACE_FORMULATIONS = (
    {cls.name: cls for cls in _ELEMENTS if cls.leaves_plane is leaves} for leaves in (False, True)
)
"""The class of each formulation in the plane, and in space; its fields are its options."""

ALIASES = {"reissner": "exact"}
"""Other names of formulations: "exact" is Reissner's beam, not the exact continuum."""


def formulation(
    element: str | Formulation,
    options: Mapping[str, object] | None = None,
    *,
    in_space: bool = False,
) -> Formulation:
    """Return the formulation called `element`, with `options`; a Formulation is passed through.

    Raises
    ------
    ValueError
        If the name, or an option of it, is not known: the sentence says which are.
    """
    if not isinstance(element, str):
        if not _is_formulation(element):
            raise TypeError(
                "element must be the name of a formulation, or an instance of a frozen dataclass "
                "that inherits from a kind of node and whose options are numbers and text, as "
                f"Exact(nodes=3), got {shown(element)}"
            )
        return element
    element = ALIASES.get(element, element)
    known = SPACE_FORMULATIONS if in_space else FORMULATIONS
    if element not in known:
        names = ", ".join(map(repr, known))
        raise ValueError(
            f"unknown element {'in space ' if in_space else ''}{element!r}; known are {names}; "
            "other codes are in rotbeam_exu.verification.peers"
        )
    cls: Any = known[element]
    fields = [field.name for field in dataclasses.fields(cls)]
    for name in options or {}:
        if name not in fields:
            has = f"its options are {', '.join(fields)}" if fields else "it has no options"
            raise ValueError(f"element {element!r} has no option {name!r}; {has}")
    model: Formulation = cls(**(options or {}))
    return model


def _is_formulation(element: object) -> bool:
    """Whether it is one, hashes, and a file can hold it."""
    try:
        _ = hash(element), describe(element)
    except TypeError:
        return False
    return isinstance(element, Formulation)


def require_modeled(beam: AnyBlade, model: Formulation, frame: Frame = "inertial") -> None:
    """Refuse a blade that the formulation does not model, or not in this frame.

    Raises
    ------
    ValueError
        It names the property of the blade, and the formulations that take it.
    """
    require_frame(beam, frame)
    if frame not in model.frames:
        raise ValueError(
            f"element {model.name!r} is solved in the {' or '.join(model.frames)} frame, its "
            f"inertia being no constant matrix: take frame={model.frames[0]!r}"
        )
    model.require_section(beam)
    unit = beam.unit
    if unit == UNIFORM:
        return
    if model.leaves_plane and any(unit.damping):
        raise ValueError(
            "simulate_3d is for undamped blades, as Exudyn's geometrically exact beam ignores its "
            f"damping: this one has {unit.differences}; take "
            "blade.with_damping(Damping())"
        )
    if model.leaves_plane and unit.masses:
        raise ValueError(
            f"simulate_3d is for blades without point masses, and this one has {unit.differences}"
        )
    if not model.takes_blades:
        raise ValueError(
            f"element {model.name!r} is for the uniform beam at the axis, and this blade has "
            f"{unit.differences}: take {_any_of(lambda cls: cls.takes_blades)}"
        )
    bending, axial, _ = unit.damping
    if (bending or axial) and not model.takes_viscosity:
        raise ValueError(
            f"element {model.name!r} has no viscosity, and this blade has bending or axial "
            f"damping: take {_any_of(lambda cls: cls.takes_viscosity)}, or external damping"
        )


def _any_of(able: Callable[[type[Formulation]], bool]) -> str:
    names = [repr(name) for name, cls in FORMULATIONS.items() if able(cls)]
    return f"{', '.join(names[:-1])} or {names[-1]}"


def options_of(element: Formulation) -> dict[str, Any]:
    """Return the options of a formulation by name, such that `formulation` makes it again."""
    return dataclasses.asdict(element)  # type: ignore[call-overload, no-any-return]


__all__ = [
    "ALIASES", "FORMULATIONS", "SPACE_FORMULATIONS", "Ancf3", "Cable", "Chain", "Exact",
    "Formulation", "Linear", "SpaceCable", "SpaceExact", "Substructures", "formulation",
    "options_of", "require_modeled",
]  # fmt: skip
