"""The figures in a journal's style: widths, greys, endings."""

import matplotlib.pyplot as plt
import numpy as np
import pytest
import xarray as xr
from matplotlib.colors import to_rgb

from rotbeam_exu import figures
from rotbeam_exu.figures.style import typeset
from rotbeam_exu.paper import MODEL_LINES


@pytest.fixture
def data():
    """As of Figure 14, with three models and one mesh at one speed."""
    a, t = [0.1, 0.2], [2.0, 3.0]
    ratio = 1.0 + np.array([[[0.01, 0.02]], [[-0.01, -0.015]], [[0.0, 0.001]]])
    points = np.array([[[0.999, 0.9985]]])
    bars = np.full((1, 1, 2), 1e-4)
    mesh = ("mesh", "omega", "ramp_time")
    return xr.Dataset(
        {
            "backbone": (("model", "omega", "a"), ratio),
            "ratio": (mesh, points),
            "amplitude": (mesh, [[[0.1, 0.2]]]),
            "ratio_error": (mesh, bars),
            "amplitude_error": (mesh, bars),
        },
        {"model": ["CE", "CI", "exact"], "omega": [6.0], "a": a, "mesh": ["paper"], "ramp_time": t},
    )


def colors(axes):
    return {to_rgb(line.get_color()) for line in axes.get_figure(root=True).axes[0].lines}


def test_the_journal_sets_the_width_and_the_endings(data, tmp_path):
    with figures.style("journal"):
        axes = figures.figure_14(data)[0]
        assert axes.figure.get_figwidth() == pytest.approx(174.0 / 25.4)
        written = figures.save_figure(axes, tmp_path / "one")
    assert [path.name for path in written] == ["one.pdf", "one.svg"]
    assert all(path.stat().st_size > 1000 for path in written)
    # The house's own again.
    assert figures.figure_14(data)[0].figure.get_figwidth() == pytest.approx(7.2)
    own = figures.Style(columns=190.0, formats=("svg",))
    with figures.style(own):
        assert figures.figure_14(data)[0].figure.get_figwidth() == pytest.approx(190.0 / 25.4)


def test_grey_has_no_color_and_tells_lines_apart(data):
    assert any(len(set(rgb)) > 1 for rgb in colors(figures.figure_14(data)[0]))
    with figures.style("grey"):
        axes = figures.figure_14(data)[0]
        (own,) = plt.subplots()[1].plot([0.0, 1.0])
    assert all(len(set(rgb)) == 1 for rgb in colors(axes))
    assert len(set(to_rgb(own.get_color()))) == 1
    looks = {(to_rgb(line.get_color()), str(line._dash_pattern)) for line in axes.lines[:3]}
    assert len(looks) == 3


def test_models_differ_by_more_than_their_color():
    dashes = [str(line["ls"]) for name, line in MODEL_LINES.items() if name != "exact"]
    assert len(set(dashes)) == len(dashes)


def test_an_unknown_style_names_those_that_are_known():
    known = pytest.raises(ValueError, match="known are house, journal, grey")
    with known, figures.style("sepia"):
        pass


def test_numbers_are_typeset():
    words = typeset("-33.4 %, 1.758e-06, 2e+03 and (-v), rad-s, 1-2")
    assert words == "−33.4 %, 1.758·10⁻⁶, 2·10³ and (-v), rad-s, 1-2"


def test_one_speed_has_one_panel(data):
    assert len(figures.figure_14(data)[0].figure.axes) == 1


def test_models_are_spelled_out_where_there_is_room(data):
    (legend,) = figures.figure_14(data)[0].figure.legends
    names = [text.get_text() for text in legend.get_texts()]
    assert names == [
        "CE: cantilever's mode, extensible",
        "CI: cantilever's mode, inextensible",
        "exact: geometrically exact beam",
        "16 elements",
    ]
    figure, ax = plt.subplots(figsize=(3.5, 3.0))
    figures.figure_14(data, ax=[ax])
    assert figure.legends[0].get_texts()[0].get_text() == "CE"
