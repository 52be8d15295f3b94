"""The tier of real blades: what its tables say, its references, and codes that do it."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from analytic import Theory, steady_state
from analytic.arrays import evaluated
from rotbeam_exu.fem.elements import formulation
from rotbeam_exu.files.beam_file import load_beam
from rotbeam_exu.verification import kit
from rotbeam_exu.verification.cases import CASES, SHEAR
from rotbeam_exu.verification.entries import formulation_entry
from rotbeam_exu.verification.judgement import judged
from rotbeam_exu.verification.mistakes import mistakes_in
from rotbeam_exu.verification.outcomes import Outcome
from rotbeam_exu.verification.references import reference
from rotbeam_exu.verification.space_cases import ROOT, TIP
from rotbeam_exu.verification.submission_files import read_submission, write_submission
from rotbeam_exu.verification.verify import submission_of, verify
from tests.verification.test_in_space import submitted

BLADES = Path(__file__).parents[2] / "models" / "blades"
FILES = {"N": BLADES / "nrel_5mw.toml", "I": BLADES / "iea_15mw.toml"}
SHEARED = Theory(shear=SHEAR)
TIER = ["F+N", "G+N", "W+N", "F+I", "G+I", "W+I"]


@pytest.mark.parametrize("name", FILES)
def test_the_tables_are_the_blades_that_come_with_the_models(name):
    shipped, blade = load_beam(FILES[name]), CASES[f"F+{name}"].blade
    assert (blade.line, blade.hub_radius) == (shipped.line, shipped.hub_radius)
    assert blade.section.x == shipped.section.x
    assert np.array(blade.section.stiffness) == pytest.approx(np.array(shipped.section.stiffness))
    mass = np.array(blade.section.mass)
    assert mass == pytest.approx(np.array(shipped.section.mass), rel=6e-6)  # the polar one
    assert np.array_equal(mass[:, 3, 3], mass[:, 4, 4] + mass[:, 5, 5])  # as BeamDyn asks
    assert blade.section.interpolation == "matrix"  # as the problem says, and BeamDyn has it


@pytest.mark.parametrize("name", FILES)
def test_the_line_of_the_kit_is_its_curvatures_integrated(name):
    """By an integrator of ordinary differential equations, as the problem has curvature."""
    table = kit.kit_files()[f"blades/{name}_line.csv"].decode().splitlines()
    rows = np.loadtxt(table, delimiter=",", skiprows=2)
    blade, x = CASES[f"F+{name}"].blade, rows[:, 0]
    line, length = blade.line, blade.length

    def turned_by_twist(at):
        about = evaluated(line.twist, np.atleast_1d(at))[:, None] * [1.0, 0.0, 0.0]
        return Rotation.from_rotvec(about).as_matrix()

    def rates(at, y):
        """Of the place and of a frame that the twist does not turn, R' = R κ×."""
        bow = [float(evaluated(one, np.array([at]))[0]) for one in (line.prebend, line.sweep)]
        k1, k2, k3 = turned_by_twist(at)[0] @ [0.0, *bow]
        cross = np.array([[0.0, -k3, k2], [k3, 0.0, -k1], [-k2, k1, 0.0]])
        turn = y[3:].reshape(3, 3)
        return np.concatenate((turn[:, 0], (turn @ cross).ravel()))

    start = np.concatenate((np.zeros(3), np.eye(3).ravel()))
    found = solve_ivp(rates, (0.0, length), start, t_eval=x, rtol=1e-9, atol=1e-10, max_step=0.5)
    assert rows[:, 1:4] == pytest.approx(found.y[:3].T, abs=1e-5)
    sections = found.y[3:].T.reshape(-1, 3, 3) @ turned_by_twist(x)
    axes = np.swapaxes(rows[:, 4:].reshape(-1, 3, 3), 1, 2)  # X1, Y1, Z1, X2 and so on
    assert axes == pytest.approx(sections, abs=1e-6)
    assert np.linalg.norm(rows[-1, 1:4]) == pytest.approx(length, rel=2e-3)


@pytest.mark.parametrize("theory", [Theory(), SHEARED], ids=str)
def test_a_right_code_converges_from_files_as_well(theory, tmp_path):
    submission = submitted(TIER, theory)
    found = judged(submission)
    assert [found.outcome_of(name) for name in found.findings] == [Outcome.REFERENCE] * len(TIER)
    assert all(source.startswith("shipped") for source in found.sources.values())
    files = read_submission(write_submission(submission, tmp_path / "mine"))
    assert str(judged(files)) == str(found)


def test_references_are_known_to_a_hundredth_of_what_passes():
    """Frequencies and steady states to 1e-6 or so; histories with moments to 2e-5."""
    for name in TIER:
        most = 2e-5 if name.startswith("W") else 2e-6
        assert all(reference(CASES[name], theory).bound < most for theory in (Theory(), SHEARED))


@pytest.mark.parametrize("name", FILES)
def test_the_root_carries_the_weight_at_rest(name):
    """Force and place of the deflected blade give the moment, and weight is that of the table."""
    case = CASES[f"W+{name}"]
    (_, _, _, *moment) = reference(case, SHEARED).history(0.0).tolist()
    theory = case.theory_of(SHEARED)
    state = steady_state(case.blade, 0.0, loads=case.loads, theory=theory)
    x = np.linspace(0.0, case.blade.length, 4001)
    loads = state.section_loads(x)
    mass = case.blade.section.matrices(x)[1]
    arm = np.stack((0.0 * x, -mass[:, 0, 5], mass[:, 0, 4]), axis=-1) / mass[:, :1, 0]
    center = loads.place + (loads.section @ arm[..., None])[..., 0]
    pull = np.cross(center, [0.0, -9.81, 0.0]) * mass[:, :1, 0]
    assert np.trapezoid(pull, x, axis=0) == pytest.approx(moment, rel=2e-5, abs=50.0)


@pytest.mark.parametrize(
    ("factors", "name"),
    [
        ((1.0, 1.0, 1.0, -1.0, -1.0, -1.0), "sign of the moment"),
        ((1.0, 1.0, 1.0, 1e-3, 1e-3, 1e-3), "kN m"),
        ((1.0, 1.0, 57.29577951308232, 1.0, 1.0, 1.0), "degrees"),
        ((1.0, 1.0, 1.0, 1.0, 1.0, 1.1), None),
    ],
)
def test_mistakes_in_the_root_s_moment_are_named(factors, name):
    submission = submitted(["W+N"], change=lambda q: q * factors)
    found = mistakes_in(submission, judged(submission))
    assert [one.name for one in found] == [name] * (name is not None)


def test_a_code_without_shear_that_says_otherwise_is_told():
    submission = submitted(["F+I"], Theory(), SHEARED)
    found = mistakes_in(submission, judged(submission))
    assert [one.name for one in found] == ["tags"]


def test_rows_of_the_kit_name_the_table():
    document = json.loads(kit.kit_files()["cases.json"])
    rows = {row["id"]: row for row in document["cases"]}
    assert rows["W+I"]["stations"] == "blades/I.csv"
    assert rows["W+I"]["start"] == "equilibrium"
    assert rows["W+I"]["EA"] is rows["W+I"]["twist"] is None
    assert rows["S1"]["stations"] is rows["S1"]["start"] is None
    other = replace(CASES["F+N"], blade=CASES["F+N"].blade.with_sweep((1e-3,)))
    with pytest.raises(ValueError, match="F\\+N has line = "):
        kit.row_of(other)


ENTRY = formulation_entry(formulation("space_exact"))


@pytest.mark.parametrize("names", [("F+N", "G+N"), ("F+I", "G+I")])
def test_exudyn_converges_to_the_tables(names):
    cases = [replace(CASES[name], speeds=CASES[name].speeds[-1:]) for name in names]
    found = judged(submission_of(ENTRY, cases))
    for name in names:
        (finding,) = found.findings[name].values()
        _near(finding, str(found))


def _near(finding, said):
    """Frequency 5 and the twist want 300 elements to be decided; their limits are near at 128."""
    assert finding.outcome is not Outcome.DIFFERS, said
    assert abs(finding.model_difference) < 1e-3, said
    assert finding.runs.orders["mesh"].value == pytest.approx(2.0, abs=0.4), said


def test_cases_that_a_code_does_not_do_are_refused():
    plane = formulation_entry(formulation("cable"))
    with pytest.raises(ValueError, match=r"cable is judged by cases in the plane, and F\+N is of"):
        verify(plane, cases=["S1", "F+N"])
    with pytest.raises(ValueError, match="leave out --config, or blade and spin_up"):
        verify(plane, blade=CASES["S1"].blade, cases=["S1"])


@pytest.mark.slow
@pytest.mark.parametrize("name", ["W+N", "W+I"])
def test_exudyn_comes_near_the_run_up(name):
    """All columns; the torque at the root swings from mesh to mesh, so that no limit is decided."""
    entry = replace(ENTRY, elements=64, meshes=(32, 64, 128), step=4e-3)
    found = judged(submission_of(entry, [CASES[name]]))
    (finding,) = found.findings[name].values()
    assert finding.outcome is not Outcome.DIFFERS, str(found)
    assert "root_moment_x" in finding.note
    histories = found.histories[name]
    assert histories.case.columns == (*TIP, *ROOT)
    assert np.abs(histories.differences[histories.finest]).max() < 1e-2
