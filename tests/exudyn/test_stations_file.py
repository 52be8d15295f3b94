"""A blade from a CSV file of its stations, with units; shapes and a damping ratio in the TOML."""

import numpy as np
import pytest

from analytic import Blade, Damping, Rectangle, Section, damping_ratios
from rotbeam_exu.files.beam_file import load_beam

TOML = '[blade]\nhub_radius = 0.5\n[blade.stations]\nfile = "stations.csv"\n'
PLANAR = "x [mm],EA [MN],EI [kN m^2],m [kg/m]\n0,5,0.6,0.2\n8000,4,0.4,0.1\n"
SPACE = (
    "x [m],EA [MN],GJ [kN m²],EI2 [N m^2],EI3 [N m^2],m [kg/m],twist [deg],center2 [cm]\n"
    "0,10,8,5e3,8e4,8,10,-2\n10,4,1,1e3,2e4,4,0,-1\n"
)


@pytest.fixture
def loaded(tmp_path):
    def load(stations, toml=TOML):
        (tmp_path / "stations.csv").write_text(stations, encoding="utf-8")
        (tmp_path / "blade.toml").write_text(toml, encoding="utf-8")
        return load_beam(tmp_path / "blade.toml")

    return load


def test_a_planar_blade(loaded):
    section = Section(
        axial_stiffness=((0.0, 5e6), (8.0, 4e6)), bending_stiffness=((0.0, 600.0), (8.0, 400.0)),
        mass_per_length=((0.0, 0.2), (8.0, 0.1)),
    )  # fmt: skip
    assert loaded(PLANAR) == Blade(length=8.0, section=section, hub_radius=0.5)


def test_a_blade_in_space(loaded):
    """Shear that is not told is as stiff as EA; inertia that is not told, of one material."""
    by_hand = Blade.from_stations(
        [0.0, 10.0], [[1e7, 1e7, 1e7, 8e3, 5e3, 8e4], [4e6, 4e6, 4e6, 1e3, 1e3, 2e4]],
        [[8.0, 0.068, 0.004, 0.064], [4.0, 0.021, 0.001, 0.02]],
        twist=np.radians([10.0, 0.0]), center=[[-0.02, 0.0], [-0.01, 0.0]],
    )  # fmt: skip
    found = loaded(SPACE)
    for name in ("stiffness", "mass"):
        ours, theirs = (np.array(getattr(one.section, name)) for one in (found, by_hand))
        assert ours == pytest.approx(theirs, rel=1e-14, abs=1e-14)
    assert found.line.twist[0] == pytest.approx(by_hand.line.twist[0], rel=1e-15)


SHAPES = (
    "[blade.stations]\nx = [0.0, 2.0]\nyoungs_modulus = 7e10\ndensity = [2700, 2800]\n"
    'shapes = [{ kind = "Rectangle", height = 0.08, width = 0.01 },\n'
    '          { kind = "Rectangle", height = 0.04, width = 0.008 }]\n'
)
RATIO = f"{TOML}[blade.damping]\nratio = 0.02\n"


@pytest.mark.parametrize(
    ("old", "new", "sentence"),
    [
        ("EA [MN]", "EA", r"the unit of column 'EA', as EA \[N\]; known are N, kN, MN, GN"),
        ("EA [MN]", "EA [Nm]", r"the unit of column 'EA \[Nm\]'"),
        ("EA [MN]", "AE [MN]", "unknown column 'AE'; known are x, twist, EA"),
        (",EI [kN m^2]", "", r"lacks the column GJ, EI2, EI3"),
        ("m [kg/m]", "GJ [N m^2]", "lacks the column m"),
        ("m [kg/m]\n", "m [kg/m],GJ [N m^2]\n", r"'GJ \[N m\^2\]' has '', which is no number"),
        ("0.6", "", r"column 'EI \[kN m\^2\]' has '', which is no number"),
        (PLANAR, "", "lacks the column x"),
    ],
)
def test_a_bad_table_is_one_sentence(loaded, tmp_path, old, new, sentence):
    with pytest.raises(ValueError, match=sentence) as refused:
        loaded(PLANAR.replace(old, new))
    assert str(tmp_path) in str(refused.value)


@pytest.mark.parametrize(
    ("toml", "sentence"),
    [
        (TOML.replace("stations.csv", "sections.csv"), "there is no file .*sections.csv"),
        (
            SHAPES.replace("[{ kind", '["Tube", { kind'),
            r"write \[\[blade.stations.shapes\]\] as a table",
        ),
        (f"{RATIO}bending = 0.1\n", r"unknown key 'bending' in \[blade.damping\]"),
    ],
)
def test_a_bad_file_beside_it_is_one_sentence(loaded, toml, sentence):
    with pytest.raises((FileNotFoundError, ValueError), match=sentence):
        loaded(PLANAR, toml)


def test_shapes_and_a_damping_ratio(loaded):
    shapes = Rectangle(height=0.08, width=0.01), Rectangle(height=0.04, width=0.008)
    by_hand = Blade.from_shapes([0.0, 2.0], shapes, 7e10, [2700.0, 2800.0])
    assert loaded("", SHAPES) == by_hand
    damped = loaded(PLANAR, RATIO)
    plain = loaded(PLANAR)
    assert damped == plain.with_damping(Damping.from_ratio(plain, 1, 0.02))
    # At rest, as close as the frequency is that the ratio was made with.
    assert damping_ratios(damped, omega=0.0)[0] == pytest.approx(0.02, rel=1e-6)
