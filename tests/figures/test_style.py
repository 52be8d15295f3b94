"""The figures in a journal's style: widths, greys, endings."""

from dataclasses import replace

import matplotlib.pyplot as plt
import numpy as np
import pytest
import xarray as xr
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.colors import to_rgb

from analytic import Beam
from rotbeam_exu import figures
from rotbeam_exu.figures.style import fitting_units, prefix_of, quantity, typeset
from rotbeam_exu.paper import MODEL_LINES, RAMP_TIMES, SPEEDS
from rotbeam_exu.runs.attributes import blade_attributes


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
            "backbone": (("model", "omega", "a"), ratio), "ratio": (mesh, points),
            "amplitude": (mesh, [[[0.1, 0.2]]]), "ratio_error": (mesh, bars),
            "amplitude_error": (mesh, bars),
        },
        {"model": ["CE", "CI", "exact"], "omega": [6.0], "a": a, "mesh": ["paper"], "ramp_time": t},
        {**blade_attributes(Beam.reference()), "meshes": "16 cable elements"},
    )  # fmt: skip


def colors(axes):
    return {to_rgb(line.get_color()) for line in axes.get_figure(root=True).axes[0].lines}


def test_the_journal_sets_the_width_and_the_endings(data, tmp_path):
    with figures.style("journal"):
        axes = figures.figure_14(data)[0]
        assert axes.figure.get_figwidth() == pytest.approx(174.0 / 25.4)
        written = figures.save_figure([axes], f"{tmp_path}/one")
    assert [path.name for path in written] == ["one.pdf", "one.svg"]
    assert all(path.stat().st_size > 1000 for path in written)
    # The house's own again.
    assert figures.figure_14(data)[0].figure.get_figwidth() == pytest.approx(7.2)
    with figures.style(85):  # of one column [mm]
        assert figures.figure_14(data)[0].figure.get_figwidth() == pytest.approx(176.0 / 25.4)


def test_grey_has_no_color_and_tells_lines_apart(data):
    assert any(len(set(rgb)) > 1 for rgb in colors(figures.figure_14(data)[0]))
    with figures.style("grey"):
        axes = figures.figure_14(data)[0]
        (own,) = plt.subplots()[1].plot([0.0, 1.0])
    assert all(len(set(rgb)) == 1 for rgb in colors(axes))
    assert len(set(to_rgb(own.get_color()))) == 1
    looks = {(to_rgb(line.get_color()), str(line._dash_pattern)) for line in axes.lines[:3]}
    assert len(looks) == 3
    dashes = [str(line["ls"]) for name, line in MODEL_LINES.items() if name != "exact"]
    assert len(set(dashes)) == len(dashes), "by more than their color"


def test_an_unknown_style_names_those_that_are_known():
    known = pytest.raises(ValueError, match="known are house, journal, grey")
    with known, figures.style("sepia"):
        pass


def test_models_are_spelled_out_where_there_is_room(data):
    figure = figures.figure_14(data)[0].figure
    assert len(figure.axes) == 1  # of one speed
    (legend,) = figure.legends
    names = [text.get_text() for text in legend.get_texts()]
    assert names == [
        "CE: cantilever's mode, extensible", "CI: cantilever's mode, inextensible",
        "exact: geometrically exact beam", "16 elements",
    ]  # fmt: skip
    figure, ax = plt.subplots(figsize=(3.5, 3.0))
    figures.figure_14(data, ax=[ax])
    assert figure.legends[0].get_texts()[0].get_text() == "CE"


@given(st.floats(1e-12, 1e14))
def test_a_prefix_leaves_three_digits_before_the_point(value):
    factor, prefix = prefix_of(value)
    if prefix:
        assert 1.0 - 1e-12 <= value / factor < 1000.0 * (1.0 + 1e-12) or prefix in "pT"
    else:
        assert 0.1 <= value < 1e4


@pytest.mark.parametrize(
    ("size", "unit", "shown"),
    [(3e-4, "m", "µm"), (8.0, "m", "m"), (1.2e6, "rad/s", "Mrad/s"), (3e-4, "1", "1"),
     (2e-6, "kg/m", "kg/m")],
)  # fmt: skip
def test_axes_have_fitting_units_and_keep_their_data(size, unit, shown):
    axes = plt.subplots()[1]
    axes.plot([0.0, 0.5 * size, size], [0.0, 1.0, 2.0])
    axes.set_xlabel(f"x [{unit}]")
    fitting_units(axes)
    assert axes.get_xlabel() == f"x [{shown}]"
    factor = prefix_of(size)[0] if shown != unit else 1.0
    axes.figure.draw_without_rendering()
    offset = axes.xaxis.get_offset_text().get_text()
    if not offset:
        for place, text in zip(axes.get_xticks(), axes.get_xticklabels(), strict=True):
            assert float(text.get_text().replace("−", "-")) * factor == pytest.approx(place)
    np.testing.assert_array_equal(axes.lines[0].get_xdata(), [0.0, 0.5 * size, size])


def test_numbers_in_words_have_a_prefix_beyond_those_of_the_paper_s_beam():
    words = typeset("-33.4 %, 1.758e-06, 2e+03 and (-v), rad-s, 1-2")
    assert words == "−33.4 %, 1.758·10⁻⁶, 2·10³ and (-v), rad-s, 1-2"
    assert quantity(0.002, "rad/s") == "0.002 rad/s"
    assert quantity(4.5e-5, "s") == "45 µs"
    assert quantity(5.0328e6, "N", 4) == "5.033 MN"
    assert quantity(2e-6, "kg/m") == "2e-06 kg/m"


def test_a_caption_has_the_claim_of_the_paper_s_data_only(data):
    claim = figures.PAPER_FIGURES[14].claim
    assert "The paper explains" in claim
    assert "The paper explains" not in figures.caption(14, data)
    all_of_it = data.isel(omega=0, ramp_time=0, drop=True).expand_dims(
        omega=list(SPEEDS), ramp_time=list(RAMP_TIMES)
    )
    assert "The paper explains" in figures.caption(14, all_of_it)
    other = blade_attributes(replace(Beam.reference(), length=2.0))
    assert "The paper explains" not in figures.caption(14, all_of_it.assign_attrs(other))
