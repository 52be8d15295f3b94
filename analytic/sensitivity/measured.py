"""Measured numbers of a blade, and what an exact answer has for them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from ..arrays import FloatArray
from ..blade import Blade
from ..exact.continuum.unit import space_unit
from ..exact.driven.spin_up import spin_up_response
from ..exact.linear.steady_state import steady_state
from ..input_checks import (
    finite_number,
    not_negative,
    positive,
    rotation_speed,
    shown,
    whole_number,
)
from ..loads import Load, loads_at_once, loads_in_time
from ..motion import SpeedChange, SteadyRotation, require_ramp
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
_TOLERANCE = 1e-5  # of a motion, far below what is measured


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
class _MeasuredOutput(Measured):
    """One of the numbers of an answer under loads."""

    output: str
    loads: Sequence[Load] = ()
    among: ClassVar[tuple[str, ...]]

    def __post_init__(self) -> None:
        super().__post_init__()
        object.__setattr__(self, "loads", loads_at_once(self.loads))
        if self.output not in self.among:
            raise ValueError(
                f"output must be one of {', '.join(self.among)}, got {shown(self.output)}"
            )

    @property
    def unit(self) -> str:
        """Unit of the number."""
        return OUTPUTS[self.output]


@dataclass(frozen=True, kw_only=True)
class MeasuredState(_MeasuredOutput):
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

    among: ClassVar[tuple[str, ...]] = tuple(OUTPUTS)

    @property
    def label(self) -> str:
        """The number and the speed."""
        return f"{self.output} at {self.omega:g} rad/s"

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


@dataclass(frozen=True, kw_only=True)
class MeasuredMotion(_MeasuredOutput):
    """A number of a spin-up at a time: the tip's place or twist, or a load at the root.

    Its deviation is needed, for a motion goes through zero.

    Parameters
    ----------
    output : str
        "tip y", "root moment z" and so on, as of `Sensitivity`.
    time : float
        When it was measured [s].
    spin_up : SpinUp, FourierRamp, SpeedTable or SteadyRotation
    loads, start
        As of `spin_up_response`.

    Examples
    --------
    >>> from analytic import SpinUp
    >>> from analytic.sensitivity import MeasuredMotion
    >>> motion = SpinUp(omega=6.0, ramp_time=3.0)
    >>> seen = MeasuredMotion(output="tip y", time=1.5, value=-5.1, deviation=0.1, spin_up=motion)
    >>> print(seen.label)
    tip y at 1.5 s
    """

    time: float
    spin_up: SpeedChange | SteadyRotation
    start: str = "straight"
    among: ClassVar[tuple[str, ...]] = SteadyDerivatives.outputs

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.deviation is None:
            raise ValueError("a motion goes through zero: give the deviation of what was measured")
        if not isinstance(self.spin_up, SteadyRotation):
            require_ramp(self.spin_up)
        for name, value in {
            "omega": self.spin_up.omega,
            "time": not_negative("time", self.time, "s"),
            "loads": loads_in_time(self.loads),
        }.items():
            object.__setattr__(self, name, value)

    @property
    def label(self) -> str:
        """The number and the time."""
        return f"{self.output} at {self.time:.12g} s"

    @property
    def together(self) -> tuple[Any, ...]:
        """The same for numbers of one motion."""
        return type(self), self.spin_up, self.loads, self.start

    @staticmethod
    def computed(
        several: Sequence[Any], blade: Blade, theory: Theory, names: Sequence[str]
    ) -> tuple[FloatArray, FloatArray]:
        """Return the numbers and their derivatives."""
        first, times = several[0], np.unique([one.time for one in several])
        response = spin_up_response(
            blade, first.spin_up, times, loads=first.loads, start=first.start, theory=theory,
            tolerance=_TOLERANCE,
        )  # fmt: skip
        found = sensitivity(response, names)
        rows = [found.outputs.index(one.label) for one in several]
        return found.values[rows], found.derivatives[rows]


def _unloaded(blade: Blade) -> FloatArray:
    """Return the tip's place of the unloaded blade [m], (3,)."""
    (place,), _ = space_unit(blade).unloaded(np.ones(1))
    return np.asarray(blade.length * place)
