"""Frequencies of rotating blades as published, met to the rounding of the print."""

import math

import numpy as np
import pytest
from scipy.linalg import eigh

from analytic import Blade, Section, Theory, linear_modes
from analytic.exact.linear.unstretched import unstretched_frequencies
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


def test_chordwise_tables_are_of_the_unstretched_beam():
    """Yoo and Shin (1998), Chung and Yoo (2002)."""
    found = [unstretched_frequencies(CHORDWISE, w, 1)[0] for w in SPEEDS]
    # The print differs from the model by up to 3.4e-5, rounding included.
    assert found == pytest.approx([3.6195, 3.8880, 4.2393, 4.6105, 4.9700], abs=1e-4)
    true = [linear_modes(CHORDWISE, w, 1).frequencies[0] for w in SPEEDS]
    assert np.abs(np.subtract(true, [3.6186, 3.8844, 4.2316, 4.5970, 4.9487])).max() <= PRINTED


@pytest.mark.parametrize("w", [2.0, 10.0])
def test_what_the_unstretched_beam_lacks(w):
    """N/(1+e) with the stretched levers for N, (v'/(1+e))' for v'', and nothing else."""
    x, weights = gauss_points(72)
    k = w / math.sqrt(SLENDERNESS)
    stretch, slope_of_it = np.cos(k * x) / math.cos(k), -k * np.sin(k * x) / math.cos(k)
    basis = clamped_basis(24, x)

    def stiffness(stretched):
        tension, curvature = 0.5 * w**2 * (1.0 - x**2), basis.curvature
        if stretched:
            tension = SLENDERNESS * (stretch - 1.0) / stretch
            curvature = (curvature - basis.slope * (slope_of_it / stretch)[:, None]) / (
                stretch[:, None]
            )
        bent = curvature.T @ (weights[:, None] * curvature)
        return bent + basis.slope.T @ ((weights * tension)[:, None] * basis.slope)

    M = basis.value.T @ (weights[:, None] * basis.value)
    first, other = (
        math.sqrt(1.0 / eigh(M, stiffness(stretched), eigvals_only=True)[-1])
        for stretched in (True, False)
    )
    # Flap, which nothing but the tension and the curvature tells about the stretch.
    flap = CHORDWISE.with_setting_angle(0.5 * math.pi)
    assert linear_modes(flap, w, 1).frequencies[0] == pytest.approx(first, rel=1e-9)
    assert unstretched_frequencies(flap, w, 1)[0] == pytest.approx(other, rel=1e-9)


def test_without_stretch_it_is_the_truth():
    """Every hub, mass, taper, setting and rotary inertia of the exact blade is in it."""
    bent = [(x, (1.0 - 0.5 * x) ** 3) for x in np.linspace(0.0, 1.0, 5)]
    section = Section(axial_stiffness=(1e11, -4e10), bending_stiffness=bent,
                      mass_per_length=(1.0, -0.5), rotary_inertia=(0.01, -0.005))  # fmt: skip
    blade = Blade(length=1.0, section=section, hub_radius=0.5, setting_angle=0.0)
    blade = blade.with_tip_mass(0.3, 0.02)
    exact = linear_modes(blade, 3.0, 3).frequencies
    assert unstretched_frequencies(blade, 3.0) == pytest.approx(exact, rel=1e-8)
    set_at = CHORDWISE.with_setting_angle(0.7)
    still = linear_modes(set_at, 0.0, 5).frequencies
    assert unstretched_frequencies(set_at, 0.0, 5) == pytest.approx(still, rel=1e-9)
    slow = 1e-2  # what the stretch changes is of order μw̄²
    assert unstretched_frequencies(set_at, slow) == pytest.approx(
        linear_modes(set_at, slow).frequencies, rel=SLENDERNESS**-1 * slow**2
    )


def test_unstretched_frequencies_are_in_rad_per_second(beam):
    exact = linear_modes(beam, 6.0).frequencies
    assert unstretched_frequencies(beam, 6.0) == pytest.approx(exact, rel=5e-5)


@pytest.mark.parametrize(
    ("blade", "omega", "count", "sentence"),
    [
        (CHORDWISE, -1.0, 3, "omega must not be negative"),
        (CHORDWISE, 1.0, 129, "resolve 128 modes, .* ask for less"),
        (CHORDWISE, 110.0, 3, "leaves no steady state"),
    ],
)
@pytest.mark.filterwarnings("ignore:omega:analytic.input_checks.RotbeamWarning")
def test_what_unstretched_frequencies_refuse(blade, omega, count, sentence):
    with pytest.raises(ValueError, match=sentence):
        unstretched_frequencies(blade, omega, count)


@pytest.mark.filterwarnings("ignore:omega:analytic.input_checks.RotbeamWarning")
def test_unstretched_frequencies_that_do_not_settle(monkeypatch):
    monkeypatch.setattr("analytic.exact.linear.modes.MOST_FUNCTIONS", 60)
    said = "solutions differ by .* in the frequencies at .*; rotate slower"
    with pytest.raises(ValueError, match=said):
        unstretched_frequencies(UNIT, 4e3)
