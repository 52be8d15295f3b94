"""Forced response: published-to-be numbers, an independent integrator, and the limits."""

import math
import warnings
from dataclasses import replace

import numpy as np
import pytest

from analytic import (
    Beam,
    Damping,
    Gravity,
    LoadTable,
    PointLoad,
    ResponseNotReachedError,
    SpeedRipple,
    SteadyRotation,
    Theory,
    TipForce,
    forced_response,
    linear_modes,
    periodic_orbits,
    reduced_model,
    spin_up_response,
)
from analytic.methods.collocation import radau

BEAM = Beam.reference()
SCALE = BEAM.frequency_scale
FORCE = BEAM.bending_stiffness / BEAM.length**3  # unit of force per length


def by_mass(c):
    """The beam with mass-proportional damping c, over its frequency scale."""
    return BEAM.with_damping(Damping(external=c * BEAM.mass_per_length * SCALE))


# Converged to the digits printed (peaks 5e-7, folds 4e-8 in ν) by another code.
CASES = {
    "loaded": ((3.6748996, 0.443459), [(3.6731232, 0.257793), (3.6750403, 0.439112)]),
    "rippled": ((4.4939512, 0.397604), [(4.4936794, 0.394058), (4.4982797, 0.220710)]),
}


@pytest.mark.parametrize("name", CASES)
def test_peak_and_folds_are_the_known_ones(name, request):
    response = request.getfixturevalue(name)
    (nu, a), folds = CASES[name]
    (peak,) = response.peaks
    assert peak.amplitude == pytest.approx(a, abs=2e-6)
    assert peak.frequency == pytest.approx(nu * SCALE, rel=1e-6)
    found = sorted(response.folds)
    assert [fold.amplitude for fold in found] == pytest.approx([f[1] for f in folds], abs=2e-6)
    assert [fold.frequency / SCALE for fold in found] == pytest.approx(
        [f[0] for f in folds], rel=5e-8
    )


@pytest.mark.parametrize(
    ("name", "ratio", "amplitudes", "unstable"),
    [
        ("loaded", 1.0015, (0.419642, 0.318274, 0.205078), 1.001920),
        ("rippled", 0.997, (0.129067, 0.347907, 0.390224), 1.003912),
    ],
)
def test_between_the_folds_the_middle_response_is_unstable(
    name, ratio, amplitudes, unstable, request
):
    response = request.getfixturevalue(name)
    omega_n = {"loaded": 3.66791071, "rippled": 4.50886824}[name] * SCALE
    three = response.at(ratio * omega_n)
    assert response.amplitude[three] == pytest.approx(amplitudes, abs=2e-6)
    assert response.stable[three].tolist() == [True, False, True]
    assert np.abs(response.multipliers[three[1]]).max() == pytest.approx(unstable, abs=1e-6)
    # Folds are where a multiplier passes 1: all between is unstable, all beyond stable.
    turns = [int(np.argmin(np.abs(response.frequency - f.frequency))) for f in response.folds]
    middle = slice(turns[0] + 1, turns[1])
    assert not response.stable[middle].any()
    assert response.stable[: turns[0]].all()
    assert response.stable[turns[1] + 1 :].all()


def by_collocation(orbit):
    """Start of an orbit, and what Radau's method of order 15 makes of it in a period, (2n,)."""
    system, w, method, steps = orbit.system, orbit.frequency, radau(8), 60
    q, q_dot, q_ddot = (part[0] for part in orbit.coordinates(np.zeros(1)))
    start, h = np.concatenate((q, q_dot)), 2.0 * np.pi / w / steps
    acceleration = np.tile(q_ddot, (8, 1))
    for step in range(steps):
        phase = 2.0 * np.pi * (step + method.nodes) / steps
        acceleration = method.step(
            h, q, q_dot, acceleration,
            residual=lambda *state, phase=phase: system.residual(*state, phase, w),
            tangent=lambda *state, phase=phase: system.tangent(*state, phase, w),
        ).z  # fmt: skip
        positions, velocities, _ = method.stages(h, q, q_dot, acceleration)
        q, q_dot = positions[-1], velocities[-1]
    return start, np.concatenate((q, q_dot))


def test_a_period_later_an_integrator_that_knows_no_fourier_series_is_back():
    """For a stable response and the unstable one."""
    nu = 0.997 * 4.50886824 * SCALE
    response = forced_response(
        by_mass(0.008), 6.0, SpeedRipple(amplitude=0.003 * SCALE), [0.99 * nu, nu, 1.004 * nu],
        theory=Theory(extension=False), functions=6, harmonics=15,
    )  # fmt: skip
    for i in response.at(nu)[:2]:
        start, ended = by_collocation(response.nondimensional[i])
        assert np.abs(ended - start).max() < 1e-8


@pytest.mark.parametrize(
    ("w", "amplitude"), [(1, 0.249537), (2, 0.318507), (3, 0.382298), (4, 0.453427), (5, 0.252023)]
)
def test_the_beam_under_its_weight(w, amplitude):
    gravity = 1.791 * FORCE / BEAM.mass_per_length
    speeds = SCALE * np.unique([0.9 * w, w, 1.05 * w])
    found = forced_response(by_mass(1.5), speeds, Gravity(gravity), theory=Theory(extension=False))
    assert found.amplitude[found.at(w * SCALE)] == pytest.approx([amplitude], abs=1e-6)
    assert found.omega == pytest.approx(found.frequency)


def test_a_small_load_gives_the_linear_response():
    """One mode's receptance: at resonance F/(c ω_n M) in size and a quarter turn behind."""
    modes = linear_modes(BEAM, 6.0, theory=Theory(extension=False))
    omega_n = float(modes.frequencies[0])
    x = np.linspace(0.0, BEAM.length, 401)
    mass = BEAM.mass_per_length * np.trapezoid(modes.shapes(x)[1, :, 0].real ** 2, x)
    force, c = 1e-4, 0.02
    found = forced_response(
        by_mass(c), 6.0, TipForce(amplitude=force), omega_n * np.array([0.8, 1.0, 1.2]),
        theory=Theory(extension=False),
    )  # fmt: skip
    (i,) = found.at(omega_n)
    wanted = force / (c * SCALE * omega_n * mass) / BEAM.length
    # Other modes add their quasi-static share, which is out of phase.
    assert abs(found.harmonics[i, 1]) == pytest.approx(wanted, rel=1e-4)
    assert found.phase[i] == pytest.approx(0.5 * np.pi, abs=1e-2)
    assert found.phase[0] < 0.1
    assert not found.folds


@pytest.mark.filterwarnings("ignore:internal resonance:analytic.input_checks.RotbeamWarning")
def test_what_a_response_says_of_itself(loaded):
    assert "folds at 3.04082 rad/s, 3.03923 rad/s" in str(loaded)
    i = int(np.argmax(loaded.amplitude))
    phase = np.linspace(0.0, 2.0 * np.pi, 2001)
    q = loaded.response(phase, i)
    assert np.abs(q).max() == pytest.approx(loaded.amplitude[i], abs=1e-6)
    series = sum((h * np.exp(1j * k * phase)).real for k, h in enumerate(loaded.harmonics[i]))
    assert series == pytest.approx(q, abs=1e-6)
    state = loaded.state(i, [0.0, BEAM.length], phase=1.0)
    assert state.place[1, 1] == pytest.approx(BEAM.length * loaded.response(1.0, i))
    assert loaded.backbone.omega_n == pytest.approx(3.66791071 * SCALE)


@pytest.mark.parametrize(
    ("call", "error", "sentence"),
    [
        (lambda: forced_response(BEAM, 6.0, TipForce(amplitude=1.0), [3.0, 3.1, 4.0]), ValueError,
         "lag 1 is at 3.7304 rad/s: take blade.with_damping"),
        (lambda: forced_response(by_mass(0.1), [3.0, 4.0], Gravity(), [3.0, 4.0]), ValueError,
         "gravity goes around once a turn, at ω itself: give the speeds as omega"),
        (lambda: forced_response(by_mass(0.1), 6.0, TipForce(amplitude=1.0, frequency=2.0),
                                 [3.0, 4.0]), ValueError, "leave it out of the load"),
        (lambda: forced_response(by_mass(0.1), 6.0, TipForce(amplitude=1.0), [4.0, 3.0]),
         ValueError, "above 0 and ascending"),
        (lambda: forced_response(by_mass(0.1), 6.0, 3.0, [3.0, 4.0]), TypeError, "a PointLoad"),
        (lambda: forced_response(BEAM, [3.0, 3.1, 3.5], Gravity()), ValueError,
         "meets 1 times the speed"),
        (lambda: Damping(bending=-0.1), ValueError, "damping takes energy, it gives none"),
        (lambda: periodic_orbits(by_mass(0.1), 6.0, [0.1]), ValueError,
         "no free periodic orbits: take forced_response for the damped blade"),
        (lambda: reduced_model(by_mass(0.1), 6.0, "FrM"), ValueError, "damping"),
    ],
)  # fmt: skip
def test_bad_input_is_one_sentence(call, error, sentence):
    with pytest.raises(error, match=sentence):
        call()


def test_a_steeply_set_blade_leans_on_the_backbone_of_its_plane():
    """In the frame of the clamp its first mode is flap."""
    blade = by_mass(0.2).with_setting_angle(1.2)
    found = forced_response(blade, 1.0, TipForce(amplitude=1e-3), [3.0, 4.0], functions=8)
    assert found.backbone.mode == "flap 1"
    assert found.backbone.omega_n == pytest.approx(linear_modes(blade, 1.0, 1).frequencies[0])


def test_what_does_not_excite_leaves_the_blade_at_rest():
    """A ripple of the speed has no force across a blade that flaps."""
    blade = by_mass(0.01).with_setting_angle(0.5 * np.pi)
    found = forced_response(blade, 6.0, SpeedRipple(amplitude=0.01), [5.0, 8.0])
    assert found.amplitude.max() < 1e-12
    assert str(found).startswith("Response to a ripple of 0.01 rad/s: ")


def test_a_load_without_resonance_needs_no_damping():
    found = forced_response(BEAM, 6.0, TipForce(amplitude=0.5), [1.0, 2.0])
    assert not found.folds
    assert found.amplitude[-1] > found.amplitude[0]


def test_a_response_that_leaves_the_reach_is_kept_as_far_as_it_goes():
    with warnings.catch_warnings(), pytest.raises(ResponseNotReachedError) as caught:
        warnings.simplefilter("error")
        forced_response(
            by_mass(1e-4), 6.0, TipForce(amplitude=5.0), [3.0, 4.0],
            theory=Theory(extension=False), functions=8,
        )  # fmt: skip
    assert caught.value.part.amplitude.max() > 0.5
    assert "take more damping" in str(caught.value)


SPACE = BEAM.with_section_out_of_plane(0.0625, 0.08).with_damping(
    Damping(external=0.3, bending=1e-3)
)
FOLLOWING = PointLoad(force=(0.0, 2.0, 1.0), moment=(0.5, 0.0, 0.0), position=5.0, following=True)


@pytest.mark.parametrize(
    ("omega", "load", "frequencies"),
    [
        ([7.0, 7.4], Gravity(9.81, tilt=0.1), None),
        pytest.param(5.0, FOLLOWING, [5.5, 5.6], marks=pytest.mark.slow),
    ],
    ids=["tilted gravity", "what follows the sections"],
)
def test_a_turn_of_time_integration_comes_back_to_the_orbit_in_space(omega, load, frequencies):
    found = forced_response(SPACE, omega, load, frequencies, gauge="flap", functions=6)
    first, w = found.frequency[0], found.omega[0]
    times = np.array([0.0, 0.5, 1.0]) * 2.0 * math.pi / first
    acting = load if frequencies is None else replace(load, frequency=first)
    tip = spin_up_response(
        SPACE, SteadyRotation(omega=w), times, loads=[acting],
        start=lambda x: found.state(0, x), tolerance=1e-5,
    ).tip  # fmt: skip
    assert tip[2] == pytest.approx(tip[0], abs=1e-6)
    assert abs(tip[1, 2] - tip[0, 2]) > 1e-2  # it moves


def test_a_force_by_its_components_or_by_a_table_is_that_of_its_kind():
    at = [3.0, 3.2]
    one = forced_response(SPACE, 6.0, TipForce(amplitude=0.3), at, functions=8)
    other = forced_response(SPACE, 6.0, PointLoad(force=(0.0, 0.3, 0.0)), at, functions=8)
    assert other.amplitude[other.at(3.2)] == pytest.approx(one.amplitude[one.at(3.2)], rel=1e-9)


def test_a_table_over_time_has_no_frequency_to_vary():
    over_time = LoadTable(x=[0.0, 8.0], force=np.zeros((2, 2, 3)), time=[0.0, 1.0])
    with pytest.raises(TypeError, match="has none: take spin_up_response"):
        forced_response(SPACE, 6.0, over_time, [3.0, 3.2])
