"""Fast rotation: the layer at the clamp is resolved, or the answer refused."""

import numpy as np
import pytest
from scipy import linalg

from analytic import Beam, Theory, campbell, linear_modes, periodic_orbits
from tests.beams import deflection_matrices, unit_beam

pytestmark = [
    pytest.mark.filterwarnings(f"ignore:{text}:analytic.input_checks.RotbeamWarning")
    for text in (".*rpm", "internal resonance")
]


def deflection_frequencies(rate, count):
    """Inextensible modes by a Galerkin basis for v: nothing of the solver under test."""
    stiffness, mass = deflection_matrices(rate, count)
    return 1.0 / np.sqrt(linalg.eigh(mass, stiffness, eigvals_only=True)[:-4:-1])


@pytest.mark.parametrize("rate", [3.0, 12.0, 700.0])
def test_inextensible_modes_are_those_of_the_equation_in_the_deflection(rate):
    found = linear_modes(unit_beam(1e-10), rate, theory=Theory(extension=False)).frequencies
    # With twenty functions the fast one is off by a third in the first.
    expected = deflection_frequencies(rate, 14 if rate < 20.0 else 160)
    assert found[:3] == pytest.approx(expected, rel=1e-9 if rate < 20.0 else 1e-8)


def test_extensible_modes_have_settled():
    beam, rate = unit_beam(1e-10), 300.0
    found = linear_modes(beam, rate)
    finer = linear_modes(beam, rate, functions=2 * found.model.bending)
    assert found.frequencies == pytest.approx(finer.frequencies, rel=1e-9)
    # Softer than without extension by about μw̄² of the frequency.
    stiff = linear_modes(beam, rate, theory=Theory(extension=False)).frequencies[0]
    assert 1.0 - found.frequencies[0] / stiff == pytest.approx(1e-10 * rate**2, rel=0.05)


@pytest.mark.parametrize("count", [10, 20])
def test_high_modes_at_rest_have_settled(beam, count):
    found = linear_modes(beam, 0.0, count, theory=Theory(extension=False), functions=2 * count)
    # cos β cosh β = -1 has β = (k - ½)π to round-off.
    beta = (count - 0.5) * np.pi
    assert found.frequencies[-1] / beam.frequency_scale == pytest.approx(beta**2, rel=1e-9)


def test_a_crossing_is_found_in_any_unit_of_time():
    slow = campbell(unit_beam(1e-6), np.linspace(0.0, 8.0, 3), 1, 4).crossings
    beam = Beam.from_stiffness(
        length=1.0, axial_stiffness=1e6, bending_stiffness=1.0, mass_per_length=1e24
    )
    fast = campbell(beam, np.linspace(0.0, 8.0, 3) * 1e-12, 1, 4).crossings
    assert [c.omega * 1e12 for c in fast] == pytest.approx([c.omega for c in slow], rel=1e-9)


@pytest.mark.parametrize(
    ("slenderness", "omega", "amplitude"),
    [(1.758e-6, 36.257, 0.3), (1e-4, 14.5, 0.3), (1e-3, 12.1, 0.24), (1e-2, 12.0, 0.3)],
)
def test_functions_of_an_orbit_grow_as_it_needs_them(slenderness, omega, amplitude):
    found = periodic_orbits(unit_beam(slenderness), omega, [amplitude])
    finer = periodic_orbits(unit_beam(slenderness), omega, [amplitude], functions=36)
    assert found.residual.max() <= 1e-4
    # The square of the residual, 1e-8.
    ratio = found.frequency / found.omega_n
    assert ratio == pytest.approx(finer.frequency / finer.omega_n, rel=1e-8)
    assert found.lambda_omega == pytest.approx(finer.lambda_omega, abs=1e-6)


def test_very_fast_orbits():
    found = periodic_orbits(unit_beam(1e-10), 250.0, [0.1])
    linear = linear_modes(unit_beam(1e-10), 250.0, 1).frequencies[0]
    assert found.omega_n == pytest.approx(linear, rel=1e-8)
    # Extrapolated to a = 0 with 120 functions, at μ = 1e-8.
    assert found.lambda_omega == pytest.approx(0.0163, abs=1e-4)
