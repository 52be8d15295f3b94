"""Sections along a blade: where they are, how they stand, and the loads in them."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from ...arrays import FloatArray
from ...beam import AnyBlade


@dataclass(frozen=True, kw_only=True)
class SectionLoads:
    """Sections, and force and moment that the outboard part exerts on the inboard part; SI units.

    By d'Alembert's principle: all loads outboard, less mass times acceleration, with the rotation
    of the clamp, Coriolis forces and rotary inertia. In the section's axes, which turn with it: 1
    normal to it, 2 in the plane of bending or along the chord, 3 normal to both. At a point mass or
    a kink a station takes the outboard side, at the tip the inboard one.

    Attributes
    ----------
    blade : Beam or Blade
    stations : ndarray (stations,)
        From the clamp [m].
    place : ndarray (samples, stations, 3)
        Where the sections are [m], from the clamp: along the clamp, in the direction of rotation
        (lag) and normal to both (flap). The frame turns with the clamp and has its precone.
    section : ndarray (samples, stations, 3, 3)
        Axes of the sections, in columns, in the frame of `place`.
    force : ndarray (samples, stations, 2) or (samples, stations, 3)
        Tension N and shear force along axis 2, in space along axis 3 as well [N].
    moment : ndarray (samples, stations) or (samples, stations, 3)
        Bending moment M about axis 3, EI times the curvature [N m]. In space the torque, and the
        moments about axes 2 (flap, of a blade set at zero) and 3 (lag). A steady state has no
        samples.

    Examples
    --------
    >>> from analytic import Beam, SpinUp, spin_up_response
    >>> found = spin_up_response(Beam.reference(), SpinUp(omega=6.0, ramp_time=3.0), [1.0, 2.0])
    >>> print(found.section_loads([0.0, 4.0]).moment.round(2))
    [[ -69.55  -20.56]
     [-220.73  -21.15]]
    """

    blade: AnyBlade
    stations: FloatArray
    place: FloatArray = field(repr=False)
    section: FloatArray = field(repr=False)
    force: FloatArray = field(repr=False)
    moment: FloatArray = field(repr=False)

    @property
    def tension(self) -> FloatArray:
        """N [N], (samples, stations)."""
        return np.asarray(self.force[..., 0])


def in_newtons(
    beam: AnyBlade,
    x: FloatArray,
    standing: tuple[FloatArray, FloatArray],
    loads: tuple[FloatArray, FloatArray],
) -> SectionLoads:
    """Return places, sections and loads without dimensions at `x` over L as a value."""
    unit = beam.bending_stiffness / beam.length
    (place, section), (force, moment) = standing, loads
    return SectionLoads(
        blade=beam,
        stations=beam.length * x,
        place=beam.length * place,
        section=section,
        force=unit / beam.length * force,
        moment=unit * moment,
    )


def in_plane_of_bending(angle: FloatArray, setting: float) -> FloatArray:
    """Return the sections (..., 3, 3) of a planar blade set at ψ, turned by θ (...), both [rad].

    In columns, in the frame of the clamp.
    """
    turn = np.zeros((*angle.shape, 3, 3))
    turn[..., 0, 0] = turn[..., 1, 1] = np.cos(angle)
    turn[..., 1, 0] = np.sin(angle)
    turn[..., 0, 1] = -turn[..., 1, 0]
    turn[..., 2, 2] = 1.0
    return set_at(setting) @ turn


def set_at(setting: float) -> FloatArray:
    """Return the rotation (3, 3) about the blade by its setting angle [rad]."""
    c, s = math.cos(setting), math.sin(setting)
    return np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])
