"""Linear floating frames in a row."""

import matplotlib as mpl
import numpy as np
import pytest

from analytic import SpinUp
from analytic.input_checks import RotbeamWarning
from rotbeam_exu import figures, simulate
from rotbeam_exu.fem.elements import Substructures
from rotbeam_exu.fem.elements.linear_frames import divergence_speeds
from rotbeam_exu.fem.linearization import Linearization


@pytest.mark.parametrize("frame", ["tangent", "pinned"])
def test_divergence_speed_grows_with_the_number(beam, frame):
    speeds = [Substructures(frame=frame).divergence_speed(beam, n) for n in (1, 2, 3, 4, 6, 8)]
    assert np.all(np.diff(speeds) > 0.0)


def test_the_divergence_speed_depends_on_the_frame(beam):
    """Pinned frames see half the rotation from chord to tangent, and hold out longer."""
    for n in (1, 2, 4):
        pinned, tangent = (
            Substructures(frame=f).divergence_speed(beam, n) for f in ("pinned", "tangent")
        )
        assert pinned > 2.0 * tangent


def test_one_tangent_frame_is_the_linear_beam(beam):
    # Eight cubic cells are within 4e-6 of the beam.
    assert Substructures(cells=8).divergence_speed(beam, 1) == pytest.approx(beam.omega_0, rel=5e-6)


@pytest.mark.parametrize(
    ("n", "frame"), [(1, "tangent"), (2, "tangent"), (4, "tangent"), (1, "pinned"), (2, "pinned")]
)
def test_it_is_where_growth_sets_in(beam, frame, n):
    """All eigenvalues about the steady state, with Coriolis terms, through Exudyn."""
    model, speed = Substructures(frame=frame), Substructures(frame=frame).divergence_speed(beam, n)
    assert Linearization.of(beam, 0.999 * speed, element=model, elements=n).growth_rate == 0.0
    above = Linearization.of(beam, 1.0002 * speed, element=model, elements=n).growth_rate
    # Divergence sets in like a square root.
    assert Linearization.of(
        beam, 1.0008 * speed, element=model, elements=n
    ).growth_rate == pytest.approx(2.0 * above, rel=0.02)


def test_a_run_above_the_divergence_speed_that_stays_bounded_says_so(beam):
    noticed = r"above the divergence speed, 4\.45\d+ rad/s, of 2 'sub"
    with pytest.warns(RotbeamWarning, match=noticed):
        simulate(
            beam, SpinUp(omega=4.6, ramp_time=6.0), element=Substructures(cells=1), elements=2,
            duration=6.6, step=1.5e-2,
        )  # fmt: skip


def test_figure(beam):
    mpl.use("agg")
    data = divergence_speeds(beam, [1, 2, 4])
    axes = figures.divergence_speed(data)
    assert axes.get_ylabel() == "divergence speed [rad/s]"
    drawn = {line.get_label(): line.get_ydata() for line in axes.get_lines()}
    assert drawn["pinned frames"] == pytest.approx(data["divergence_speed"].sel(frame="pinned"))


def test_refuses_a_row_of_no_elements(beam):
    with pytest.raises(ValueError, match="elements must be at least 1, got 0"):
        Substructures().divergence_speed(beam, 0)
