"""Derivatives of reduced models: laws of similarity to 1e-9, and the exact orbits."""

import numpy as np
import pytest

from analytic import Beam, periodic_orbits, reduced_model
from analytic.sensitivity import sensitivity


@pytest.mark.parametrize("variant", ["FrE", "FrM", "FrM5"])
def test_similarity(variant):
    """ω_n goes with √(EI/m), as the speed at the same w̄ does; λ and κ are numbers of w̄."""
    found = sensitivity(reduced_model(Beam.reference(), 3.0, variant))
    of = dict(zip(found.names, found.derivatives.T, strict=True))
    frequency, *numbers = 2.0 * (of["EA"] + of["EI3"]) + 3.0 * of["omega"]
    assert frequency == pytest.approx(found.values[0], rel=1e-9)
    np.testing.assert_allclose(numbers, 0.0, atol=1e-9)
    np.testing.assert_allclose(of["m"], -of["EA"] - of["EI3"], atol=1e-9 * found.values[0])


def test_the_hub():
    """As the softening of small orbits has it, and differences of closed forms."""
    beam, change = Beam.reference(), 0.01
    model = reduced_model(beam, 6.0, "FrM")
    found = sensitivity(model, ["hub_radius"])
    assert found.theory == model.theory
    steps = [
        reduced_model(beam.with_hub_radius(change * k), 6.0, "FrM").lambda_omega for k in range(5)
    ]
    slope = np.array([-25.0, 48.0, -36.0, 16.0, -3.0]) @ steps / (12.0 * change)
    assert found.of("lambda_omega", "hub_radius") == pytest.approx(slope, rel=1e-7)
    small = sensitivity(periodic_orbits(beam, 6.0, [0.1]), ["hub_radius"])
    assert found.of("lambda_omega", "hub_radius") == pytest.approx(
        small.of("softening at a = 0.1", "hub_radius"), rel=1e-2
    )
    assert found.of("omega_n", "hub_radius") == pytest.approx(
        small.of("frequency at a = 0.1", "hub_radius"), rel=3e-3
    )


def test_the_papers_models_know_three_numbers():
    """With a hub a beam is none of theirs."""
    found = sensitivity(reduced_model(Beam.reference(), 6.0, "P3"))
    assert found.names == ("EA", "EI3", "m", "omega")
    assert np.isfinite(found.derivatives).all()
    with pytest.raises(ValueError, match="no parameter 'hub_radius'; it has EA, EI3, m, omega"):
        sensitivity(reduced_model(Beam.reference(), 6.0, "FrE"), ["hub_radius"])
