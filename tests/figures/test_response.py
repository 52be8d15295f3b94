"""The picture of a forced response."""

from dataclasses import replace

import matplotlib.pyplot as plt
import numpy as np
import pytest

from analytic import Beam, Damping, Gravity, forced_response
from rotbeam_exu import dataset_of, figures

BEAM = Beam.reference()


@pytest.fixture(scope="module")
def curves(folded):
    """One response, once more as of a blade with another damping, which is its name."""
    other = BEAM.with_damping(Damping.from_ratio(BEAM, ratio=2e-3))
    return [dataset_of(folded), dataset_of(replace(folded, blade=other))]


def shown(line):
    nu, a = np.array(line.get_xydata()).T
    return nu[~np.isnan(a)], a[~np.isnan(a)]


@pytest.mark.parametrize("of_folds", [True, False])
def test_unstable_is_dashed_from_fold_to_fold_and_all_else_is_solid(curves, of_folds):
    # Round-off decides what a fold itself is, where a multiplier is 1.
    turns = curves[0]["mark"] == "fold"
    data = curves[0].assign(stable=(curves[0]["stable"] & ~turns) | (turns & of_folds))
    ax = figures.forced_response(data)
    solid, dashed, rings, backbone = ax.lines[:4]
    assert (solid.get_linestyle(), dashed.get_linestyle()) == ("-", "--")
    folds = data["amplitude"][data["mark"] == "fold"].to_numpy()
    _, a = shown(dashed)
    assert [a[0], a[-1]] == pytest.approx(folds)
    assert rings.get_ydata() == pytest.approx(folds)
    # Every stable point is on the solid line, and no more than the folds on both.
    both = set(shown(solid)[1].round(12)) & set(a.round(12))
    assert both == set(folds.round(12))
    points = data["amplitude"][data["stable"] & (data["mark"] != "fold")].to_numpy()
    assert set(points.round(12)) <= set(shown(solid)[1].round(12))
    # Between two points either coordinate goes one way: no peak or fold is drawn that is none.
    drawn = np.where(np.isnan(solid.get_xydata()), dashed.get_xydata(), solid.get_xydata())
    steps = np.diff(drawn, axis=0).reshape(data.sizes["point"] - 1, -1, 2)
    assert (np.abs(np.sign(steps).sum(axis=1)) == steps.shape[1]).all()
    assert backbone.get_xdata()[0] == pytest.approx(3.7304014, abs=1e-6)
    assert ax.get_xlabel() == "drive frequency ν [rad/s]"
    assert ax.get_xlim() == pytest.approx((3.7, 3.76))


def test_several_curves_share_axes_and_say_what_sets_them_apart(curves):
    _, ax = plt.subplots()
    assert figures.forced_response(curves, ax=ax) is ax
    names = [text.get_text() for text in ax.get_legend().get_texts()]
    assert names == [
        "ε = 0.002 rad/s, $η_b$ = 0.00055 s", "ε = 0.002 rad/s, $η_b$ = 0.00137 s",
        "backbone", "unstable", "fold",
    ]  # fmt: skip
    assert ax.get_title(loc="left") == "ω = 6 rad/s"


def test_under_gravity_there_is_no_backbone_and_no_single_speed():
    damped = BEAM.with_damping(Damping(external=0.5))
    data = dataset_of(forced_response(damped, [4.5, 5.0], Gravity()))
    ax = figures.forced_response(data)
    assert ax.get_xlabel() == "rotation speed ω [rad/s]"
    assert [text.get_text() for text in ax.get_legend().get_texts()] == [
        "g = 9.81 m/s², $d$ = 0.5 kg/(m s)"
    ]
    assert data.attrs["load"] == Gravity.__name__
    assert ax.get_title(loc="left") == ""


def test_a_least_amplitude_is_a_dip():
    damped = BEAM.with_damping(Damping(external=1.5 * BEAM.mass_per_length * BEAM.frequency_scale))
    data = dataset_of(forced_response(damped, [1.4, 2.0], Gravity(), functions=8))
    marks = [mark for mark in data["mark"].to_numpy() if mark]
    assert marks == ["start", "peak", "dip", "end"]
