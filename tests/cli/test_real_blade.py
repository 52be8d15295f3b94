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
    """What a ramp leaves of any blade, and how this one responds, is tested in the theory."""
    monkeypatch.chdir(tmp_path)
    code, out, error = call(*command, "--config", NREL)
    assert code == 0, error
    assert told in out
    for path in tmp_path.glob("**/*.nc"):
        with xr.open_dataset(path) as data:
            assert sum(map(int, data.isnull().sum().values())) < sum(v.size for v in data.values())
