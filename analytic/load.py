"""The base of loads on a blade: what each answers to theory, Exudyn, files and figures."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import fields, replace
from typing import ClassVar, Literal, Self

import numpy as np

from .arrays import ComplexArray, FloatArray
from .description import Described
from .motion import Rotation


class Load(Described, abstract=True):
    """Force or motion that acts on a blade; a frozen dataclass whose first field is its size.

    Attributes
    ----------
    unit, symbol, called : str
        Of the size: its unit in SI and the theory's letter; and the load in a sentence, by the name
        of its class unless given, never by that of a base.
    dimension : tuple of three int
        Powers of length, mass and time in the size.
    dimensions : mapping
        The same of other numbers among the fields, by name; zeros of an angle.
    acts_on : {"mass", "length", "tip", "span"} or None
        Carrier of the force, which is per unit of it; "span" of a load that has a `wrench`; None
        for a load that moves the clamp.
    stations : tuple of float
        Of a load on the span, places [m] where it is not smooth, ascending: it acts from the first
        to the last, per length. It acts on a single one as a whole, and without any on the tip.
    following : bool
        Whether the components of such a load turn with its sections.
    frequency : float or None
        ν [rad/s] of a harmonic load, where it is given.
    varied : {"frequency", "speed"} or None
        Abscissa of a response: the load's frequency, or the rotation speed if the load goes around
        once a turn; None for a load without a response.
    """

    unit: ClassVar[str]
    symbol: ClassVar[str]
    called: ClassVar[str]
    dimension: ClassVar[tuple[int, int, int]]
    dimensions: ClassVar[Mapping[str, tuple[int, int, int]]] = {}
    acts_on: ClassVar[Literal["mass", "length", "tip", "span"] | None]
    varied: ClassVar[Literal["frequency", "speed"] | None] = None
    frequency: float | None = None
    stations: tuple[float, ...] = ()
    following: bool = False

    def __init_subclass__(cls, **rest: bool) -> None:
        super().__init_subclass__(**rest)
        words = re.sub("(?<=.)(?=[A-Z])", " ", cls.__name__).lower()
        article = "an" if words[0] in "aeiou" else "a"
        cls.called = vars(cls).get("called", f"{article} {words}")

    @property
    def size(self) -> float:
        """Amplitude, in `unit`."""
        return float(getattr(self, self._of_size()))

    def _of_size(self) -> str:
        return fields(self)[0].name  # type: ignore[arg-type]

    def phase_at(self, t: FloatArray) -> FloatArray:
        """Return the phase at times `t`: νt [rad], or what the load goes by in its place."""
        return (self.frequency or 0.0) * t

    def wrench(self, phase: FloatArray, x: FloatArray) -> FloatArray:
        """Return force and moment on the line at `x`, (samples, places, 6), of a load on the span.

        Along the clamp, in the direction of rotation and normal to both, as the tip's place; or in
        the section's axes where it is `following`.
        """
        raise NotImplementedError

    def force(self, phase: FloatArray, angle: FloatArray, setting: float) -> ComplexArray:
        """Return the force (samples,): real part along the undeformed blade, imaginary across.

        Parameters
        ----------
        phase, angle : ndarray (samples,)
            νt and θ [rad].
        setting : float
            c = cos ψ.
        """
        raise NotImplementedError

    @property
    def leaves_plane(self) -> bool:
        """Whether it moves the blade out of the plane of rotation: unless stated, with a lift."""
        return type(self).lift is not Load.lift

    def lift(self, phase: FloatArray) -> FloatArray:
        """Return the force along the axis of rotation, (samples,)."""
        return 0.0 * phase

    def rate(self, phase: FloatArray) -> FloatArray:
        """Return the change of the clamp's speed, (samples,)."""
        return 0.0 * phase

    def acceleration(self, phase: FloatArray, frequency: float) -> FloatArray:
        """Return the change of its acceleration at ν = `frequency`, (samples,)."""
        return 0.0 * frequency * phase

    def require_in_time(self) -> None:
        """Refuse a load without the values that a motion in time needs."""

    def moved(self, rotation: Rotation) -> Rotation:
        """Return the rotation of the clamp with the load's share."""
        return rotation

    def in_units(self, length: float, mass: float, time: float) -> Self:
        """Return the load in units of length [m], mass [kg] and time [s].

        TypeError of a number whose dimension the class does not state.
        """
        known, scaled = {self._of_size(): self.dimension, **self.dimensions}, {}
        for name in (one.name for one in fields(self)):  # type: ignore[arg-type]
            value = getattr(self, name)
            if name == "frequency":
                scaled[name] = None if value is None else value * time
            elif name in known:
                if value is not None:
                    value = np.asarray(value)
                    for unit, power in zip((length, mass, time), known[name], strict=True):
                        value = value / unit**power
                    value = value.tolist()
                scaled[name] = value
            elif not isinstance(value, str | bool | None):
                raise TypeError(
                    f"{self} has {name} of unknown dimension: let {type(self).__name__} have "
                    f"dimensions = {{{name!r}: powers of length, mass and time}}, 0 of an angle"
                )
        return replace(self, **scaled)  # type: ignore[type-var]

    def times(self, factor: float) -> Self:
        """Return the load with `factor` times its size."""
        return replace(self, **{self._of_size(): factor * self.size})  # type: ignore[type-var]

    def __str__(self) -> str:
        return f"{self.called} of {self.size:g} {self.unit}"
