"""Stout beams and blades in space: theories told apart, tips and frequencies by number judged."""

import math
from dataclasses import replace

import numpy as np
import pytest

from analytic import Gravity, Theory, linear_modes
from rotbeam_exu.verification.case import Asked
from rotbeam_exu.verification.cases import CASES, SHEAR
from rotbeam_exu.verification.judgement import judged
from rotbeam_exu.verification.mistakes import mistakes_in
from rotbeam_exu.verification.outcomes import Outcome
from rotbeam_exu.verification.references import reference, row_of
from rotbeam_exu.verification.submission import Declaration, Row, Run, Submission
from rotbeam_exu.verification.submission_files import read_submission, write_submission

EULER, SHEARED = Theory(), Theory(shear=SHEAR)
RUNS = (8, 4e-3), (16, 4e-3), (32, 4e-3), (32, 2e-3), (32, 8e-3)
MESHES = 8, 16, 32
TIME = np.linspace(0.0, 15.0, 1001)


def rows_of(case, truth, change=lambda row: row):
    """Rows of a table with errors 1/n² of a code of the truth's theory."""
    made = []
    for elements in MESHES:
        for speed in case.speeds:
            row = (change(truth.row(speed)) * (1.0 + 1e-2 / elements**2)).tolist()
            place = {"case": case.name, "elements": elements, "speed": speed}
            if case.asked is Asked.STEADY:
                made.append(Row(**place, values=tuple(row)))
            else:
                made += [Row(**place, number=k, values=(f,)) for k, f in enumerate(row, start=1)]
    return made


def submitted(names, theory=EULER, declared=None, change=lambda row: row):
    """What a code of a theory hands in that declares it, or another."""
    rows, runs = [], []
    for case in map(CASES.get, names):
        truth = reference(case, theory)
        if case.asked is Asked.HISTORY:
            time = np.linspace(0.0, case.duration, 1001)
            q = change(truth.history(time))
            runs += [
                Run(
                    case=case.name, elements=n, step=h, time=time,
                    q=q * (1.0 + 0.5 / n**2 + 100.0 * h**2),
                )
                for n, h in RUNS
            ]  # fmt: skip
        else:
            rows += rows_of(case, truth, change)
    declaration = Declaration(code="mine", theory=declared or theory, order=2.0, order_in_step=2.0)
    return Submission(declaration=declaration, rows=tuple(rows), runs=tuple(runs))


@pytest.mark.parametrize("theory", CASES["T"].theories, ids=str)
def test_a_stout_beam_tells_theories_apart(theory):
    for declared in CASES["T"].theories:
        submission = submitted(["TL", "T"], theory, declared)
        found = judged(submission)
        due = Outcome.REFERENCE if declared == theory else Outcome.DIFFERS
        assert {found.outcome_of(name) for name in ("TL", "T")} == {due}
        if declared == theory:
            assert mistakes_in(submission, found) == []


REISSNER = Theory(shear=SHEAR, rotary_inertia=True)
ENGESSER = Theory(shear=SHEAR, rotary_inertia=True, engesser=True)


@pytest.mark.parametrize(
    ("theory", "declared", "said"),
    [
        (EULER, REISSNER, "those of Bernoulli-Euler, the tags say Timoshenko with"),
        (REISSNER, EULER, "those of Timoshenko with rotary inertia, the tags say Bern"),
        (ENGESSER, REISSNER, "those of Timoshenko, Engesser's law with rotary inertia, the tags"),
        (REISSNER, ENGESSER, "the tags say Timoshenko, Engesser's law with rotary inertia: corr"),
    ],
)
def test_tags_that_do_not_fit_are_named(theory, declared, said):
    submission = submitted(["TL", "T"], theory, declared)
    found = mistakes_in(submission, judged(submission))
    assert [(one.case, one.name) for one in found if one.case == "T"] == [("T", "tags")]
    assert said in str(found[-1])


def test_a_straight_blade_has_the_modes_of_its_plane_and_a_rods_torsion():
    case = CASES["F"]
    blade, section = case.blade, case.blade.section
    out = section.out_of_plane
    for speed in case.speeds:
        lag = linear_modes(
            blade, speed, 2, only="lag", theory=Theory(rotary_inertia=True)
        ).frequencies
        found = reference(case).row(speed)
        assert found[[1, 4]] == pytest.approx(lag, rel=1e-9)
        # Of sections with inertia j1 = j2 + j3, which the propeller moment stiffens by j3 - j2.
        r, mu = out.bending_ratio, blade.slenderness * blade.length**2
        turns = section.mass_per_length * mu
        rod = 0.25 * math.pi**2 / blade.length**2 * out.torsion_ratio * section.bending_stiffness
        torsion = math.sqrt((rod / turns + speed**2 * (1.0 - r)) / (1.0 + r))
        # The sections' spin couples it to the slope of flap, by 2e-9 at 1 rad/s and more beyond.
        assert found[6] == pytest.approx(torsion, rel=1e-7)


@pytest.mark.parametrize(
    ("name", "most"), [("F", 1e-7), ("F+p", 1e-7), ("P", 1e-7), ("TL", 1e-7), ("G", 3e-7)]
)
def test_shipped_rows_are_computed_ones(name, most):
    case = CASES[name]
    for theory in case.theories[:2]:
        assert reference(case, theory).source.startswith("shipped")
        row, bound = row_of(case, theory, case.speeds[-1])
        assert reference(case, theory).row(case.speeds[-1]) == pytest.approx(row, rel=1e-9)
        # The bound is an estimate, of which round-off moves the last digits.
        assert 0.99 * bound <= reference(case, theory).bound < most


@pytest.mark.parametrize("theory", [EULER, REISSNER])
def test_a_right_code_in_space_converges_from_files_as_well(theory, tmp_path):
    submission = submitted(["F", "F+p", "P", "W", "G", "K"], theory)
    found = judged(submission)
    assert [found.outcome_of(name) for name in found.findings] == [Outcome.REFERENCE] * 6
    assert all(source.startswith("shipped") for source in found.sources.values())
    files = read_submission(write_submission(submission, tmp_path / "mine"))
    assert str(judged(files)) == str(found)
    for mine, theirs in zip(submission.runs, files.runs, strict=True):
        assert np.array_equal(mine.q, theirs.q)
    assert files.rows == submission.rows


def test_shear_is_seen_in_the_frequencies_of_a_blade():
    found = judged(submitted(["F+p"], SHEARED, EULER)).findings["F+p"]["frequencies"]
    assert found.outcome is Outcome.DIFFERS
    assert "in frequency 5 at 0 rad/s" in found.note


def test_the_worst_component_is_named():
    found = judged(submitted(["W", "P"], change=lambda q: q * (1.0, 1.0, 1.03)))
    assert found.findings["W"]["history"].note.endswith("in W, most of all twist")
    assert "in twist at" in found.findings["P"]["steady deflection"].note


@pytest.mark.parametrize(
    ("case", "factors", "name"),
    [
        ("W", (1.0, -1.0, -1.0), "sign of the blade's twist"),
        ("W", (1.0, -1.0, 1.0), "sign of flap"),
        ("W", (1.0, 1.0, 180.0 / math.pi), "degrees"),
        ("W", (1.0, 1.0, 1.3), None),
        ("P", (-1.0, -1.0, 1.0), "sign of the precone"),
        ("P", (-1.0, 1.0, -1.0), "sign of the blade's twist"),
        ("P", (1.0, 1.0, -1.0), "sign of twist"),
        ("G", (-1.0, -1.0, 1.0), "sign of gravity"),
        ("G", (-1.0, 1.0, -1.0), "sign of the blade's twist"),
        ("K", (1.0, -1.0, -1.0), "sign of the kick"),
        ("K", (1.0, 1.0, 180.0 / math.pi), "degrees"),
        ("K", (1.0, 0.9, 1.0), None),
        ("P", (1.0, 1.2, 1.0), None),
        ("F+p", (0.5 / math.pi,) * 7, "hertz"),
    ],
)
def test_mistakes_in_space_are_named(case, factors, name):
    submission = submitted([case], change=lambda q: q * factors)
    found = mistakes_in(submission, judged(submission))
    assert [one.name for one in found] == [name] * (name is not None)


def test_a_delay_in_space_is_measured():
    """Lag, flap and twist are 3 ms late."""
    late = reference(CASES["W"]).history(np.maximum(TIME - 3e-3, 0.0))
    submission = submitted(["W"], change=lambda _: late)
    (found,) = mistakes_in(submission, judged(submission))
    assert found.said == "q(t) is 3 ms late: let t = 0 be the start of Eq. 1"


def of_line(**change):
    """Case P of a blade whose line is another."""
    blade = CASES["P"].blade
    return replace(CASES["P"], blade=replace(blade, line=replace(blade.line, **change)))


LINE = CASES["P"].blade.line
UPWARD = replace(CASES["G"], loads=(Gravity(-9.81, tilt=0.5 * math.pi),), speeds=(3.0,))


@pytest.mark.parametrize(
    ("built", "name"),
    [
        (of_line(precone=-LINE.precone), "sign of the precone"),
        (of_line(twist=(0.0, -LINE.twist[1])), "sign of the blade's twist"),
        (UPWARD, "sign of gravity"),
    ],
)
def test_a_blade_built_or_loaded_the_other_way_is_found(built, name):
    """By its own steady state, not by the factors that the judge tries."""
    rows = tuple(rows_of(built, reference(built)))
    submission = Submission(declaration=Declaration(code="mine"), rows=rows)
    (found,) = mistakes_in(submission, judged(submission))
    assert (found.case, found.name) == (built.name, name)


def test_a_code_without_gravity_or_kick_differs():
    """Without gravity the blade stays straight; without the kick the tube moves as in S1."""
    planar = reference(CASES["S1"]).history(TIME)[:, None] * (1.0, 0.0, 0.0)
    for name, plain in (("G", np.zeros(3)), ("K", planar)):
        found = judged(submitted([name], change=lambda row, plain=plain: plain))
        assert found.outcome_of(name) is Outcome.DIFFERS
