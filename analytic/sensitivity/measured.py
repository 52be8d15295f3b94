"""Measured numbers of a blade, and what an exact answer has for them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from ..arrays import FloatArray
from ..blade import Blade
from ..exact.continuum.unit import space_unit
from ..exact.linear.steady_state import steady_state
from ..input_checks import finite_number, positive, rotation_speed, shown, whole_number
from ..loads import Load, loads_at_once
from ..theory import Theory
from .derivatives import sensitivity
from .energies import difference
from .frequencies import MOST, modes_until
from .steady import SteadyDerivatives

OUTPUTS = {
    **{f"deflection {axis}": "m" for axis in "xyz"},
    **dict(zip(SteadyDerivatives.outputs, SteadyDerivatives.units, strict=True)),
}
"""Numbers of a steady state that are measured, with their units."""


@dataclass(frozen=True, kw_only=True)
class Measured:
    """A number that was measured.

    Parameters
    ----------
    value : float
    omega : float
        Rotation speed [rad/s] at which it was.
    deviation : float, optional
        Standard deviation, in the value's unit.
    """

    value: float
    omega: float = 0.0
    deviation: float | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "value", finite_number("value", self.value))
        object.__setattr__(self, "omega", rotation_speed(self.omega))
        if self.deviation is not None:
            object.__setattr__(self, "deviation", positive("deviation", self.deviation))

    @property
    def label(self) -> str:
        """Name of the number, with its speed."""
        raise NotImplementedError

    @property
    def unit(self) -> str:
        """Unit of the value."""
        raise NotImplementedError

    @property
    def together(self) -> tuple[Any, ...]:
        """The same for numbers that one answer has."""
        return type(self), self.omega

    @staticmethod
    def computed(
        several: Sequence[Any], blade: Blade, theory: Theory, names: Sequence[str]
    ) -> tuple[FloatArray, FloatArray]:
        """Return what a blade has for numbers of one answer, and its derivatives, (n, names)."""
        raise NotImplementedError


@dataclass(frozen=True, kw_only=True)
class MeasuredFrequency(Measured):
    """A natural frequency [rad/s], of a mode by its name or by its number in `linear_modes`.

    Examples
    --------
    >>> from analytic.sensitivity import MeasuredFrequency
    >>> print(MeasuredFrequency(mode="lag 1", value=3.73, omega=6.0).label)
    lag 1 at 6 rad/s
    """

    mode: str | int
    unit: ClassVar[str] = "rad/s"

    def __post_init__(self) -> None:
        super().__post_init__()
        positive("value", self.value)
        if not isinstance(self.mode, str):
            whole_number("mode", self.mode, most=MOST)

    @property
    def label(self) -> str:
        """The mode and the speed."""
        name = self.mode if isinstance(self.mode, str) else f"mode {self.mode}"
        return f"{name} at {self.omega:g} rad/s"

    @staticmethod
    def computed(
        several: Sequence[Any], blade: Blade, theory: Theory, names: Sequence[str]
    ) -> tuple[FloatArray, FloatArray]:
        """Return the frequencies and their derivatives."""
        named = [one.mode for one in several if isinstance(one.mode, str)]
        highest = max((one.mode for one in several if not isinstance(one.mode, str)), default=1)
        omega = several[0].omega
        modes = modes_until(
            lambda modes: len(modes.names) >= highest and {*named} <= {*modes.names},
            blade, omega, theory,
        )  # fmt: skip
        if missing := [name for name in named if name not in modes.names]:
            raise ValueError(
                f"the lowest {MOST} modes at {omega:g} rad/s have none of the name "
                f"{shown(missing[0])}; they are {', '.join(modes.names)}"
            )
        found = sensitivity(modes, names)
        rows = [
            modes.names.index(one.mode) if isinstance(one.mode, str) else one.mode - 1
            for one in several
        ]
        return found.values[rows], found.derivatives[rows]


@dataclass(frozen=True, kw_only=True)
class MeasuredState(Measured):
    """A number of the steady state under loads: a deflection, the tip's place, a load at the root.

    Parameters
    ----------
    output : str
        "deflection x", "deflection y" or "deflection z", the tip's place less that of the unloaded
        blade; or as of `Sensitivity`: "tip z", "twist", "root moment y".
    loads : sequence of loads
        As of `steady_state`; a `PointLoad` is a static pull.

    Examples
    --------
    >>> from analytic import PointLoad
    >>> from analytic.sensitivity import MeasuredState
    >>> pull = PointLoad(force=(0.0, 0.0, 10.0))
    >>> print(MeasuredState(output="deflection z", value=0.31, loads=[pull], deviation=0.002).unit)
    m
    """

    output: str
    loads: Sequence[Load] = ()

    def __post_init__(self) -> None:
        super().__post_init__()
        object.__setattr__(self, "loads", loads_at_once(self.loads))
        if self.output not in OUTPUTS:
            raise ValueError(
                f"output must be one of {', '.join(OUTPUTS)}, got {shown(self.output)}"
            )

    @property
    def label(self) -> str:
        """The number and the speed."""
        return f"{self.output} at {self.omega:g} rad/s"

    @property
    def unit(self) -> str:
        """Unit of the number."""
        return OUTPUTS[self.output]

    @property
    def together(self) -> tuple[Any, ...]:
        """The same for numbers of one speed and the same loads."""
        return *super().together, self.loads

    @staticmethod
    def computed(
        several: Sequence[Any], blade: Blade, theory: Theory, names: Sequence[str]
    ) -> tuple[FloatArray, FloatArray]:
        """Return the numbers and their derivatives."""
        first = several[0]
        state = steady_state(blade, first.omega, loads=first.loads, theory=theory)
        found = sensitivity(state, names)
        rows = [found.outputs.index(one.output.replace("deflection", "tip")) for one in several]
        values, slopes = found.values[rows], found.derivatives[rows]
        for k, one in enumerate(several):
            if one.output.startswith("deflection"):
                values[k] -= _unloaded(blade)[rows[k]]
                slopes[k] -= [
                    difference(p, _unloaded)[rows[k]] if p.moves else 0.0 for p in found.parameters
                ]
        return values, slopes


def _unloaded(blade: Blade) -> FloatArray:
    """Return the tip's place of the unloaded blade [m], (3,)."""
    (place,), _ = space_unit(blade).unloaded(np.ones(1))
    return np.asarray(blade.length * place)
