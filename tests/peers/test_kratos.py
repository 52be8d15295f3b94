"""KratosMultiphysics, where it is installed."""

import numpy as np
import pytest

from analytic import spin_up_response
from analytic.input_checks import RotbeamWarning
from rotbeam_exu.verification import peers
from rotbeam_exu.verification.cases import CASES, spin_up_case
from rotbeam_exu.verification.peers import NotInstalledError, installed, peer
from rotbeam_exu.verification.peers.kratos import Kratos
from rotbeam_exu.verification.verify import handed_in

needs_kratos = pytest.mark.skipif(
    not installed("kratos"), reason="KratosMultiphysics is not installed (the extra `peers`)"
)


@pytest.mark.skipif(installed("kratos"), reason="KratosMultiphysics is installed")
def test_it_says_how_to_install_it():
    with pytest.raises(NotInstalledError, match=r"not installed; pip install '\.\[peers\]' in a"):
        peer("kratos")


def test_another_peer_is_a_class_and_a_line(monkeypatch):
    class Other(Kratos):
        name = "other"
        package = "Another code"

        def is_installed(self):
            return False

    monkeypatch.setitem(peers.PEERS, "other", Other())
    with pytest.raises(NotInstalledError, match="^Another code is not installed; pip install"):
        peer("other")
    with pytest.raises(ValueError, match="known are 'kratos', 'other'"):
        peer("third")


def test_the_command_line_says_so_too(call, monkeypatch):
    monkeypatch.setattr(peers, "installed", lambda name: False)
    code, _, error = call("verify", "--element", "kratos")
    assert code == 2
    assert "pip install '.[peers]'" in error


@needs_kratos
@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::analytic.input_checks.RotbeamWarning")
def test_it_agrees_with_the_exact_beam(beam, spin_up):
    case = spin_up_case(beam, spin_up, 15.0)
    run = peer("kratos").simulate(case, elements=32, step=5e-4)
    exact = spin_up_response(beam, spin_up, run["time"].to_numpy(), tolerance=1e-6)
    assert np.abs(run["q"] - exact.q).max() < 1e-3 * np.abs(exact.q).max()
    assert np.abs(run["q_dot"] - exact.q_dot).max() < 3e-3 * np.abs(exact.q_dot).max()


@needs_kratos
@pytest.mark.filterwarnings("ignore::analytic.input_checks.RotbeamWarning")
def test_it_converges_with_second_order(beam, spin_up):
    errors = []
    for elements, step in ((8, 2e-3), (16, 1e-3)):
        case = spin_up_case(beam, spin_up, 3.0)
        run = peer("kratos").simulate(case, elements=elements, step=step)
        exact = spin_up_response(beam, spin_up, run["time"].to_numpy(), tolerance=1e-6)
        errors.append(np.abs(run["q"] - exact.q).max().item())
    assert np.log2(errors[0] / errors[1]) == pytest.approx(2.0, abs=0.1)


@needs_kratos
def test_steps_that_did_not_converge_are_counted(beam, spin_up):
    case = spin_up_case(beam, spin_up, 1.0)
    with pytest.warns(RotbeamWarning, match=r"\d+ of 500 steps did not converge to 1e-08; Kratos"):
        run = Kratos(tolerance=1e-8)(case, elements=4, step=2e-3)
    assert 0 < run.attrs["unconverged_steps"] <= 500
    assert "of 500 steps did not converge" in run.attrs["verdict"]


@needs_kratos
def test_bad_input(beam, spin_up):
    case = spin_up_case(beam, spin_up, 15.0)
    with pytest.raises(ValueError, match="elements must be at least 1, got 0"):
        Kratos()(case, elements=0)
    with pytest.raises(ValueError, match="step must be positive"):
        Kratos()(case, step=-1e-3)


def test_a_case_that_it_does_not_do_is_not_submitted():
    """Needs no Kratos: what cannot be done is said before anything is imported."""
    cases = [CASES[name] for name in ("O", "S1+g")]
    assert handed_in(Kratos().entry(), cases).runs == ()
