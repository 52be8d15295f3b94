"""One amplitude that is not reached does not cost the others."""

import numpy as np
import pytest

from analytic import AmplitudeNotReachedError, periodic_orbits
from analytic.methods.continuation import Care


@pytest.mark.parametrize("amplitudes", [[0.04, 0.06], [0.02, 0.03], [0.02, 0.04], [0.04]])
def test_amplitudes_of_the_orbits_it_starts_from(beam, amplitudes):
    found = periodic_orbits(beam, 6.0, amplitudes)
    expected = 1.0 - found.lambda_omega * found.amplitude**2
    # The next term, κa⁴ with κ = 0.0072.
    assert found.frequency / found.omega_n == pytest.approx(expected, abs=1e-2 * 0.06**4)


def test_orbits_found_are_attached(beam, monkeypatch):
    monkeypatch.setattr("analytic.exact.free.path.THOROUGH", Care(harmonics=12))
    asked = [0.2, 0.6, 0.1]
    with pytest.raises(AmplitudeNotReachedError, match=r"of 0\.6 was found") as caught:
        periodic_orbits(beam, 6.0, asked)
    kept = caught.value.orbits
    whole = periodic_orbits(beam, 6.0, [0.2, 0.1])
    assert kept.amplitude.tolist() == [0.2, 0.1]
    np.testing.assert_array_equal(kept.frequency, whole.frequency)
    assert isinstance(caught.value, RuntimeError)
    with pytest.raises(AmplitudeNotReachedError) as caught:
        periodic_orbits(beam, 6.0, [0.6])
    assert caught.value.orbits is None


def test_an_orbit_lost_in_round_off_does_not_cost_the_larger(beam):
    with pytest.raises(AmplitudeNotReachedError, match="take linear_modes") as caught:
        periodic_orbits(beam, 6.0, [1e-14, 0.1])
    assert caught.value.orbits.amplitude.tolist() == [0.1]
