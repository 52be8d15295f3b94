"""The drawings have the signs of the package, and stand where axes are explained."""

import re

import numpy as np
import pytest

from analytic import steady_state
from docs.sentences import PAGES, ROOT

DRAWN = ROOT / "docs" / "images"


@pytest.fixture
def blade(beam):
    return beam.with_section_out_of_plane(0.2, 0.1)


def test_the_line_of_a_blade_bends_as_drawn(blade):
    """Prebend < 0 towards b3, sweep < 0 behind; both are curvatures of the unloaded line."""
    radius = 20.0 * blade.length
    angle, across = blade.length / radius, radius * (1.0 - np.cos(blade.length / radius))
    along = radius * np.sin(angle)
    for line, tip in (
        (blade.with_prebend(-1.0 / radius), (along, 0.0, across)),
        (blade.with_sweep(-1.0 / radius), (along, -across, 0.0)),
    ):
        assert steady_state(line, 0.0).tip == pytest.approx(tip, abs=1e-9 * blade.length)


def test_precone_lifts_the_blade_and_rotation_flattens_it(blade):
    """Towards the axis of rotation, so that the centrifugal force bends it down, against b3."""
    assert steady_state(blade.with_precone(0.2), 3.0).tip[2] < -1e-3 * blade.length


@pytest.mark.parametrize("name", ["clamp", "section", "blade_line", "other_axes"])
def test_each_drawing_stands_on_a_page_and_has_words_for_those_who_hear_it(name):
    assert (DRAWN / f"{name}.svg").exists()
    found = [
        re.search(rf"!\[([^]]+)\]\(\S*images/{name}\.svg\)", page.read_text(encoding="utf-8"))
        for page in PAGES
    ]
    words = [one[1] for one in found if one]
    assert words
    assert all(len(one.split()) > 8 for one in words)
