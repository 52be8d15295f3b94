"""The reduced models: one beam, rotation speed and variant, and what Eq. 41 answers for them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from numpy.typing import ArrayLike

from ..arrays import FloatArray, NumbersT, lone_as_float
from ..blade import Blade
from ..input_checks import finite_array, finite_number, not_negative
from ..theory import BERNOULLI_EULER, Theory
from ..warning import warn
from .any_blade import NormalMode, normal_mode
from .oscillator import Oscillator, Perturbation
from .variants import Variant

_MEANT = {3: 0.2, 5: 0.4}
"""Amplitudes up to which a model is meant, by its order: the paper's own bound, and FrM5's."""


@dataclass(frozen=True, kw_only=True, repr=False)
class ReducedModel:
    """Eq. 41 for one beam, rotation speed and variant; made by `reduced_model`.

    Parameters
    ----------
    blade : Blade
    omega : float
        Rotation speed ω [rad/s].
    variant : Variant
    oscillator : Oscillator
        Eq. 41 with its coefficients, nondimensional.
    """

    blade: Blade
    omega: float
    variant: Variant
    oscillator: Oscillator

    @property
    def theory(self) -> Theory:
        """Slices without shear and rotary inertia, which stretch in some variants."""
        return BERNOULLI_EULER

    @property
    def speed_ratio(self) -> float:
        """Ω = ω/ω0, Eq. 40 [-]."""
        return self.omega / self.blade.omega_0

    @property
    def omega_n(self) -> float:
        """Natural frequency of small oscillations [rad/s]."""
        return self.w_n * self.blade.frequency_scale

    @property
    def w_n(self) -> float:
        """ω_n of Eq. 41, nondimensional."""
        return self.oscillator.w_n

    @property
    def g1(self) -> float:
        """Cubic stiffness of Eq. 41, nondimensional."""
        return self.oscillator.g1

    @property
    def g2(self) -> float:
        """Inertial nonlinearity of Eq. 41, nondimensional."""
        return self.oscillator.g2

    @property
    def lambda_omega(self) -> float:
        """λ_ω of Eq. 64 [-]; positive softens."""
        return self.oscillator.lambda_omega

    @property
    def lambda_x(self) -> float:
        """λ_x of Eq. 65 [-], the tip's third harmonic; FrM adds the other modes' share."""
        return self.perturbation.h3

    @property
    def kappa(self) -> float:
        """κ of ω_NL = ω_n (1 - λ_ω a² - κ a⁴) [-], a the first harmonic; zero but in FrM5."""
        return self._normal_mode.kappa if self.variant.order == 5 else 0.0

    @property
    def kappa_of_peak(self) -> float:
        """κ where a is the peak of q/L; zero but in FrM5."""
        return self._normal_mode.kappa_of_peak if self.variant.order == 5 else 0.0

    @cached_property
    def _normal_mode(self) -> NormalMode:
        return normal_mode(self.blade.unit, self.omega / self.blade.frequency_scale)

    @cached_property
    def perturbation(self) -> Perturbation:
        """Frequency and tip as series in the first harmonic.

        The series of Eq. 41 in one-mode models; FrM adds the other modes' share in h2 and h3.
        """
        if not self.variant.coriolis:
            return Perturbation(lambda_omega=self.lambda_omega, h3=self.oscillator.lambda_x)
        h2, h3 = self._normal_mode.h2, self._normal_mode.h3
        return Perturbation(lambda_omega=self.lambda_omega, kappa=self.kappa, h2=h2, h3=h3)

    def frequency(self, a: NumbersT) -> NumbersT:
        """Return ω_NL = ω_n (1 - λ_ω a²) [rad/s], Eq. 63, and of FrM5 with its -κ a⁴.

        Parameters
        ----------
        a : float or ndarray
            Amplitude a0 of the first harmonic over L, in 0 .. 1; the result has its shape.

        Raises
        ------
        ValueError
            If an amplitude is negative, above 1 or not finite, or Eq. 63 gives no positive
            frequency for it.
        TypeError
            If `a` does not hold numbers.
        """
        series = Perturbation(lambda_omega=self.lambda_omega, kappa=self.kappa)
        amplitude = self._within(a, series.largest_amplitude, "Eq. 63 has no frequency")
        frequency: NumbersT = lone_as_float(self.omega_n * series.ratio(amplitude))
        return frequency

    def first_harmonic(self, peak: ArrayLike) -> FloatArray:
        """Return the first harmonic of q/L whose `response` has the `peak`, of its shape."""
        return self.perturbation.first_harmonic(finite_array("peak", peak))

    def exact_frequency(self, a: NumbersT) -> NumbersT:
        """Return the exact frequency of Eq. 41 [rad/s], by its first integral.

        Its distance from `frequency` is the error of the perturbation, of order a⁴. Parameters and
        errors as in `frequency`, but `a` is the peak of x.
        """
        largest = self.oscillator.largest_amplitude
        amplitude = self._within(a, largest, "Eq. 41 has no periodic orbit")
        exact = self.oscillator.exact_frequency(amplitude)
        frequency: NumbersT = lone_as_float(self.blade.frequency_scale * exact)
        return frequency

    def response(self, t: ArrayLike, a0: float, phase: float = 0.0) -> FloatArray:
        """Return x(t) = q/L of Eq. 65, of the shape of `t`; of FrM with its second harmonic.

        Corrected: it starts from a0 (1 - λ_x a0²) at phase zero, not from a0 (Eq. 53). FrM's tip
        has -h2 a0² sin 2ψ as well, and h2 and λ_x hold the share of the other modes.

        Parameters
        ----------
        t : array_like
            Time [s].
        a0 : float
            Amplitude of the first harmonic over L.
        phase : float
            φ0 of Eq. 65 [rad].
        """
        a0 = not_negative("a0", a0)
        psi = self.frequency(a0) * finite_array("t", t, "s") + finite_number("phase", phase, "rad")
        return self.perturbation.deflection(psi, a0)

    def __repr__(self) -> str:
        kind = "softens" if self.lambda_omega > 0.0 else "hardens"
        fifth = f", κ = {self.kappa:.7f}" if self.variant.order == 5 else ""
        return (
            f"{self.variant.name} at ω = {self.omega:g} rad/s (Ω = {self.speed_ratio:.4g}): "
            f"ω_n = {self.omega_n:.6f} rad/s, g1 = {self.g1:.6g}, g2 = {self.g2:.6g}, "
            f"λ_ω = {self.lambda_omega:.7f} ({kind}), λ_x = {self.lambda_x:.7f}{fifth}"
        )

    def _within(self, a: ArrayLike, largest: float, beyond: str) -> FloatArray:
        """Return amplitudes as floats; refuse negative ones, above 1, and from `largest` on."""
        amplitude, order = finite_array("amplitude", a), self.variant.order
        if amplitude.size == 0:
            return amplitude
        low, high = float(amplitude.min()), float(amplitude.max())
        not_negative("amplitude", low, remedy="the phase, not the sign, turns the start around")
        if high > 1.0:
            raise ValueError(f"amplitude is the tip's over L and at most 1, got {high}: meters?")
        if high >= largest:
            raise ValueError(
                f"{beyond} at amplitude {high:g} in {self.variant.name} at omega = "
                f"{self.omega:g} rad/s: keep it below {largest:.6g}"
            )
        if high > _MEANT[order]:
            bound = {3: "the paper's own bound for the reduced models", 5: "beyond which a⁶ counts"}
            warn(
                f"amplitude {high:g} is above {_MEANT[order]:g}, {bound[order]}; backbone_curve "
                "and periodic_orbits go on for as long as there is an orbit"
            )
        return amplitude
