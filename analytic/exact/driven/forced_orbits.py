"""The response of the exact blade to one load: what its periodic orbits answer."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...arrays import ComplexArray, FloatArray
from ...beam import AnyBlade, undamped
from ...input_checks import finite_array, finite_number
from ...loads import Gravity, HarmonicLoad
from ...methods.floquet import Multipliers, floquet_multipliers
from ...methods.orbit import Orbit
from ...plotting import axes_or_new
from ...theory import Theory
from ..beam.state import BeamState, orbit_state
from ..free.backbone import Backbone
from ..free.periodic import periodic_orbits
from .loading import DrivenBeam

if TYPE_CHECKING:
    from ...plotting import Axes


class ResponsePoint(NamedTuple):
    """A point of a response curve.

    Attributes
    ----------
    frequency : float
        ν [rad/s].
    amplitude : float
        Peak |q|/L.
    """

    frequency: float
    amplitude: float


class ResponseNotReachedError(RuntimeError):
    """A response curve ended too early; `response` holds what was found, None if nothing was."""

    def __init__(self, message: str, response: ForcedResponse | None = None) -> None:
        super().__init__(message)
        self.response = response


@dataclass(frozen=True, kw_only=True)
class ForcedResponse:
    """Periodic response under one load, in order along the curve; made by `forced_response`.

    The phase φ = νt of everything is the drive's: the load is greatest at φ = 0. Under gravity φ is
    the angle θ of the clamp.

    Attributes
    ----------
    beam : Beam or Blade
    load : load
    theory : Theory
    omega : ndarray (points,)
        Rotation speed ω [rad/s].
    frequency : ndarray (points,)
        ν [rad/s].
    amplitude : ndarray (points,)
        Peak |q|/L.
    harmonics : ndarray (points, H + 1), complex
        q/L = Re Σ h_k exp(ikφ); h_0 is the mean.
    residual : ndarray (points,)
        Largest residual of the equations of motion, relative to the motion.
    marks : tuple of str
        Mark of each point: "asked" for, a "fold" where the curve turns around, a "peak" where the
        amplitude is greatest or least, a "branch point" where another curve crosses; else "".

    Examples
    --------
    >>> from analytic import Beam, Damping, TipForce, forced_response
    >>> blade = Beam.reference().with_damping(Damping(external=0.05))
    >>> push = TipForce(amplitude=0.5)
    >>> found = forced_response(blade, 2.0, push, [2.9, 3.0, 3.1, 3.2], functions=8)
    >>> print(f"{found.peaks[0].amplitude:.4f} L, stable throughout: {found.stable.all()}")
    0.2001 L, stable throughout: True
    >>> axes = found.plot()
    """

    beam: AnyBlade
    load: HarmonicLoad | Gravity
    theory: Theory
    omega: FloatArray
    frequency: FloatArray
    amplitude: FloatArray
    harmonics: ComplexArray = field(repr=False)
    residual: FloatArray = field(repr=False)
    marks: tuple[str, ...] = field(repr=False)
    _orbits: tuple[Orbit[DrivenBeam], ...] = field(repr=False)

    @property
    def phase(self) -> FloatArray:
        """By how much the first harmonic of q lags behind cos νt [rad], (points,), in ±π.

        The load goes with cos νt; the weight across the blade with -cos θ.
        """
        return np.asarray(-np.angle(self.harmonics[:, 1]))

    def _marked(self, mark: str) -> tuple[ResponsePoint, ...]:
        return tuple(
            ResponsePoint(float(self.frequency[i]), float(self.amplitude[i]))
            for i, here in enumerate(self.marks)
            if here == mark
        )

    @property
    def folds(self) -> tuple[ResponsePoint, ...]:
        """Where the curve turns around and the response jumps, in order along the curve."""
        return self._marked("fold")

    @property
    def peaks(self) -> tuple[ResponsePoint, ...]:
        """Where the amplitude is greatest or least, in order along the curve."""
        return self._marked("peak")

    def at(self, frequency: float) -> NDArray[np.intp]:
        """Return the indices of the points at one of the frequencies asked for [rad/s]."""
        frequency = finite_number("frequency", frequency, "rad/s")
        asked = np.array(self.marks) == "asked"
        found = np.flatnonzero(asked & np.isclose(self.frequency, frequency, rtol=1e-9, atol=0.0))
        if not found.size:
            raise ValueError(
                f"the response was not asked for at {frequency:g} rad/s: give it among the "
                "frequencies"
            )
        return found

    @cached_property
    def _stability(self) -> tuple[Multipliers, ...]:
        return tuple(floquet_multipliers(orbit, modes=4) for orbit in self._orbits)

    @property
    def multipliers(self) -> ComplexArray:
        """Floquet multipliers (points, 8) of the lowest four modes; computed when asked for."""
        return np.array([found.lowest for found in self._stability])

    @property
    def stable(self) -> NDArray[np.bool_]:
        """Whether a small disturbance in the plane dies out, (points,).

        No Floquet multiplier of the lowest four modes lies outside the unit circle.
        """
        return np.array([found.stable(tolerance=1e-9) for found in self._stability])

    def response(self, phase: ArrayLike, i: int) -> FloatArray:
        """Return q/L of point `i` at the phases φ [rad]."""
        phases = finite_array("phase", phase, "rad")
        return self._orbits[i].gauge(phases.ravel()).reshape(phases.shape)

    def state(self, i: int, x: ArrayLike, phase: float = 0.0) -> BeamState:
        """Return the state of point `i` at the material points `x` [m], to start a code from.

        In the frame of the clamp, as `Backbone.state` gives it.
        """
        return orbit_state(self.beam, self._orbits[i], x, phase)

    @cached_property
    def backbone(self) -> Backbone:
        """The undamped free orbits of the first mode, up to the largest amplitude here."""
        if isinstance(self.load, Gravity):
            raise ValueError(
                "gravity goes around with the speed, and each speed has its own backbone: take "
                "periodic_orbits at one of them"
            )
        highest = float(self.amplitude.max())
        return periodic_orbits(
            undamped(self.beam),
            float(self.omega[0]),
            np.linspace(0.0, highest, 13)[1:],
            theory=self.theory,
        )

    def plot(self, ax: Axes | None = None, **line: Any) -> Axes:
        """Draw the peak amplitude over the frequency: unstable dashed, folds as rings.

        Parameters
        ----------
        ax : Axes, optional
            Drawn on these; otherwise on a new figure.
        **line
            As for matplotlib's `Axes.plot`, such as color and label.

        Returns
        -------
        Axes
            The frequency is the drive's, under gravity the rotation speed.
        """
        ax = axes_or_new(ax)
        # At a fold, where a multiplier is 1, both parts end.
        fold = np.array(self.marks) == "fold"
        calm = self.stable | fold
        firm = calm[1:] & calm[:-1]
        stable, unstable = (
            np.where(np.append(part, False) | np.append(False, part), self.amplitude, np.nan)
            for part in (firm, ~firm)
        )
        (solid,) = ax.plot(self.frequency, stable, **{"label": str(self.load), **line})
        dashed = {**line, "color": solid.get_color(), "ls": "--", "label": "_unstable"}
        ax.plot(self.frequency, unstable, **dashed)
        ax.plot(
            self.frequency[fold], self.amplitude[fold], "o", color=solid.get_color(), mfc="white"
        )
        gravity = isinstance(self.load, Gravity)
        ax.set(
            xlabel="rotation speed ω [rad/s]" if gravity else "drive frequency ν [rad/s]",
            ylabel="peak |q|/L",
        )
        ax.set_ylim(bottom=0.0)
        ax.legend()
        return ax

    def __str__(self) -> str:
        folds = ", ".join(f"{fold.frequency:.6g} rad/s" for fold in self.folds)
        return (
            f"Response to {self.load}: {self.frequency.size} points from "
            f"{self.frequency[0]:.6g} to {self.frequency[-1]:.6g} rad/s, largest |q|/L "
            f"{self.amplitude.max():.6g} at {self.frequency[np.argmax(self.amplitude)]:.6g} rad/s, "
            f"{'folds at ' + folds if folds else 'no folds'}; "
            f"residual at most {self.residual.max():.1e}"
        )
