"""What acts on a blade and takes from it: loads and damping, as values in SI units."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

from .input_checks import finite_number, not_negative, whole_number
from .motion import Rippled, Rotation


@dataclass(frozen=True, kw_only=True)
class Damping:
    """Viscous damping of a blade.

    The bending moment is EI(κ + η_b κ̇), the axial force EA(e + η_a ė). External damping takes d ṙ
    per length, with the velocity relative to the turning frame: it does not brake steady rotation
    as drag would, and point masses have none.

    Parameters
    ----------
    bending : float
        η_b [s].
    axial : float
        η_a [s].
    external : float
        d [kg/(m s)]; c times the mass per length damps a uniform blade by its mass.

    Examples
    --------
    >>> from analytic import Beam, Damping, damping_ratios
    >>> blade = Beam.reference().with_damping(Damping(bending=1e-3))
    >>> print(damping_ratios(blade, omega=6.0).round(5))
    [0.00127 0.00723 0.02303]
    """

    bending: float = 0.0
    axial: float = 0.0
    external: float = 0.0

    def __post_init__(self) -> None:
        for name, unit in (("bending", "s"), ("axial", "s"), ("external", "kg/(m s)")):
            value = not_negative(
                name, getattr(self, name), unit, "damping takes energy, it gives none"
            )
            object.__setattr__(self, name, value)

    @classmethod
    def from_ratio(cls, blade: Any, mode: int = 1, ratio: float = 0.01) -> Damping:
        """Return the bending damping that gives one mode at rest a damping ratio.

        η_b = 2ζ/ω_j; in rotation, where the centrifugal stiffness takes no part, `damping_ratios`
        tells what is left of it.

        Parameters
        ----------
        blade : Beam or Blade
        mode : int
            j, from 1 to 12.
        ratio : float
            ζ, of the critical damping.
        """
        mode = whole_number("mode", mode)
        frequencies = getattr(blade, "blade", blade).frequencies_at_rest
        if mode > frequencies.size // 2:
            raise ValueError(f"mode must be at most {frequencies.size // 2}, got {mode}")
        return cls(bending=2.0 * not_negative("ratio", ratio) / float(frequencies[mode - 1]))

    def __bool__(self) -> bool:
        return any((self.bending, self.axial, self.external))


UNDAMPED = Damping()


@dataclass(frozen=True, kw_only=True)
class _Harmonic:
    """What acts at one frequency, as the cosine."""

    amplitude: float
    frequency: float | None = None

    unit: ClassVar[str]
    called: ClassVar[str]

    def __post_init__(self) -> None:
        object.__setattr__(self, "amplitude", finite_number("amplitude", self.amplitude, self.unit))
        if self.frequency is not None:
            frequency = not_negative("frequency", self.frequency, "rad/s")
            object.__setattr__(self, "frequency", frequency)

    def __str__(self) -> str:
        at = "" if self.frequency is None else f" at {self.frequency:g} rad/s"
        return f"{self.called} of {self.amplitude:g} {self.unit}{at}"


@dataclass(frozen=True, kw_only=True)
class SpeedRipple(_Harmonic):
    """A ripple of the speed: the clamp turns at ω + ε cos νt.

    Parameters
    ----------
    amplitude : float
        ε [rad/s].
    frequency : float, optional
        ν [rad/s]; `forced_response` sweeps it, a motion in time needs it.

    Examples
    --------
    >>> from analytic import Beam, Damping, SpeedRipple, forced_response
    >>> blade = Beam.reference().with_damping(Damping(external=0.1))
    >>> ripple = SpeedRipple(amplitude=0.02)
    >>> found = forced_response(blade, 6.0, ripple, [3.6, 3.7], functions=8)
    >>> print(f"{found.amplitude[-1]:.4f} L at {found.frequency[-1]:.1f} rad/s")
    0.0440 L at 3.7 rad/s
    """

    unit: ClassVar[str] = "rad/s"
    called: ClassVar[str] = "a ripple"


@dataclass(frozen=True, kw_only=True)
class TipForce(_Harmonic):
    """A force on the tip across the undeformed blade, F cos νt, turning with the clamp.

    Parameters
    ----------
    amplitude : float
        F [N].
    frequency : float, optional
        ν [rad/s]; `forced_response` sweeps it, a motion in time needs it.

    Examples
    --------
    >>> from analytic import Beam, Damping, TipForce, forced_response
    >>> blade = Beam.reference().with_damping(Damping(external=0.1))
    >>> found = forced_response(blade, 6.0, TipForce(amplitude=0.5), [3.6, 3.7], functions=8)
    >>> print(f"{found.amplitude[-1]:.4f} L at {found.frequency[-1]:.1f} rad/s")
    0.0768 L at 3.7 rad/s
    """

    unit: ClassVar[str] = "N"
    called: ClassVar[str] = "a tip force"


@dataclass(frozen=True, kw_only=True)
class DistributedForce(_Harmonic):
    """A force per undeformed length across the blade, p cos νt, turning with the clamp.

    Parameters
    ----------
    amplitude : float
        p [N/m].
    frequency : float, optional
        ν [rad/s]; `forced_response` sweeps it, a motion in time needs it.

    Examples
    --------
    >>> from analytic import Beam, Damping, DistributedForce, forced_response
    >>> blade = Beam.reference().with_damping(Damping(external=0.1))
    >>> push = DistributedForce(amplitude=0.1)
    >>> found = forced_response(blade, 6.0, push, [3.6, 3.7], functions=8)
    >>> print(f"{found.amplitude[-1]:.4f} L at {found.frequency[-1]:.1f} rad/s")
    0.0517 L at 3.7 rad/s
    """

    unit: ClassVar[str] = "N/m"
    called: ClassVar[str] = "a distributed force"


@dataclass(frozen=True)
class Gravity:
    """Gravity in a plane of rotation that stands vertical: -g(sin θ i + cos ψ cos θ j).

    At θ = 0 the blade points sideways, and gravity bends it back.

    Parameters
    ----------
    gravity : float
        g [m/s²].

    Examples
    --------
    >>> from analytic import Beam, Damping, gravity_response
    >>> blade = Beam.reference().with_damping(Damping(external=0.3))
    >>> found = gravity_response(blade, [5.0, 5.5], gravity=1.62, functions=8)
    >>> found.load
    Gravity(gravity=1.62)
    >>> print(f"{found.amplitude[0]:.4f} L at {found.omega[0]:.1f} rad/s, on the moon")
    0.0220 L at 5.0 rad/s, on the moon
    """

    gravity: float = 9.81

    unit: ClassVar[str] = "m/s²"

    def __post_init__(self) -> None:
        object.__setattr__(self, "gravity", finite_number("gravity", self.gravity, "m/s^2"))

    def __str__(self) -> str:
        return f"gravity of {self.gravity:g} {self.unit}"


HarmonicLoad = SpeedRipple | TipForce | DistributedForce
"""What acts at one frequency."""

Load = HarmonicLoad | Gravity
"""What a motion in time takes."""


def loads_in_time(loads: Any) -> tuple[Load, ...]:
    """Return the loads of a motion in time as a tuple, each with all that it needs.

    Raises
    ------
    TypeError
        If it is no sequence of loads.
    ValueError
        If a harmonic load has no frequency, or a ripple the frequency zero.
    """
    if not isinstance(loads, (tuple, list)):
        raise TypeError(f"loads must be several, as in loads=(Gravity(),), got {loads!r}")
    for load in loads:
        if not isinstance(load, Load):
            raise TypeError(
                f"a load must be a SpeedRipple, TipForce, DistributedForce or Gravity, got {load!r}"
            )
        if isinstance(load, Gravity):
            continue
        if load.frequency is None:
            raise ValueError(
                f"a motion in time needs the frequency of {load}: give frequency= [rad/s]"
            )
        if isinstance(load, SpeedRipple) and load.frequency == 0.0:
            raise ValueError(
                "a ripple of frequency 0 is another speed: give a frequency above 0 rad/s, or "
                "add the amplitude to omega"
            )
    return tuple(loads)


def rippled(rotation: Rotation, loads: Sequence[Load]) -> Rotation:
    """Return the rotation of the clamp with the ripples among the loads."""
    for load in loads:
        if isinstance(load, SpeedRipple) and load.frequency is not None:
            rotation = Rippled(
                rotation=rotation, amplitude=load.amplitude, frequency=load.frequency
            )
    return rotation
