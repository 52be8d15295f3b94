"""Kinds of cases of blades that flap and twist as well: of plain ones, and of tables."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from analytic import linear_modes
from analytic.arrays import FloatArray
from analytic.theory import Theory

from .case import Case

if TYPE_CHECKING:
    from analytic.exact.driven.response import SpinUpResponse
    from analytic.exact.linear.families import LinearModes

TIP = ("lag", "flap", "twist")
"""The tip in space, as `SpinUpResponse` has it: two places [m], and the section's turn [rad]."""

ROOT = ("root_moment_x", "root_moment_y", "root_moment_z")
"""Moment of the blade on the clamp [N m], in the axes of the clamp, as runs of Exudyn have it."""


TWISTED = "twist is the other way round: it turns the chord from the direction of rotation up"
_OTHER = "is the other way round: lag grows along the rotation, flap up, twist from lag to flap"
SIGNS = {
    "sign of lag": (f"lag {_OTHER}", (-1.0, 1.0, 1.0)),
    "sign of flap": (f"flap {_OTHER}", (1.0, -1.0, 1.0)),
    "sign of twist": (f"twist {_OTHER}", (1.0, 1.0, -1.0)),
    "degrees": ("the twist is in degrees: hand it in in rad", (1.0, 1.0, 180.0 / math.pi)),
}
"""Factors of lag, flap and twist by which a tip in space may be off, and what is said of them."""


@dataclass(frozen=True, kw_only=True)
class SpaceCase(Case):
    """A task of a blade that flaps and twists as well: its histories are those of `TIP`."""

    columns: ClassVar[tuple[str, ...]] = TIP
    in_space: ClassVar[bool] = True
    is_quick: ClassVar[bool] = False

    @property
    def sizes(self) -> tuple[float, ...]:
        """L of lag and flap, a radian of the twist."""
        return self.blade.length, self.blade.length, 1.0

    @property
    def slips(self) -> Mapping[str, tuple[str, Sequence[float]]]:
        """Signs and units, and the mirror of a blade that is built or kicked wrongly."""
        name, said = "sign of the blade's twist", f"the blade's {TWISTED}"
        if self.kick:
            name = "sign of the kick"
            said = "the kick is the other way round: it goes up, along the axis"
        return {**SIGNS, name: (said, (1.0, -1.0, -1.0))}

    def theory_of(self, declared: Theory) -> Theory:
        """Return the theory by which a code is judged that declares one.

        Slices have their inertia about all axes, and twist does not shorten the axis: the beam of
        Reissner and Simo, or of Kirchhoff without shear.
        """
        return replace(declared, rotary_inertia=True, trapeze=False, engesser=False)

    def modes(self, speed: float, theory: Theory) -> LinearModes:
        """Return the exact modes of all motions at a speed [rad/s]."""
        return linear_modes(self.blade, speed, self.count, theory=theory)


@dataclass(frozen=True, kw_only=True)
class TableCase(SpaceCase):
    """A task of a real blade, by 6x6 matrices at stations: histories have the root's moment too."""

    columns: ClassVar[tuple[str, ...]] = (*TIP, *ROOT)

    @property
    def sizes(self) -> tuple[float, ...]:
        """L of lag and flap, a radian of the twist, and EI/L at the root."""
        return (*super().sizes, *3 * [self.blade.bending_stiffness / self.blade.length])

    @property
    def slips(self) -> Mapping[str, tuple[str, Sequence[float]]]:
        """Slips in the tip, and of the moment its sign and its unit."""
        moment = "the root's moment is"
        return {
            **{name: (said, (*of, 1.0, 1.0, 1.0)) for name, (said, of) in super().slips.items()},
            "sign of the moment": (
                f"{moment} that of the clamp on the blade: hand in that on the clamp",
                (1.0, 1.0, 1.0, -1.0, -1.0, -1.0),
            ),
            "kN m": (f"{moment} in kN m: hand it in in N m", (1.0, 1.0, 1.0, 1e-3, 1e-3, 1e-3)),
        }  # fmt: skip

    def theory_of(self, declared: Theory) -> Theory:
        """Return the theory by which a code is judged: stations have a shear stiffness."""
        return replace(super().theory_of(declared), shear=bool(declared.shear))

    def handed(self, response: SpinUpResponse) -> FloatArray:
        """Return the tip and the moment of the blade on the clamp, (samples, 6)."""
        root = response.section_loads([0.0])
        moment = root.section[:, 0] @ root.moment[:, 0, :, None]
        tip = self.joined([getattr(response, name) for name in TIP])
        return np.concatenate((tip, moment[..., 0]), axis=1)

    def error_of(self, q: FloatArray, error: float, coarser: Callable[[], SpinUpResponse]) -> float:
        """Return the change from a coarser response: moments have larger errors than the tip."""
        change = np.abs(self.handed(coarser()) - q).max(axis=0)
        return float((change / np.abs(q).max(axis=0)).max())
