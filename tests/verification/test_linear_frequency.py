"""A linear frequency is judged by what it tends to on the author's own meshes."""

from dataclasses import replace

import numpy as np
import pytest

from analytic import Beam, linear_modes
from analytic.input_checks import RotbeamWarning
from rotbeam_exu.verification.cases import frequency_case
from rotbeam_exu.verification.judgement import judged
from rotbeam_exu.verification.outcomes import Outcome
from rotbeam_exu.verification.verify import Entry, submission_of


def of_frequency(difference, power, size=0.05, higher=0.0, **options):
    """Return a code with no more than a frequency, off by the difference and C/nᵖ (1 + c/n)."""

    def lowest(case, omega, elements):
        exact = linear_modes(case.blade, omega, case.count).frequencies
        return exact * (1.0 + difference + size / elements**power * (1.0 + higher / elements))

    return Entry(name="mine", simulate=None, frequencies=lowest, **options)


def finding(entry, speeds=(0.0, 6.0)):
    case = frequency_case(Beam.reference(), speeds)
    found = judged(submission_of(entry, [case]), cases={"L": case})
    return found.findings["L"]["linear frequency"]


def test_a_coarse_code_is_judged_by_its_limit():
    """On the finest mesh it is off by twice the threshold, and tends to the truth."""
    found = finding(of_frequency(0.0, 1.0, elements=16))
    # Nobody declared the order, and two of it would be as likely.
    assert found.runs.errors[-1] == pytest.approx(0.05 / 32, rel=0.1)
    assert found.outcome is Outcome.UNDECIDED
    meshes = (16, 32, 64, 128)
    found = finding(of_frequency(0.0, 1.0, meshes=meshes, order=1.0))
    assert found.outcome is Outcome.REFERENCE
    assert found.runs.errors[-1] == pytest.approx(0.05 / 128, rel=1e-2)
    assert found.difference == pytest.approx(0.05 / 128, rel=1e-2)


def test_another_limit_is_named():
    found = finding(of_frequency(-3e-3, 2.0, order=2.0))
    assert found.outcome is Outcome.DIFFERS
    assert found.model_difference == pytest.approx(-3e-3, abs=1e-6)


def test_a_judgement_never_gets_worse_by_refining():
    rank = list(Outcome)
    lasts = {0.0: Outcome.REFERENCE, 1.9e-4: Outcome.AGREES}
    for difference, last in lasts.items():
        seen = []
        for elements in 2 ** np.arange(1, 10):
            entry = of_frequency(difference, 2.0, 3.0, -5.0, elements=int(elements))
            seen.append(rank.index(finding(replace(entry, order=2.0)).outcome))
        assert seen == sorted(seen, reverse=True)
        assert seen[0] == rank.index(Outcome.UNDECIDED)
        assert seen[-1] == rank.index(last)


def test_a_theory_that_refuses_a_speed_is_no_verdict_on_the_code():
    burst = 1.01 * Beam.reference().burst_speed
    entry = Entry(name="mine", simulate=None, frequencies=lambda *_: [1.0])
    with pytest.warns(RotbeamWarning, match="rpm"):
        found = finding(entry, (burst,))
    assert found.outcome is Outcome.UNDECIDED
    assert found.note.startswith("no reference at 989.951 rad/s: omega = ")


def test_a_mesh_too_coarse_for_the_code_is_left_out():
    def lowest(case, omega, elements):
        if elements < 8:
            raise RuntimeError("too coarse")
        return linear_modes(case.blade, omega, case.count).frequencies * (1.0 + 0.01 / elements**2)

    entry = Entry(name="mine", simulate=None, frequencies=lowest)
    found = finding(replace(entry, meshes=(4, 8, 16, 32)))
    assert found.outcome is Outcome.REFERENCE
    assert found.runs.values.size == 3
    assert finding(replace(entry, meshes=(2, 4))).note == "no mesh: too coarse"
