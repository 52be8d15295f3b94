"""Beam files: whatever is in them, a beam or one sentence that names the file."""

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from analytic import Beam, Blade, Damping, Ellipse, Rectangle, Section
from rotbeam_exu.files.beam_file import load_beam, load_run_file
from rotbeam_exu.runs.attributes import beam_of, blade_attributes
from tests.beams import BLADE_TOML

GOOD = """[beam]
length = 8.0
area = 7.299e-5
second_moment = 8.214e-9
youngs_modulus = 6.895e10
density = 2767.0
"""


def written(path, content):
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return path


@pytest.mark.parametrize(
    "content", [GOOD, b"\xef\xbb\xbf" + GOOD.encode(), GOOD.replace("\n", "\r\n")]
)
def test_a_good_file_is_a_beam_whatever_wrote_it(tmp_path, content):
    assert load_beam(written(tmp_path / "beam.toml", content)) == Beam.reference()


def test_a_shape_is_read(tmp_path):
    beam = load_beam(written(tmp_path / "beam.toml", GOOD + 'shape = { kind = "Rectangle" }\n'))
    assert beam == Beam.reference().with_shape(Rectangle())
    section, damping = DAMPED.split("[blade.damping]")
    content = section + 'shape = { kind = "Ellipse", ratio = 2.0 }\n[blade.damping]' + damping
    assert load_beam(written(tmp_path / "blade.toml", content)) == load_beam(
        written(tmp_path / "damped.toml", DAMPED)
    ).with_shape(Ellipse(ratio=2.0))


WHOLE = """[blade]
length = 8.0
hub_radius = 0.5

[blade.section]
axial_stiffness = 5.03e6
bending_stiffness = [[0.0, 600.0], [4.0, 550.0], [8.0, 500.0]]
mass_per_length = [0.2, -0.02]

[[blade.point_mass]]
position = 4.0
mass = 0.1

[blade.damping]
bending = 1e-3
external = 0.02
"""
DAMPED = f"{BLADE_TOML}\n[blade.damping]\nbending = 1e-3\nexternal = 0.02\n"


def test_a_whole_blade_is_read(tmp_path):
    section = Section(
        axial_stiffness=5.03e6,
        bending_stiffness=((0.0, 600.0), (4.0, 550.0), (8.0, 500.0)),
        mass_per_length=(0.2, -0.02),
    )
    blade = Blade(length=8.0, hub_radius=0.5, section=section).with_point_mass(0.1, 4.0)
    damped = blade.with_damping(Damping(bending=1e-3, external=0.02))
    assert load_beam(written(tmp_path / "blade.toml", WHOLE)) == damped
    bare = WHOLE.partition("[blade.damping]")[0]
    assert load_beam(written(tmp_path / "blade.toml", bare)) == blade


def test_no_rotary_inertia_is_other_than_none_told(tmp_path):
    for told, found in (("", None), ("rotary_inertia = 0", 0.0), ("rotary_inertia = 1e-4", 1e-4)):
        blade = load_beam(written(tmp_path / "blade.toml", f"{BLADE_TOML}{told}\n"))
        assert blade.section.rotary_inertia == found
        assert beam_of(blade_attributes(blade)) == blade


MASS = "mass_per_length = [0.2, -0.02]"
PLANE = f"{MASS}\n[blade.section.out_of_plane]\n"


BAD = [
    (GOOD.replace("8.0", "nan"), "length must be finite, got nan m"),
    (GOOD.replace("8.0", "-inf"), "length must be finite"),
    (GOOD.replace("8.0", "1" + 400 * "0"), "too large|finite|largest floating point"),
    (GOOD.replace("8.0", 5000 * "1"), "not valid TOML: .* digits"),
    (GOOD.replace("8.0", "true"), "length must be a number in m, got True"),
    (GOOD.replace("8.0", "1979-05-27"), "length must be a number in m"),
    (GOOD.replace("8.0", "[8.0]"), "length must be a number in m"),
    (GOOD + "length = 8.0\n", "not valid TOML"),
    (GOOD.replace("8.0", "8,0"), "not valid TOML: .*; write 8.0 for 8,0"),
    (GOOD + "hub_radius = 0.5\n", "'hub_radius' in .beam.; known are length, area"),
    ("omega = 4.0\n" + GOOD, "unknown key 'omega' in the file; known are beam, blade, motion"),
    (GOOD.replace("length", "lenght"), "unknown key 'lenght' in .beam.; did you mean 'length'"),
    (GOOD.replace("density", "# "), "lacks density"),
    ("beam = 3", "write .beam. as a table"),
    ("", "has no table .beam."),
    ("# Größe\n".encode("latin-1"), "not written in UTF-8: byte 0xf6"),
    (GOOD.encode("utf-16"), "not written in UTF-8: byte 0xff"),
    (b"\0\0\0", "not valid TOML"),
]
# With motion, numerics and loads.
BAD += [
    ("[motion]\nomega = -1", "beam.toml: omega must not be negative, got -1.0 rad/s"),
    ("[motion]\nomega = '60rpm'", "omega must be a number in rad/s, got '60rpm'"),
    ("[motion]\nramp_time = 'long'", "beam.toml: ramp_time must be a number"),
    ("[numerics]\nelements = 2.5", "beam.toml: elements must be a whole number"),
    ("[numerics]\nelement = 3", "beam.toml: element must be a name in quotes, got 3"),
    ("motion = 3", r"write \[motion\] as a table"),
    ("loads = 3", "write each ..loads.. as a table"),
    ("[[loads]]\nkind = 'Storm'", "'Storm' is no known Load"),
    ("[[loads]]\nkind = 'TipForce'\nsize = 1.0", "this is no TipForce"),
    ("[movement]\nomega = 6", "unknown key 'movement' in the file; known are beam"),
]
CHANGED = [
    ("hub_radius", "hub_radios", r"unknown key 'hub_radios' in \[blade\]; did you mean 'hub_r"),
    ("mass_per_length", "mass_length", r"did you mean 'mass_per_length'\?"),
    ("position = 4.0", "", r"\[\[blade.point_mass\]\] lacks position"),
    ("[4.0, 550.0]", "[9.0, 550.0]", "must ascend"),
    ("0.5", "-0.5", "hub_radius must not be negative"),
    ("[blade.section]", "[beam]", r"has both \[beam\] and \[blade\]"),
    ("bending = 1e-3", "bendin = 1", "'bendin' in .blade.damping.; did you mean 'bending'"),
    ("bending = 1e-3", "loss = 1e-3", "in .blade.damping.; known are bending, axial, ext"),
    ("bending = 1e-3", "bending = -1.0", "bending must not be negative, .* it gives none"),
    ("[blade.damping]", "[blade.dampings]", "'dampings' in .blade.; did you mean 'damping'"),
    ("[blade.damping]", "[[blade.damping]]", "write .blade.damping. as a table"),
    (MASS, f"{MASS}\nout_of_plane = 1.0", r"write \[blade.section.out_of_plane\] as a table"),
    (MASS, f"{PLANE}torsion_ratio = 1.0", "lacks bending_ratio"),
    (MASS, f"{PLANE}bending_ratio = 1.0\ntorsion = 1.0", "did you mean 'torsion_ratio'"),
    (MASS, f"{PLANE}bending_ratio = -1.0", "bending_ratio must be positive"),
    (MASS, f'{MASS}\nshape = "Tube"', r"write \[blade.section.shape\] as a table"),
    (MASS, f'{MASS}\nshape = {{ kind = "Blade" }}', "'Blade' is no known SectionShape"),
    (
        MASS,
        f'{MASS}\nshape = {{ kind = "Tube", height = 1.0 }}',
        "this is no Tube",
    ),
    (
        MASS,
        PLANE.replace("\n", '\nshape = { kind = "Tube" }\n', 1) + "bending_ratio = 1.0",
        "say the same: keep one",
    ),
]
BAD += [(WHOLE.replace(old, new, 1), sentence) for old, new, sentence in CHANGED]
LINE = (
    f"{BLADE_TOML}[blade.section.out_of_plane]\nbending_ratio = 0.1\ntorsion_ratio = 0.2\n"
    "[blade.line]\ntwist = [[0.0, 0.3], [4.0, 0.1], [8.0, 0.0]]\n"
    "precone = 0.04\nmass_offset = [0.01, 0.0]\n"
    "[[blade.point_mass]]\nposition = 8.0\nmass = 0.1\noffset = [0.02, 0.0]\n"
)
STATIONS = (
    "[blade]\nhub_radius = 0.5\n[blade.line]\nprecone = 0.04\n[blade.stations]\n"
    "x = [0.0, 8.0]\ntwist = [0.2, 0.0]\nmass = [[8.0, 0.3, 0.02, 0.28], [4, 0.1, 0.01, 0.09]]\n"
    "stiffness = [[1e7, 3e6, 3e6, 8e3, 5e3, 8e4], [4e6, 1e6, 1e6, 1e3, 9e2, 2e4]]\n"
)
MASSES = r"unknown key 'masses' in \[blade.stations\]; did you mean 'mass'"
BAD += [
    (LINE.replace("precone", "cone"), r"unknown key 'cone' in \[blade.line\]; did you mean 'pr"),
    (STATIONS.replace("mass", "masses"), MASSES),
    (STATIONS.replace("8e3", "-8e3"), "stiffness at x = 0 m has GJ = -8000"),
    (STATIONS.replace("hub_radius = 0.5", "length = 8.0"), r"unknown key 'length' in \[blade\]"),
]


@pytest.mark.parametrize(("content", "sentence"), BAD)
def test_a_bad_file_is_one_sentence(tmp_path, content, sentence):
    path = written(tmp_path / "beam.toml", content)
    with pytest.raises(ValueError, match=sentence) as refused:
        load_run_file(path)
    assert str(path) in str(refused.value)


WORDS = st.one_of(
    st.floats().map(repr),
    st.integers(-(10**400), 10**400).map(str),
    st.sampled_from(["true", '"8"', "[8.0]", "{}", "1979-05-27", "0x10", "1_0.0", "", "=", "\n"]),
    st.text(max_size=5),
)
LINES = st.tuples(
    st.sampled_from([*GOOD.replace("[beam]", "").replace("=", "").split()[::2], "mass_per_length"]),
    WORDS,
).map(" = ".join)


@settings(suppress_health_check=[HealthCheck.too_slow])
@given(
    st.one_of(
        st.lists(LINES, max_size=6)
        .map(lambda x: "\n".join(["[beam]", *x]))
        .map(lambda x: x.encode(errors="replace")),
        st.binary(max_size=40),
    )
)
def test_any_file_is_a_beam_or_a_sentence(tmp_path_factory, content):
    path = written(tmp_path_factory.getbasetemp() / "any.toml", content)
    try:
        beam = load_beam(path)
    except ValueError as error:
        refused = str(error)
    else:
        refused = f"{path}: {beam!r}"
    assert str(path) in refused


def test_a_twisted_and_coned_blade(tmp_path):
    section = Section(axial_stiffness=5e6, bending_stiffness=566.0, mass_per_length=0.2)
    by_hand = (
        Blade(length=8.0, section=section)
        .with_section_out_of_plane(0.1, 0.2)
        .with_twist(((0.0, 0.3), (4.0, 0.1), (8.0, 0.0)))
        .with_precone(0.04)
        .with_offsets(mass=(0.01, 0.0))
        .with_tip_mass(0.1, offset=(0.02, 0.0))
    )
    assert load_beam(written(tmp_path / "blade.toml", LINE)) == by_hand


def test_a_blade_from_stations(tmp_path):
    """Twist of the stations, precone of the line."""
    stiffness = [[1e7, 3e6, 3e6, 8e3, 5e3, 8e4], [4e6, 1e6, 1e6, 1e3, 9e2, 2e4]]
    mass = [[8.0, 0.3, 0.02, 0.28], [4.0, 0.1, 0.01, 0.09]]
    by_hand = Blade.from_stations([0.0, 8.0], stiffness, mass, twist=[0.2, 0.0])
    by_hand = by_hand.with_precone(0.04).with_hub_radius(0.5)
    assert load_beam(written(tmp_path / "blade.toml", STATIONS)) == by_hand
