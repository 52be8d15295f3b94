"""The data and the pictures of all figures."""

import functools
from dataclasses import replace

import matplotlib.pyplot as plt
import numpy as np
import pytest
import xarray as xr

from analytic import SpinUp, reduced_model
from rotbeam_exu import comparison, figures
from rotbeam_exu.cli import main
from rotbeam_exu.comparison import runs
from rotbeam_exu.comparison.runs import reference_displacement, reference_velocity


@pytest.fixture(scope="module")
def data_of():
    """The data of a figure by its number, computed once; runs take steps of 8 ms."""
    coarse = functools.partial(runs.simulate, step=8e-3)

    @functools.cache
    def data(number):
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(runs, "simulate", coarse)
            return getattr(comparison, f"figure_{number}")()

    return data


def test_figure_3_even_one_element_is_stable(data_of):
    data = data_of(3)
    # What is inset: one element is 10 % fast, three are nearly in phase with the exact beam.
    words = figures.caption(3, data)
    assert "1 element: −32.8 and −10.2 %; 2 elements: +1.7 and −1.0 %; 3 elements: +0.3" in words
    assert np.abs(data["q"][-1] - data["exact"]).max() < 0.01 * np.abs(data["exact"]).max()
    assert "cable elements, step 8 ms" in words
    steady = np.abs(data["q"].where(data["time"] > 15.0)).max("time")
    assert (steady < 0.05).all()
    assert "[m]" in figures.figure_3(data).get_ylabel()
    # Two and three elements agree on the lag to 1 %, one does to 5 %.
    lag = data["q"].min("time")
    assert lag.sel(elements=2).item() == pytest.approx(lag.sel(elements=3).item(), rel=0.01)
    assert lag.sel(elements=1).item() == pytest.approx(lag.sel(elements=3).item(), rel=0.05)


def test_figure_4_normalization_has_the_units_of_a_velocity(beam):
    """A quarter of E: the same beam in a time unit twice as long."""
    slow = replace(beam, youngs_modulus=0.25 * beam.youngs_modulus)
    spin_ups = (SpinUp(omega=4.0, ramp_time=3.0), SpinUp(omega=2.0, ramp_time=6.0))
    both = list(zip((beam, slow), spin_ups, strict=True))
    # Lengths stay, velocities fall by the factor of time: the print's Eq. 18 does not.
    lengths, velocities = (
        [scale(one, spin_up) for one, spin_up in both]
        for scale in (reference_displacement, reference_velocity)
    )
    assert lengths[1] == pytest.approx(lengths[0])
    assert velocities[1] == pytest.approx(0.5 * velocities[0])


def test_figure_4_orbits_close(data_of):
    data = data_of(4)
    left, right = figures.figure_4(data)
    assert (left.get_xlim(), left.get_ylim()) == (right.get_xlim(), right.get_ylim())
    # The last of a) is the first of b), and drawn as it is; pale lines are all turns of each.
    common = [panel.lines[i] for panel, i in ((left, 5), (right, 1))]
    np.testing.assert_array_equal(*[line.get_xydata() for line in common])
    assert common[0].get_color() == common[1].get_color() == "0.4"
    looks = [line.get_linestyle() + str(line._dash_pattern) for line in left.lines[1::2]]
    assert len(set(looks)) == 3
    # The second mode, in the steady motion after the shortest ramp.
    assert data["smear"].to_numpy()[:3] == pytest.approx([0.011, 0.0013, 0.0002], rel=0.2)
    assert "T = 1.5 s is smeared: 1.0 % of its velocity" in figures.caption(4, data)
    orbit = data.isel(case=2)
    assert float(np.abs(orbit["q_bar"]).max()) == pytest.approx(3.3, abs=0.1)
    assert data["panel"].to_numpy().tolist() == list("aaabbb")


def test_figure_8_is_bounded_by_its_limits_and_has_the_exact_beam(data_of):
    data, ratio = data_of(8), data_of(8)["ratio"]
    assert (ratio[0] >= 1.0).all()
    assert (ratio[2] <= ratio[1]).all()
    # λ_ω → 3.3504/2.3901 as Ω → ∞, Eq. 64.
    limit = 1.0 - 3.3504 / 2.3901 * 0.4**2
    assert ratio[2, -1].item() == pytest.approx(limit, abs=1e-4)
    # At rest the model is right, to its fourth order; in rotation it is far off.
    model = data["ratio"].sel(amplitude=0.4, method="nearest").to_numpy()
    exact = data["exact"].sel(exact_amplitude=0.4, method="nearest").to_numpy()
    assert model[0] == pytest.approx(exact[0], abs=3e-4)
    assert abs(model[1] - exact[1]) > 0.03
    ax = figures.figure_8(data)
    black = [line for line in ax.lines if line.get_color() == "black"]
    np.testing.assert_array_equal([line.get_xdata() for line in black], data["exact"])


def test_exact_coefficients_are_those_of_small_orbits(beam, data_of):
    ten = data_of(10)
    for omega in (2.0, 8.4):
        exact = ten.sel(model="exact", omega=omega)
        # FrM is the inextensible beam to this order.
        model = reduced_model(beam, omega, "FrM")
        assert exact["lambda_omega"].item() == pytest.approx(model.lambda_omega, abs=1.1e-4)
        assert exact["lambda_x"].item() == pytest.approx(model.lambda_x, abs=1.1e-4)


def test_figures_9_to_11_have_the_papers_values(beam, data_of):
    nine = data_of(9)
    at_one = nine.sel(speed_ratio=1.0, model="CI")
    assert at_one["lambda_omega"].item() == pytest.approx(
        (3.3504 - 0.23963) / (2.3901 + 12.362), abs=2e-5
    )
    ten = data_of(10)
    # The paper: degree 5 is nearest to the mode at low speed, and degree 4 never hardens.
    low = np.abs(ten["lambda_omega"] - ten["lambda_omega"].sel(model="CI")).sel(
        omega=1.0, method="nearest"
    )
    assert low.isel(model=slice(1, None)).idxmin("model").item() == "degree 5"
    assert (ten["lambda_omega"].sel(model="degree 4") > 0.0).all()
    eleven = data_of(11)
    # From 4 rad/s on shapes differ by less than all do from the exact beam; at rest CI is right.
    shapes = ten["lambda_omega"].isel(model=slice(-1))
    spread = (shapes.max("model") - shapes.min("model")).sel(omega=slice(4.0, None))
    off = (shapes - ten["lambda_omega"].sel(model="exact")).sel(omega=slice(4.0, None))
    assert (spread < 0.25 * off.min("model")).all()
    at_rest = ten["lambda_omega"].sel(omega=0.0)
    assert at_rest[0].item() == pytest.approx(at_rest[-1].item(), abs=1e-4)
    # The paper: an initial hardening, and less softening than without extensibility.
    first = eleven["lambda_omega"].isel(omega=slice(0, 20))
    assert (first.isel(model=slice(4)).diff("omega") < 0.0).all()
    # The exact beam begins to soften at once, but for the thickest, which ends at 0.6 of its burst.
    assert (first.isel(model=slice(5, None)).diff("omega") > 0.0).all()
    thickest = eleven["lambda_omega"].sel(model="exact, μ = 0.01").dropna("omega")
    assert thickest["omega"][-1].item() == pytest.approx(0.6 * 12.9971, abs=0.2)
    assert (thickest.diff("omega") <= 0.0).all()
    assert (eleven["lambda_omega"].max("omega") < ten["lambda_omega"].max()).all()
    # One color for each μ, in which the exact line is dashed.
    lines = figures.figure_11(eleven)[0].lines[:8]
    assert [line.get_color() for line in lines[:4]] == [line.get_color() for line in lines[4:]]
    assert [line.get_linestyle() for line in lines] == ["-"] * 4 + ["--"] * 4


def test_figure_12_converges_later_at_higher_speed(data_of):
    data = data_of(12)
    error = np.abs(data["omega_n"] - data["converged"])
    enough = [int(data["degree"][np.argmax((row < 1e-6).to_numpy())]) for row in error]
    assert enough == sorted(enough)
    ax = figures.figure_12(data)
    assert ax.get_yscale() == "log"
    np.testing.assert_allclose(ax.lines[3].get_ydata()[20], error[3, 20])
    # What no root gives is said, not left to be wondered at.
    assert np.isnan(data["omega_n"].sel(omega=8.0, degree=26))
    assert "Before N = 10, 20, 22 and 28 there is no point" in figures.caption(12, data)
    # At the paper's degree, 2.1e-4 rad/s off at 8 rad/s.
    assert error.sel(omega=8.0, degree=36).item() == pytest.approx(2.1e-4, abs=1e-5)


def test_figure_13_mode_straightens_with_speed(data_of):
    shape = data_of(13)["shape"]
    assert np.allclose(shape.isel(eta=-1), 1.0)
    assert (shape.sel(eta=0.5).diff("omega") > 0.0).all()
    words = figures.caption(13, data_of(13))
    assert "by up to 0.008, 0.027, 0.050 and 0.070, there at η/L = 0.46" in words


def test_a_figure_on_the_command_line(call, tmp_path):
    call("figure", "13", "--style", "grey", "--out", tmp_path)
    written = {path.suffix for path in tmp_path.iterdir()}
    assert written == {".nc", ".csv", ".json", ".pdf", ".svg", ".txt"}
    words = (tmp_path / "figure_13.txt").read_text()
    # What is drawn comes first, and of which beam.
    claim = figures.PAPER_FIGURES[13].claim
    assert words.index("Beam: L = 8 m") < words.index(claim)


@pytest.mark.parametrize("number", range(8, 14))
def test_every_figure_draws_on_given_axes_with_units(number, data_of):
    data = data_of(number)
    count = 2 if number in (9, 10, 11) else 1
    _, axes = plt.subplots(ncols=count)
    drawn = getattr(figures, f"figure_{number}")(data, ax=axes)
    for panel in np.atleast_1d(np.array(drawn, dtype=object)):
        assert panel.get_xlabel()
        assert panel.get_ylabel()
    assert plt.get_fignums() == [1]


def test_captions_name_every_figure_with_data():
    for number in figures.PAPER_FIGURES:
        assert callable(getattr(comparison, f"figure_{number}"))
        assert callable(getattr(figures, f"figure_{number}"))
    assert sorted(figures.PAPER_FIGURES) == [3, 4, 5, *range(8, 16)]


def test_figure_15_shows_where_each_orbit_ends():
    phase = np.linspace(0.0, 1.0, 201)
    names = ["finite element", "CI", "FrI", "exact"]
    turns = 2.0 * np.pi * np.outer([1.0, 1.01, 0.95, 1.0], phase)
    data = xr.Dataset(
        {
            "q_bar": (("model", "phase"), 0.3 * np.cos(turns)),
            "q_dot_bar": (("model", "phase"), -0.4 * np.sin(turns)),
        },
        {"model": names, "phase": phase},
        {"omega": 6.0, "amplitude": 0.3, "elements": 16},
    )
    ax, apart = figures.figure_15(data)
    (inset,) = ax.child_axes
    # CI's orbit has the same shape: it deviates by nothing but the chords of 200 points.
    off = {line.get_color(): line.get_ydata() for line in apart.lines}
    assert np.abs(off["#D55E00"]).max() < 0.02
    for panel in (ax, inset):
        ends = {
            (float(line.get_xdata()[0]), float(line.get_ydata()[0])): line.get_color()
            for line in panel.lines
            if len(line.get_xdata()) == 1
        }
        assert len(ends) == 3
        assert ends[(float(data["q_bar"][2, -1]), float(data["q_dot_bar"][2, -1]))] == "#E69F00"
    # Open ends are seen in the inset: it holds them.
    low, high = inset.get_ylim()
    assert low < float(data["q_dot_bar"][2, -1]) < high


@pytest.mark.slow
def test_all_figures_from_an_empty_cache(tmp_path, capsys):
    main(["figure", "all", "--out", str(tmp_path), "--cache", str(tmp_path / "cache")])
    for number in figures.PAPER_FIGURES:
        for ending in (".nc", ".png", ".pdf", ".txt"):
            assert (tmp_path / f"figure_{number}{ending}").stat().st_size > 0
