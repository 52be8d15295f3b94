"""Modes about the steady state as a value: their names by families, their shapes."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Literal, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...arrays import ComplexArray, FloatArray
from ...blade import Blade
from ...input_checks import points_of_beam
from ...plotting import DASHES, axes_or_new
from ...theory import Theory
from ..continuum.discretization import Model
from ..continuum.rotation import GAUGES, SteadyBlade
from ..continuum.space import SpaceContinuum

if TYPE_CHECKING:
    from ...plotting import Axes

_DRAWN = 201  # points of a shape
_ONLY_TURNS = 1e-6  # displacement of the tip over the length, times its turn
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
        The modes in the energy norm of the discretization, by which `campbell` distinguishes them.

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
    >>> ax = modes.plot()
    """

    blade: Blade
    omega: float
    theory: Theory
    frequencies: FloatArray
    shares: FloatArray
    error: float
    coordinates: ComplexArray = field(repr=False)
    steady: SteadyBlade = field(repr=False)

    @property
    def model(self) -> Model:
        """The discretization."""
        model: Model = self.steady.model
        return model

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
        moved, turn = self.model.moved(self.steady.equilibrium, self.coordinates, at)
        parts = np.concatenate((length * moved, turn[:1]))
        tip = parts[:3, -1]
        largest = np.take_along_axis(tip, np.argmax(np.abs(tip), axis=0)[None], axis=0)[0]
        only_turns = np.abs(largest) < _ONLY_TURNS * length * np.abs(parts[3, -1])
        return np.asarray(parts[:, :-1] / np.where(only_turns, parts[3, -1], largest))

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draw the shapes along the blade, named, with their frequencies in Hz; return the axes.

        Of each mode its family's part, the largest value 1, in the phase of this value.

        Parameters
        ----------
        ax : Axes, optional
            Drawn on these; otherwise on a new figure.
        """
        ax = axes_or_new(ax)
        x = np.linspace(0.0, self.blade.length, _DRAWN)
        moved = dict(zip(("axial", "lag", "flap", "torsion"), self.shapes(x), strict=True))
        for k, (name, frequency) in enumerate(zip(self.names, self.frequencies, strict=True)):
            family = name.split()[0]
            shape = moved[family][:, k]
            shape = (shape / shape[np.argmax(np.abs(shape))]).real
            label = f"{name}, {frequency / (2.0 * math.pi):.4g} Hz"
            ax.plot(x, shape, ls=DASHES[family], label=label)
        ax.set(xlabel="x [m]", ylabel="shape", xlim=(0.0, self.blade.length))
        ax.legend(title=f"ω = {self.omega:.4g} rad/s")
        return ax

    def lowest(self, count: int, only: Family | None = None) -> LinearModes:
        """Return the lowest modes, of all or of one family."""
        names, of = self.names, places_of(self.names, count, only)
        if len(of) < count:
            raise ValueError(
                f"count is {count}, and the blade has {len(of)} {only or ''} modes: flap and "
                "torsion need a section that is known out of the plane, and no motion without "
                f"stiffness or inertia has modes; the lowest are {', '.join(names[:4])}"
            )
        return self.among(of)

    def among(self, places: Sequence[int] | NDArray[np.intp]) -> LinearModes:
        """Return some of the modes, by their places."""
        return replace(
            self,
            frequencies=self.frequencies[places],
            shares=self.shares[places],
            coordinates=self.coordinates[places],
        )


def modes_of(blade: Blade, omega: float, theory: Theory, steady: SteadyBlade) -> LinearModes:
    """Return all modes of a blade in steady rotation."""
    frequencies, shapes = steady.vibration
    return LinearModes(
        blade=blade,
        omega=omega,
        theory=theory,
        frequencies=frequencies * blade.frequency_scale,
        shares=steady.shares,
        error=math.nan,
        coordinates=shapes.T,
        steady=steady,
    )


def flap_shape(model: SpaceContinuum) -> FloatArray:
    """Return the first flap mode of a planar blade at rest, (n,), its tip 1 out of the plane."""
    at_rest = SteadyBlade(model, 0.0, GAUGES["flap"])
    shape = at_rest.vibration_of(np.arange(1, model.functions.counts[0], 2))[1][:, 0].real
    return np.asarray(shape / (at_rest.gauge_gradient(at_rest.equilibrium[None])[0] @ shape))


def orbit_shapes(modes: LinearModes) -> FloatArray | ComplexArray:
    """Return shapes (modes, n) out of which orbits grow; the gauge is a sine in them.

    Under time reversal odd coordinates go with the sine, the others with the cosine: real shapes.
    Without it the motion is the real part of the shape times exp(iφ).
    """
    steady, shapes = modes.steady, modes.coordinates
    gradient = steady.gauge_gradient(steady.equilibrium[None])[0]
    parts: FloatArray | ComplexArray = -1j * shapes
    if steady.odd is not None:
        shapes = parts = np.where(steady.odd, shapes.real, shapes.imag)
    tip = shapes @ gradient
    # The tip stands still in modes of other blocks.
    return parts / np.where(tip == 0.0, 1.0, tip)[:, None]
