"""Responses of the inextensible beam with mass-proportional damping, known by other codes too."""

import numpy as np
import pytest

from analytic import Beam, Damping, DistributedForce, SpeedRipple, Theory, forced_response


def response(c, omega, load, omega_n, at):
    beam = Beam.reference()
    scale = beam.frequency_scale
    damped = beam.with_damping(Damping(external=c * beam.mass_per_length * scale))
    frequencies = omega_n * scale * np.array(at)
    return forced_response(damped, omega, load, frequencies, theory=Theory(extension=False))


@pytest.fixture(scope="session")
def loaded(beam):
    """Case D1: a distributed force at 2 rad/s, hardening."""
    load = DistributedForce(amplitude=0.0045 * beam.bending_stiffness / beam.length**3)
    return response(0.004, 2.0, load, 3.66791071, [0.985, 1.0015, 1.015])


@pytest.fixture(scope="session")
def rippled(beam):
    """Case D3: a ripple of the speed at 6 rad/s, softening."""
    load = SpeedRipple(amplitude=0.003 * beam.frequency_scale)
    return response(0.008, 6.0, load, 4.50886824, [0.985, 0.997, 1.015])
