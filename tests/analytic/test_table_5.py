"""Sec. 5 and Table 5: the rotating mode by Frobenius' method, and FrE."""

import numpy as np
import pytest
from numpy.polynomial import Polynomial
from scipy.optimize import brentq

from analytic import paper_table
from analytic.blade_functions import blade_functions
from analytic.reduced.shapes import (
    converged_degree,
    frequency_equation,
    rotating_frequency,
    rotating_mode,
)
from analytic.unit_blade import UNIFORM


def test_print_within_the_rounding_of_its_constants():
    """The print's β = 1.8751 is 2.2e-6 off, (1.8751)² 4.4e-6: times 4 rad/s, and one last digit."""
    bound = {"ω_n": 1.75e-5, "λ_ω": 2.8e-6, "λ_x": 1e-6}
    rows = paper_table(5).rows
    assert [row.note for row in rows].count("") == 2  # of 12
    for row in rows:
        assert abs(float(row.derived) - float(row.printed)) <= bound[row.quantity.split()[0]]


@pytest.mark.parametrize("w_bar", [0.0, 2.0, 10.0, 20.0, 30.0])
def test_power_series_and_legendre_basis_agree(w_bar):
    # Cancellation between the two series grows like exp(w̄/√2) ulps.
    tolerance = 1e-12 + 4e-16 * np.exp(w_bar / np.sqrt(2))
    expected = blade_functions(UNIFORM, 24).first_mode(w_bar).w_n
    assert rotating_mode(w_bar).w_n == pytest.approx(expected, rel=tolerance)


@pytest.mark.parametrize("w_bar", [0.0, 3.0, 9.67])
def test_mode_solves_the_differential_equation(w_bar):
    mode = rotating_mode(w_bar)
    v, x = Polynomial(mode.coefficients), Polynomial([0.0, 1.0])
    tension = 0.5 * w_bar**2 * (1 - x**2)
    residual = v.deriv(4) - (tension * v.deriv()).deriv() - (w_bar**2 + mode.w_n**2) * v
    points = np.linspace(0.0, 1.0, 21)
    # Fourth derivatives of a degree 60 series, against terms of order w̄² · 10.
    assert np.abs(residual(points)).max() < 1e-8 * (10.0 + w_bar**4)
    assert v(0.0) == v.deriv()(0.0) == 0.0
    assert v(1.0) == pytest.approx(1.0, abs=1e-13)
    assert v.deriv(2)(1.0) == pytest.approx(0.0, abs=1e-10)
    assert v.deriv(3)(1.0) == pytest.approx(0.0, abs=1e-8)


def test_degree_36_has_not_converged_at_8_rad_per_s(beam):
    scale = beam.frequency_scale
    w_bar = 8.0 / scale
    converged = rotating_mode(w_bar)
    assert rotating_frequency(w_bar, 36) * scale == pytest.approx(4.124777, abs=5e-7)
    assert converged.w_n * scale == pytest.approx(4.124564, abs=5e-7)
    assert converged.degree > 50
    again = rotating_frequency(w_bar, 2 * converged.degree)
    assert converged.w_n == pytest.approx(again, rel=1e-12)


def test_degree_grows_with_speed():
    degrees = [converged_degree(w_bar) for w_bar in (0.0, 2.0, 5.0, 10.0, 20.0, 30.0)]
    assert degrees == sorted(set(degrees))


def test_equation_81_as_printed_is_wrong(beam, monkeypatch):
    """With the printed numerator the frequency at 2 rad/s is 5.140 rad/s instead of 3.035."""

    def as_printed(r, w_bar, w_n, degree):
        a = np.zeros(degree + 1)
        a[r] = 1.0
        for k in range(r + 2, degree + 1):
            a[k] = 0.5 * w_bar**2 * a[k - 2] / (k * (k - 1))
            if k >= r + 4:
                numerator = w_bar**2 * (k - 3) * (k - 4) - w_n**2
                a[k] -= 0.5 * numerator * a[k - 4] / (k * (k - 1) * (k - 2) * (k - 3))
        return a

    monkeypatch.setattr("analytic.reduced.shapes.frobenius_series", as_printed)
    w_bar = 2.0 / beam.frequency_scale
    w_n = brentq(lambda w: frequency_equation(w_bar, w, 40), 5.0, 8.0)
    assert w_n * beam.frequency_scale == pytest.approx(5.140, abs=5e-4)


def test_speed_beyond_the_series():
    with pytest.raises(ValueError, match=r"up to w_bar = .* = 30, got 31"):
        rotating_mode(31.0)
