"""Tables of stations, lines and shapes with one fault at random: one sentence that names it."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from analytic import Blade
from tests.spoiled import CELLS, WHOLES, spoiled

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
    """The sentence, which names the argument, of a call that must be refused."""
    with pytest.raises((TypeError, ValueError)) as found:
        call()
    sentence = str(found.value)
    assert name in sentence, sentence
    assert "\n" not in sentence
    assert len(sentence) < 400
    return sentence


@settings(max_examples=100, deadline=None)
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
        ({"x": [X, X]}, "x must be a sequence of numbers"),
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
