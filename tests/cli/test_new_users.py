"""Beams as a new user has them: a ruler in mm and t, a cantilever in micrometers.

Numbers of theirs hold in the units that they bring: of length, mass and time, which are consistent.
"""

import math
import re

import pytest

from rotbeam_exu import load

UNIFORM = "[beam]\nlength = {}\narea = {}\nsecond_moment = {}\nyoungs_modulus = {}\ndensity = {}\n"
BEAMS = {
    # A steel ruler, 300 x 30 x 0.5, in mm, t and s; flapping, as it does by hand.
    "ruler": (300.0, 15.0, 0.3125, 2.1e5, 7.85e-9),
    # A silicon cantilever, 200 x 30 x 2 micrometers, in SI.
    "silicon": (2e-4, 6e-11, 2e-23, 1.69e11, 2330.0),
}


@pytest.mark.parametrize("name", ["ruler", pytest.param("silicon", marks=pytest.mark.slow)])
def test_a_beam_in_units_of_ones_own(call, tmp_path, name):
    """First frequency in closed form, 1.8751² √(EI/ρA)/L²; a run in Exudyn with default times."""
    length, area, inertia, modulus, density = BEAMS[name]
    config = tmp_path / f"{name}.toml"
    config.write_text(UNIFORM.format(*BEAMS[name]))
    diagram = ("campbell", "--points", "2", "--count", "1", "--out", tmp_path / "modes")
    assert call(*diagram, "--config", config)[0] == 0
    first = load(tmp_path / "modes" / "campbell-given.nc")["frequency"][0, 0].item()
    euler = 1.8751040687119611**2 * math.sqrt(modulus * inertia / (density * area)) / length**2
    # Extension lowers it, by about the slenderness, EI/(EA L²).
    assert first == pytest.approx(euler, rel=1e-5)
    quick = ("--elements", "2", "--no-figure", "--no-exact", "--out", tmp_path)
    code, printed, _ = call("run", "--config", config, *quick)
    assert code == 0
    # The benchmark's speed, of its own ω_0.
    assert re.search(r"\(Ω = 2.0\d+, the benchmark's\)", printed)
    (run,) = tmp_path.glob("*.nc")
    assert load(run).attrs["verdict"] == "passed"
