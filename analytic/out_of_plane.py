"""What a section resists and weighs out of its plane of bending: values, and shapes that have them.

In the plane a thin blade knows its EA, EI and m. Whether its motion stays there depends on how it
bends out of the plane and twists.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from .description import Described
from .input_checks import not_negative, positive

_PLACES = 61  # terms of the torsion series, whose rest is below 1e-9
_POISSON_RATIO = 0.3
_THINNEST = 1000.0  # of a rectangle, one side over the other
_SAME = 0.01  # what rounded dimensions may differ from A and I


@dataclass(frozen=True, kw_only=True)
class OutOfPlane(Described):
    """What a slice of the blade resists and weighs out of the plane, over what it has in it.

    The ratios hold all along the blade.

    Parameters
    ----------
    bending_ratio : float
        r, the bending stiffness out of the plane over the EI in it.
    torsion_ratio : float, optional
        g = GJ/EI; infinite of a section that does not twist. None where it is not known.
    polar_inertia : float, optional
        ρI_p at the root [kg m]; along the blade it goes as m EI/EA. None of a homogeneous section,
        which has m (1 + r) EI/EA. Its parts in the plane and across it, whose difference stiffens
        the twist as the blade turns, are taken as 1 to r. Zero makes the twist follow without
        inertia.

    Examples
    --------
    >>> from analytic import Beam, OutOfPlane, linear_modes
    >>> blade = Beam.reference().with_out_of_plane(OutOfPlane(bending_ratio=4.0, torsion_ratio=0.5))
    >>> print(linear_modes(blade, 6.0, plane="flap").frequencies.round(4))
    [  8.7358  39.5322 105.1932]
    """

    bending_ratio: float
    torsion_ratio: float | None = None
    polar_inertia: float | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "bending_ratio", positive("bending_ratio", self.bending_ratio))
        if self.torsion_ratio is not None and not _is_infinite(self.torsion_ratio):
            ratio = positive("torsion_ratio", self.torsion_ratio)
            object.__setattr__(self, "torsion_ratio", ratio)
        if self.polar_inertia is not None:
            inertia = not_negative("polar_inertia", self.polar_inertia, "kg m")
            object.__setattr__(self, "polar_inertia", inertia)

    @classmethod
    def rectangle(cls, ratio: float, poisson_ratio: float = _POISSON_RATIO) -> OutOfPlane:
        """Return that of a rectangle whose height, in the plane, is `ratio` times its width.

        GJ by Saint-Venant's series (Timoshenko and Goodier, Theory of Elasticity, Sec. 109).
        """
        ratio = positive("ratio", ratio)
        if not 1.0 / _THINNEST <= ratio <= _THINNEST:
            raise ValueError(
                f"the ratio of height to width must be between {1.0 / _THINNEST:g} and "
                f"{_THINNEST:g}, got {ratio:g}: beyond, it is a foil and no beam"
            )
        longer, shorter = max(ratio, 1.0), min(ratio, 1.0)  # in widths
        odd = np.arange(1, 2 * _PLACES, 2)
        rest = np.sum(np.tanh(0.5 * np.pi * odd * longer / shorter) / odd**5.0)
        torsion = longer * shorter**3 / 3.0 * (1.0 - 192.0 / np.pi**5 * shorter / longer * rest)
        shear = 0.5 / (1.0 + _poisson(poisson_ratio))
        return cls(
            bending_ratio=1.0 / ratio**2, torsion_ratio=float(shear * torsion * 12.0 / ratio**3)
        )

    @classmethod
    def circle(cls, poisson_ratio: float = _POISSON_RATIO) -> OutOfPlane:
        """Return that of a circle or a tube, of which J = 2I."""
        return cls(bending_ratio=1.0, torsion_ratio=1.0 / (1.0 + _poisson(poisson_ratio)))


def _is_infinite(value: object) -> bool:
    # A masked number compares to something that is neither True nor False.
    return isinstance(value, float) and value == math.inf


def _poisson(value: float) -> float:
    ratio = not_negative("poisson_ratio", value)
    if ratio > 0.5:
        raise ValueError(f"poisson_ratio must be at most 0.5, got {ratio:g}")
    return ratio


@dataclass(frozen=True, kw_only=True)
class Gyration:
    """A of a section, if it is known, and I/A, which is EI/EA whatever the material.

    Attributes
    ----------
    squared : float
        I/A [m²].
    area : float or None
        A [m²].
    """

    squared: float
    area: float | None = None


def rectangle(
    own: Gyration, height: float | None, width: float | None, poisson_ratio: float
) -> OutOfPlane:
    """Return the data of a rectangle, refusing one that contradicts the blade's `own` A and I."""
    fitting = math.sqrt(12.0 * own.squared)
    tall = fitting if height is None else positive("height", height, "m")
    across = own.area / tall if width is None and own.area is not None else width
    if across is None:
        raise ValueError(
            "a rectangle of unknown area needs its width: a Blade has EA and EI, no area; give "
            "width in m"
        )
    wide = positive("width", across, "m")
    remedy = f"height={fitting:.4g}"
    if own.area is not None:
        remedy += f", width={own.area / fitting:.4g}"
    shape = Gyration(squared=tall**2 / 12.0, area=tall * wide)
    _require_same(f"a rectangle of {tall:g} by {wide:g} m", shape, own, remedy)
    return OutOfPlane.rectangle(tall / wide, poisson_ratio)


def tube(own: Gyration, radius: float, wall: float, poisson_ratio: float) -> OutOfPlane:
    """Return the data of a tube, refusing one that contradicts the blade's `own` A and I."""
    r, t = positive("radius", radius, "m"), positive("wall", wall, "m")
    if t > 2.0 * r:
        raise ValueError(
            f"the wall of a tube is at most twice its mean radius, got wall = {t:g} m and radius "
            f"= {r:g} m: {2.0 * r:g} m is the full circle"
        )
    remedy = f"radius={math.sqrt(2.0 * own.squared):.4g}"
    if own.area is not None:
        # A = 2πrt and I/A = (r² + t²/4)/2
        half = own.squared
        thin = own.area / (2.0 * math.pi)
        mean = math.sqrt(half + math.sqrt(max(half**2 - 0.25 * thin**2, 0.0)))
        remedy = f"radius={mean:.4g}, wall={thin / mean:.4g}"
    shape = Gyration(squared=0.5 * (r**2 + 0.25 * t**2), area=2.0 * math.pi * r * t)
    _require_same(f"a tube of mean radius {r:g} m and wall {t:g} m", shape, own, remedy)
    return OutOfPlane.circle(poisson_ratio)


def _require_same(name: str, shape: Gyration, own: Gyration, remedy: str) -> None:
    """Refuse a shape with another I/A, or another A where it is known."""
    pairs = [("I/A", shape.squared, own.squared)]
    if own.area is not None and shape.area is not None:
        pairs.append(("A", shape.area, own.area))
    for what, has, wanted in pairs:
        if abs(has / wanted - 1.0) > _SAME:
            raise ValueError(
                f"{name} has {what} = {has:.4g} m², {100.0 * abs(has / wanted - 1.0):.3g} % from "
                f"the {wanted:.4g} m² of this blade: {remedy} fits it"
            )
