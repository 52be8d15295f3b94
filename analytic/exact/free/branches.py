"""The backbone as a branch: with its folds, internal resonances and the tongues they make."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...arrays import FloatArray
from ...beam import AnyBlade, require_undamped, warn_if_rpm
from ...input_checks import peak_deflection, rotation_speed, whole_number
from ...methods.continuation import Care
from ...methods.floquet import Multipliers, floquet_multipliers
from ...methods.newton import NoOrbitError
from ...theory import BERNOULLI_EULER, Theory
from ...threads import one_thread
from ..beam.state import BeamState, orbit_state
from ..beam.steady import BeamOrbit
from ..linear.modes import resolved_model
from .branch import Branch, branch_of
from .internal_resonance import Resonance, frequency_at, pinned, resonances_along
from .tongues import Crossing, follow, leave, tongue

_GRID, _FINE_GRID = 0.05, 0.02  # of |q|/L between the orbits of the main path, below and above
_FINE_FROM = 0.8  # where frequency ratios change fast
_CARE = Care(harmonics=120, halvings=8)  # above 0.8 orbits lie between tongues
_END_POINTS = 60  # by arclength, where steps in amplitude find no orbit
_SAME = 1e-3  # amplitudes that are no farther apart tell nothing of how a ratio changes


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
    amplitude : ndarray (points,)
        Peak |q|/L, in order along each piece.
    frequency : ndarray (points,)
        [rad/s].
    piece : ndarray (points,)
        0 for the main path, then a number for each tongue that was followed off it.
    resonances : tuple of Resonance
        Where a harmonic of the orbits on the main path meets another mode, by the Floquet exponents
        about them, ascending.
    folds : tuple of Fold
        Where amplitude turns around.
    branch_points : tuple of Fold
        Where another branch crosses a piece that was followed by arclength; `switched` follows it.

    Examples
    --------
    >>> from analytic import Beam, backbone_branch
    >>> found = backbone_branch(Beam.reference(), omega=6.0, up_to=0.1)
    >>> print(f"{found.frequency[-1]:.5f} rad/s at {found.amplitude[-1]:.2f} L")
    3.73001 rad/s at 0.10 L
    """

    beam: AnyBlade
    omega: float
    mode: int
    amplitude: FloatArray
    frequency: FloatArray
    piece: NDArray[np.int_]
    resonances: tuple[Resonance, ...]
    folds: tuple[Fold, ...]
    branch_points: tuple[Fold, ...]
    _crossings: tuple[Crossing, ...] = field(repr=False)
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
        return orbit_state(self.beam, self._orbits[i], x, phase)

    def switched(self, i: int) -> tuple[FloatArray, FloatArray]:
        """Return amplitude and frequency [rad/s] along the branch that crosses at branch point `i`.

        Each (points,), from one side of the crossing to the other, as far as it is resolved.
        """
        count = len(self._crossings)
        if not 0 <= i < count:
            raise IndexError(f"branch point {i} is none of the {count} that there are")
        here = self._crossings[i]
        sides = [leave(here, sign) for sign in (-1.0, 1.0)]
        orbits = [*sides[0][::-1], *sides[1]]
        per_second = self.beam.frequency_scale
        return (
            np.array([orbit.amplitude for orbit in orbits]),
            np.array([orbit.frequency for orbit in orbits]) * per_second,
        )

    def __str__(self) -> str:
        met = ", ".join(f"{r.harmonic}:{r.mode} at {r.amplitude:.3f}" for r in self.resonances)
        turns = ", ".join(f"{fold.amplitude:.4f}" for fold in self.folds)
        main = self.amplitude[self.piece == 0]
        return (
            f"Backbone of mode {self.mode} at {self.omega:g} rad/s up to a = {main.max():.4g}; "
            f"harmonic:mode in resonance: {met or 'none'}; "
            + (f"folds at a = {turns}" if turns else "no folds")
        )


@one_thread
def backbone_branch(
    beam: AnyBlade,
    omega: float,
    up_to: float = 0.9,
    mode: int = 1,
    *,
    theory: Theory = BERNOULLI_EULER,
    functions: int = 16,
) -> BackboneBranch:
    """Return the backbone of a mode up to an amplitude, with its internal resonances.

    The main path is that of `periodic_orbits`, on up to 120 harmonics. Where a harmonic that is
    felt meets another mode, the orbits are followed by arclength from either side, through the
    folds that the resonance makes and a way into its tongue, on which the other mode takes over.

    Parameters
    ----------
    beam : Beam or Blade
        Without damping.
    omega : float
        Rotation speed ω [rad/s].
    up_to : float
        Largest peak |q|/L, below 1. Where the path ends before, it ends in a fold.
    mode, theory, functions
        As for `periodic_orbits`.

    Raises
    ------
    ValueError
        If an argument is refused.
    AmplitudeNotReachedError
        If no orbit grows out of the mode.

    Examples
    --------
    >>> from analytic import Beam, backbone_branch
    >>> found = backbone_branch(Beam.reference(), omega=4.0, up_to=0.15)
    >>> for one in found.resonances:
    ...     print(f"harmonic {one.harmonic} meets mode {one.mode} at a = {one.amplitude:.4f}")
    harmonic 16 meets mode 3 at a = 0.1269
    """
    omega, mode = rotation_speed(omega), whole_number("mode", mode)
    up_to = peak_deflection("up_to", up_to)
    warn_if_rpm(beam, omega)
    require_undamped(beam, "a damped blade has no free periodic orbits")
    branch = branch_of(beam, omega, mode, resolved_model(beam, mode, theory, functions), _CARE)
    main = _main_path(branch, up_to)
    end = None
    if main[-1].amplitude < up_to - 1e-9:
        end = follow(main[-2], main[-1], lambda orbit: False, up_to=up_to, points=_END_POINTS)
    if end is not None and end.fold is None:
        main, end = [*main, *end.orbits[1:]], None
    per_second = beam.frequency_scale
    met = []
    for one in resonances_along(main, branch.modes, mode, per_second):
        near, place = pinned(branch.path.at, main, one)
        main = sorted([*main, *near], key=lambda orbit: orbit.amplitude)
        met.append(one._replace(amplitude=place, frequency=frequency_at(main, place) * per_second))
    met.sort(key=lambda one: one.amplitude)
    followed = [tongue(main, met, one, below) for one in met for below in (True, False)]
    off = [piece for piece in [*followed, end] if piece is not None]
    pieces = [main, *(piece.orbits for piece in off)]
    orbits = [orbit for piece in pieces for orbit in piece]
    crossings = [crossing for piece in off for crossing in piece.crossings]

    def places(at: list[BeamOrbit]) -> tuple[Fold, ...]:
        return tuple(Fold(orbit.amplitude, orbit.frequency * per_second) for orbit in at)

    return BackboneBranch(
        beam=beam,
        omega=omega,
        mode=mode,
        amplitude=np.array([orbit.amplitude for orbit in orbits]),
        frequency=np.array([orbit.frequency for orbit in orbits]) * per_second,
        piece=np.repeat(np.arange(len(pieces)), [len(piece) for piece in pieces]),
        resonances=tuple(met),
        folds=places([piece.fold for piece in off if piece.fold is not None]),
        branch_points=places([one.curve.orbit(one.z) for one in crossings]),
        _crossings=tuple(crossings),
        _orbits=tuple(orbits),
    )


def _main_path(branch: Branch, up_to: float) -> list[BeamOrbit]:
    """Return the orbits on a grid of amplitudes, and the last that there is."""
    path, found = branch.path, []
    coarse, fine = np.arange(_GRID, _FINE_FROM, _GRID), np.arange(_FINE_FROM, 1.0, _FINE_GRID)
    grid = np.concatenate((coarse, fine))
    for a in [*grid[grid < up_to - 1e-9].tolist(), up_to]:
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
