"""Tables of stations, lines and shapes with one fault at random: one sentence that names it."""

import warnings

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from analytic import Blade, Ellipse, PointMass, Rectangle, RotbeamWarning, Section, Tube
from analytic.parts import Line
from analytic.section_shapes import Box
from tests.spoiled import CELLS, WHOLES, Quantity, spoiled

X = [0.0, 3.0, 8.0]
STIFFNESS = [[1e7, 3e6, 3e6, 8e3, 5e3, 8e4], [7e6, 2e6, 2e6, 4e3, 3e3, 5e4],
             [4e6, 1e6, 1e6, 1e3, 9e2, 2e4]]  # fmt: skip
MASS = [[8.0, 0.3, 0.02, 0.28], [6.0, 0.2, 0.015, 0.18], [4.0, 0.1, 0.01, 0.09]]
PAIRS = [[0.02, 0.01], [0.01, -0.01], [0.03, 0.0]]
TABLE = {"x": X, "stiffness": STIFFNESS, "mass": MASS, "twist": [0.2, 0.1, 0.0]}
TABLE |= dict.fromkeys(("tension", "shear", "center", "axis"), PAIRS)
PLAIN = Blade.from_stations(X, STIFFNESS, MASS).section
MATRICES = TABLE | {"stiffness": PLAIN.stiffness, "mass": PLAIN.mass}
MATRICES |= dict.fromkeys(("tension", "shear", "center"), 0.0)

kinds = st.sampled_from([*CELLS, *WHOLES])
places = st.integers(min_value=0, max_value=200)


def refused(call, name):
    """Require one sentence, which names the argument, of a call."""
    with pytest.raises((TypeError, ValueError)) as found:
        call()
    sentence = str(found.value)
    assert name in sentence, sentence
    assert "\n" not in sentence
    assert len(sentence) < 400


@settings(max_examples=60, deadline=None)
@given(st.sampled_from([TABLE, MATRICES]), st.sampled_from(list(TABLE)), kinds, places)
def test_a_table_of_stations_with_a_fault(table, name, kind, place):
    if table[name] == 0.0:
        return
    bad = {**table, name: spoiled(table[name], kind, place)}
    refused(lambda: Blade.from_stations(**bad), name)


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"center": 0.1}, r"center must be a pair \(c2, c3\) \[m\] at each of the 3 stations"),
        ({"tension": (0.1, 0.2)}, r"if it is the same at all, give \[\[c2, c3\]\] \* 3"),
        ({"axis": PAIRS[:2]}, r"axis must be a pair .* got the shape \(2, 2\)"),
        ({"twist": [0.2, 0.1]}, r"twist must be one number in rad, or one at each of the 3 stat"),
        ({"x": X[:2]}, "at each of the 2 stations"),
        ({"x": [0.0, 8.0, 3.0]}, "x must ascend, but 3 m comes after 8 m"),
        ({"x": [0.0, 0.0, 0.0]}, "x must ascend, but 0 m comes after 0 m"),
        ({"x": [X, X]}, "x must be a sequence of numbers"),
        ({"x": [0.0]}, "x must be two stations or more from 0 to the length, got 1 from 0 to 0 m"),
        ({"stiffness": PLAIN.stiffness}, "tension is a center of columns, and 6x6 matrices have"),
        ({"mass": PLAIN.mass}, "center is a center of columns"),
    ],
)  # fmt: skip
def test_a_table_that_is_not_of_its_stations(change, sentence):
    with pytest.raises(ValueError, match=sentence):
        Blade.from_stations(**{**TABLE, **change})


def test_zeros_are_no_centers():
    zero = dict.fromkeys(("tension", "shear", "center"), np.zeros((3, 2)))
    assert Blade.from_stations(**MATRICES) == Blade.from_stations(**{**MATRICES, **zero})


NUMBERS = {"axial_stiffness": 5e6, "bending_stiffness": 566.0, "mass_per_length": 0.2}
BLADE = Blade(length=8.0, section=Section(**NUMBERS))
FORMS = {
    "number": lambda value: value,
    "coefficients": lambda value: [value, -0.1 * value],
    "stations": lambda value: [[0.0, value], [8.0, 0.5 * value]],
}
SHAPES = [Rectangle(height=0.4, width=0.2), Ellipse(height=0.4, width=0.2)]
SHAPES += [Tube(radius=0.2, wall=0.02), Box(height=0.4, width=0.2, wall=0.01)]


@settings(max_examples=60, deadline=None)
@given(st.sampled_from(["twist", "prebend", "sweep", *NUMBERS]), st.sampled_from([*FORMS]), kinds,
       places)  # fmt: skip
def test_a_profile_with_a_fault(name, form, kind, place):
    """Of a line or a section: a number, coefficients, or stations."""
    good = FORMS[form](NUMBERS.get(name, 0.01))
    bad = spoiled(good, kind, place)
    if form == "number" and kind in ("pair", "bytearray"):  # coefficients are a profile too
        return
    if name in NUMBERS:
        refused(lambda: Section(**{**NUMBERS, name: bad}), name)
    else:
        refused(lambda: Line(**{name: bad}), name)


@settings(max_examples=60, deadline=None)
@given(st.sampled_from([
    ("kinks", lambda bad: Line(kinks=[bad]), (5.0, 0.0, 0.3)),
    ("kinks", lambda bad: Line(kinks=bad), [(5.0, 0.0, 0.3), (6.0, 0.1, 0.0)]),
    ("height", lambda bad: BLADE.with_taper(height=bad), 0.1),
    ("mass_offset", lambda bad: Line(mass_offset=bad), (0.1, 0.2)),
    ("tension_offset", lambda bad: Line(tension_offset=bad), (0.1, 0.2)),
    ("offset", lambda bad: PointMass(position=1.0, mass=1.0, offset=bad), (0.1, 0.2)),
    ("precone", lambda bad: Line(precone=bad), 0.1),
    ("youngs_modulus",
     lambda bad: Blade.from_shapes(X, SHAPES[:3], bad, 2700.0), [7e10, 7e10, 6e10]),
    ("density", lambda bad: Blade.from_shapes(X, SHAPES[:3], 7e10, bad), [2700.0, 2600.0, 2500.0]),
]), kinds, places)  # fmt: skip
def test_a_part_with_a_fault(part, kind, place):
    name, made, good = part
    refused(lambda: made(spoiled(good, kind, place)), name.removesuffix("s"))


@settings(max_examples=60, deadline=None)
@given(st.sampled_from(SHAPES), kinds, places)
def test_a_shape_with_a_fault(shape, kind, place):
    values = {k: x for k, x in vars(shape).items() if x is not None}
    name = sorted(values)[place % len(values)]
    if kind == "nothing":  # follows from the blade
        return
    refused(lambda: type(shape)(**{**values, name: spoiled(values[name], kind)}), name)


@pytest.mark.parametrize("vary", [BLADE.with_twist, BLADE.with_prebend, BLADE.with_sweep])
@pytest.mark.parametrize("at", [(0.0, 10.0), (0.0, 7.0), (1.0, 8.0), (-1.0, 8.0), (0.0, 1.0)])
def test_stations_of_a_line_are_those_of_its_blade(vary, at):
    with pytest.raises(ValueError, match=rf"from {at[0]:g} to {at[1]:g} m: give them from 0 to t"):
        vary([(at[0], 0.1), (at[1], 0.0)])
    assert vary([(0.0, 0.1), (8.0, 0.0)]).line


@pytest.mark.parametrize(
    ("call", "sentence"),
    [
        (lambda: BLADE.with_twist(13.3), r"twist = 13.3 rad is beyond 3.142 .* are 0.2321 rad"),
        (lambda: BLADE.with_twist((13.3, -13.3)), "twist = 13.3 rad"),
        (lambda: Blade.from_stations(X, STIFFNESS, MASS, twist=[13.3, 5, 0]), "twist = 13.3 rad"),
        (lambda: BLADE.with_twist([(0, 3.0), (2, 1.0), (8, 0)]), "slope of -8 rad .* -0.1396 rad"),
        (lambda: BLADE.with_precone(2.5), r"precone = 2.5 rad is beyond 1.571 .* are 0.04363 rad"),
        (lambda: BLADE.with_setting_angle(5.0), r"setting_angle = 5 rad .* are 0.08727 rad"),
        (lambda: BLADE.with_kink(4.0, sweep=-2.0), "angle of a kink = -2 rad"),
    ],
)
def test_an_angle_in_degrees_is_asked_about(call, sentence):
    with pytest.warns(RotbeamWarning, match=sentence):
        call()


def test_a_steep_cell_of_a_small_twist_is_not_asked_about():
    """IEA's blade turns by 0.066 rad in a hundredth of its length."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        BLADE.with_twist([(0, 0.27), (4, 0.2), (4.08, 0.134), (8, 0)])


@pytest.mark.parametrize(
    ("call", "sentence"),
    [
        (lambda: BLADE.with_twist(1e300), r"twist = 1e\+300 rad is more than a turn, even if"),
        (lambda: BLADE.with_prebend(45), "prebend turns the line by 360 rad, more than once"),
        (lambda: BLADE.with_sweep([(0, 0), (8, -2)]), "sweep turns the line by 8 rad"),
        (lambda: BLADE.with_offsets(mass=(0, 100)), "mass_offset is 100 m from the line of a blad"),
        (lambda: BLADE.with_tip_mass(1.0, offset=(100, 0)), "offset of a point mass is 100 m"),
        (lambda: Blade.from_stations(X, STIFFNESS, MASS, axis=[[0, 20]] * 3), "axis is 20 m from"),
    ],
)
def test_a_line_that_no_blade_has(call, sentence):
    with pytest.raises(ValueError, match=sentence):
        call()


def test_a_quantity_of_all_stations_is_not_stripped():
    """Its places are in m, whatever the unit of the values."""
    bad = Quantity(np.array([[0.0, 1.0], [8.0, 1.0]]))
    bad.to = lambda unit: bad
    with pytest.raises(ValueError, match="axial_stiffness has stations .* in one quantity"):
        Section(**{**NUMBERS, "axial_stiffness": bad})
