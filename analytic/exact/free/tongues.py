"""Off the backbone: into the tongues of internal resonances, by arclength."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from itertools import islice

import numpy as np

from ...arrays import FloatArray
from ...methods.arclength import corrected
from ...methods.continuation import refined
from ...methods.newton import NoOrbitError
from ...methods.orbit_curve import At, OrbitCurve
from ..beam.steady import BeamOrbit, SteadyBeam
from .internal_resonance import Resonance

_STEP, _LONGEST = 0.02, 0.2  # of the arclength in a tongue
_TONGUE_POINTS = 14
_FREQUENCY_SCALE = 0.05  # relative change of Ω that counts as much as a unit of the coordinates
_ROUGHLY = 1e-4  # drift of the invariant up to which a fold is still told, beyond all harmonics
_FELT = 1e-3  # size of a harmonic, over the first, whose resonance is looked into
_TAKES_OVER = 3.0  # growth of that harmonic by which a tongue is told from the path


@dataclass(frozen=True, eq=False)
class Crossing:
    """Where another branch crosses, and the way it goes."""

    curve: OrbitCurve[SteadyBeam]
    z: FloatArray
    off: FloatArray


@dataclass(eq=False)
class Piece:
    """Orbits followed off the main path, where the amplitude turns, and what crosses."""

    orbits: list[BeamOrbit]
    fold: BeamOrbit | None
    crossings: list[Crossing]


def tongue(
    main: list[BeamOrbit], met: list[Resonance], resonance: Resonance, below: bool
) -> Piece | None:
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

    def goes_on(orbit: BeamOrbit) -> bool:
        """Whether the path has crossed the resonance without a tongue."""
        passed = (orbit.amplitude > other.amplitude) == below
        return passed and _share(orbit, k) < _TAKES_OVER * _share(other, k)

    return follow(before, last, goes_on)


def _share(orbit: BeamOrbit, k: int) -> float:
    """Return the size of harmonic k over that of the first."""
    sizes = np.linalg.norm(orbit.sines, axis=1)
    return float(sizes[k - 1] / sizes[0])


def follow(
    before: BeamOrbit,
    last: BeamOrbit,
    goes_on: Callable[[BeamOrbit], bool],
    *,
    up_to: float = 1.0,
    points: int = _TONGUE_POINTS,
) -> Piece | None:
    """Return the orbits that follow two by arclength; None if the path just goes on.

    So many points at most, and not beyond the amplitude `up_to`.
    """
    curve = OrbitCurve(last, last.frequency, _FREQUENCY_SCALE * last.frequency, _better_resolved)
    start = curve.unknowns(last)
    piece = Piece([last], None, [])
    # As far as it is resolved.
    with suppress(NoOrbitError):
        at = At(curve, corrected(curve, start, start - curve.unknowns(before)))
        for here, there in at.followed(_STEP, _LONGEST):
            if goes_on(there.orbit):
                return None
            piece.orbits.append(there.orbit)
            if piece.fold is None:
                peak = here.peak(there)
                piece.fold = None if peak is None else here.curve.orbit(peak.z)
            elif (met := here.crossing(there)) is not None:
                # Short of the fold the sign of the determinant only tells that a narrow tongue was
                # stepped over.
                piece.crossings.append(Crossing(here.curve, *met))
            if len(piece.orbits) >= points or there.orbit.amplitude >= up_to:
                break
    return piece if len(piece.orbits) > 2 else None


def leave(here: Crossing, sign: float) -> list[BeamOrbit]:
    """Return the orbits on one side of the branch that crosses, as far as it is resolved."""
    found: list[BeamOrbit] = []
    with suppress(NoOrbitError):
        guess = here.z + sign * _STEP * here.off
        there = At(here.curve, corrected(here.curve, guess, sign * here.off)).resolved()
        found = [there.orbit]
        ahead = there.followed(_STEP, _LONGEST)
        found += [there.orbit for _, there in islice(ahead, _TONGUE_POINTS - 1)]
    return found


def _better_resolved(orbit: BeamOrbit) -> BeamOrbit | None:
    """Return the orbit on more harmonics or functions, None if it needs none."""
    try:
        return refined(orbit)
    except NoOrbitError:
        if orbit.invariant_drift < _ROUGHLY:
            return None
        raise
