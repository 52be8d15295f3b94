"""Linear modes of the exact beam: published frequencies, the stretched rod, limits."""

import numpy as np
import pytest

from analytic import Beam, Theory, linear_modes
from analytic.exact.continuum.planar_rotation import continuum, resolved_model
from analytic.exact.continuum.rotation import SteadyBlade
from tests.beams import unit_beam

# In-plane; Wright et al. 1982, Hodges and Rutkowski 1981 and Banerjee 2000 give the squares
# of the out-of-plane ones, larger by w̄², to fewer digits.
INEXTENSIBLE = {
    0.0: (3.516015269, 22.03449156, 61.69721441),
    4.0: (3.897722524, 23.94150143, 63.84157304),
    8.0: (4.657149596, 28.90887294, 69.83624083),
    12.0: (5.427049278, 35.63697598, 78.70492478),
}
EXTENSIBLE = {2.0: 3.03488474, 4.0: 3.34561553, 6.0: 3.73040139, 8.0: 4.12389509}


@pytest.mark.parametrize("rate", INEXTENSIBLE)
def test_inextensible_modes_are_the_published_ones(beam, rate):
    modes = linear_modes(beam, rate * beam.frequency_scale, theory=Theory(extension=False))
    # The numbers carry ten digits, the last ones rounded.
    assert modes.frequencies / beam.frequency_scale == pytest.approx(INEXTENSIBLE[rate], abs=1e-8)


@pytest.mark.parametrize("omega", EXTENSIBLE)
def test_extensible_first_frequency(beam, omega):
    first = linear_modes(beam, omega).frequencies[0]
    assert first == pytest.approx(EXTENSIBLE[omega], abs=1e-8)


@pytest.mark.parametrize("rate", [0.5, 6.0, 14.0])
def test_steady_state_is_the_rotating_rod(rate):
    model = continuum(1e-2, 16, 14)
    k = 0.1 * rate  # up to 1.4, near π/2 where the rod is stretched without bound
    x = np.linspace(0.0, 1.0, 11)
    slope = model.slope(SteadyBlade(model, rate).equilibrium, x)
    assert slope.imag == pytest.approx(0.0, abs=1e-15)
    assert slope.real == pytest.approx(np.cos(k * x) / np.cos(k), rel=1e-10)


def test_axial_frequencies_at_rest_are_those_of_a_rod():
    thick = unit_beam(5e-4)
    axial = 0.5 * np.pi * np.sqrt(2e3)
    modes = linear_modes(thick, 0.0, 5)
    assert np.abs(modes.frequencies / axial - 1.0).min() < 1e-12


def test_shapes_are_clamped_and_one_at_the_tip(beam):
    modes = linear_modes(beam, 5.0, 4)
    shapes = modes.shapes([0.0, 1e-6 * beam.length, beam.length])
    assert shapes[:, 0] == pytest.approx(0.0, abs=1e-15)
    assert shapes[:, 1] == pytest.approx(0.0, abs=1e-9)  # no slope at the clamp either
    assert shapes[1, 2] == pytest.approx(1.0)


def test_a_speed_that_tears_the_beam_is_refused(beam):
    soft = unit_beam(1e-2)
    linear_modes(soft, 15.5)
    with pytest.raises(ValueError, match=r"stretched without bound at 15\.708 rad/s"):
        linear_modes(soft, 15.71)


def test_a_mode_beyond_the_resolved_ones_is_refused(beam, monkeypatch):
    with pytest.raises(ValueError, match="mode 11 is beyond the 10 that 20 functions resolve"):
        linear_modes(beam, 1.0, 11)
    monkeypatch.setattr("analytic.exact.continuum.planar_rotation.MOST_FUNCTIONS", 20)
    assert resolved_model(beam, 10, Theory(), 20).size
    for mode, functions in ((11, 20), (1, 21)):
        with pytest.raises(ValueError, match="at most 20 functions are taken, .* 10 modes"):
            resolved_model(beam, mode, Theory(), functions)


@pytest.mark.parametrize("stiffness", [0.0, -1.0, np.nan])
def test_axial_stiffness_must_be_positive(stiffness):
    with pytest.raises(ValueError, match="axial_stiffness must be"):
        Beam.from_stiffness(
            length=1.0, axial_stiffness=stiffness, bending_stiffness=1.0, mass_per_length=1.0
        )
