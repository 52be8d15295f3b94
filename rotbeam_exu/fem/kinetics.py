"""What the mass of a chain makes of its velocities: kinetic energy and angular momentum."""

from __future__ import annotations

import numpy as np

from analytic.arrays import FloatArray

from .elements.formulation import radial, spun
from .elements.point_masses import spins
from .rotating_beam import RotatingBeam


def energy_and_momentum(
    built: RotatingBeam,
    coordinates: FloatArray,
    velocities: FloatArray,
    rate: FloatArray,
    setting: float,
) -> tuple[FloatArray, FloatArray]:
    """Return the kinetic energy T and the angular momentum L_z = ∂T/∂w about the axis, (samples,).

    The velocity in the plane of bending has a rotation by c w in it; normal to the plane a point
    moves by s w times its distance x along the clamp's line, with c = cos ψ and s = sin ψ.

    Parameters
    ----------
    built : RotatingBeam
    coordinates : ndarray (samples, nodes, n)
        In the frame of the clamp, reference included.
    velocities : ndarray (samples, nodes, n)
        Absolute, in the plane of bending, by the axes of that frame.
    rate : ndarray (samples,)
        w.
    setting : float
        c.
    """
    samples = rate.size
    v = velocities.reshape(samples, -1)
    turning = spun(built.model, coordinates).reshape(samples, -1)
    along = (coordinates * radial(built.model)).reshape(samples, -1)
    momentum = v @ built.mass
    about_normal = np.sum(turning * momentum, axis=1)
    twice = np.sum(v * momentum, axis=1)
    for inertia, spin in spins(built.chain.turning, coordinates, velocities):
        about_normal += inertia * spin
        twice += inertia * spin**2
    normal = (1.0 - setting**2) * rate * np.sum(along * (along @ built.mass), axis=1)
    return 0.5 * (twice + rate * normal), setting * about_normal + normal
