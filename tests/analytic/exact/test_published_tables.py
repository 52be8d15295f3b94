"""Frequencies of rotating blades as published, met to the rounding of the print."""

import math

import numpy as np
import pytest
from scipy.linalg import block_diag, eigh, eigvals

from analytic import Blade, Section, Theory, linear_modes
from analytic.quadrature import gauss_points
from tests.beams import UNIT, clamped_basis

FLAP = UNIT.with_setting_angle(0.5 * math.pi)
PRINTED = 5e-5 * (1.0 + 1e-3)
"""Half of the fourth decimal, the last that the tables print."""

# Wright, Smith, Thresher and Wang (1982), Hodges and Rutkowski (1981): w̄ = 0, 1 ... 12.
UNIFORM = [
    "3.5160 3.6816 4.1373 4.7973 5.5850 6.4495 7.3604 8.2996 9.2568 10.2257 11.2023 "
    "12.1843 13.1702",
    "22.0345 22.1810 22.6149 23.3203 24.2733 25.4461 26.8091 28.3341 29.9954 31.7705 33.6404 "
    "35.5890 37.6031",
    "61.6972 61.8418 62.2732 62.9850 63.9668 65.2050 66.6839 68.3860 70.2930 72.3867 74.6493 "
    "77.0638 79.6145",
]
# Hodges and Rutkowski (1981): m ~ 1 - x/2, EI ~ (1 - x/2)³.
TAPERED = [
    "3.8238 3.9866 4.4368 5.0927 5.8788 6.7434 7.6551 8.5956 9.5540 10.5239 11.5015 "
    "12.4845 13.4711",
    "18.3173 18.4740 18.9366 19.6839 20.6852 21.9053 23.3093 24.8647 26.5437 28.3227 30.1827 "
    "32.1085 34.0877",
    "47.2648 47.4173 47.8716 48.6190 49.6456 50.9338 52.4633 54.2124 56.1595 58.2833 60.5639 "
    "62.9829 65.5237",
]


@pytest.mark.parametrize(
    ("blade", "table"),
    [(FLAP, UNIFORM), (FLAP.with_taper(height=0.5), TAPERED)],
    ids=["uniform", "height taper"],
)
def test_flap_tables(blade, table):
    published = np.array([line.split() for line in table], dtype=float).T
    found = [
        linear_modes(blade, w, 3, theory=Theory(extension=False)).frequencies for w in range(13)
    ]
    assert np.abs(np.array(found) - published).max() <= PRINTED


def test_the_taper_of_wright_at_rest():
    """Mass falls to 0.2 of the root's, bending stiffness to 0.05."""
    section = Section(
        axial_stiffness=1e9, bending_stiffness=(1.0, -0.95), mass_per_length=(1.0, -0.8)
    )
    found = linear_modes(
        Blade(length=1.0, section=section), 0.0, 3, theory=Theory(extension=False)
    ).frequencies
    assert np.abs(found[:2] - [5.2738, 24.0041]).max() <= PRINTED
    # By shooting with Runge and Kutta's method, tolerance 1e-12.
    assert found == pytest.approx([5.2737588496, 24.0040874529, 59.9701465150], rel=1e-9)


SLENDERNESS = 4900.0  # A L²/I, the square of the tables' 70
CHORDWISE = Blade(
    length=1.0,
    section=Section(axial_stiffness=SLENDERNESS, bending_stiffness=1.0, mass_per_length=1.0),
)
SPEEDS = (2, 4, 6, 8, 10)


def unstretched_lag(w):
    """First lag frequency about the blade that rotation has not stretched, by Galerkin's method.

    s̈ - 2wv̇ - w²s = s''/μ, v̈ + 2wṡ - w²v = (Nv')' - v'''', N = w²(1 - x²)/2.
    """
    x, weights = gauss_points(72)
    v, k = clamped_basis(24, x), (np.arange(24) + 0.5) * math.pi
    s, s_slope = np.sin(np.outer(x, k)), k * np.cos(np.outer(x, k))
    tension = 0.5 * w**2 * (1.0 - x**2)
    M = block_diag(s.T @ (weights[:, None] * s), v.value.T @ (weights[:, None] * v.value))
    bent = v.curvature.T @ (weights[:, None] * v.curvature)
    bent += v.slope.T @ ((weights * tension)[:, None] * v.slope)
    K = block_diag(SLENDERNESS * s_slope.T @ (weights[:, None] * s_slope), bent) - w**2 * M
    coupled, none = 2.0 * w * s.T @ (weights[:, None] * v.value), np.zeros((24, 24))
    C, one = np.block([[none, -coupled], [coupled.T, none]]), np.eye(48)
    rates = eigvals(np.block([[-C, -K], [one, 0.0 * one]]), block_diag(M, one))
    return np.abs(rates.imag).min()


def test_chordwise_tables_are_of_the_unstretched_beam():
    """Yoo and Shin (1998), Chung and Yoo (2002)."""
    found = [unstretched_lag(w) for w in SPEEDS]
    # The print differs from the model by up to 3.4e-5, rounding included.
    assert found == pytest.approx([3.6195, 3.8880, 4.2393, 4.6105, 4.9700], abs=1e-4)
    true = [linear_modes(CHORDWISE, w, 1).frequencies[0] for w in SPEEDS]
    assert np.abs(np.subtract(true, [3.6186, 3.8844, 4.2316, 4.5970, 4.9487])).max() <= PRINTED


@pytest.mark.parametrize("w", [2.0, 10.0])
def test_stretch_enters_flap_by_the_tension_and_the_curvature(w):
    """N/(1+e) with the stretched levers for N, (v'/(1+e))' for v'', and nothing else."""
    x, weights = gauss_points(72)
    k = w / math.sqrt(SLENDERNESS)
    stretch, slope_of_it = np.cos(k * x) / math.cos(k), -k * np.sin(k * x) / math.cos(k)
    basis = clamped_basis(24, x)
    tension = SLENDERNESS * (stretch - 1.0) / stretch
    curvature = basis.curvature - basis.slope * (slope_of_it / stretch)[:, None]
    K = curvature.T @ ((weights / stretch**2)[:, None] * curvature)
    K += basis.slope.T @ ((weights * tension)[:, None] * basis.slope)
    M = basis.value.T @ (weights[:, None] * basis.value)
    first = math.sqrt(1.0 / eigh(M, K, eigvals_only=True)[-1])
    flap = CHORDWISE.with_setting_angle(0.5 * math.pi)
    assert linear_modes(flap, w, 1).frequencies[0] == pytest.approx(first, rel=1e-9)
