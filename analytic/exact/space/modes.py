"""Linear modes of the blade in space about its steady state: flap, lag and torsion together."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...arrays import ComplexArray, FloatArray
from ...beam import AnyBlade, require_out_of_plane
from ...input_checks import points_of_beam
from ...methods.system import reciprocal_modes
from ...settled import settled
from ...theory import Theory
from .continuum import SpaceContinuum
from .steady import FUNCTIONS, SpaceBlade, finer_blades, space_continuum, space_rotation

_MASSLESS = 1e-12  # 1/Ω of what has no inertia
_ONLY_TWISTS = 1e-6  # displacement of the tip over the length, times its turn
DIRECTIONS = {"lag": (0.0, 1.0, 0.0), "flap": (0.0, 0.0, 1.0)}
"""Directions of the tip, in the root frame, whose peak may be called the amplitude."""


def require_gauge(gauge: object) -> None:
    """Refuse a name that is no place of the tip."""
    if gauge not in DIRECTIONS:
        raise ValueError(f"gauge must be 'lag' or 'flap', got {gauge!r}")


@dataclass(frozen=True, kw_only=True)
class LinearModes:
    """Modes about the rotating steady state, in the plane or in space; made by `linear_modes`.

    Attributes
    ----------
    beam, omega, theory : as given
    frequencies : ndarray (count,)
        Natural frequencies in the rotating frame [rad/s], ascending. Sections are free to warp: a
        clamp that holds it raises those of torsion by a quarter of its depth over the length.
    shares : ndarray (count, 3)
        Shares of flap, lag and torsion in the kinetic energy of each mode.
    error : float
        Largest relative change of the frequencies by the last refinement.
    coordinates : ndarray (count, n)
        The modes in the energy norm of the discretization, by which `campbell` tells them apart.

    Examples
    --------
    >>> from analytic import Beam, linear_modes
    >>> modes = linear_modes(Beam.reference(), omega=6.0, count=2)
    >>> print(modes.lag([2.0, 4.0, 8.0]).round(4))
    [[ 0.1307 -0.3935]
     [ 0.3889 -0.6521]
     [ 1.      1.    ]]
    """

    beam: AnyBlade
    omega: float
    theory: Theory
    frequencies: FloatArray
    shares: FloatArray
    error: float
    model: Any = field(repr=False)
    coordinates: Any = field(repr=False)
    setting: float = field(repr=False)
    _steady: FloatArray = field(repr=False)

    def lag(self, x: ArrayLike) -> Any:
        """Return the displacements at `x` [m] in the direction of rotation, (points, count)."""
        return self._moved(x)[0][1]

    def flap(self, x: ArrayLike) -> Any:
        """Return the displacements at `x` [m] normal to it and to the clamp, (points, count).

        On the scale of `lag`: the largest of all is 1 at the tip. In space the phase tells which is
        ahead. Where the tip only twists, to 1e-6 of its turn times the length, the twist is.
        """
        return self._moved(x)[0][2]

    def twist(self, x: ArrayLike) -> Any:
        """Return the turns about the clamp's axis at `x` [m] on that scale, (points, count)."""
        return self._moved(x)[1]

    def shapes(self, x: ArrayLike) -> FloatArray:
        """Return the deflections of a planar blade in its plane of bending at `x` [m]."""
        if self.model.in_space:
            raise ValueError("this blade bends in space: take lag, flap and twist of its modes")
        (_, lag, flap), _ = self._moved(x)
        return np.asarray(math.cos(self.setting) * lag + math.sin(self.setting) * flap)

    def _moved(self, x: ArrayLike) -> tuple[Any, Any]:
        length = self.beam.length
        at = np.append(points_of_beam("x", x, length), 1.0)
        moved, turn = self.model.moved(self._steady, self.coordinates, at, self.setting)
        place, tip = length * moved, length * moved[:, -1]
        across = tip if self.model.in_space else np.stack((tip[0], np.hypot(*tip[1:])))
        k = np.argmax(np.abs(across), axis=0)[None]
        largest = np.take_along_axis(across, k, axis=0)[0]
        if not self.model.in_space:
            sign = np.sign(math.cos(self.setting) * tip[1] + math.sin(self.setting) * tip[2])
            largest = np.where(k[0] == 1, sign * largest, largest)
        only = np.abs(largest) < _ONLY_TWISTS * length * np.abs(turn[-1])
        largest = np.where(only, turn[-1], largest)
        return place[:, :-1] / largest, turn[:-1] / largest


def modes_across(
    blade: AnyBlade, omega: float, count: int, theory: Theory, family: str
) -> LinearModes:
    """Return the lowest modes of "flap" or "torsion" of a planar blade, by their larger share.

    Both move without lag, and without each other unless slices have rotary inertia. The trapeze
    effect and the propeller moment stiffen torsion. Of the paper's rectangle at 12 rad/s its first
    is at 64.49 rad/s without either, at 65.59 with the propeller moment alone, and at 66.75 with
    both.
    """
    known = require_out_of_plane(blade, torsion=False)
    if family == "flap":
        if known.torsion_ratio is None:
            rigid = blade.with_section_out_of_plane(known.bending_ratio, math.inf)
            return replace(space_modes(rigid, omega, count, theory, family), beam=blade)
    elif known.torsion_ratio is None or math.isinf(known.torsion_ratio):
        raise ValueError(
            "torsion has no modes where torsion_ratio is unknown or infinite: give GJ/EI by "
            "with_section_out_of_plane or with_shape"
        )
    elif blade.section.rotary_inertia == 0.0:
        raise ValueError(
            "torsion has no modes without inertia of the slices: leave rotary_inertia out of the "
            "section, for that of a homogeneous one"
        )
    return space_modes(blade, omega, count, theory, family)


def space_modes(
    blade: AnyBlade, omega: float, count: int, theory: Theory, family: str | None = None
) -> LinearModes:
    """Return the lowest modes, or those of a family alone, on more functions until they settle."""
    model = space_continuum(blade, theory, max(FUNCTIONS, 2 * count + 4))
    _, (steady, (found, shapes)), error = settled(
        lambda one: (one, _solved(one, family)),
        finer_blades(space_rotation(blade, omega, model)),
        model.functions.blade.tolerance,
        lambda solved: np.log(solved[1][0][:count]),
        f"the frequencies at omega = {omega:g} rad/s",
        "ask for fewer modes, or rotate slower",
    )
    return _packed(blade, omega, steady, found[:count], shapes[:, :count], error)


def space_modes_on(
    model: SpaceContinuum,
    blade: AnyBlade,
    omega: float,
    count: int,
    *,
    family: str | None = None,
    near: LinearModes | None = None,
) -> LinearModes:
    """Return the modes on a discretization that is known to resolve them, unchecked.

    The steady state is sought from that of modes on the same discretization at a speed nearby.
    """
    steady = space_rotation(blade, omega, model)
    if near is not None:
        steady = replace(steady, near=near._steady)
    found, shapes = _solved(steady, family)
    return _packed(blade, omega, steady, found[:count], shapes[:, :count], math.nan)


def _packed(
    blade: AnyBlade,
    omega: float,
    steady: SpaceBlade,
    frequencies: FloatArray,
    shapes: ComplexArray,
    error: float,
) -> LinearModes:
    return LinearModes(
        beam=blade,
        omega=omega,
        theory=steady.model.functions.theory,
        frequencies=frequencies * blade.frequency_scale,
        shares=steady.model.shares(steady.equilibrium, shapes.T),
        setting=0.0,
        error=error,
        model=steady.model,
        coordinates=shapes.T,
        _steady=steady.equilibrium,
    )


def _solved(steady: SpaceBlade, family: str | None = None) -> tuple[FloatArray, ComplexArray]:
    """Return the frequencies, ascending, and the shapes (n, modes) in columns."""
    every = np.arange(steady.size)
    if family is None:
        return _block(steady, every)
    bending, twists, _, shear = steady.model.functions.counts
    apart = every[1:bending:2], every[bending : bending + twists], every[every.size - shear // 2 :]
    frequencies, shapes = _block(steady, np.concatenate(apart))
    torsion = steady.model.shares(steady.equilibrium, shapes.T)[:, 2] > 0.5
    kept = torsion == (family == "torsion")
    return frequencies[kept], shapes[:, kept]


def flap_shape(model: SpaceContinuum) -> FloatArray:
    """Return the first flap mode of a planar blade at rest, (n,), its tip 1 out of the plane."""
    at_rest = SpaceBlade(model, 0.0, DIRECTIONS["flap"])
    shape = _block(at_rest, np.arange(1, model.functions.counts[0], 2))[1][:, 0].real
    return np.asarray(shape / (at_rest.gauge_gradient(at_rest.equilibrium[None])[0] @ shape))


def _block(steady: SpaceBlade, moving: NDArray[np.intp]) -> tuple[FloatArray, ComplexArray]:
    """Return the same where only some coordinates move."""
    parts: list[Any] = [part[0][np.ix_(moving, moving)] for part in steady.linearized[1:]]
    K, C, M = parts
    # x exp(iΩτ) obeys K + iΩC - Ω²M, with a skew C.
    inverse, found = reciprocal_modes(0.5 * (K + K.T), -0.5j * (C - C.T), 0.5 * (M + M.T))
    kept = inverse > _MASSLESS
    shapes = np.zeros((steady.size, np.count_nonzero(kept)), dtype=np.complex128)
    shapes[moving] = found[:, kept]
    return 1.0 / inverse[kept], shapes


def orbit_modes(
    steady: SpaceBlade, mode: int, gauge: str | None
) -> tuple[SpaceBlade, FloatArray, FloatArray | ComplexArray]:
    """Return the blade with its gauge, and frequencies and shapes (modes, n) of which orbits grow.

    The gauge is "flap" or "lag", by default that of which the mode has more; in the shapes a sine.
    Under time reversal odd coordinates go with the sine, the others with the cosine: real shapes.
    Without it the motion is the real part of the shape times exp(iφ).
    """
    frequencies, shapes = _solved(steady)
    if gauge is None:
        flap, lag, _ = steady.model.shares(steady.equilibrium, shapes[:, mode - 1 : mode].T)[0]
        gauge = "flap" if flap > lag else "lag"
    if steady.direction != DIRECTIONS[gauge]:
        steady = replace(steady, direction=DIRECTIONS[gauge], near=steady.equilibrium)
    odd, gradient = steady.odd, steady.gauge_gradient(steady.equilibrium[None])[0]
    if odd is None:
        return steady, frequencies, np.asarray((-1j * shapes / (gradient @ shapes)).T)
    # The phase that turns the odd ones into the sine.
    turn = np.sum(shapes[odd] ** 2, axis=0)
    shapes = shapes * 1j * np.conj(np.sqrt(turn / np.abs(turn)))
    parts = np.where(odd[:, None], -shapes.imag, shapes.real).T
    return steady, frequencies, np.asarray(parts / (parts @ gradient)[:, None])
