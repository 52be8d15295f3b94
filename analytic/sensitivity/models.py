"""Derivatives of a reduced model's numbers: they are closed forms, and differences exact to 1e-9.

Four or five models for each parameter, in milliseconds.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from ..arrays import FloatArray
from ..blade import Blade
from ..load import Load
from ..motion import SteadyRotation
from ..reduced.model import ReducedModel
from ..reduced.model_range import model_at
from .conditions import case_of, conditions_of
from .energies import FINE, OneByOne, difference
from .parameters import Parameter, parameters_of

_CHANGE = 1e-3  # of a parameter over its size, of which the fourth power is left
_UNIFORM = "EA", "EI3", "m"  # with any of which a beam is still the paper's kind
_NUMBERS = {"omega_n": "rad/s", "lambda_omega": "1", "lambda_x": "1", "kappa": "1"}


class ModelDerivatives(OneByOne):
    """Derivatives of ω_n, λ_ω, λ_x and κ."""

    outputs, units = tuple(_NUMBERS), tuple(_NUMBERS.values())

    def __init__(self, model: ReducedModel) -> None:
        self._model = model
        self.values = np.array([getattr(model, name) for name in _NUMBERS])
        known = parameters_of(model.blade, model.theory)
        if not model.variant.is_of_any_blade:
            known = {name: one for name, one in known.items() if name in _UNIFORM}
        self.parameters = known
        self.given = SteadyRotation(omega=model.omega), ()
        self.conditions = conditions_of(*self.given, model.blade.frequency_scale)

    def again(self, blade: Blade, motion: Any, loads: Sequence[Load]) -> dict[str, float]:
        """Return the numbers of another blade's model at another speed, by name."""
        del loads
        other = model_at(blade, motion.omega, self._model.variant)
        return {name: float(getattr(other, name)) for name in _NUMBERS}

    def to(self, parameter: Parameter) -> FloatArray:
        """Return the derivatives of all numbers to a parameter."""
        return difference(parameter, self._anew, _CHANGE, FINE)

    def _anew(self, other: Any) -> FloatArray:
        case = case_of(other, self._model.blade, self.given)
        return np.array([*self.again(*case).values()])
