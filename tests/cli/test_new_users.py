"""Blades as a new user has them: a helicopter's, a ruler in mm and t, a cantilever in micrometers.

Numbers of theirs hold in the units that they bring: of length, mass and time, which are consistent.
"""

import math
import re

import pytest

from analytic import linear_modes
from rotbeam_exu import load
from rotbeam_exu.files.beam_file import load_beam

UNIFORM = "[beam]\nlength = {}\narea = {}\nsecond_moment = {}\nyoungs_modulus = {}\ndensity = {}\n"
BEAMS = {
    # A steel ruler, 300 x 30 x 0.5, in mm, t and s; flapping, as it does by hand.
    "ruler": (300.0, 15.0, 0.3125, 2.1e5, 7.85e-9),
    # A silicon cantilever, 200 x 30 x 2 micrometers, in SI.
    "silicon": (2e-4, 6e-11, 2e-23, 1.69e11, 2330.0),
}
HELICOPTER = """
[blade]
hub_radius = 0.15
[blade.line]
precone = 0.05
[blade.stations]
file = "stations.csv"
[blade.damping]
ratio = 0.005
[motion]
omega = 40.0
"""
STATIONS = """x [mm],EA [MN],GJ [N m^2],EI2 [N m^2],EI3 [kN m^2],m [kg/m],twist [deg]
0,300,2e4,1.5e4,600,6,10
600,150,6e3,6e3,250,4,9
5000,120,5e3,5e3,200,3.5,0
"""


@pytest.mark.parametrize("name", ["ruler", pytest.param("silicon", marks=pytest.mark.slow)])
def test_a_beam_in_units_of_ones_own(call, tmp_path, name):
    """First frequency in closed form, 1.8751² √(EI/ρA)/L²; a run in Exudyn with default times."""
    length, area, inertia, modulus, density = BEAMS[name]
    config = tmp_path / f"{name}.toml"
    config.write_text(UNIFORM.format(*BEAMS[name]))
    out = call("campbell", "--config", config, "--points", "2", "--count", "1", "--format", "csv")[
        1
    ]
    first = float(out.splitlines()[1].split(",")[1])
    euler = 1.8751040687119611**2 * math.sqrt(modulus * inertia / (density * area)) / length**2
    # Extension lowers it, by about the slenderness, EI/(EA L²).
    assert first == pytest.approx(euler, rel=1e-5)
    quick = ("--elements", "4", "--no-figure", "--no-exact", "--out", tmp_path)
    code, printed, _ = call("run", "--config", config, *quick)
    assert code == 0
    # The benchmark's speed, of its own ω_0.
    assert re.search(r"\(Ω = 2.0\d+, the benchmark's\)", printed)
    (run,) = tmp_path.glob("*.nc")
    assert load(run).attrs["verdict"] == "passed"


def test_a_helicopter_blade_from_a_table_of_its_stations(call, tmp_path):
    """Modes, with [motion] of the file: flap 1 is a little above 1/rev, by stiffness and hub."""
    (tmp_path / "stations.csv").write_text(STATIONS)
    (tmp_path / "blade.toml").write_text(HELICOPTER)
    blade = load_beam(tmp_path / "blade.toml")
    assert blade.mass == pytest.approx(0.6 * 5.0 + 4.4 * 3.75, rel=1e-9)
    few = ("--omega-min", "40", "--points", "2", "--count", "1", "--orders", "1")
    out = call("campbell", "--config", tmp_path / "blade.toml", *few, "--format", "csv")[1]
    rows = [[float(cell) for cell in line.split(",")] for line in out.splitlines()[1:]]
    assert [row[0] for row in rows] == [40.0, 80.0]
    # Both are resolved to 1e-9.
    first = linear_modes(blade, 40.0, count=1).frequencies[0]
    assert rows[0][1] == pytest.approx(first, rel=1e-8)
    assert 1.0 < first / 40.0 < 1.2
