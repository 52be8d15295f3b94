"""Blades that fit measurements: exact data, closed forms, and what data do not tell."""

import numpy as np
import pytest

from analytic import (
    Beam,
    PointLoad,
    SpinUp,
    Theory,
    TipForce,
    linear_modes,
    spin_up_response,
    steady_state,
)
from analytic.sensitivity import (
    MeasuredFrequency,
    MeasuredMotion,
    MeasuredState,
    fit,
    parameters_of,
    sensitivity,
)
from tests.beams import irregular, unit_beam

STRIP = unit_beam(1e-3).with_section_out_of_plane(0.25, 0.2).with_twist(0.4)
SLENDER = Theory(extension=False)


def with_values(blade, **values):
    for name, value in values.items():
        blade = parameters_of(blade, Theory())[name].changed(value)
    return blade


def frequencies(blade, omega, count, deviation=1e-4, theory=Theory(), scale=1.0):  # noqa: B008
    modes = linear_modes(blade, omega, count, theory=theory)
    return [
        MeasuredFrequency(mode=name, omega=omega, value=scale * value, deviation=deviation * value)
        for name, value in zip(modes.names, modes.frequencies.tolist(), strict=True)
    ]


def pulled(blade, force, deviation=1e-5):
    load = PointLoad(force=force)
    found = sensitivity(steady_state(blade, 0.0, loads=[load]), [])
    return [
        MeasuredState(output=name, loads=[load], value=value, deviation=deviation)
        for name, value in zip(found.outputs[1:3], found.values[1:3].tolist(), strict=True)
    ]


def test_exact_data_give_the_blade_that_made_them():
    truth = {"EI2": 1.1, "EI3": 0.92, "GJ": 1.05, "m": 0.97}
    blade = with_values(STRIP, **truth)
    data = [*frequencies(blade, 0.0, 4), *frequencies(blade, 3.0, 4)]
    data += pulled(blade, (0.0, 0.02, 0.01))
    found = fit(STRIP, data, truth)
    np.testing.assert_allclose(found.values, list(truth.values()), rtol=2e-6)
    np.testing.assert_allclose(found.residuals, 0.0, atol=0.02)
    assert not found.unknown
    again = linear_modes(found.blade, 0.0, 4).frequencies
    np.testing.assert_allclose(again, linear_modes(blade, 0.0, 4).frequencies, rtol=1e-6)


def test_a_history_with_noise():
    """Of the lag after a spin-up and the root's moment; scatter and deviations are the noise's."""
    rng, beam = np.random.default_rng(4), Beam.reference()
    truth = with_values(beam, EI3=1.08, hub_radius=0.25)
    motion, times = SpinUp(omega=6.0, ramp_time=3.0), np.linspace(0.5, 5.0, 31)
    made = sensitivity(spin_up_response(truth, motion, times, tolerance=1e-6), [])
    data = [
        MeasuredMotion(
            output=name, time=time, spin_up=motion, deviation=noise,
            value=made.values[made.outputs.index(f"{name} at {time:.12g} s")] + noise * error,
        )
        for name, noise in (("tip y", 0.02), ("root moment z", 2.0))
        for time, error in zip(times.tolist(), rng.standard_normal(times.size), strict=True)
    ]  # fmt: skip
    found = fit(beam, data, ["EI3", "hub_radius"])
    assert found.labels[0] == "tip y at 0.5 s"
    assert not found.unknown
    assert 0.8 < found.misfit < 1.2
    off = np.abs(found.values - [1.08, 0.25])
    assert (off < 3.0 * found.deviations).all()
    assert (found.deviations < [2e-3, 0.01]).all()


@pytest.mark.parametrize(
    ("change", "error", "sentence"),
    [
        ({"deviation": None}, ValueError, "a motion goes through zero: give the deviation"),
        ({"output": "deflection y"}, ValueError, "output must be one of tip x"),
        ({"time": -1.0}, ValueError, "time must not be negative"),
        ({"time": True}, TypeError, "time must be a"),
        ({"value": np.ma.masked}, (TypeError, ValueError), "value"),
        ({"spin_up": 6.0}, TypeError, "spin_up must be a SpinUp"),
        ({"loads": 9.81}, TypeError, "loads must be several"),
        ({"loads": [TipForce(amplitude=1.0)]}, ValueError, "needs the frequency"),
        ({"start": "bent"}, ValueError, "start must be 'straight', 'steady'"),
    ],
)
def test_a_motion_that_is_none(change, error, sentence):
    given = {
        "output": "tip y", "time": 1.0, "value": 0.1, "deviation": 0.01,
        "spin_up": SpinUp(omega=6.0, ramp_time=3.0),
    }  # fmt: skip
    with pytest.raises(error, match=sentence):
        fit(Beam.reference(), [MeasuredMotion(**given | change)], ["EI3"])


def test_a_deflection_is_from_the_unloaded_blade():
    """The line of a bent blade, and its derivatives, are those of the tip less where it was."""
    blade = STRIP.with_precone(0.1).with_prebend(0.05)
    load = PointLoad(force=(0.0, 0.02, 0.01))
    names = ["EI2", "precone", "m"]
    state = sensitivity(steady_state(blade, 0.0, loads=[load]), names)
    deflection = MeasuredState(output="deflection z", value=0.1, loads=[load])
    (value,), (slopes,) = MeasuredState.computed([deflection], blade, Theory(), names)
    start = steady_state(blade, 0.0).tip[2]
    assert value == pytest.approx(state.values[2] - start, abs=1e-9)
    assert slopes[0] == pytest.approx(state.of("tip z", "EI2"), rel=1e-9)
    turned = (steady_state(blade.with_precone(0.1 + h), 0.0).tip[2] for h in (-1e-4, 1e-4))
    away = np.diff([*turned])[0] / 2e-4
    assert slopes[1] == pytest.approx(state.of("tip z", "precone") - away, abs=1e-6)


def test_a_station_is_found_in_a_table():
    table = irregular(3, 0.01, 5)
    value = parameters_of(table, Theory())["EI2[1]"].value
    blade = with_values(table, **{"EI2[1]": 1.2 * value})
    found = fit(table, frequencies(blade, 1.0, 3), ["EI2[1]"])
    assert found.values[0] == pytest.approx(1.2 * value, rel=1e-4)
    assert found.parameters[0].unit == "N m^2"


def test_the_covariance_is_that_of_the_square_root_law():
    """ω ∝ √EI: twice the deviation of ω; a prior adds its inverse square."""
    beam = Beam.reference()
    data = frequencies(beam, 0.0, 1, 0.01, SLENDER)
    alone = fit(beam, data, ["EI3"], theory=SLENDER)
    assert alone.deviations[0] == pytest.approx(0.02, rel=1e-5)
    both = fit(beam, data, ["EI3"], prior={"EI3": 0.02}, theory=SLENDER)
    assert both.deviations[0] == pytest.approx(0.02 / np.sqrt(2.0), rel=1e-5)
    # A frequency 2 % too high: EI by 4 %, and with a prior as wide as the data half of it.
    high = frequencies(beam, 0.0, 1, 0.01, SLENDER, scale=1.02)
    assert fit(beam, high, ["EI3"], theory=SLENDER).values[0] == pytest.approx(1.02**2, rel=1e-5)
    halved = fit(beam, high, ["EI3"], prior={"EI3": 0.02}, theory=SLENDER).values[0]
    assert halved == pytest.approx(1.0 + 0.02, abs=4e-4)


def test_what_frequencies_do_not_tell():
    beam = Beam.reference()
    blade = with_values(beam, EI3=1.1)
    data = [*frequencies(blade, 0.0, 2, 0.01), *frequencies(blade, 6.0, 2, 0.01)]
    found = fit(beam, data, ["EI3", "m"])
    (sentence,) = found.unknown
    known = "the data do not determine; they determine their ratio alone"
    assert sentence == f"EI3 +1 % with m +1 %: {known}"
    assert np.isinf(found.deviations).all()
    assert found.values[0] / found.values[1] == pytest.approx(1.1, rel=1e-3)
    assert np.abs(found.values - 1.0).max() < 0.1  # as near as the ratio allows
    told = fit(beam, data, ["EI3", "m"], prior={"m": 0.01})
    assert told.unknown == found.unknown  # of the data alone
    assert np.all(told.deviations < 0.03)


def test_a_misfit_tells_of_wrong_data_and_of_deviations_that_are_not_given():
    beam = Beam.reference()
    data = frequencies(beam, 0.0, 3, 0.001)
    off = [
        MeasuredFrequency(mode=one.mode, value=one.value * scale, deviation=one.deviation)
        for one, scale in zip(data, (0.98, 1.0, 1.02), strict=True)
    ]
    found = fit(beam, off, ["EI3"])
    assert found.misfit == pytest.approx(20.0, rel=0.02)
    bare = [MeasuredFrequency(mode=one.mode, value=one.value) for one in off]
    same = fit(beam, bare, ["EI3"])
    assert same.misfit == pytest.approx(0.02, rel=0.02)
    assert same.values[0] == pytest.approx(found.values[0], rel=2e-3)
    assert same.deviations[0] == pytest.approx(2.0 * 0.02 / np.sqrt(3.0), rel=0.02)


def test_a_bound_holds():
    beam = Beam.reference()
    data = frequencies(with_values(beam, EI3=1.3), 0.0, 1, 0.01)
    found = fit(beam, data, ["EI3"], bounds={"EI3": (0.9, 1.1)})
    assert found.values[0] == pytest.approx(1.1, rel=1e-6)


def test_bad_input():
    beam = Beam.reference()
    data = frequencies(beam, 0.0, 1)
    for measured, free, more, error, sentence in (
        ([], ["EI3"], {}, ValueError, "nothing is measured: give frequencies"),
        ([3.0], ["EI3"], {}, TypeError, "measured must be MeasuredFrequency or MeasuredState, g"),
        (data, "EI3", {}, TypeError, r"free must be names, as \['EI3'\]"),
        (data, [], {}, ValueError, "nothing is free: name numbers of the blade"),
        (data, ["EI4"], {}, ValueError, "the blade has no parameter 'EI4'; it has EA, EI3"),
        (data, ["EI3", "EI3"], {}, ValueError, "free has EI3 twice"),
        (data, ["EI3", "m"], {}, ValueError, "2 numbers are free, and 1 are measured or have a p"),
        (data, ["EI3"], {"prior": {"m": 0.1}}, ValueError, "prior has 'm', which is not free: EI3"),
        (data, ["EI3"], {"prior": {"EI3": -1}}, ValueError, "the prior of EI3 must be positive"),
        (data, ["EI3"], {"prior": 0.1}, TypeError, "prior must be by name"),
        (data, ["EI3"], {"bounds": {"EI3": (2, 3)}}, ValueError, "do not hold its value 1"),
        (data, ["EI3"], {"bounds": [1, 2]}, TypeError, "bounds must be by name, as"),
        (data, ["EI3"], {"bounds": {"EI3": 3}}, ValueError, "bounds of EI3 must be two numbers"),
        (data, ["EI3"], {"bounds": {"m": (0, 2)}}, ValueError, "bounds has 'm', which is not free"),
    ):
        with pytest.raises(error, match=sentence):
            fit(beam, measured, free, **more)
    table = irregular(3, 0.01, 4)
    with pytest.raises(ValueError, match=r"EI3 changes EI3\[1\], too: free one of them"):
        fit(table, [*data, *data], ["EI3", "EI3[1]"])
    with pytest.raises(ValueError, match="give a deviation to each of the measured or to none: m"):
        fit(beam, [*data, MeasuredFrequency(mode=1, value=3.0)], ["EI3"])
    with pytest.raises(ValueError, match="the lowest 24 modes at 0 rad/s have none of the name 'f"):
        fit(beam, [MeasuredFrequency(mode="flap 1", value=3.0)], ["EI3"])


@pytest.mark.parametrize(
    ("values", "sentence"),
    [
        ({"value": -1.0}, "value must be positive"), ({"value": True}, "value must be a"),
        ({"value": np.nan}, "value must be finite"), ({"omega": -1.0}, "omega must not be neg"),
        ({"deviation": 0.0}, "deviation must be positive"), ({"mode": 0}, "mode must be at least"),
        ({"mode": 2.5}, "mode must be a whole number"), ({"mode": 99}, "mode must be at most 24"),
    ],
)  # fmt: skip
def test_a_measured_frequency_passes_the_checks(values, sentence):
    with pytest.raises((ValueError, TypeError), match=sentence):
        MeasuredFrequency(**{"mode": "lag 1", "value": 3.0, **values})


def test_a_measured_state_passes_the_checks():
    with pytest.raises(ValueError, match=r"output must be one of deflection x, .*, got 'tip w'"):
        MeasuredState(output="tip w", value=0.1)
    with pytest.raises(TypeError, match="loads must be several"):
        MeasuredState(output="tip z", value=0.1, loads=PointLoad(force=(0, 0, 1)))
