"""The pictures of the stability of the plane: what they show is in the data."""

import numpy as np
import pytest

from analytic import Rectangle, Theory, Tube, periodic_orbits
from analytic.exact.free.stability_limit import StabilityLimit
from rotbeam_exu import comparison, dataset_of, figures


def test_growth_over_the_amplitude(beam):
    blade = beam.with_hub_radius(0.0).with_shape(Rectangle(ratio=3.0))
    found = periodic_orbits(blade, 2.0, [0.25, 0.3]).out_of_plane()
    axes = figures.planar_stability(dataset_of(found))
    by_label = {line.get_label(): line for line in axes.lines}
    assert by_label["sum resonance"].get_xydata() == pytest.approx(
        np.array([[0.3, found.growth_rate[1]]])
    )
    assert by_label["stays in plane"].get_xdata() == pytest.approx([0.25])
    # No line joins orbits between which others may stay.
    assert all(line.get_linestyle() == "None" for line in axes.lines)
    limit = StabilityLimit(
        blade=blade, omega=2.0, mode="lag 1", damping=0.0, theory=Theory(), growth=0.01,
        amplitude=0.28, searched=0.3, kind="", modes=(), tongues=(), converged=True,
    )  # fmt: skip
    (line,) = figures.planar_stability(dataset_of(found, limit)).lines[-1:]
    assert line.get_label() == "limit, a = 0.28"
    assert line.get_xdata() == pytest.approx([0.28, 0.28])


def test_what_stays_is_drawn_at_zero(beam):
    found = periodic_orbits(beam.with_shape(Tube()), 6.0, [0.1, 0.3]).out_of_plane()
    axes = figures.planar_stability(dataset_of(found))
    assert axes.get_ylim()[0] == 0.0
    assert axes.get_yticks().tolist() == [0.0]


def test_the_line_of_the_map_is_where_growth_begins(beam):
    """At 0.0402 and 0.0594, by another search; 2.2 % of the amplitude lie between two points."""
    amplitudes = np.geomspace(0.039, 0.064, 24)
    data = comparison.growth_out_of_plane(omegas=[2.0, 4.0], amplitudes=amplitudes)
    rate = data["growth_rate"].to_numpy()
    assert np.all(rate[:, 0] < 0.0), "what is stable decays"
    axes = figures.growth_out_of_plane(data)
    line = np.concatenate([path.vertices for path in axes.collections[-1].get_paths()])
    for omega, limit in ((2.0, 0.0402), (4.0, 0.0594)):
        assert np.abs(line[line[:, 0] == omega, 1] / limit - 1.0).min() < 0.022
    # White is what stays, not what was not computed.
    assert axes.get_ylim() == pytest.approx((0.039, 0.064))


def test_a_map_of_an_unknown_section_is_refused(beam):
    with pytest.raises(ValueError, match="out of its plane is unknown: give its section"):
        comparison.growth_out_of_plane(beam, omegas=[2.0], amplitudes=[0.02])
    with pytest.raises(ValueError, match="omegas must be"):
        comparison.growth_out_of_plane(omegas=[], amplitudes=[0.02])
