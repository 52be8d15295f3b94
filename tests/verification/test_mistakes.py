"""Each of the usual mistakes, planted into the exact answer, is named; what is right has none."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from analytic import FourierRamp, SpeedTable, SpinUp, linear_modes, spin_up_response
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
    assert np.ptp(q[S1.ramp_time < TIME]) > 0.1 * np.ptp(q)  # it swings on after the ramp


@pytest.fixture(params=["S1", "S1+h"])
def work(request):
    """Return coordinates, their rates, and a function: the work of a force, that of the rest."""
    case, model = CASES[request.param], Lacking(CASES[request.param], {1.0: 1.0})
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
