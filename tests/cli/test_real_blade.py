"""NREL's blade of 49 stations, and a stranger's table, through the commands that take a blade."""

import math
from pathlib import Path
from types import SimpleNamespace

import pytest
import xarray as xr

from analytic import SpinUp, linear_modes
from rotbeam_exu import simulate
from rotbeam_exu.cli.request import uses
from rotbeam_exu.fem.case import RunCase
from rotbeam_exu.files.blade_toml import blade_toml
from rotbeam_exu.verification.assessment import assess
from tests.beams import irregular

NREL = Path(__file__).parents[2] / "models" / "blades" / "nrel_5mw_edgewise.toml"
SPEED = ("--omega", "1.267")
MOTION = (*SPEED, "--ramp-time", "3")
MESH = ("--elements", "4", "--step", "0.01", "--duration", "10")


@pytest.mark.filterwarnings("ignore::analytic.input_checks.RotbeamWarning")
@pytest.mark.parametrize(
    ("command", "told"),
    [
        (("run", *MOTION, *MESH, "--no-figure"), "written"),
        (
            ("reference", *MOTION, "--duration", "4", "--samples", "9", "--tolerance", "1e-5"),
            "written",
        ),
        (("sweep", *MOTION, *MESH, "--jobs", "1"), "written"),
        # Its first frequency in rotation, in rad/s.
        (("backbone", *SPEED, "--variant", "FrM", "--exact", "--amplitude", "0.1"), "7.0"),
        (("campbell", "--omega-max", "2", "--points", "3"), "7.0"),
        (("animate", *MOTION, "--duration", "1", "--rate", "2", "-o", "film.gif"), "written"),
    ],
    ids=lambda command: command[0],
)
def test_a_command_takes_it(call, tmp_path, monkeypatch, command, told):
    """A ramp's residual vibration, and the response of this blade, are tested in the theory."""
    monkeypatch.chdir(tmp_path)
    code, out, error = call(*command, "--config", NREL)
    assert code == 0, error
    assert told in out
    for path in tmp_path.glob("**/*.nc"):
        with xr.open_dataset(path) as data:
            assert sum(map(int, data.isnull().sum().values())) < sum(v.size for v in data.values())


def test_a_twisted_blade_that_is_not_set_has_a_campbell_diagram_and_a_backbone(call, tmp_path):
    """Its flap, lag and torsion go together, so no family is asked for."""
    file = tmp_path / "twisted.toml"
    file.write_text(
        "[blade]\nlength = 8.0\nline = { twist = [0.0, 0.5] }\n[blade.section]\n"
        "axial_stiffness = 5e6\nbending_stiffness = 566.0\nmass_per_length = 0.2\n"
        "out_of_plane = { bending_ratio = 0.1, torsion_ratio = 0.09 }\n"
    )
    code, out, error = call("campbell", "--points", "2", "--orders", "1", "--config", file)
    assert code == 0, error
    assert "flap 2" in out
    # Alone, for the models are of the plane.
    code, out, error = call(
        "backbone", "--omega", "2", "--exact", "--amplitude", "0.1", "--config", file
    )
    assert code == 0, error
    assert "exact/ω_n" in out


STRANGER = irregular(2, 0.005, 6)
"""A table of a stranger: twist, a cone, steps at the root, jumping centers."""


@pytest.fixture
def stranger(tmp_path):
    (tmp_path / "stranger.toml").write_text(blade_toml(STRANGER))
    return tmp_path / "stranger.toml"


def request_of(file):
    """Return the request of `rotbeam run` of a file alone."""
    kept = []
    uses("speed", "ramp_time", "discretization", "loads", "damping")(kept.append)(config=file)
    return kept[0]


def test_without_options_a_table_is_run_up_like_a_rotor_in_space(stranger):
    case = request_of(stranger).case()
    omega_0, spin_up = STRANGER.omega_0, case.spin_up
    assert case.element.name == "space_exact"
    # To two digits of each.
    assert spin_up.omega == pytest.approx(0.515 * omega_0, rel=0.05)
    assert spin_up.ramp_time == pytest.approx(61.0 / omega_0, rel=0.05)
    assert (case.duration - spin_up.ramp_time) * omega_0 == pytest.approx(10 * math.pi, rel=0.3)


@pytest.mark.slow
@pytest.mark.parametrize("command", ["run", "reference", "campbell", "sweep"])
def test_a_command_without_options_answers(call, stranger, tmp_path, command):
    one = ["--omega", "2", "--ramp-time", "15"] if command == "sweep" else []
    code, out, error = call(command, *one, "--config", stranger, "-o", tmp_path / "results")
    assert code == 0, error
    assert "written" in out


def test_the_tip_of_a_twisted_blade_is_compared_with_the_mode_in_which_it_swings():
    """It swung in flap 1 and was compared with lag 1: an error of -36 % was told."""
    case = RunCase(
        blade=STRANGER, spin_up=SpinUp(omega=2.4, ramp_time=12.0), element="space_exact", step=0.01
    )
    modes = linear_modes(STRANGER, 2.4, 3, theory=case.model.theory_of(STRANGER))
    for name, exact in zip(modes.names[:2], modes.frequencies, strict=False):
        swing = SimpleNamespace(frequency=1.001 * exact, amplitude=0.01)
        found = assess(case, swing, exact=False)
        assert found.mode == name
        assert found.exact_omega_n == pytest.approx(exact, rel=1e-6)
        assert abs(found.mesh_error) < 1e-2


def test_offsets_that_jump_by_three_percent_are_no_axial_strain():
    """Bending strains the line by 0.05 where it is far from the tension centers; EA hardly does."""
    blade = irregular(2, 0.03, 6)
    run = simulate(
        blade, SpinUp(omega=2.6, ramp_time=3.0), element="space_exact", elements=8, duration=6.0,
        step=0.02,
    )  # fmt: skip
    # N/EA at the root, of the centrifugal force and EA of the table; 8 and 32 elements have 8.1e-4.
    assert run["axial_strain"].max() == pytest.approx(8.1e-4, rel=0.02)
