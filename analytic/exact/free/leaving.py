"""Branches that leave the plane: orbits in space, born where planar ones lose their stability.

Out of its plane a planar orbit is linear. So the Jacobian of harmonic balance falls into two
blocks, and the one of flap and torsion, which is symmetric, is singular where a Floquet multiplier
is 1, and over two periods of the orbit where one is -1. Its null vector is the direction in which a
branch leaves. Mirrored in the plane the branch is another one: its distance from the plane goes
with the root of the amplitude's way from there.

A straight blade has two reversals of time, by the half turn about it and by the mirror through it
and the axis of rotation. The orbits of a branch keep one of them, and are half a Fourier series.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ...arrays import FloatArray
from ...blade_checks import require_out_of_plane
from ...lazily import optimize
from ...methods.arclength import corrected
from ...methods.continuation import Care, refined
from ...methods.fourier import packed
from ...methods.harmonic_balance import jacobian, solve
from ...methods.newton import NoOrbitError
from ...methods.orbit import Orbit
from ...methods.orbit_curve import At, OrbitCurve
from ...plotting import axes_or_new, draw_response
from ...settled import settled
from ..continuum.discretization import space_continuum
from ..continuum.rotation import BladeOrbit, SteadyBlade, rotating_blade
from .branch import Branch, SpecialPoint
from .path import ModePath

if TYPE_CHECKING:
    from ...plotting import Axes

_HARMONICS = (8, 12, 18, 27, 40)  # of the planar orbit at the birth, until it settles
_SETTLED = 1e-7  # of the logarithm of its amplitude
_LOCATED = 1e-9  # of its amplitude
# A strip in rotation flaps in short waves. So many unknowns take 2 GB, and 15 s for an orbit.
_CARE = Care(drift=1e-9, harmonics=120, unknowns=9000)
_BEGIN, _LONGEST = 0.005, 0.2  # steps of the arclength, over the size of the planar orbit


@dataclass(frozen=True, kw_only=True)
class LeavingBranch(Branch):
    """Orbits in space, in order from the planar orbit they leave; by `Backbone.leaving`.

    Attributes
    ----------
    beam, omega, mode : those of the backbone
    periods : int
        Periods of the planar orbit that one of these orbits takes at first: 1 or 2.
    mirror : bool
        Whether reversed time maps the orbits onto themselves by the mirror through the blade and
        the axis of rotation, as of a whirl; or by the half turn about the blade.
    born : SpecialPoint
        Frequency [rad/s] and amplitude |q|/L of the planar orbit.
    born_error : float
        Relative change of that amplitude by the last refinement.
    frequency : ndarray (points,)
        Of the orbits [rad/s]; times `periods` it begins at that of the planar orbit.
    amplitude : ndarray (points,)
        Peak |q|/L of the tip's lag.
    ended : str
        Reason why the branch ends.

    Examples
    --------
    >>> from analytic import Beam, backbone
    >>> oval = Beam.reference().with_section_out_of_plane(0.9, 0.8)
    >>> found = backbone(oval, omega=0.0, functions=6).leaving(0.3, 0.4, points=12)
    >>> print(f"born at a = {found.born.amplitude:.5f}, a whirl: {found.mirror}")
    born at a = 0.35808, a whirl: True
    >>> axes = found.plot()
    """

    periods: int
    mirror: bool
    born: SpecialPoint
    born_error: float
    ended: str = field(repr=False)

    @property
    def largest(self) -> FloatArray:
        """Largest lag and flap of the tip over L, and its twist [rad], (points, 3)."""
        return np.array([np.abs(course).max(axis=0) for course in self._courses])

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draw the largest lag over the frequency, unstable orbits dashed, and flap and twist.

        The frequency is that of the lag: `periods` times the orbits' own. Flap and twist have a
        scale of their own, on the right.
        """
        ax, stable = axes_or_new(ax), self.stable
        frequency = np.append(self.born.frequency, self.periods * self.frequency)
        right = ax.twinx()
        right.spines["right"].set_visible(True)
        starts = (self.born.amplitude, 0.0, 0.0)
        names = ("lag, |q|/L", "flap, |w|/L (right)", "twist [rad] (right)")
        on = ((ax, "C0", 2.0), (right, "C1", 1.2), (right, "C2", 0.8))
        for name, start, (axes, color, width), height in zip(
            names, starts, on, self.largest.T, strict=True
        ):
            draw_response(
                axes, frequency, np.append(start, height), np.append(stable[:1], stable),
                np.zeros(frequency.size, dtype=bool), label=name, color=color, lw=width,
            )  # fmt: skip
        ax.plot(self.born.frequency, self.born.amplitude, "o", color="black", ms=4.0)
        ax.set(xlabel="frequency of the lag [rad/s]", ylabel="largest lag of the tip, |q|/L")
        right.set(ylabel="largest flap |w|/L, twist [rad]")
        for axes, heights in ((ax, self.largest[:, 0]), (right, self.largest[:, 1:])):
            axes.set_ylim(0.0, 1.1 * heights.max())
            axes.ticklabel_format(useOffset=False)
        lines = [line for axes in (ax, right) for line in axes.get_legend_handles_labels()[0]]
        ax.legend(handles=lines)
        return ax

    def __str__(self) -> str:
        lag, flap, twist = self.largest[-1]
        return (
            f"At {self.omega:g} rad/s orbits leave the plane at a = {self.born.amplitude:.5g}, "
            f"{self.born.frequency:.6g} rad/s, of {self.periods} period{'s' * (self.periods > 1)} "
            f"of the lag: {self.frequency.size} up to lag {lag:.3g} L, flap {flap:.3g} L and twist "
            f"{twist:.3g} rad; {self.ended}"
        )


@dataclass(frozen=True, kw_only=True)
class _Leaving:
    """Planar orbits, of so many harmonics, as such of one reversal in space, and what leaves."""

    of: ModePath
    system: SteadyBlade
    periods: int
    harmonics: int

    def orbit(self, amplitude: float) -> BladeOrbit:
        """Return the planar orbit of an amplitude."""
        flat = self.of.path.at(amplitude).with_harmonics(self.harmonics)
        planar = solve(_in_space(flat, self.system, self.periods), amplitude)
        # Near the birth round-off is enlarged in flap and torsion.
        return replace(
            planar, coefficients=np.where(_across(self.system), 0.0, planar.coefficients)
        )

    def block(self, orbit: BladeOrbit) -> tuple[FloatArray, NDArray[np.intp]]:
        """Return the symmetric block of flap and torsion, and the places of its unknowns.

        Of two periods only odd harmonics belong to it: others leave after one.
        """
        order = np.arange(orbit.harmonics + 1)
        order = np.append(order, order[1:])[:, None]
        moves = _across(self.system) & (order % self.periods == self.periods - 1)
        places = np.flatnonzero(packed(moves, orbit.parts))
        # A mean has twice the weight of a wave, which makes the block symmetric.
        weights = packed(np.where(order == 0, 2.0, np.ones_like(orbit.coefficients)), orbit.parts)
        block = weights[places, None] * jacobian(orbit)[np.ix_(places, places)]
        return 0.5 * (block + block.T), places

    def values(self, amplitude: float) -> FloatArray:
        """Return the eigenvalues of the block, ascending."""
        return np.asarray(np.linalg.eigvalsh(self.block(self.orbit(amplitude))[0]))

    def birth(self, low: float, high: float) -> float | None:
        """Return where one of them is zero; None if as many are negative at both ends."""
        ends = {a: self.values(a) for a in (low, high)}
        count, other = (int(np.sum(values < 0.0)) for values in ends.values())
        if count == other:
            return None
        place = min(count, other)

        def value(a: float) -> float:
            return float((ends[a] if a in ends else self.values(a))[place])

        return float(optimize.brentq(value, low, high, xtol=_LOCATED * high))


def _across(system: SteadyBlade) -> NDArray[np.bool_]:
    """Return True for flap and torsion, which both reversals together turn around, (n,)."""
    across: NDArray[np.bool_] = system.model.blocks[1]
    return across


def _in_space(flat: BladeOrbit, system: SteadyBlade, periods: int) -> BladeOrbit:
    """Return a planar orbit as one in space, once or twice around."""
    planar, functions, H = flat.system.model, system.model.functions, flat.harmonics
    coefficients = np.zeros((2 * periods * H + 1, system.size))
    order = np.concatenate(([0], periods * np.arange(1, H + 1)))
    rows = np.append(order, periods * H + order[1:])
    bending, twists, *_ = functions.counts
    for coordinates, places in (
        (flat.coefficients[:, : planar.bending], np.arange(0, bending, 2)),
        (flat.coefficients[:, planar.bending :], bending + twists + np.arange(functions.counts[2])),
    ):
        count = min(coordinates.shape[1], places.size)
        coefficients[np.ix_(rows, places[:count])] = coordinates[:, :count]
    return Orbit(
        system=system, amplitude=flat.amplitude, frequency=flat.frequency / periods,
        coefficients=coefficients, peak_phase=flat.peak_phase / periods,
    )  # fmt: skip


def leaving_branch(
    of: ModePath, low: float, high: float, periods: int, points: int
) -> LeavingBranch:
    """Return the branch that leaves the planar orbits, as `Backbone.leaving` says."""
    require_out_of_plane(of.blade, of.theory)
    model = space_continuum(of.blade, of.theory, of.path.at(high).system.model.bending)
    flat = rotating_blade(of.blade, of.omega, model)
    systems = [replace(flat, mirror=mirror) for mirror in (False, True)]

    def births() -> Iterator[tuple[float, _Leaving]]:
        """Yield the smallest amplitude at which something leaves, and what, ever finer."""
        at = None
        for harmonics in _HARMONICS:
            at, end = None, high
            for one in systems:
                leaving = _Leaving(of=of, system=one, periods=periods, harmonics=harmonics)
                place = leaving.birth(low, end)
                if place is not None:
                    at, end = (place, leaving), place
            if at is not None:
                yield at
        if at is None:
            raise ValueError(
                f"between a = {low:g} and {high:g} no multiplier out of the plane passes "
                f"{'1' if periods == 1 else '-1'} at {of.omega:g} rad/s: take the amplitudes "
                "around an edge that stable of orbits shows, periods=2 where the period doubles"
            )

    _, (amplitude, leaving), error = settled(
        lambda birth: birth, births(), _SETTLED, lambda birth: np.log(birth[0]),
        "the amplitude at which a branch leaves the plane", "look at smaller orbits",
    )  # fmt: skip
    birth = leaving.orbit(amplitude)
    orbits, ended = _followed(leaving, birth, points)
    return LeavingBranch(
        **LeavingBranch.common_fields(of.blade, of.theory, orbits),
        omega=of.omega,
        mode=of.mode,
        periods=periods,
        mirror=leaving.system.mirror,
        born=SpecialPoint(periods * birth.frequency * of.blade.frequency_scale, amplitude),
        born_error=error,
        marks=("",) * len(orbits),
        ended=ended,
    )


def _followed(leaving: _Leaving, birth: BladeOrbit, points: int) -> tuple[list[BladeOrbit], str]:
    """Return the orbits of the branch in order, and why it ends."""
    block, places = leaving.block(birth)
    values, vectors = np.linalg.eigh(block)
    size = float(np.linalg.norm(packed(birth.coefficients, birth.parts)))
    curve = OrbitCurve(
        birth, birth.frequency, birth.frequency / size, lambda at: refined(at.orbit, _CARE)
    )
    start = curve.unknowns(birth)
    across = np.zeros(start.size)
    across[places] = vectors[:, np.argmin(np.abs(values))]
    at = At(curve, corrected(curve, start + _BEGIN * size * across, across)).resolved()
    orbits = [at.orbit]
    try:
        for here, there in at.followed(_BEGIN * size, _LONGEST * size):
            if len(orbits) == points:
                break
            if _apart(here.orbit) @ _apart(there.orbit) < 0.0:
                return orbits, "the branch comes back to the plane"
            orbits.append(there.orbit)
    except NoOrbitError as reason:
        return orbits, f"there {reason}"
    return orbits, "followed no farther"


def _apart(orbit: BladeOrbit) -> FloatArray:
    """Return the lowest harmonics of flap and torsion."""
    kept = orbit.with_harmonics(6).coefficients[:, _across(orbit.system)]
    return np.asarray(kept[:, :6].ravel())
