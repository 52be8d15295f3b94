"""A sampled signal as a Fourier series and free tones, and how far its remainder could mislead.

x(t) ≈ c₀ + Σ_k [c_k cos(kωt) + s_k sin(kωt)] + Σ_j [c_j cos(ν_j t) + s_j sin(ν_j t)]. The series is
the periodic oscillation of fundamental ω; the tones belong to other modes, at any frequency. Of a
signal that an integrator damps, harmonics have the envelopes exp(-kδs), s from the middle of the
window, and the phases kωt + ½kχs²; tones decay, too. ω and the height are those in the middle.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from analytic.arrays import FloatArray
from analytic.lazily import ndimage

HARMONICS = 9
"""Harmonics of the series; the tenth is the highest that 20 samples a period could tell."""

_TONES = 8
"""Free tones at most: a second bending mode and its sidebands ν ± mω, seven of which count."""

_LOBE = 2
"""Half the width of the main lobe of Hann's window [turns over the window]."""

_ORDERS = np.arange(1.0, HARMONICS + 1.0)
_COSINES = slice(1, HARMONICS + 1)
_MIDDLE = 0.5  # of the window
_NONE: FloatArray = np.empty(0)
_LOOSE = 1e-4  # relative error of the height above which the signal may decay
_ROUND_OFF = 16.0 * float(np.finfo(np.float64).eps)


@dataclass(frozen=True, kw_only=True)
class Estimate:
    """A number and the largest change that the remainder could have brought about."""

    value: float
    error: float


@dataclass(frozen=True)
class Fit:
    """Least-squares fit of a series and tones to weighted samples, at its minimum."""

    time: FloatArray
    x: FloatArray
    weights: FloatArray
    rates: FloatArray  # ω and the ν_j [rad per unit of time]
    damping: FloatArray  # δ of each, and χ; empty of what does not decay
    coefficients: FloatArray  # c₀, the cosines of harmonics and tones, then their sines
    columns: FloatArray  # the model's functions (samples, coefficients)

    @property
    def cosines(self) -> FloatArray:
        """Cosine coefficients of the harmonics, shape (HARMONICS,)."""
        return self.coefficients[_COSINES]

    @property
    def sines(self) -> FloatArray:
        """Sine coefficients of the harmonics, shape (HARMONICS,)."""
        return self.coefficients[self._sines]

    @property
    def _sines(self) -> slice:
        start = HARMONICS + self.rates.size
        return slice(start, start + HARMONICS)

    def periodic(self) -> FloatArray:
        """Return the series without the tones, over time."""
        first = np.r_[0, _COSINES, self._sines]
        return np.asarray(self.columns[:, first] @ self.coefficients[first])

    @cached_property
    def remainder(self) -> FloatArray:
        """Signal that neither series nor tones explain, over time."""
        return np.asarray(self.x - self.columns @ self.coefficients)

    @property
    def misfit(self) -> float:
        """Weighted sum of the remainder's squares."""
        return float(self.weights @ self.remainder**2)

    @property
    def decay(self) -> float:
        """Rate δ by which the oscillation decays [1 per unit of time]."""
        return float(self.damping[0]) if self.damping.size else 0.0

    def frequency(self) -> Estimate:
        """Return ω and its error."""
        gradient = np.zeros(self._size)
        gradient[self.coefficients.size] = 1.0
        return self._estimate(float(self.rates[0]), gradient)

    def half_peak_to_peak(self) -> Estimate:
        """Return half the height of the series, from its lowest to its highest, and its error."""
        top, bottom = (self._turn(sign) for sign in (1.0, -1.0))
        gradient = np.zeros(self._size)
        gradient[_COSINES] = 0.5 * (np.cos(top * _ORDERS) - np.cos(bottom * _ORDERS))
        gradient[self._sines] = 0.5 * (np.sin(top * _ORDERS) - np.sin(bottom * _ORDERS))
        height = float(gradient[: self.coefficients.size] @ self.coefficients)
        return self._estimate(height, gradient)

    @property
    def _size(self) -> int:
        return self.coefficients.size + self.rates.size + self.damping.size

    def uncertainty(self) -> float:
        """Return the product of both errors, by which fits are compared."""
        return self.frequency().error * self.half_peak_to_peak().error

    def _turn(self, sign: float) -> float:
        """Phase ωt [rad] at which sign times the series is largest, by Newton from a fine grid."""
        grid = np.linspace(0.0, 2.0 * np.pi, 40 * HARMONICS, endpoint=False)
        phases = np.outer(grid, _ORDERS)
        series = np.cos(phases) @ self.cosines + np.sin(phases) @ self.sines
        phase = float(grid[np.argmax(sign * series)])
        for _ in range(3):  # from 1/40 of the shortest wave: quadratic, hence round-off
            c, s = np.cos(phase * _ORDERS), np.sin(phase * _ORDERS)
            slope = float(_ORDERS @ (self.sines * c - self.cosines * s))
            bend = -float(_ORDERS**2 @ (self.cosines * c + self.sines * s))
            if sign * bend >= 0.0:
                break
            phase -= slope / bend
        return phase

    def _estimate(self, value: float, gradient: FloatArray) -> Estimate:
        """Attach an error to a number that changes with the parameters by `gradient`.

        The number moves with the samples by g·δx, g the influence function of the fit. The
        remainder r is orthogonal to g, but the whole error need not be: |g·δx| is bounded by Σ |ĝ|
        |r̂| over the discrete frequencies, r with the least lucky phases. Near its own frequencies
        the fit has absorbed the error, so r̂ is the largest of its neighbors.
        """
        inverse, samples = self._inverse, 2 * self.x.size
        influence = self.weights * (self.tangent @ (inverse @ (inverse.T @ gradient)))
        of_influence = np.abs(np.fft.rfft(influence, samples))
        bound = 2.0 / samples * float(of_influence @ self._unlucky)
        return Estimate(value=value, error=bound + _ROUND_OFF * abs(value))

    @cached_property
    def tangent(self) -> FloatArray:
        """Derivatives of the model by coefficients, ω, ν and the damping, (samples, all)."""
        slopes = _slopes(self.time, self.columns, self.coefficients, self.damping.size > 0)
        return np.hstack([self.columns, slopes])

    @cached_property
    def _inverse(self) -> FloatArray:
        """The weighted tangent's triangle, inverted."""
        root = np.sqrt(self.weights)[:, None]
        return np.linalg.pinv(np.linalg.qr(root * self.tangent, mode="r"), rcond=1e-12)

    @cached_property
    def _unlucky(self) -> FloatArray:
        """The remainder's spectrum, each line the largest of its neighbors."""
        # Twice as many samples: two bins to the turn.
        spectrum = np.abs(np.fft.rfft(self.remainder, 2 * self.x.size))
        return np.asarray(ndimage.maximum_filter1d(spectrum, 4 * _LOBE + 1))


def fit_signal(time: FloatArray, x: FloatArray, guess: float) -> Fit:
    """Fit a series of fundamental near `guess`, and as many tones as make it better known.

    Times increase from 0 to 1, evenly spaced or not; the signal x is of the order of one. The guess
    is ω [rad per unit of time], to a third of a turn over the window.
    """
    # Hann's window all but silences what is more than two turns away from a tone.
    weights = np.sin(np.pi * time) ** 2 * np.gradient(time)
    fit = _with_tones(_descend(time, x, weights, np.array([guess])))
    height = fit.half_peak_to_peak()
    if height.error > _LOOSE * height.value:
        first = fit.rates[:1]
        damped = _with_tones(_descend(time, x, weights, first, np.zeros(2)))
        # More parameters help a little by chance; of what decays they take nearly all.
        if damped.uncertainty() < 0.1 * fit.uncertainty():
            return damped
    return fit


def _with_tones(fit: Fit) -> Fit:
    """Return a fit with as many tones as make it better known."""
    time, x, weights = fit.time, fit.x, fit.weights
    best, failures = fit, 0
    room = (2 * time.size // 3 - best.coefficients.size) // 3
    for _ in range(min(_TONES, room)):
        if best.frequency().error < 2.0 * _ROUND_OFF * best.rates[0] or failures == 2:
            break
        rates = np.append(fit.rates, _loudest(time, fit.remainder))
        damping = np.insert(fit.damping, -1, 0.0) if fit.damping.size else fit.damping
        fit = _descend(time, x, weights, rates, damping)
        better = fit.uncertainty() < best.uncertainty()
        best, failures = (fit, 0) if better else (best, failures + 1)
    return _descend(time, x, weights, best.rates, best.damping, most=20, enough=1e-9)


def _descend(
    time: FloatArray,
    x: FloatArray,
    weights: FloatArray,
    rates: FloatArray,
    damping: FloatArray = _NONE,
    *,
    most: int = 8,
    enough: float = 1e-3,
) -> Fit:
    """Gauss-Newton's method on frequencies and damping; the coefficients are linear and follow.

    It ends after `most` steps, or when one gains less than `enough` of the misfit.
    """

    def at(rates: FloatArray, damping: FloatArray) -> Fit:
        columns = _columns(time, rates, damping)
        return Fit(time, x, weights, rates, damping, _solve(columns, x, weights), columns)

    fit = at(rates, damping)
    for _ in range(most):
        # The change that the linearized model asks for, coefficients free.
        step = _solve(fit.tangent, fit.remainder, weights)[fit.coefficients.size :]
        # Beyond a tenth of a turn over the window the linearization means nothing.
        step /= max(1.0, float(np.abs(step).max()) / 0.6)
        for _ in range(5):
            trial = at(fit.rates + step[: rates.size], fit.damping + step[rates.size :])
            if trial.misfit < fit.misfit:
                break
            step /= 2.0
        else:
            break  # at the minimum, to round-off
        gain = 1.0 - trial.misfit / fit.misfit
        fit = trial
        if gain < enough:
            break
    return fit


def _solve(columns: FloatArray, x: FloatArray, weights: FloatArray) -> FloatArray:
    """Weighted least squares by the small triangle of a QR factorization, rank revealed by SVD."""
    root = np.sqrt(weights)[:, None]
    weighted = np.hstack([root * columns, root * x[:, None]])
    triangle = np.asarray(np.linalg.qr(weighted, mode="r"))
    size = columns.shape[1]
    scale = np.linalg.norm(triangle[:, :size], axis=0)
    scale[scale == 0.0] = 1.0
    solution = np.linalg.lstsq(triangle[:, :size] / scale, triangle[:, size], rcond=1e-13)[0]
    return np.asarray(solution / scale, dtype=np.float64)


def _columns(time: FloatArray, rates: FloatArray, damping: FloatArray) -> FloatArray:
    """One, the cosines and the sines of harmonics and tones, shape (samples, coefficients)."""
    phases = np.outer(time, _of_each(rates))
    envelopes: FloatArray | float = 1.0
    if damping.size:
        s = time - _MIDDLE
        phases[:, :HARMONICS] += np.outer(0.5 * damping[-1] * s**2, _ORDERS)
        envelopes = np.exp(-np.outer(s, _of_each(damping[:-1])))
    waves = envelopes * np.cos(phases), envelopes * np.sin(phases)
    return np.hstack([np.ones((time.size, 1)), *waves])


def _of_each(rates: FloatArray) -> FloatArray:
    """Return those of harmonics and tones."""
    return np.concatenate([rates[0] * _ORDERS, rates[1:]])


def _slopes(
    time: FloatArray, columns: FloatArray, coefficients: FloatArray, damped: bool
) -> FloatArray:
    """Return the derivatives of the model by ω and the ν, then by δ and χ, (samples, all)."""
    half = columns.shape[1] // 2
    cosines, sines = columns[:, 1 : half + 1], columns[:, half + 1 :]
    c, s = coefficients[1 : half + 1], coefficients[half + 1 :]

    def gathered(of: FloatArray) -> FloatArray:
        return np.hstack([of[:, :HARMONICS] @ _ORDERS[:, None], of[:, HARMONICS:]])

    turned = gathered(cosines * s - sines * c)
    slopes = [time[:, None] * turned]
    if damped:
        middle = (time - _MIDDLE)[:, None]
        slopes += [-middle * gathered(cosines * c + sines * s), 0.5 * middle**2 * turned[:, :1]]
    return np.hstack(slopes)


def _loudest(time: FloatArray, remainder: FloatArray) -> float:
    """Frequency [rad per unit of time] of the remainder's largest peak, to 1/8 turn."""
    even = np.linspace(0.0, 1.0, time.size)
    tapered = np.interp(even, time, remainder) * np.sin(np.pi * even) ** 2
    spectrum = np.abs(np.fft.rfft(tapered, 8 * (time.size - 1)))
    return float(2.0 * np.pi * np.argmax(spectrum) / 8.0)
