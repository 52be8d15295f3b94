"""The beam theory that a code is held against: its own, so that shear is no error of it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from analytic import (
    AnyBlade,
    Backbone,
    Blade,
    SpinUp,
    SpinUpResponse,
    linear_modes,
    periodic_orbits,
    spin_up_response,
)
from analytic.input_checks import flag
from analytic.loads import Load
from analytic.profiles import evaluated, in_units


@dataclass(frozen=True, kw_only=True)
class Theory:
    """Bernoulli and Euler's beam, with rotary inertia, or with shear (Timoshenko's, Reissner's).

    Parameters
    ----------
    rotary_inertia : bool
        Whether sections have inertia against rotation: that of a homogeneous section,
        ρI = m EI/EA, unless the blade's section says its own, which it always has.
    shear_share : float, optional
        k_s GA/(EA) = k_s/(2 (1 + ν)) of a beam that shears.
    """

    rotary_inertia: bool = False
    shear_share: float | None = None

    def __post_init__(self) -> None:
        flag("rotary_inertia", self.rotary_inertia)

    @property
    def name(self) -> str:
        """What the reference is called."""
        if self.shear_share is not None:
            return "Timoshenko"
        return "with rotary inertia" if self.rotary_inertia else "Bernoulli-Euler"

    def first_frequency(self, beam: AnyBlade, omega: float) -> float:
        """Return the first natural frequency [rad/s] in steady rotation; ValueError if refused."""
        beam, sections = self._applied(beam)
        return float(linear_modes(beam, omega, 1, **sections).frequencies[0])

    def history(
        self,
        beam: AnyBlade,
        spin_up: SpinUp,
        times: float | ArrayLike,
        *,
        tolerance: float = 1e-8,
        loads: Sequence[Load] = (),
    ) -> SpinUpResponse:
        """Return the response of the exact beam to a spin-up, as `spin_up_response` does."""
        beam, sections = self._applied(beam)
        return spin_up_response(beam, spin_up, times, tolerance=tolerance, loads=loads, **sections)

    def orbits(self, beam: AnyBlade, omega: float, amplitudes: float | Sequence[float]) -> Backbone:
        """Return the periodic orbits of the first mode, as `periodic_orbits` does."""
        beam, sections = self._applied(beam)
        return periodic_orbits(beam, omega, amplitudes, **sections)

    def _applied(self, beam: AnyBlade) -> tuple[AnyBlade, dict[str, Any]]:
        """Return the blade with its inertia, and what else functions of `analytic` are told."""
        sections: dict[str, Any] = {"shear_share": self.shear_share}
        if isinstance(beam, Blade):
            return (_with_inertia(beam) if self.rotary_inertia else beam), sections
        return beam, sections | {"rotary_inertia": self.rotary_inertia}


def _with_inertia(blade: Blade) -> Blade:
    """Return the blade with the rotary inertia of a homogeneous section if it says none."""
    section, x = blade.section, np.linspace(0.0, 1.0, 257)
    if section.rotary_inertia is not None:
        return blade
    if not np.allclose(evaluated(blade.unit.mass, x), evaluated(blade.unit.axial, x), rtol=1e-9):
        raise ValueError(
            "mass and axial stiffness of the blade do not vary alike, so that its sections have no "
            "one ρ/E to take their rotary inertia from: give Section(rotary_inertia=...) in kg m"
        )
    inertia = in_units(
        section.bending_stiffness, 1.0, blade.axial_stiffness / blade.mass_per_length
    )
    return replace(blade, section=replace(section, rotary_inertia=inertia))


BERNOULLI_EULER = Theory()
"""The beam of `linear_modes`."""
