"""The shape of a section, from which follows how a blade bends and twists out of its plane.

A new shape is a frozen dataclass that inherits from `SectionShape`, with fields whose types say
what they are: `Length`, `Ratio` or `Count`.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields
from functools import cache, partial
from typing import Annotated, get_args, get_type_hints

from .description import Described
from .input_checks import not_negative, positive, shown, whole_number
from .section import OutOfPlane

_SAME = 0.01  # what rounded lengths may differ from A and I

Length = Annotated[float, "length"]
"""A field in m, above zero."""
Ratio = Annotated[float, "ratio"]
"""A field without a unit, zero or more."""
Count = Annotated[int, "count"]
"""A field that is a whole number, from 1 on."""

_CHECKS: Mapping[str, Callable[[str, object], float]] = {
    "length": partial(positive, unit="m"),
    "ratio": not_negative,
    "count": whole_number,
}


@dataclass(frozen=True, kw_only=True)
class Gyration:
    """I/A [m²], which is EI/EA whatever the material, and A [m²] if it is known."""

    squared: float
    area: float | None = None


@dataclass(frozen=True, kw_only=True)
class SectionShape(Described, ABC, abstract=True):
    """Shape of a section at the root; lengths [m] that are left out follow from the blade.

    Parameters
    ----------
    poisson_ratio : float
        ν of the shear modulus E/(2 (1 + ν)).

    Raises
    ------
    ValueError
        If a value is out of range, or there is no such shape; of a blade, if the shape has another
        I/A or A than it.
    TypeError
        If a value is no number, or the class does not say of a field whether it is a `Length`, a
        `Ratio` or a `Count`.
    """

    poisson_ratio: Ratio = 0.3

    def __post_init__(self) -> None:
        for field in fields(self):
            value = getattr(self, field.name)
            if value is not None or field.default is not None:
                check = _CHECKS[_sorts(type(self))[field.name]]
                self._keep(**{field.name: check(field.name, value)})
        if self.poisson_ratio > 0.5:
            raise ValueError(f"poisson_ratio must be at most 0.5, got {self.poisson_ratio:g}")
        if not self._missing:
            self._gyration(self._given)  # refuses lengths that no shape has

    @abstractmethod
    def _fitting(self, gyration: Gyration) -> dict[str, float]:
        """Return the lengths [m] by name that follow from I/A and, if it is known, A."""

    @abstractmethod
    def _gyration(self, lengths: Mapping[str, float]) -> Gyration:
        """Return I/A and A of these lengths [m]."""

    @abstractmethod
    def _ratios(self, lengths: Mapping[str, float]) -> tuple[float, float]:
        """Return I out of the plane and the torsion constant J over I."""

    def out_of_plane(self, gyration: Gyration) -> OutOfPlane:
        """Return the stiffness out of the plane, refusing what contradicts the blade's `own`."""
        lengths = self._fitting(gyration) | self._given
        if difference := self._difference(lengths, gyration):
            fitting = type(self)()._fitting(gyration)
            remedy = f"{', '.join(f'{name}={x:.4g}' for name, x in fitting.items())} fits it"
            if not fitting or (gyration.area and self._difference(fitting, gyration)):
                remedy = "take another shape, or with_section_out_of_plane"
            raise ValueError(f"{self!r} has {difference} of this blade: {remedy}")
        across, torsion = self._ratios(lengths)
        shear = 0.5 / (1.0 + self.poisson_ratio)
        return OutOfPlane(bending_ratio=across, torsion_ratio=shear * torsion)

    def _difference(self, lengths: Mapping[str, float], gyration: Gyration) -> str:
        """Return how the lengths contradict a blade's `own`, empty if they do not."""
        has = self._gyration(lengths)
        for what, value, target in (
            ("I/A", has.squared, gyration.squared), ("A", has.area, gyration.area)
        ):  # fmt: skip
            off = abs(value / target - 1.0) if value and target else 0.0
            if off > _SAME:
                return f"{what} = {value:.4g} m², {100.0 * off:.3g} % from the {target:.4g} m²"
        return ""

    @abstractmethod
    def _shear(self, lengths: Mapping[str, float]) -> tuple[float, float]:
        """Return the shear coefficients along height and width."""

    def of_material(
        self, youngs_modulus: float, density: float
    ) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """Return a station's columns, the height along the chord: EA ... EI3, and m ... j3.

        As `Blade.from_stations` takes them; GA2 and GA3 have Cowper's shear coefficients (1966).

        Parameters
        ----------
        youngs_modulus, density : float
            E [N/m²] and ρ [kg/m³].

        Raises
        ------
        ValueError
            If the shape does not determine all its lengths.
        """
        E, rho = (
            positive("youngs_modulus", youngs_modulus, "Pa"),
            positive("density", density, "kg/m^3"),
        )
        if self._missing:
            raise ValueError(f"{self!r} along a blade needs {' and '.join(self._missing)} [m]")
        gyration = self._gyration(self._given)
        A = gyration.area or math.nan
        inertia, G = gyration.squared * A, 0.5 * E / (1.0 + self.poisson_ratio)
        (across, torsion), (k2, k3) = self._ratios(self._given), self._shear(self._given)
        stiffness = E * A, k2 * G * A, k3 * G * A, G * torsion * inertia, E * across * inertia
        j2, j3 = rho * across * inertia, rho * inertia
        return (*stiffness, E * inertia), (rho * A, j2 + j3, j2, j3)

    @property
    def _lengths(self) -> dict[str, float | None]:
        sorts = _sorts(type(self)).items()
        return {name: getattr(self, name) for name, sort in sorts if sort == "length"}

    @property
    def _given(self) -> dict[str, float]:
        return {name: length for name, length in self._lengths.items() if length is not None}

    @property
    def _missing(self) -> list[str]:
        return [name for name, length in self._lengths.items() if length is None]


@cache
def _sorts(cls: type[SectionShape]) -> dict[str, str]:
    """Return whether each field of a shape is a length, a ratio or a count."""
    sorts = {}
    hints = get_type_hints(cls, include_extras=True)
    for field in fields(cls):
        hint = hints[field.name]
        marks = [
            one for part in (hint, *get_args(hint)) for one in getattr(part, "__metadata__", ())
        ]
        if not marks or marks[0] not in _CHECKS:
            raise TypeError(
                f"{cls.__name__} does not say what {field.name} is: let its type be Length, Ratio "
                "or Count of analytic.section_shape, each as | None where it may be left out"
            )
        sorts[field.name] = marks[0]
    return sorts


def require_shape(shape: object) -> None:
    """Refuse what is no shape of a section."""
    if not isinstance(shape, SectionShape):
        raise TypeError(f"a SectionShape is needed, got {shown(shape)}: as Rectangle()")
