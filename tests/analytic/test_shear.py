"""The exact beam with shear: Reissner's statics and limits."""

from functools import partial

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from analytic import Theory, periodic_orbits
from analytic.exact.beam.state import Driven
from analytic.exact.beam.steady import SteadyBeam, continuum
from tests.beams import SHARE, unit_beam

MU = 1e-3
STUBBY = unit_beam(MU)
"""EI = m = L = 1: shear takes 0.7 % off its first frequency."""


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
    finer = SteadyBeam(model, 0.0).refined().model
    assert (finer.bending, finer.axial, finer.shear) == (9, 6, 6)
    q = 0.2 * np.random.default_rng(2).normal(size=model.size)
    x = np.linspace(0.0, 1.0, 7)
    assert finer.slope(model.padded(q, finer), x) == pytest.approx(model.slope(q, x), abs=1e-14)


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
