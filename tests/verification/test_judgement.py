"""Codes of known errors are judged by what they tend to: it is named where it is not the truth."""

from dataclasses import replace

import numpy as np
import pytest
import xarray as xr
from scipy.interpolate import CubicSpline

from analytic import AmplitudeNotReachedError, SpinUp, SteadyRotation
from rotbeam_exu.verification import judgement
from rotbeam_exu.verification.cases import CASES
from rotbeam_exu.verification.judgement import THRESHOLDS, judged
from rotbeam_exu.verification.outcomes import Finding, Outcome
from rotbeam_exu.verification.references import reference
from rotbeam_exu.verification.submission import (
    Declaration,
    Row,
    Run,
    Submission,
)
from rotbeam_exu.verification.verify import Entry, verify

S1 = SpinUp(omega=6.0, ramp_time=3.0)


def judge(entry, **options):
    return verify(entry, spin_up=S1, **options)


def test_a_right_code_converges_to_the_reference(judged_right):
    found = judged_right
    assert found.passed
    assert found.outcome == "1 of 2 agrees, 1 not submitted"
    of = found.findings["S"]
    assert found.orders["S"]["step"].value == pytest.approx(2.0, abs=1e-2)
    assert found.orders["S"]["mesh"].value == pytest.approx(2.0, abs=1e-2)
    # What was put in: 4e-6 of the step of 2 ms, and the mesh's share.
    put_in = 4e-6 + 1e-2 / 64**2
    assert of["amplitude"].runs.errors[-1] == pytest.approx(put_in, rel=1e-2)
    assert of["history"].runs.errors[-1] == pytest.approx(put_in, rel=1e-2)
    for quantity in ("amplitude", "history"):
        assert abs(of[quantity].model_difference) < 1e-6
    # The reference's own amplitude is measured, too: its error counts over itself.
    true = found.histories["S"].true_oscillation
    own = of["amplitude"].bound - found.histories["S"].reference.bound
    assert own * true.amplitude == pytest.approx(true.amplitude_error, rel=1e-6)
    # All runs are compared as far as the shortest goes, its last sample included.
    seen = found.histories["S"]
    compared = seen.finest.time <= min(run.time[-1] for run in seen.runs)
    assert {d.size for d in seen.aligned.values()} == {np.count_nonzero(compared)}
    # The exact answer lies on the exact backbone, a second mode in it notwithstanding.
    assert abs(of["nonlinear shift"].model_difference) < 1e-3
    assert found.sources["S"]
    assert "nonlinear shift" in str(found)


def test_a_clock_that_is_slow_by_a_thousandth_is_seen_in_the_shift(
    made_of_the_exact_answer, judged_right
):
    """A thousandth of ω_NL is 6 % of the shift at 6 rad/s, 1.4e-2."""
    entry = made_of_the_exact_answer(lambda time, q, n: CubicSpline(time, q)(time * 0.999))
    found = judge(entry).findings["S"]["nonlinear shift"]
    exact = reference(CASES["S1"])
    amplitude = next(iter(judged_right.histories["S"].oscillations.values())).amplitude
    shift = exact.frequency_at(amplitude) / exact.first_frequency(6.0) - 1.0
    assert found.model_difference == pytest.approx(-1e-3 / shift, rel=0.02)
    assert found.outcome is Outcome.DIFFERS


def test_a_linear_frequency_of_its_own_moves_the_shift_and_adds_its_bar(judged_right):
    """By its error over the shift, 1.4e-2, where that is known; else by nothing."""
    seen = judged_right.histories["S"]
    without = seen.shift(5e-2, None)
    amplitude = seen.oscillations[seen.finest].amplitude
    shift = seen.reference.frequency_at(amplitude) / seen.reference.first_frequency(6.0) - 1.0
    for limit, bar in ((1e-4, 5e-5), (-1e-4, 5e-5), (1e-4, 2e-4)):
        own = replace(without.runs, limit=limit, bar=bar)
        off, doubt = (limit, bar) if bar < abs(limit) else (0.0, 0.0)
        found = seen.shift(5e-2, own)
        moved = found.model_difference - without.model_difference
        assert moved == pytest.approx(-off / shift, rel=1e-6, abs=1e-9)
        assert found.bound == pytest.approx(without.bound + doubt / abs(shift), rel=1e-9)


def test_a_linear_oscillator_is_told_from_the_truth_at_two_radians():
    """Its ω_NL is ω_n: off by a thousandth, which is the whole of the shift."""
    case = replace(CASES["O"], motion=SteadyRotation(omega=2.0), duration=40.0, amplitudes=(0.3,))
    truth, time = reference(case), np.linspace(0.0, 39.0, 1951)
    shift = truth.frequency_at(0.3) / truth.first_frequency(2.0) - 1.0
    assert abs(shift) < 2e-3
    for rate, expected in ((1.0, 0.0), (1.0 / (1.0 + shift), -1.0)):
        q = truth.history(time * rate)
        runs = tuple(
            Run(case="O", elements=n, step=h, time=time, q=q * (1.0 + 0.1 / n**2 + h))
            for n, h in ((8, 1e-3), (16, 1e-3), (32, 1e-3), (8, 5e-4), (8, 2e-3))
        )
        submission = Submission(declaration=Declaration(code="mine"), runs=runs)
        found = judged(submission, cases={"O": case}).findings["O"]["nonlinear shift"]
        assert found.model_difference == pytest.approx(expected, abs=1e-2)
        assert found.outcome is (Outcome.DIFFERS if expected else Outcome.REFERENCE)


def test_a_code_of_another_frequency_is_told_so():
    def slow(case, *, elements, step):
        time = np.arange(0.0, case.duration, 0.02)
        return xr.Dataset({"q": ("time", 0.1 * np.sin(1.5 * time))}, {"time": time})

    found = judge(Entry(name="slow", simulate=slow))
    assert not found.passed
    assert "times the beam's natural frequency" in found.findings["S"]["nonlinear shift"].note


def test_a_code_that_fails_says_why():
    def broken(case, *, elements, step):
        raise RuntimeError("no license")

    found = judge(Entry(name="broken", simulate=broken))
    assert found.passed is None
    (note,) = {one.note for one in found.findings["S"].values()}
    assert note.startswith("no run: failed, no license: 8 elements at 2 ms, 16 elements at 4 ms")
    assert found.outcome_of("S") is Outcome.UNDECIDED
    assert len(found.remarks["S"]) == 1


def test_a_reference_that_fails_is_not_charged_to_the_code(whole, monkeypatch):
    def no_history(case, theory):
        raise AmplitudeNotReachedError("no orbit")

    monkeypatch.setattr(judgement, "reference", no_history)
    found = judged(whole)
    assert {one.outcome for one in found.findings["S1"].values()} == {Outcome.UNDECIDED}
    assert found.findings["S1"]["history"].note == "no reference: no orbit"
    assert not found.passed


def test_an_estimator_that_fails_on_the_exact_answer_is_not_charged_either(
    made_of_the_exact_answer,
):
    """Four seconds after the ramp hold too few cycles to measure, of anybody's run."""
    found = judge(made_of_the_exact_answer(), duration=4.0)
    assert found.passed is None
    assert found.findings["S"]["history"].outcome is Outcome.REFERENCE
    assert found.findings["S"]["amplitude"].outcome is Outcome.UNDECIDED
    assert found.findings["S"]["amplitude"].note.startswith("not measured: ")
    assert found.outcome == "0 of 2 agree, 1 undecided (S), 1 not submitted"


def history_of(submission):
    """The judgement of q(t) alone, which takes no fit."""
    return judged(submission, cases={"S1": replace(CASES["S1"], oscillates=False)})


def test_an_order_below_the_declared_one_is_told_and_decides_nothing(submitted):
    found = history_of(submitted(order=4.0))
    assert found.orders["S1"]["mesh"].low
    assert not found.orders["S1"]["step"].low
    assert str(found.orders["S1"]["mesh"]) == "2.0 of 4"
    assert found.passed


def test_points_of_a_backbone_are_judged_by_their_shift():
    truth = reference(CASES["B"])
    for off, outcome in ((0.0, Outcome.REFERENCE), (0.1, Outcome.DIFFERS)):
        points = []
        for speed in (2.0, 8.0):
            linear = truth.first_frequency(speed)
            shift = truth.frequency_at(0.3, speed) / linear - 1.0
            points += [
                Row(
                    case="B", elements=n, speed=speed, amplitude=0.3,
                    values=(linear * (1.0 + shift * (1.0 + off + 0.3 / n**2)),),
                )
                for n in (8, 16, 32)
            ]  # fmt: skip
        failed = Row(case="B", elements=64, speed=2.0, amplitude=0.3, failure="buckles")
        submission = Submission(declaration=Declaration(code="mine"), rows=(*points, failed))
        found = judged(submission).findings["B"]["backbone"]
        assert found.outcome is outcome
        assert found.model_difference == pytest.approx(off, abs=2e-3)
    alone = judged(replace(submission, rows=(failed,))).findings["B"]["backbone"]
    assert alone.note == "no mesh: buckles"


def test_nonlinear_frequencies_are_over_the_linear_one_of_the_same_code():
    """A code whose frequencies are all 1e-4 too high has the right shifts, of the same blade."""
    truth, off = reference(CASES["B"]), 1e-4
    linear = truth.first_frequency(2.0)
    points = tuple(
        Row(
            case="B", elements=n, speed=2.0, amplitude=0.3,
            values=(truth.frequency_at(0.3, 2.0) * (1.0 + off + 1e-3 / n**2),),
        )
        for n in (16, 32, 64)
    )  # fmt: skip
    rows = tuple(
        Row(elements=n, speed=2.0, values=(linear * (1.0 + off + 1e-3 / n**2),))
        for n in (16, 32, 64)
    )
    submission = Submission(declaration=Declaration(code="mine", order=2.0), rows=(*points, *rows))
    shift = truth.frequency_at(0.3, 2.0) / linear - 1.0
    other = replace(CASES["L"], blade=CASES["L"].blade.with_tip_mass(0.1))
    for known, expected in ((CASES["L"], 0.0), (other, off / shift)):
        of = judged(submission, cases={"L": known, "B": CASES["B"]}).findings
        found, doubt = of["B"]["backbone"], of["L"]["linear frequency"].runs.bar
        assert found.model_difference == pytest.approx(expected, abs=1e-4)
        # The bar of ω_n counts where ω_n is the code's own.
        known_to = truth.bound + (0.0 if expected else doubt)
        assert found.bound == pytest.approx(known_to / shift, rel=1e-12)


def test_thresholds_are_those_that_authors_were_told(judged_right):
    assert list(THRESHOLDS.values()) == [2e-4, 2e-3, 1e-3, 1e-2, 1e-2, 5e-2, 5e-2]
    assert {quantity for _, quantity in judged_right.by_quantity} < set(THRESHOLDS)


@pytest.fixture(scope="module")
def whole(submitted):
    """Histories of a right code, on meshes of 8 to 32 elements."""
    return replace(submitted(), rows=())


@pytest.mark.parametrize("finer", [{"elements": 64, "step": 4e-3}, {"elements": 4, "step": 1e-3}])
def test_a_failed_run_is_told_and_not_judged(whole, finer):
    """A large step of a finer mesh, or a mesh that is too coarse."""
    failed = replace(whole.runs[0], **finer, time=np.empty(0), q=np.empty(0), failure="Newton")
    alone, beside = history_of(whole), history_of(replace(whole, runs=(*whole.runs, failed)))
    assert beside.findings["S1"]["history"].outcome is Outcome.REFERENCE
    assert beside.findings["S1"]["history"].runs.limit == alone.findings["S1"]["history"].runs.limit
    name = f"{finer['elements']} elements at {1e3 * finer['step']:g} ms"
    assert beside.remarks == {"S1": [f"failed, Newton: {name}"]}
    assert name in str(beside)


def test_a_code_that_damps_is_judged_by_its_limit_and_told_how_much(whole):
    """As HHT or generalized-α do by h²; undecided before, for the bar of the amplitude was a."""
    runs = tuple(
        replace(run, q=run.q * np.exp(-5e2 * run.step**2 * np.maximum(run.time - 3.0, 0.0)))
        for run in whole.runs
    )
    found = judged(replace(whole, runs=runs), only=["S1"])
    amplitude = found.findings["S1"]["amplitude"]
    assert amplitude.outcome is Outcome.REFERENCE
    assert amplitude.runs.bar < 1e-3
    (said,) = found.remarks["S1"]
    assert said == (
        "your integrator damps the first mode by 8e-04 of its amplitude per cycle: "
        "32 elements at 1 ms"
    )


def test_copies_of_the_reference_are_named_and_not_judged(whole):
    """Of each mesh the reference, to the digits of a file."""
    runs = tuple(
        replace(run, q=np.round(reference(CASES["S1"]).history(run.time), 8)) for run in whole.runs
    )
    found = history_of(replace(whole, runs=runs))
    assert found.passed is None
    assert "16 elements at 2 ms, 16 elements at 1 ms" in found.remarks["S1"][0]
    assert "the reference itself, to " in found.findings["S1"]["history"].note


def test_identical_histories_are_named_and_judged_once(whole):
    """A script that ignores the mesh has run one mesh only, and one that ignores the step."""
    same = tuple(replace(run, q=whole.runs[0].q) for run in whole.runs)
    found = history_of(replace(whole, runs=same))
    assert found.passed is None
    history = found.findings["S1"]["history"]
    within = f"as run within {abs(history.difference) + history.bound:.0e} of the reference"
    assert history.note == f"{within}, but one mesh has no limit in S1: hand in three"
    assert found.remarks["S1"][0] == (
        "the history of 8 elements at 1 ms to the last digit, mesh or step ignored: "
        "16 elements at 2 ms, 16 elements at 1 ms, 16 elements at 0.5 ms, 32 elements at 1 ms"
    )
    # Beside good runs it changes nothing.
    twice = replace(whole.runs[2], elements=64)
    beside = history_of(replace(whole, runs=(*whole.runs, twice)))
    assert beside.passed
    assert len(beside.remarks["S1"]) == 1
    again = history_of(replace(whole, runs=(*whole.runs, replace(whole.runs[0]))))
    assert again.remarks["S1"] == ["handed in twice: 8 elements at 1 ms"]


def test_what_is_off_by_half_of_what_passes_agrees_and_does_not_converge(submitted):
    found = history_of(submitted(lambda q: 1.005 * q))
    history = found.findings["S1"]["history"]
    assert (history.outcome, found.passed) == (Outcome.AGREES, True)
    assert history.said in ("agrees within 5e-03", "agrees within 6e-03")


def test_the_headline_counts_all_cases(whole):
    found = judged(whole)
    assert found.outcome == "1 of 26 agrees, 25 not submitted"
    coarse = replace(
        found, findings={**found.findings, "O": {"history": Finding(outcome=Outcome.UNDECIDED)}}
    )
    assert coarse.outcome == "1 of 26 agrees, 1 undecided (O), 24 not submitted"
    assert coarse.passed is None
    # An undecided shift, the harder demand, is told behind q(t), and does not pass either.
    right = found.findings["S1"]["history"]
    hard = {"history": right, "nonlinear shift": Finding(outcome=Outcome.UNDECIDED)}
    behind = replace(found, findings={**found.findings, "S4": hard})
    said = f"2 of {len(CASES)} agree, {len(CASES) - 2} not submitted; the shift is undecided in S4"
    assert (behind.outcome, behind.passed) == (said, None)
    wrong = {"history": Finding(outcome=Outcome.DIFFERS)}
    both = replace(coarse, findings={**coarse.findings, "S2": wrong})
    assert both.outcome == "1 of 26 agrees, 1 undecided (O), 1 differs (S2), 23 not submitted"
    assert both.passed is False


@pytest.mark.parametrize(("size", "runs"), [(512.0, {32, 64}), (1e5, set())])
def test_a_coarse_run_that_swings_too_far_has_no_part_in_the_shift(
    made_of_the_exact_answer, size, runs
):
    """Its amplitude is beyond all orbits; errors are size/n², three times q(t) on 16 elements."""
    entry = made_of_the_exact_answer(lambda _, q, n: q * (1.0 + size / n**2), elements=32)
    spin_up = SpinUp(omega=6.0, ramp_time=3.0)
    found = verify(entry, spin_up=spin_up, duration=12.0).findings["S"]["nonlinear shift"]
    if runs:
        assert set(found.runs.elements.tolist()) == runs
    else:
        assert found.note == "all runs swing by more than 0.9 L, where no orbit is known"
