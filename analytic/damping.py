"""Damping of a blade, as a value in SI units."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from .description import Described
from .input_checks import not_negative, whole_number


@dataclass(frozen=True, kw_only=True)
class Damping(Described):
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
            remedy = "damping takes energy, it gives none"
            self._keep(**{name: not_negative(name, getattr(self, name), unit, remedy)})

    @classmethod
    def from_ratio(cls, blade: Any, mode: int = 1, ratio: float = 0.01) -> Damping:
        """Return the bending damping that gives one mode at rest a damping ratio.

        η_b = 2ζ/ω_j; for rotation, where the centrifugal stiffness takes no part, see
        `damping_ratios`.

        Parameters
        ----------
        blade : Beam or Blade
        mode : int
            j, from 1 to 12.
        ratio : float
            ζ, of the critical damping.
        """
        mode = whole_number("mode", mode)
        frequencies = blade.frequencies_at_rest
        if mode > frequencies.size // 2:
            raise ValueError(f"mode must be at most {frequencies.size // 2}, got {mode}")
        return cls(bending=2.0 * not_negative("ratio", ratio) / float(frequencies[mode - 1]))

    def in_units(self, length: float, mass: float, time: float) -> Damping:
        """Return the same in units of length [m], mass [kg] and time [s]."""
        return Damping(
            bending=self.bending / time,
            axial=self.axial / time,
            external=self.external * length * time / mass,
        )

    def __bool__(self) -> bool:
        return any((self.bending, self.axial, self.external))


UNDAMPED = Damping()
