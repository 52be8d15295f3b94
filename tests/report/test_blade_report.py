"""The report of a blade: its numbers, what it does where there are none, and a stranger's names."""

import math
from pathlib import Path

import numpy as np
import pytest

from analytic import Beam, Theory, linear_modes, steady_state
from rotbeam_exu.files.beam_file import load_beam
from rotbeam_exu.report.blade import blade_parts, sections_of

BLADES = Path(__file__).parents[2] / "models" / "blades"
TITLES = [
    "Sections and mass", "Modes", "Campbell diagram", "Steady state over the speed",
    "Root loads over a turn, under the weight",
]  # fmt: skip


@pytest.fixture(scope="module")
def parts():
    """Of a blade that turns once while its first mode swings ten times."""
    blade = Beam.reference().with_section_out_of_plane(2.0, 1.0).with_precone(0.05)
    omega = 0.1 * float(linear_modes(blade, 0.0, 1).frequencies[0])
    made = {part.title: part for part in blade_parts(blade, omega, Theory(), None)}
    assert [*made] == TITLES
    assert not any(part.failure for part in made.values())
    return blade, omega, made


def test_mass_and_moments_are_those_of_a_uniform_blade(parts):
    blade, _, made = parts
    mass, length = blade.mass, blade.length
    said = made["Sections and mass"].text
    for number in (f"{mass:.6g} kg", f"{mass * length / 2:.6g} kg m about the clamp"):
        assert number in said
    assert f"{mass * length**2 / 3.0:.6g} kg m² about the axis" in said
    data = made["Sections and mass"].data["sections"]
    assert np.trapezoid(data["m"], data["x"]) == pytest.approx(mass)


def test_its_numbers_are_those_of_the_functions(parts):
    blade, omega, made = parts
    steady = made["Steady state over the speed"].data["steady"]
    fast, slow = (steady_state(blade, speed) for speed in (1.2 * omega, 0.0))
    assert steady["flap"][-1].item() == pytest.approx((fast.tip - slow.tip)[2])
    modes = linear_modes(blade, omega, 6)
    told = made["Modes"].tables[0]
    assert [f"{f / (2.0 * math.pi):.5g}" for f in modes.frequencies] == [
        told[f"at {omega:g} rad/s [Hz]"][told["mode"].index(name)] for name in modes.names
    ]


def test_the_weight_of_a_slow_blade_is_that_of_a_rigid_one(parts):
    """A first mode ten times faster than the turn amplifies by 1 %; the cone takes 0.1 %."""
    blade, _, made = parts
    turn = made["Root loads over a turn, under the weight"].data["turn"]
    rigid = 9.81 * blade.mass * blade.length / 2.0
    assert np.abs(turn["moment_z"]).max().item() == pytest.approx(rigid, rel=0.02)
    weight = 9.81 * blade.mass
    tension = turn["force_x"]
    assert (tension.max() - tension.min()).item() / 2.0 == pytest.approx(weight, rel=0.02)
    # Hanging down the root carries most, straight up least.
    assert tension["angle"][int(np.argmax(tension.data))].item() == pytest.approx(270.0, abs=10.0)


def test_a_part_without_an_answer_keeps_its_place_and_the_page_is_written(call, tmp_path):
    """In a file with a name that a page must not take for its own."""
    config = tmp_path / "<b onclick=1>&.toml"
    config.write_text("[beam]\nlength = 8.0\narea = 7.299e-05\nsecond_moment = 8.214e-09\n"
                      "youngs_modulus = 6.895e10\ndensity = 2767.0\n")  # fmt: skip
    out = tmp_path / "out"
    code, printed, error = call("report", "--omega", "1", "--config", config, "-o", out)
    assert code == 0, error
    page = next(out.glob("report-*.html")).read_text()
    assert "<b onclick" not in page
    assert "&lt;b onclick=1&gt;&amp;" in page
    assert page.count("Not known") == 1  # the section out of the plane is not told
    assert page.count("<svg") == 4
    assert "http" not in page.replace("http://www.w3.org", "")  # nothing is fetched
    (turn,) = out.glob("*-turn.csv")
    assert len(turn.read_text().splitlines()) == 74
    assert str(turn) in printed.replace("\n", "")
    code, _, error = call("report", "--omega", "1", "--config", config, "-o", out)
    assert code == 2
    assert "or --force" in error


@pytest.mark.slow
@pytest.mark.parametrize(("name", "omega"), [("nrel_5mw", 1.267), ("iea_15mw", 0.7917)])
def test_real_blades_have_all_parts(name, omega):
    blade = load_beam(BLADES / f"{name}.toml")
    assert sections_of(blade)["x"][-1].item() == pytest.approx(blade.length)
    made = list(blade_parts(blade, omega, Theory(), None))
    assert [part.title for part in made] == TITLES
    assert not any(part.failure for part in made)
