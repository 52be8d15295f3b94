"""The fifth order: κ and the tip's harmonics, against another code's numbers and exact orbits."""

import math

import numpy as np
import pytest

from analytic import Theory, Variant, periodic_orbits, reduced_model
from analytic.reduced.any_blade import blade_oscillator, normal_mode, product, turn


def test_series_of_a_product_and_of_a_turn():
    # (1 + ε)² and exp(iε), by their coefficients.
    one_plus = np.array([1.0, 1.0, 0.0, 0.0])
    assert product(one_plus, one_plus).tolist() == [1.0, 2.0, 1.0, 0.0]
    angle = np.array([0.0, 1.0, 0.0, 0.0])
    np.testing.assert_allclose(turn(angle), [1j**k / math.factorial(k) for k in range(4)])


@pytest.mark.parametrize(
    ("omega", "of_peak", "of_first"),
    # By a code that shares nothing with this one; four digits are given.
    [
        (0.0, -0.0064, -0.0046),
        (2.0, -0.0032, -0.0023),
        (4.0, 0.0028, 0.0019),
        (6.0, 0.0072, 0.0050),
        (8.0, 0.0091, 0.0065),
    ],
)
def test_kappa(beam, omega, of_peak, of_first):
    model = reduced_model(beam, omega, "FrM5")
    assert model.kappa_of_peak == pytest.approx(of_peak, abs=5e-5)
    assert model.kappa == pytest.approx(of_first, abs=5e-5)


@pytest.mark.parametrize(
    ("hub", "tip_mass", "setting", "w_bar"),
    [(0.0, 0.0, 1.0, 0.0), (0.5, 0.0, 1.0, 2.0), (1.0, 0.5, 1.0, 2.0), (0.0, 0.0, 0.0, 2.0)],
)
def test_lambda_is_that_of_the_closed_formula(beam, hub, tip_mass, setting, w_bar):
    blade = beam.with_hub_radius(hub * beam.length).with_setting_angle(math.acos(setting))
    if tip_mass:
        blade = blade.with_tip_mass(tip_mass * beam.mass)
    mode, oscillator = normal_mode(blade.unit, w_bar), blade_oscillator(blade.unit, w_bar, True)
    # Another derivation of the same number, to round-off.
    assert mode.lambda_omega == pytest.approx(oscillator.oscillator.lambda_omega, abs=1e-12)
    assert mode.w_n == pytest.approx(oscillator.oscillator.w_n, rel=1e-12)


@pytest.mark.parametrize("setting", [0.0, 0.7])
def test_the_error_of_the_shift_falls_with_the_next_power(beam, setting):
    blade = beam.with_hub_radius(0.1 * beam.length).with_setting_angle(setting)
    a = np.array([0.1, 0.2])
    model = reduced_model(blade, 4.0, "FrM5")
    exact = periodic_orbits(blade, 4.0, a, theory=Theory(extension=False))
    peak, first = exact.amplitude, exact.first_harmonic
    for kappa, at in ((model.kappa_of_peak, peak), (model.kappa, first)):
        error = 1.0 - model.lambda_omega * at**2 - kappa * at**4 - exact.frequency / exact.omega_n
        # a⁶ is left: 64 for the doubled amplitude, 16 were κ wrong.
        assert 50.0 < error[1] / error[0] < 75.0
    np.testing.assert_allclose(
        model.frequency(first), model.omega_n * (1 - model.lambda_omega * first**2
                                                 - model.kappa * first**4), rtol=1e-14)  # fmt: skip


@pytest.mark.parametrize(
    ("omega", "h3"), [(0.0, 0.0487), (2.0, 0.0505), (4.0, 0.0540), (6.0, 0.0560), (8.0, 0.0559)]
)
def test_the_tip_has_the_other_modes_harmonics(beam, omega, h3):
    for name in ("FrM", "FrM5"):
        model = reduced_model(beam, omega, name)
        # Of the exact beam as a → 0, by another code, to the digits that it gives.
        assert model.lambda_x == pytest.approx(h3, abs=6e-5)
    exact = periodic_orbits(beam, omega, [0.05, 0.1], theory=Theory(extension=False))
    # To a → 0 by extrapolation in a²; a⁴ is left.
    second, third = (
        np.array([4.0 / 3.0, -1.0 / 3.0])
        @ (exact.harmonics[:, k] / exact.first_harmonic ** (k + 1))
        for k in (1, 2)
    )
    assert model.perturbation.h2 == pytest.approx(second, abs=3e-6)
    assert model.lambda_x == pytest.approx(third, abs=3e-6)


def test_the_response_is_the_exact_tip_to_fourth_order(beam):
    model, a = reduced_model(beam, 6.0, "FrM5"), np.array([0.1, 0.2])
    exact = periodic_orbits(beam, 6.0, a, theory=Theory(extension=False))
    misses = []
    for i, first in enumerate(exact.first_harmonic):
        # Both from where the first harmonic has its crest, at phase ψ = 0.
        psi = np.linspace(0.0, 2.0 * np.pi, 50)
        found = model.response(psi / model.frequency(first), first)
        misses.append(np.abs(found - exact.response(psi / exact.frequency[i], i, np.pi / 2)).max())
    # With the other modes' share left out of h2 or h3, 4 and 8 for the doubled amplitude.
    assert misses[1] / misses[0] > 14.0
    assert misses[1] < 2e-4


def test_peak_and_first_harmonic_are_each_others_inverse(beam):
    exact = periodic_orbits(beam, 6.0, [0.1, 0.2, 0.4], theory=Theory(extension=False))
    model = reduced_model(beam, 6.0, "FrM")
    peaks = model.perturbation.peak(model.first_harmonic(exact.amplitude))
    np.testing.assert_allclose(peaks, exact.amplitude)
    # Fifth order is left.
    error = np.abs(model.first_harmonic(exact.amplitude) - exact.first_harmonic)
    assert (error < 0.04 * exact.amplitude**5).all()
    psi = model.perturbation.peak_phase(np.array([0.3]))
    assert model.perturbation.rate(psi, 0.3) == pytest.approx(0.0, abs=1e-12)
    # Of one mode it is Eq. 65's own, at ψ = 0.
    one = reduced_model(beam, 6.0, "FrE")
    assert one.perturbation.peak(np.array(0.2)) == pytest.approx(
        0.2 * (1 - one.lambda_x * 0.04), rel=1e-14
    )


def test_fifth_order_without_all_that_counts_is_refused():
    with pytest.raises(ValueError, match="take FrM5"):
        Variant(name="?", shape="rotating", axial="consistent", order=5)
    with pytest.raises(ValueError, match="order must be 3 or 5"):
        Variant(name="?", shape="rotating", axial="consistent", coriolis=True, order=4)
