"""Claims of the README and of the page of findings."""

import re
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from analytic import Beam, SpinUp, Theory, linear_modes, periodic_orbits, reduced_model
from docs.sentences import PAGES
from rotbeam_exu import natural_frequencies, simulate, steady_oscillation
from rotbeam_exu.fem.elements import Cable, Exact, Linear
from rotbeam_exu.files.beam_file import load_beam
from rotbeam_exu.verification.entries import formulation_entry
from rotbeam_exu.verification.verify import verify

ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text(encoding="utf-8")
FINDINGS = (ROOT / "docs/findings.md").read_text(encoding="utf-8")
FLAT = " ".join(FINDINGS.split())


def test_the_lambda_table_is_computed(beam):
    """Every entry is what the code gives, to the digits shown."""
    header = re.search(r"^\| ω \[rad/s\] \|(.*)\|$", FINDINGS, re.MULTILINE).group(1)
    names = [name.strip() for name in header.split("|")]
    rows = re.findall(r"^\| ([2468]) \|(.*)\|$", FINDINGS, re.MULTILINE)
    assert [row[0] for row in rows] == ["2", "4", "6", "8"]
    for omega, cells in rows:
        for name, cell in zip(names, cells.split("|"), strict=True):
            found = (
                periodic_orbits(beam, float(omega), [0.05]).lambda_omega
                if name == "exact"
                else reduced_model(beam, float(omega), name).lambda_omega
            )
            assert f"{found:.5f}" == cell.strip(), (omega, name)


def test_the_toml_block_is_the_reference_beam(beam, tmp_path):
    block = re.search(r"```toml\n(.*?)```", README, re.DOTALL).group(1)
    (tmp_path / "beam.toml").write_text(block, encoding="utf-8")
    assert load_beam(tmp_path / "beam.toml") == beam


def golden_points(mesh):
    """Amplitude, and ω_NL over the mesh's own ω_n, of the 24 spin-ups, by speed."""
    golden = pd.read_csv(ROOT / "tests/comparison/golden/figure_14-amplitude.csv")
    for omega, here in golden[golden["mesh"] == mesh].groupby("omega [rad/s]"):
        yield omega, here["amplitude"].to_numpy(), here["ratio"].to_numpy()


@pytest.mark.parametrize(
    ("mesh", "elements", "claimed"), [("converged", 64, 3e-7), ("paper", 16, 6e-5)]
)
def test_simulation_and_exact_backbone_agree_as_said(beam, mesh, elements, claimed):
    """ω_NL of the finite elements in Figure 14 against the exact one at the same amplitude."""
    assert "Of the paper's 24 spin-ups 21 stay below a = 0.6." in FLAT
    assert "agree with the exact ω_NL to 3e-7; the defaults, 16 elements at 1 ms, to 6e-5" in FLAT
    assert f"{claimed:.0e}".replace("e-0", "e-") in README
    home = (ROOT / "docs/index.md").read_text(encoding="utf-8")
    assert (
        "**3e-7**\n[agreement](findings.md) of 64 finite elements with the exact frequency" in home
    )
    errors = []
    for omega, amplitude, ratio in golden_points(mesh):
        inside = amplitude < 0.6
        omega_n = natural_frequencies(beam, omega, elements=elements, count=1)[0]
        exact = periodic_orbits(beam, omega, amplitude[inside])
        errors.extend(ratio[inside] * omega_n / exact.frequency - 1.0)
        # As Figure 14 draws them, each over the ω_n of its own mesh.
        assert np.abs(ratio[inside] - exact.frequency / exact.omega_n).max() < claimed
    assert len(errors) == 21
    # Neither more than was measured, nor much less.
    assert 0.6 * claimed < np.abs(errors).max() < claimed


def shares(element, spin_up):
    """Errors of ω_NL from the mesh and from the step, of 16 elements at 1 ms.

    The error of the step is of second order: a third of what 2 ms changes.
    """
    beam, off = Beam.reference(), {}
    for step in (2e-3, 1e-3):
        steady = steady_oscillation(
            simulate(beam, spin_up, element=element, elements=16, step=step)
        )
        orbit = periodic_orbits(beam, spin_up.omega, [steady.amplitude])
        off[step] = steady.frequency / orbit.frequency[0] - 1.0
    of_step = (off[2e-3] - off[1e-3]) / 3.0
    return off[1e-3] - of_step, of_step


def test_the_linear_beam_of_the_film_is_lost_as_said(beam):
    """Where the speed of Eq. 1 reaches the first natural frequency at rest."""
    motion, times = SpinUp(omega=4.0, ramp_time=3.0), np.linspace(0.0, 3.0, 30_001)
    lost = np.interp(beam.omega_0, motion.rate(times), times)
    said = f"unstable from {lost:.2f} s on"
    for page in ("README.md", "docs/index.md"):
        assert said in " ".join((ROOT / page).read_text(encoding="utf-8").split()), page
    explorer = (ROOT / "docs/explorer.md").read_text(encoding="utf-8")
    assert f"first natural frequency at rest, {beam.omega_0:.2f} rad/s" in explorer


QUANTITIES = (
    ("L", "linear frequency"), ("S1", "history"), ("S1", "nonlinear shift"),
    ("O", "nonlinear shift"), ("S4", "history"),
)  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize(
    ("row", "element"),
    [
        ("`cable`", Cable()), ("`exact`", Exact()), ("`exact`, `nodes=3`", Exact(nodes=3)),
        ("`linear`", Linear()),
    ],
)  # fmt: skip
def test_codes_tend_to_what_the_table_of_formulations_says(row, element):
    """Limits to their bars; what they are less than is not compared."""
    page = (ROOT / "docs/validation.md").read_text(encoding="utf-8")
    cells = re.search(rf"^\| {re.escape(row)} \|(.*)\|$", page, re.MULTILINE).group(1).split("|")
    entry = formulation_entry(element)
    found = verify(entry)
    assert cells[1].strip() == ", ".join(map(str, entry.own_meshes))
    for key, cell in zip(QUANTITIES, cells[2:7], strict=True):
        said = cell.strip()
        finding = found.by_quantity.get(key)
        if finding is None or not np.isfinite(finding.model_difference):
            failed = finding is not None and finding.outcome.passed is False
            assert said in ("", "none!" if failed else "none?")
            continue
        limit, bar = map(float, said.rstrip("!?").split("±"))
        # One digit of a limit is told.
        error = max(1.5 * bar, 0.1 * abs(limit))
        assert finding.model_difference == pytest.approx(limit, abs=error)
        assert said.endswith("!") == (finding.outcome.passed is False)
    assert cells[8].strip() == found.outcome


@pytest.mark.slow
def test_mesh_and_step_at_the_worst_of_the_spin_ups():
    assert "up to +9e-5 comes from the mesh and up to -3.3e-5 from the time step" in FLAT
    of_mesh, of_step = shares(Cable(), SpinUp(omega=8.0, ramp_time=2.5))
    assert of_mesh == pytest.approx(9e-5, rel=0.05)
    assert of_step == pytest.approx(-3.3e-5, rel=0.05)


@pytest.mark.filterwarnings("ignore::analytic.input_checks.RotbeamWarning")
def test_to_leading_order_is_said_of_the_inextensible_beam():
    assert "higher by 4 to 5 times μ = I/(AL²): 1e-5 for this beam" in FLAT
    assert "up to ω̄ = 500 at least" in FLAT
    beam = Beam.reference()
    for omega in (2.0, 4.0, 6.0, 8.0):
        by_orbits = [
            periodic_orbits(beam, omega, [0.05], theory=Theory(extension=not rigid)).lambda_omega
            for rigid in (False, True)
        ]
        assert 3.9 < (by_orbits[0] - by_orbits[1]) / beam.slenderness < 5.4
        assert reduced_model(beam, omega, "FrM").lambda_omega == pytest.approx(
            by_orbits[1], abs=2e-8
        )
    fast = reduced_model(beam, 500.0 * beam.frequency_scale, "FrM")
    exact = linear_modes(beam, fast.omega, 1, theory=Theory(extension=False)).frequencies[0]
    assert fast.omega_n == pytest.approx(exact, rel=1e-8)


@pytest.mark.filterwarnings("ignore::analytic.input_checks.RotbeamWarning")
@pytest.mark.parametrize("omega", [4.0, 6.0])
def test_fre_beats_frm_from_about_a_half_on(beam, omega):
    orbits = periodic_orbits(beam, omega, [0.4, 0.6])
    off = {
        name: np.abs(
            model.frequency(orbits.first_harmonic) / model.omega_n
            - orbits.frequency / orbits.omega_n
        )
        for name, model in ((n, reduced_model(beam, omega, n)) for n in ("FrE", "FrM"))
    }
    assert off["FrM"][0] < 0.5 * off["FrE"][0]
    assert off["FrE"][1] < off["FrM"][1]


def test_fre_is_within_6_to_29_percent(beam):
    off = [
        reduced_model(beam, omega, "FrE").lambda_omega
        / periodic_orbits(beam, omega, [0.05]).lambda_omega
        - 1.0
        for omega in (2.0, 4.0, 6.0, 8.0)
    ]
    assert [round(100.0 * abs(value)) for value in off] == [6, 19, 20, 29]


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::analytic.input_checks.RotbeamWarning")
@pytest.mark.parametrize(("omega", "reached"), [(2.0, 0.83), (4.0, 0.88), (6.0, 0.90), (8.0, 0.90)])
def test_the_exact_backbone_reaches_as_far_as_said(beam, omega, reached):
    said = "= 0.83 at 2 rad/s, 0.88 at 4, 0.90 at 6 and 0.90 at 8"
    assert said in FLAT
    trust = (ROOT / "docs/theory/trust.md").read_text(encoding="utf-8").replace("$", "")
    assert said in " ".join(trust.split())
    orbit = periodic_orbits(beam, omega, [reached])
    assert orbit.residual[0] < 1e-4
    # It ends: what it cannot resolve it refuses.
    with pytest.raises(RuntimeError, match="no orbit"):
        periodic_orbits(beam, omega, [reached + 0.05])


@pytest.mark.filterwarnings("ignore::analytic.input_checks.RotbeamWarning")
def test_peak_and_first_harmonic_are_5_percent_apart(beam):
    orbit = periodic_orbits(beam, 6.0, [0.75])
    assert orbit.first_harmonic[0] / 0.75 - 1.0 == pytest.approx(0.05, abs=0.005)


def test_tests_that_pages_name_exist():
    files = [path.as_posix() for path in (ROOT / "tests").rglob("*.py")]
    named = {
        name
        for page in PAGES
        for name in re.findall(r"`(?:tests/)?([\w/]*test_\w+\.py)`", page.read_text("utf-8"))
    }
    assert len(named) > 20
    assert [name for name in named if not any(f.endswith(f"/{name}") for f in files)] == []


@pytest.mark.parametrize("link", re.findall(r"\]\(((?!http)[^)#]+)\)", README))
def test_links_resolve(link):
    assert (Path(__file__).parents[2] / link).exists()
