"""The paper's own element."""

import numpy as np
import pytest

from analytic import Theory, linear_modes
from rotbeam_exu import natural_frequencies, simulate, steady_oscillation
from rotbeam_exu.fem.elements import Ancf3
from rotbeam_exu.fem.solver import mass_matrix


def first_frequency(beam, omega, element, elements):
    return natural_frequencies(beam, omega, element=element, elements=elements, count=1)[0]


@pytest.mark.parametrize(
    ("omega", "frequency"),
    [(0.0, 2.909195), (2.0, 3.034856), (4.0, 3.345612), (6.0, 3.730423), (8.0, 4.123943)],
)
def test_linear_frequencies(beam, omega, frequency):
    found = natural_frequencies(beam, omega, element="ancf3", count=1)[0]
    assert found == pytest.approx(frequency, abs=6e-7)  # the print's rounding


def test_sixteen_elements_have_the_papers_coordinates(beam):
    assert mass_matrix(Ancf3(), beam, 16).shape == (132, 132)
    # Four constraints: 128 degrees of freedom.
    assert natural_frequencies(beam, 0.0, element="ancf3", count=128).size == 128
    with pytest.raises(ValueError, match="more than the 128 modes"):
        natural_frequencies(beam, 0.0, element="ancf3", count=129)


@pytest.mark.slow
@pytest.mark.parametrize(("law", "frequency"), [("uncoupled", 3.7231), ("coupled", 3.848)])
def test_nonlinear_frequency(beam, spin_up, law, frequency):
    run = simulate(beam, spin_up, element=Ancf3(law=law))
    # The rounding of the number: its last digit.
    places = len(str(frequency).partition(".")[2])
    assert steady_oscillation(run).frequency == pytest.approx(frequency, abs=0.5 * 10.0**-places)


def test_stiff_shear_leaves_the_cable_but_for_the_law_of_strain(beam):
    """In rotation, Green-Lagrange strain makes bending stiffer by 3ε, ε the centrifugal strain.

    (1 + ε)² from b = r_x·r_xy and ε from 2ac; by Rayleigh's quotient the frequency gains
    (3/2) ∫ ε EI v''² dx / (ω_n² ∫ ρA v² dx), 4.7e-5 at 6 rad/s.
    """
    omega = 6.0
    modes = linear_modes(beam, omega, 1, theory=Theory(rotary_inertia=True))
    x = np.linspace(0.0, beam.length, 2001)
    v = modes.shapes(x)[1, :, 0].real
    curvature = np.gradient(np.gradient(v, x, edge_order=2), x, edge_order=2)
    strain = beam.density * omega**2 * (beam.length**2 - x**2) / (2.0 * beam.youngs_modulus)
    gain = (
        1.5
        * np.trapezoid(strain * beam.bending_stiffness * curvature**2, x)
        / (modes.frequencies[0] ** 2 * np.trapezoid(beam.mass_per_length * v**2, x))
    )
    stiff = first_frequency(beam, omega, Ancf3(shear_correction=100.0), 32)
    cable = first_frequency(beam, omega, "cable", 64)
    rotary = modes.frequencies[0] / linear_modes(beam, omega, 1).frequencies[0]
    # Beyond the first order in ε there is the mesh, 5e-7.
    assert stiff / cable - rotary == pytest.approx(gain, abs=2e-6)


def test_mass_is_that_of_a_blade_that_tapers(beam):
    """∫(m + ρI) x⁴ dx of quadratic r and r_y; ρI = m EI/EA of a homogeneous section."""
    blade = beam.with_taper(0.3, 0.5)
    x = np.polynomial.Polynomial([0.0, beam.length])
    width, height = np.polynomial.Polynomial([1, -0.3]), np.polynomial.Polynomial([1, -0.5])
    m = beam.mass_per_length * width * height
    both = m + beam.density * beam.second_moment * width * height**3
    nodes = np.zeros((9, 4))
    nodes[:, 1] = nodes[:, 2] = np.linspace(0.0, beam.length, 9) ** 2
    found = nodes.ravel() @ mass_matrix(Ancf3(), blade, 4) @ nodes.ravel()
    assert found == pytest.approx(beam.length * (both * x**4).integ()(1.0), rel=1e-13)
