"""Exudyn in three dimensions: elements, runs, and what leaves the plane of rotation."""

import numpy as np
import pytest
import xarray as xr
from scipy.spatial.transform import Rotation

from analytic import (
    Beam,
    Rectangle,
    SpinUp,
    SteadyRotation,
    Tube,
    linear_modes,
    periodic_orbits,
)
from analytic.exact.continuum.state import BladeState
from rotbeam_exu import kicked, natural_frequencies, simulate
from rotbeam_exu.fem.columns import twist
from rotbeam_exu.fem.elements import SpaceExact
from rotbeam_exu.fem.elements.node_kinds import FrameNodes, directors
from rotbeam_exu.runs.check import energy_drift

ALIKE = Beam.reference().with_section_out_of_plane(bending_ratio=1.0)
RECTANGLE = Beam.reference().with_shape(Rectangle())
TUBE = Beam.reference().with_shape(Tube(radius=0.015, wall=0.00077))


def test_rates_of_a_state_are_those_of_its_coordinates():
    rng = np.random.default_rng(5)
    place, velocity, spin = rng.standard_normal((3, 4, 3))
    first = Rotation.random(4, random_state=6)

    def at(t):
        section = (Rotation.from_rotvec(t * spin) * first).as_matrix()
        return BladeState(
            place=place + t * velocity, velocity=velocity, slope=section[:, :, 0],
            slope_rate=np.cross(spin, section[:, :, 0]), section=section, spin=spin,
        )  # fmt: skip

    def coordinates(t):
        return FrameNodes().coordinates(at(t))

    _, rate = coordinates(0.0)
    difference = (coordinates(1e-6)[0] - coordinates(-1e-6)[0]) / 2e-6
    np.testing.assert_allclose(rate, difference, atol=1e-9)
    np.testing.assert_allclose(directors(coordinates(0.0)[0][:, 3:]), at(0.0).section, atol=1e-14)


def test_twist_is_the_angle_about_the_tangent():
    p = np.array([np.cos(0.15), np.sin(0.15), 0.0, 0.0])
    at = np.zeros((1, 2, 7))
    at[:, :, 3:] = p
    turned = SpaceExact().turned(at, np.array([1.2]))
    sections = SpaceExact().sections(turned)[:, -1]
    np.testing.assert_allclose(twist(sections), 0.3, rtol=1e-14)


@pytest.mark.parametrize("omega", [0.0, 6.0])
def test_frequencies_of_the_cable_in_space(omega, fitted_order):
    """Lag and flap of a blade that bends alike in both planes, the lowest three of each."""
    exact = np.sort([linear_modes(ALIKE, omega, 3, only=p).frequencies for p in ("lag", "flap")])
    exact = np.sort(exact.ravel())
    meshes = [8, 16, 32]
    errors = [
        natural_frequencies(ALIKE, omega, element="space_cable", elements=n, count=6) / exact - 1.0
        for n in meshes
    ]
    assert np.abs(errors[-1]).max() < 1e-5
    # Cubic elements: with the fourth power.
    assert -fitted_order(meshes, [error[0] for error in errors]) == pytest.approx(4.0, abs=0.1)


def test_without_a_kick_the_cable_in_space_is_the_cable_in_its_plane():
    spin_up = SpinUp(omega=6.0, ramp_time=1.0)
    settings = {"elements": 4, "duration": 2.0, "step": 5e-3}
    planar = simulate(Beam.reference(), spin_up, **settings)
    space = simulate(ALIKE, spin_up, element="space_cable", **settings)
    assert np.array_equal(space["w"], np.zeros(space["time"].size))
    for name in set(planar.data_vars):
        scale = np.abs(planar[name]).max().item()
        # Newton's tolerance on either side; residuals are zero but for round-off.
        assert np.abs(space[name] - planar[name]).max() < 1e-7 * scale + 1e-11, name


def test_energy_and_both_frames():
    orbit = periodic_orbits(ALIKE, 2.0, [0.3])
    runs = [
        simulate(
            ALIKE, SteadyRotation(omega=2.0), element="space_cable", elements=4, duration=2.0,
            step=5e-3, frame=frame, initial_state=kicked(ALIKE, 1e-3, lambda x: orbit.state(0, x)),
        )
        for frame in ("inertial", "rotating")
    ]  # fmt: skip
    # Steps of 5 ms err by (ωh)²/12 = 7e-4 in the second flap mode, of which the kick has a tenth:
    # after two seconds and 36 rad that is 3e-3.
    assert np.abs(runs[0]["w"] - runs[1]["w"]).max() < 1e-2 * np.abs(runs[0]["w"]).max()
    assert max(energy_drift(run)[0] for run in runs) < 1e-4


def test_drift_of_the_geometrically_exact_beam_is_that_of_the_step():
    orbit = periodic_orbits(TUBE, 2.0, [0.3])
    drifts = [
        energy_drift(
            simulate(
                TUBE, SteadyRotation(omega=2.0), element="space_exact", elements=4, duration=1.0,
                step=step, initial_state=kicked(TUBE, 1e-6, lambda x: orbit.state(0, x)),
            )
        )[0]
        for step in (1e-2, 5e-3)
    ]  # fmt: skip
    # Of second order: whatever the kinetic or elastic energy missed would stay.
    assert drifts[0] / drifts[1] == pytest.approx(4.0, rel=0.1)


def growth_rate_of(run, period):
    """Return the rate [1/s] of the envelope out of the plane, and over how many powers of ten.

    The envelope is the root mean square of w and w_dot/Ω over a period of the planar orbit; what
    its logarithm gains in whole periods is averaged over the last three powers of ten up to L/100.
    """
    time, length = run["time"].to_numpy(), run.attrs["blade_length"]
    w, w_dot = (run[name].to_numpy() / length for name in ("w", "w_dot"))
    squares = w**2 + (w_dot * period / (2.0 * np.pi)) ** 2
    steps = 0.5 * np.diff(time) * (squares[1:] + squares[:-1])
    # Sums of positive numbers over many decades: each window anew, not as a difference of two.
    ends = np.searchsorted(time, time + period)
    starts = np.flatnonzero(ends < time.size)
    envelope = np.sqrt([steps[i : ends[i]].sum() / period for i in starts])
    above = np.flatnonzero(envelope > 1e-2)
    end = above[0] if above.size else envelope.size
    logarithm, time = np.log(envelope[:end]), time[:end]
    start = np.flatnonzero(logarithm >= logarithm[-1] - 3.0 * np.log(10.0))[0]
    # Within a period the envelope of a growing motion is no straight line.
    lag = max(1, int(0.5 * (time[-1] - time[start]) / period)) * period
    later = np.interp(time[start:] + lag, time, logarithm, right=np.nan)
    rate = np.nanmean(later - logarithm[start:]) / lag
    return rate, (logarithm[-1] - logarithm[start]) / np.log(10.0)


@pytest.mark.parametrize("rate", [0.9, 0.3, -0.2])
def test_rate_of_a_known_growth(rate):
    time = np.linspace(0.0, 12.0, 4001)
    w = 8e-6 * np.exp(rate * time) * np.cos(3.1 * time)
    columns = {"w": ("time", w), "w_dot": ("time", np.gradient(w, time))}
    run = xr.Dataset(columns, {"time": time}, {"blade_length": 8.0})
    found, decades = growth_rate_of(run, 2.0 * np.pi / 10.0)
    # A window of a period that is not w's own leaves ripples, over the three decades 2 %.
    assert found == pytest.approx(rate, rel=0.02)
    if rate == 0.9:
        assert decades == pytest.approx(3.0, abs=0.01)


def run_on_an_orbit(blade, omega, amplitude, periods, element="space_exact", **settings):
    """Return a run from the planar orbit, over a number of its periods."""
    orbit = periodic_orbits(blade, omega, [amplitude])
    steps = round(periods * 2.0 * np.pi / orbit.frequency[0] / settings["step"])
    return simulate(
        blade, SteadyRotation(omega=omega), element=element, duration=steps * settings["step"],
        initial_state=kicked(blade, 1e-6, lambda x: orbit.state(0, x)), **settings,
    )  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize(
    ("blade", "omega", "amplitude", "settings"),
    [
        (RECTANGLE, 2.0, 0.02, {"elements": 16}),
        (TUBE, 2.0, 0.5, {"elements": 8}),
        (ALIKE, 4.35 * ALIKE.frequency_scale, 0.5, {"element": "space_cable", "elements": 16}),
        (ALIKE, 4.48 * ALIKE.frequency_scale, 0.5, {"element": "space_cable", "elements": 16}),
    ],
    ids=["rectangle below its limit", "tube", "cable below its tongue", "cable above it"],
)
@pytest.mark.filterwarnings("ignore:internal resonance:analytic.input_checks.RotbeamWarning")
def test_a_stable_plane_keeps_a_kick_for_fifty_periods(blade, omega, amplitude, settings):
    run = run_on_an_orbit(blade, omega, amplitude, 50, step=1e-2, **settings)
    assert np.abs(run["w"]).max() < 1e-5 * blade.length


@pytest.mark.slow
def test_an_unstable_rectangle_grows_as_theory_says():
    """At 2 rad/s from 0.0294 L on; at 0.045 L one mode leads, by 18 a period.

    Three powers of ten take 2.4 periods, and the kick needs one to become that mode.
    """
    stability = periodic_orbits(RECTANGLE, 2.0, [0.045]).out_of_plane()
    rates = []
    for elements in (32, 64):
        run = run_on_an_orbit(RECTANGLE, 2.0, 0.045, 4.0, elements=elements, step=5e-3)
        rate, decades = growth_rate_of(run, 2.0 * np.pi / stability.frequency[0])
        assert decades > 2.95
        rates.append(rate)
    assert rates == pytest.approx([stability.growth_rate[0]] * 2, rel=0.1)
    # Linear elements: of second order, so that both meshes together tell the limit.
    assert (4.0 * rates[1] - rates[0]) / 3.0 == pytest.approx(stability.growth_rate[0], rel=0.01)


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore:internal resonance:analytic.input_checks.RotbeamWarning")
@pytest.mark.parametrize(("amplitude", "w_bar", "periods"), [(0.5, 4.42, 1400), (0.7, 4.36, 340)])
def test_the_cable_grows_inside_its_tongue(amplitude, w_bar, periods):
    """Three quarters of an hour of the blade's time for three powers of ten at half its length.

    Steps of 5 ms move the tongue, 0.025 wide, by 0.0016; 10 ms by four times as much, and then
    the motion grows by a sixth too slowly.
    """
    omega = w_bar * ALIKE.frequency_scale
    stability = periodic_orbits(ALIKE, omega, [amplitude]).out_of_plane()
    settings = {"element": "space_cable", "elements": 8, "step": 5e-3}
    run = run_on_an_orbit(ALIKE, omega, amplitude, periods, **settings)
    rate, decades = growth_rate_of(run, 2.0 * np.pi / stability.frequency[0])
    assert decades > 2.95
    assert rate == pytest.approx(stability.growth_rate[0], rel=0.03)
