"""At the peak of a response, damping takes what the load gives, nearly on the free orbit.

By energies and momenta of states in space, which know nothing of the forced equations.
"""

import numpy as np
import pytest

from analytic import Beam, SpeedRipple, Theory, periodic_orbits

BEAM = Beam.reference()
X, WEIGHTS = np.polynomial.legendre.leggauss(40)
X, WEIGHTS = 0.5 * BEAM.length * (X + 1.0), 0.5 * BEAM.length * WEIGHTS
PHASE = 2.0 * np.pi * np.arange(64) / 64


def power(states, omega, nu, load, ripple=0.0):
    """Mean powers [W]: of damping along and across the blade over d, of the load, complex.

    The load's is real where it is as it acts; the size is what it is where it gives most.
    """
    at = [states(p) for p in PHASE]
    x, v, _ = np.array([s.place.T for s in at]).swapaxes(0, 1)
    u_dot, v_dot, _ = np.array([s.velocity.T for s in at]).swapaxes(0, 1)
    if isinstance(load, SpeedRipple):
        # -ẇ ∂L/∂w, the angular momentum about the axis.
        w = omega + ripple * np.cos(PHASE)[:, None]
        momentum = x * (v_dot + w * x) - v * (u_dot - w * v)
        moved = 1j * nu * BEAM.mass_per_length * (momentum @ WEIGHTS)
    else:
        moved = v_dot @ WEIGHTS
    along, across = ((rate**2 @ WEIGHTS).mean() for rate in (u_dot, v_dot))
    return along, across, load.amplitude * (moved * np.exp(-1j * PHASE)).mean()


@pytest.mark.parametrize("name", ["rippled", pytest.param("loaded", marks=pytest.mark.slow)])
def test_damping_takes_what_the_load_gives(name, request):
    response = request.getfixturevalue(name)
    omega, load, d = response.omega[0], response.load, response.blade.damping.external
    i = int(np.argmax(response.amplitude))
    ripple = load.amplitude if isinstance(load, SpeedRipple) else 0.0
    for point in (0, i // 2, i):
        along, across, given = power(
            lambda phase, point=point: response.state(point, X, phase=phase),
            omega, response.frequency[point], load, ripple,
        )  # fmt: skip
        assert given.real == pytest.approx(d * (along + across), rel=1e-4)
    # On the free orbit of the peak's amplitude as well, to the square of the damping.
    (peak,) = response.peaks
    free = periodic_orbits(BEAM, omega, [peak.amplitude], theory=Theory(extension=False))
    along, across, given = power(
        lambda phase: free.state(0, X, phase=phase), omega, free.frequency[0], load
    )
    assert abs(given) == pytest.approx(d * (along + across), rel=3e-4)
    # The foreshortening, which the leading order leaves out, takes percents of it.
    assert 0.03 < along / across < 0.07
