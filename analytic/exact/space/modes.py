"""Linear modes of the blade in space about its steady state: flap, lag and torsion together."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from ...arrays import ComplexArray, FloatArray
from ...beam import AnyBlade
from ...input_checks import points_of_beam
from ...methods.gyroscopic import reciprocal_modes
from ...settled import settled
from ...theory import Theory
from .continuum import SpaceContinuum
from .steady import FUNCTIONS, SpaceBlade, finer_blades, space_continuum, space_rotation

_MASSLESS = 1e-12  # 1/Ω of what has no inertia


@dataclass(frozen=True, kw_only=True)
class SpaceModes:
    """Modes of a blade in space; made by `linear_modes` of a blade that is not planar.

    Attributes
    ----------
    blade : Blade
    omega : float
        Rotation speed ω [rad/s].
    theory : Theory
    frequencies : ndarray (count,)
        Natural frequencies in the rotating frame [rad/s], ascending.
    shares : ndarray (count, 3)
        Shares of flap, lag and torsion in the kinetic energy of each mode.
    error : float
        Largest relative change of the frequencies by the last refinement.
    coordinates : ndarray (count, n)
        The modes in the energy norm of the discretization, by which `campbell` tells them apart.
    """

    blade: AnyBlade
    omega: float
    theory: Theory
    frequencies: FloatArray
    shares: FloatArray
    error: float
    model: SpaceContinuum = field(repr=False)
    coordinates: ComplexArray = field(repr=False)
    _steady: FloatArray = field(repr=False)

    def lag(self, x: ArrayLike) -> ComplexArray:
        """Return the displacements at `x` [m] in the direction of rotation, (points, count)."""
        return np.asarray(self._moved(x)[0][1])

    def flap(self, x: ArrayLike) -> ComplexArray:
        """Return the displacements at `x` [m] normal to it and to the clamp, (points, count).

        On the scale of `lag`: the larger of both is 1 at the tip. The phase tells which is ahead.
        """
        return np.asarray(self._moved(x)[0][2])

    def twist(self, x: ArrayLike) -> ComplexArray:
        """Return the turns about the clamp's axis at `x` [m] on that scale, (points, count)."""
        return np.asarray(self._moved(x)[1][0])

    def _moved(self, x: ArrayLike) -> tuple[ComplexArray, ComplexArray]:
        length = self.blade.length
        at = np.append(points_of_beam("x", x, length), 1.0)
        change = self.model.changes(self._steady[None])
        onto = self.model.functions.grid.integral(at)
        places, turns = onto @ change.slope[:, 0], onto @ change.bend[:, 0]
        shapes = self.coordinates.T
        place, turn = length * places @ shapes, turns @ shapes
        tip = place[1:, -1]
        largest = np.take_along_axis(tip, np.argmax(np.abs(tip), axis=0)[None], axis=0)[0]
        return place[:, :-1] / largest, turn[:, :-1] / largest


def space_modes(blade: AnyBlade, omega: float, count: int, theory: Theory) -> SpaceModes:
    """Return the lowest modes, on more and more functions until they settle.

    Raises
    ------
    ValueError
        If they do not.
    """
    model = space_continuum(blade, theory, max(FUNCTIONS, 2 * count + 4))
    _, (steady, (found, shapes)), error = settled(
        lambda one: (one, _solved(one)),
        finer_blades(space_rotation(blade, omega, model)),
        model.functions.blade.tolerance,
        lambda solved: np.log(solved[1][0][:count]),
    )
    if error > model.functions.blade.tolerance:
        raise ValueError(
            f"the frequencies at omega = {omega:g} rad/s have not settled with "
            f"{steady.functions} functions: the last refinement changes them by {error:.1e}; "
            "ask for fewer modes, or rotate slower"
        )
    return _packed(blade, omega, steady, found[:count], shapes[:, :count], error)


def space_modes_on(model: SpaceContinuum, blade: AnyBlade, omega: float, count: int) -> SpaceModes:
    """Return the modes on a discretization that is known to resolve them, unchecked."""
    steady = space_rotation(blade, omega, model)
    found, shapes = _solved(steady)
    return _packed(blade, omega, steady, found[:count], shapes[:, :count], math.nan)


def _packed(
    blade: AnyBlade,
    omega: float,
    steady: SpaceBlade,
    frequencies: FloatArray,
    shapes: ComplexArray,
    error: float,
) -> SpaceModes:
    return SpaceModes(
        blade=blade,
        omega=omega,
        theory=steady.model.functions.theory,
        frequencies=frequencies * blade.frequency_scale,
        shares=_shares(steady, shapes),
        error=error,
        model=steady.model,
        coordinates=shapes.T,
        _steady=steady.equilibrium,
    )


def _solved(steady: SpaceBlade) -> tuple[FloatArray, ComplexArray]:
    """Return the frequencies, ascending, and the shapes (n, modes) in columns."""
    at = steady.linearized
    # x exp(iΩτ) obeys K + iΩC - Ω²M, with a skew C.
    gyroscopic = -0.5j * (at.damping[0] - at.damping[0].T)
    stiffness, mass = (0.5 * (part[0] + part[0].T) for part in (at.stiffness, at.mass))
    inverse, shapes = reciprocal_modes(stiffness, gyroscopic, mass)
    kept = inverse > _MASSLESS
    return 1.0 / inverse[kept], np.asarray(shapes[:, kept], dtype=np.complex128)


def orbit_modes(steady: SpaceBlade) -> tuple[FloatArray, FloatArray | ComplexArray]:
    """Return frequencies and shapes (modes, n) from which orbits grow, their gauge a sine.

    Under time reversal odd coordinates go with the sine, the others with the cosine: real shapes.
    Without it the motion is the real part of the shape times exp(iφ).
    """
    frequencies, shapes = _solved(steady)
    odd, gradient = steady.odd, steady.gauge_gradient(steady.equilibrium[None])[0]
    if odd is None:
        return frequencies, np.asarray((-1j * shapes / (gradient @ shapes)).T)
    # The phase that turns the odd ones into the sine.
    turn = np.sum(shapes[odd] ** 2, axis=0)
    shapes = shapes * 1j * np.conj(np.sqrt(turn / np.abs(turn)))
    parts = np.where(odd[:, None], -shapes.imag, shapes.real).T
    return frequencies, np.asarray(parts / (parts @ gradient)[:, None])


def _shares(steady: SpaceBlade, coordinates: ComplexArray) -> FloatArray:
    """Return the shares of flap, lag and torsion in the kinetic energy, (modes, 3)."""
    change, masses = steady.model.changes(steady.equilibrium[None]), steady.model.masses
    moved = masses.mass @ np.abs(change.center[:, 0] @ coordinates) ** 2
    turned = change.turn_m[:, 0] @ coordinates
    twist = np.einsum("ipk,ijp,jpk->k", turned.conj(), masses.inertia, turned).real
    parts = np.stack((moved[2], moved[1], twist), axis=-1)
    return np.asarray(parts / (moved.sum(axis=0) + twist)[:, None])
