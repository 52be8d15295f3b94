"""What results draw of themselves is what they hold."""

import math

import matplotlib.pyplot as plt
import numpy as np
import pytest

from analytic import Rectangle, Tube, backbone_curve, campbell, linear_modes, periodic_orbits
from analytic.plotting import apart


def test_a_backbone_starts_at_the_linear_frequency(beam):
    found = periodic_orbits(beam, 6.0, [0.2, 0.1])
    ax = found.plot(color="k")
    curve, dots = ax.lines
    np.testing.assert_array_equal(dots.get_ydata(), [0.0, 0.2, 0.1])
    np.testing.assert_array_equal(dots.get_xdata(), [found.omega_n, *found.frequency])
    assert curve.get_color() == dots.get_color() == "k"
    assert ax.get_legend().get_texts()[0].get_text() == "ω = 6 rad/s"
    # A second one goes on the same axes, and no figure is made.
    assert found.plot(ax, label="mine") is ax
    assert len(plt.get_fignums()) == 1
    assert [text.get_text() for text in ax.get_legend().get_texts()] == ["ω = 6 rad/s", "mine"]


def test_a_backbone_is_drawn_as_a_curve_through_its_dots(beam):
    """Against the series: the chord from 0.3 to 0.6 is 20 pixels of 400 off."""
    found = periodic_orbits(beam, 6.0, [0.3, 0.6])
    curve = found.plot().lines[0]
    frequency, amplitude = curve.get_xdata(), curve.get_ydata()
    exact = backbone_curve(beam, 6.0, up_to=0.6).frequency(amplitude)
    pixel = np.ptp(exact) / 400.0
    assert np.abs(frequency - exact).max() < pixel
    # A higher one on the same axes is seen as well.
    ax = periodic_orbits(beam, 6.0, [0.1]).plot()
    found.plot(ax)
    assert ax.get_ylim()[0] == 0.0
    assert ax.get_ylim()[1] > 0.6
    # Its chords, too, are nowhere a pixel from the curve.
    middle = 0.5 * (amplitude[1:] + amplitude[:-1])
    exact = backbone_curve(beam, 6.0, up_to=0.6).frequency(middle)
    assert np.abs(0.5 * (frequency[1:] + frequency[:-1]) - exact).max() < pixel


def test_a_campbell_diagram_names_its_modes_apart(beam):
    diagram = campbell(beam, [0.0, 4.0, 8.0])
    _, ax = plt.subplots()
    assert diagram.plot(ax) is ax
    texts = {text.get_text(): text for text in ax.texts}
    assert {"lag 1", "lag 2", "lag 3", "1ω", "2ω"} <= set(texts)
    orders = max(crossing.order for crossing in diagram.crossings)
    curves = ax.lines[orders : orders + 3]
    for line, column in zip(curves, diagram.frequencies.T, strict=True):
        at = np.isin(line.get_xdata(), diagram.omegas)
        np.testing.assert_allclose(line.get_ydata()[at], column, rtol=1e-9)
    dots = ax.lines[-1].get_xydata()
    np.testing.assert_array_equal(dots, [(c.omega, c.frequency) for c in diagram.crossings])
    # No two names overlap.
    ax.figure.draw_without_rendering()
    boxes = [text.get_window_extent() for text in texts.values()]
    assert not any(a.overlaps(b) for i, a in enumerate(boxes) for b in boxes[:i])


def test_the_dots_of_a_campbell_diagram_lie_on_its_curves(beam):
    """Also between speeds 6 rad/s apart, of several families: to a third of a pixel of 400."""
    diagram = campbell(beam.with_shape(Tube()), [0.0, 6.0, 12.0], 3, 6)
    ax = diagram.plot()
    curves = dict(zip(diagram.names, ax.lines[-4:-1], strict=True))
    assert {one.mode for one in diagram.crossings} == set(diagram.names)
    for one in diagram.crossings:
        curve = curves[one.mode]
        drawn = np.interp(one.omega, curve.get_xdata(), curve.get_ydata())
        assert drawn == pytest.approx(one.frequency, abs=ax.get_ylim()[1] / 1200.0)


def test_a_campbell_diagram_has_scales_in_hertz_and_revolutions_a_minute(beam):
    ax = campbell(beam, [0.0, 4.0], 1).plot()
    ax.figure.draw_without_rendering()
    speed, frequency = ax.child_axes
    assert speed.get_xlim() == pytest.approx((0.0, 4.0 * 60.0 / (2.0 * np.pi)))
    assert frequency.get_ylim() == pytest.approx(np.array(ax.get_ylim()) / (2.0 * np.pi))


def test_modes_are_drawn_by_the_part_of_their_family(beam):
    """Lag of a cantilever at rest: its tip is 1, and mode j has j - 1 nodes between."""
    modes = linear_modes(beam.with_shape(Rectangle()), 0.0, 5)
    ax = modes.plot()
    texts = [text.get_text() for text in ax.get_legend().get_texts()]
    assert texts[0] == f"flap 1, {modes.frequencies[0] / (2.0 * np.pi):.4g} Hz"
    for name, line in zip(modes.names, ax.lines, strict=True):
        shape = line.get_ydata()
        assert shape[[0, -1]] == pytest.approx([0.0, 1.0], abs=1e-9)
        assert np.count_nonzero(np.diff(np.sign(shape[1:]))) == int(name.split()[1]) - 1


def test_a_blade_is_named_by_the_plane_that_it_bends_in(beam):
    for angle, name in (
        (0.0, "lag 1"),
        (90.0, "flap 1"),
        (-90.0, "flap 1"),
        (45.0, "lag 1"),
    ):
        diagram = campbell(beam.with_setting_angle(math.radians(angle)), [0.0, 4.0], 1)
        assert diagram.names == (name,)
    assert name in {text.get_text() for text in diagram.plot().texts}


def test_a_campbell_diagram_without_crossings_has_the_line_of_the_first_order(beam):
    diagram = campbell(beam, [0.0, 0.5], 1, orders=5)
    assert not diagram.crossings
    assert [text.get_text() for text in diagram.plot().texts] == ["1ω", "lag 1"]


@pytest.mark.slow  # what a user asks to be cut off
def test_what_leaves_the_frame_of_a_campbell_diagram_has_no_name(beam):
    diagram = campbell(beam.with_shape(Rectangle()), [0.0, 12.0], 2, only="torsion")
    ax = diagram.plot(highest=100.0)
    names = {text.get_text() for text in ax.texts}
    assert "torsion 1" in names
    assert "torsion 2" not in names  # 193 rad/s
    assert ax.get_ylim() == (0.0, 100.0)
    assert ax.lines[-1].get_ydata().max() <= 100.0


def test_labels_move_up_only_where_they_must():
    np.testing.assert_allclose(apart(np.array([3.0, 1.0, 1.1, 1.2]), 0.5), [3.0, 1.0, 1.5, 2.0])


def test_a_response_is_dashed_where_it_is_unstable(folded):
    ax = folded.plot()
    solid, dashed, rings = ax.lines
    assert (solid.get_linestyle(), dashed.get_linestyle()) == ("-", "--")
    np.testing.assert_allclose(rings.get_xdata(), [fold.frequency for fold in folded.folds])
    # From fold to fold, through the points between; the two parts are the whole curve.
    first, last = np.flatnonzero(np.array(folded.marks) == "fold")
    a = dashed.get_ydata()[~np.isnan(dashed.get_ydata())]
    assert a[[0, -1]] == pytest.approx(folded.amplitude[[first, last]])
    assert set(folded.amplitude[first : last + 1].round(12)) <= set(a.round(12))
    assert not np.isnan(np.fmax(solid.get_ydata(), dashed.get_ydata())).any()
    assert ax.get_xlabel() == "drive frequency ν [rad/s]"
