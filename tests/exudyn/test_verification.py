"""The verdict table: it passes what is right, names what is wrong, and takes anyone's code."""

from dataclasses import replace

import numpy as np
import pytest
import xarray as xr

from analytic import AmplitudeNotReachedError, Beam, linear_modes, spin_up_response
from analytic.input_checks import RotbeamWarning
from rotbeam_exu.cli import main
from rotbeam_exu.fem.elements import Ancf3, Cable, Exact, Linear
from rotbeam_exu.verification import measures
from rotbeam_exu.verification.cost import cost_at_error
from rotbeam_exu.verification.entries import formulation_entry
from rotbeam_exu.verification.linear_frequency import linear_frequency
from rotbeam_exu.verification.measures import THRESHOLDS, verify
from rotbeam_exu.verification.outcomes import Outcome
from rotbeam_exu.verification.peers import Entry, peer
from rotbeam_exu.verification.theory import BERNOULLI_EULER


def truth(beam, spin_up, duration):
    time = np.linspace(0.0, duration, round(duration / 0.01) + 1)
    return time, spin_up_response(beam, spin_up, time, tolerance=1e-6)


def second_order(scale=1.0, drift=0.0):
    """A code of second order in step and mesh, made from the exact answer."""

    def code(beam, spin_up, *, elements, duration, step):
        time, exact = truth(beam, spin_up, duration)
        error = scale * (step**2 + 1e-2 / elements**2)
        q = exact.q * (1.0 + error) + drift * time
        return xr.Dataset({"q": ("time", q), "q_dot": ("time", exact.q_dot)}, {"time": time})

    return code


def test_a_right_code_passes():
    found = verify(Entry(name="mine", simulate=second_order(), elements=32))
    assert found.passed
    assert found.outcome == "passed"
    assert found.measures["order in step"].value == pytest.approx(2.0, abs=1e-3)
    assert found.measures["order in mesh"].value == pytest.approx(2.0, abs=1e-3)
    # The error that was put in, of amplitude and history alike.
    assert found.measures["amplitude"].value == pytest.approx(1e-6 + 1e-2 / 32**2, rel=1e-3)
    assert found.measures["history"].value == pytest.approx(1e-6 + 1e-2 / 32**2, rel=1e-2)
    # The exact answer lies on the exact backbone, a second mode in it notwithstanding.
    assert found.measures["nonlinear frequency"].value < 1e-5
    assert found.measures["linear frequency"].note == "not offered"
    assert "nonlinear frequency" in str(found)


def test_a_drifting_code_falls_short():
    found = verify(Entry(name="drifting", simulate=second_order(drift=0.02)))
    assert not found.passed
    assert found.measures["history"].passed is False
    assert "falls short: " in found.outcome
    assert "history" in found.outcome


def test_a_code_of_another_frequency_is_told_so():
    def slow(beam, spin_up, *, elements, duration, step):
        time = np.arange(0.0, duration, 0.02)
        return xr.Dataset({"q": ("time", 0.1 * np.sin(1.5 * time))}, {"time": time})

    found = verify(Entry(name="slow", simulate=slow))
    assert not found.passed
    assert "times the beam's natural frequency" in found.measures["nonlinear frequency"].note


def test_a_code_that_fails_says_why():
    def broken(beam, spin_up, *, elements, duration, step):
        raise RuntimeError("no license")

    found = verify(Entry(name="broken", simulate=broken))
    assert not found.passed
    assert {m.note for m in found.measures.values() if m.passed is False} == {"no license"}
    assert set(THRESHOLDS) < set(found.measures)


def test_a_formulation_passes():
    found = verify(formulation_entry(Exact(nodes=3)))
    assert found.name == "exact nodes=3"
    assert found.passed, str(found)


@pytest.mark.slow
def test_the_locking_law_falls_short():
    found = verify(formulation_entry(Ancf3(law="coupled")))
    for name in ("linear frequency", "nonlinear frequency", "history"):
        assert found.measures[name].passed is False


def test_cost_is_read_off_a_ladder():
    """An error of second order in a ladder that halves the mesh falls by four a rung."""
    seconds, ladder = cost_at_error(Entry(name="mine", simulate=second_order()), 2e-4)
    assert ladder[:-1, 0] / ladder[1:, 0] == pytest.approx(4.0, rel=1e-2)
    assert ladder[:, 1].min() <= seconds <= ladder[:, 1].max()
    assert np.isnan(cost_at_error(Entry(name="mine", simulate=second_order()), 1e-9)[0])


def test_command_line(capsys):
    main(["verify", "--element", "linear"])
    out = capsys.readouterr().out
    assert "falls short" in out
    assert "linear: the tip's distance from the clamp" in out


def test_command_line_refuses_what_it_does_not_know(capsys):
    with pytest.raises(SystemExit) as stop:
        main(["verify", "--element", "shell"])
    assert stop.value.code == 2
    assert "unknown element 'shell'; known are 'cable'," in capsys.readouterr().err


def test_unknown_peer():
    with pytest.raises(ValueError, match="unknown code 'ansys'; known are 'kratos'"):
        peer("ansys")


def test_a_beam_of_ones_own_is_judged_at_its_own_speeds(tmp_path, capsys):
    """A twentieth as long: 400 times as fast, and the same numbers, for μ hardly matters."""
    (tmp_path / "beam.toml").write_text(
        "[beam]\nlength = 0.4\naxial_stiffness = 2e9\n"
        "bending_stiffness = 566.4\nmass_per_length = 0.202\n"
    )
    main(["verify", "--element", "cable", "--config", str(tmp_path / "beam.toml")])
    shown = capsys.readouterr().out
    assert "ω = 2400 rad/s in T = 0.0075 s" in shown
    assert "passed" in shown


def test_a_reference_that_fails_is_not_charged_to_the_code(monkeypatch):
    def refuses(*_):
        raise AmplitudeNotReachedError("no orbit")

    monkeypatch.setattr(measures, "periodic_orbits", refuses)
    found = verify(Entry(name="mine", simulate=second_order(), elements=32))
    assert found.passed
    assert found.measures["nonlinear frequency"].passed is None
    assert found.measures["nonlinear frequency"].note == "no reference: no orbit"
    assert found.outcome == "passed; no verdict: nonlinear frequency"


def test_an_estimator_that_fails_on_the_exact_answer_is_not_charged_either():
    """Four seconds after the ramp hold too few cycles to measure, of anybody's run."""
    found = verify(Entry(name="mine", simulate=second_order(), elements=32), duration=4.0)
    assert found.passed
    assert found.measures["amplitude"].note.startswith("not measured: ")
    assert found.measures["history"].passed


def of_frequency(difference, power, size=0.05, higher=0.0, **options):
    """Return a code with no more than a frequency, off by the difference and C/nᵖ (1 + c/n)."""

    def first(beam, omega, elements):
        exact = linear_modes(beam, omega, 1).frequencies[0]
        return exact * (1.0 + difference + size / elements**power * (1.0 + higher / elements))

    return Entry(name="mine", simulate=second_order(), first_frequency=first, **options)


def finding(entry, speeds=(0.0, 6.0)):
    return linear_frequency(entry, Beam.reference(), speeds, THRESHOLDS["linear frequency"])


def test_a_coarse_code_is_judged_by_its_limit():
    """On the finest mesh it is off by twice the threshold, and tends to the truth."""
    found = finding(of_frequency(0.0, 1.0, elements=16))
    assert found.runs.errors[-1] == pytest.approx(0.05 / 32, rel=1e-2)
    assert found.outcome is Outcome.NO_VERDICT  # nobody declared the order
    found = finding(of_frequency(0.0, 1.0, elements=64, order=1.0))
    assert found.outcome is Outcome.REFERENCE
    assert found.runs.errors[-1] == pytest.approx(0.05 / 128, rel=1e-2)


def test_another_limit_is_named():
    found = finding(of_frequency(-3e-3, 2.0, order=2.0))
    assert found.outcome is Outcome.ANOTHER_LIMIT
    assert found.model_difference == pytest.approx(-3e-3, abs=1e-6)


def test_a_verdict_never_gets_worse_by_refining():
    rank = list(Outcome)
    for difference in (0.0, 1.5e-4, 1.99e-4):
        seen = []
        for elements in 2 ** np.arange(1, 10):
            entry = of_frequency(difference, 2.0, 3.0, -5.0, elements=int(elements))
            seen.append(rank.index(finding(replace(entry, order=2.0)).outcome))
        assert seen == sorted(seen, reverse=True)
        assert seen[0] == rank.index(Outcome.NO_VERDICT)
        assert seen[-1] == rank.index(Outcome.REFERENCE)


@pytest.mark.parametrize("elements", [8, 16, 32])
def test_the_quadratic_exact_element_converges_on_any_meshes(elements):
    found = finding(formulation_entry(Exact(nodes=3), elements=elements), (0.0, 8.0))
    assert found.outcome is Outcome.REFERENCE, str(found)


def test_the_locking_law_converges_to_another_limit():
    """Its bending stiffness is E/(1 - ν²): frequencies higher by (1 - ν²)^(-1/2) at rest."""
    found = finding(formulation_entry(Ancf3(law="coupled")), (0.0, 2.0))
    assert found.outcome is Outcome.ANOTHER_LIMIT
    assert found.model_difference == pytest.approx((1.0 - 0.3**2) ** -0.5 - 1.0, rel=1e-4)


@pytest.mark.parametrize("poisson_ratio", [0.0, 0.3])
def test_a_beam_that_shears_has_its_own_truth(poisson_ratio):
    """Against Bernoulli and Euler's beam it is off by 8e-5 of shear and rotary inertia."""
    entry = formulation_entry(Exact(nodes=3, poisson_ratio=poisson_ratio), elements=16)
    found = finding(entry, (0.0, 8.0))
    assert abs(found.model_difference) < 5e-7
    thin = finding(replace(entry, theory=BERNOULLI_EULER), (8.0,))
    assert -1e-4 < thin.model_difference < -5e-5


def test_each_element_that_converges_is_told_so():
    for model in (Cable(), Exact(), Ancf3(poisson_ratio=0.0)):
        found = finding(formulation_entry(model), (0.0, 8.0))
        assert found.outcome is Outcome.REFERENCE, str(found)


def test_the_linear_frame_does_not_converge():
    found = finding(formulation_entry(Linear()))
    assert found.outcome is Outcome.NO_LIMIT
    assert "is unstable" in found.note


def test_a_theory_that_refuses_a_speed_is_no_verdict_on_the_code():
    burst = 1.01 * Beam.reference().burst_speed
    entry = Entry(name="mine", simulate=second_order(), first_frequency=lambda *_: 1.0)
    with pytest.warns(RotbeamWarning, match="rpm"):
        found = finding(entry, (burst,))
    assert found.outcome is Outcome.NO_VERDICT
    assert found.note.startswith("no reference: omega = ")


def test_a_mesh_too_coarse_for_the_code_is_left_out():
    def first(beam, omega, elements):
        if elements < 8:
            raise RuntimeError("too coarse")
        return linear_modes(beam, omega, 1).frequencies[0] * (1.0 + 0.01 / elements**2)

    entry = Entry(name="mine", simulate=second_order(), first_frequency=first)
    found = finding(replace(entry, meshes=(4, 8, 16, 32)))
    assert found.outcome is Outcome.REFERENCE
    assert found.runs.values.size == 3
    assert finding(replace(entry, meshes=(2, 4))).note == "too coarse"


def test_an_order_below_the_declared_one_falls_short():
    code = second_order()
    found = verify(Entry(name="mine", simulate=code, order=4.0))
    assert found.measures["order in mesh"].passed is False
    assert found.measures["order in step"].passed


def test_what_has_converged_below_the_floor_has_no_order_and_passes():
    def code(beam, spin_up, *, elements, duration, step):
        return second_order(1e-4)(beam, spin_up, elements=10**6, duration=duration, step=step)

    found = verify(Entry(name="mine", simulate=code, order=2.0))
    for name in ("order in mesh", "order in step"):
        assert found.measures[name].note == "not measured: the changes are below the floor"
    assert found.outcome == "passed"
