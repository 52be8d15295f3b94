"""NREL's blade of 49 stations through the commands that take a blade."""

from pathlib import Path

import pytest
import xarray as xr

NREL = Path(__file__).parents[2] / "models" / "blades" / "nrel_5mw_edgewise.toml"
SPEED = ("--omega", "1.267")
MOTION = (*SPEED, "--ramp-time", "3")
MESH = ("--elements", "4", "--step", "0.01", "--duration", "10")

WRITTEN = {
    "run": ("run", *MOTION, *MESH, "--no-figure"),
    "reference": ("reference", *MOTION, "--duration", "4", "--samples", "9", "--tolerance", "1e-5"),
    "ramp": ("ramp", *SPEED, "--longest", "2", "--points", "1", "--finite-element-points", "0"),
    "tip force": ("respond", *SPEED, "--tip-force", "1000", "--damping-ratio", "0.005",
                  "--from", "7", "--to", "7.1", "--points", "2", "--no-figure"),
    "sweep": ("sweep", *MOTION, *MESH, "--jobs", "1"),
}  # fmt: skip


@pytest.mark.filterwarnings("ignore::analytic.input_checks.RotbeamWarning")
@pytest.mark.parametrize(
    "name",
    # What a ramp leaves of any blade, and how this one responds, is tested in the theory.
    [
        pytest.param(one, marks=pytest.mark.slow if one in ("ramp", "tip force") else ())
        for one in WRITTEN
    ],
)
def test_a_command_writes_its_results(call, tmp_path, name):
    code, out, error = call(*WRITTEN[name], "--config", NREL, "--out", tmp_path)
    assert code == 0, error
    assert "written" in out
    for path in tmp_path.glob("*.nc"):
        with xr.open_dataset(path) as data:
            assert sum(map(int, data.isnull().sum().values())) < sum(v.size for v in data.values())


@pytest.mark.filterwarnings("ignore::analytic.input_checks.RotbeamWarning")
def test_a_command_prints_its_table(call, tmp_path):
    backbone = ("backbone", *SPEED, "--variant", "FrM", "--exact", "--amplitude", "0.1")
    for command in (backbone, ("campbell", "--omega-max", "2", "--points", "3")):
        code, out, error = call(*command, "--config", NREL)
        assert code == 0, error
        assert "7.0" in out  # its first frequency in rotation, in rad/s
    code, out, error = call(
        "animate", *MOTION, "--duration", "1", "--rate", "2", "--config", NREL,
        "-o", tmp_path / "film.gif",
    )  # fmt: skip
    assert code == 0, error


def test_what_the_file_does_not_tell_is_asked_for(call, tmp_path):
    code, _, error = call("stability", *SPEED, "--config", NREL, "--out", tmp_path)
    assert code != 0
    assert "out_of_plane" in error or "--section" in error


def test_a_twisted_blade_that_is_not_set_has_a_campbell_diagram(call, tmp_path):
    """Its flap, lag and torsion go together, so no family is asked for."""
    file = tmp_path / "twisted.toml"
    file.write_text(
        "[blade]\nlength = 8.0\nline = { twist = [0.0, 0.5] }\n[blade.section]\n"
        "axial_stiffness = 5e6\nbending_stiffness = 566.0\nmass_per_length = 0.2\n"
        "out_of_plane = { bending_ratio = 0.1, torsion_ratio = 0.09 }\n"
    )
    code, out, error = call("campbell", "--points", "2", "--orders", "1", "--config", file)
    assert code == 0, error
    assert "mode 3" in out
