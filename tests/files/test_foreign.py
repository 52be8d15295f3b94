"""Blades in the files of BeamDyn, ElastoDyn and HAWC2: read, written, refused in one sentence."""

from contextlib import suppress
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from analytic import Blade, Damping, linear_modes
from analytic.arrays import evaluated
from analytic.exact.continuum.unit import space_unit
from rotbeam_exu.files.beam_file import load_beam
from rotbeam_exu.files.blade_toml import blade_toml
from rotbeam_exu.files.foreign import ForeignText
from rotbeam_exu.files.key_points import key_points, line_through
from rotbeam_exu.files.openfast import write_beamdyn

BLADES = Path(__file__).parents[2] / "models" / "blades"
TO_BEAMDYN = np.array([[0, 0, 1.0], [0, -1.0, 0], [1.0, 0, 0]])

PRIMARY = """\
--------- BEAMDYN with OpenFAST INPUT FILE
two cells
False  Echo - (flag)
1   member_total - Number of members
3   kp_total - Number of key points
1 3
  kp_xr  kp_yr  kp_zr  initial_twist
  (m)  (m)  (m)  (deg)
  0.0  0.0  0.0  10.0
 0, 0, 5.0D+00, 6.0
\t0.0\t0.0\t1.0D+01\t2.0 ! the tip
---- MESH
5  order_elem - Order
"x_Blade.dat"  BldFile - Name
END
"""
STIFF = """\
3e6 0 0 0 0 0
0 2.0d+06 0 0 0 0
0 0 1.0E+07 {a} {b} 0
0 0 {a} 4e5 0 0
0 0 {b} 0 9e4 0
0 0 0 0 0 8e4
"""
MASS = """\
8 0 0 0 0 -0.4
0 8 0 0 0 0.8
0 0 8 0.4 -0.8 0
0 0 0.4 3 0 0
0 0 -0.8 0 2 0
-0.4 0.8 0 0 0 5
"""
ROWS = STIFF.format(a=-2e5, b=3e5) + "\n" + MASS + "\n"
SECTIONS = f"""\
 ------- BEAMDYN V1.00.* INDIVIDUAL BLADE INPUT FILE
 Test
2  station_total - Number
0  damp_type - none
 ---- DAMPING COEFFICIENT
 mu1 mu2 mu3 mu4 mu5 mu6
 (-) (-) (-) (-) (-) (-)
 0.1 0.1 0.1 0.1 0.1 0.1
 ---- DISTRIBUTED PROPERTIES
 0.0
{ROWS} 1.0
{ROWS}"""
ELASTODYN = """\
------- ELASTODYN V1.00.* INDIVIDUAL BLADE INPUT FILE
3  NBlInpSt - Number
1  FlStTunr(1) - tuner
1.5  AdjBlMs - factor
2  AdjFlSt - factor
0.5  AdjEdSt - factor
---- DISTRIBUTED BLADE PROPERTIES
BlFract  {extra} StrcTwst  BMassDen  FlpStff  EdgStff
(-)  {unit} (deg)  (kg/m)  (Nm^2)  (Nm^2)
0.0  {cell} 10  8  3e4  8e5
0.5  {cell} 5  6  2e4  7e5
1.0  {cell} 0  4  1e4  4e5
---- BLADE MODE SHAPES
 0.06 BldFl1Sh(2) - x^2
"""
PLAIN = ELASTODYN.format(extra="", unit="", cell="")
RIGID = "length = 20.0\naxial_stiffness = 1e9\ntorsion_stiffness = [1e6, 2e6, 3e6]\n"
HTC = """\
; a turbine
begin new_htc_structure;
 begin main_body;
  name tower ;
  begin timoschenko_input; filename ./x_st.txt ; set 1 1 ; end timoschenko_input;
 end main_body;
 begin main_body; the blade
  name  blade1 ;
  begin timoschenko_input ;
   filename ./x_st.txt ;
   set 2 1 ;  set subset
  end timoschenko_input;
  begin c2_def;
   nsec 3 ;
   sec 1 0.0 0.0 0.0 0.0 ; x y z twist
   sec 2 0.0 0.0 6.0 -4.0 ;
   sec 3 0.0 0.0 12.0 -8.0 ;
  end c2_def ;
 end main_body;
end new_htc_structure;
"""
#    r   m  x_cg  y_cg  ri_x ri_y x_sh y_sh  E    G   I_x  I_y   K   k_x k_y A pitch x_e  y_e
ST = """\
2 sets
#1 tower
$1 2
0 9 0 0 1 1 0 0 2e11 8e10 1 1 2 .5 .5 .1 0 0 0
9 9 0 0 1 1 0 0 2e11 8e10 1 1 2 .5 .5 .1 0 0 0
#2 blade
r m x_cg and so on
$1 2 flexible
0  8 0.05 0.02 0.3 0.5 0.03 0.01 1e10 1e9 2e-3 5e-3 1e-3 0.6 0.4 0.1 {pitch} 0.02 -0.01 ; root
12 4 0.05 0.02 0.3 0.5 0.03 0.01 1e10 1e9 2e-3 5e-3 1e-3 0.6 0.4 0.1 {pitch} 0.02 -0.01
$2 1 stiff
"""
FILES = {
    "x_BeamDyn.dat": PRIMARY, "x_Blade.dat": SECTIONS, "x_ElastoDyn_blade.dat": PLAIN,
    "x.htc": HTC, "x_st.txt": ST.format(pitch=0.0),
    "e.toml": f'[blade.stations]\nfile = "x_ElastoDyn_blade.dat"\n{RIGID}',
    "b.toml": '[blade]\nhub_radius = 1.5\n[blade.line]\nprecone = -0.04\n[blade.stations]\n'
    'file = "x_BeamDyn.dat"\n',
}  # fmt: skip


@pytest.fixture
def folder(tmp_path):
    for name, text in FILES.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    return tmp_path


def test_beamdyn_s_two_files(folder):
    """Its axes 3, -2, 1 are ours; its twist turns the other way; a TOML file adds hub and cone."""
    blade = load_beam(folder / "x_BeamDyn.dat")
    S, M = (np.array(getattr(blade.section, name))[0] for name in ("stiffness", "mass"))
    assert np.diag(S) == pytest.approx([1e7, 2e6, 3e6, 8e4, 9e4, 4e5])
    assert np.diag(M) == pytest.approx([8, 8, 8, 5, 2, 3])
    # An axial strain is borne by the moments of EA at its center: 0.02 to its 2 is -0.02 here.
    assert S[0, 3:] == pytest.approx([0.0, -3e5, -2e5])
    # m (c2 ω3 - c3 ω2) moves along axis 1; the center is 0.1 along its 1, 0.05 along its 2.
    assert M[0, 3:] == pytest.approx([0.0, 0.8, 0.4])
    assert np.array(blade.line.twist) == pytest.approx(
        np.column_stack(([0.0, 5.0, 10.0], -np.radians([10.0, 6.0, 2.0])))
    )
    on_a_hub = load_beam(folder / "b.toml")
    assert on_a_hub.section == blade.section
    assert (on_a_hub.hub_radius, on_a_hub.line.precone) == (1.5, -0.04)
    assert on_a_hub.line.twist == blade.line.twist


def test_elastodyn_s_file_with_what_it_lacks(folder):
    """With and without the column PitchAxis of before 2024; its factors are in."""
    blade = load_beam(folder / "e.toml")
    section = blade.section
    assert np.array(section.stiffness)[1].diagonal() == pytest.approx([1e9] * 3 + [2e6, 4e4, 3.5e5])
    assert np.array(section.mass_per_length) == pytest.approx(np.array([[0, 12], [10, 9], [20, 6]]))
    assert np.array(section.mass)[1].diagonal()[4:] == pytest.approx(9 * np.array([4e-5, 3.5e-4]))
    assert np.array(blade.line.twist)[:, 1] == pytest.approx(-np.radians([10, 5, 0]))
    old = ELASTODYN.format(extra="PitchAxis", unit="(-)", cell="0.25")
    (folder / "x_ElastoDyn_blade.dat").write_text(old)
    assert load_beam(folder / "e.toml") == blade


@pytest.mark.parametrize("missing", ["length", "axial_stiffness", "torsion_stiffness"])
def test_elastodyn_s_file_alone_says_what_to_give(folder, missing):
    """And the stiffness that it names is as good as rigid: frequencies of less change by 1e-4."""
    kept = [line for line in FILES["e.toml"].splitlines() if not line.startswith(missing)]
    (folder / "less.toml").write_text("\n".join(kept))
    for name in ("less.toml", "x_ElastoDyn_blade.dat"):
        with pytest.raises(ValueError, match="no length, EA and GJ.* 8e[+]08 for both") as refused:
            load_beam(folder / name)
        assert 'file = "x_ElastoDyn_blade.dat"' in str(refused.value)
    found = []
    for size in (8e8, 8e10):
        (folder / "r.toml").write_text(
            f'[blade.stations]\nfile = "x_ElastoDyn_blade.dat"\nlength = 20.0\n'
            f"axial_stiffness = {size}\ntorsion_stiffness = {size}\n"
        )
        found.append(linear_modes(load_beam(folder / "r.toml"), 2.0, 3).frequencies)
    assert found[0] == pytest.approx(found[1], rel=1e-4)


def test_hawc2_s_files(folder):
    """Centers from the half chord, radii of gyration about the elastic center."""
    blade = load_beam(folder / "x.htc")
    S, M = (np.array(getattr(blade.section, name))[0] for name in ("stiffness", "mass"))
    EA, GA2, GA3, GJ = 1e9, 6e7, 4e7, 1e6
    assert S[0, [0, 4, 5]] == pytest.approx([EA, -0.01 * EA, -0.02 * EA])
    assert S[4, 4] == pytest.approx(2e7 + EA * 1e-4)
    assert S[5, 5] == pytest.approx(5e7 + EA * 4e-4)
    assert S[3, 1:4] == pytest.approx([-0.01 * GA2, 0.03 * GA3, GJ + 1e-4 * GA2 + 9e-4 * GA3])
    assert M[0, [4, 5]] == pytest.approx([8 * 0.02, -8 * 0.05])
    # m (ri² + c² - (c - e)²): from the elastic center to the line.
    assert M[4, 4] == pytest.approx(8 * (0.09 + 0.02**2 - 0.03**2))
    assert M[5, 5] == pytest.approx(8 * (0.25 + 0.05**2 - 0.03**2))
    assert np.array(blade.line.twist) == pytest.approx(
        np.column_stack(([0.0, 6.0, 12.0], -np.radians([0.0, 4.0, 8.0])))
    )
    (folder / "x_st.txt").write_text(ST.format(pitch=90.0))
    S = np.array(load_beam(folder / "x.htc").section.stiffness)[0]
    assert S[4, 4] - EA * 1e-4 == pytest.approx(5e7)  # the principal axes have changed places
    assert S[1, 1] == pytest.approx(GA3)


def test_a_full_matrix_of_hawc2_is_that_of_its_columns(folder):
    """30 columns: the matrix about the elastic center, in principal axes."""
    by_columns = load_beam(folder / "x.htc")
    shear, G = np.array([0.01, 0.02]), np.array([6e7, 4e7])  # from the elastic center
    K = np.diag([*G, 1e9, 2e7, 5e7, 1e6 + shear[1] ** 2 * G[0] + shear[0] ** 2 * G[1]])
    K[0, 5], K[1, 5] = -shear[1] * G[0], shear[0] * G[1]
    full = " ".join(f"{one:.16g}" for one in K[np.triu_indices(6)])
    lines = [f"{r} {m} 0.05 0.02 0.3 0.5 0 0.02 -0.01 {full}" for r, m in (("0", "8"), ("12", "4"))]
    text = ST.partition("$1 2 flexible")[0] + "$1 2\n" + "\n".join(lines) + "\n"
    (folder / "x_st.txt").write_text(text)
    found = load_beam(folder / "x.htc")
    for name in ("stiffness", "mass"):
        ours, theirs = (np.array(getattr(one.section, name)) for one in (found, by_columns))
        assert ours == pytest.approx(theirs, rel=1e-12, abs=1e-6)


def test_structural_data_alone_are_straight_and_say_so(folder):
    with pytest.raises(ValueError, match=r"has 2 sets, of bodies that the main file names"):
        load_beam(folder / "x_st.txt")
    text = FILES["x_st.txt"]
    (folder / "x_st.txt").write_text("#2" + text.partition("#2")[2])
    with pytest.warns(UserWarning, match="has no twist and no line: give the main file"):
        blade = load_beam(folder / "x_st.txt")
    assert blade.section.x == (0.0, 12.0)
    assert not any(angle for _, angle in blade.line.twist)


def test_nrel_s_blade_is_that_of_openfast(tmp_path):
    """∫m, ∫mx and ∫mx² of the file in OpenFAST's r-test, times what the shipped blade weighs more.

    Linear between its 49 stations: 16844.752021 kg, 345672.0175 kg m, 11188346.5616 kg m².
    """
    path = tmp_path / "n_BeamDyn.dat"
    written = write_beamdyn(load_beam(BLADES / "nrel_5mw.toml"), path)
    assert [one.name for one in written] == ["n_BeamDyn.dat", "n_BeamDyn_Blade.dat"]
    x, mass = np.array(load_beam(path).section.mass_per_length).T
    at, weight = np.polynomial.legendre.leggauss(3)
    half, middle = 0.5 * np.diff(x)[:, None], 0.5 * (x[1:] + x[:-1])[:, None]
    points = middle + half * at
    moments = [np.sum(half * weight * np.interp(points, x, mass) * points**k) for k in range(3)]
    known = 1.05315 * np.array([16844.752021, 345672.017487, 11188346.561581])
    assert moments == pytest.approx(known, rel=2e-6)  # masses in our table have seven digits


@pytest.mark.parametrize("name", ["nrel_5mw", "iea_15mw"])
def test_the_shipped_blades_come_back_from_beamdyn_s_files(name, tmp_path):
    """Sections to the last digit; a curved line, found again from its points, to round-off.

    BeamDyn refuses a polar inertia that is not the sum of both others, by 5e-6 in NREL's table.
    """
    blade = load_beam(BLADES / f"{name}.toml")
    write_beamdyn(blade, tmp_path / "b.dat")
    found = load_beam(tmp_path / "b.dat")
    assert found.section.stiffness == blade.section.stiffness
    mass, same = np.array(found.section.mass), np.array(blade.section.mass)
    assert np.array_equal(mass[:, 3, 3], mass[:, 4, 4] + mass[:, 5, 5])
    assert mass[:, 3, 3] == pytest.approx(same[:, 3, 3], rel=1e-5)
    same[:, 3, 3] = mass[:, 3, 3]
    assert np.array_equal(mass, same)
    assert found.length == pytest.approx(blade.length, rel=1e-12)
    assert found.section.x == pytest.approx(blade.section.x, rel=1e-12)
    at = np.linspace(0.0, 1.0, 101)
    for ours, theirs in zip(*(space_unit(one).unloaded(at) for one in (found, blade)), strict=True):
        assert ours == pytest.approx(theirs, abs=1e-12)
    twists = (evaluated(one.line.twist, at * blade.length) for one in (found, blade))
    assert next(twists) == pytest.approx(next(twists), abs=1e-12)


@pytest.mark.parametrize("name", ["nrel_5mw", "iea_15mw", "nrel_5mw_edgewise"])
def test_the_shipped_blades_come_back_from_toml(name, tmp_path):
    blade = load_beam(BLADES / f"{name}.toml").with_tip_mass(2.0, 0.5)
    blade = blade.with_setting_angle(0.1).with_kink(1.0, 0.01)
    (tmp_path / "b.toml").write_text(blade_toml(blade, motion={"omega": 1.0}))
    assert load_beam(tmp_path / "b.toml") == blade


@pytest.mark.parametrize("bend", [0.02, 0.5, 0.8])
def test_a_line_goes_through_its_key_points(bend):
    """Of a helix with twist, bent by up to a fifth of a turn; sections twisted as BeamDyn says."""
    z = np.linspace(0.0, 1.0, 9)
    points = 20.0 * np.column_stack((z, 0.3 * bend * z**2, -0.5 * bend * z**3))
    angles = np.linspace(0.3, -0.2, 9)
    length, line = line_through(points, angles)
    blade = load_beam(BLADES / "nrel_5mw.toml").in_units(61.5 / length, 1.0, 1.0)
    bent = type(blade)(length=length, section=blade.section, line=line)
    at = np.array([x for x, _ in line.twist])
    place, axes = space_unit(bent).unloaded(at / length)
    assert length * place == pytest.approx(points[: at.size], abs=1e-9)
    thickness = axes[:, :, 2]
    assert np.arctan2(-thickness[:, 1], thickness[:, 2]) == pytest.approx(angles, abs=1e-9)
    # A cubic spline through points of a cubic is that cubic, whose slope at the tip is known.
    slope = bent_slope(bend)
    assert axes[-1, :, 0] == pytest.approx(slope, abs=2e-3)
    again, points, _ = key_points(bent)
    assert again[-1] == length
    assert points[-1] == pytest.approx(20.0 * np.array([1.0, 0.3 * bend, -0.5 * bend]), abs=1e-9)


def bent_slope(bend):
    slope = np.array([1.0, 0.6 * bend, -1.5 * bend])
    return slope / np.linalg.norm(slope)


HOSTILE = [
    ("x_BeamDyn.dat", "3   kp_total", "4   kp_total", "line 12 has .* cells|line 12 has '----'"),
    ("x_BeamDyn.dat", "3   kp_total", "2   kp_total", "kp_total must be a whole number from 3 on"),
    ("x_BeamDyn.dat", "3   kp_total", "3.0 kp_total", "kp_total must be a whole number"),
    ("x_BeamDyn.dat", "3   kp_total", "", "no line with a value and the name kp_total"),
    ("x_BeamDyn.dat", "10.0\n", "nan\n", "line 9 has 'nan', which is no number"),
    ("x_BeamDyn.dat", "1.0D+01", "1.0D+999", "line 11 has '1.0D[+]999'"),
    ("x_BeamDyn.dat", "0, 0, 5.0D+00, 6.0", "0,0 0,0 5,0 6,0", "write a decimal point"),
    ("x_BeamDyn.dat", "0, 0, 5.0D+00, 6.0", "0 0 -5.0 6.0", "no line goes|must ascend"),
    ("x_BeamDyn.dat", "0.0  0.0  0.0  10.0", "0 0 1 10", "first key point must be 0 0 0"),
    ("x_BeamDyn.dat", '"x_Blade.dat"', '"../x_Blade.dat"', "which is not in its folder"),
    ("x_BeamDyn.dat", '"x_Blade.dat"', '"/etc/passwd"', "which is not in its folder"),
    ("x_BeamDyn.dat", '"x_Blade.dat"', "no.dat", "'no.dat', which is not in its folder"),
    ("x_BeamDyn.dat", '"x_Blade.dat"  BldFile', "", "no line with a value and the name BldFile"),
    ("x_Blade.dat", "2  station_total", "3  station_total", "26 lines .* its 3 stations need 13"),
    ("x_Blade.dat", "2  station_total", "9" * 5000 + "  station_total", "need 13 each"),
    ("x_Blade.dat", " 1.0\n", " 0.9\n", "stations must run from 0 to 1, got 0 to 0.9"),
    ("x_Blade.dat", "2.0d+06", "2.0f+06", "'2.0f[+]06', which is no number"),
    ("x_Blade.dat", "3e6 0 0", "inf 0 0", "'inf', which is no number"),
    ("x_Blade.dat", "3e6 0 0", "-3e6 0 0", "GA3 = -3e[+]06: give it above zero"),
    ("x_Blade.dat", "3e6 0 0", "3e6 1e5 0", "is not symmetric"),
    ("x_Blade.dat", "DISTRIBUTED PROPERTIES", "", "no line DISTRIBUTED PROPERTIES"),
    ("e.toml", "length = 20.0", "length = 'long'", "length must be a number in m"),
    ("e.toml", "length = 20.0", "length = -20.0", "length must be positive"),
    ("e.toml", "[1e6, 2e6, 3e6]", "[1e6, 2e6]", "one at each of the 3 stations"),
    ("e.toml", "length", "lenght", "unknown key 'lenght'"),
    ("x_ElastoDyn_blade.dat", "3  NBlInpSt", "9  NBlInpSt", "cells where 5 numbers|'----'"),
    ("x_ElastoDyn_blade.dat", "0.5  AdjEdSt", "half  AdjEdSt", "AdjEdSt is 'half'"),
    ("x_ElastoDyn_blade.dat", "BMassDen", "Mass", "lacks the column BMassDen"),
    ("x.htc", "nsec 3", "nsec 4", "has 3 lines sec, and nsec 4"),
    ("x.htc", "sec 2 0.0 0.0 6.0 -4.0", "sec 2 0.0 0.0 6.0", "cells where 5 numbers"),
    ("x.htc", "set 2 1", "set 2 7", "no subset [$]7"),
    ("x.htc", "set 2 1", "set 5 1", "has no set #5"),
    ("x.htc", "set 2 1", "set two", "must have set with two numbers"),
    ("x.htc", "name  blade1", "name  wing", "no main_body whose name begins with blade"),
    ("x.htc", "filename ./x_st.txt ;\n   set 2", "filename ../x_st.txt ;\n   set 2", "not in its"),
    ("x.htc", "12.0 -8.0", "14.0 -8.0", "ends at 12 m, and the half chord line is 14 m long"),
    ("x_st.txt", "$1 2 flexible", "$1 5 flexible", "cells where 19 numbers"),
    ("x_st.txt", "$1 2 flexible", "$1 flexible", "no subset [$]1"),
]  # fmt: skip
READ = {"x_Blade.dat": "x_BeamDyn.dat", "x_ElastoDyn_blade.dat": "e.toml", "x_st.txt": "x.htc"}


@pytest.mark.parametrize(("name", "old", "new", "sentence"), HOSTILE)
def test_a_bad_file_is_one_sentence_that_names_it(folder, name, old, new, sentence):
    assert old in FILES[name]
    (folder / name).write_text(FILES[name].replace(old, new, 1), encoding="utf-8")
    with pytest.raises(ValueError, match=sentence) as refused:
        load_beam(folder / READ.get(name, name))
    text = str(refused.value)
    assert "\n" not in text
    assert str(folder) in text or name == "e.toml"
    assert len(text.replace(str(folder), "")) < 500


@settings(
    max_examples=60, suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None
)
@given(st.sampled_from(sorted(set(FILES) - {"e.toml", "b.toml"})), st.floats(0.0, 1.0), st.data())
def test_a_file_that_is_cut_or_spoiled_is_read_or_refused(folder, name, place, data):
    """Whatever a line has become."""
    lines = FILES[name].splitlines()
    k = min(int(place * len(lines)), len(lines) - 1)
    lines[k] = data.draw(
        st.sampled_from(["", "1", "1 2 3", "#9", "$9 9", "nan " * 6, "x" * 2000, "\x00"])
    )
    if data.draw(st.booleans()):
        lines = lines[: k + 1]
    for other, text in FILES.items():
        (folder / other).write_text("\n".join(lines) if other == name else text, encoding="utf-8")
    with suppress(ValueError, FileNotFoundError):  # and nothing else
        load_beam(folder / READ.get(name, name))


def test_a_blade_file_without_its_primary_and_a_huge_file(folder, monkeypatch):
    with pytest.raises(ValueError, match="is the blade file of BeamDyn, which has no length"):
        load_beam(folder / "x_Blade.dat")
    monkeypatch.setattr("rotbeam_exu.files.foreign._LARGEST", 100)
    with pytest.raises(ValueError, match="files of blades have less than"):
        load_beam(folder / "x_BeamDyn.dat")
    with pytest.raises(FileNotFoundError, match="there is no file"):
        load_beam(folder / "none.dat")


def test_damping_is_not_dropped_in_silence(folder):
    path = folder / "x_Blade.dat"
    path.write_text(SECTIONS.replace("0  damp_type", "2  damp_type"))
    with pytest.warns(UserWarning, match=r"the damping in .*x_Blade.dat is not read"):
        load_beam(folder / "x_BeamDyn.dat")
    mu = "0.01 0.03 0.04 0.05 0.06 0.07"
    path.write_text(
        SECTIONS.replace("0  damp_type", "1  damp_type").replace("0.1 0.1 0.1 0.1 0.1 0.1", mu)
    )
    with pytest.warns(UserWarning, match=r"damps both shear forces unlike, .* taken, 0.02 s"):
        blade = load_beam(folder / "x_BeamDyn.dat")
    assert blade.damping == Damping(
        shear=0.02, axial=0.04, bending=0.05, out_of_plane=0.06, torsion=0.07
    )
    write_beamdyn(blade, folder / "again.dat")
    assert load_beam(folder / "again.dat").damping == blade.damping
    path.write_text(SECTIONS.replace("0  damp_type", "1  damp_type").replace("0.1 0.1", "x 0.1", 1))
    with pytest.raises(ValueError, match="x_Blade.dat: "):
        load_beam(folder / "x_BeamDyn.dat")


def test_nothing_but_what_beamdyn_holds_is_written(folder):
    blade = load_beam(BLADES / "nrel_5mw.toml")
    for other, sentence in (
        (blade.with_tip_mass(1.0), "no point masses"),
        (blade.with_kink(1.0, 0.1), "no kinks"),
        (load_beam(BLADES / "nrel_5mw_edgewise.toml"), "make the blade by Blade.from_stations"),
        (
            Blade.from_stations(
                [0.0, 9.0], [[1e7, 1e7, 1e7, 8e4, 5e3, 8e4]] * 2, [[8, 0.4, 0.1, 0.2]] * 2
            ),
            "at 0 m it is 0.4 of 0.3 kg m: set j1 = j2 \\+ j3",
        ),
    ):
        with pytest.raises(ValueError, match=sentence):
            write_beamdyn(other, folder / "y.dat")
    assert not (folder / "y.dat").exists()


def test_letters_of_other_alphabets_in_remarks_are_no_fault(folder):
    (folder / "x_BeamDyn.dat").write_bytes(PRIMARY.replace("two", "zw\u00f6lf").encode("cp1252"))
    assert load_beam(folder / "x_BeamDyn.dat").length == 10.0
    assert ForeignText(folder / "x_BeamDyn.dat").value("order_elem") == "5"


def test_two_codes_files_of_one_blade_agree(folder):
    """BeamDyn's section as HAWC2's columns, about principal axes that are turned."""
    # The principal axes at the center of tension, where EI23 = EA c2 c3.
    flap, lag, both = 9e4 - 1e7 * 9e-4, 4e5 - 1e7 * 4e-4, 1e7 * 0.02 * 0.03
    pitch = 0.5 * np.arctan2(2.0 * both, lag - flap)
    mean, apart = 0.5 * (flap + lag), np.hypot(0.5 * (lag - flap), both)
    row = (
        f"0 8 0.05 0.1 0.4 0.5 0 0 1e7 1e7 {(mean - apart) / 1e7} {(mean + apart) / 1e7} 8e-3 0.2 "
        f"0.3 1 {np.degrees(pitch)} 0.02 -0.03"
    )
    st_file = "#2 blade\n$1 2\n" + row + "\n" + row.replace("0 8", "10 8", 1) + "\n"
    (folder / "x_st.txt").write_text(st_file)
    htc = HTC.replace("6.0 -4.0", "5.0 -6.0").replace("12.0 -8.0", "10.0 -2.0")
    (folder / "x.htc").write_text(htc.replace("0.0 0.0 0.0 0.0", "0.0 0.0 0.0 -10.0"))
    beamdyn, hawc2 = (load_beam(folder / name) for name in ("x_BeamDyn.dat", "x.htc"))
    S = [np.array(one.section.stiffness)[0] for one in (beamdyn, hawc2)]
    for block in ([0, 4, 5], [3]):  # HAWC2's shear is in principal axes of bending
        ours, theirs = (one[np.ix_(block, block)] for one in S)
        assert ours == pytest.approx(theirs, rel=1e-12, abs=1e-6)
    assert np.array(hawc2.line.twist) == pytest.approx(np.array(beamdyn.line.twist))
