"""The exact backbone as a series: against orbits it was not made from, and where it must end."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.polynomial import Chebyshev

from analytic import (
    AmplitudeNotReachedError,
    Theory,
    backbone_curve,
    periodic_orbits,
    reduced_model,
)
from analytic.exact.free import curve as curve_module
from analytic.exact.free.curve import _converging, _tail
from analytic.input_checks import RotbeamWarning

SPEEDS = (0.0, 4.0, 6.0, 8.0)
ALL = "ignore:internal resonance:analytic.input_checks.RotbeamWarning"


@pytest.fixture(scope="module")
def curves(beam):
    return {omega: backbone_curve(beam, omega) for omega in SPEEDS}


@pytest.mark.parametrize("omega", SPEEDS)
def test_orbits_it_was_not_made_from_lie_on_it(beam, curves, omega):
    curve, a = curves[omega], np.array([0.05, 0.13, 0.27, 0.4, 0.47, 0.58, 0.6])
    orbits = periodic_orbits(beam, omega, a)
    off = np.abs(curve.frequency(a) / orbits.frequency - 1.0)
    assert curve.holds_up_to == 0.6
    assert curve.error < 1e-8
    # What is asked of ten coefficients is 1e-8 up to 0.4 and 1e-6 at 0.6; its own estimate holds.
    assert (off < min(1e-8, curve.error)).all()
    first = np.abs(curve.first_harmonic(a) - orbits.first_harmonic) / a
    # Orbits of the series keep 2e-9 of it.
    assert (first < max(2.0 * curve.error, 3e-9)).all()
    assert curve.omega_n == pytest.approx(orbits.omega_n, rel=1e-12)


@pytest.mark.parametrize("omega", SPEEDS)
def test_its_slope_at_rest_is_the_perturbation_theory(beam, omega):
    curve = backbone_curve(beam, omega, up_to=0.4, theory=Theory(extension=False))
    model = reduced_model(beam, omega, "FrM5")
    # Derivatives at the end of a series lose the square and the fourth power of its length.
    assert curve.lambda_omega == pytest.approx(model.lambda_omega, abs=2e-8)
    assert curve.kappa == pytest.approx(model.kappa_of_peak, abs=1e-6)


def test_shape_of_the_answers(curves):
    curve = curves[6.0]
    grid = np.linspace(0.0, 0.6, 24).reshape(2, 3, 4)
    assert curve.frequency(grid).shape == curve.first_harmonic(grid).shape == grid.shape
    assert isinstance(curve.frequency(0.3), float)  # NumPy's is one
    assert isinstance(curve.first_harmonic(0.3), float)
    assert curve.frequency(0.0) == pytest.approx(curve.omega_n, rel=curve.error)
    assert curve.frequency([]).size == 0
    assert "up to a = 0.6" in str(curve)


@pytest.mark.filterwarnings(ALL)
def test_before_a_resonance_it_says_how_far_it_holds(beam):
    """Harmonic 6 meets mode 2 at a = 0.64, 2 rad/s, where the orbits have a fold."""
    with pytest.warns(RotbeamWarning, match=r"holds to 1e-08 up to a = .*harmonic 6 is .* lag 2"):
        curve = backbone_curve(beam, 2.0, up_to=0.7)
    assert 0.5 < curve.holds_up_to < 0.6375
    a = np.array([0.2, 0.4, curve.holds_up_to])
    off = np.abs(curve.frequency(a) / periodic_orbits(beam, 2.0, a).frequency - 1.0)
    assert (off < 1e-8).all()
    with pytest.raises(ValueError, match="holds for amplitudes from 0 up to 0.5"):
        curve.frequency(0.6)


def test_second_mode_and_a_blade(beam):
    a = np.array([0.012, 0.035])
    curve = backbone_curve(beam, 4.0, up_to=0.04, mode="lag 2")
    orbits = periodic_orbits(beam, 4.0, a, mode="lag 2")
    np.testing.assert_allclose(curve.frequency(a), orbits.frequency, rtol=1e-8)
    blade = beam.with_tip_mass(0.5 * beam.mass)
    orbits = periodic_orbits(blade, 3.0, a)
    found = backbone_curve(blade, 3.0, up_to=0.3).frequency(a)
    np.testing.assert_allclose(found, orbits.frequency, rtol=1e-8)


@pytest.mark.parametrize(
    ("options", "says"),
    [
        ({"up_to": 1.0}, "up_to must be below 1"),
        ({"up_to": -0.1}, "up_to must be positive"),
        ({"mode": 0}, "mode must be at least 1"),
    ],
)
def test_bad_input(beam, options, says):
    with pytest.raises(ValueError, match=says):
        backbone_curve(beam, 6.0, **options)


def test_amplitudes_beyond_it_are_refused(curves):
    with pytest.raises(ValueError, match="got 0.61"):
        curves[6.0].frequency([0.1, 0.61])
    with pytest.raises(ValueError, match=r"got -0\.1"):
        curves[6.0].first_harmonic(-0.1)
    with pytest.raises(ValueError, match="finite"):
        curves[6.0].frequency(np.nan)


def test_a_range_that_no_series_resolves_is_refused(beam, monkeypatch):
    monkeypatch.setattr(curve_module, "_TOLERANCE", 1e-16)
    monkeypatch.setattr(curve_module, "_COEFFICIENTS", 5)
    with pytest.raises(AmplitudeNotReachedError, match="even up to a = .*: take backbone"):
        backbone_curve(beam, 8.0)


def geometric(ratio, count=8):
    """The series Σ r^k T_k on [0, top²], of 0.5, whose tail is r^count/(1 - r)."""
    return Chebyshev(ratio ** np.arange(count), domain=[0.0, 0.25])


def test_the_tail_of_a_geometric_series_is_its_sum():
    assert _tail(geometric(0.3)) == pytest.approx(0.3**8 / 0.7)
    assert _tail(Chebyshev([1.0, 0.0, 0.0, 1e-9])) == 0.0
    # A series that does not fall has no sum: a tail of nine times its last coefficient.
    assert _tail(geometric(1.2)) == pytest.approx(9.0 * 1.2**7)


def test_a_shorter_range_has_the_error_that_was_asked_for(curves):
    """√(s² - s top²)/(s - a²): its last coefficient falls by the place of the pole, s, alone."""

    def fitted(top):
        places = 0.5 * top**2 * (1.0 - np.cos(np.pi * np.arange(10) / 9))
        size = np.sqrt(0.5 * (0.5 - top**2))
        series = Chebyshev.fit(places, size / (0.5 - places), 9, domain=[0.0, top**2])
        return replace(
            curves[0.0], series=series, first=series, error=_tail(series), holds_up_to=top
        )

    found = fitted(0.5)
    for wanted in (10.0, 100.0, 1e3):
        shorter = fitted(_converging(found, found.error / wanted))
        assert found.series.coef[-1] / shorter.series.coef[-1] == pytest.approx(wanted, rel=0.02)
    # Never by more than 30 % at once, nor by less than 3 %.
    assert _converging(found, 1e-30) == pytest.approx(0.35)
    assert _converging(found, found.error) == pytest.approx(0.485)
