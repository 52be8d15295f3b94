"""The steady oscillation of a run: amplitude and frequency, and how well they are known."""

from __future__ import annotations

import math
import warnings
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from analytic import Blade
from analytic.arrays import FloatArray
from analytic.exact.linear.modes import driven_modes
from analytic.input_checks import RotbeamWarning, not_negative, positive

from ..lazily import xr
from .attributes import beam_of
from .tones import fit_signal

SAMPLES = 20
"""Samples a period at least, two for each of ten harmonics; `simulate` keeps more."""


OSCILLATION: dict[str, str] = {
    "amplitude": "amplitude a = q/L, half peak to peak",
    "amplitude_error": "error bar of a, estimator",
    "first_harmonic": "first harmonic over L",
    "frequency": "nonlinear frequency ω_NL [rad/s]",
    "frequency_error": "error bar of ω_NL, estimator [rad/s]",
    "offset": "mean of q over L",
    "residual": "second bending mode, rms over L",
}
"""Numbers of a steady oscillation, with their labels."""


class NoOscillationError(ValueError):
    """A run whose oscillation cannot be measured; the sentence says why, and what would do."""


@dataclass(frozen=True, kw_only=True)
class SteadyOscillation:
    """Periodic part of the tip displacement after the spin-up.

    q(t)/L ≈ offset + Σ_k [c_k cos(k ω_NL t) + s_k sin(k ω_NL t)], t from the window's start.

    Attributes
    ----------
    amplitude : float
        Half peak to peak of the periodic part of q over L [-].
    amplitude_error : float
        Error of `amplitude`, the estimator's alone: neither mesh nor step are in it [-].
    first_harmonic : float
        Amplitude of the first harmonic over L [-]; up to 7 % apart from `amplitude`.
    frequency : float
        Nonlinear frequency ω_NL [rad/s].
    frequency_error : float
        Error of `frequency`, the estimator's alone: neither mesh nor step are in it [rad/s].
    offset : float
        Mean of the periodic part of q over L [-]; zero by symmetry.
    residual : float
        Root mean square of q less its periodic part, over L [-]: the other bending modes.
    decay : float
        Share of the amplitude that is lost per cycle; zero where none is seen [-].
    cycles : int
        Whole cycles in the window.
    harmonics : ndarray of shape (HARMONICS,)
        Amplitudes of the harmonics over L [-], the first one first.
    """

    amplitude: float
    amplitude_error: float
    first_harmonic: float
    frequency: float
    frequency_error: float
    offset: float
    residual: float
    decay: float
    cycles: int
    harmonics: FloatArray


def steady_oscillation(run: xr.Dataset) -> SteadyOscillation:
    """Measure the oscillation of q from the end of the ramp to the end of the run.

    A Fourier series and, for the other modes, free tones are fitted to q, frequencies included, by
    least squares weighted with Hann's window (`rotbeam_exu.runs.tones`). Where integrator or blade
    damp it, amplitude and frequency are those in the middle of the window. The errors bound the
    effect of the fit's remainder at its most harmful phases. Time may be in any unit, evenly
    sampled or not.

    Parameters
    ----------
    run : Dataset
        As made by `simulate`, or any with `q` over `time` and the attributes ramp_time and
        blade_length. If it holds the rest of the beam and `omega` as `simulate` writes them, the
        frequency must be near the beam's natural frequency.

    Raises
    ------
    TypeError
        If `run` is not a Dataset.
    NoOscillationError
        A ValueError, if something is missing, not finite or out of order, or if the tip does not
        oscillate. Also if the window holds fewer than two cycles or 20 samples a cycle, or if the
        frequency is not within half and twice ω_n. The sentence says what would do.

    Examples
    --------
    >>> from analytic import Beam, SpinUp
    >>> from rotbeam_exu import simulate, steady_oscillation
    >>> motion = SpinUp(omega=2.0, ramp_time=3.0)
    >>> run = simulate(Beam.reference(), motion, elements=4, duration=8.0, step=4e-3)
    >>> steady = steady_oscillation(run)
    >>> print(f"{steady.amplitude:.4f} L at {steady.frequency:.4f} rad/s")
    0.1654 L at 3.0361 rad/s
    """
    _check_form(run)
    time, q = (run[name].to_numpy().astype(np.float64) for name in ("time", "q"))
    length = positive("the attribute blade_length", run.attrs["blade_length"])
    ramp_time = not_negative("the attribute ramp_time", run.attrs["ramp_time"])
    return oscillation_of(time, q / length, ramp_time, _natural_frequency(run))


def oscillation_of(
    time: FloatArray, x: FloatArray, ramp_time: float, omega_n: float | None
) -> SteadyOscillation:
    """Return `steady_oscillation` of q/L over time, of a beam whose ω_n [rad/s] may be known."""
    time, x = _steady_part(time, x, ramp_time)
    if omega_n is not None:
        # The nonlinear frequency may be lower, by a few percent.
        _check_samples(time, 0.9 * omega_n, "of the beam's slowest oscillation")
    guess = _frequency_guess(time, x, ramp_time, omega_n)
    _check_samples(time, guess, "found")
    # More than some fifty samples a period of so smooth a signal cost time and add nothing.
    every = max(1, int(_samples(time, guess) // 50))
    time, x, window = time[::every], x[::every], float(time[::every][-1])
    height = float(np.ptp(x))
    fit = fit_signal(time / window, x / height, guess * window)
    frequency, amplitude = fit.frequency(), fit.half_peak_to_peak()
    _check_frequency(frequency.value / window, omega_n)
    harmonics = height * np.hypot(fit.cosines, fit.sines)
    return SteadyOscillation(
        amplitude=height * amplitude.value,
        amplitude_error=height * amplitude.error,
        first_harmonic=float(harmonics[0]),
        frequency=frequency.value / window,
        frequency_error=frequency.error / window,
        offset=height * float(fit.coefficients[0]),
        residual=height * float(np.sqrt(np.mean((fit.x - fit.periodic()) ** 2))),
        decay=2.0 * math.pi * fit.decay / frequency.value,
        cycles=_whole_cycles(window, frequency.value / window, ramp_time),
        harmonics=harmonics,
    )


def _steady_part(
    time: FloatArray, x: FloatArray, ramp_time: float
) -> tuple[FloatArray, FloatArray]:
    """Return the steady part: time from the end of the ramp, and q/L."""
    for name, values in (("time", time), ("q", x)):
        bad = np.flatnonzero(~np.isfinite(values))
        if bad.size:
            raise NoOscillationError(
                f"{name} is not finite in {bad.size} of {values.size} samples, first in number "
                f"{bad[0]}: leave them out, as run.isel(time=np.isfinite(run[{name!r}]).values)"
            )
    back = np.flatnonzero(np.diff(time) <= 0.0)
    if back.size:
        k = int(back[0])
        raise NoOscillationError(
            f"time must increase, but sample {k + 1} is at {time[k + 1]:g} after {time[k]:g}: "
            "take run.sortby('time').drop_duplicates('time')"
        )
    # Half a spacing would do; round-off in the times must not move the window by a sample.
    slack = 1e-6 * float(np.diff(time).min()) if time.size > 1 else 0.0
    steady = time >= ramp_time - slack
    if steady.sum() < SAMPLES:
        last = f", the last at {time[-1]:g} s" if time.size else ""
        raise NoOscillationError(
            f"q has {steady.sum()} samples after the ramp, which ends at {ramp_time:g} s{last}; "
            f"{2 * SAMPLES} at least are needed: run for longer, or sample more often"
        )
    return time[steady] - time[steady][0], x[steady]


def _check_form(run: xr.Dataset) -> None:
    """Refuse all but a Dataset with q over time, in one sentence that names the missing part."""
    if not isinstance(run, xr.Dataset):
        raise TypeError(
            f"steady_oscillation takes a Dataset, got {type(run).__name__}: "
            "make one by xarray.Dataset({'q': ('time', q)}, {'time': time}, "
            "{'ramp_time': ..., 'blade_length': ...})"
        )
    missing = [name for name in ("time", "q") if name not in run.variables]
    missing += [
        f"attribute {name}" for name in ("ramp_time", "blade_length") if name not in run.attrs
    ]
    if missing:
        raise NoOscillationError(
            f"the run has no {' and no '.join(missing)}: give q over time, and "
            "run.attrs ramp_time (0 if there is none) and blade_length"
        )
    if run["q"].dims != ("time",) or run["time"].dims != ("time",):
        dims = ", ".join(map(str, run["q"].dims))
        raise NoOscillationError(
            f"q must run over time alone, it has the dimensions {dims}"
            ": choose one run by run.isel or run.sel"
        )


def _natural_frequency(run: xr.Dataset) -> float | None:
    """Return ω_n of the exact beam of a run; None if the run does not say which beam it is.

    Nor in space, where q may show any mode.
    """
    if "w" in run:
        return None
    try:
        blade, omega = beam_of(run.attrs), float(run.attrs["omega"])
    except KeyError:
        return None
    return _exact_frequency(blade, abs(omega))


@lru_cache(maxsize=64)
def _exact_frequency(blade: Blade, omega: float) -> float | None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RotbeamWarning)  # said when the run was made
        try:
            return float(driven_modes(blade, omega).frequencies[0])
        except ValueError:
            return None  # so fast that theory has no answer to compare with


def _frequency_guess(
    time: FloatArray, x: FloatArray, ramp_time: float, omega_n: float | None
) -> float:
    """Return the frequency from the crossings between samples well above and below the middle.

    Of q/L over the time from the ramp's end on; `omega_n` is for the sentence if there are none.
    """
    height = float(np.ptp(x))
    if height <= 1e-12:
        raise NoOscillationError(
            f"the tip does not oscillate: after the ramp q stays within {height:.1g} of the "
            "length: take an omega other than zero, or a shorter ramp"
        )
    centered = x - 0.5 * (x.max() + x.min())
    # What is within a tenth of the height from the middle, noise or another mode, decides nothing.
    clear = np.flatnonzero(np.abs(centered) > 0.1 * height)
    turns = np.flatnonzero(np.diff(np.sign(centered[clear])))
    if turns.size < 2:
        enough = 6.0 * math.pi / omega_n if omega_n else 4.0 * float(time[-1])
        raise NoOscillationError(
            f"the tip does not oscillate within the {time[-1]:.3g} s after the ramp: "
            + (
                f"run for {ramp_time + enough:.3g} s or longer"
                if time[-1] < enough
                else "q drifts, which no longer run will mend; see what the run's verdict says"
            )
        )
    before, after = clear[turns], clear[turns + 1]
    share = centered[before] / (centered[before] - centered[after])
    crossings = time[before] + share * (time[after] - time[before])
    return float(np.pi * (turns.size - 1) / (crossings[-1] - crossings[0]))


def _whole_cycles(window: float, frequency: float, ramp_time: float) -> int:
    """Return how many cycles there are, refusing fewer than two."""
    cycles = int(window * frequency / (2.0 * math.pi) + 1e-9)
    if cycles < 2:
        raise NoOscillationError(
            f"the steady window of {window:.3g} s holds {cycles} whole cycles of "
            f"{frequency:.4g} rad/s, two are needed: run for "
            f"{ramp_time + 5.0 * math.pi / frequency:.3g} s or longer"
        )
    return cycles


def _samples(time: FloatArray, frequency: float) -> float:
    """Return the samples a period where they are farthest apart."""
    return 2.0 * math.pi / (frequency * float(np.diff(time).max()))


def _check_samples(time: FloatArray, frequency: float, whose: str) -> None:
    """Refuse samples so far apart that the oscillation could be a faster one in disguise."""
    samples = _samples(time, frequency)
    if samples < 0.99 * SAMPLES:
        raise NoOscillationError(
            f"the samples are up to {np.diff(time).max():.3g} s apart, {samples:.3g} a period of "
            f"the {frequency:.4g} rad/s {whose}: what they show may be a faster oscillation in "
            f"disguise; {SAMPLES} a period are needed, sample every "
            f"{2.0 * math.pi / frequency / (1.2 * SAMPLES):.2g} s or less"
        )


def _check_frequency(frequency: float, omega_n: float | None) -> None:
    if omega_n is not None and not 0.5 <= frequency / omega_n <= 2.0:
        raise NoOscillationError(
            f"the frequency found, {frequency:.4g} rad/s, is {frequency / omega_n:.3g} times the "
            f"beam's natural frequency, {omega_n:.4g} rad/s: the element, its mesh or the step are "
            "wrong, or the run's attributes are of another beam"
        )
