"""The axial models: how the point x moves along the beam when the beam deflects by v.

    "none"          u = 0                                     linear model, Eq. 45
    "inextensible"  u' = -½v'²                                Eq. 25, as printed
    "consistent"    u' = -½v'² - ⅛v'⁴                         with the term Eq. 25 drops
    "sine"          u = φ_u q² + Δl, φ_ω = sin(πx/2)          Eqs. 66-68, as printed
    "static"        u = φ_u q² + Δl, φ_ω = (3x - x³)/2        the static solution

One definition each, for numbers and for symbols.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal

Axial = Literal["none", "inextensible", "consistent", "sine", "static"]

Elongation = Callable[[Any, Any], tuple[Any, Any, Any]]
"""φ_ω, φ_ω', φ_ω'' at x, with sin, cos and pi of the library given: numpy or sympy."""


@dataclass(frozen=True, kw_only=True)
class AxialModel:
    """The order of the foreshortening, and the shape of the elongation."""

    name: Axial  # in a `Variant`
    order: int = 2  # highest power of v' kept in u' = -½v'² - ⅛v'⁴: 0, 2 or 4
    elongation: Elongation | None = None  # φ_ω of Δl ~ μ w̄² φ_ω, Eq. 67; None if inextensible


def _sine(x: Any, library: Any) -> tuple[Any, Any, Any]:
    """Return Eq. 68, the first axial mode, which is not the static solution."""
    k = library.pi / 2
    return library.sin(k * x), k * library.cos(k * x), -(k**2) * library.sin(k * x)


def _static(x: Any, library: Any) -> tuple[Any, Any, Any]:
    """Return what solves the static problem EA u'' = -mω²x/L, Eq. 67."""
    del library
    return (3 * x - x**3) / 2, 3 * (1 - x**2) / 2, -3 * x


AXIAL_MODELS: dict[str, AxialModel] = {
    model.name: model
    for model in (
        AxialModel(name="none", order=0),
        AxialModel(name="inextensible"),
        AxialModel(name="consistent", order=4),
        AxialModel(name="sine", elongation=_sine),
        AxialModel(name="static", elongation=_static),
    )
}


def axial_model(name: str) -> AxialModel:
    """Return the axial model of that name, refusing others with a list of them."""
    if name not in AXIAL_MODELS:
        raise ValueError(f"axial must be one of {', '.join(AXIAL_MODELS)}, got {name!r}")
    return AXIAL_MODELS[name]
