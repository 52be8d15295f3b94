"""Growth out of the plane of responses: the blade in space, the free orbit, and refusals."""

import math
from dataclasses import replace

import numpy as np
import pytest

from analytic import (
    Damping,
    Gravity,
    SpeedRipple,
    Theory,
    TipForce,
    forced_response,
)
from tests.beams import told, unit_beam

BEAM = unit_beam(1e-4)
DAMPING = Damping(bending=0.02, axial=0.02, external=0.2)
# Without inertia of the sections, of which L2 leaves parts out.
RIGID = told(BEAM, 0.0, 1.0 / 16.0, math.inf).with_damping(DAMPING)
THIN = Theory(trapeze=False)


@pytest.mark.parametrize(
    ("blade", "omega", "load", "frequencies"),
    [
        (RIGID, 2.0, TipForce(amplitude=0.5), [3.4, 3.5]),
        # Slower than the blade:
        pytest.param(RIGID, 2.0, TipForce(amplitude=1.0), [0.75, 0.8], marks=pytest.mark.slow),
        pytest.param(RIGID, 2.0, SpeedRipple(amplitude=0.2), [3.4, 3.5], marks=pytest.mark.slow),
        pytest.param(RIGID, [1.7, 1.8], Gravity(1.0), None, marks=pytest.mark.slow),
    ],
    ids=["rigid", "slow drive", "ripple", "gravity"],
)
def test_its_multipliers_and_those_in_the_plane_are_all_of_the_blade_in_space(
    blade, omega, load, frequencies
):
    """Harmonic balance and Floquet of the blade in space do not know the plane."""

    def first(found):
        parts = ("nondimensional", "frequency", "amplitude")
        return replace(found, **{name: getattr(found, name)[:1] for name in parts})

    planar = first(forced_response(blade, omega, load, frequencies, theory=THIN, functions=12))
    hardly = blade.with_twist(1e-13)
    space = first(forced_response(hardly, omega, load, frequencies, theory=THIN, functions=24))
    assert space.amplitude[0] == pytest.approx(planar.amplitude[0], rel=1e-9)
    ours = np.append(planar.out_of_plane(confirm=False).multipliers[0], planar.multipliers[0])
    known = space.multipliers[0]
    apart = np.abs(known[:, None] - ours).min(axis=1)
    assert (apart / np.maximum(1.0, np.abs(known))).max() < 1e-8


@pytest.mark.parametrize(
    ("ask", "sentence"),
    [
        (lambda found: found.out_of_plane(damping=-0.1), "not be negative"),
        (
            lambda found: replace(found, theory=Theory(shear=0.3)).out_of_plane(),
            "take a theory without shear",
        ),
        (
            lambda found: replace(found, blade=BEAM).out_of_plane(),
            "is unknown: give its section by",
        ),
    ],
)
def test_bad_input_is_one_sentence(ask, sentence):
    found = forced_response(RIGID, 2.0, TipForce(amplitude=1e-3), [3.4, 3.5], functions=8)
    with pytest.raises(ValueError, match=sentence):
        ask(found)
