"""The beam with shear in steady rotation: its limits, and the classical one at rest."""

from pathlib import Path

import numpy as np
import pytest
from numpy.polynomial import Polynomial, legendre
from scipy.linalg import block_diag, expm
from scipy.optimize import brentq

from analytic import Beam, Theory, linear_modes
from analytic.exact.continuum.planar_rotation import blade_continuum
from analytic.exact.continuum.state import Driven
from tests.beams import SHARE, unit_beam

STUBBY = unit_beam(1e-3)
"""EI = m = L = 1 and μ = 1e-3: shear takes percents off its second and third frequency."""


def sheared(beam, omega, count=3, *, share=SHARE, rotary_inertia=True, law="Reissner"):
    """Return the frequencies of the beam with shear."""
    theory = Theory(shear=share, rotary_inertia=rotary_inertia, engesser=law == "Engesser")
    return linear_modes(beam, omega, count, theory=theory).frequencies


def at_rest(beam, share, low, high):
    """Return the frequency between two of Timoshenko's cantilever, by its transfer matrix.

    Of (v, φ, M, Q): v' = φ + Q/(k_s GA), φ' = M/EI, M' = -Q - ρI Ω² φ, Q' = -ρA Ω² v.
    """
    rigidity = share * beam.axial_stiffness
    density, EI = beam.mass_per_length, beam.bending_stiffness

    def at_the_tip(frequency):
        change = np.zeros((4, 4))
        change[0, 1], change[0, 3], change[1, 2] = 1.0, 1.0 / rigidity, 1.0 / EI
        change[2, 1], change[2, 3] = -beam.density * beam.second_moment * frequency**2, -1.0
        change[3, 0] = -density * frequency**2
        return np.linalg.det(expm(beam.length * change)[2:, 2:])

    return brentq(at_the_tip, low, high, xtol=1e-12)


def test_at_rest_it_is_timoshenkos_cantilever():
    found = sheared(STUBBY, 0.0, 2)
    assert found[0] < 0.995 * linear_modes(STUBBY, 0.0, 1).frequencies[0]
    assert found[0] == pytest.approx(at_rest(STUBBY, SHARE, 3.0, 3.6), rel=1e-9)
    assert found[1] == pytest.approx(at_rest(STUBBY, SHARE, 18.0, 22.1), rel=1e-9)


@pytest.mark.parametrize("rotary_inertia", [False, True])
@pytest.mark.parametrize("w_bar", [0.0, 3.0, 10.0])
def test_stiff_in_shear_it_is_the_exact_beam(w_bar, rotary_inertia):
    """What is left of shear at a share of 1e10 is 1e-13."""
    found = sheared(STUBBY, w_bar, share=1e10, rotary_inertia=rotary_inertia)
    exact = linear_modes(STUBBY, w_bar, theory=Theory(rotary_inertia=rotary_inertia)).frequencies
    assert found == pytest.approx(exact, rel=1e-9)


def by_powers(beam, w_bar, law="Reissner", rotary=1.0, count=14):
    """The frequencies with the tension by either law, by Galerkin's method of its own.

    v, φ and u are x times Legendre's polynomials; 14 of each are as good as 16 to 2e-11.
    """
    x, dx = (part / 2.0 for part in legendre.leggauss(2 * count + 8))
    x += 0.5
    powers = Polynomial([0.0, 1.0])
    shapes = [
        powers * legendre.Legendre.basis(k, domain=[0.0, 1.0]).convert(kind=Polynomial)
        for k in range(count)
    ]
    value = np.stack([shape(x) for shape in shapes], axis=1)
    slope = np.stack([shape.deriv()(x) for shape in shapes], axis=1)

    def product(left, right, weight=1.0):
        return left.T @ ((dx * weight)[:, None] * right)

    mu = beam.slenderness
    k = np.sqrt(mu) * w_bar
    stretch = np.cos(k * x) / np.cos(k)
    tension, shear = (stretch - 1.0) / mu, SHARE / mu
    none, mass = np.zeros((count, count)), product(value, value)
    across = shear * product(slope, slope) - w_bar**2 * mass
    mixed = -shear * product(slope, value, stretch)
    turning = shear * product(value, value, stretch**2) + product(slope, slope)
    if law == "Reissner":
        mixed += product(slope, value, tension)
        turning -= product(value, value, tension * stretch)
    else:
        across += product(slope, slope, tension / stretch)
    K = np.block([
        [across, mixed, none],
        [mixed.T, turning, none],
        [none, none, product(slope, slope) / mu - w_bar**2 * mass],
    ])  # fmt: skip
    M = block_diag(mass, rotary * mu * mass, mass)
    coriolis = 2.0 * w_bar * np.block([[none, none, mass], [none, none, none], [-mass, none, none]])
    none = np.zeros_like(K)
    # Of the reciprocal problem: without rotary inertia M is singular, and the low digits stay.
    dynamic = np.block([[none, np.eye(3 * count)], [-K, -coriolis]])
    found = np.linalg.eigvals(np.linalg.solve(dynamic, block_diag(np.eye(3 * count), M))).imag
    return 1.0 / np.sort(found[found > 0.0])[::-1]


@pytest.mark.parametrize("law", ["Reissner", "Engesser"])
@pytest.mark.parametrize("rotary_inertia", [False, True])
@pytest.mark.parametrize(
    ("beam", "omega"),
    [
        (STUBBY, 0.0),
        (STUBBY, 3.0),
        (STUBBY, 10.0),
        (Beam.reference(), 0.0),
        (Beam.reference(), 8.0),
    ],
)
def test_another_formulation_has_the_same_frequencies(beam, omega, rotary_inertia, law):
    """In deflection, angle and stretch, about the stretched state."""
    found = sheared(beam, omega, rotary_inertia=rotary_inertia, law=law) / beam.frequency_scale
    w_bar = omega / beam.frequency_scale
    assert found == pytest.approx(by_powers(beam, w_bar, law, rotary_inertia)[:3], rel=1e-10)


def test_engessers_forces_are_the_slope_of_its_energy():
    """At large strains and angles, where the energy is not quadratic, and once more its tangent."""
    theory = Theory(shear=SHARE, engesser=True)
    model = blade_continuum(unit_beam(0.02), theory, 6, 4)
    rng = np.random.default_rng(3)
    q, still = 0.5 * rng.standard_normal((1, model.size)), np.zeros((1, model.size))
    ends = [q + sign * 1e-5 * np.eye(model.size) for sign in (1.0, -1.0)]
    at_rest = np.zeros_like(ends[0])
    energies = [model.amended_potential(end, 2.0) for end in ends]
    forces = [model.residual(end, at_rest, at_rest, Driven(2.0)) for end in ends]
    tangent = model.tangent(q, still, still, Driven(2.0))
    # Central differences of round-off 1e-11 over the step.
    assert (energies[0] - energies[1]) / 2e-5 == pytest.approx(tangent.residual[0], abs=1e-8)
    slopes = (forces[0] - forces[1]) / 2e-5
    np.testing.assert_allclose(slopes.T, tangent.stiffness[0], atol=1e-8)


@pytest.mark.parametrize(("ratio", "higher"), [(8.0, 1.7e-3), (20.0, 4.5e-5)])
def test_engessers_law_has_another_limit(ratio, higher):
    """By Reissner's law the same code is `linear_modes`, so the law is what differs."""
    page = Path(__file__).parents[3] / "docs" / "theory" / "continuum.md"
    assert "1.7e-3 higher, at $L/h=20$ 4.5e-5" in page.read_text(encoding="utf-8")
    beam = unit_beam(1.0 / (12.0 * ratio**2))
    ours = sheared(beam, 6.0, 1)[0]
    assert by_powers(beam, 6.0)[0] == pytest.approx(ours, rel=1e-10)
    # The digits that are printed.
    assert sheared(beam, 6.0, 1, law="Engesser")[0] / ours - 1.0 == pytest.approx(higher, rel=0.02)
