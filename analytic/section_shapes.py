"""Shapes of sections: full and hollow rectangles and ellipses; each a `SectionShape`."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from .input_checks import positive
from .section_shape import Gyration, Length, Ratio
from .section_shape import SectionShape as SectionShape  # noqa: PLC0414  (with its kinds)
from .warning import warn

_PLACES = 61  # terms of the torsion series, whose rest is below 1e-9


@dataclass(frozen=True, kw_only=True)
class _TwoSided(SectionShape, ABC, abstract=True):
    """A shape with a height in the plane of bending and a width, or the ratio of both."""

    height: Length | None = None
    width: Length | None = None
    ratio: Ratio | None = None

    _deep: ClassVar[float]  # h² A/I
    _filled: ClassVar[float]  # A/(h b)

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.ratio is not None:
            self._keep(ratio=positive("ratio", self.ratio))
            if self.width is not None:
                raise ValueError(
                    f"give width or ratio, which is height over width, not both: {self}"
                )

    def _fitting(self, gyration: Gyration) -> dict[str, float]:
        height = math.sqrt(self._deep * gyration.squared)
        if self.ratio is not None:
            return {"height": height, "width": (self.height or height) / self.ratio}
        if gyration.area is None:
            return {"height": height}
        return {"height": height, "width": gyration.area / (self._filled * (self.height or height))}

    def _gyration(self, lengths: Mapping[str, float]) -> Gyration:
        if "width" not in lengths:
            raise ValueError(
                f"a {type(self).__name__} of unknown area needs its width: a Blade has EA and EI, "
                "no area; give width in m, or ratio, height in the plane over width"
            )
        height, area = lengths["height"], self._filled * lengths["height"] * lengths["width"]
        return Gyration(squared=height**2 / self._deep, area=area)

    def _ratios(self, lengths: Mapping[str, float]) -> tuple[float, float]:
        ratio = self.ratio or lengths["height"] / lengths["width"]
        return 1.0 / ratio**2, self._torsion(ratio)

    @abstractmethod
    def _torsion(self, ratio: float) -> float:
        """Return J/I by the ratio of height to width."""


@dataclass(frozen=True, kw_only=True)
class Rectangle(_TwoSided):
    """A rectangle, whose GJ follows from Saint-Venant's series.

    The series is in Timoshenko and Goodier, Theory of Elasticity, Sec. 109.

    Parameters
    ----------
    height, width : float, optional
        In the plane of bending and across it [m]; by default they give the beam's A and I.
    ratio : float, optional
        Height over width, in place of the width.
    poisson_ratio : float
        ν, for the shear modulus.

    Examples
    --------
    >>> from analytic import Beam, Rectangle
    >>> strip = Beam.reference().with_shape(Rectangle())
    >>> print(f"{1.0 / strip.section.out_of_plane.bending_ratio:.0f} times stiffer in its plane")
    342 times stiffer in its plane
    """

    _deep = 12.0
    _filled = 1.0

    def _shear(self, lengths: Mapping[str, float]) -> tuple[float, float]:
        nu = self.poisson_ratio
        return (10.0 * (1.0 + nu) / (12.0 + 11.0 * nu),) * 2

    def _torsion(self, ratio: float) -> float:
        longer, shorter = max(ratio, 1.0), min(ratio, 1.0)  # in widths
        odd = np.arange(1, 2 * _PLACES, 2)
        rest = np.sum(np.tanh(0.5 * np.pi * odd * longer / shorter) / odd**5.0)
        torsion = longer * shorter**3 / 3.0 * (1.0 - 192.0 / np.pi**5 * shorter / longer * rest)
        return float(torsion * 12.0 / ratio**3)


@dataclass(frozen=True, kw_only=True)
class Ellipse(_TwoSided):
    """A full ellipse with J = π a³b³/(a² + b²) and the half axes a and b; a circle has ratio=1.

    Parameters
    ----------
    height, width, ratio, poisson_ratio : float, optional
        As of a `Rectangle`.
    """

    _deep = 16.0
    _filled = 0.25 * math.pi

    def _shear(self, lengths: Mapping[str, float]) -> tuple[float, float]:
        nu, n = self.poisson_ratio, (lengths["height"] / lengths["width"]) ** 2
        return self._along(n, nu), self._along(1.0 / n, nu)

    @staticmethod
    def _along(n: float, nu: float) -> float:
        """Return the shear coefficient by the squared ratio of the sides, along over across."""
        below = (40.0 + 37.0 * nu) * n**2 + (16.0 + 10.0 * nu) * n + nu
        return 12.0 * (1.0 + nu) * n * (3.0 * n + 1.0) / below

    def _torsion(self, ratio: float) -> float:
        return 4.0 / (1.0 + ratio**2)


@dataclass(frozen=True, kw_only=True)
class Tube(SectionShape):
    """A round tube, with J = 2I.

    Parameters
    ----------
    radius, wall : float, optional
        Mean radius and thickness of the wall [m]; by default they give the beam's A and I.
    poisson_ratio : float
        ν, for the shear modulus.
    """

    radius: Length | None = None
    wall: Length | None = None

    def __post_init__(self) -> None:
        super().__post_init__()
        r, t = self.radius, self.wall
        if r is not None and t is not None and t > r:
            warn(
                f"radius = {r:g} m is that of the middle of the wall, so that a wall of {t:g} m is "
                f"between the radii {r - 0.5 * t:g} and {r + 0.5 * t:g} m: give the outer radius "
                "less half the wall"
            )

    def _fitting(self, gyration: Gyration) -> dict[str, float]:
        if gyration.area is None:
            return {"radius": math.sqrt(2.0 * gyration.squared)}
        # A = 2πrt and I/A = (r² + t²/4)/2
        thin = gyration.area / (2.0 * math.pi)
        rest = max(gyration.squared**2 - 0.25 * thin**2, 0.0)
        radius = math.sqrt(gyration.squared + math.sqrt(rest))
        return {"radius": radius, "wall": thin / radius}

    def _gyration(self, lengths: Mapping[str, float]) -> Gyration:
        r, t = lengths["radius"], lengths.get("wall", 0.0)
        if t > 2.0 * r:
            raise ValueError(
                f"the wall of a tube is at most twice its mean radius, got wall = {t:g} m and "
                f"radius = {r:g} m: {2.0 * r:g} m is the full circle"
            )
        return Gyration(squared=0.5 * (r**2 + 0.25 * t**2), area=2.0 * math.pi * r * t)

    def _ratios(self, lengths: Mapping[str, float]) -> tuple[float, float]:
        return 1.0, 2.0

    def _shear(self, lengths: Mapping[str, float]) -> tuple[float, float]:
        nu, half = self.poisson_ratio, 0.5 * lengths["wall"]
        hollow = ((lengths["radius"] - half) / (lengths["radius"] + half)) ** 2
        whole = (1.0 + hollow) ** 2
        below = (7.0 + 6.0 * nu) * whole + (20.0 + 12.0 * nu) * hollow
        return (6.0 * (1.0 + nu) * whole / below,) * 2


@dataclass(frozen=True, kw_only=True)
class Box(SectionShape):
    """A rectangular tube with sharp corners.

    J is the torsion of its straight walls and of its four corners, each the same as if the others
    were far: to 0.1 % where a wall is at most a third of the width, to 1.2 % where it closes the
    tube. Shear has the energy of Jourawski's shear flow, Q²/(2I²t), to 4 % up to a third, and
    to 8 % beyond.

    Parameters
    ----------
    height, width, wall : float
        Outside, in the plane of bending and across it, and thickness of the walls [m].
    poisson_ratio : float
        ν, for the shear modulus.

    Examples
    --------
    >>> from analytic import Blade
    >>> from analytic.section_shapes import Box
    >>> spar = Box(height=0.4, width=0.2, wall=0.01)
    >>> blade = Blade.from_shapes([0.0, 10.0], [spar, spar], youngs_modulus=7e10, density=2700.0)
    >>> print(f"{blade.mass:.0f} kg")
    313 kg
    """

    height: Length | None = None
    width: Length | None = None
    wall: Length | None = None

    def _fitting(self, gyration: Gyration) -> dict[str, float]:
        return {}  # height and wall do not follow from I/A and A alone

    def _gyration(self, lengths: Mapping[str, float]) -> Gyration:
        if len(lengths) < 3:
            raise ValueError(f"{self!r} needs height, width and wall [m]")
        h, b, t = lengths["height"], lengths["width"], lengths["wall"]
        if 2.0 * t > min(h, b):
            raise ValueError(
                f"the walls of {self!r} overlap: take wall below {0.5 * min(h, b):g} m"
            )
        area = h * b - (h - 2.0 * t) * (b - 2.0 * t)
        return Gyration(squared=_box_inertia(h, b, t) / area, area=area)

    def _ratios(self, lengths: Mapping[str, float]) -> tuple[float, float]:
        h, b, t = lengths["height"], lengths["width"], lengths["wall"]
        inertia = _box_inertia(h, b, t)
        # Stress function of torsion: c u + w, where u falls from 1 at the hole to 0 outside, and w
        # is zero on both. Integrals of u and of w, and the flow of u, are of walls and corners.
        inside, hole = 2.0 * (h + b - 4.0 * t), (h - 2.0 * t) * (b - 2.0 * t)
        flow, of_u, of_w = (
            wall * inside * t**power + 4.0 * corner * t ** (power + 1)
            for power, wall, corner in zip((-1, 1, 3), (1.0, 0.5, 1.0 / 6.0), _CORNER, strict=True)
        )
        torsion = 2.0 * of_w + 4.0 * (hole + of_u) ** 2 / flow
        return _box_inertia(b, h, t) / inertia, torsion / inertia

    def _shear(self, lengths: Mapping[str, float]) -> tuple[float, float]:
        h, b, t = lengths["height"], lengths["width"], lengths["wall"]
        return _box_shear(h, b, t), _box_shear(b, h, t)


_CORNER = 1.0 - 2.0 * math.log(2.0) / math.pi, 0.144834, 0.202911
"""Flow, ∫u and ∫w of a square corner of two walls of thickness 1, beyond those of the walls.

The first from a conformal map; the others by finite differences, to their digits.
"""


def _box_shear(h: float, b: float, t: float) -> float:
    """Return the shear coefficient along h: I² over A and the integral of Q²/t."""
    half, inner = 0.5 * h, 0.5 * h - t
    flange = 0.5 * b * (half**2 - inner**2)
    web = flange**2 * inner + 4.0 / 3.0 * flange * t * inner**3 + 8.0 / 15.0 * t**2 * inner**5
    ends = 0.25 * b**2 * (
        8.0 / 15.0 * half**5 - inner * (half**4 - 2.0 / 3.0 * (half * inner) ** 2 + 0.2 * inner**4)
    )  # fmt: skip
    across = (t * (h - t)) ** 2 * (0.5 * b - t) ** 3 / 3.0
    area = h * b - 4.0 * inner * (0.5 * b - t)
    return _box_inertia(h, b, t) ** 2 * t / (area * (web + ends + across))


def _box_inertia(h: float, b: float, t: float) -> float:
    """Return I [m⁴] of a rectangular tube, bent along h."""
    return (b * h**3 - (b - 2.0 * t) * (h - 2.0 * t) ** 3) / 12.0
