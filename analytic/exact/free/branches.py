"""The backbone as a branch: its folds, its internal resonances, and the tongues they make."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, replace
from itertools import islice

import numpy as np
from numpy.typing import NDArray

from ...methods.arclength import corrected
from ...methods.continuation import Care, refined
from ...methods.newton import NoOrbitError
from ...methods.orbit_curve import At, Marked, OrbitCurve
from ..continuum.rotation import BladeOrbit
from .branch import Branch
from .internal_resonance import Resonance, frequency_at, pinned, resonances_along
from .path import ModePath

_GRID, _FINE_GRID = 0.05, 0.02  # of |q|/L between the orbits of the main path, below and above
_FINE_FROM = 0.8  # where frequency ratios change fast
_CARE = Care(harmonics=120, halvings=8)  # above 0.8 orbits lie between tongues
_END_POINTS = 60  # by arclength, where steps in amplitude find no orbit
_SAME = 1e-3  # amplitudes that are no farther apart tell nothing of how a ratio changes
_STEP, _LONGEST = 0.02, 0.2  # of the arclength in a tongue
_TONGUE_POINTS = 14
_FREQUENCY_SCALE = 0.05  # relative change of Ω that counts as much as a unit of the coordinates
_ROUGHLY = 1e-4  # drift of the invariant up to which a fold is still told, beyond all harmonics
_FELT = 1e-3  # size of a harmonic, over the first, whose resonance is looked into
_TAKES_OVER = 3.0  # growth of that harmonic by which a tongue is told from the path


@dataclass(frozen=True, kw_only=True)
class BackboneBranch(Branch):
    """Free orbits of one mode, with the tongues of internal resonances; by `Backbone.branch`.

    Its folds are where the amplitude turns around.

    Attributes
    ----------
    beam, omega, mode : those of the backbone
    amplitude : ndarray (points,)
        Peak |q|/L, in order along each piece.
    frequency : ndarray (points,)
        [rad/s].
    piece : ndarray (points,)
        0 for the main path, then a number for each tongue that was followed off it.
    resonances : tuple of Resonance
        Where a harmonic of the orbits on the main path meets another mode, by the Floquet exponents
        about them, ascending.
    """

    piece: NDArray[np.int_]
    resonances: tuple[Resonance, ...]

    def __str__(self) -> str:
        met = ", ".join(f"{r.harmonic}:{r.mode} at {r.amplitude:.3f}" for r in self.resonances)
        turns = ", ".join(f"{fold.amplitude:.4f}" for fold in self.folds)
        main = self.amplitude[self.piece == 0]
        return (
            f"Backbone of {self.mode} at {self.omega:g} rad/s up to a = {main.max():.4g}; "
            f"harmonic:mode in resonance: {met or 'none'}; "
            + (f"folds at a = {turns}" if turns else "no folds")
        )


def followed_branch(of: ModePath, up_to: float) -> BackboneBranch:
    """Return the branch of a backbone, as `Backbone.branch` says."""
    of = replace(of, care=_CARE)
    main, end = _main_path(of, up_to), None
    if main[-1].amplitude < up_to - 1e-9:
        end = _followed(main[-2], main[-1], lambda orbit: False, up_to=up_to, points=_END_POINTS)
    if end is not None and not _folds(end):
        main, end = [*main, *(orbit for orbit, _ in end[1:])], None
    per_second = of.blade.frequency_scale
    met = []
    for one in resonances_along(of, main):
        near, place = pinned(of.path.at, main, one)
        main = sorted([*main, *near], key=lambda orbit: orbit.amplitude)
        met.append(one._replace(amplitude=place, frequency=frequency_at(main, place) * per_second))
    met.sort(key=lambda one: one.amplitude)
    tongues = [_tongue(main, met, one, below) for one in met for below in (True, False)]
    pieces = [[(orbit, "") for orbit in main], *filter(None, [*tongues, end])]
    orbits, marks = zip(*(marked for piece in pieces for marked in piece), strict=True)
    return BackboneBranch(
        **BackboneBranch.common_fields(of.blade, of.theory, orbits),
        omega=of.omega,
        mode=of.mode,
        marks=marks,
        piece=np.repeat(np.arange(len(pieces)), [len(piece) for piece in pieces]),
        resonances=tuple(met),
    )


def _main_path(of: ModePath, up_to: float) -> list[BladeOrbit]:
    """Return the orbits on a grid of amplitudes, and the last that there is."""
    path, orbits = of.path, []
    coarse, fine = np.arange(_GRID, _FINE_FROM, _GRID), np.arange(_FINE_FROM, 1.0, _FINE_GRID)
    grid = np.concatenate((coarse, fine))
    for a in [*grid[grid < up_to - 1e-9].tolist(), up_to]:
        try:
            orbits.append(path.at(a))
        except NoOrbitError:
            # In a tongue, or beyond the end.
            if path.nodes[-1].amplitude < a:
                break
    both = sorted(
        [*orbits, *(o for o in path.nodes if o.amplitude < up_to)], key=lambda o: o.amplitude
    )
    return [
        o
        for o, last in zip(both, [None, *both], strict=False)
        if last is None or o.amplitude - last.amplitude > _SAME
    ]


def _tongue(
    main: list[BladeOrbit], met: list[Resonance], resonance: Resonance, below: bool
) -> list[Marked] | None:
    """Return the orbits off the main path into the tongue of a resonance, from one side."""
    near = [o for o in main if (o.amplitude < resonance.amplitude) == below]
    beyond = [o for o in main if (o.amplitude >= resonance.amplitude) == below]
    if len(near) < 2 or not beyond:
        return None
    k = resonance.harmonic
    before, last, other = (
        (near[-2], near[-1], beyond[0]) if below else (near[1], near[0], beyond[-1])
    )
    if k > min(last.harmonics, other.harmonics) or _share(last, k) < _FELT:
        return None
    low, high = sorted((before.amplitude, last.amplitude))
    felt = [one for one in met if one.harmonic <= last.harmonics]
    felt = [one for one in felt if _share(last, one.harmonic) >= 10.0 * _FELT]
    if any(low < one.amplitude < high for one in felt):
        return None  # another resonance is nearer, and two sides of it give no direction

    def goes_on(orbit: BladeOrbit) -> bool:
        """Whether the path has crossed the resonance without a tongue."""
        passed = (orbit.amplitude > other.amplitude) == below
        return passed and _share(orbit, k) < _TAKES_OVER * _share(other, k)

    return _followed(before, last, goes_on)


def _share(orbit: BladeOrbit, k: int) -> float:
    """Return the size of harmonic k over the size of the first."""
    sizes = orbit.sizes
    return float(sizes[k - 1] / sizes[0])


def _followed(
    before: BladeOrbit,
    last: BladeOrbit,
    goes_on: Callable[[BladeOrbit], bool],
    *,
    up_to: float = 1.0,
    points: int = _TONGUE_POINTS,
) -> list[Marked] | None:
    """Return the orbits that follow two, to `up_to` at most; None if the path just goes on."""
    scale = _FREQUENCY_SCALE * last.frequency
    curve = OrbitCurve(last, last.frequency, scale, lambda at: _better_resolved(at.orbit))
    start = curve.unknowns(last)
    piece: list[Marked] = [(last, "")]
    # As far as it is resolved.
    with suppress(NoOrbitError):
        at = At(curve, corrected(curve, start, start - curve.unknowns(before)))
        for here, there in islice(at.followed(_STEP, _LONGEST), points - 1):
            if goes_on(there.orbit):
                return None
            if not _folds(piece):
                if (peak := here.peak(there)) is not None:
                    piece.append((here.curve.orbit(peak.z), "fold"))
            elif (met := here.crossing(there)) is not None:
                # Short of the fold the sign of the determinant only tells that a narrow tongue was
                # stepped over.
                piece.append((here.curve.orbit(met), "branch point"))
            piece.append((there.orbit, ""))
            if there.orbit.amplitude >= up_to:
                break
    return piece if sum(mark == "" for _, mark in piece) > 2 else None


def _folds(piece: list[Marked]) -> bool:
    return any(mark == "fold" for _, mark in piece)


def _better_resolved(orbit: BladeOrbit) -> BladeOrbit | None:
    """Return the orbit on more harmonics or functions, None if it needs none."""
    try:
        return refined(orbit)
    except NoOrbitError:
        if orbit.invariant_drift < _ROUGHLY:
            return None
        raise
