"""The exact backbone over speed too: against orbits, and where it says that it does not hold."""

from dataclasses import replace

import numpy as np
import pytest

from analytic import backbone_curve, backbone_map, linear_modes, periodic_orbits
from analytic.exact.backbone_map import nearest


@pytest.fixture(scope="module")
def found(beam):
    seen = []
    result = backbone_map(
        beam, (3.0, 5.0), up_to=0.3, speeds=9, progress=lambda *done: seen.append(done)
    )
    assert seen == [(k, 9) for k in range(1, 10)]
    return result


def test_orbits_lie_on_it(beam, found):
    a = np.array([0.04, 0.17, 0.3])
    # Between the curves, next to either end and amid.
    for omega in (3.1, 4.13, 4.9):
        orbits = periodic_orbits(beam, omega, a)
        assert found.holds(omega, a).all()
        off = np.abs(found.frequency(omega, a) - orbits.frequency) / orbits.omega_n
        assert (off < found.tolerance).all()
        np.testing.assert_allclose(found.first_harmonic(omega, a), orbits.first_harmonic, rtol=1e-6)
        assert found.linear_frequency(omega) == pytest.approx(orbits.omega_n, rel=1e-6)


def test_at_a_speed_of_its_own_it_is_the_curve(beam, found):
    a = np.linspace(0.0, 0.3, 7)
    np.testing.assert_allclose(
        found.frequency(4.0, a), backbone_curve(beam, 4.0, up_to=0.3).frequency(a), rtol=3e-7
    )


def test_more_curves_are_nearer(beam):
    a, omega = 0.25, 4.4
    exact = periodic_orbits(beam, omega, a).frequency[0]
    off = []
    for high, step in ((7.0, 0.9), (5.6, 0.45)):
        # So far apart the first would say nothing at 1e-6.
        wide = backbone_map(beam, (high - 7.0 * step, high), 0.3, speeds=8, tolerance=1e-3)
        off.append(abs(wide.frequency(omega, a) - exact))
    # A polynomial through eight: 2^8 for half the distance.
    assert off[0] / off[1] > 30.0


def test_shapes_broadcast(found):
    omega, a = np.array([3.0, 3.5, 5.0])[:, None], np.array([0.0, 0.1, 0.2, 0.3])
    answer = found.frequency(omega, a)
    assert answer.shape == found.holds(omega, a).shape == (3, 4)
    assert found.first_harmonic(omega, a)[1, 2] == found.first_harmonic(3.5, 0.2)
    assert answer[1, 2] == found.frequency(3.5, 0.2)
    assert isinstance(found.frequency(3.5, 0.2), float)


@pytest.mark.parametrize(
    ("omega", "a", "says"),
    [
        (2.9, 0.1, "omega from 3 to 5 rad/s, got 2.9"),
        (5.1, 0.1, "got 5.1 rad/s"),
        (4.0, 0.31, "amplitude from 0 to 0.3, got 0.31"),
        (4.0, -0.1, "got -0.1"),
        (np.nan, 0.1, "finite"),
    ],
)
def test_what_it_is_not_for(found, omega, a, says):
    with pytest.raises(ValueError, match=says):
        found.frequency(omega, a)


def test_where_it_does_not_hold_it_is_silent(found):
    """As it is where one curve ends early: the answers that come from it."""
    cell_reach = found.cell_reach.copy()
    cell_reach[2] = 0.12
    short = replace(found, cell_reach=cell_reach)
    omega = np.array([3.3, 3.6, 4.2])
    assert short.holds(omega, 0.2).tolist() == [True, False, True]
    assert np.isnan(short.frequency(omega, 0.2)).tolist() == [False, True, False]
    assert short.frequency(3.6, 0.1) == found.frequency(3.6, 0.1)
    assert "up to a = 0.12 at the least, between 3.5 and 3.75 rad/s" in str(short)
    assert "everywhere" in str(found)


def test_which_curves_an_answer_comes_from():
    assert nearest(0, 20) == slice(0, 8)
    assert nearest(10, 20) == slice(7, 15)
    assert nearest(18, 20) == slice(12, 20)
    assert nearest(3, 5) == slice(0, 5)


@pytest.mark.parametrize(
    ("arguments", "options", "says"),
    [
        (((5.0, 3.0),), {}, "lowest and the highest"),
        (((3.0, 5.0), 1.0), {}, "up_to must be below 1"),
        (((3.0, 5.0),), {"speeds": 7}, "speeds must be at least 8"),
        (((3.0, 5.0),), {"tolerance": 1e-12}, "tolerance must be at least 1e-9"),
    ],
)
def test_bad_input(beam, arguments, options, says):
    with pytest.raises(ValueError, match=says):
        backbone_map(beam, *arguments, **options)


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore:internal resonance:analytic.input_checks.RotbeamWarning")
def test_before_a_resonance_it_ends(beam):
    """Harmonic 6 meets mode 2 at a = 0.6375, 2 rad/s."""
    found = backbone_map(beam, (1.5, 2.5), up_to=0.68, speeds=8)
    assert (found.cell_reach < 0.6375).all()
    assert (found.cell_reach > 0.5).all()
    assert not found.holds(2.0, 0.65)
    assert np.isnan(found.frequency(2.0, 0.65))
    exact = periodic_orbits(beam, 2.06, [0.5])
    assert found.frequency(2.06, 0.5) == pytest.approx(exact.frequency[0], rel=1e-6)


def test_linear_frequency_is_that_of_the_modes(beam, found):
    modes = linear_modes(beam, 4.4)
    assert found.linear_frequency(4.4) == pytest.approx(modes.frequencies[0], rel=1e-7)
