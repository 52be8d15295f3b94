"""The response of the exact blade to one load: what its periodic orbits answer."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, ClassVar, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...arrays import ComplexArray, FloatArray
from ...blade_checks import undamped
from ...input_checks import finite_array, finite_number
from ...loads import Load
from ...plotting import axes_or_new, draw_response
from ...warning import PartialError
from ..continuum.rotation import GAUGES
from ..free.backbone import Backbone, backbone
from ..free.branch import Branch, SpecialPoint

if TYPE_CHECKING:
    from ...plotting import Axes


class ResponseNotReachedError(PartialError):
    """A response curve ended too early; its `part` is the ForcedResponse up to there, or None."""


@dataclass(frozen=True, kw_only=True)
class ForcedResponse(Branch):
    """Periodic response under one load, in order along the curve; made by `forced_response`.

    The phase φ = νt of everything is the drive's: the load is greatest at φ = 0. Under gravity φ is
    the angle θ of the clamp. Of a blade in space q is the gauge, the tip's place along lag or flap
    less that of the steady state, under gravity less that at rest.

    Attributes
    ----------
    beam, load, theory : as given
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
    error : float
        Change of the harmonics on more functions, over the amplitude: at the highest point, of a
        table the largest along the curve. NaN of a part of it.
    marks : tuple of str
        Mark of each point: "asked" for; "fold" where the curve turns around and the response jumps;
        "peak" where the amplitude is greatest or least; "branch point" where another curve crosses;
        or "".

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

    _covered: ClassVar[int] = 4
    _tolerance: ClassVar[float] = 1e-9
    _confirms: ClassVar[bool] = False  # there are many, and a slow drive takes ten times as long

    load: Load
    harmonics: ComplexArray = field(repr=False)
    residual: FloatArray = field(repr=False)
    error: float

    @property
    def phase(self) -> FloatArray:
        """Phase lag of the first harmonic of q behind cos νt [rad], (points,), in ±π.

        The load goes with cos νt; the weight across the blade with -cos θ.
        """
        return np.asarray(-np.angle(self.harmonics[:, 1]))

    @property
    def peaks(self) -> tuple[SpecialPoint, ...]:
        """Points of greatest or least amplitude, in order along the curve."""
        return self._marked("peak")

    def at(self, frequency: float) -> NDArray[np.intp]:
        """Return the indices of the points at one of the frequencies asked for [rad/s]."""
        frequency = finite_number("frequency", frequency, "rad/s")
        is_asked = np.array(self.marks) == "asked"
        points = np.flatnonzero(
            is_asked & np.isclose(self.frequency, frequency, rtol=1e-9, atol=0.0)
        )
        if not points.size:
            raise ValueError(
                f"the response was not asked for at {frequency:g} rad/s: give it among the "
                "frequencies"
            )
        return points

    def response(self, phase: ArrayLike, i: int) -> FloatArray:
        """Return q/L of point `i` at the phases φ [rad]."""
        phases = finite_array("phase", phase, "rad")
        return self._orbit(i).gauge(phases.ravel()).reshape(phases.shape)

    @property
    def backbone(self) -> Backbone:
        """The backbone of the undamped blade on which the response leans.

        Of the first mode; in space of the first that has more of the gauge.
        """
        if self.load.varied == "speed":
            raise ValueError(
                f"{self.load.called} goes around with the speed, and each speed has its own "
                "backbone: take periodic_orbits at one of them"
            )
        blade, omega = undamped(self.blade), float(self.omega[0])
        mode = f"{self._system.model.family(self.gauge)} 1"
        return backbone(blade, omega, mode, theory=self.theory)

    @property
    def _system(self) -> Any:
        return self.nondimensional[0].system

    @property
    def gauge(self) -> Literal["lag", "flap"]:
        """Place of the tip whose greatest deflection is the amplitude."""
        return "flap" if self._system.component == GAUGES["flap"] else "lag"

    def plot(self, ax: Axes | None = None, **line: Any) -> Axes:
        """Draw the peak amplitude over the frequency: unstable dashed, folds as rings.

        Between the points is a cubic that is monotone where they are.

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
        fold = np.array(self.marks) == "fold"
        line = {"label": str(self.load), **line}
        draw_response(ax, self.frequency, self.amplitude, self.stable, fold, **line)
        swept = "rotation speed ω" if self.load.varied == "speed" else "drive frequency ν"
        ax.set(xlabel=f"{swept} [rad/s]", ylabel="peak |q|/L")
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
            f"error {self.error:.0e}"
        )
