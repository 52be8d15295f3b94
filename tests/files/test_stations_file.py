"""A blade from a CSV file of its stations, with units; shapes and a damping ratio in the TOML."""

import re

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from analytic import Blade, Damping, Rectangle, Section, damping_ratios
from rotbeam_exu.files import stations_file
from rotbeam_exu.files.beam_file import load_beam
from tests.spoiled import nested_with

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
        ("EA [MN]", "AE [MN]", "unknown column 'AE.*'; known are x, EA|unknown column 'AE"),
        ("EA [MN]", "", "unknown column ''; known are"),
        ("EI [kN m^2]", "GJ [kN m^2]", "lacks the column EI2, EI3"),
        ("m [kg/m]", "GJ [N m^2]", "lacks the column m"),
        ("m [kg/m]\n", "m [kg/m],EA [kN]\n", "has two columns EA: keep one"),
        ("m [kg/m]\n", "m [kg/m],GJ [N m^2]\n", "line 2 has 4 cells, the header 5"),
        ("0,5,", "0,5,1,", "line 2 has 5 cells, the header 4; write a decimal point, as 1.5"),
        ("0.6", "", r"line 2 has '' in column EI, which is no number"),
        ("0.4", "4_00", "line 3 has '4_00' in column EI, which is no number"),
        ("0.4", "\u0664", "in column EI, which is no number"),
        ("0.4", "nan", "line 3 has 'nan' in column EI"),
        ("0.4", "1e999", "line 3 has '1e999' in column EI"),
        ("0.4", "5" * 200_000, r"line 3 is no row of a table: field larger"),
        (PLANAR, "", "begins with no title of a known column"),
        (PLANAR, PLANAR.split("\n", maxsplit=1)[0], "has a header and no rows"),
        (",", ";", "no title of a known column: give it a header, .* separated by commas"),
    ],
)
def test_a_bad_table_is_one_sentence(loaded, tmp_path, old, new, sentence):
    with pytest.raises(ValueError, match=sentence) as refused:
        loaded(PLANAR.replace(old, new))
    assert str(tmp_path) in str(refused.value)
    assert len(str(refused.value)) < len(str(tmp_path)) * 2 + 400


@pytest.mark.parametrize("encoding", ["cp1252", "utf-16"])
def test_another_encoding_is_one_sentence(loaded, tmp_path, encoding):
    """Of the CSV, and of the TOML file alike."""
    toml = tmp_path / "other.toml"
    toml.write_text(f"{TOML}# m²\n", encoding=encoding)
    with pytest.raises(ValueError, match=r"other.toml is not written in UTF-8: byte 0x[bf]") as one:
        load_beam(toml)
    assert "CSV UTF-8" in str(one.value)
    loaded(PLANAR)
    (tmp_path / "stations.csv").write_text(SPACE, encoding=encoding)
    with pytest.raises(ValueError, match="stations.csv is not written in UTF-8: byte 0x[bf]"):
        load_beam(tmp_path / "blade.toml")
    (tmp_path / "stations.csv").write_text(PLANAR, encoding="utf-8-sig")  # as Excel writes
    assert load_beam(tmp_path / "blade.toml").length == 8.0


def test_no_row_of_another_file_is_shown(loaded, tmp_path):
    (tmp_path / "secret").write_text("name,password\nroot,hidden\n", encoding="utf-8")
    with pytest.raises(ValueError, match="begins with no title of a known column") as refused:
        loaded("", TOML.replace("stations.csv", "secret"))
    assert "password" not in str(refused.value)
    assert "hidden" not in str(refused.value)


SI = {
    "rad": 1.0, "deg": np.pi / 180, "m": 1.0, "cm": 0.01, "mm": 0.001, "in": 0.0254, "ft": 0.3048,
    "N": 1.0, "kN": 1e3, "MN": 1e6, "GN": 1e9, "N m^2": 1.0, "kN m^2": 1e3, "MN m^2": 1e6,
    "N mm^2": 1e-6, "kg/m": 1.0, "g/mm": 1.0, "t/mm": 1e6, "g/m": 1e-3, "kg m": 1.0,
    "kg m^2/m": 1.0, "t mm": 1.0, "g m": 1e-3,
}  # fmt: skip
FULL = {
    "x": [0.0, 10.0], "twist": [0.2, 0.1], "EA": [1e7, 4e6], "GA2": [3e6, 1e6], "GA3": [2e6, 1e6],
    "GJ": [8e3, 1e3], "EI2": [5e3, 1e3], "EI3": [8e4, 2e4], "m": [8.0, 4.0], "j1": [0.3, 0.1],
    "j2": [0.02, 0.01], "j3": [0.28, 0.09],
} | {f"{name}{axis}": [0.01 * axis, 0.02] for name in ("tension", "shear", "center", "axis")
     for axis in (2, 3)}  # fmt: skip


def written(units):
    """The table `FULL` as a CSV, of each column in one of the units."""
    rows = zip(*(np.array(FULL[name]) / SI[unit] for name, unit in units.items()), strict=True)
    title = ",".join(f"{name} [{unit}]" for name, unit in units.items())
    return "\n".join([title, *(",".join(map(repr, map(float, row))) for row in rows)])


def test_every_unit_of_every_column(loaded):
    """In turn, all columns at once; by factors written here."""
    known = {name: list(stations_file._FACTORS[stations_file._UNITS[name]]) for name in FULL}
    plain = loaded(written({name: units[0] for name, units in known.items()}))
    by_hand = np.array(plain.section.stiffness)
    assert by_hand[0, 3, 3] > FULL["GJ"][0]  # moved from its centers
    for k in range(1, max(map(len, known.values()))):
        found = loaded(written({name: units[k % len(units)] for name, units in known.items()}))
        for kind in ("stiffness", "mass", "x"):
            ours, theirs = (np.array(getattr(one.section, kind)) for one in (found, plain))
            assert ours == pytest.approx(theirs, rel=1e-12, abs=1e-9)
        assert np.array(found.line.twist) == pytest.approx(np.array(plain.line.twist), rel=1e-14)


def test_a_csv_alone_is_the_blade_that_a_toml_file_names(loaded, tmp_path):
    """And stays so whatever its letters are."""
    blade = loaded(SPACE)
    assert load_beam(tmp_path / "stations.csv") == blade.with_hub_radius(0.0)
    (tmp_path / "stations.csv").rename(tmp_path / "S.CSV")
    assert load_beam(tmp_path / "S.CSV") == blade.with_hub_radius(0.0)
    with pytest.raises(ValueError, match="length next to file are for a blade file of ElastoDyn"):
        loaded(SPACE, f"{TOML}length = 8.0\n")


def test_elastodyn_s_columns_are_told_by_the_names_here(loaded):
    """And so named, with EA and GJ, they are a blade."""
    theirs = "BlFract,BMassDen (kg/m),FlpStff [Nm^2],EdgStff\n0,8,5e3,8e4\n1,4,1e3,2e4\n"
    with pytest.raises(ValueError, match="has columns of ElastoDyn: name them as here") as refused:
        loaded(theirs)
    for told in (
        "BlFract is x [m], the length times it",
        "BMassDen (kg/m) is m [kg/m]",
        "FlpStff [Nm^2] is EI2 [N m^2]",
        "EdgStff is EI3 [N m^2]",
        "EA [N] and GJ",
    ):
        assert told in str(refused.value)
    ours = "x [m],m [kg/m],EI2 [N m^2],EI3 [N m^2],EA [N],GJ [N m^2]\n"
    ours += "0,8,5e3,8e4,1e7,8e3\n10,4,1e3,2e4,1e7,8e3\n"
    assert loaded(ours).length == 10.0


def test_two_twists_are_refused(loaded):
    line = "[blade.line]\ntwist = [0.0, 0.1]\n"
    with pytest.raises(ValueError, match=r"\[blade.line\] and \[blade.stations\] both give a tw"):
        loaded(SPACE, TOML + line)
    assert loaded(SPACE.replace(",10,-2", ",0,-2"), TOML + line).line.twist == (0.0, 0.1)
    assert loaded(PLANAR, TOML + line).line.twist == (0.0, 0.1)


@pytest.mark.parametrize(
    ("toml", "sentence"),
    [
        (TOML.replace("stations.csv", "sections.csv"), "there is no file .*sections.csv"),
        (
            SHAPES.replace("[{ kind", '["Tube", { kind'),
            r"write \[\[blade.stations.shapes\]\] as a table",
        ),
        ('[blade]\nstations = "a.csv"', r"write \[blade.stations\] as a table, file = 'a.csv' in"),
        (RATIO.replace("0.02", '{ "lag 99" = 0.02 }'), "ratios name lag 99; the 12 lowest modes"),
        (RATIO.replace("0.02", '{ "lag 1" = true }'), "the ratio of lag 1 must be a number"),
        (RATIO.replace("0.02", "{}"), "ratios must name modes"),
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
    by_name = RATIO.replace("0.02", '{ "lag 1" = 0.02 }')
    assert damping_ratios(loaded(PLANAR, by_name), omega=0.0)[0] == pytest.approx(0.02, rel=1e-6)


def refused(folder, text, name):
    """Require one sentence, which names the argument, of a file."""
    path = folder / "blade.toml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(ValueError, match=re.escape(f"{path}: ")) as found:
        load_beam(path)
    sentence = str(found.value).replace(str(folder), "")
    assert name in sentence, sentence
    assert "\n" not in sentence
    assert len(sentence) < 400


CELLS = st.sampled_from([
    "", "-", "five", "1_0", "\u0664", "nan", "inf", "-1e999", "0x10", "True", "1.0 N", "1.2.3",
    "1e", "1j", "1 000", "1;5", "1d5", "\u2212" + "1.0",
])  # fmt: skip


@settings(max_examples=60, deadline=None)
@given(st.sampled_from([PLANAR, SPACE]), st.integers(0, 20), CELLS)
def test_a_csv_with_a_fault(tmp_path_factory, table, place, cell):
    folder = tmp_path_factory.getbasetemp()
    header, *rows = (line.split(",") for line in table.splitlines())
    k, j = place % len(rows), place % len(header)
    rows[k][j] = cell
    text = "\n".join(map(",".join, [header, *rows]))
    (folder / "stations.csv").write_text(text, encoding="utf-8")
    refused(folder, TOML, f"line {k + 2} has {cell!r} in column {header[j].split(' [')[0]},")


TABLES = {
    "x": [0.0, 8.0],
    "stiffness": [[1e7, 3e6, 3e6, 8e3, 5e3, 8e4], [4e6, 1e6, 1e6, 1e3, 9e2, 2e4]],
    "mass": [[8.0, 0.3, 0.02, 0.28], [4.0, 0.1, 0.01, 0.09]], "twist": [0.2, 0.0],
    **{key: [[0.02, 0.01], [0.03, 0.0]] for key in ("tension", "shear", "center", "axis")},
}  # fmt: skip
LINES = {
    "precone": 0.1, "twist": [0.0, 0.1], "prebend": [[0.0, 0.01], [8.0, 0.0]], "sweep": 0.01,
    "mass_offset": [0.01, 0.0], "tension_offset": [0.0, 0.02], "kinks": [[4.0, 0.1, 0.0]],
}  # fmt: skip
VALUES = st.sampled_from([
    '"1.0"', "true", "nan", "-inf", "[1.0, 2.0, 3.0]", "[]", "2026-01-01", "12:00:00",
    '{ value = 1.0, unit = "m" }',
])  # fmt: skip


def toml_of(tables):
    return "".join(
        f"[blade.{title}]\n" + "".join(f"{key} = {value}\n" for key, value in table.items())
        for title, table in tables.items()
    )


@settings(max_examples=60, deadline=None)
@given(st.sampled_from([(name, key) for name, table in (("stations", TABLES), ("line", LINES))
                        for key in table]), st.integers(0, 20), VALUES)  # fmt: skip
def test_a_toml_table_with_a_fault(tmp_path_factory, key, place, value):
    tables = {"stations": TABLES, "line": {}}
    if key[0] == "line":
        section = "axial_stiffness = 5e6\nbending_stiffness = 566\nmass_per_length = 0.2\n"
        begin, tables = f"[blade]\nlength = 8.0\n[blade.section]\n{section}", {"line": LINES}
    else:
        begin = ""
    title, name = key
    good = tables[title][name]
    bad = repr(nested_with(good, place, "@")).replace("'@'", value)
    text = begin + toml_of({**tables, title: {**tables[title], name: bad}})
    refused(tmp_path_factory.getbasetemp(), text, name.removesuffix("s"))
