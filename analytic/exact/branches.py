"""The backbone as a branch: with its folds, internal resonances and the tongues they make."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..arrays import FloatArray
from ..beam import AnyBlade, require_undamped, warn_if_rpm
from ..input_checks import finite_number, positive, rotation_speed, whole_number
from ..methods.arclength import NoWayOnError, advanced, corrected, located
from ..methods.floquet import Multipliers, floquet_multipliers
from ..methods.free import FreeCurve
from ..methods.harmonic_balance import NoOrbitError
from ..methods.orbit_curve import At
from .internal_resonance import Resonance, resonances_along
from .modes import resolved_model
from .periodic import Branch, branch_of
from .state import BeamState, beam_state
from .steady import BeamOrbit, SteadyBeam

_GRID = 0.05  # of |q|/L between the orbits of the main path
_STEP, _LONGEST = 0.02, 0.2  # of the arclength in a tongue
_TONGUE_POINTS = 14
_SAME = 1e-3  # amplitudes that are no farther apart tell nothing of how a ratio changes
_FELT = 1e-3  # size of a harmonic, over the first, whose resonance is looked into
_TAKES_OVER = 3.0  # growth of that harmonic by which a tongue is told from the path


class Fold(NamedTuple):
    """Where a branch turns around.

    Attributes
    ----------
    amplitude : float
        Peak |q|/L, greatest or least there.
    frequency : float
        [rad/s].
    """

    amplitude: float
    frequency: float


@dataclass(frozen=True, kw_only=True)
class BackboneBranch:
    """Free orbits of one mode, with the tongues of internal resonances; by `backbone_branch`.

    Attributes
    ----------
    beam : Beam or Blade
    omega : float
        Rotation speed ω [rad/s].
    mode : int
    amplitude, frequency : ndarray (points,)
        Peak |q|/L and frequency [rad/s], in order along each piece.
    piece : ndarray (points,)
        0 for the main path, then a number for each tongue that was followed off it.
    resonances : tuple of Resonance
        Where a harmonic of the orbits on the main path meets another mode, by the Floquet exponents
        about them, ascending.
    folds : tuple of Fold
        Where amplitude turns around.
    """

    beam: AnyBlade
    omega: float
    mode: int
    amplitude: FloatArray
    frequency: FloatArray
    piece: NDArray[np.int_]
    resonances: tuple[Resonance, ...]
    folds: tuple[Fold, ...]
    _orbits: tuple[BeamOrbit, ...] = field(repr=False)

    @cached_property
    def _stability(self) -> tuple[Multipliers, ...]:
        return tuple(floquet_multipliers(orbit) for orbit in self._orbits)

    @property
    def stable(self) -> NDArray[np.bool_]:
        """Whether each orbit is stable in the plane, (points,), as `Backbone.stable` says."""
        return np.array([found.stable() for found in self._stability])

    @property
    def stability_changes(self) -> FloatArray:
        """Amplitudes on the main path between an orbit that is stable and one that is not."""
        main = self.piece == 0
        changes = np.flatnonzero(np.diff(self.stable[main].astype(int)))
        a = self.amplitude[main]
        return np.asarray(0.5 * (a[changes] + a[changes + 1]))

    def state(self, i: int, x: ArrayLike, phase: float = 0.0) -> BeamState:
        """Return the state of orbit `i` at the material points `x` [m], to start a code from."""
        orbit, phase = self._orbits[i], finite_number("phase", phase, "rad")
        q, q_dot, _ = orbit.coordinates(np.array([phase]))
        return beam_state(self.beam, orbit.system.model, q[0], q_dot[0], x)

    def __str__(self) -> str:
        met = ", ".join(f"{r.harmonic}:{r.mode} at {r.amplitude:.3f}" for r in self.resonances)
        turns = ", ".join(f"{fold.amplitude:.4f}" for fold in self.folds)
        main = self.amplitude[self.piece == 0]
        return (
            f"Backbone of mode {self.mode} at {self.omega:g} rad/s up to a = {main.max():.4g}; "
            f"harmonic:mode in resonance: {met or 'none'}; folds at a = {turns or 'none'}"
        )


def backbone_branch(
    beam: AnyBlade,
    omega: float,
    up_to: float = 0.9,
    mode: int = 1,
    *,
    inextensible: bool = False,
    functions: int = 16,
) -> BackboneBranch:
    """Return the backbone of a mode up to an amplitude, with its internal resonances.

    The main path is that of `periodic_orbits`. Where a harmonic that is felt meets another mode,
    the orbits are followed by arclength from either side, through the folds that the resonance
    makes and a way into its tongue, on which the other mode takes over.

    Parameters
    ----------
    beam : Beam or Blade
        Without damping.
    omega : float
        Rotation speed ω [rad/s].
    up_to : float
        Largest peak |q|/L, below 1. Where the path ends before, it ends in a fold.
    mode, inextensible, functions
        As for `periodic_orbits`.

    Raises
    ------
    ValueError
        If an argument is refused.
    AmplitudeNotReachedError
        If no orbit grows out of the mode.
    """
    omega, mode = rotation_speed(omega), whole_number("mode", mode)
    if positive("up_to", up_to) >= 1.0:
        raise ValueError(f"up_to must be below 1, got {up_to:g}: it is |q|/L of the tip")
    warn_if_rpm(beam, omega)
    require_undamped(beam, "a damped blade has no free periodic orbits")
    branch = branch_of(
        beam, omega, mode, resolved_model(beam, mode, inextensible, False, functions)
    )
    main = _main_path(branch, up_to)
    per_second = beam.frequency_scale
    met = resonances_along(main, branch.modes, mode, per_second)
    pieces, folds = [main], []
    for resonance in met:
        for below in (True, False):
            tongue, fold = _tongue(main, met, resonance, below)
            pieces += [tongue] if tongue else []
            folds += [fold] if fold else []
    if main[-1].amplitude < up_to - 1e-9:
        tongue, fold = _followed(main[-2], main[-1], lambda orbit: False)
        pieces += [tongue] if tongue else []
        folds += [fold] if fold else []
    orbits = [orbit for piece in pieces for orbit in piece]
    return BackboneBranch(
        beam=beam,
        omega=omega,
        mode=mode,
        amplitude=np.array([orbit.amplitude for orbit in orbits]),
        frequency=np.array([orbit.frequency for orbit in orbits]) * per_second,
        piece=np.repeat(np.arange(len(pieces)), [len(piece) for piece in pieces]),
        resonances=tuple(met),
        folds=tuple(Fold(o.amplitude, o.frequency * per_second) for o in folds),
        _orbits=tuple(orbits),
    )


def _main_path(branch: Branch, up_to: float) -> list[BeamOrbit]:
    """Return the orbits on a grid of amplitudes, and the last that there is."""
    path, found = branch.path, []
    for a in np.append(np.arange(_GRID, up_to - 1e-9, _GRID), up_to).tolist():
        try:
            found.append(path.at(a))
        except NoOrbitError:
            # In a tongue, or beyond the end.
            if path.nodes[-1].amplitude < a:
                break
    both = sorted(
        [*found, *(o for o in path.nodes if o.amplitude < up_to)], key=lambda o: o.amplitude
    )
    return [
        o
        for o, last in zip(both, [None, *both], strict=False)
        if last is None or o.amplitude - last.amplitude > _SAME
    ]


def _tongue(
    main: list[BeamOrbit], met: list[Resonance], resonance: Resonance, below: bool
) -> tuple[list[BeamOrbit], BeamOrbit | None]:
    """Return the orbits off the main path into the tongue, from one side, and where they turn."""
    near = [o for o in main if (o.amplitude < resonance.amplitude) == below]
    beyond = [o for o in main if (o.amplitude >= resonance.amplitude) == below]
    if len(near) < 2 or not beyond:
        return [], None
    k = resonance.harmonic
    before, last, other = (
        (near[-2], near[-1], beyond[0]) if below else (near[1], near[0], beyond[-1])
    )
    if k > min(last.harmonics, other.harmonics) or _share(last, k) < _FELT:
        return [], None
    low, high = sorted((before.amplitude, last.amplitude))
    felt = [one for one in met if one.harmonic <= last.harmonics]
    felt = [one for one in felt if _share(last, one.harmonic) >= 10.0 * _FELT]
    if any(low < one.amplitude < high for one in felt):
        return [], None  # another resonance is nearer, and two sides of it give no direction

    def goes_on(orbit: BeamOrbit) -> bool:
        """Whether the path has crossed the resonance without a tongue."""
        passed = (orbit.amplitude > other.amplitude) == below
        return passed and _share(orbit, k) < _TAKES_OVER * _share(other, k)

    return _followed(before, last, goes_on)


def _share(orbit: BeamOrbit, k: int) -> float:
    """Return the size of harmonic k over that of the first."""
    sizes = np.linalg.norm(orbit.sines, axis=1)
    return float(sizes[k - 1] / sizes[0])


def _followed(
    before: BeamOrbit, last: BeamOrbit, goes_on: Callable[[BeamOrbit], bool]
) -> tuple[list[BeamOrbit], BeamOrbit | None]:
    """Return the orbits that follow two, and that at which the amplitude turns, if it does.

    None of them if the path just goes on.
    """
    curve = FreeCurve(last, last.frequency)
    start = curve.unknowns(last)
    found, fold, step = [last], None, _STEP
    # As far as it is resolved.
    with suppress(NoWayOnError):
        at = At(curve, corrected(curve, start, start - curve.unknowns(before)))
        while len(found) < _TONGUE_POINTS:
            point, step = advanced(at.curve, at.point, step, _LONGEST)
            there = At(at.curve, point).resolved()
            if there.curve is not at.curve:
                at = at.on(there.curve)
            if goes_on(there.orbit):
                return [], None
            fold = fold or _turning_point(at, there)
            found.append(there.orbit)
            at = there
    return (found, fold) if len(found) > 2 else ([], None)


def _turning_point(
    at: At[FreeCurve[SteadyBeam]], there: At[FreeCurve[SteadyBeam]]
) -> BeamOrbit | None:
    """Return the orbit between two at which the amplitude is stationary, if there is one."""
    curve = at.curve
    point = located(curve, at.point, there.point, lambda p: curve.climb(p.z, p.tangent))
    return None if point is None else curve.orbit(point.z)
