"""The variants of the reduced model: settings of the one Lagrangian's two switches.

    model   shape                       axial model
    CI      cantilever mode             inextensible, as printed (Sec. 3)
    CE      cantilever mode             elongation by the sine (Sec. 4)
    FrI     rotating mode               inextensible, as printed (Sec. 5)
    FrE     rotating mode               elongation by the sine (Sec. 5)
    P3-P5   static deflections          inextensible, as printed (Tables 1-3)
    FrC     rotating mode               consistent foreshortening; not in the paper
    FrM     rotating mode               FrC with the Coriolis coupling to all other bending modes
    FrM5    rotating mode               FrM with the fifth order, κ a⁴ of the frequency

Only FrM and FrM5 have the right λ_ω to leading order, for the inextensible beam: -v'⁴/8 and the
other modes both enter at that order. So does the extension: the extensible beam's λ_ω is higher by
3.9 μ at rest and 5.4 μ at w̄ = 12, 1e-5 for the paper's beam. Its ω_n is lower by about μw̄² ω_n.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

from ..input_checks import flag
from .lagrangian import Axial, axial_model
from .shapes import CantileverMode, Shape, rotating_mode, static_deflection

_MODES: dict[str, Callable[[float], Shape]] = {
    "cantilever": lambda _: CantileverMode(),
    "rotating": rotating_mode,
}


@dataclass(frozen=True, kw_only=True)
class Variant:
    """One setting of the Lagrangian's two switches, and whether the other modes take part.

    Parameters
    ----------
    name : str
        Name of the model.
    shape : {"cantilever", "rotating"} or Shape
        One of the two modes, or a shape that does not depend on the speed, as
        `static_deflection(3)`.
    axial : str
        One of `lagrangian.AXIAL_MODELS`; "none" is the linear model, Eq. 45.
    coriolis : bool
        Whether the other bending modes are eliminated to cubic order; rotating mode and consistent
        foreshortening only.
    order : int
        3, or 5 with the next term of the frequency, -κ a⁴; with the other modes only, for without
        them it would be of no use.

    Examples
    --------
    >>> from analytic import Beam, Variant, reduced_model
    >>> mine = Variant(name="mine", shape="cantilever", axial="consistent")
    >>> print(f"{reduced_model(Beam.reference(), 6.0, mine).lambda_omega:.5f}")
    -0.08363
    """

    name: str
    shape: Literal["cantilever", "rotating"] | Shape
    axial: Axial
    coriolis: bool = False
    order: Literal[3, 5] = 3

    def __post_init__(self) -> None:
        axial_model(self.axial)
        if not isinstance(self.shape, Shape) and self.shape not in _MODES:
            raise ValueError(f"shape must be {', '.join(_MODES)} or a Shape, got {self.shape!r}")
        if flag("coriolis", self.coriolis) and not self.is_of_any_blade:
            raise ValueError(
                f"the Coriolis coupling is eliminated about the rotating mode with consistent "
                f"foreshortening, got shape {self.shape!r} and axial {self.axial!r}: take shape "
                f'"rotating" and axial "consistent"'
            )
        if self.order not in {3, 5}:
            raise ValueError(f"order must be 3 or 5, got {self.order!r}")
        if self.order == 5 and not self.coriolis:
            raise ValueError(
                "the fifth order needs the other modes, got coriolis=False: take FrM5, or order 3"
            )

    @property
    def is_of_any_blade(self) -> bool:
        """Whether it assumes no more than a straight, inextensible blade: FrC's and FrM's."""
        return self.shape == "rotating" and self.axial == "consistent"

    def shape_at(self, w_bar: float) -> Shape:
        """Return φ_v; only the rotating mode depends on the normalized speed `w_bar`."""
        return _MODES[self.shape](w_bar) if isinstance(self.shape, str) else self.shape


VARIANTS: dict[str, Variant] = {
    variant.name: variant
    for variant in (
        Variant(name="CI", shape="cantilever", axial="inextensible"),
        Variant(name="CE", shape="cantilever", axial="sine"),
        Variant(name="FrI", shape="rotating", axial="inextensible"),
        Variant(name="FrE", shape="rotating", axial="sine"),
        Variant(name="P3", shape=static_deflection(3), axial="inextensible"),
        Variant(name="P4", shape=static_deflection(4), axial="inextensible"),
        Variant(name="P5", shape=static_deflection(5), axial="inextensible"),
        Variant(name="FrC", shape="rotating", axial="consistent"),
        Variant(name="FrM", shape="rotating", axial="consistent", coriolis=True),
        Variant(name="FrM5", shape="rotating", axial="consistent", coriolis=True, order=5),
    )
}


def variant_named(name: str | Variant) -> Variant:
    """Return a variant, or that of the name, refusing others with a list of them."""
    if isinstance(name, Variant):
        return name
    if name not in VARIANTS:
        raise ValueError(f"variant must be one of {', '.join(VARIANTS)}, got {name!r}")
    return VARIANTS[name]
