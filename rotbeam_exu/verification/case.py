"""A case of the benchmark: a blade, its motion and loads, and the quantity asked for.

A case answers for its kind: the columns of its histories, the theory and the modes of its
reference, and the usual slips in the tip. A kind is a class: `Case` in the plane, here, and those
of `space_cases`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import cached_property, partial
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from analytic import Blade, SteadyRotation, periodic_orbits, steady_state
from analytic.arrays import FloatArray
from analytic.exact.continuum.state import BladeState
from analytic.exact.linear.modes import driven_modes
from analytic.exact.linear.steady_state import kicked_state
from analytic.loads import Load
from analytic.motion import SpeedChange
from analytic.theory import BERNOULLI_EULER, Theory

if TYPE_CHECKING:
    from analytic.exact.driven.response import SpinUpResponse
    from analytic.exact.free.orbits import Orbits
    from analytic.exact.linear.families import LinearModes


class Level(StrEnum):
    """Demand that a case makes on a code."""

    BASIC = "basic"
    MODERATE = "moderate"
    HARD = "hard"
    BLADE = "blade"
    SPACE = "space"
    REAL = "real blade"


class Asked(StrEnum):
    """Result that is handed in."""

    FREQUENCIES = "natural frequencies at each speed"
    STEADY = "steady deflection of the tip at each speed"
    HISTORY = "deflection of the tip over time"
    BACKBONE = "nonlinear frequency at each speed and amplitude"


@dataclass(frozen=True, kw_only=True)
class Case:
    """One task, of a blade that bends in the plane of rotation.

    Attributes
    ----------
    name : str
        As files and folders are named: "L", "S1", "S1+h".
    level : Level
    title : str
        In a few words.
    asked : Asked
    blade : Blade
        Damping included.
    motion : SpeedChange or SteadyRotation, optional
        How the clamp turns, of a history.
    duration : float
        Of the history [s].
    speeds : tuple of float
        Of frequencies, steady deflections and backbones [rad/s].
    count : int
        Number of frequencies at each speed, by their number.
    amplitudes : tuple of float
        Peak |q|/L: of a history the orbit it starts on, of a backbone its points.
    loads : tuple
    kick : float
        Speed of the tip out of the plane at t = 0 [m/s], as `spin_up_response` has it.
    settled : bool
        Whether a history starts in equilibrium under its loads, at rest.
    table : str
        Name of the file of the blade's stations; empty of a blade without.
    oscillates : bool
        Whether the history ends in a steady oscillation, whose amplitude and frequency are judged.
    theories : tuple of Theory
        Those whose references come with the package, as codes declare them.
    columns : tuple of str
        Columns of its histories besides the time.
    sizes : tuple of float
        Units of the columns, to which errors are small: lengths, one radian, a moment.
    is_quick : bool
        Whether theory answers in a second or two, so that mistakes are planted into it.
    slips : dict
        By name of a mistake, the sentence on it and the factors by which the tip is off.
    """

    name: str
    level: Level
    title: str
    asked: Asked
    blade: Blade
    motion: SpeedChange | SteadyRotation | None = None
    duration: float = 0.0
    speeds: tuple[float, ...] = ()
    amplitudes: tuple[float, ...] = ()
    loads: tuple[Load, ...] = ()
    kick: float = 0.0
    settled: bool = False
    table: str = ""
    oscillates: bool = False
    count: int = 1
    theories: tuple[Theory, ...] = (BERNOULLI_EULER,)

    def __post_init__(self) -> None:
        """Refuse a load that the reference would leave out."""
        steady = self.asked is Asked.STEADY
        for load in () if self.is_spun_up else self.loads:
            if not (steady and _is_weight(load)):
                raise ValueError(
                    f"the reference of case {self.name}, {self.asked}, knows no {load!r}: "
                    + ("weight along the axis of rotation alone" if steady else "take a spin-up")
                )

    columns: ClassVar[tuple[str, ...]] = ("q",)
    in_space: ClassVar[bool] = False
    is_quick: ClassVar[bool] = True

    @property
    def sizes(self) -> tuple[float, ...]:
        """L of q."""
        return (self.blade.length,)

    @property
    def slips(self) -> Mapping[str, tuple[str, Sequence[float]]]:
        """Sign and unit of q."""
        return {
            "sign of q": (
                "q has the wrong sign: it is negative while the rotation speeds up, Eq. 16", (-1.0,)
            ),
            "q over L": ("q is over L: hand it in in metres", (1.0 / self.blade.length,)),
            "millimetres": ("q is in millimetres: hand it in in metres", (1e3,)),
        }  # fmt: skip

    def theory_of(self, declared: Theory) -> Theory:
        """Return the theory by which a code is judged that declares one."""
        return replace(declared, trapeze=True)  # which the plane does not know

    def modes(self, speed: float, theory: Theory) -> LinearModes:
        """Return the lowest exact modes at a speed [rad/s], as many as the case has numbers."""
        return driven_modes(self.blade, speed, self.count, theory=theory)

    def handed(self, response: SpinUpResponse) -> FloatArray:
        """Return what a spin-up would hand in: q (samples,), of several columns (samples, n)."""
        return self.joined([getattr(response, name) for name in self.columns])

    def error_of(self, q: FloatArray, error: float, coarser: Callable[[], SpinUpResponse]) -> float:
        """Return the relative error of what is `handed` in, of its worst column.

        Of a response with an error over the largest of q and flap; `coarser` computes another one.
        """
        # To the largest all columns are small.
        sizes = np.abs(q).max(axis=0) / self.sizes
        return error * float(sizes.max() / sizes.min())

    def joined(self, tip: Sequence[FloatArray] | FloatArray) -> FloatArray:
        """Return the columns of a history as one array: q (samples,), of several (samples, n)."""
        return np.asarray(tip[0] if len(self.columns) == 1 else np.stack(list(tip), axis=-1))

    @property
    def quantities(self) -> tuple[str, ...]:
        """Quantities that are judged of it."""
        if self.asked is Asked.HISTORY:
            return ("history", "amplitude", "nonlinear shift")[: 3 if self.oscillates else 1]
        return ("frequencies",) if self.count > 1 else (_QUANTITIES[self.asked],)

    @property
    def is_spun_up(self) -> bool:
        """True where its history starts straight; else it starts on an orbit."""
        return self.motion is not None and not self.amplitudes

    @property
    def rotation(self) -> SpeedChange | SteadyRotation:
        """Rotation of the clamp of a history; ValueError if the case asks for none."""
        if self.motion is None:
            raise ValueError(f"case {self.name} has several speeds: say which")
        return self.motion

    @property
    def spin_up(self) -> SpeedChange:
        """Rotation of the clamp of a history that starts straight; ValueError of others."""
        if not isinstance(self.motion, SpeedChange):
            raise ValueError(f"case {self.name} is not spun up, its motion is {self.motion!r}")
        return self.motion

    @property
    def ramp_time(self) -> float:
        """Time in which it is spun up [s]; 0 of a steady rotation."""
        return self.rotation.ramp_time

    @cached_property
    def orbit(self) -> Orbits:
        """Exact orbit that its history starts on, at phase 0; ValueError if it starts at rest."""
        if self.motion is None or not self.amplitudes:
            raise ValueError(f"case {self.name} starts at rest, on no orbit")
        return periodic_orbits(self.blade, self.motion.omega, self.amplitudes)

    @property
    def start(self) -> Callable[[FloatArray], BladeState] | None:
        """State at material points x [m] at t = 0; None of a beam that starts straight, at rest.

        Equilibrium is that of the last one of its theories: of a real blade with shear.
        """
        if self.kick:
            return partial(kicked_state, self.blade, self.kick)
        if self.settled:
            theory = self.theory_of(self.theories[-1])
            return steady_state(self.blade, 0.0, loads=self.loads, theory=theory).state
        return None if self.is_spun_up else partial(self.orbit.state, 0)

    def whole_duration(self, step: float) -> float:
        """Return the duration, or a little more that is a whole number of steps [s]."""
        return math.ceil(self.duration / step * (1.0 - 1e-12)) * step


def _is_weight(load: Load) -> bool:
    """Whether a load is a steady weight along the axis of rotation."""
    in_plane = load.force(np.zeros(1), np.ones(1), 1.0)
    small = float(np.abs(in_plane).max()) < 1e-12 * abs(load.size)
    return small and load.acts_on == "mass" and not load.frequency


_QUANTITIES = {
    Asked.FREQUENCIES: "linear frequency",
    Asked.STEADY: "steady deflection",
    Asked.BACKBONE: "backbone",
}
