"""A blade at material points: its state, to start a code from, and the loads in sections."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ...arrays import FloatArray
from ...input_checks import points_of_beam

if TYPE_CHECKING:
    from ...blade import Blade


@dataclass(frozen=True, kw_only=True)
class BladeState:
    """State of a blade at material points, in the frame that turns with the clamp; SI units.

    Components are along the clamp, in the direction of rotation (lag) and normal to both (flap).

    Attributes
    ----------
    place, velocity : ndarray (points, 3)
        Places from the clamp [m] and their rates [m/s].
    slope, slope_rate : ndarray (points, 3)
        Derivatives of both to the length x of the unloaded blade [-, 1/s].
    section : ndarray (points, 3, 3)
        Axes of the sections, in columns, as of `SectionLoads`; with shear the first is not along
        the slope.
    spin : ndarray (points, 3)
        Angular velocity of the sections, as seen in this frame [rad/s].

    Examples
    --------
    >>> from analytic import Beam, periodic_orbits
    >>> orbit = periodic_orbits(Beam.reference(), omega=6.0, amplitudes=[0.3])
    >>> print(orbit.state(0, [4.0, 8.0], phase=1.0).place.round(4))
    [[3.906  0.8022 0.    ]
     [7.7162 2.0198 0.    ]]
    """

    place: FloatArray
    velocity: FloatArray
    slope: FloatArray
    slope_rate: FloatArray
    section: FloatArray
    spin: FloatArray

    def seen_from(self, axes: FloatArray) -> BladeState:
        """Return the state in a frame whose axes are the columns of a rotation (3, 3)."""
        parts = {name: value @ axes for name, value in vars(self).items()}
        return BladeState(**parts | {"section": axes.T @ self.section})


def state_of(
    blade: Blade, model: Any, q: FloatArray, q_dot: FloatArray, x: ArrayLike
) -> BladeState:
    """Return the state of coordinates and their rates (n,) at the points `x` [m]."""
    at = points_of_beam("x", x, blade.length)
    length, per_second = blade.length, blade.frequency_scale
    (place,), (section,) = model.standing(q[None], at)
    velocity, spin = (part[..., 0].real.T for part in model.moved(q, q_dot[None], at))
    (slope,), (slope_rate,) = model.slopes(q[None], q_dot[None], at)
    return BladeState(
        place=length * place,
        velocity=length * per_second * velocity,
        slope=slope,
        slope_rate=per_second * slope_rate,
        section=section,
        spin=per_second * spin,
    )


@dataclass(frozen=True, kw_only=True)
class SectionLoads:
    """Sections, and force and moment that the outboard part exerts on the inboard part; SI units.

    By d'Alembert's principle: all loads outboard, less mass times acceleration, with the rotation
    of the clamp, Coriolis forces and rotary inertia. In the section's axes, which turn with it: 1
    normal to it, 2 in the plane of bending or along the chord, 3 normal to both. At a point mass or
    a kink a station takes the outboard side, at the tip the inboard one.

    Attributes
    ----------
    blade : Blade
    stations : ndarray (stations,)
        From the clamp [m].
    place : ndarray (samples, stations, 3)
        Where the sections are [m], from the clamp: along the clamp, in the direction of rotation
        (lag) and normal to both (flap). The frame turns with the clamp and has its precone.
    section : ndarray (samples, stations, 3, 3)
        Axes of the sections, in columns, in the frame of `place`.
    force : ndarray (samples, stations, 3)
        Tension N, and shear forces along axes 2 and 3 [N].
    moment : ndarray (samples, stations, 3)
        Torque, and bending moments about axes 2 (flap, of a blade set at zero) and 3 (lag) [N m].
        Of a blade that bends in one plane the shear force along axis 3, the torque and the moment
        about axis 2 are zero; where its section out of this plane is unknown they are not
        computed. A steady state has no samples.
    trapeze : bool or "elastic"
        Whether twist shortens the axis, as `Theory` has it, so that tension twists a section too.

    Examples
    --------
    >>> from analytic import Beam, SpinUp, spin_up_response
    >>> found = spin_up_response(Beam.reference(), SpinUp(omega=6.0, ramp_time=3.0), [1.0, 2.0])
    >>> print(found.section_loads([0.0, 4.0]).moment[..., 2].round(2))
    [[ -69.55  -20.56]
     [-220.73  -21.15]]
    """

    blade: Blade
    stations: FloatArray
    place: FloatArray = field(repr=False)
    section: FloatArray = field(repr=False)
    force: FloatArray = field(repr=False)
    moment: FloatArray = field(repr=False)
    trapeze: bool | Literal["elastic"] = False

    @property
    def tension(self) -> FloatArray:
        """N [N], (samples, stations)."""
        return np.asarray(self.force[..., 0])


def in_newtons(
    blade: Blade,
    x: FloatArray,
    standing: tuple[FloatArray, FloatArray],
    loads: tuple[FloatArray, FloatArray],
    trapeze: bool | Literal["elastic"],
) -> SectionLoads:
    """Return places, sections and loads without dimensions at `x` over L as a value."""
    unit = blade.bending_stiffness / blade.length
    (place, section), (force, moment) = standing, loads
    return SectionLoads(
        blade=blade,
        stations=blade.length * x,
        place=blade.length * place,
        section=section,
        force=unit / blade.length * force,
        moment=unit * moment,
        trapeze=trapeze,
    )


class Driven(NamedTuple):
    """Rotation of the clamp and loads, without units, as the equations of motion take them."""

    rate: Any  # w, a number or (samples,)
    rate_dot: Any = 0.0
    push: Any = None  # load beyond each Gauss point, as the discretization's `push` returns it
    follow: Any = ()  # loads that turn with sections: each a `Span`, force and moment there
    clamp: Any = None  # W, Ẇ and h of a clamp that is moved, (3, samples, 1) each

    def share(self, part: float) -> Driven:
        """Return a share of speed and loads."""
        return Driven(
            part * self.rate,
            part * self.rate_dot,
            None if self.push is None else part * self.push,
            tuple((span, part * wrench) for span, wrench in self.follow),
        )


def flap_of_kick(x: FloatArray, derivative: int = 0) -> FloatArray:
    """Return x²(6 - 4x + x²)/3 of x/L, the flap of a kick over that of the tip, or a derivative.

    The shape that a uniform load gives a cantilever: its end has neither moment nor force.
    """
    shape: FloatArray = np.polynomial.Polynomial([0.0, 0.0, 2.0, -4.0 / 3.0, 1.0 / 3.0]).deriv(
        derivative
    )(x)
    return shape
