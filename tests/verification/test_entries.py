"""Our formulations and their limits: what is right is told so, what is wrong is named."""

from dataclasses import replace

import numpy as np
import pytest

from analytic import Beam
from analytic.theory import BERNOULLI_EULER
from rotbeam_exu.fem.elements import Ancf3, Cable, Exact, Linear, SpaceExact
from rotbeam_exu.verification.cases import CASES, frequency_case
from rotbeam_exu.verification.entries import formulation_entry
from rotbeam_exu.verification.judgement import judged
from rotbeam_exu.verification.outcomes import Outcome
from rotbeam_exu.verification.references import reference
from rotbeam_exu.verification.verify import submission_of


def finding(entry, speeds=(0.0, 6.0)):
    case = frequency_case(Beam.reference(), speeds)
    found = judged(submission_of(entry, [case]), cases={"L": case})
    return found.findings["L"]["linear frequency"]


def test_the_locking_law_converges_to_another_limit():
    """Its bending stiffness is E/(1 - ν²): frequencies higher by (1 - ν²)^(-1/2) at rest."""
    found = finding(formulation_entry(Ancf3(law="coupled")), (0.0, 2.0))
    assert found.outcome is Outcome.DIFFERS
    assert found.model_difference == pytest.approx((1.0 - 0.3**2) ** -0.5 - 1.0, rel=1e-4)


def test_a_beam_that_shears_has_its_own_truth():
    """Against Bernoulli and Euler's beam it is off by 8e-5 of shear and rotary inertia."""
    entry = formulation_entry(Exact(nodes=3), elements=16)
    found = finding(entry, (0.0, 8.0))
    assert abs(found.model_difference) < 5e-7
    thin = finding(replace(entry, theory=BERNOULLI_EULER), (8.0,))
    assert -1e-4 < thin.model_difference < -5e-5


def test_each_element_that_converges_is_told_so():
    found = finding(formulation_entry(Cable()), (0.0, 8.0))
    assert found.outcome is Outcome.REFERENCE, str(found)
    # The paper's element is off by 8e-5, which is significant.
    found = finding(formulation_entry(Ancf3(poisson_ratio=0.0), elements=16), (0.0, 8.0))
    assert found.outcome is Outcome.AGREES, str(found)
    assert found.within < 1e-4


def test_the_linear_frame_does_not_converge():
    found = finding(formulation_entry(Linear()))
    assert found.outcome is Outcome.UNDECIDED
    assert "is unstable" in found.note


@pytest.mark.parametrize("name", ["S1+g", "S1+h"])
def test_loads_and_blades_reach_an_element(name):
    """Without its weight or its hub the tip would be off by as much as it swings."""
    case = replace(CASES[name], duration=4.0)
    run = formulation_entry(Cable()).simulate(case, elements=8, step=4e-3)
    off = run["q"] - reference(case).history(run["time"].to_numpy())
    assert np.abs(off).max() < 0.05 * np.abs(run["q"]).max()


def test_a_case_that_an_element_does_not_do_is_not_submitted():
    linear, locking = formulation_entry(Linear()), formulation_entry(Ancf3(law="coupled"))
    assert submission_of(linear, [CASES["S1+h"]]).runs == ()
    assert submission_of(locking, [CASES["O"]]).runs == ()


def test_coarse_meshes_in_space_tend_to_the_reference():
    """Of seven frequencies, twisted and coned, and of the tip: of second order, or undecided."""
    entry = replace(formulation_entry(SpaceExact()), elements=8, meshes=(4, 8, 16), step=1e-2)
    cases = replace(CASES["F+p"], speeds=(3.0,), count=3), replace(CASES["W"], duration=5.0)
    found = judged(submission_of(entry, cases), cases={case.name: case for case in cases})
    for one in found.by_quantity.values():
        assert one.outcome is not Outcome.DIFFERS
        assert one.runs.orders["mesh"].value == pytest.approx(2.0, abs=0.15)
        assert abs(one.runs.limit) < one.runs.bar
    # It has no blade in the plane whose stiffness out of it is unknown, and the cable no space.
    assert not submission_of(entry, [CASES["L"], CASES["S1"]]).runs
    assert not submission_of(formulation_entry(Cable()), cases).rows


@pytest.mark.slow
def test_the_element_in_space_passes_on_the_meshes_of_the_kit():
    """A minute: frequencies within 3e-5 with a bar of 3e-4, and the tip within 1e-4."""
    entry = formulation_entry(SpaceExact(), step=2.5e-3)
    found = judged(submission_of(entry, [CASES["F"], CASES["F+p"]]))
    assert found.outcome == "2 of 26 agree, 24 not submitted", str(found)
    found = judged(submission_of(replace(entry, meshes=(16, 32, 64)), [CASES["W"]]))
    assert found.outcome_of("W") is Outcome.REFERENCE, str(found)


@pytest.mark.slow
def test_a_stout_element_passes_by_its_own_theory_alone():
    entry = formulation_entry(Exact(nodes=3), step=2e-3)
    submission = submission_of(entry, [CASES["TL"], CASES["T"]])
    assert judged(submission).outcome == "2 of 26 agree, 24 not submitted"
    others = [theory for theory in CASES["T"].theories if theory != entry.theory]
    assert len(others) == 5
    for theory in others:
        declared = replace(submission.declaration, theory=theory)
        assert judged(replace(submission, declaration=declared)).passed is False


@pytest.mark.slow
def test_a_beam_of_ones_own_is_judged_at_its_own_speeds(call, tmp_path, monkeypatch):
    """A twentieth as long: 400 times as fast, and the same numbers, for μ hardly matters."""
    monkeypatch.setenv("COLUMNS", "200")
    (tmp_path / "beam.toml").write_text(
        "[beam]\nlength = 0.4\naxial_stiffness = 2e9\n"
        "bending_stiffness = 566.4\nmass_per_length = 0.202\n"
    )
    shown = call("verify", "--element", "cable", "--config", tmp_path / "beam.toml")[1]
    assert "ω = 2400 rad/s in T = 0.0075 s" in shown
    assert "2 of 2 agree" in shown
