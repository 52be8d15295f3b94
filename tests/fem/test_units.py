"""The answer does not depend on the units, nor on the size, stiffness or mesh of the beam."""

import math

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from analytic import Beam, SpinUp, linear_modes, spin_up_response
from rotbeam_exu import natural_frequencies, simulate
from rotbeam_exu.fem.units import Units
from rotbeam_exu.runs.check import checked_steps
from tests.beams import REED

STEEL_BAR = Beam(
    length=2.0, area=2.5e-3, second_moment=5.2083e-7, youngs_modulus=2.1e11, density=7850.0
)
BLADE = Beam.from_stiffness(
    length=60.0, axial_stiffness=2e9, bending_stiffness=2e8, mass_per_length=200.0
)


def slender(mu):
    """The paper's beam with another axial stiffness."""
    paper = Beam.reference()
    return Beam.from_stiffness(
        length=paper.length, axial_stiffness=paper.bending_stiffness / (mu * paper.length**2),
        bending_stiffness=paper.bending_stiffness, mass_per_length=paper.mass_per_length,
    )  # fmt: skip


def spun_up(beam, speed_ratio, steps=2000, **options):
    """Spin up to Ω in nine units of time, and on to twelve: q/L on a grid of its own."""
    second = 1.0 / beam.frequency_scale
    run = simulate(
        beam, SpinUp(omega=speed_ratio * beam.omega_0, ramp_time=9.0 * second),
        duration=12.0 * second, step=12.0 * second / steps, **options,
    )  # fmt: skip
    assert run.attrs["verdict"] == "passed"
    return run["q"].to_numpy() / beam.length


@pytest.mark.parametrize(
    ("beam", "speed_ratio", "frame"),
    [
        (STEEL_BAR, 1.5, "inertial"), (BLADE, 1.5, "rotating"), (REED, 0.5, "rotating"),
        (slender(1e-2), 0.5, "rotating"),
    ],
    ids=["bar", "blade", "reed", "stout"],
)  # fmt: skip
def test_real_beams_of_any_size_follow_the_exact_one(beam, speed_ratio, frame):
    q = spun_up(beam, speed_ratio, elements=8, frame=frame)
    second = 1.0 / beam.frequency_scale
    exact = spin_up_response(
        beam, SpinUp(omega=speed_ratio * beam.omega_0, ramp_time=9.0 * second),
        np.linspace(0.0, 12.0 * second, q.size), tolerance=1e-4,
    )  # fmt: skip
    # Eight cables and a step of 6e-3 units of time: the mesh leaves 1e-4, the step half of it.
    assert np.abs(q - exact.q / beam.length).max() < 5e-4 * np.abs(q).max()


POWERS = st.floats(-9.0, 9.0)


@pytest.mark.filterwarnings("ignore:.* makes sound go:analytic.RotbeamWarning")
@settings(
    max_examples=settings().max_examples // 4, derandomize=True,
    suppress_health_check=[HealthCheck.too_slow],
)  # fmt: skip
@given(st.floats(-6.0, 6.0), POWERS, POWERS, st.floats(-7.0, -3.0), st.booleans())
def test_q_over_length_is_the_same_in_any_units(length, mass, time, mu, inertial):
    beam, frame = slender(10.0**mu), "inertial" if inertial else "rotating"
    other = beam.in_units(10.0**length, 10.0**mass, 10.0**time)
    here, there = (spun_up(b, 1.2, steps=600, elements=4, frame=frame) for b in (beam, other))
    # Forces of the size EA cancel to EI/L²: what is left of double precision.
    assert np.abs(here - there).max() < 1e-9 + 1e-15 / 10.0**mu
    ratio = [
        natural_frequencies(b, 1.2 * b.omega_0, elements=4, count=1)[0] / b.frequency_scale
        for b in (beam, other)
    ]
    assert ratio[0] == pytest.approx(ratio[1], rel=1e-9)


@pytest.mark.parametrize("element", ["cable", "exact"])
def test_slenderness_hardly_matters(element):
    """As μ → 0 the response settles; so stiff an axis must neither stop nor bend the solver."""
    stiff, stiffer, stiffest = (
        spun_up(slender(mu), 1.2, steps=800, elements=4, element=element, frame="rotating")
        for mu in (1e-6, 1e-8, 1e-10)
    )
    # Extensibility shifts λ_ω by 5 μ; an element of the exact beam is 2e-3 softer at 1e-6.
    assert np.abs(stiff - stiffest).max() < {"cable": 2e-4, "exact": 3e-3}[element]
    # Round-off of the axial force, 1e-14 × 4/μ in EI/L², for 12 units of time.
    assert np.abs(stiffer - stiffest).max() < 2e-4


@pytest.mark.parametrize("mu", [1e-2, 1e-6, 1e-10])
def test_natural_frequencies_of_any_slenderness(mu):
    beam = slender(mu)
    omega = min(6.0, 0.5 * beam.burst_speed)
    exact = linear_modes(beam, omega, 1).frequencies[0]
    # Mesh of 16: 4e-5.
    assert natural_frequencies(beam, omega, count=1)[0] == pytest.approx(exact, rel=1e-4)


@pytest.mark.parametrize(("duration", "step"), [(3600.0, 0.04), (2000.0, 5e-3)])
def test_long_runs_keep_every_sample(beam, duration, step):
    """Sums of such steps are not exact in seconds; in units of a power of two of them they are."""
    units = Units.of(beam, step)
    own = step / units.time
    assert math.frexp(own)[0] == 0.5
    steps = round(duration / step)
    assert np.cumsum(np.full(steps, own))[-1] == steps * own


def test_samples_follow_the_period():
    """A reed of 1133 rad/s is sampled like the paper's beam: 200 times a period at least."""
    _, every = checked_steps(REED, 1000.0, ramp_time=0.006, duration=0.03, step=1e-5)
    period = 2.0 * math.pi / linear_modes(REED, 1000.0, 1).frequencies[0]
    assert 200 <= period / (every * 1e-5) < 600


def test_a_short_ramp_is_followed(beam):
    """A ramp of thirty steps leaves what the exact beam keeps of it, not 1e-9 of that."""
    step, spin_up = 4e-3, SpinUp(omega=0.5, ramp_time=0.12)
    for frame in ("inertial", "rotating"):
        run = simulate(beam, spin_up, elements=4, duration=1.0, step=step, frame=frame)
        exact = spin_up_response(beam, spin_up, run["time"].to_numpy(), tolerance=1e-3)
        assert np.abs(run["q"] - exact.q).max() < 2e-2 * np.abs(exact.q).max()
