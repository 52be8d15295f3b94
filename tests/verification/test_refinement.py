"""What is made of a code's runs: rows of meshes and of steps, their common limit, the outcome."""

import math

import numpy as np
import pytest
import xarray as xr

from rotbeam_exu.verification.cases import CASES
from rotbeam_exu.verification.convergence import Convergence
from rotbeam_exu.verification.outcomes import Finding, Order, Outcome, found_of, worst_of
from rotbeam_exu.verification.refinement import limit_of_histories, limit_of_numbers, refinement
from rotbeam_exu.verification.submission import Declaration, Run
from rotbeam_exu.verification.verify import Entry, handed_in

TIME = np.linspace(0.0, 1.0, 5)
SECOND = Declaration(code="mine", order=2.0, order_in_step=2.0)


def run_of(elements, step):
    return Run(case="S1", elements=elements, step=step, time=TIME, q=TIME)


def rows_of(*resolutions):
    return refinement([run_of(*one) for one in resolutions])


def resolutions(runs):
    return [(run.elements, run.step) for run in runs]


TOGETHER = ((16, 2.0), (8, 2.0), (32, 2.0), (16, 1.0), (16, 4.0))
"""Meshes at one of the steps that were tried on one of them."""
APART = ((16, 2.0), (8, 2.0), (32, 2.0), (64, 1.0), (64, 0.5), (64, 0.25))
"""Steps on a mesh of their own, all smaller."""


def test_rows_are_the_longest_and_of_equally_long_ones_the_finest():
    rows = rows_of(*TOGETHER)
    assert resolutions(rows.meshes) == [(8, 2.0), (16, 2.0), (32, 2.0)]
    assert resolutions(rows.steps) == [(16, 4.0), (16, 2.0), (16, 1.0)]
    assert resolutions([rows.finest]) == [(32, 2.0)]
    every = rows_of(*((n, h) for n in (4, 8) for h in (1.0, 2.0)))
    assert resolutions(every.meshes) == [(4, 1.0), (8, 1.0)]
    assert resolutions(every.steps) == [(8, 2.0), (8, 1.0)]
    assert resolutions([every.finest]) == [(8, 1.0)]
    # The longer row wins against the finer.
    assert resolutions(rows_of((4, 2.0), (8, 2.0), (8, 1.0)).meshes) == [(4, 2.0), (8, 2.0)]
    assert resolutions(rows_of((4, 2.0), (4, 1.0), (8, 1.0)).steps) == [(4, 2.0), (4, 1.0)]
    alone = rows_of((4, 1.0), (8, 1.0))
    assert (alone.steps, alone.steps_are_refined) == ((), False)
    both = rows_of((4, 4.0), (8, 2.0), (16, 1.0))
    assert resolutions(both.meshes) == [(4, 4.0), (8, 2.0), (16, 1.0)]
    assert both.steps_are_refined
    assert rows.steps_are_refined
    one = rows_of((8, 1.0), (8, 2.0), (8, 4.0))
    assert (len(one.meshes), len(one.steps)) == (1, 3)


@pytest.mark.parametrize("given", [TOGETHER, APART])
def test_the_limit_is_free_of_the_errors_of_mesh_and_step(given):
    """1 + 0.5/n² + 3e-3 h² tends to 1; each bar is a quarter of what is left on the finest."""
    rows = rows_of(*given)
    steps = [h for _, h in resolutions(rows.steps)]

    def value(run):
        return 1.0 + 0.5 / run.elements**2 + 3e-3 * run.step**2

    measured = {run: (value(run), 1e-9) for run in (*rows.meshes, *rows.steps)}
    found = limit_of_numbers(rows, measured, SECOND)
    assert found.limit == pytest.approx(1.0, abs=1e-8)
    assert found.errors == pytest.approx([value(run) - 1.0 for run in rows.meshes], abs=1e-8)
    bar = 0.25 * (0.5 / 32**2 + 3e-3 * steps[-1] ** 2)
    assert found.bar == pytest.approx(bar, rel=1e-3)
    shape, other = 1.0 + TIME, 2.0 - TIME

    def history(run):
        return np.cos(TIME) + 0.5 / run.elements**2 * shape + 3e-3 * run.step**2 * other

    histories = {run: history(run) for run in (*rows.meshes, *rows.steps)}
    runs, step, limit = limit_of_histories(rows, histories, 1e-9, SECOND)
    assert limit == pytest.approx(np.cos(TIME), abs=1e-7)
    assert runs.limit == pytest.approx(1.0, abs=1e-7)
    assert runs.values == pytest.approx([np.abs(history(run)).max() for run in rows.meshes])
    away = [np.abs(history(run) - np.cos(TIME)).max() for run in rows.meshes]
    assert runs.errors == pytest.approx(away, abs=1e-7)
    bar = 0.25 * (2.0 * 0.5 / 32**2 + 2.0 * 3e-3 * steps[-1] ** 2)
    assert runs.bar == pytest.approx(bar, rel=1e-3)
    assert step.order == pytest.approx(2.0, abs=1e-4)


def test_steps_that_do_not_settle_are_told():
    rows = rows_of(*TOGETHER)
    bad = {1.0: 1.0, 2.0: 0.1, 4.0: 0.0}
    measured = {
        run: (1.0 / run.elements**2 + bad[run.step], 0.0) for run in (*rows.meshes, *rows.steps)
    }
    found = limit_of_numbers(rows, measured, SECOND)
    assert (found.settles, found.why) == (False, "the changes do not shrink")


def test_a_code_is_run_on_three_meshes_and_with_three_steps():
    def code(case, *, elements, step):
        time = np.arange(0.0, case.duration + 0.3, 0.1)
        names = {"q": ("time", 0.0 * time), "q_dot": ("time", 0.0 * time)}
        return xr.Dataset(names, {"time": time}, {"verdict": "passed" if step < 2e-3 else "drifts"})

    runs = handed_in(Entry(name="mine", simulate=code, elements=16), [CASES["S1"]]).runs
    assert resolutions(runs) == [(8, 2e-3), (16, 1e-3), (16, 2e-3), (16, 4e-3), (32, 2e-3)]
    assert [run.remark for run in runs] == ["drifts", "", "drifts", "drifts", "drifts"]
    assert all(0.0 < run.wall < 5.0 for run in runs)
    assert all(run.time[-1] == pytest.approx(CASES["S1"].duration) for run in runs)
    assert Entry(name="mine", simulate=code, elements=1).own_meshes == (1, 2)
    assert Entry(name="mine", simulate=code, meshes=(9, 3)).own_meshes == (3, 9)


def known(limit, bar, *, settles=True):
    none = np.zeros(2)
    return Convergence(
        sizes=none, values=np.array([0.0, 0.5]), noise=none, errors=none, limit=limit, bar=bar,
        order=2.0, why="the changes do not shrink", settles=settles,
    )  # fmt: skip


@pytest.mark.parametrize(
    ("limit", "bar", "bound", "outcome"),
    [
        (0.25, 0.0, 0.0, Outcome.REFERENCE),
        (0.26, 0.0, 0.0, Outcome.ANOTHER_LIMIT),
        (-0.26, 0.0, 0.0, Outcome.ANOTHER_LIMIT),
        (0.5, 0.125, 0.125, Outcome.REFERENCE),  # off by no more than tolerance and doubt
        (0.51, 0.125, 0.125, Outcome.ANOTHER_LIMIT),
        (0.0, 0.25, 0.01, Outcome.NO_VERDICT),
        (0.0, 0.01, 0.25, Outcome.NO_VERDICT),
        (0.52, 0.25, 0.01, Outcome.ANOTHER_LIMIT),
    ],
)
def test_a_limit_is_the_reference_as_far_as_tolerance_and_doubt_go(limit, bar, bound, outcome):
    """The tolerance is a quarter."""
    found = found_of(known(limit, bar), tolerance=0.25, bound=bound, where="here")
    assert found.outcome is outcome
    assert (found.model_difference, found.difference, found.bound) == (limit, 0.5, bound)
    # What grows is charged where it is more than the tolerance.
    grown = found_of(known(limit, bar, settles=False), tolerance=0.25, bound=bound, where="here")
    assert grown.outcome is (outcome if bar + bound <= 0.25 else Outcome.NO_LIMIT)


def test_the_worst_finding_decides_and_of_equal_ones_the_farthest_off():
    def finding(outcome, limit):
        runs = None if limit is None else known(limit, 0.0)
        return Finding(outcome=outcome, runs=runs)

    right, near, far, unknown, broken = (
        finding(Outcome.REFERENCE, 9.0), finding(Outcome.ANOTHER_LIMIT, 0.5),
        finding(Outcome.ANOTHER_LIMIT, -0.7), finding(Outcome.ANOTHER_LIMIT, None),
        finding(Outcome.NO_LIMIT, 0.0),
    )  # fmt: skip
    assert worst_of([right, near]) is near
    assert worst_of([near, far, right]) is far
    assert worst_of([far, unknown]) is unknown
    assert worst_of([unknown, broken, far]) is broken


def test_an_order_is_low_below_seven_tenths_of_the_declared_one():
    assert [Order(value=v, declared=4.0).low for v in (2.79, 2.81)] == [True, False]
    assert not Order(value=0.1, declared=None).low
    assert str(Order(value=math.nan, declared=2.0, why="2 runs")) == "not measured: 2 runs"
