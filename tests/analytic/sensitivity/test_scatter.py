"""Scatter of frequencies: to the first order, and of samples."""

import numpy as np
import pytest

from analytic import (
    Beam,
    Damping,
    Gravity,
    PointLoad,
    RotbeamWarning,
    SpinUp,
    Theory,
    TipForce,
    campbell,
    forced_response,
    linear_modes,
    periodic_orbits,
    reduced_model,
    spin_up_response,
    steady_state,
)
from analytic.sensitivity import campbell_spread, parameters_of, sampled, sensitivity, spread
from tests.beams import irregular, unit_beam

TABLE = irregular(3, 0.01, 4)
STRIP = unit_beam(1e-3).with_section_out_of_plane(0.25, 0.2).with_twist(0.4)
WHOLE = ["EI3", "EI2", "m", "setting_angle"]


@pytest.fixture(scope="module")
def modes():
    return linear_modes(TABLE, 2.0, 2)


def test_of_a_slender_beam_at_rest():
    """ω ∝ √(EI/m): half of both deviations, of which variances add up."""
    modes = linear_modes(Beam.reference(), 0.0, 2, theory=Theory(extension=False))
    found = spread(sensitivity(modes), {"EI3": 0.06, "m": 0.08})
    np.testing.assert_allclose(found.relative, 0.05, rtol=1e-6)
    np.testing.assert_allclose(found.shares, [[0.36, 0.64]] * 2, rtol=1e-6)


def test_stations_that_are_off_together_or_each_by_itself(modes):
    """Far-reaching correlation is the whole blade's; short ones leave the root of squares."""
    found = sensitivity(modes)
    scatter = {"EI2": 0.05, "center2": 0.004}
    together = spread(found, scatter)
    np.testing.assert_allclose(spread(found, scatter, 1e9).deviations, together.deviations)
    alone = spread(found, scatter, 1e-9)
    for k, name in enumerate(scatter):
        several = [i for i, one in enumerate(found.parameters) if one.family == name]
        sizes = [found.parameters[i].value if name == "EI2" else 1.0 for i in several]
        parts = found.derivatives[:, several] * sizes * scatter[name]
        variances = alone.shares[:, k] * alone.deviations**2
        np.testing.assert_allclose(variances, np.sum(parts**2, axis=1), rtol=1e-9)


@pytest.mark.parametrize(("name", "length"), [("strip", np.inf), ("table", 0.3)])
def test_samples_have_the_scatter_of_the_first_order(name, length, modes):
    """60 of them leave 9 % of a deviation; the second order shifts the mean by its square."""
    if name == "strip":
        modes = linear_modes(STRIP, 2.0, 2)
    scatter = {"EI2": 0.04, "setting_angle": 0.05, "m": 0.03}
    first = spread(sensitivity(modes), scatter, length)
    several = sampled(modes, scatter, length, count=60, seed=3)
    deviations = several.std(axis=0, ddof=1)
    np.testing.assert_allclose(deviations, first.deviations, rtol=0.3)
    np.testing.assert_allclose(several.mean(axis=0), modes.frequencies, rtol=5e-3)


def test_a_sample_is_a_blade_of_its_own(modes, monkeypatch):
    """By the strains of the first blade, to the square of an angle, and else to 1e-5."""
    monkeypatch.setattr("scipy.stats.norm.ppf", lambda x: 2.0 + 0.0 * x)
    known = parameters_of(TABLE, Theory())
    for name, deviation in (("EI2", 0.05), ("tension3", 0.01), ("setting_angle", 0.02)):
        (found,) = sampled(modes, {name: deviation}, count=1)
        other = known[name].changed(known[name].value + 2.0 * deviation)
        anew = linear_modes(other, 2.0, 2, tolerance=1e-8)
        assert anew.names == modes.names
        np.testing.assert_allclose(found, anew.frequencies, rtol=3e-5)


BEAM = Beam.reference()
SPUN = SpinUp(omega=6.0, ramp_time=3.0)
STIRRED = BEAM.with_damping(Damping(external=0.1))
ANSWERS = {
    "a steady state": lambda: (
        steady_state(STRIP, 1.0, loads=[PointLoad(force=(0.0, 0.0, 0.01))]),
        {"EI2": 0.02, "loads[0]": 0.02},
    ),
    "orbits": lambda: (periodic_orbits(BEAM, 6.0, [0.1]), {"EI3": 0.02, "omega": 0.05}),
    "a response": lambda: (
        forced_response(STIRRED, 6.0, TipForce(amplitude=0.3), [3.4, 3.5]),
        {"EI3": 0.01, "loads[0]": 0.02},
    ),
    "under gravity": lambda: (
        forced_response(STIRRED, [5.0, 5.1], Gravity(1.0)), {"EI3": 0.01, "loads[0]": 0.02},
    ),
    "a spin-up": lambda: (
        spin_up_response(BEAM, SPUN, [2.0], tolerance=1e-4), {"EI3": 0.01, "ramp_time": 0.03},
    ),
    "a model": lambda: (reduced_model(BEAM, 6.0, "FrM"), {"EI3": 0.02, "omega": 0.05}),
}  # fmt: skip


@pytest.mark.parametrize("name", ANSWERS)
def test_a_sample_of_every_answer_is_solved_anew(name, monkeypatch):
    """Two, half a deviation to both sides: what is not linear cancels but for the third power."""
    monkeypatch.setattr("scipy.stats.norm.ppf", lambda x: np.array([[0.5], [-0.5]]))
    answer, scatter = ANSWERS[name]()
    found = sensitivity(answer, [*scatter])
    for one, deviation in scatter.items():
        ahead, behind = sampled(answer, {one: deviation}, count=2)
        slopes = deviation * found.derivatives[:, found.names.index(one)]
        size = np.abs(found.values) + np.abs(slopes)
        size[size == 0.0] = 1.0
        assert np.abs(slopes).max() > 0.0
        np.testing.assert_allclose((ahead - behind) / size, slopes / size, atol=1e-3)


def test_a_sample_without_an_answer_is_on_record(monkeypatch):
    """A ramp cannot take less than no time; the other sample is there all the same."""
    monkeypatch.setattr("scipy.stats.norm.ppf", lambda x: np.array([[0.1], [-3.0]]))
    answer = spin_up_response(BEAM, SPUN, [2.0], tolerance=1e-4)
    with pytest.warns(RotbeamWarning, match="1 of 2 samples are without .* ramp_time must be"):
        found = sampled(answer, {"ramp_time": 1.5}, count=2)
    assert np.isfinite(found[0]).sum() > 10
    assert np.isnan(found[1]).all()


def test_of_what_is_no_sensitivity():
    with pytest.raises(TypeError, match=r"found must be what sensitivity returns, got 3\.0"):
        spread(3.0, {"EI3": 0.1})
    with pytest.raises(TypeError, match=r"answer must be what linear_modes, .* returns, got 3\.0"):
        sampled(3.0, {"EI3": 0.1})
    with pytest.raises(ValueError, match="scatter has no parameter 'EI2'; there are EA, EI3, m"):
        sampled(linear_modes(Beam.reference(), 0.0, 1), {"EI2": 0.1})


@pytest.mark.parametrize(
    ("scatter", "length", "sentence"),
    [
        ({}, np.inf, r"scatter must be deviations by name, as \{'EI3': 0.05\}"),
        ([0.05], np.inf, "scatter must be deviations by name"),
        ({"EI3": -0.1}, np.inf, "the scatter of EI3 must not be negative"),
        ({"EI3": True}, np.inf, "the scatter of EI3 must be a number"),
        ({"EI3[1]": 0.1}, np.inf, r"scatter has no parameter 'EI3\[1\]'; there are EA, GJ"),
        ({"E": 0.1}, np.inf, "scatter has no parameter 'E'; there are"),
        ({"EI3": 0.1}, -1.0, "length must be positive"),
        ({"EI3": 0.1}, np.nan, "length must be finite"),
        ({"hub_radius": 0.1}, 1.0, "hub_radius has none"),
    ],
)
def test_what_is_no_scatter_is_refused(scatter, length, sentence, modes):
    for verb in (lambda: spread(sensitivity(modes), scatter, length),
                 lambda: sampled(modes, scatter, length, count=1)):  # fmt: skip
        with pytest.raises((ValueError, TypeError), match=sentence):
            verb()


def test_the_scatter_of_a_diagram_is_that_of_its_modes(modes):
    diagram = campbell(TABLE, [0.0, 2.0, 3.0], 2)
    scatter = {"EI2": 0.05, "EI3": 0.02, "setting_angle": 0.01}
    for length in (np.inf, 0.3):
        found = campbell_spread(diagram, scatter, length)
        assert found.shape == diagram.frequencies.shape
        expected = spread(sensitivity(modes), scatter, length)
        np.testing.assert_allclose(found[1], expected.deviations, rtol=1e-5)
    with pytest.raises(TypeError, match=r"diagram must be what campbell returns, got 3\.0"):
        campbell_spread(3.0, scatter)
    with pytest.raises(ValueError, match="scatter has no parameter 'EI4'"):
        campbell_spread(diagram, {"EI4": 0.1})


def test_curves_that_cross_keep_their_own_scatter():
    """Lag depends on EI3, flap on EI2, before and after they have met."""
    strip = Beam.reference().with_section_out_of_plane(0.95, 0.9)
    diagram = campbell(strip, [0.0, 6.0], 2)
    lag, flap = (diagram.names.index(name) for name in ("lag 1", "flap 1"))
    order = np.argsort(diagram.frequencies, axis=1)
    assert order[0].tolist() != order[1].tolist()
    by_lag, by_flap = (campbell_spread(diagram, {name: 0.1}) for name in ("EI3", "EI2"))
    assert np.all(by_lag[:, lag] > 0.05)
    assert np.all(by_lag[:, flap] < 1e-3)
    assert np.all(by_flap[:, flap] > 0.03)
    assert np.all(by_flap[:, lag] < 1e-3)


def test_pictures_have_the_largest_on_top(modes):
    found = sensitivity(modes, ["EI2", "m", "precone", "EI2[1]"])
    names = [tick.get_text() for tick in found.plot("lag 1").get_yticklabels()]
    row = found.outputs.index("lag 1")
    largest = np.abs(found.derivatives[row] * [one.step for one in found.parameters])
    order = [f"{found.parameters[k].name} {found.parameters[k].change}" for k in largest.argsort()]
    assert names == order
    shares = spread(found, {"EI2": 0.01, "m": 0.05})
    axes = shares.plot("lag 1")
    bars = axes.patches
    assert axes.get_xlabel() == "± of lag 1 [rad/s]"
    widths = np.array([bar.get_width() for bar in bars])
    assert np.sqrt(np.sum(widths**2)) == pytest.approx(shares.deviations[row])
    with pytest.raises(ValueError, match="there is no 'lag 9': known are flap 1, lag 1"):
        found.plot("lag 9")
