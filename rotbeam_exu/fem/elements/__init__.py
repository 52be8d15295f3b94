"""The beam formulations by the names a user gives them, in the plane and in space."""

from __future__ import annotations

from collections.abc import Callable

from analytic import Blade
from analytic.description import describe
from analytic.input_checks import shown
from analytic.unit_blade import UNIFORM

from ...runs import Frame
from .ancf3 import Ancf3
from .cable import Cable, SpaceCable
from .formulation import Chain, Formulation
from .linear_frames import Linear, Substructures
from .reissner import Exact
from .reissner_in_space import SpaceExact

_ELEMENTS: tuple[type[Formulation], ...] = (
    Cable, Exact, Ancf3, Linear, Substructures, SpaceCable, SpaceExact,
)  # fmt: skip

FORMULATIONS = {cls.name: cls for cls in _ELEMENTS}
"""The class of each formulation, in the plane or in space; its fields are its options."""


def formulation(element: str | Formulation) -> Formulation:
    """Return the formulation called `element`, or say which are known; pass a Formulation."""
    if not isinstance(element, str):
        try:  # whether it hashes, and a file can hold it
            _ = hash(element), describe(element)
            if isinstance(element, Formulation):
                return element
        except TypeError:
            pass
        raise TypeError(
            "element must be the name of a formulation, or an instance of a frozen dataclass "
            "that inherits from a kind of node and whose options are numbers and text, as "
            f"Exact(nodes=3), got {shown(element)}"
        )
    if element not in FORMULATIONS:
        names = ", ".join(map(repr, FORMULATIONS))
        raise ValueError(f"unknown element {element!r}; known are {names}")
    return FORMULATIONS[element]()


def require_modeled(blade: Blade, model: Formulation, frame: Frame = "inertial") -> None:
    """Refuse a blade that the formulation does not model, or not in this frame.

    The sentence names the property of the blade, and the formulations that take it.
    """
    model.require_section(blade)
    if frame not in ("inertial", "rotating"):
        raise ValueError(f"unknown frame {frame!r}; known are 'inertial' and 'rotating'")
    if frame == "inertial" and (setting := model.setting(blade)) != 1.0:
        raise ValueError(
            "in the inertial frame the models turn in their plane of bending, and this blade has a "
            f"setting angle with the cosine {setting:.4g}: take frame='rotating'"
        )
    unit = blade.unit
    if unit == UNIFORM:
        return
    if not model.takes_blades:
        raise ValueError(
            f"element {model.name!r} is for the uniform beam at the axis, and this blade has "
            f"{unit.differences}: take {_any_of(model, lambda cls: cls.takes_blades)}"
        )
    if any(unit.damping.of_strains) and not model.takes_viscosity:
        raise ValueError(
            f"element {model.name!r} has no viscosity, and this blade has damping of its strains: "
            f"take {_any_of(model, lambda cls: cls.takes_viscosity)}, or external damping"
        )
    if unit.damping.shear and not model.twists:
        raise ValueError(
            f"element {model.name!r} has no damping of shear: leave shear out of Damping, or take "
            f"{_any_of(model, lambda cls: cls.twists)}"
        )


def require_joint(model: Formulation) -> None:
    """Refuse a formulation whose root no joint of Exudyn's holds."""
    if not model.joint:
        raise ValueError(
            f"no joint clamps element {model.name!r} to the marker of a body: take "
            f"{_any_of(model, lambda cls: bool(cls.joint))}, or a prescribed rotation"
        )


def _any_of(model: Formulation, able: Callable[[type[Formulation]], bool]) -> str:
    """Return the names of those that are able to, first of as many dimensions as the model's."""
    able_ones = [cls for cls in FORMULATIONS.values() if able(cls)]
    alike = [cls for cls in able_ones if cls.leaves_plane == model.leaves_plane] or able_ones
    *most, last = [repr(cls.name) for cls in alike]
    return f"{', '.join(most)} or {last}" if most else last


__all__ = [
    "FORMULATIONS", "Ancf3", "Cable", "Chain", "Exact",
    "Formulation", "Linear", "SpaceCable", "SpaceExact", "Substructures", "formulation",
    "require_joint", "require_modeled",
]  # fmt: skip
