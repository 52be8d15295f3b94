"""Forced response of the exact blade: damped, loaded, in steady rotation."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, ClassVar, Literal

import numpy as np

from ...arrays import FloatArray
from ...blade import Blade
from ...blade_checks import warn_if_rpm
from ...input_checks import finite_values, rotation_speed, whole_number
from ...loads import Load
from ...methods.newton import NoOrbitError
from ...methods.orbit_curve import RESPONSE_ERROR, Marked, response_curve
from ...theory import BERNOULLI_EULER, Theory
from ...threads import one_thread
from ...warning import warn
from ..continuum.discretization import continuum_of
from ..continuum.loading import pushes, unit_load
from ..continuum.planar import MOST_FUNCTIONS
from ..continuum.rotation import SteadyBlade, rotating_blade
from ..continuum.state import Driven
from ..linear.modes import driven_modes
from .forced_orbits import ForcedResponse, ResponseNotReachedError

_LARGEST = 0.95  # |q|/L to which a response is followed


@dataclass(frozen=True, eq=False, kw_only=True)
class DrivenBlade(SteadyBlade):
    """The blade under one load in steady rotation, a driven system of `methods`.

    Under gravity, which goes around once a turn, the drive's frequency ν is the speed as well. The
    gauge is that of the blade without the load, which has no dimensions.
    """

    drive: Load
    driven: ClassVar[bool] = True
    odd: ClassVar[None] = None

    @property
    def _turns(self) -> bool:
        return self.drive.varied == "speed"

    def speed(self, frequency: float) -> float:
        """Return w̄."""
        return frequency if self._turns else self.rate

    def unloaded(self, frequency: float) -> SteadyBlade:
        """Return the blade in steady rotation without the load."""
        near = None if self._turns else self.equilibrium
        return SteadyBlade(self.model, self.speed(frequency), self.component, near)

    def rest(self, frequency: float) -> FloatArray:
        """Return the steady state without the load, (n,)."""
        return self.unloaded(frequency).equilibrium

    def loaded(self, share: float) -> DrivenBlade:
        """Return the blade under a share of the load."""
        return replace(self, drive=self.drive.times(share))

    def by(self, *drive: Any) -> Driven:
        """Return what drives it at the phases."""
        phase, nu = drive
        # Gravity goes by the angle, which is its phase; what goes by the phase alone is told none.
        angle = phase if self._turns else np.full_like(phase, np.nan)
        rate = self.speed(nu) + self.drive.rate(phase)
        acting = pushes(self.model, [(self.drive, phase)], angle)
        return Driven(rate, self.drive.acceleration(phase, nu), *acting)


@one_thread
def forced_response(
    blade: Blade,
    omega: float | Sequence[float] | FloatArray,
    load: Load,
    frequencies: Sequence[float] | FloatArray | None = None,
    *,
    theory: Theory = BERNOULLI_EULER,
    functions: int = 10,
    harmonics: int = 4,
    gauge: Literal["lag", "flap"] = "lag",
) -> ForcedResponse:
    """Return the periodic response of the damped blade to a load, over the load's frequency.

    Harmonic balance with a full Fourier series, followed by arclength through folds, so that
    unstable responses between are found as well. Harmonics and functions grow until the rest
    changes the amplitude by about 1e-6, of a table by 5e-5: see `error` of the result. Curves that
    are not connected to the response at the first frequency (isolas) are not found.

    Gravity goes around once a turn, for the plane of rotation stands vertical: its frequency is ω,
    which varies along the curve.

    Parameters
    ----------
    blade : Blade
        With damping: see `Blade.with_damping`.
    omega : float or sequence of float
        Rotation speed ω [rad/s]; under gravity speeds, ascending, in place of the frequencies.
    load : SpeedRipple, TipForce, DistributedForce, PointLoad, LoadTable or Gravity
        Without a frequency, and a table without times.
    frequencies : sequence of float
        Drive frequencies ν [rad/s], ascending: the first and the last are the ends of the curve,
        those between are among its points, wherever it passes them. None under gravity.
    theory : Theory
        Extension, shear and rotary inertia.
    functions, harmonics : int
        Least number of functions for the tangent's angle, half as many for each curvature in space,
        and of harmonics.
    gauge : {"lag", "flap"}
        Place of the tip whose greatest deflection is the amplitude; "flap" of a blade in space, or
        under a load that leaves the plane.

    Raises
    ------
    ValueError, TypeError
        If an input is refused; if the blade is undamped and the frequencies hold a resonance.
    ResponseNotReachedError
        If the curve cannot be followed to its end; its `.part` is the response up to there.

    Examples
    --------
    >>> from analytic import Beam, Damping, Gravity, TipForce, forced_response
    >>> blade = Beam.reference().with_damping(Damping(external=0.1))
    >>> push = TipForce(amplitude=0.5)
    >>> found = forced_response(blade, 6.0, push, frequencies=[3.4, 3.7, 4.0], functions=8)
    >>> for peak in found.peaks:
    ...     print(f"{peak.amplitude:.4f} L at {peak.frequency:.4f} rad/s")
    0.0769 L at 3.7123 rad/s
    >>> blade = Beam.reference().with_damping(Damping(external=0.3))
    >>> found = forced_response(blade, [4.5, 5.0, 5.5], Gravity(), functions=8)
    >>> print(found.amplitude[found.at(5.0)].round(4))
    [0.1355]
    """
    unit = unit_load(blade, load)
    if load.varied is None:
        raise TypeError(
            f"forced_response varies the frequency of a load, and {load} has none: take "
            "spin_up_response"
        )
    if load.frequency is not None:
        raise ValueError(
            f"the load has a frequency, {load.frequency:g} rad/s, and forced_response varies it: "
            "leave it out of the load, and give it among the frequencies"
        )
    by_speed = load.varied == "speed"
    start = np.zeros(1)
    by_phase = by_speed or load.acts_on in (None, "span")
    if not by_phase and not np.isfinite(unit.force(start, np.nan * start, 1.0)).all():
        raise ValueError(
            f"{load} goes by the angle of the clamp as well, so that no response is periodic: take "
            "spin_up_response"
        )
    if by_speed:
        if frequencies is not None:
            raise ValueError(
                f"{load.called} goes around once a turn, at ω itself: give the speeds as omega, "
                "and no frequencies"
            )
        values = _ascending("omega", omega)
        highest = rotation_speed(float(values[-1]))
    else:
        highest, values = rotation_speed(omega), _ascending("frequencies", frequencies)
        warn_if_rpm(blade, highest)
    functions = whole_number("functions", functions, least=4, most=MOST_FUNCTIONS)
    model = continuum_of(blade, theory, functions, functions // 2, loads=(load,))
    steady = rotating_blade(blade, highest, model, gauge)
    if not blade.damping:
        _require_no_resonance(blade, None if by_speed else highest, theory, values)
    # Deflections are told from the steady state, at changing speeds from that at rest.
    rate = 0.0 if by_speed else steady.rate
    system = DrivenBlade(model=model, rate=rate, component=steady.component, drive=unit)
    least = whole_number("harmonics", harmonics)
    try:
        marked, error = response_curve(
            system, values / blade.frequency_scale, _LARGEST, least, model.tail
        )
    except NoOrbitError as failed:
        response, last = None, f" at {values[0]:g} rad/s"
        if failed.last:
            response = _packed(blade, load, theory, failed.last, math.nan)
            nu, a = response.frequency[-1], response.amplitude[-1]
            last = f" after {nu:.6g} rad/s, where |q|/L is {a:.4g}"
        free = model.twists and not blade.damping.of_strains[3]
        more = "damping of the bending, without which torsion has none," if free else "more damping"
        remedy = failed.remedy or f"take {more} or a smaller load"
        raise ResponseNotReachedError(
            f"the response to {load} was not found{last}: {failed}; {remedy}", response
        ) from None
    if error > RESPONSE_ERROR:
        warn(
            f"the response to {load} is known to {error:.1e} of its amplitude: no more functions "
            "are taken for the steps of the table; smooth those that its data do not know"
        )
    return _packed(blade, load, theory, marked, error)


def _ascending(name: str, given: Any) -> FloatArray:
    values = finite_values(name, given, "rad/s")
    if values.size < 2 or values[0] <= 0.0 or np.any(np.diff(values) <= 0.0):
        raise ValueError(
            f"{name} must be two or more, above 0 and ascending [rad/s], got {values.tolist()}: "
            "the first and the last are the ends of the curve"
        )
    return values


def _require_no_resonance(
    blade: Blade, omega: float | None, theory: Theory, values: FloatArray
) -> None:
    """Refuse frequencies that include a mode's, or speeds at which a mode meets a multiple."""
    no_end, remedy = (
        "without damping the response has no end at resonance, and",
        ("take blade.with_damping(Damping(...))"),
    )
    if omega is None:
        slow, fast = (
            math.floor(driven_modes(blade, w, theory=theory).frequencies[0] / w)
            for w in values[[0, -1]].tolist()
        )
        if slow > fast:
            raise ValueError(
                f"{no_end} the first mode meets {slow} times the speed in between: {remedy}"
            )
        return
    modes = driven_modes(blade, omega, 3, theory=theory)
    for name, frequency in zip(modes.names, modes.frequencies, strict=True):
        if values[0] <= frequency <= values[-1]:
            raise ValueError(
                f"{no_end} {name} is at {frequency:.6g} rad/s: {remedy}, or periodic_orbits "
                "for the backbone on which it ends"
            )


def _packed(
    blade: Blade, load: Load, theory: Theory, marked: list[Marked], error: float
) -> ForcedResponse:
    orbits, marks = zip(*marked, strict=True)
    count = max(orbit.harmonics for orbit in orbits)
    harmonics = [np.pad(o.gauge_harmonics, (0, count - o.harmonics)) for o in orbits]
    return ForcedResponse(
        **ForcedResponse.common_fields(blade, theory, orbits),
        load=load,
        omega=blade.frequency_scale * np.array([o.system.speed(o.frequency) for o in orbits]),
        harmonics=np.array(harmonics),
        residual=np.array([orbit.residual for orbit in orbits]),
        error=error,
        marks=marks,
    )
