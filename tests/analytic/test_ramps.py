"""Changes of the speed: Eq. 1, their own consistency, their limits; the exact beam under them."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.interpolate import CubicSpline

from analytic import (
    FourierRamp,
    Gravity,
    SpeedTable,
    SpinUp,
    SteadyRotation,
    Theory,
    linear_modes,
    spin_up_response,
)

WAVES = {"cosines": (-0.9, -0.3, 0.2), "sines": (0.3, 0.0, -0.1)}
RAMPS = {
    "spin-up": SpinUp(omega=6.0, ramp_time=3.0),
    "Eq. 1": FourierRamp(omega=6.0, ramp_time=3.0),
    "waves": FourierRamp(start=2.0, omega=5.0, ramp_time=3.0, **WAVES),
    "down": FourierRamp(start=6.0, omega=0.0, ramp_time=3.0, **WAVES),
    "table": SpeedTable([0.0, 0.4, 1.5, 2.0, 3.0], [1.0, 1.5, 4.0, 3.0, 5.0]),
}
TIMES = np.linspace(-0.5, 4.0, 9001)


@given(st.floats(0.1, 20.0), st.floats(0.1, 20.0), st.floats(0.0, 3.0))
def test_angle_is_equation_1(omega, ramp_time, share):
    t = share * ramp_time
    printed = (
        omega
        / ramp_time
        * (t**2 / 2 + ramp_time**2 / (4 * math.pi**2) * (math.cos(2 * math.pi * t / ramp_time) - 1))
        if t < ramp_time
        else omega * (t - ramp_time / 2)
    )
    # The print loses digits to 1 - cos; relative to its larger terms it is exact.
    assert SpinUp(omega=omega, ramp_time=ramp_time).angle(t) == pytest.approx(
        printed, abs=1e-14 * omega * (t + ramp_time)
    )


def test_largest_acceleration_is_twice_the_mean():
    """The speed's derivatives and its two ends are tested with the other ramps."""
    spin_up = SpinUp(omega=6.0, ramp_time=3.0)
    assert spin_up.angle(3.0) == pytest.approx(9.0)
    t = np.linspace(0.0, 3.0, 30001)
    assert spin_up.acceleration(t).max() == pytest.approx(2.0 * 6.0 / 3.0)


def test_steady_rotation_is_a_spin_up_long_past():
    steady, spin_up = SteadyRotation(omega=6.0), SpinUp(omega=6.0, ramp_time=3.0)
    t = np.array([4.0, 5.5])
    assert np.allclose(np.diff(steady.angle(t)), np.diff(spin_up.angle(t)))
    assert np.allclose(steady.rate(t), spin_up.rate(t), rtol=1e-15)
    assert np.allclose(steady.acceleration(t), spin_up.acceleration(t), atol=1e-30)


@pytest.mark.parametrize("ramp", RAMPS.values(), ids=RAMPS)
def test_rate_and_acceleration_are_the_derivatives(ramp):
    angle = CubicSpline(TIMES, ramp.angle(TIMES))
    inside = slice(5, -5)
    # Cubics on steps of 5e-4 s.
    assert ramp.rate(TIMES)[inside] == pytest.approx(angle(TIMES, 1)[inside], abs=1e-6)
    rate = CubicSpline(TIMES, ramp.rate(TIMES))
    # A table's acceleration has kinks, which a cubic rounds off by a share of slope times step.
    near = 2e-3 if isinstance(ramp, SpeedTable) else 1e-5
    assert ramp.acceleration(TIMES)[inside] == pytest.approx(rate(TIMES, 1)[inside], abs=near)


@pytest.mark.parametrize("ramp", RAMPS.values(), ids=RAMPS)
def test_speed_has_two_derivatives_at_both_ends(ramp):
    for end, speed in ((0.0, ramp.start), (ramp.ramp_time, ramp.omega)):
        assert ramp.rate(end) == pytest.approx(speed, abs=1e-12)
        assert ramp.acceleration(end) == pytest.approx(0.0, abs=1e-11)
        # Linear in the distance from the end where there is a jerk, as a table has.
        near, nearer = (abs(ramp.acceleration(end + s * h)) for h in (1e-3, 5e-4)
                        for s in ((1.0,) if end == 0.0 else (-1.0,)))  # fmt: skip
        assert nearer < (0.51 if isinstance(ramp, SpeedTable) else 0.3) * near
    assert ramp.angle(0.0) == 0.0
    assert ramp.rate(-1.0) == pytest.approx(ramp.start)
    assert ramp.rate(99.0) == pytest.approx(ramp.omega)


@pytest.mark.parametrize("ramp", RAMPS.values(), ids=RAMPS)
def test_one_time_is_as_many(ramp):
    for of in (ramp.angle, ramp.rate, ramp.acceleration):
        assert isinstance(of(1.3), float)
        assert of(1.3) == pytest.approx(of(np.array([0.2, 1.3]))[1], rel=1e-14)


def test_one_wave_is_eq_1():
    spin_up, ramp = SpinUp(omega=6.0, ramp_time=3.0), RAMPS["Eq. 1"]
    for name in ("angle", "rate", "acceleration"):
        assert getattr(ramp, name)(TIMES) == pytest.approx(getattr(spin_up, name)(TIMES), abs=1e-13)


def test_table_converges_with_the_third_power(spin_up, fitted_order):
    counts = np.array([25, 50, 100, 200])
    at = np.linspace(0.0, 3.0, 5001)
    errors = [
        np.abs(SpeedTable(t, spin_up.rate(t)).rate(at) - spin_up.rate(at)).max()
        for t in (np.linspace(0.0, 3.0, n + 1) for n in counts)
    ]
    assert fitted_order(1.0 / counts, errors) == pytest.approx(3.0, abs=0.2)


@pytest.mark.parametrize(
    ("times", "speeds"),
    [
        ([0.0, 0.1, 0.2, 3.0], [0.0, 0.0, 5.9, 6.0]),  # a step as one measures it
        ([0.0, 1.0, 1.01, 2.0, 4.0], [6.0, 6.0, 0.0, 0.0, 3.0]),  # a brake, then on
        (np.linspace(0.0, 3.0, 301), np.clip(4.0 * np.linspace(0.0, 3.0, 301), 0.0, 6.0)),
    ],
    ids=["step", "brake", "corner"],
)
def test_a_table_stays_between_its_speeds(times, speeds):
    table = SpeedTable(times, speeds)
    for start, end, before, after in zip(
        times[:-1], times[1:], speeds[:-1], speeds[1:], strict=True
    ):
        inside = table.rate(np.linspace(start, end, 101))
        # But for round-off of the largest speed.
        assert inside.min() >= min(before, after) - 1e-14 * max(speeds)
        assert inside.max() <= max(before, after) + 1e-14 * max(speeds)
    assert table.fastest == max(speeds)
    # The acceleration is continuous, and zero at both ends.
    knots, near = np.array(times)[1:-1], 1e-9
    jumps = table.acceleration(knots + near) - table.acceleration(knots - near)
    assert np.abs(jumps).max() < 1e-5 * np.abs(table.acceleration(np.linspace(0, 4, 999))).max()
    assert table.acceleration(np.array([0.0, times[-1]])) == pytest.approx(0.0, abs=1e-12)


def test_fastest_sees_what_is_above_both_ends():
    over = FourierRamp(start=2.0, omega=3.0, ramp_time=1.0, cosines=(-1.0,), sines=(4.0, -2.0))
    assert over.fastest == pytest.approx(over.rate(np.linspace(0.0, 1.0, 9999)).max(), rel=1e-6)
    assert over.fastest > 3.0


@pytest.mark.parametrize(
    ("make", "sentence"),
    [
        (lambda: FourierRamp(omega=1.0, ramp_time=1.0, cosines=(-1.0, 0.2)), "by -0.2$"),
        (lambda: FourierRamp(omega=1.0, ramp_time=1.0, sines=(0.0, 0.2)), "by -0.4 over its k"),
        (lambda: FourierRamp(omega=1.0, ramp_time=0.0), "ramp_time must be positive"),
        (lambda: SpinUp(omega=6.0, ramp_time=-2.0), "ramp_time must be positive, got -2.0 s"),
        (lambda: SpinUp(omega=math.nan, ramp_time=3.0), "omega must be finite, got nan rad/s"),
        (lambda: SpinUp(omega=-6.0, ramp_time=3.0), "omega must not be negative, .* mirror image"),
        (lambda: FourierRamp(omega=1.0, ramp_time=1.0, start=-1.0), "start must not be negative"),
        (lambda: SpeedTable([0.0, 1.0], [1.0]), "got 2 times and 1 speeds"),
        (lambda: SpeedTable([1.0, 2.0], [1.0, 2.0]), "begin at 0 s, got 1 s: subtract it"),
        (lambda: SpeedTable([0.0, 2.0, 1.0], [1.0, 2.0, 3.0]), "1 s comes after 2 s"),
        (lambda: SpeedTable([0.0, 2.0], [1.0, -2.0]), "speeds must not be negative"),
    ],
)
def test_bad_input(make, sentence):
    with pytest.raises(ValueError, match=sentence):
        make()


@pytest.mark.slow  # its convergence is tested above, and Exudyn agrees
def test_a_table_drives_the_exact_beam_as_what_it_tabulates(beam, spin_up):
    times = np.linspace(0.0, 4.0, 81)
    one = spin_up_response(beam, spin_up, times, tolerance=1e-6)
    off = []
    for intervals in (50, 100):
        at = np.linspace(0.0, 3.0, intervals + 1)
        table = spin_up_response(beam, SpeedTable(at, spin_up.rate(at)), times, tolerance=1e-6)
        off.append(np.abs(table.q - one.q).max() / beam.length)
    # What the docstring says of a hundred; and the third power, or better, on the way there.
    assert off[1] < 1e-6
    assert off[0] / off[1] > 8.0


def test_what_turns_already_is_stretched_and_stays_so(beam):
    """A change of the speed so slow that it hardly bends: stretched as by Eq. 67 all the time."""
    ramp = FourierRamp(start=6.0, omega=6.0 + 1e-6, ramp_time=1.0)
    times = np.linspace(0.0, 2.0, 21)
    response = spin_up_response(beam, ramp, times, tolerance=1e-3)
    k = 6.0 * np.sqrt(beam.density / beam.youngs_modulus)
    stretched = np.tan(k * beam.length) / k
    assert np.hypot(*response.tip.T) == pytest.approx(stretched, rel=1e-9)


def test_a_slow_change_of_the_speed_is_quasi_static(beam):
    """The deflection is the acceleration's: v = -θ''·(K - w²M)⁻¹∫xφ, linear; it leads."""
    motion = FourierRamp(start=0.3, omega=0.1, ramp_time=60.0)
    response = spin_up_response(beam, motion, [30.0], tolerance=1e-6)
    modes = linear_modes(beam, motion.rate(30.0), 8, theory=Theory(extension=False))
    x = np.linspace(0.0, 1.0, 4001)
    shapes = modes.shapes(x * beam.length)[1].real
    loads = np.trapezoid(x[:, None] * shapes, x, axis=0) / np.trapezoid(shapes**2, x, axis=0)
    static = -motion.acceleration(30.0) * beam.length * np.sum(loads / modes.frequencies**2)
    assert static > 0.0
    assert response.q[0] == pytest.approx(static, rel=5e-3)  # (ω_1 T/2π)⁻² is 1e-3


def test_gravity_on_a_blade_that_turns_already(beam):
    """A load acts from t = 0 on, whatever the speed then: free fall for an instant."""
    ramp = FourierRamp(start=1.0, omega=2.0, ramp_time=5.0)
    t = 0.01
    q = spin_up_response(beam, ramp, [t], tolerance=1e-4, loads=(Gravity(9.81),)).q[0]
    assert q == pytest.approx(-0.5 * 9.81 * t**2, rel=2e-2)  # bending waves are 0.1 L long by then
