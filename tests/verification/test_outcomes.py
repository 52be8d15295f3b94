"""What is said of a limit: right, off by a little, different, or which runs would decide."""

from dataclasses import replace

import numpy as np
import pytest
import xarray as xr

from rotbeam_exu.verification.cases import CASES
from rotbeam_exu.verification.convergence import Convergence, Order, converged
from rotbeam_exu.verification.judgement import judged
from rotbeam_exu.verification.outcomes import Finding, Outcome, _rounded, finding_of, worst_of
from rotbeam_exu.verification.space_cases import SpaceCase
from rotbeam_exu.verification.verify import Entry, submission_of


def known(limit, bar, *, finest=0.5, growths=0, steps=(0.0, 0.0)):
    none = np.zeros(2)
    return Convergence(
        elements=np.array([8.0, 16.0]), steps=np.array(steps), values=np.array([0.0, finest]),
        noise=none, errors=none, in_mesh=np.array([0.4, 0.1]), in_step=none, limit=limit, bar=bar,
        powers=(2.0, 1.0), orders={"mesh": Order(why="two")}, growths=growths,
    )  # fmt: skip


@pytest.mark.parametrize(
    ("limit", "bar", "bound", "outcome"),
    [
        (0.0, 0.0, 0.0, Outcome.REFERENCE),
        (0.125, 0.0625, 0.0625, Outcome.REFERENCE),  # zero within the bars, all of it within
        (0.125, 0.0625, 0.0, Outcome.AGREES),
        (-0.25, 0.0, 0.0, Outcome.AGREES),
        (0.125, 0.125, 0.0625, Outcome.UNDECIDED),
        (0.0, 0.25, 0.01, Outcome.UNDECIDED),
        (0.5, 0.125, 0.125, Outcome.UNDECIDED),
        (0.51, 0.125, 0.125, Outcome.DIFFERS),
        (-0.26, 0.0, 0.0, Outcome.DIFFERS),
    ],
)
def test_a_code_is_right_if_its_limit_and_all_bars_are_within_the_tolerance(
    limit, bar, bound, outcome
):
    """The tolerance is a quarter."""
    found = finding_of(known(limit, bar), tolerance=0.25, bound=bound, where="here")
    assert found.outcome is outcome
    assert (found.model_difference, found.difference, found.bound) == (limit, 0.5, bound)
    assert found.within == abs(limit) + bar + bound
    assert (" within " in found.said) == (outcome is Outcome.AGREES)


def test_what_grows_does_not_converge_if_it_grows_twice_or_is_far_off():
    for growths, finest, outcome in (
        (1, 0.5, Outcome.UNDECIDED), (2, 0.5, Outcome.DIFFERS), (1, 30.0, Outcome.DIFFERS),
        (0, 30.0, Outcome.UNDECIDED),
    ):  # fmt: skip
        runs = known(0.5, 0.5, growths=growths, finest=finest)
        found = finding_of(runs, tolerance=0.25, bound=0.0, where="here")
        assert found.outcome is outcome
        assert ("does not converge here" in found.note) == (outcome is Outcome.DIFFERS)
    # What is known well enough is right, however it came there.
    assert finding_of(
        known(0.0, 0.1, growths=2), tolerance=0.25, bound=0.0, where=""
    ).outcome.passed


@pytest.mark.parametrize("limit", [0.0, 0.5])
def test_one_step_alone_decides_nothing(limit):
    runs = known(limit, 0.0, steps=(1e-3, 1e-3))
    found = finding_of(runs, tolerance=0.25, bound=0.0, where="here")
    assert found.outcome is Outcome.UNDECIDED
    assert "refine it" in found.note


@pytest.mark.parametrize(
    ("runs", "said"),
    [
        # The bar has to shrink by about four: twice the elements of order two.
        (((8, 16, 32), None), "elements would decide"),
        (((16, 32), None), "a third mesh would decide"),
        (((16, 16, 16, 32, 64), (4e-3, 2e-3, 1e-3, 2e-3, 2e-3)), "a step of about"),
    ],
)
def test_what_is_undecided_says_which_runs_would_decide(runs, said):
    elements, steps = runs
    n = np.array(elements, dtype=float)
    h = np.zeros(n.size) if steps is None else np.array(steps)
    size = 1.0 if steps is None else 1e-3

    def judged(n, h):
        values = 0.02 * size * (32 / n) ** 2 + 6e4 * h**2
        fit = converged(n, None if steps is None else h, values, declared=(2.0, 2.0))
        return finding_of(fit, tolerance=5e-3, bound=0.0, where="here")

    found = judged(n, h)
    assert found.outcome is Outcome.UNDECIDED
    assert said in found.note
    if "third" in said:
        return
    advised = float(found.note.split("about ")[1].split()[0])
    if said.startswith("elements"):
        assert 32 < advised <= 160
        found = judged(np.append(n, advised), np.append(h, 0.0))
    else:
        assert 0.2 <= advised < 1.0
        found = judged(np.append(n, 16.0), np.append(h, 1e-3 * advised))
    assert found.outcome.passed


@pytest.mark.parametrize(
    ("limit", "in_mesh", "in_step", "said"),
    [
        # The bar, 1, has to shrink to half the tolerance: by four.
        (0.0, 0.1, 0.1, "about 64 elements and a step of about 0.5 ms would decide"),
        (0.0, 0.1, 0.02, "here: about 64 elements would decide"),
        (0.0, 0.02, 0.1, "here: a step of about 0.5 ms would decide"),
        # To what the limit is beyond the tolerance: by 2.5.
        (-0.9, 0.1, 0.1, "about 52 elements and a step of about 0.6 ms would decide"),
    ],
)
def test_a_remedy_refines_the_finest_run_by_its_orders(limit, in_mesh, in_step, said):
    """Both orders are two; what has less than a third of the other's error is left as it is."""
    runs = replace(
        known(limit, 1.0), elements=np.array([8.0, 16.0, 32.0]), powers=(2.0, 2.0),
        steps=np.array([4e-3, 2e-3, 1e-3]), in_mesh=np.array([0.4, 0.2, in_mesh]),
        in_step=np.array([0.4, 0.2, -in_step]),
    )  # fmt: skip
    found = finding_of(runs, tolerance=0.5, bound=0.0, where="here")
    assert found.outcome is Outcome.UNDECIDED
    assert found.note.endswith(said)


def test_numbers_of_elements_that_are_advised_have_two_digits_and_are_even():
    assert [_rounded(elements) for elements in (51.2, 100.0, 122.0)] == [52, 100, 140]


def test_a_reference_that_is_not_known_well_enough_is_named():
    found = finding_of(known(0.0, 0.1), tolerance=0.25, bound=0.2, where="in B", of_what="ω_n")
    assert found.note == "known to 3e-01 only in B: ω_n is known to 2e-01 only"


def test_the_worst_finding_decides_and_of_equal_ones_the_farthest_off():
    def finding(outcome, limit):
        runs = None if limit is None else known(limit, 0.0)
        return Finding(outcome=outcome, runs=runs)

    right, near, far, unknown = (
        finding(Outcome.REFERENCE, 9.0), finding(Outcome.DIFFERS, 0.5),
        finding(Outcome.DIFFERS, -0.7), finding(Outcome.DIFFERS, None),
    )  # fmt: skip
    assert worst_of([right, near]) is near
    assert worst_of([near, far, right]) is far
    assert worst_of([far, unknown]) is unknown


def test_a_code_is_run_on_three_meshes_and_with_three_steps():
    def code(case, *, elements, step):
        time = np.arange(0.0, case.duration + 0.3, 0.1)
        own = {"verdict": "passed" if step < 2e-3 else "drifts"}
        return xr.Dataset({"q": ("time", 0.0 * time)}, {"time": time}, own)

    runs = submission_of(Entry(name="mine", simulate=code, elements=16), [CASES["S1"]]).runs
    assert [(run.elements, run.step) for run in runs] == [
        (8, 2e-3), (16, 1e-3), (16, 2e-3), (16, 4e-3), (32, 2e-3)
    ]  # fmt: skip
    assert [run.remark for run in runs] == ["drifts", "", "drifts", "drifts", "drifts"]
    assert all(0.0 < run.wall < 5.0 for run in runs)
    assert all(run.time[-1] == pytest.approx(CASES["S1"].duration) for run in runs)
    assert Entry(name="mine", simulate=code, elements=1).own_meshes == (1, 2)
    assert Entry(name="mine", simulate=code, meshes=(9, 3)).own_meshes == (3, 9)


@pytest.mark.parametrize("name", ["L", "P"])
def test_a_refusal_of_frequencies_or_of_a_tip_is_told_and_what_is_not_done_is_left_out(name):
    case = CASES[name]

    def refusing(case, omega, elements):
        if omega == case.speeds[0]:
            raise NotImplementedError
        raise RuntimeError(f"no license at {omega:g}")

    entry = Entry(
        name="mine", simulate=None, in_space=isinstance(case, SpaceCase), frequencies=refusing,
        steady_tip=refusing,
    )  # fmt: skip
    submission = submission_of(entry, [case])
    assert {row.speed for row in submission.rows} == set(case.speeds[1:])
    assert {row.failure for row in submission.rows} == {
        f"no license at {w:g}" for w in case.speeds[1:]
    }
    (finding,) = judged(submission).findings[name].values()
    assert finding.note.startswith("no mesh: no license at")
