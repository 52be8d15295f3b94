"""Tables of stations as irregular as real ones: always an answer, and no error larger than told."""

import warnings

import numpy as np
import pytest

from analytic import (
    Blade,
    Damping,
    ResponseNotReachedError,
    RotbeamWarning,
    SpinUp,
    Theory,
    TipForce,
    forced_response,
    linear_modes,
    periodic_orbits,
    spin_up_response,
    steady_state,
)
from analytic.exact.continuum.unit import StationUnit
from analytic.methods import orbit_curve
from tests.beams import irregular

STEEP = pytest.mark.filterwarnings("ignore:.* the twist is so steep that fibers")
SIGMAS = (0.001, 0.005, 0.03)  # of the centers, over the length
CASES = (
    (0.001, Theory()),
    (0.005, Theory(shear=True, trapeze=False)),
    (0.03, Theory()),
    (0.03, Theory(extension=False)),
)


@pytest.fixture
def by_panels(monkeypatch):
    """Return what makes panels between all stations, with polynomials and nothing else."""

    def change():
        monkeypatch.setattr(StationUnit, "panels", property(lambda unit: np.array(unit.section.x)))
        monkeypatch.setattr(StationUnit, "answers", property(lambda unit: False))

    return change


@pytest.mark.parametrize(("sigma", "theory"), CASES)
def test_errors_are_not_larger_than_told(sigma, theory, by_panels):
    """Polynomials on panels between stations need no answers: all kinks are at their ends."""
    blade = irregular(3, sigma, 6)
    modes = linear_modes(blade, 4.0, 6, theory=theory)
    state = steady_state(blade, 4.0, force=(0.0, 0.02, 0.05), theory=theory)
    assert max(modes.error, state.error) < 1e-6
    by_panels()
    known = linear_modes(blade, 4.0, 6, theory=theory, tolerance=1e-8)
    assert known.model.blade.panel_count == 5
    assert np.abs(modes.frequencies / known.frequencies - 1.0).max() < modes.error + known.error
    there = steady_state(blade, 4.0, force=(0.0, 0.02, 0.05), theory=theory, tolerance=1e-8)
    assert np.abs(state.tip - there.tip).max() < state.error + there.error


@pytest.mark.slow
@pytest.mark.parametrize(("count", "tolerance"), [(6, 1e-3), (6, 1e-5), (10, 1e-6)])
def test_the_error_of_a_spin_up_is_not_larger_than_told(by_panels, count, tolerance):
    """By functions from the motion's own forces; those of modes alone do not settle to 1e-6."""
    blade, motion, times = irregular(3, 0.03, count), SpinUp(omega=3.0, ramp_time=2.0), [1.0, 2.0]
    found = spin_up_response(blade, motion, times, tolerance=tolerance)
    assert found.error < tolerance
    by_panels()
    known = spin_up_response(blade, motion, times, tolerance=0.1 * tolerance)
    assert known.model.blade.panel_count == count - 1
    size = np.abs(known.tip[:, 1:]).max()
    for one, other in ((found.tip, known.tip), (found.twist, known.twist)):
        assert np.abs(one - other).max() < (found.error + known.error) * size


@pytest.mark.slow
def test_orbits_are_those_by_polynomials(by_panels):
    """On functions from their own forces; 1e-8 of the frequency is the bound of their harmonics."""
    blade = irregular(3, 0.005, 5)
    orbits = periodic_orbits(blade, 2.0, [0.03])
    by_panels()
    known = periodic_orbits(blade, 2.0, [0.03])
    error = orbits.frequency_error + known.frequency_error + 1e-8
    assert (np.abs(orbits.frequency / known.frequency - 1.0) < error).all()


@pytest.mark.slow
@pytest.mark.parametrize("sigma", [0.005, 0.03])
def test_the_error_of_a_response_is_not_larger_than_told(sigma, by_panels, monkeypatch):
    """The ends of a curve of forced vibration, against those by polynomials."""
    blade = irregular(3, sigma, 5)
    blade = blade.with_damping(Damping.from_ratio(blade, 1, 0.05))

    def response():
        return forced_response(blade, 2.0, TipForce(amplitude=0.01), [2.0, 2.2])

    found = response()
    assert 1e-7 < found.error < 5e-5
    by_panels()
    monkeypatch.setattr("analytic.methods.orbit_curve.RESPONSE_ERROR", 1e-7)
    known = response()
    for end in (0, -1):
        one, other = found.harmonics[end][:6], known.harmonics[end][:6]
        # Harmonics left out are 1e-6 of the amplitude.
        assert np.abs(one - other).max() < (found.error + 2e-6) * known.amplitude[end]


def test_a_table_answers_to_a_load_of_any_size():
    """The response to a millionth of a load is its millionth: no round-off makes functions."""
    blade = irregular(3, 0.005, 5)
    blade = blade.with_damping(Damping.from_ratio(blade, 1, 0.05))
    small, smaller = (
        forced_response(blade, 2.0, TipForce(amplitude=size), [1.0, 1.1]).amplitude[0] / size
        for size in (1e-4, 1e-10)
    )
    assert smaller == pytest.approx(small, rel=1e-4)


@STEEP
def test_fifty_stations_with_steps_of_three():
    """As an owner of a real blade has them."""
    modes = linear_modes(irregular(7, 0.03, 50), 4.0, 6)
    assert modes.error < 1e-6
    assert modes.model.size < 250


@STEEP
@pytest.mark.slow
@pytest.mark.parametrize("theory", [Theory(), Theory(trapeze=False)], ids=str)
@pytest.mark.parametrize("sigma", SIGMAS)
def test_forty_tables_are_answered(sigma, theory):
    for seed in range(40):
        blade = irregular(seed, sigma)
        modes = linear_modes(blade, 4.0, 6, theory=theory)
        assert modes.error < 1e-6
        finer = linear_modes(blade, 4.0, 6, theory=theory, tolerance=1e-9)
        assert np.abs(modes.frequencies / finer.frequencies - 1.0).max() < modes.error + 1e-9


def test_a_twist_that_steps_is_none_for_the_trapeze_effect():
    """By it the blade grew to twice its length at 1e-7, without a word; the remedy has a limit."""

    def stepped(width):
        EI = np.array([2.0, 2.0, 1.0, 0.7])
        columns = np.outer(EI, [4e3, 4e3, 4e3, 0.08, 0.0625, 1.0])
        return Blade.from_stations(
            [0.0, 0.3, 0.3 + width, 1.0], columns, [[1.0, 3e-3, 2e-3, 1e-3]] * 4,
            twist=[0.4, 0.3, 0.1, 0.0], center=[(0.0, 0.0), (0.01, 0.0), (-0.01, 0.0), (0.0, 0.0)],
        )  # fmt: skip

    with pytest.warns(RotbeamWarning, match="at x = 0.3 m the twist is so steep that fibers"):
        assert linear_modes(stepped(1e-7), 2.0, 1).frequencies[0] < 1.0
    steps = [
        linear_modes(stepped(width), 2.0, 6, theory=Theory(trapeze="elastic")).frequencies
        for width in (1e-7, 1e-9)
    ]
    np.testing.assert_allclose(*steps, rtol=3e-7)


def test_short_of_its_tolerance_an_answer_comes_with_a_warning(monkeypatch):
    """And one that is not known to 1e-3 is refused."""
    monkeypatch.setattr("analytic.exact.continuum.space.SpaceContinuum.most_functions", 25)
    blade = irregular(3, 0.03, 12)
    with pytest.warns(RotbeamWarning, match="more than the tolerance of 1e-10"):
        modes = linear_modes(blade, 4.0, 6, tolerance=1e-10)
    assert 1e-10 < modes.error < 1e-3
    with warnings.catch_warnings():
        warnings.simplefilter("error", RotbeamWarning)
        assert linear_modes(blade, 4.0, 6, tolerance=10.0 * modes.error).error <= modes.error
    monkeypatch.setattr("analytic.exact.continuum.space.SpaceContinuum.most_functions", 20)
    with pytest.raises(ValueError, match=r"differ by .*; ask for fewer modes, or rotate slower"):
        linear_modes(blade, 4.0, 6)


@pytest.mark.parametrize("tolerance", [0.0, -1e-6, 1e-13, 0.01, np.nan, np.inf, "1e-6", True])
def test_tolerances_out_of_reach_are_refused(tolerance):
    for verb in (linear_modes, steady_state):
        with pytest.raises((ValueError, TypeError), match="tolerance"):
            verb(irregular(3, 0.001, 4), 4.0, tolerance=tolerance)


@pytest.mark.filterwarnings("ignore:at x")  # of the trapeze effect, which MBDyn has not
@pytest.mark.parametrize(
    ("table", "frequencies"),
    [
        ((2, 0.03, 9), (2.678371, 4.139866, 6.003401, 8.521109, 15.17584, 17.37809)),
        ((4, 0.005, 16), (3.028772, 5.578425, 7.774819, 8.871129, 16.7923, 22.3205)),
        ((7, 0.01, 6), (2.881322, 5.03304, 7.272182, 8.616821, 16.41816, 20.1421)),
    ],
)
def test_another_code_has_the_modes_of_irregular_tables_in_rotation(table, frequencies):
    """MBDyn 1.7.3: 8 and 16 beams between two stations, extrapolated by the square of their length.

    As `models/codes/mbdyn_blades`; its own change from 4 and 8 beams is up to 4e-6.
    """
    theory = Theory(shear=True, rotary_inertia=True, trapeze=False)
    modes = linear_modes(irregular(*table), 2.6, 6, theory=theory)
    assert modes.frequencies == pytest.approx(frequencies, rel=1e-6)


@pytest.mark.filterwarnings("ignore:at x")
@pytest.mark.parametrize(
    ("table", "tip"),
    [
        ((2, 0.03, 9), (0.67382797, -0.99169195, 0.076649611)),
        ((4, 0.005, 16), (0.11925552, -0.4765, 0.020734795)),
        ((7, 0.01, 6), (0.24642929, -0.35030846, 0.016213064)),
    ],
)
def test_another_code_has_the_sag_of_irregular_tables_in_rotation(table, tip):
    """MBDyn as above: lag, flap and twist of 10 m at 15 rad/s on a cone, weight along the axis.

    Its own change from 4 and 8 beams is up to 2e-5, which 8 and 16 make sixteen times smaller.
    """
    blade = irregular(*table).in_units(length=0.1, mass=0.01, time=5.0)
    theory = Theory(shear=True, rotary_inertia=True, trapeze=False)
    state = steady_state(blade, 15.0, gravity=9.81, theory=theory)
    assert (*state.tip[1:], state.twist) == pytest.approx(tip, rel=3e-6)


def test_where_functions_are_missing_the_error_is_told_and_smoothing_mends_it(monkeypatch):
    """As of a table with more steps than any so far, here by few functions."""

    def response(sigma):
        blade = irregular(4, sigma, 8)
        blade = blade.with_damping(Damping.from_ratio(blade, 1, 0.05))
        return forced_response(blade, 2.0, TipForce(amplitude=0.01), [2.0, 2.05])

    known = response(0.0)
    monkeypatch.setattr(orbit_curve, "_CARE", orbit_curve._CARE._replace(functions=5))
    with pytest.raises(ResponseNotReachedError, match="with 5 functions .* smooth"):
        response(0.03)
    with pytest.warns(RotbeamWarning, match=r"is known to \S+ of its amplitude: no more functions"):
        found = response(0.0)
    assert 5e-5 < found.error < 1e-3
    assert np.abs(found.amplitude[[0, -1]] / known.amplitude[[0, -1]] - 1.0).max() < found.error
