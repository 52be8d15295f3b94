"""Linear modes of the blade in space about its steady state: flap, lag and torsion together."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any, Literal, get_args

import numpy as np
from numpy.typing import ArrayLike

from ...arrays import ComplexArray, FloatArray
from ...blade import Blade
from ...input_checks import points_of_beam
from ...settled import require_tolerance, settled
from ...theory import Theory
from ..continuum.rotation import (
    FUNCTIONS,
    SpaceBlade,
    finer_blades,
    space_continuum,
    space_rotation,
)
from ..continuum.space import SpaceContinuum

_ONLY_TURNS = 1e-6  # displacement of the tip over the length, times its turn
DIRECTIONS = {"lag": (0.0, 1.0, 0.0), "flap": (0.0, 0.0, 1.0)}
"""Directions of the tip, in the root frame, whose peak may be called the amplitude."""


def require_gauge(gauge: object) -> None:
    """Refuse a name that is no place of the tip."""
    if gauge not in DIRECTIONS:
        raise ValueError(f"gauge must be 'lag' or 'flap', got {gauge!r}")


Family = Literal["flap", "lag", "torsion", "axial"]
"""A family of modes, by the largest share of their kinetic energy."""
FAMILIES: tuple[Family, ...] = get_args(Family)


def mode_names(shares: FloatArray) -> tuple[str, ...]:
    """Return the names of modes in ascending order, "lag 1" say, by their shares (count, 4)."""
    kinds = [FAMILIES[k] for k in np.argmax(shares, axis=1).tolist()]
    return tuple(f"{kind} {kinds[: i + 1].count(kind)}" for i, kind in enumerate(kinds))


def places_of(names: Sequence[str], count: int, only: Family | None) -> list[int]:
    """Return the places of at most so many of the lowest modes, of all or of one family."""
    return [k for k, name in enumerate(names) if only is None or name.startswith(only)][:count]


@dataclass(frozen=True, kw_only=True)
class LinearModes:
    """Modes about the rotating steady state; made by `linear_modes`.

    Attributes
    ----------
    beam, omega, theory : as given
    frequencies : ndarray (count,)
        Natural frequencies in the rotating frame [rad/s], ascending. Sections are free to warp: a
        clamp that holds it raises those of torsion by a quarter of its depth over the length.
    names : tuple of str
        "lag 1", "flap 2", "torsion 1", "axial 1": the family of the largest share, and the number
        within the family from the lowest frequency on.
    shares : ndarray (count, 4)
        Shares of flap, lag, torsion and axial motion in the kinetic energy of each mode.
    error : float
        Largest relative change of the frequencies by the last refinement.
    coordinates : ndarray (count, n)
        The modes in the energy norm of the discretization, by which `campbell` tells them apart.

    Examples
    --------
    >>> from analytic import Beam, Rectangle, linear_modes
    >>> strip = Beam.reference().with_shape(Rectangle())
    >>> modes = linear_modes(strip, omega=6.0, count=4)
    >>> for name, frequency in zip(modes.names, modes.frequencies, strict=True):
    ...     print(f"{name} {frequency:.3f} rad/s")
    lag 1 3.730 rad/s
    flap 1 6.048 rad/s
    flap 2 14.831 rad/s
    lag 2 23.010 rad/s
    >>> along, lag, flap, twist = modes.shapes([4.0, 8.0])
    >>> print(lag[:, 0].real.round(3))
    [0.389 1.   ]
    """

    blade: Blade
    omega: float
    theory: Theory
    frequencies: FloatArray
    shares: FloatArray
    error: float
    model: Any = field(repr=False)
    coordinates: ComplexArray = field(repr=False)
    setting: float = field(repr=False)
    _steady: FloatArray = field(repr=False)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the modes."""
        return mode_names(self.shares)

    def shapes(self, x: ArrayLike) -> ComplexArray:
        """Return the shapes at `x` [m], (4, points, count).

        Displacements along the clamp's line, in the direction of rotation (lag) and normal to both
        (flap), and the turn about the clamp's line [rad]. The largest displacement of the tip is 1;
        where the tip only turns, to 1e-6 of its turn times the length, the turn is. Motion is the
        real part times exp(iΩt): the phase says which part is ahead.
        """
        length = self.blade.length
        at = np.append(points_of_beam("x", x, length), 1.0)
        moved, turn = self.model.moved(self._steady, self.coordinates, at, self.setting)
        parts = np.concatenate((length * moved, turn[None]))
        tip = parts[:3, -1]
        largest = np.take_along_axis(tip, np.argmax(np.abs(tip), axis=0)[None], axis=0)[0]
        only_turns = np.abs(largest) < _ONLY_TURNS * length * np.abs(parts[3, -1])
        return np.asarray(parts[:, :-1] / np.where(only_turns, parts[3, -1], largest))

    def lowest(self, count: int, only: Family | None = None) -> LinearModes:
        """Return the lowest modes, of all or of one family."""
        names, of = self.names, places_of(self.names, count, only)
        if len(of) < count:
            raise ValueError(
                f"count is {count}, and the blade has {len(of)} {only or ''} modes: flap and "
                "torsion need a section that is known out of the plane, and no motion without "
                f"stiffness or inertia has modes; the lowest are {', '.join(names[:4])}"
            )
        return replace(
            self,
            frequencies=self.frequencies[of],
            shares=self.shares[of],
            coordinates=self.coordinates[of],
        )


def space_modes(
    blade: Blade,
    omega: float,
    count: int,
    theory: Theory,
    only: Family | None = None,
    tolerance: float | None = None,
    near: LinearModes | None = None,
) -> LinearModes:
    """Return the lowest modes, of all or of one family, on more functions until they settle.

    On those of other modes `near` to begin with.
    """
    model = near.model if near else space_continuum(blade, theory, max(FUNCTIONS, 2 * count + 4))
    first = space_rotation(blade, omega, model)

    def finer(steady: SpaceBlade) -> SpaceBlade:
        if only is None:
            return steady.resolving(count)
        return steady.resolving(
            1 + max(places_of(mode_names(steady.shares), count, only), default=0)
        )

    _, modes, error = settled(
        lambda steady: _modes_of(blade, omega, steady).lowest(count, only),
        finer_blades(first, finer),
        require_tolerance(tolerance, first.model.functions.blade.tolerance),
        lambda modes: np.log(modes.frequencies),
        f"the frequencies at omega = {omega:g} rad/s",
        "ask for fewer modes, or rotate slower",
    )
    return replace(modes, error=error)


def space_modes_on(
    model: SpaceContinuum,
    blade: Blade,
    omega: float,
    count: int,
    only: Family | None = None,
    *,
    near: LinearModes | None = None,
) -> LinearModes:
    """Return the modes on a discretization that is known to resolve them, unchecked.

    The steady state is sought from that of modes on the same discretization at a speed nearby.
    """
    steady = space_rotation(blade, omega, model)
    if near is not None:
        steady = replace(steady, near=near._steady)
    return _modes_of(blade, omega, steady).lowest(count, only)


def _modes_of(blade: Blade, omega: float, steady: SpaceBlade) -> LinearModes:
    frequencies, shapes = steady.vibration
    return LinearModes(
        blade=blade,
        omega=omega,
        theory=steady.model.functions.theory,
        frequencies=frequencies * blade.frequency_scale,
        shares=steady.shares,
        setting=0.0,
        error=math.nan,
        model=steady.model,
        coordinates=shapes.T,
        _steady=steady.equilibrium,
    )


def flap_shape(model: SpaceContinuum) -> FloatArray:
    """Return the first flap mode of a planar blade at rest, (n,), its tip 1 out of the plane."""
    at_rest = SpaceBlade(model, 0.0, DIRECTIONS["flap"])
    shape = at_rest.vibration_of(np.arange(1, model.functions.counts[0], 2))[1][:, 0].real
    return np.asarray(shape / (at_rest.gauge_gradient(at_rest.equilibrium[None])[0] @ shape))


def orbit_modes(
    steady: SpaceBlade, gauge: str
) -> tuple[SpaceBlade, FloatArray, FloatArray | ComplexArray, tuple[str, ...]]:
    """Return the blade with its gauge; frequencies, shapes (modes, n) and names of its modes.

    Orbits grow out of the shapes; the gauge is a sine in them. Under time reversal odd coordinates
    go with the sine, the others with the cosine: real shapes. Without it the motion is the real
    part of the shape times exp(iφ).
    """
    frequencies, shapes = steady.vibration
    names = mode_names(steady.shares)
    if steady.direction != DIRECTIONS[gauge]:
        steady = replace(steady, direction=DIRECTIONS[gauge], near=steady.equilibrium)
    odd, gradient = steady.odd, steady.gauge_gradient(steady.equilibrium[None])[0]
    if odd is None:
        shapes = -1j * shapes / _not_zero(gradient @ shapes)
        return steady, frequencies, shapes.T, names
    # The phase that turns the odd ones into the sine.
    turn = _not_zero(np.sum(shapes[odd] ** 2, axis=0))
    shapes = shapes * 1j * np.conj(np.sqrt(turn / np.abs(turn)))
    parts = np.where(odd[:, None], -shapes.imag, shapes.real).T
    return steady, frequencies, np.asarray(parts / _not_zero(parts @ gradient)[:, None]), names


def _not_zero(values: Any) -> Any:
    """Return values where the motion of a mode may be none: those of other blocks."""
    return np.where(values == 0.0, 1.0, values)
