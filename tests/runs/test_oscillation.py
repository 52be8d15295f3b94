"""The estimators of amplitude and frequency, on signals whose answer is known."""

import re

import numpy as np
import pytest
import xarray as xr
from hypothesis import example, given, settings
from hypothesis import strategies as st

from rotbeam_exu import steady_oscillation
from rotbeam_exu.runs.attributes import blade_attributes
from tests.beams import REED


def signal(frequency=3.7, second=0.0, duration=15.0, ramp_time=3.0, step=5e-3):
    time = np.arange(0.0, duration + 0.5 * step, step)
    phase = frequency * (time - 1.234)
    x = 0.3 * np.cos(phase) + 0.01 * np.sin(2 * phase) + 0.02 * np.cos(3 * phase + 0.3)
    q = 8.0 * (x + second * np.cos(23.01 * time + 0.5))
    return xr.Dataset(
        {"q": ("time", q)},
        coords={"time": time},
        attrs={"ramp_time": ramp_time, "blade_length": 8.0},
    )


def test_a_pure_periodic_signal_is_found_exactly():
    """The amplitude is half peak to peak, not the first harmonic."""
    found = steady_oscillation(signal())
    assert found.frequency == pytest.approx(3.7, rel=1e-7)
    assert found.frequency_error < 1e-6
    assert found.harmonics == pytest.approx([0.3, 0.01, 0.02, *np.zeros(6)], abs=1e-8)
    assert found.first_harmonic == found.harmonics[0]
    assert found.offset == pytest.approx(0.0, abs=1e-8)
    assert found.residual < 1e-7
    assert found.cycles == 7
    phase = np.linspace(0.0, 2 * np.pi, 100001)
    exact = np.ptp(0.3 * np.cos(phase) + 0.01 * np.sin(2 * phase) + 0.02 * np.cos(3 * phase + 0.3))
    assert found.amplitude == pytest.approx(0.5 * exact, abs=1e-6)


@pytest.mark.parametrize(("frequency", "second"), [(3.03, 1e-4), (3.73, 1e-3), (4.12, 5e-3)])
def test_a_second_mode_is_told_apart(frequency, second):
    """Second modes as the paper's runs have them, or larger, at the paper's frequencies."""
    found = steady_oscillation(signal(frequency=frequency, second=second))
    assert found.residual == pytest.approx(second / np.sqrt(2.0), rel=0.1)
    assert abs(found.frequency - frequency) <= found.frequency_error
    # A tone of its own takes all of it: the former fit heard 1e-6 of the frequency.
    assert found.frequency_error < 1e-11 * frequency


@pytest.mark.parametrize("lost", [1e-5, 1e-3, 2e-2])
def test_what_an_integrator_damps_is_measured_in_the_middle_of_the_window(lost):
    """A slow swing of a hardening oscillator: x'' + 2δx' + ω²x (1 + κx²) = 0 by averaging.

    Its amplitude is A exp(-δs), its frequency ω(1 + ⅜κA²exp(-2δs)), harmonics go with the third
    power; the second mode dies within the window. Before, tones beside the harmonics took the
    decay, and the bar of the amplitude was up to eight times the amplitude.
    """
    frequency, shift, period = 3.7, 2e-3, 2.0 * np.pi / 3.7
    run = signal()
    time = run["time"].to_numpy()
    s = time - 9.0  # of the window from 3 to 15 s
    delta = lost / period
    slow = -np.expm1(-2.0 * delta * s) / (2.0 * delta)
    phase, a = frequency * (s + shift * (slow - s)) + 0.4, np.exp(-delta * s)
    x = 0.3 * a * np.cos(phase) + 0.004 * a**3 * np.cos(3.0 * phase)
    x += 5e-3 * np.exp(-0.5 * (time - 3.0)) * np.cos(23.01 * time)
    run["q"] = "time", 8.0 * x
    found = steady_oscillation(run)
    assert abs(found.amplitude - 0.304) <= found.amplitude_error < 1e-4
    assert abs(found.frequency - frequency) <= found.frequency_error < 1e-4
    assert found.decay == pytest.approx(lost, rel=1e-2, abs=2e-6)


def beside(rng, ratio, extra):
    """One signal with a mode at `ratio` times the frequency, and what `extra` adds; and truths.

    Windows of 2.2 to 8 cycles, other modes of 1e-4 to 1e-2 for an amplitude of 0.3.
    """
    frequency = rng.uniform(2.9, 4.2)
    time = np.arange(0.0, rng.uniform(2.2, 8.0) * 2.0 * np.pi / frequency, 1e-2)
    size = 10.0 ** rng.uniform(-4.0, -2.0)
    turn = rng.uniform(0.0, 2.0 * np.pi, 14)

    def periodic(phase):
        return (
            0.3 * np.cos(phase) + 0.01 * np.sin(2 * phase) + 0.02 * np.cos(3 * phase + 0.3)
            + 0.003 * np.cos(5 * phase + 1.0)
        )  # fmt: skip

    other = size * np.cos(ratio * frequency * time + turn[0])
    if extra == "decay":
        other *= np.exp(-rng.uniform(0.01, 0.3) * time)
    if extra == "noise":
        other += 1e-5 * rng.normal(size=time.size)
    if extra == "a dozen modes":
        for phase in turn[:12]:
            other += 0.1 * size * np.cos(rng.uniform(0.2, 12.0) * frequency * time + phase)
    run = xr.Dataset(
        {"q": ("time", periodic(frequency * time) + other)},
        {"time": time},
        {"ramp_time": 0.0, "blade_length": 1.0},
    )
    return run, frequency, 0.5 * np.ptp(periodic(np.linspace(0.0, 2.0 * np.pi, 200001)))


def coverage(ratio, extra, count):
    """Shares of frequency and amplitude bars that hold, and median width over error."""
    rng = np.random.default_rng(7)
    held, width = [], []
    for _ in range(count):
        run, frequency, amplitude = beside(rng, ratio, extra)
        found = steady_oscillation(run)
        error = abs(found.frequency - frequency)
        held.append(
            (
                error <= found.frequency_error,
                abs(found.amplitude - amplitude) <= found.amplitude_error + 1e-9,
            )
        )
        width.append(found.frequency_error / max(error, 1e-16))
    return *np.mean(held, axis=0), np.median(width)


RATIOS = (5.05, 4.06, 3.30, 1.2, 6.17)
EXTRAS = ("nothing", "noise", "decay", "a dozen modes")


@pytest.mark.parametrize("ratio", [5.05, 1.2])
def test_bars_hold_beside_another_mode(ratio):
    frequency, amplitude, _ = coverage(ratio, "noise", 10)
    assert min(frequency, amplitude) >= 0.9


@pytest.mark.slow
@pytest.mark.parametrize("ratio", RATIOS)
@pytest.mark.parametrize("extra", EXTRAS)
def test_bars_hold_over_many_signals(ratio, extra):
    frequency, amplitude, width = coverage(ratio, extra, 200)
    # 19 of 20 where the model can describe the signal; 9 of 10 where it cannot.
    assert min(frequency, amplitude) >= (0.95 if extra in ("nothing", "noise") else 0.9)
    if extra == "noise":
        assert width < 15.0


def scaled(run, time=1.0, length=1.0):
    return xr.Dataset(
        {"q": ("time", length * run["q"].to_numpy())},
        {"time": time * run["time"].to_numpy()},
        {"ramp_time": time * run.attrs["ramp_time"], "blade_length": length * 8.0},
    )


@settings(max_examples=10, deadline=None)
@given(time=st.floats(-9.0, 9.0), length=st.floats(-6.0, 6.0), frequency=st.floats(2.9, 4.2))
@example(time=1.0, length=1.0, frequency=3.287109375)
def test_units_do_not_matter(time, length, frequency):
    """To round-off times the condition of the fit: where tones nearly coincide 2e-9 is seen."""
    run = signal(frequency=frequency, second=1e-3)
    here = steady_oscillation(run)
    there = steady_oscillation(scaled(run, 10.0**time, 10.0**length))
    assert there.frequency * 10.0**time == pytest.approx(here.frequency, rel=1e-9)
    for name in ("amplitude", "first_harmonic", "residual"):
        off = getattr(there, name) - getattr(here, name)
        assert abs(off) < 1e-8 * here.amplitude
    assert there.cycles == here.cycles


def test_twenty_samples_a_period_are_enough_and_fewer_are_refused():
    period = 2.0 * np.pi / 3.7
    found = steady_oscillation(signal(step=period / 20.0, second=1e-3))
    assert found.frequency == pytest.approx(3.7, rel=1e-9)
    assert found.amplitude == pytest.approx(steady_oscillation(signal()).amplitude, rel=1e-9)
    with pytest.raises(ValueError, match=r"18 a period of the 3.7 .* in disguise") as refusal:
        steady_oscillation(signal(step=period / 18.0))
    every = float(re.search(r"sample every (\S+) s", str(refusal.value)).group(1))
    assert steady_oscillation(signal(step=every)).frequency == pytest.approx(3.7, rel=1e-9)


def test_uneven_times_are_measured_as_they_are():
    rng = np.random.default_rng(1)
    even = signal(step=1e-3, second=1e-3)
    keep = np.sort(rng.choice(even.sizes["time"], 3000, replace=False))
    found = steady_oscillation(even.isel(time=keep))
    assert found.frequency == pytest.approx(3.7, rel=1e-9)
    assert found.amplitude == pytest.approx(steady_oscillation(even).amplitude, rel=1e-9)


ATTRS = {**blade_attributes(REED), "omega": 1000.0, "ramp_time": 0.006}


def reed(step):
    time = np.arange(0.0, 0.2 + 0.5 * step, step)
    return xr.Dataset({"q": ("time", 0.005 * np.cos(1133.343 * time))}, {"time": time}, ATTRS)


def test_an_alias_is_refused():
    """A reed at 1133 rad/s, sampled each 5 ms, looked like 123.29 rad/s and passed."""
    # The last is so near to a whole number of periods that it seems slow: only ω_n tells.
    for step in (5e-3, 2.0 * np.pi / 1133.343 * 1.02):
        with pytest.raises(ValueError, match=r"the beam's slowest .* in disguise") as refusal:
            steady_oscillation(reed(step))
        every = float(re.search(r"sample every (\S+) s", str(refusal.value)).group(1))
        assert steady_oscillation(reed(every)).frequency == pytest.approx(1133.343, rel=1e-9)
    # Without the beam, the samples a period of what is found.
    anonymous = reed(5e-3)
    del anonymous.attrs["omega"]
    with pytest.raises(ValueError, match=r"rad/s found: .* in disguise"):
        steady_oscillation(anonymous)


def test_a_run_that_is_too_short_for_a_swing_is_told_how_long():
    run = reed(2e-5)
    with pytest.raises(ValueError, match=r"run for (\S+) s or longer") as refusal:
        steady_oscillation(run.isel(time=slice(0, 460)))
    enough = float(re.search(r"run for (\S+) s", str(refusal.value)).group(1))
    steady_oscillation(run.sel(time=slice(0.0, enough)))


def swings(of):
    """The reed's run with another q."""
    run = reed(2e-5)
    return run.assign(q=("time", of(run["time"].to_numpy())))


def without(name):
    run = signal()
    del run.attrs[name]
    return run


@pytest.mark.parametrize(
    ("run", "sentence"),
    [
        (swings(lambda t: 0.005 * np.cos(0.4 * 1133.0 * t)), "its mesh or the step are wrong"),
        (swings(lambda t: 0.005 * np.cos(2.2 * 1133.0 * t)), "its mesh or the step are wrong"),
        (swings(lambda t: t), "no longer run will mend"),
        (swings(lambda t: 0.0 * t), "take an omega other than zero"),
        (signal()["q"].to_numpy(), "takes a Dataset, got ndarray"),
        (without("ramp_time"), "no attribute ramp_time"),
        (without("blade_length"), "no attribute blade_length"),
        (signal().drop_vars("q"), "the run has no q"),
        (signal().drop_vars("time"), "the run has no time"),
        (signal().expand_dims(case=2), "dimensions case, time"),
        (signal().assign_attrs(blade_length=0.0), "blade_length must be positive"),
        (signal().assign_attrs(ramp_time=15.0), "samples after the ramp"),
        (signal(duration=3.2), "does not oscillate"),
    ],
)
def test_what_cannot_be_measured_is_refused(run, sentence):
    with pytest.raises((ValueError, TypeError), match=sentence):
        steady_oscillation(run)


def test_bad_samples_are_refused_and_the_remedy_works():
    run = signal()
    gap = run.copy(deep=True)
    gap["q"][1500] = np.nan
    with pytest.raises(ValueError, match=r"q is not finite in 1 of 3001 samples"):
        steady_oscillation(gap)
    left = gap.isel(time=np.isfinite(gap["q"]).values)
    assert steady_oscillation(left).frequency == pytest.approx(3.7, rel=1e-9)
    for wrong in (run.isel(time=slice(None, None, -1)), xr.concat([run, run], dim="time")):
        with pytest.raises(ValueError, match="time must increase"):
            steady_oscillation(wrong)
        mended = wrong.sortby("time").drop_duplicates("time")
        assert steady_oscillation(mended).frequency == pytest.approx(3.7, rel=1e-9)


def test_a_short_window_is_refused_with_the_length_that_would_do():
    with pytest.raises(ValueError, match=r"holds 1 whole cycles .* run for (\S+) s") as refusal:
        steady_oscillation(signal(duration=6.0))
    enough = float(str(refusal.value).split("run for ")[1].split()[0])
    assert steady_oscillation(signal(duration=enough)).cycles >= 2
