"""Each of the usual mistakes, planted into the exact answer, is named; what is right has none."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from analytic import Blade, FourierRamp, SpeedTable, SpinUp, linear_modes, spin_up_response
from analytic.exact.continuum.state import Driven
from rotbeam_exu.verification.cases import CASES
from rotbeam_exu.verification.convergence import converged
from rotbeam_exu.verification.judgement import judged
from rotbeam_exu.verification.mistakes import mistakes_in, most_left
from rotbeam_exu.verification.mistakes.forces import FORCES, Lacking, without
from rotbeam_exu.verification.mistakes.histories import RAMPS, mistake_in_history
from rotbeam_exu.verification.mistakes.tables import mistake_in_table
from rotbeam_exu.verification.outcomes import finding_of
from rotbeam_exu.verification.references import reference
from rotbeam_exu.verification.submission import (
    Declaration,
    Row,
    Run,
    Submission,
)
from rotbeam_exu.verification.verify import verify

S1 = replace(CASES["S1"], duration=6.0)
TIME = np.arange(0.0, 6.0, 0.02)
LENGTH = S1.blade.length


def response(motion, time=TIME, tolerance=1e-4):
    return spin_up_response(S1.blade, motion, time, tolerance=tolerance)


@pytest.fixture(scope="module")
def exact():
    return response(S1.motion)


@pytest.fixture
def named(exact):
    """Return a function that names the mistake in a history; its mesh has errors of its own."""

    def name(q, time=TIME, **options):
        q = q * (1.0 + 2e-3 * np.sin(5.0 * time))
        found = mistake_in_history(S1, time, q, exact.q[: time.size], **options)
        return None if found is None else found.name

    return name


def test_a_right_history_has_none(named, exact):
    assert named(exact.q) is None


def test_factors(named, exact):
    assert named(-exact.q) == "sign of q"
    assert named(exact.q / LENGTH) == "q over L"
    assert named(1e3 * exact.q) == "millimetres"


def test_an_axis_that_does_not_turn(named, exact):
    """The tip's height in the inertial frame, and its displacement across the turned beam there."""
    assert named(exact.from_axis[:, 1]) == "inertial axis"
    assert named(exact.from_axis[:, 1] - LENGTH * np.sin(S1.motion.angle(TIME))) == "inertial axis"


FINE = np.linspace(0.0, 1.0, 41)
SHARES = dict(
    zip(RAMPS, (FINE, np.sin(0.5 * np.pi * FINE) ** 2, FINE**2 * (3.0 - 2.0 * FINE)), strict=True)
)
"""Rates over ω of the wrong ramps, in their order."""


def ramp(name, omega, ramp_time):
    return SpeedTable(ramp_time * FINE, omega * SHARES[name])


@pytest.mark.parametrize("name", RAMPS)
def test_another_ramp(named, name):
    time = TIME[TIME <= 3.0]
    q = response(ramp(name, 6.0, 3.0), time, 1e-2).q
    assert named(q, time) == name


def test_a_ramp_that_is_not_that_of_eq_1_is_not_told_to_be():
    other = replace(S1, motion=FourierRamp(omega=6.0, ramp_time=3.0, cosines=(-1.2, 0.2)))
    time = TIME[TIME <= 3.0]
    wrong = response(ramp(next(iter(RAMPS)), 6.0, 3.0), time, 1e-2).q
    found = mistake_in_history(other, time, wrong, response(other.motion, time, 1e-3).q)
    assert found is None


@pytest.mark.parametrize("force", FORCES)
def test_a_force_that_is_left_out(named, force):
    q = without(force, S1, TIME)
    assert named(q) == force
    if force != "no Euler force":  # without which nothing bends the blade
        assert np.ptp(q[S1.ramp_time < TIME]) > 0.1 * np.ptp(q)  # it swings on after the ramp


@pytest.fixture(params=["S1", "S1+h"])
def work(request):
    """Return coordinates, their rates, and a function: the work of a force, that of the rest."""
    case, model = CASES[request.param], Lacking(CASES[request.param], {(1.0, 1.0): 1.0})
    rng = np.random.default_rng(1)
    q, q_dot, q_ddot = 0.1 * rng.standard_normal((3, 1, model.size))

    def of(force, by, rates=q_dot):
        lacking = Lacking(case, FORCES[force][1]).residual(q, rates, q_ddot, by)
        return (model.residual(q, rates, q_ddot, by) - lacking)[0], lacking[0]

    return model, q, q_dot, of


def test_the_coriolis_force_is_gyroscopic(work):
    """It does no work on the motion, grows with the motion, and leaves nothing odd in the rate."""
    _, _, q_dot, of = work
    force, rest = of("no Coriolis force", Driven(2.0, 0.7))
    assert abs(q_dot[0] @ force) < 1e-12 * np.abs(q_dot[0]) @ np.abs(force)
    assert of("no Coriolis force", Driven(2.0, 0.7), 3.0 * q_dot)[0] == pytest.approx(3.0 * force)
    assert of("no Coriolis force", Driven(-2.0, 0.7))[1] == pytest.approx(rest, rel=1e-12)


def test_the_centrifugal_force_has_a_potential(work):
    """It is the gradient of -½ w² ∫ r² dm, whatever the motion; by central differences."""
    model, q, _, of = work
    force, _ = of("no centrifugal force", Driven(2.0, 0.7))
    change = 1e-4 * np.eye(model.size)
    potential = [
        model.amended_potential(q + sign * change, 2.0)
        - model.amended_potential(q + sign * change, 0.0)
        for sign in (1, -1)
    ]
    gradient = (potential[0] - potential[1]) / 2e-4
    assert force == pytest.approx(gradient, rel=1e-5, abs=1e-6 * np.abs(force).max())


def test_euler_s_force_is_that_of_the_acceleration(work):
    """It is proportional to θ̈, whatever the speed and the motion; the rest does not know θ̈."""
    _, _, q_dot, of = work
    force, rest = of("no Euler force", Driven(2.0, 0.7))
    assert of("no Euler force", Driven(5.0, 1.4), 3.0 * q_dot)[0] == pytest.approx(2.0 * force)
    assert of("no Euler force", Driven(2.0, -5.0))[1] == pytest.approx(rest, rel=1e-12)


def test_without_the_centrifugal_force_a_slow_ramp_bends_as_a_load_does():
    """q = -(11/120) ρA θ̈ L⁵/EI at the middle of the ramp; stiffened a sixth less."""
    slow = replace(S1, motion=SpinUp(omega=6.0, ramp_time=60.0), duration=30.0)
    time = np.linspace(0.0, 30.0, 601)
    q = without("no centrifugal force", slow, time)
    beam = S1.blade
    static = 11.0 / 120.0 * 0.2 * beam.mass_per_length * LENGTH**5 / beam.bending_stiffness
    # The first mode swings by a tenth of a percent about it, and bends by 1 % of L.
    assert q[-1] == pytest.approx(-static, rel=1e-2)
    stiffened = spin_up_response(beam, slow.motion, time, tolerance=1e-3).q[-1]
    assert abs(stiffened) < 0.9 * static
    # Nothing else bends a straight blade, but for Coriolis' force as it stretches.
    assert np.abs(without("no Euler force", slow, time)).max() < 1e-3 * static


@pytest.mark.parametrize("delay", [-2e-3, 1e-3, 5e-3, 0.05])
def test_a_delay_is_measured_whether_it_passes_or_not(exact, delay):
    """1 and 2 ms pass; the step is 4 ms, so that none of them is one."""
    q = np.interp(TIME - delay, TIME, exact.q) if abs(delay) > 0.01 else shifted(exact.q, delay)
    found = mistake_in_history(S1, TIME, q, exact.q, step=4e-3)
    when = "late" if delay > 0.0 else "early"
    assert found is not None
    assert f"q(t) is {1e3 * abs(delay):.2g} ms {when}: let t = 0" in found.said


def test_one_step_s_lag_is_named(exact):
    found = mistake_in_history(S1, TIME, shifted(exact.q, 4e-3), exact.q, step=4e-3)
    assert "q(t) is 4 ms late, one step" in found.said
    found = mistake_in_history(S1, TIME, np.r_[0.0, exact.q[:-1]], exact.q, step=4e-3)
    assert "q(t) is 20 ms late, one sample" in found.said


def shifted(q, delay):
    return CubicSpline(TIME, q)(np.maximum(TIME - delay, 0.0))


@pytest.mark.parametrize(("mass", "stiffness"), [(1.02, 1.0), (1.0, 0.97), (2.0, 1.0), (0.5, 1.0)])
def test_a_mass_or_a_stiffness_that_is_off_is_measured(mass, stiffness):
    """Its factor follows from the frequency; the code has an error of 1e-3 of its own."""
    time = np.arange(0.0, 12.0, 0.02)
    exact = spin_up_response(S1.blade, S1.motion, time, tolerance=1e-4).q
    section = replace(
        S1.blade.section, mass_per_length=mass * S1.blade.mass_per_length,
        bending_stiffness=stiffness * S1.blade.bending_stiffness,
    )  # fmt: skip
    other = Blade(length=LENGTH, section=section)
    q = spin_up_response(other, S1.motion, time, tolerance=1e-4).q
    q = q * (1.0 + 1e-3 * np.sin(5.0 * time))
    found = mistake_in_history(S1, time, q, exact)
    assert found.name == "mass"
    stated = float(found.said.split()[3])
    assert stated == pytest.approx(mass / stiffness, rel=2e-3)


@pytest.mark.parametrize("speeds", [(0.0,), (0.0, 2.0, 6.0), (4.0, 8.0)])
def test_frequencies_of_another_mass(speeds):
    """ω of g times the mass is that of √g times the speed over √g: here of a blade that has it."""
    section = replace(S1.blade.section, mass_per_length=1.1 * S1.blade.mass_per_length)
    other = Blade(length=LENGTH, section=section)
    found = mistake_in_frequencies(
        lambda w, speed: linear_modes(other, speed, 1).frequencies[0], speeds
    )
    assert found == "mass"


def test_a_mass_that_is_five_times_too_large_is_another_mistake():
    """A factor of four is the most that is taken for a wrong mass."""
    assert mistake_in_frequencies(lambda w, speed: w / np.sqrt(5.0), (0.0,)) is None
    assert mistake_in_frequencies(lambda w, speed: w / np.sqrt(3.9), (0.0,)) == "mass"


def test_an_order_that_is_lower_than_declared_gets_a_sentence(made_of_the_exact_answer):
    """The mesh has order two where four are declared, the step the declared one."""
    entry = made_of_the_exact_answer(elements=32, order=4.0)
    (remarks,) = verify(
        entry, spin_up=SpinUp(omega=6.0, ramp_time=3.0), duration=9.0
    ).remarks.values()
    assert [one.partition(", ")[0] for one in remarks] == [
        "q(t) converges in the mesh by order 2.0"
    ]


@pytest.mark.parametrize(
    ("factor", "name"),
    [
        (np.pi / 180.0, "degrees"),
        (2.0 * np.pi, "hertz"),
        (30.0 / np.pi, "revolutions per minute"),
    ],
)
@pytest.mark.filterwarnings("ignore:.*rpm")
def test_units_of_the_speed(named, factor, name):
    """A ramp to ω × factor; of the fast ones the beginning, then what a broken code hands in."""
    time = TIME if factor < 1.0 else TIME[TIME < 0.4]
    q = response(SpinUp(omega=6.0 * factor, ramp_time=3.0), time).q
    rest = LENGTH * np.sin(50.0 * TIME[time.size :])
    assert named(np.concatenate((q, rest))) == name


def test_what_none_of_them_explains_is_left_alone(named, exact):
    """A frequency that is off by a fiftieth, a coarse mesh: no mistake of these."""
    frequency = np.interp(TIME * 1.02, TIME, exact.q)
    assert named(frequency) is None
    assert named(exact.q * (1.0 + 0.3 * np.sin(7.0 * TIME)), ramps=()) is None


@pytest.mark.parametrize(
    ("change", "name"),
    [
        (lambda w, speed: w, None),
        (lambda w, speed: w / (2.0 * np.pi), "hertz"),
        (lambda w, speed: w * 30.0 / np.pi, "revolutions per minute"),
        (lambda w, speed: w**2, "eigenvalues"),
        (lambda w, speed: first(0.0), "no rotation"),
        (lambda w, speed: first(speed * np.pi / 30.0), "revolutions per minute"),
        (lambda w, speed: w * 1.01, None),
        (np.hypot, "out of the plane"),
        (lambda w, speed: w + speed, "seen at rest"),
        (lambda w, speed: np.rint(w / (2.0 * np.pi / 60.0)) * (2.0 * np.pi / 60.0), "bins"),
    ],
)
def test_linear_frequencies(change, name):
    assert mistake_in_frequencies(change, CASES["L"].speeds) == name


def test_frequencies_without_centrifugal_stiffening():
    """At low speeds; faster ones have no frequency at all."""
    found = mistake_in_frequencies(lambda w, speed: np.sqrt(first(0.0) ** 2 - speed**2), (0.0, 2.0))
    assert found == "no centrifugal stiffening"


def mistake_in_frequencies(change, speeds):
    """The name of the mistake in frequencies of L that are changed, if there is one."""
    rows = [
        Row(elements=n, speed=speed, values=(change(first(speed), speed) * (1 + 1e-3 / n**2),))
        for n in (8, 16)
        for speed in speeds
    ]
    found = mistake_in_table(CASES["L"], rows, reference(CASES["L"]), 2e-4 / 3.0)
    return found and found.name


@cache
def first(speed):
    return float(linear_modes(S1.blade, speed, 1).frequencies[0])


def test_a_mistake_may_leave_a_third_and_the_error_of_the_finest_run():
    """Of meshes of second order, which tend to 0.1 with an error of 1e-3 on the finest."""
    n = np.array([8, 16, 32, 64])
    runs = converged(n.tolist(), None, (0.1 + 1e-3 * (64 / n) ** 2).tolist())
    finding = finding_of(runs, tolerance=1e-2, bound=0.0, where="here")
    assert most_left(1e-2, finding) == pytest.approx(1e-2 / 3.0 + 1e-3, rel=1e-3)
    assert most_left(1e-4, finding) == pytest.approx(1e-4 / 3.0 + 1e-4, rel=1e-9)
    alone = replace(finding, runs=None)
    assert most_left(1e-2, alone) == pytest.approx(1e-2 / 3.0, rel=1e-9)


def test_all_that_was_handed_in_is_searched(submitted):
    """Frequencies in Hz and the sign of q, each named in its case with what is left."""
    mine = submitted(lambda q: -q)
    rows = [replace(one, values=(one.values[0] / (2.0 * np.pi),)) for one in mine.rows]
    mine = replace(mine, rows=tuple(rows))
    found = mistakes_in(mine, judged(mine))
    assert [(one.case, one.name) for one in found] == [("L", "hertz"), ("S1", "sign of q")]
    assert "hand in rad/s" in str(found[0])
    assert found[1].before == pytest.approx(2.0, abs=1e-2)
    assert found[1].after < 1e-2


def test_a_ramp_is_looked_for_beside_a_right_case(exact):
    """A history that is right in S1 says nothing of the ramp in S3."""
    name, time = list(RAMPS)[-1], TIME[TIME <= 2.0]
    wrong = response(ramp(name, 4.0, 2.0), time).q
    runs = tuple(
        Run(case=case, elements=n, step=h, time=t, q=q * (1.0 + 0.1 / n**2 + 100.0 * h**2))
        for n, h in ((8, 1e-3), (16, 1e-3), (16, 5e-4))
        for case, t, q in (("S1", TIME, exact.q), ("S3", time, wrong))
    )
    submission = Submission(declaration=Declaration(code="mine"), runs=runs)
    found = mistakes_in(submission, judged(submission))
    assert [(one.case, one.name) for one in found] == [("S3", name)]
