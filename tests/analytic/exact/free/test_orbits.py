"""Periodic orbits of the exact beam: golden frequencies, invariants, amplitudes not reached."""

import numpy as np
import pytest

import analytic
from analytic import AmplitudeNotReachedError, Theory, linear_modes, periodic_orbits
from analytic.input_checks import RotbeamWarning
from analytic.methods import harmonic_balance
from analytic.methods.continuation import Care
from analytic.methods.harmonic_balance import LastTangent, solve
from tests.beams import UNIT

AMPLITUDES = [0.05, 0.10, 0.15, 0.20, 0.25]
RATIOS = {
    2.0: [1.000022, 1.000090, 1.000203, 1.000364, 1.000574],
    8.0: [0.999940, 0.999761, 0.999459, 0.999032, 0.998473],
}


@pytest.fixture(scope="module", params=sorted(RATIOS))
def backbone(request, beam):
    return periodic_orbits(beam, request.param, AMPLITUDES)


def test_golden_frequencies(backbone):
    ratio = backbone.frequency / backbone.omega_n
    assert ratio == pytest.approx(RATIOS[backbone.omega], abs=6e-7)  # six decimals


def test_the_frequency_error_is_the_change_under_refinement(beam, monkeypatch):
    """Against the refined equations solved anew; of six functions two steps leave a tenth out."""
    monkeypatch.setattr("analytic.methods.continuation.RESIDUAL_BOUND", 1.0)
    monkeypatch.setattr("analytic.methods.continuation.FREQUENCY_BOUND", 1.0)
    for functions in (6, 8, 10):
        found = periodic_orbits(beam, 8.0, [0.3], functions=functions)
        (orbit,) = found.nondimensional
        finer = solve(orbit.on(orbit.system.refined()), 0.3)
        change = abs(finer.frequency / orbit.frequency - 1.0)
        assert found.frequency_error[0] == pytest.approx(change, rel=0.2)


@pytest.mark.parametrize("functions", [6, 8, 16])
def test_an_orbit_takes_the_functions_that_its_frequency_needs(beam, functions):
    exact = periodic_orbits(beam, 8.0, [0.2, 0.4], functions=32)
    found = periodic_orbits(beam, 8.0, [0.2, 0.4], functions=functions)
    assert found.frequency_error.max() <= 1e-9
    error = np.abs(found.frequency / exact.frequency - 1.0)
    # What the next refinement leaves is less than what it changes; round-off keeps 1e-12.
    assert np.all(error < 2.0 * found.frequency_error + 1e-12)


UNCONFIRMED = pytest.mark.xfail(strict=True, reason="finer functions do not confirm this orbit")


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore:internal resonance:analytic.input_checks.RotbeamWarning")
@pytest.mark.parametrize("amplitude", [0.35, pytest.param(0.4, marks=UNCONFIRMED)])
def test_near_a_resonance_no_orbit_depends_on_the_functions(amplitude):
    """Where several orbits have one amplitude: 5e-4 lay between 16 functions and 24."""
    blade = UNIT.with_hub_radius(5.0)
    found = []
    for functions in (20, 24):
        try:
            orbits = periodic_orbits(
                blade, 8.0, [amplitude], theory=Theory(extension=False), functions=functions
            )
        except AmplitudeNotReachedError as beyond:
            orbits = beyond.part
        assert orbits.frequency_error.max() < 1e-9
        found.append(orbits.frequency)
    assert found[0] == pytest.approx(found[1], rel=2e-9)


def test_invariants(backbone):
    assert backbone.jacobi_drift.max() < 1e-10
    assert backbone.residual.max() < 1e-5


def test_lambda_omega_at_rest(beam):
    first = periodic_orbits(beam, 0.0, [0.05], theory=Theory(extension=False))
    assert first.lambda_omega == pytest.approx(-0.0193835, abs=1e-7)
    second = periodic_orbits(beam, 0.0, [0.02], mode="lag 2", theory=Theory(extension=False))
    assert second.lambda_omega == pytest.approx(6.45441, abs=1e-5)


def test_frequency_departs_from_the_leading_order_as_the_fourth_power(beam, fitted_order):
    a = np.array([0.05, 0.07, 0.1, 0.14])
    b = periodic_orbits(beam, 6.0, a)
    rest = np.abs(b.frequency / b.omega_n - (1.0 - b.lambda_omega * a**2))
    assert fitted_order(a, rest) == pytest.approx(4.0, abs=0.1)


def test_small_orbit_is_the_linear_mode(beam):
    b = periodic_orbits(beam, 6.0, [1e-4])
    modes = linear_modes(beam, 6.0, 1)
    assert b.frequency[0] == pytest.approx(modes.frequencies[0], rel=1e-9)
    x = np.linspace(0.0, beam.length, 9)
    moving = b.state(0, x, 0.5 * np.pi).place[:, 1] / (1e-4 * beam.length)
    assert moving == pytest.approx(modes.shapes(x)[1, :, 0].real, abs=1e-6)


@pytest.fixture(scope="module")
def wide(beam):
    return periodic_orbits(beam, 4.0, [0.3])


def test_orbit_response_and_state_tell_the_same(beam, wide):
    b = wide
    x, rate = b.orbit(0, 401)
    tau = np.linspace(0.0, 2.0 * np.pi * beam.frequency_scale / b.frequency[0], 401)
    assert x[0] == pytest.approx(0.0, abs=1e-15)
    assert x == pytest.approx(-x[::-1], abs=1e-13)  # (v, t) → (-v, -t)
    assert rate[1:-1] == pytest.approx(np.gradient(x, tau)[1:-1], abs=2e-3)
    times = tau / beam.frequency_scale
    assert b.response(times, 0) == pytest.approx(x, abs=1e-13)
    assert b.response(b.peak_time[0], 0) == pytest.approx(0.3, rel=1e-12)
    series = b.harmonics[0] @ np.sin(
        np.outer(np.arange(1, b.harmonics.shape[1] + 1), b.frequency[0] * times)
    )
    assert series == pytest.approx(x, abs=1e-9)


@pytest.mark.parametrize("twist", [0.0, 0.5])
def test_state_is_consistent_in_space_and_time(wide, twist):
    """In the plane, and of a twisted blade that shears."""
    b = wide
    if twist:
        blade = b.blade.with_section_out_of_plane(0.3, 0.2).with_twist(twist)
        b = periodic_orbits(blade, 4.0, [0.05], theory=Theory(shear=0.3))
    x, phase, h = np.linspace(0.0, 8.0, 9), 0.7, 1e-4
    here = b.state(0, x, phase)
    ahead, behind = (b.state(0, x, phase + s * h * b.frequency[0]) for s in (1.0, -1.0))
    for name, rate in (("place", "velocity"), ("slope", "slope_rate")):
        moved = (getattr(ahead, name) - getattr(behind, name)) / (2.0 * h)
        assert getattr(here, rate) == pytest.approx(moved, abs=1e-6)
    inner = x[1:-1]
    after, before = b.state(0, inner + h, phase), b.state(0, inner - h, phase)
    assert here.slope[1:-1] == pytest.approx((after.place - before.place) / (2.0 * h), abs=1e-8)
    # ω × the axes of a section are their rates.
    turned = (ahead.section - behind.section) / (2.0 * h)
    assert np.cross(here.spin[..., None], here.section, axis=1) == pytest.approx(turned, abs=1e-6)
    straight = b.state(0, x)
    assert straight.place[:, 1] == pytest.approx(0.0, abs=1e-15)
    assert straight.place[0, 0] == straight.slope_rate[0, 0] == 0.0


def test_orbits_of_the_first_mode_are_stable(beam):
    b = periodic_orbits(beam, 8.0, [0.1, 0.3])
    assert b.stable.all()
    # Nothing is damped, neither by the beam nor by the method.
    assert np.abs(b.multipliers) == pytest.approx(1.0, abs=1e-7)
    # Small orbits have those of the linear modes, exp(2πi ω_j/ω_1).
    small = periodic_orbits(beam, 8.0, [1e-3])
    frequencies = linear_modes(beam, 8.0, 3).frequencies
    for frequency in frequencies[1:]:
        expected = np.exp(2j * np.pi * frequency / frequencies[0])
        assert np.abs(small.multipliers - expected).min() < 1e-4


def test_a_large_amplitude_is_reached_and_its_internal_resonance_named(beam):
    # By the linear frequencies it would be harmonic 17 and mode 3, whose ratio about this orbit is
    # 16.24; that of mode 2 is 6.036.
    with pytest.warns(RotbeamWarning, match=r"harmonic 6 of the orbit .* 0\.6 % from lag 2"):
        b = periodic_orbits(beam, 2.0, [0.6])
    assert b.amplitude[0] == 0.6
    assert b.jacobi_drift[0] < 1e-10
    assert np.max(np.abs(b.orbit(0, 2000)[0])) == pytest.approx(0.6, rel=1e-5)


def test_an_orbit_with_a_large_residual_is_refused(beam, monkeypatch):
    for module in ("methods.continuation", "exact.free.path"):
        monkeypatch.setattr(f"analytic.{module}.MOST_FUNCTIONS", 7)
    with pytest.raises(RuntimeError, match="functions meet the equations of motion to .* only"):
        periodic_orbits(beam, 8.0, [0.5], functions=5)


@pytest.mark.parametrize(
    ("arguments", "error", "sentence"),
    [
        ({"amplitudes": [0.1, 1.2]}, ValueError, "between 0 and 1, got 1.2"),
        ({"amplitudes": [0.0]}, ValueError, "between 0 and 1, got 0"),
        ({"amplitudes": [1.0]}, ValueError, "between 0 and 1, got 1:"),
        ({"amplitudes": [np.nan]}, ValueError, "must be finite, got nan"),
        ({"amplitudes": [0.1], "mode": "lag 9"}, ValueError, "mode 9 is beyond the 8"),
    ],
)
def test_bad_input(beam, arguments, error, sentence):
    with pytest.raises(error, match=sentence):
        periodic_orbits(beam, **{"omega": 4.0, **arguments})


def test_the_tangent_of_an_orbit_near_by_finds_the_same_orbit(beam, monkeypatch):
    """Broyden's method goes on where another orbit's tangent would contract slowly."""
    factored = []
    at = harmonic_balance.jacobian
    monkeypatch.setattr(
        harmonic_balance,
        "jacobian",
        lambda orbit, **kind: factored.append(orbit) or at(orbit, **kind),
    )
    path = analytic.backbone(beam, 6.0).path
    near, far = path.laid(0.2), path.laid(0.25)
    tangent = LastTangent()
    harmonic_balance.solve(near.scaled(0.2).with_harmonics(far.harmonics), 0.2, tangent)
    before = len(factored)
    shared = harmonic_balance.solve(far.scaled(0.24), 0.24, tangent)
    assert len(factored) == before
    own = harmonic_balance.solve(far.scaled(0.24), 0.24)
    assert shared.frequency == pytest.approx(own.frequency, rel=1e-13)
    np.testing.assert_allclose(shared.coefficients, own.coefficients, atol=1e-12)


def test_a_tangent_that_leads_astray_is_made_anew(beam):
    orbit = analytic.backbone(beam, 6.0).path.laid(0.2)
    tangent = LastTangent()
    tangent.factor(orbit)
    lower, pivots = tangent.factors
    tangent.factors = (-1e-3 * lower, pivots)
    found = harmonic_balance.solve(orbit.scaled(0.21), 0.21, tangent)
    assert found.frequency == pytest.approx(
        harmonic_balance.solve(orbit.scaled(0.21), 0.21).frequency, rel=1e-12
    )


@pytest.mark.parametrize("amplitudes", [[0.04, 0.06], [0.02, 0.03], [0.02, 0.04]])
def test_amplitudes_of_the_orbits_it_starts_from(beam, amplitudes):
    found = periodic_orbits(beam, 6.0, amplitudes)
    expected = 1.0 - found.lambda_omega * found.amplitude**2
    # The next term, κa⁴ with κ = 0.0072.
    assert found.frequency / found.omega_n == pytest.approx(expected, abs=1e-2 * 0.06**4)
    # Error of the extrapolation from 0.02 and 0.04.
    assert found.lambda_omega_error == pytest.approx(0.0072 * 0.02**2, rel=0.02)


def test_orbits_found_are_attached(beam, monkeypatch):
    monkeypatch.setattr("analytic.exact.free.path.THOROUGH", Care(harmonics=12))
    asked = [0.2, 0.6, 0.1, 0.2]
    with pytest.raises(AmplitudeNotReachedError, match=r"of 0\.6 was found") as caught:
        periodic_orbits(beam, 6.0, asked)
    kept = caught.value.part
    whole = periodic_orbits(beam, 6.0, [0.2, 0.1])
    assert kept.amplitude.tolist() == [0.2, 0.1, 0.2]
    np.testing.assert_array_equal(kept.frequency, whole.frequency[[0, 1, 0]])
    assert isinstance(caught.value, RuntimeError)
    with pytest.raises(AmplitudeNotReachedError) as caught:
        periodic_orbits(beam, 6.0, [0.6])
    assert caught.value.part is None


def test_an_orbit_lost_in_round_off_does_not_cost_the_larger(beam):
    with pytest.raises(AmplitudeNotReachedError, match="take linear_modes") as caught:
        periodic_orbits(beam, 6.0, [1e-14, 0.1])
    assert caught.value.part.amplitude.tolist() == [0.1]
