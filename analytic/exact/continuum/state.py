"""The exact beam at material points: its state, to start a code from, and the loads in sections."""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ...arrays import FloatArray

if TYPE_CHECKING:
    from ...blade import Blade


@dataclass(frozen=True, kw_only=True)
class BeamState:
    """State of the beam at material points, in the rotating frame: r = (x + u, v, w); SI units.

    Attributes
    ----------
    u, v : ndarray (points,)
        Displacements along and across the undeformed axis [m].
    u_slope, v_slope : ndarray (points,)
        Their derivatives to x, u' and v' [-].
    u_dot, v_dot, u_slope_dot, v_slope_dot : ndarray (points,)
        The rates of all four as seen in the rotating frame [m/s, 1/s].
    shear_angle, shear_angle_dot : ndarray (points,) or float
        How far the sections lag behind the tangent [rad], and its rate [rad/s]; 0 without shear.
    w, w_slope, w_dot, w_slope_dot : ndarray (points,) or float
        Displacement out of the plane [m], its derivative to x, and the rates of both; 0 in the
        plane. Sections are turned about their tangent by nothing.

    Examples
    --------
    >>> from analytic import Beam, periodic_orbits
    >>> orbit = periodic_orbits(Beam.reference(), omega=6.0, amplitudes=[0.3])
    >>> state = orbit.state(0, [4.0, 8.0], phase=1.0)
    >>> print(state.u.round(4), state.v.round(4))
    [-0.094  -0.2838] [0.8022 2.0198]
    """

    u: FloatArray
    v: FloatArray
    u_slope: FloatArray
    v_slope: FloatArray
    u_dot: FloatArray
    v_dot: FloatArray
    u_slope_dot: FloatArray
    v_slope_dot: FloatArray
    shear_angle: FloatArray | float = 0.0
    shear_angle_dot: FloatArray | float = 0.0
    w: FloatArray | float = 0.0
    w_slope: FloatArray | float = 0.0
    w_dot: FloatArray | float = 0.0
    w_slope_dot: FloatArray | float = 0.0


def straight_state(x: FloatArray, **moving: FloatArray) -> BeamState:
    """Return the state at `x` of a straight blade at rest, but for the parts that are given."""
    flat = dict.fromkeys((one.name for one in fields(BeamState)), np.zeros_like(x))
    return BeamState(**flat | moving)


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
    trapeze : bool
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
    trapeze: bool = False

    @property
    def tension(self) -> FloatArray:
        """N [N], (samples, stations)."""
        return np.asarray(self.force[..., 0])


def in_newtons(
    blade: Blade,
    x: FloatArray,
    standing: tuple[FloatArray, FloatArray],
    loads: tuple[FloatArray, FloatArray],
    trapeze: bool,
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


def flap_of_kick(x: FloatArray, derivative: int = 0) -> FloatArray:
    """Return x²(6 - 4x + x²)/3 of x/L, the flap of a kick over that of the tip, or a derivative.

    The shape that a uniform load gives a cantilever: its end has neither moment nor force.
    """
    found: FloatArray = np.polynomial.Polynomial([0.0, 0.0, 2.0, -4.0 / 3.0, 1.0 / 3.0]).deriv(
        derivative
    )(x)
    return found


def kicked_state(length: float, speed: float, x: FloatArray) -> BeamState:
    """Return the state at `x` [m] of a straight blade whose tip is kicked out of the plane."""
    slope = speed / length * flap_of_kick(x / length, 1)
    return straight_state(x, w_dot=speed * flap_of_kick(x / length), w_slope_dot=slope)
