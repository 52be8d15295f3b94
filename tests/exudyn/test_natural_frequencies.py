"""Frequencies of the cable mesh about its rotating equilibrium."""

import numpy as np
import pytest

from rotbeam_exu import natural_frequencies
from rotbeam_exu.fem.linearization import Linearization


def test_cantilever_at_rest(beam):
    found = natural_frequencies(beam, 0.0, elements=64) / beam.frequency_scale
    # Six printed digits; 64 elements are within 2e-7 of the exact third frequency.
    assert found == pytest.approx([3.516015, 22.034492, 61.697214], rel=3e-7)


@pytest.mark.parametrize(
    ("omega", "exact"), [(2.0, 3.034885), (4.0, 3.345616), (6.0, 3.730401), (8.0, 4.123895)]
)
def test_steady_rotation_converges_to_the_continuum(beam, omega, exact):
    # Asked: 1e-6 relative. The mesh error at 64 elements is below 2e-7, the print's rounding too.
    assert natural_frequencies(beam, omega, elements=64)[0] == pytest.approx(exact, rel=1e-6)


@pytest.mark.parametrize(
    ("omega", "leading"),
    [(2.0, 2.73958e-5), (4.0, 1.095831e-4), (6.0, 2.465620e-4), (8.0, 4.383324e-4)],
)
def test_stretch_of_the_paper_beam(beam, omega, leading):
    """Eq. 67 is the leading order; the whole stretch is tan(kL)/k - L, k = ω √(ρ/E)."""
    k = omega * np.sqrt(beam.density / beam.youngs_modulus)
    exact = np.tan(k * beam.length) / k - beam.length
    found = Linearization.of(beam, omega).stretch
    # Round-off: 8 m in double precision over 27 µm leaves about 1e-10.
    assert found == pytest.approx(exact, rel=1e-8)
    # Leading order falls short by (2/5)(kL)², and is printed to six digits.
    assert found == pytest.approx(leading * (1.0 + 0.4 * (k * beam.length) ** 2), rel=4e-6)
