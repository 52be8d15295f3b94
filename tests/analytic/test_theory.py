"""The theory of the beam: extension, shear, rotary inertia; Reissner's statics and limits."""

from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from analytic import Section, SpinUp, Theory, linear_modes, periodic_orbits, spin_up_response
from analytic.exact.continuum.planar_rotation import SteadyBeam, continuum
from analytic.exact.continuum.state import Driven
from analytic.theory import BERNOULLI_EULER
from tests.beams import SHARE, unit_beam

SHEARED = Theory(rotary_inertia=True, shear=SHARE)
STUBBY = unit_beam(1e-3)


def first_frequency(blade, theory):
    return linear_modes(blade, 3.0, 1, theory=theory).frequencies[0]


def test_a_taper_has_the_inertia_of_its_own_sections():
    blade = STUBBY.with_taper(0.2, 0.4)
    own = replace(
        blade.section, rotary_inertia=tuple(np.multiply(1e-3, blade.section.bending_stiffness))
    )
    heavy = first_frequency(blade, Theory(rotary_inertia=True))
    assert heavy == pytest.approx(
        first_frequency(blade.with_section(own), BERNOULLI_EULER), rel=1e-12
    )
    assert heavy < first_frequency(blade, BERNOULLI_EULER)


def test_inertia_that_the_section_says_stays():
    said = Section(
        axial_stiffness=1e3, bending_stiffness=1.0, mass_per_length=1.0, rotary_inertia=0.1
    )
    blade = STUBBY.with_section(said)
    heavy = first_frequency(blade, Theory(rotary_inertia=True))
    assert heavy == first_frequency(blade, BERNOULLI_EULER)


def test_a_section_without_one_density_is_refused():
    section = replace(STUBBY.section, mass_per_length=(1.0, -0.5))
    blade = STUBBY.with_section(section)
    with pytest.raises(ValueError, match="give Section\\(rotary_inertia"):
        first_frequency(blade, SHEARED)
    remedied = blade.with_section(replace(section, rotary_inertia=(1e-3, -5e-4)))
    assert first_frequency(remedied, SHEARED) > 0.0


def test_the_spin_up_without_extension_is_the_limit_of_slender_beams():
    """The axial motion leaves q by the slenderness μ, to first order."""
    spin_up, times = SpinUp(omega=2.0, ramp_time=1.0), np.linspace(0.0, 2.0, 21)
    limit = spin_up_response(
        STUBBY, spin_up, times, tolerance=1e-6, theory=Theory(extension=False)
    ).q
    apart = [
        np.abs(spin_up_response(beam, spin_up, times, tolerance=1e-6).q - limit).max()
        for beam in (unit_beam(1e-3), unit_beam(1e-4))
    ]
    assert 8.0 < apart[0] / apart[1] < 12.0


MU = 1e-3


def bent_at_rest(force):
    """Return the tip z(1) under a dead force across, on the discretized beam."""
    model = continuum(MU, 16, 10, shear=SHARE)
    q, zero = np.zeros((1, model.size)), np.zeros((1, model.size))
    for part in np.minimum(np.arange(1, 20) / 10, 1.0):
        push = 1j * part * force * model.outboard["tip"][None]
        at = model.tangent(q, zero, zero, Driven(0.0, push=push))
        q = q - np.linalg.solve(at.stiffness[0], at.residual[0])
    assert np.abs(at.residual).max() < 1e-12
    return model.tip(q)[0]


def reissners_cantilever(force):
    """Return the tip under a dead force across, by shooting with the moment at the clamp.

    θ' = M, M' = -x' F, and z' = (1 + μ F sin θ + i (μ/σ) F cos θ) exp(iθ): the force of the section
    is F turned into its axes, and the moment changes by the arm.
    """

    def slopes(_, state):
        theta, moment = state[:2]
        along, across = force * np.sin(theta), force * np.cos(theta)
        slope = (1.0 + MU * along + 1j * MU / SHARE * across) * np.exp(1j * theta)
        return [moment, -slope.real * force, slope.real, slope.imag]

    solved = partial(solve_ivp, slopes, (0.0, 1.0), method="DOP853", rtol=1e-12, atol=1e-13)
    clamp = brentq(lambda m: solved([0.0, m, 0.0, 0.0]).y[1, -1], 0.0, 1.2 * force, xtol=1e-13)
    tip = solved([0.0, clamp, 0.0, 0.0]).y[2:, -1]
    return complex(*tip)


def test_a_small_force_bends_and_shears_the_cantilever():
    """F L³/(3 EI) + F L/(k_s GA): 0.9 % are shear."""
    small = 1e-6
    assert bent_at_rest(small).imag / small == pytest.approx(1.0 / 3.0 + MU / SHARE, rel=1e-9)


@pytest.mark.parametrize("force", [1.0, 8.0])
def test_a_large_force_bends_it_as_reissner_says(force):
    assert bent_at_rest(force) == pytest.approx(reissners_cantilever(force), abs=1e-10)


def test_shear_vanishes_with_its_compliance(fitted_order):
    """To first order, and what is left is the beam without shear."""
    shares = np.array([1e1, 1e2, 1e3])
    orbits = partial(periodic_orbits, STUBBY, 3.0, [0.3])
    rigid = orbits()
    drops = [rigid.frequency[0] - orbits(theory=Theory(shear=s)).frequency[0] for s in shares]
    # The frequency falls; the second order in the compliance is a thousandth of the first.
    assert min(drops) > 0.0
    assert fitted_order(shares, drops) == pytest.approx(-1.0, abs=0.01)


def test_more_functions_hold_the_same_shape():
    model = continuum(MU, 6, 4, shear=SHARE)
    steady = SteadyBeam(model, 0.0)
    finer = steady.refined().model
    assert (finer.bending, finer.axial, finer.shear) == (9, 6, 6)
    q = 0.2 * np.random.default_rng(2).normal(size=model.size)
    x = np.linspace(0.0, 1.0, 7)
    lifted = steady.lifted(q, steady.refined())
    assert finer.slope(lifted, x) == pytest.approx(model.slope(q, x), abs=1e-14)


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        ({"shear": 0.0}, "shear must be positive"),
        ({"shear": float("inf")}, "shear"),
        ({"shear": 0.3, "extension": False}, "leave shear out, or extension"),
    ],
)
def test_bad_input(options, sentence):
    with pytest.raises(ValueError, match=sentence):
        Theory(**options)
