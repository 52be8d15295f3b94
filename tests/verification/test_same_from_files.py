"""What is judged from files is what is judged through Python, to the last digit."""

import math
from dataclasses import replace

import numpy as np
import pytest

from rotbeam_exu.fem.elements import Cable
from rotbeam_exu.verification.cases import CASES
from rotbeam_exu.verification.entries import formulation_entry
from rotbeam_exu.verification.judgement import judged
from rotbeam_exu.verification.outcomes import Outcome
from rotbeam_exu.verification.references import reference
from rotbeam_exu.verification.submission import Row
from rotbeam_exu.verification.submission_files import read_submission, write_submission
from rotbeam_exu.verification.verify import submission_of


def the_same(submission, folder):
    """The judgement of a submission, equal to that of its files."""
    ours = judged(submission)
    theirs = judged(read_submission(write_submission(submission, folder)))
    assert theirs.by_quantity.keys() == ours.by_quantity.keys()
    for key, found in ours.by_quantity.items():
        other = theirs.by_quantity[key]
        assert (other.outcome, other.note) == (found.outcome, found.note)
        if found.runs is None:
            continue
        for name in ("limit", "bar"):
            one, two = getattr(found.runs, name), getattr(other.runs, name)
            assert one == two or np.isnan([one, two]).all(), (key, name)
        for name in ("values", "errors", "in_mesh", "in_step", "noise"):
            assert np.array_equal(getattr(found.runs, name), getattr(other.runs, name)), (key, name)
    assert str(theirs) == str(ours)
    return ours


@pytest.mark.slow
def test_the_cable(tmp_path):
    entry = replace(formulation_entry(Cable(), elements=8, step=4e-3), meshes=(4, 8, 16))
    found = the_same(submission_of(entry, [CASES["L"], CASES["S1"], CASES["O"]]), tmp_path)
    # Such coarse meshes decide the orbit alone.
    assert found.outcome_of("O") is Outcome.REFERENCE
    assert found.passed is None


def test_tolerances_are_judged_as_steps_are(made_of_the_exact_answer, tmp_path):
    """Runs of a step control whose steps are as long have the same limits and orders.

    Fifteen seconds hold no whole number of 16 ms: what is beyond is left out in either way.
    """
    fixed = submission_of(made_of_the_exact_answer(step=8e-3), [CASES["S1"]])
    assert all(run.time[-1] <= 15.0 for run in fixed.runs)
    runs = [replace(run, step=math.nan, tolerance=run.step) for run in fixed.runs]
    found = the_same(replace(fixed, runs=tuple(runs)), tmp_path)
    assert {path.name[:6] for path in (tmp_path / "S1").iterdir()} == {"m008_t", "m016_t", "m032_t"}
    for key, finding in judged(fixed).by_quantity.items():
        mine = found.by_quantity[key]
        assert mine.outcome is finding.outcome
        assert (mine.runs.limit, mine.runs.bar) == (finding.runs.limit, finding.runs.bar)
        assert mine.runs.orders["step"].value == finding.runs.orders["step"].value
    coarse = [run for run in runs if run.tolerance == runs[0].tolerance]
    note = judged(replace(fixed, runs=tuple(coarse))).findings["S1"]["history"].note
    assert note.startswith("with one tolerance its error is in the difference")


def test_digits_that_are_missing_are_in_the_floor(made_of_the_exact_answer):
    """Of q(t) in m over max|q|, of frequencies in rad/s over the reference's."""
    true = reference(CASES["L"]).first_frequency(6.0)
    meshes = [Row(elements=n, speed=6.0, values=(true * (1.0 + n**-4.0),)) for n in (8, 16, 32)]
    fine = submission_of(made_of_the_exact_answer(), [CASES["S1"]])
    fine = replace(fine, rows=tuple(meshes))
    off = replace(
        fine,
        runs=tuple(replace(run, rounding=1e-3) for run in fine.runs),
        rows=tuple(replace(one, rounding=(1e-4,)) for one in meshes),
    )
    before, after = judged(fine), judged(off)
    for key, lost in {
        ("S1", "history"): 1e-3 / before.histories["S1"].scale,
        ("L", "linear frequency"): 1e-4 / true,
    }.items():
        one, two = before.by_quantity[key].runs, after.by_quantity[key].runs
        assert two.noise - one.noise == pytest.approx(lost, rel=1e-9)
        assert two.bar >= one.bar + 0.99 * lost
