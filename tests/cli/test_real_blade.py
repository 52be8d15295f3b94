"""NREL's blade of 49 stations through the commands that take a blade."""

from pathlib import Path

import pytest
import xarray as xr

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
