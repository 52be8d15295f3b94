"""The beam theory that a code is held against: its own, so that shear is no error of it."""

from __future__ import annotations

from dataclasses import dataclass

from analytic import AnyBlade, Beam, linear_modes, timoshenko_frequencies


@dataclass(frozen=True, kw_only=True)
class Theory:
    """Bernoulli and Euler's beam, with rotary inertia, or with shear (Timoshenko's).

    Only the uniform Beam has either: a Blade has its own rotary inertia, and no shear.

    Parameters
    ----------
    rotary_inertia : bool
        Whether sections have inertia against rotation.
    shear_share : float, optional
        k_s GA/(EA) = k_s/(2 (1 + ν)) of a beam that shears.
    """

    rotary_inertia: bool = False
    shear_share: float | None = None

    @property
    def name(self) -> str:
        """What the reference is called."""
        if self.shear_share is not None:
            return "Timoshenko"
        return "with rotary inertia" if self.rotary_inertia else "Bernoulli-Euler"

    def first_frequency(self, beam: AnyBlade, omega: float) -> float:
        """Return the first natural frequency [rad/s] in steady rotation; ValueError if refused."""
        if not isinstance(beam, Beam):
            return float(linear_modes(beam, omega, 1).frequencies[0])
        if self.shear_share is None:
            modes = linear_modes(beam, omega, 1, rotary_inertia=self.rotary_inertia)
            return float(modes.frequencies[0])
        return float(
            timoshenko_frequencies(
                beam,
                omega,
                1,
                shear_share=self.shear_share,
                rotary_inertia=self.rotary_inertia,
            )[0]
        )


BERNOULLI_EULER = Theory()
"""The beam of `linear_modes`."""
