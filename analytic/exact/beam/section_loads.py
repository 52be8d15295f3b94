"""Loads in the sections of a blade: what its outboard part exerts on its inboard part."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ...arrays import FloatArray
from ...beam import AnyBlade


@dataclass(frozen=True, kw_only=True)
class SectionLoads:
    """Force and moment that the outboard part exerts on the inboard part; SI units.

    By d'Alembert's principle: all loads outboard, less mass times acceleration, with the rotation
    of the clamp, Coriolis forces and rotary inertia. In the section's axes, which turn with it: 1
    normal to it, 2 in the plane of bending or along the chord, 3 normal to both. At a point mass or
    a kink a station takes the outboard side, at the tip the inboard one.

    Attributes
    ----------
    stations : ndarray (stations,)
        From the clamp [m].
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

    stations: FloatArray
    force: FloatArray = field(repr=False)
    moment: FloatArray = field(repr=False)

    @property
    def tension(self) -> FloatArray:
        """N [N], (samples, stations)."""
        return np.asarray(self.force[..., 0])


def in_newtons(beam: AnyBlade, x: FloatArray, loads: tuple[FloatArray, FloatArray]) -> SectionLoads:
    """Return loads without dimensions at the places `x` over L as a value."""
    unit = beam.bending_stiffness / beam.length
    force, moment = loads
    return SectionLoads(
        stations=beam.length * x, force=unit / beam.length * force, moment=unit * moment
    )
